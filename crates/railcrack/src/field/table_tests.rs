//! Fields of contact tables, compared with closed forms, equilibrium, the surface, superposition.

use super::super::field_checks::{equilibrium, largest, strains};
use super::super::{CarterWheel, HertzWheel, PlacedWheel, Wheels};
use super::*;
use crate::load::{CarterContact, ContactRow, HertzianContact, Travel};

const HERTZ: HertzianContact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.3 };

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

/// Rows of pressure and shear, evenly spaced in the angle or in u.
fn table(
    half_width: f64,
    count: usize,
    angular: bool,
    p: impl Fn(f64) -> f64,
    q: impl Fn(f64) -> f64,
) -> TableContact {
    let last = count - 1;
    let row = |i: usize| {
        let share = i as f64 / last as f64;
        let u = half_width * if angular { -(PI * share).cos() } else { 2.0 * share - 1.0 };
        let inside = i > 0 && i < last;
        ContactRow { u, pressure: if inside { p(u) } else { 0.0 }, shear: if inside { q(u) } else { 0.0 } }
    };
    TableContact::new((0..count).map(row).collect(), None).unwrap()
}

fn ellipse(count: usize, angular: bool) -> TableWheel {
    let p = |u: f64| 845.0 * (1.0 - (u / 6.75).powi(2)).max(0.0).sqrt();
    TableWheel::new(&table(6.75, count, angular, p, |u| 0.3 * p(u)), &steel())
}

fn points() -> Vec<Vec2> {
    let place = |i: i32| {
        let depth = 0.05 * 10f64.powf(3.3 * f64::from((i * 37) % 400) / 400.0);
        Vec2::new(0.2 * f64::from(i) - 40.0, -depth)
    };
    (0..400).map(place).collect()
}

fn difference(one: &dyn Wheel, other: &dyn Wheel) -> f64 {
    let points = points();
    let pairs = one.stresses(&points, 1.0).into_iter().zip(other.stresses(&points, 1.0));
    pairs.map(|(one, other)| largest(one - other)).fold(0.0, f64::max)
}

#[test]
fn an_ellipse_of_two_thousand_points() {
    let hertz = HertzWheel::new(&HERTZ, &steel()).unwrap();
    let table = ellipse(2001, true);
    // At depths below the spacing of the rows at the edges, the discretisation of the table shows.
    let deep = points().into_iter().filter(|point| point.y < -0.25);
    let error = deep.map(|p| largest(table.stress(p, 1.0) - hertz.stress(p, 1.0))).fold(0.0, f64::max);
    println!("stress, 2001 points: {error:e} MPa");
    assert!(error < 4e-4, "{error:e} MPa at 845 MPa");
}

#[test]
fn stress_converges_with_the_rows() {
    // Piecewise linear: second order in rows that are evenly spaced in the angle, where the ellipse
    // is smooth.
    let hertz = HertzWheel::new(&HERTZ, &steel()).unwrap();
    let errors: Vec<f64> =
        [51, 101, 201, 401].map(|count| difference(&ellipse(count, true), &hertz)).to_vec();
    println!("errors {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.3).contains(&order), "{errors:?}");
    }
}

#[test]
fn carter_from_a_table() {
    let contact = CarterContact {
        peak_pressure: 845.0,
        half_width: 6.75,
        friction: 0.3,
        traction: -0.6,
        travel: Travel::Forward,
    };
    let closed = CarterWheel::new(&contact, &steel()).unwrap();
    let rows = table(6.75, 2001, true, |u| contact.pressure(u), |u| contact.shear(u));
    // The shear is a square root at the edge of the stick zone, which does not coincide with a row.
    assert!(difference(&TableWheel::new(&rows, &steel()), &closed) < 1.0);
}

/// The largest difference of a stress component from the sum over all rows, over the largest
/// pressure, at some thousand places down to 4 half-widths.
fn summation_error(wheel: &TableWheel) -> f64 {
    let place = |i: i32| {
        let x = 5.0 * (2.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract() - 1.0);
        let y = -4.0 * 10f64.powf(-6.0 * (f64::from(i) * 0.414_213_562_373_095).fract());
        let (fast, direct) = (wheel.potential.at(x, y), wheel.potential.directly(x, y));
        let difference = wheel.stress_of(&fast, y) - wheel.stress_of(&direct, y);
        difference.xx.abs().max(difference.yy.abs()).max(difference.xy.abs())
    };
    (0..2000).map(place).fold(0.0, f64::max) / wheel.contact.peak_pressure()
}

#[test]
fn the_summation_is_as_accurate_as_it_says() {
    for count in [3, 201, 2001] {
        let error = summation_error(&ellipse(count, false));
        println!("{count} rows: {error:e} of the peak");
        assert!(error < 4e-7, "{error:e}");
    }
}

#[test]
fn the_surface_bears_the_table() {
    let wheel = ellipse(41, false);
    let rows = wheel.contact.rows();
    for pair in rows.windows(2) {
        for share in [0.0, 0.25, 0.5, 0.9] {
            let u = pair[0].u + share * (pair[1].u - pair[0].u);
            let pressure = pair[0].pressure + share * (pair[1].pressure - pair[0].pressure);
            let shear = pair[0].shear + share * (pair[1].shear - pair[0].shear);
            let s = wheel.stress(Vec2::new(u + 3.0, 0.0), 3.0);
            let error = (s.yy + pressure).abs().max((s.xy - shear).abs());
            assert!(error < 1e-4, "u = {u}: {error:e}"); // the summation: 7e-8 of 845 MPa
        }
    }
    for u in [-40.0, -7.0, 6.9, 25.0] {
        let s = wheel.stress(Vec2::new(u, 0.0), 0.0);
        assert!(s.yy.abs().max(s.xy.abs()) < 1e-4, "free surface at {u}: {s:?}");
    }
}

#[test]
fn is_in_equilibrium_and_its_strains_are_those_of_its_stress() {
    let wheel = ellipse(41, false);
    for (x, y) in
        [(2.0, -1.5), (-6.0, -1.0), (7.0, -2.0), (13.0, -6.0), (-20.0, -1.0), (0.1, -5.0), (90.0, -60.0)]
    {
        let point = Vec2::new(x, y);
        // Differences over 1e-2 mm of the summation error: 1e-5 of the stress.
        assert!(
            equilibrium(&wheel, point, 1e-2) < 1e-4 * 845.0,
            "{point:?}: {}",
            equilibrium(&wheel, point, 1e-2)
        );
        let error = strains(&wheel, &steel(), point, 1e-2);
        assert!(error < 1e-5 * 845.0, "{point:?}: {error}");
    }
    let far = Vec2::new(-30.0 * 6.75, -1e4);
    let hertz = HertzWheel::new(&HERTZ, &steel()).unwrap();
    let scale = wheel.contact.line_load() / HERTZ.line_load();
    let want = hertz.stress(far, 0.0) * scale;
    assert!(largest(wheel.stress(far, 0.0) - want) < 1e-3 * largest(want), "without round-off far away");
}

#[test]
fn two_patches_are_two_wheels() {
    let hill = [(-1.0, 0.0), (0.0, 300.0), (1.5, 0.0)];
    let other = [(4.0, 0.0), (5.0, 500.0), (6.0, 100.0), (7.0, 0.0)];
    let wheel = |rows: &[(f64, f64)]| {
        let row = |&(u, pressure): &(f64, f64)| ContactRow { u, pressure, shear: -0.2 * pressure };
        TableWheel::new(&TableContact::new(rows.iter().map(row).collect(), Some(0.2)).unwrap(), &steel())
    };
    let both: Vec<(f64, f64)> = hill.into_iter().chain(other).collect();
    let placed = |wheel| PlacedWheel { wheel: Box::new(wheel), at: 0.0 };
    let sum = Wheels::new(vec![placed(wheel(&hill)), placed(wheel(&other))]).unwrap();
    assert!(difference(&wheel(&both), &sum) < 1e-7 * 500.0);
    assert_eq!(sum.edges(), wheel(&both).edges());
    assert_eq!(sum.half_width(), 1.5);
    let shifted: Vec<(f64, f64)> = hill.iter().map(|row| (row.0 + 2.0, row.1)).collect();
    let beside = Wheels::new(vec![PlacedWheel { wheel: Box::new(wheel(&hill)), at: 2.0 }]).unwrap();
    assert!(difference(&wheel(&shifted), &beside) < 1e-7 * 300.0);
    assert_eq!(beside.edges(), [1.0, 3.5]);
}

//! Check values of the theories of rolling contact.

use super::slip::StripBound;
use super::stick::Regime;
use super::*;
use crate::load::{Contact, HertzEllipse, Travel, WheelOnRail};
use crate::material::IsotropicElastic;
use std::f64::consts::PI;

fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

fn patch(axes: [f64; 2], normal: f64, friction: f64, creepage: [f64; 3]) -> RollingPatch {
    let peak_pressure = 1.5 * normal / (PI * axes[0] * axes[1]);
    let [longitudinal, lateral, spin] = creepage;
    RollingPatch {
        ellipse: HertzEllipse { peak_pressure, along: axes[0], across: axes[1] },
        outline: None,
        friction,
        creepage: Creepage { longitudinal, lateral, spin },
        steel: steel(),
        theory: RollingTheory::FaStrip,
    }
}

/// 80 kN on 6 × 4 mm with creepage in all directions.
fn all_creepages() -> RollingPatch {
    patch([6.0, 4.0], 80e3, 0.3, [1e-3, 5e-4, 2e-4])
}

fn near(got: f64, want: f64, relative: f64) {
    assert!((got / want - 1.0).abs() < relative, "{got}, {want}");
}

#[test]
fn coefficients_between_the_entries_of_the_table() {
    // Five digits by an independent interpolation.
    for (ratio, want) in
        [(1.5, [4.7960, 4.3969, 2.0881]), (0.5, [3.8130, 3.0360, 0.95349]), (1.0, [4.3000, 3.7285, 1.5003])]
    {
        let KalkerCoefficients { c11, c22, c23 } = KalkerCoefficients::of(ratio, 0.3);
        for (got, want) in [c11, c22, c23].into_iter().zip(want) {
            near(got, want, 2e-5);
        }
    }
    let at = KalkerCoefficients::of(0.3, 0.25);
    assert!((at.c11 - 3.44).abs() < 1e-12 && (at.c22 - 2.75).abs() < 1e-12 && (at.c23 - 0.715).abs() < 1e-12);
}

#[test]
fn coefficients_of_slender_ellipses_join_the_table() {
    for poisson in [0.0, 0.25, 0.3, 0.5] {
        for slender in [0.1, 10.0] {
            let outside = if slender < 1.0 { slender * (1.0 - 1e-9) } else { slender * (1.0 + 1e-9) };
            let (inner, outer) =
                (KalkerCoefficients::of(slender, poisson), KalkerCoefficients::of(outside, poisson));
            near(outer.c11, inner.c11, 1e-6);
            near(outer.c22, inner.c22, 1e-6);
            near(outer.c23, inner.c23, 1e-6);
        }
        let line = KalkerCoefficients::of(1e-7, poisson);
        near(line.c11, 0.25 * PI * PI / (1.0 - poisson), 1e-6);
        near(line.c22, 0.25 * PI * PI, 1e-6);
    }
}

#[test]
fn forces_of_the_linear_theory() {
    // By hand from the coefficients, G = 80769.23 MPa.
    let [along, across] = all_creepages().linear_force();
    near(along, -9296.9, 1e-5);
    near(across, -8227.6, 1e-5);
}

/// FASTSIM on `n` × `n` cells as published: the shear of a cell is that of its middle after a whole
/// step from the one before, and keeps its direction at the limit. Forces, the share of slipping
/// cells, and that of slipping area.
fn fastsim_on_cells(patch: &RollingPatch, n: usize) -> ([f64; 2], f64, f64) {
    let (mut force, mut cells, mut slipping, mut area) = ([0.0; 2], 0.0, 0.0, 0.0);
    let (Creepage { longitudinal, lateral, spin }, l) = (patch.creepage, patch.flexibilities());
    let b = patch.ellipse.across;
    for j in 0..n {
        let y = b * ((2 * j + 1) as f64 / n as f64 - 1.0);
        let bound = StripBound::of(patch, y);
        let step = 2.0 * bound.half_length / n as f64;
        let mut shear = [0.0; 2];
        for i in 0..n {
            let x = bound.half_length - step * (i as f64 + 0.5);
            shear[0] -= step * (longitudinal / l.l1 - spin * y / l.l3);
            shear[1] -= step * (lateral / l.l2 + spin * x / l.l3);
            let over = shear[0].hypot(shear[1]) / bound.parabolic(x);
            let cell = step * 2.0 * b / n as f64;
            if over > 1.0 {
                shear = shear.map(|q| q / over);
                cells += 1.0;
                slipping += cell;
            }
            force = [0, 1].map(|k| force[k] + shear[k] * cell);
            area += cell;
        }
    }
    (force, cells / (n * n) as f64, slipping / area)
}

#[test]
fn fastsim_on_three_grids_and_without_a_grid() {
    let patch = RollingPatch { theory: RollingTheory::Fastsim, ..all_creepages() };
    // An independent program, rounded to newtons.
    for (n, along, across) in [(50, -7873.0, -7557.0), (100, -7794.0, -7509.0), (200, -7755.0, -7484.0)] {
        let (force, ..) = fastsim_on_cells(&patch, n);
        assert!((force[0] - along).abs() < 0.7 && (force[1] - across).abs() < 0.7, "{n}: {force:?}");
    }
    let (_, cells, area) = fastsim_on_cells(&patch, 100);
    assert!((cells - 0.21).abs() < 5e-3 && (area - 0.178).abs() < 1e-3, "{cells} {area}");
    // Extrapolated to cells without size. A shear that opposes the slip moves them by 0.3 and 0.7
    // %.
    let forces = patch.forces();
    near(forces.force[0], -7717.2, 5e-3);
    near(forces.force[1], -7459.4, 1e-2);
    assert!((forces.slip_share - 0.178).abs() < 5e-3, "{forces:?}");
}

#[test]
fn without_slip_all_theories_have_the_linear_force() {
    for theory in
        [RollingTheory::FaStrip, RollingTheory::Strip, RollingTheory::Fastsim, RollingTheory::Linear]
    {
        let patch = RollingPatch { friction: 50.0, theory, ..all_creepages() };
        let (forces, linear) = (patch.forces(), patch.linear_force());
        // d of FaStrip is a thousandth of a; FASTSIM is exact but for the quadrature.
        near(forces.force[0], linear[0], 6e-3);
        near(forces.force[1], linear[1], 6e-3);
        assert!(forces.slip_share < 6e-3, "{forces:?}");
    }
}

#[test]
fn the_example_of_contact_with_spin() {
    // CONTACT's user guide, steady rolling with spin: a 8, b 4 mm, 82 kN, μ 0.3, G 82000 MPa, ν
    // 0.28; the exact theory gives F_y = −14940 N.
    let steel = IsotropicElastic::new(2.0 * 82e3 * 1.28, 0.28).unwrap();
    let fastrip = RollingPatch { steel, ..patch([8.0, 4.0], 82e3, 0.3, [0.0, -6.25e-4, 6.25e-4]) };
    let force = |theory| RollingPatch { theory, ..fastrip }.forces().force;
    assert!(force(RollingTheory::FaStrip)[0].abs() < 1e-6);
    // As published, FaStrip and FASTSIM give -15850 and -15640 N on the finest grid of CONTACT.
    near(force(RollingTheory::FaStrip)[1], -14940.0, 0.045);
    near(force(RollingTheory::Fastsim)[1], -14940.0, 0.09);
    near(force(RollingTheory::Strip)[1], -14940.0, 0.015);
}

#[test]
fn fastrip_near_the_published_one() {
    // An independent program, in which the shear keeps its direction in slip.
    let forces = all_creepages().forces();
    near(forces.force[0], -7775.6, 1e-2);
    near(forces.force[1], -7728.9, 2e-2);
    assert!(forces.t_gamma > 0.0 && forces.t_gamma_with_spin > forces.t_gamma, "{forces:?}");
}

const SLIPPING: [RollingTheory; 3] = [RollingTheory::FaStrip, RollingTheory::Strip, RollingTheory::Fastsim];

#[test]
fn in_full_slip_the_force_opposes_the_creepage() {
    let limit = 0.3 * 100e3;
    for theory in SLIPPING {
        for axes in [[4.0, 12.0], [8.0, 8.0], [12.0, 3.0]] {
            for turn in [0.0, 0.3, 0.8, 1.5, 2.9, -2.0] {
                let creepage = [0.1 * f64::cos(turn), 0.1 * f64::sin(turn), 0.0];
                let [along, across] =
                    RollingPatch { theory, ..patch(axes, 100e3, 0.3, creepage) }.forces().force;
                let error = (along / limit + turn.cos()).hypot(across / limit + turn.sin());
                assert!(error < 1e-3, "{theory:?} {axes:?} {turn}: {along} {across}");
            }
        }
        // A tenth of that creepage: the elastic slip turns the shear by half a degree.
        let forces = RollingPatch { theory, ..patch([4.0, 12.0], 100e3, 0.3, [0.01, 0.01, 0.0]) }.forces();
        let largest = if theory == RollingTheory::FaStrip { 0.01 } else { 0.016 };
        forces.force.iter().for_each(|force| near(*force, -limit * 0.5f64.sqrt(), largest));
    }
}

#[test]
fn in_full_slip_with_spin_the_shear_opposes_the_rigid_slip_at_every_point() {
    let creepage = [0.15, -0.09, 0.024];
    for theory in SLIPPING {
        let patch = RollingPatch { theory, ..patch([6.0, 5.0], 90e3, 0.3, creepage) };
        for y in [-4.0, -1.0, 0.0, 2.0, 4.5] {
            let strip = patch.strip(y, 80).unwrap();
            // The elastic slip turns the shear: L1 μp0/a = 0.0033 times x/√(a² − x²), up to 2.1.
            for point in strip.points.iter().filter(|point| point.x.abs() < 0.9 * strip.half_length) {
                let rigid = [creepage[0] - creepage[2] * y, creepage[1] + creepage[2] * point.x];
                let limit = 0.3 * point.pressure;
                let size = f64::hypot(rigid[0], rigid[1]);
                let error = [0, 1].map(|i| point.shear[i] / limit + rigid[i] / size);
                let error = error[0].hypot(error[1]);
                assert!(point.slips && error * size < 0.0069, "{theory:?} {y} {point:?} {error}");
            }
        }
    }
}

#[test]
fn under_large_spin_no_shear_exceeds_friction() {
    // φ′ of 1.5 and 4, where strip theory has zones of more than μp, or none.
    for theory in [RollingTheory::FaStrip, RollingTheory::Strip] {
        for (lateral, spin) in [(0.0, 4e-4), (-2e-3, 4e-4), (1e-3, 1e-3), (-4e-3, 1e-3)] {
            let patch = RollingPatch { theory, ..patch([20.0, 4.0], 82e3, 0.3, [0.0, lateral, spin]) };
            for y in [-3.5, -1.0, 0.1, 2.0] {
                for point in patch.strip(y, 200).unwrap().points {
                    let size = point.shear[0].hypot(point.shear[1]);
                    assert!(
                        size <= 0.3 * point.pressure * 1.001 + 1.0,
                        "{theory:?} {lateral} {spin} {y} {point:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn fast_theories_agree_within_their_errors() {
    let force = |theory| RollingPatch { theory, ..all_creepages() }.forces().force;
    for theory in [RollingTheory::FaStrip, RollingTheory::Strip] {
        for (got, want) in force(theory).into_iter().zip(force(RollingTheory::Fastsim)) {
            near(got, want, 0.05);
        }
    }
}

/// Displacement gradient of a strip under q = √(h² − (x−m)²)/a within |x−m| < h is linear in x,
/// −(x−m)/a but for the compliance.
#[test]
fn strip_theory_does_not_slip_where_it_sticks() {
    let patch = RollingPatch { theory: RollingTheory::Strip, ..all_creepages() };
    let KalkerCoefficients { c11, c22, c23 } = patch.coefficients();
    let (a, b) = (patch.ellipse.along, patch.ellipse.across);
    let limit = patch.friction * patch.ellipse.peak_pressure;
    let creep = -2.0 * 0.7 * steel().shear_modulus() / (PI * PI * limit);
    let spin =
        -3.0 * steel().shear_modulus() * (a * b).sqrt() * c23 * patch.creepage.spin / (2.0 * PI * limit);
    for y in [-2.0, -0.5, 0.0, 1.0, 2.5] {
        let Regime::Sticks(zone) = Regime::of(&patch, y) else { panic!("a strip that sticks") };
        let d = zone.middle / a;
        let along = creep * c11 * patch.creepage.longitudinal - spin * y / a;
        near(0.7 * d * zone.inner[0], along, 1e-12);
        near(0.7 * d * zone.inner[1], creep * c22 * patch.creepage.lateral, 1e-12);
        near(zone.outer[1] - zone.inner[1], spin, 1e-12);
    }
}

#[test]
fn a_long_contact_across_is_that_of_carter() {
    // b → ∞ without spin: d = G a ξ/(2(1−ν)μp0) is Carter's a − c.
    let (a, creep) = (6.0, 4e-4);
    let wide = patch([a, 6e6], 1.0, 0.3, [creep, 0.0, 0.0]);
    let wide = RollingPatch { ellipse: HertzEllipse { peak_pressure: 900.0, ..wide.ellipse }, ..wide };
    let Contact::Carter(contact) = wide.plane_contact(0.0, Travel::Forward).unwrap() else {
        panic!("a strip of Carter's form")
    };
    let slip = steel().shear_modulus() * a * creep / (2.0 * 0.7 * 0.3 * 900.0);
    near(a - contact.stick_half_width(), slip, 1e-5);
    near(contact.traction, -(1.0 - (1.0 - slip / a).powi(2)), 1e-5);
}

#[test]
fn the_force_of_carter_in_the_example_of_contact() {
    // carter2d of CONTACT: exact Q/(μP) = 0.6400, that is d/a = 0.4.
    let (a, peak, friction) = (1.0, 1000.0, 0.3);
    let creep = 0.4 * 2.0 * 0.7 * friction * peak / steel().shear_modulus();
    let wide = RollingPatch {
        ellipse: HertzEllipse { peak_pressure: peak, along: a, across: 1e6 },
        ..patch([a, 1e6], 1.0, friction, [creep, 0.0, 0.0])
    };
    let middle = wide.plane_contact(0.0, Travel::Forward).unwrap();
    near(-middle.adhesion() / friction, 0.64, 1e-5);
}

#[test]
fn hertz_ellipses_of_rail_heads() {
    // 85 kN, wheel 460 mm.
    for (head, want) in [
        (300.0, [6.7840, 5.1031, 1172.3]),
        (80.0, [8.0915, 2.5584, 1960.5]),
        (13.0, [9.5457, 0.97319, 4368.7]),
    ] {
        let wheel = WheelOnRail {
            wheel_load: 85e3,
            wheel_radius: 460.0,
            rail_head_radius: head,
            wheel_profile_radius: f64::INFINITY,
        };
        let ellipse = HertzEllipse::new(&wheel, &steel()).unwrap();
        for (got, want) in [ellipse.along, ellipse.across, ellipse.peak_pressure].into_iter().zip(want) {
            near(got, want, 3e-5);
        }
    }
}

#[test]
fn driving_and_braking_wheels_have_opposite_signs() {
    let driving = patch([6.0, 5.0], 85e3, 0.3, [8e-4, 0.0, 0.0]);
    let adhesion = |patch: &RollingPatch, travel| patch.plane_contact(0.0, travel).unwrap().adhesion();
    assert!(driving.forces().force[0] < 0.0 && adhesion(&driving, Travel::Forward) < 0.0);
    // A vehicle code gives the same wheel a negative creepage.
    assert_eq!(CreepageSign::Vehicle.read(driving.creepage.reversed()), driving.creepage);
    assert_eq!(CreepageSign::Contact.read(driving.creepage), driving.creepage);
    let braking = RollingPatch { creepage: driving.creepage.reversed(), ..driving };
    assert!(braking.forces().force[0] > 0.0 && adhesion(&braking, Travel::Forward) > 0.0);
    // A driving wheel that runs towards −x pushes the rail towards +x.
    assert_eq!(adhesion(&driving, Travel::Backward), -adhesion(&driving, Travel::Forward));
    // Spin > 0 and lateral creepage > 0: F_y < 0.
    assert!(patch([6.0, 5.0], 85e3, 0.3, [0.0, 0.0, 3e-4]).forces().force[1] < 0.0);
    assert!(patch([6.0, 5.0], 85e3, 0.3, [0.0, 3e-4, 0.0]).forces().force[1] < 0.0);
}

#[test]
fn the_mirrored_rail_has_the_mirrored_strip() {
    for theory in [RollingTheory::FaStrip, RollingTheory::Fastsim] {
        let one = RollingPatch { theory, ..all_creepages() };
        let (left, right) = (one.strip(1.7, 80).unwrap(), one.mirrored_across().strip(-1.7, 80).unwrap());
        for (a, b) in left.points.iter().zip(&right.points) {
            assert_eq!((a.x, a.pressure, a.shear[0], a.shear[1]), (b.x, b.pressure, b.shear[0], -b.shear[1]));
        }
        assert_ne!(left.points[40].shear[0], one.strip(-1.7, 80).unwrap().points[40].shear[0]);
    }
}

#[test]
fn the_shear_never_exceeds_friction_and_is_continuous_where_the_stick_zone_ends() {
    for theory in [RollingTheory::FaStrip, RollingTheory::Fastsim] {
        for spin in [0.0, 2e-4, 1e-3] {
            let patch = patch([6.0, 4.0], 80e3, 0.3, [6e-4, -3e-4, spin]);
            let patch = RollingPatch { theory, ..patch };
            for y in [-3.5, -1.0, 0.0, 2.0, 3.9] {
                for point in patch.strip(y, 400).unwrap().points {
                    let size = point.shear[0].hypot(point.shear[1]);
                    // FaStrip with spin: the two half-ellipses differ by a little more than μp.
                    let most = 0.3 * point.pressure * 1.02 + 1.0;
                    assert!(size <= most, "{theory:?} {spin} {y} {point:?} {size} {most}");
                }
            }
        }
    }
}

#[test]
fn a_table_of_a_strip_carries_its_load() {
    let patch = all_creepages();
    let strip = patch.strip(1.0, 160).unwrap();
    let table = strip.table().unwrap();
    let hertz = patch.ellipse.strip(1.0, 0.0).unwrap();
    near(table.line_load(), hertz.line_load(), 3e-4);
    assert_eq!(table.peak_pressure(), hertz.peak_pressure);
    let contact = patch.plane_contact(1.0, Travel::Backward).unwrap();
    assert!(contact.adhesion() > 0.0 && matches!(contact, Contact::Table(_)), "driving, towards −x");
}

#[test]
fn the_regular_form_holds_at_unit_spin() {
    // φ' passes 1 between these spins: the force is continuous there.
    let at = |spin: f64| patch([8.0, 4.0], 82e3, 0.3, [0.0, -6.25e-4, spin]).forces().force[1];
    let unit = {
        let one = patch([8.0, 4.0], 82e3, 0.3, [0.0, 0.0, 1.0]);
        let c23 = one.coefficients().c23;
        2.0 * PI * 0.3 * one.ellipse.peak_pressure / (3.0 * steel().shear_modulus() * 32f64.sqrt() * c23)
    };
    near(at(unit * (1.0 + 1e-7)), at(unit * (1.0 - 1e-7)), 1e-4);
    near(at(unit), at(unit * (1.0 - 1e-7)), 1e-4);
}

#[test]
fn refused_patches_say_what_is_wrong() {
    let fine = all_creepages();
    assert!(fine.check().is_ok());
    let says = |patch: RollingPatch| patch.check().unwrap_err().to_string();
    assert!(says(RollingPatch { friction: 0.0, ..fine }).contains("creepage without friction"));
    assert!(says(RollingPatch { friction: -0.1, ..fine }).contains("= -0.1: must be zero or more"));
    let creepage = Creepage { spin: f64::NAN, ..fine.creepage };
    assert!(says(RollingPatch { creepage, ..fine }).contains("spin (1/mm) = NaN"));
    let linear = RollingPatch { theory: RollingTheory::Linear, friction: 0.1, ..fine };
    assert!(says(linear).contains("times the friction force"));
    assert!(RollingPatch { friction: 0.0, creepage: Creepage::default(), ..fine }.check().is_ok());
    assert!(fine.strip(4.0, 20).is_err() && fine.plane_contact(-4.2, Travel::Forward).is_err());
}

#[test]
fn scattered_wheels_load_a_crack_less_than_centred_ones() {
    // ΔK ∝ p0 √a ∝ √(1 − y²/b²) of the strip, rate ∝ ΔK^3.33; y normal with standard deviation σ.
    // The means are integrals by an independent program.
    for (sigma, want) in [(0.25, 0.9027), (0.5, 0.6984), (1.0, 0.4210), (1.5, 0.2923)] {
        let ellipse = HertzEllipse { peak_pressure: 1000.0, along: 6.0, across: 1.0 };
        let (mut mean, n) = (0.0, 4000);
        for i in 0..n {
            let y = (2 * i + 1) as f64 / n as f64 - 1.0;
            let strip = ellipse.strip(y, 0.0).unwrap();
            let range = strip.peak_pressure / 1000.0;
            let density = (-0.5 * (y / sigma).powi(2)).exp() / (sigma * (2.0 * PI).sqrt());
            mean += range.powf(3.33) * density * 2.0 / n as f64;
        }
        assert!((mean - want).abs() < 1e-4, "{sigma}: {mean}");
    }
}

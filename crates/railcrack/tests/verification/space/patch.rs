//! The stress of a contact patch in the plane of a crack, alone and averaged along its front,
//! against the field of space.

use railcrack::field::{CrackLine, PatchLoad, PatchWheel, PlaceOnCrack, Spread, StripTraction, Wheel};
use railcrack::load::HertzEllipse;
use railcrack::math::{Stress, Vec2, gauss_legendre};
use railcrack::space::{EllipticWheel, WheelPatch};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use crate::common::steel;

const PEAK: f64 = 1000.0;

fn elliptic(b: f64, lateral: f64, lateral_friction: f64) -> EllipticWheel {
    EllipticWheel {
        peak_pressure: PEAK,
        half_width: 5.0,
        lateral_half_width: b,
        lateral,
        friction: 0.3,
        lateral_friction,
    }
}

fn ellipse(b: f64) -> HertzEllipse {
    HertzEllipse { peak_pressure: PEAK, along: 5.0, across: b }
}

/// The largest difference of the components that load a crack in the plane, over p0.
fn off(own: Stress, of_space: [f64; 6]) -> f64 {
    let [xx, yy, zz, _, xz, _] = of_space;
    // In space the third axis points downwards.
    let pairs = [(own.xx, xx), (own.yy, zz), (own.zz, yy), (own.xy, -xz)];
    pairs.iter().map(|(own, want)| (own - want).abs()).fold(0.0, f64::max) / PEAK
}

#[test]
fn in_the_plane_of_the_crack() {
    for (b, lateral, lateral_friction) in [
        (5.0, 0.0, 0.0),
        (2.5, 0.0, 0.0),
        (10.0, 0.0, 0.2),
        (5.0, 3.0, 0.0),
        (8.0, -9.0, -0.1),
        (50.0, 0.0, 0.0),
    ] {
        let own = PatchWheel::new(
            &[PatchLoad::sliding(&ellipse(b), [0.0, lateral], [0.3, lateral_friction])],
            &steel(),
        );
        let space = WheelPatch::Ellipse(elliptic(b, lateral, lateral_friction));
        for x in [-60.0, -8.0, -4.0, 0.0, 2.0, 6.0, 25.0] {
            for depth in [0.1, 0.5, 2.0, 6.0, 15.0, 60.0] {
                let stress = own.stress(Vec2::new(x + 2.0, -depth), 2.0);
                let error = off(stress, space.stress(2.0, [x + 2.0, 0.0, depth], steel().poisson()));
                // A slender patch, and any far away at the surface, is seen within a narrow angle.
                let allowed = if x.abs() >= 10.0 * depth || b > 25.0 { 5e-3 } else { 1e-3 };
                assert!(error < allowed, "b {b}, lateral {lateral}, x {x}, depth {depth}: {error:.1e} p0");
            }
        }
    }
}

/// ∫ w(z) σ(x, z, depth) dz with the weight of (1 + β q) e^(−q), q = ρ |k|:
/// w = (ρ/π)/(ρ² + z²) (1 + β (ρ² − z²)/(ρ² + z²)).
fn averaged(space: &WheelPatch, [x, depth]: [f64; 2], spread: Spread) -> [f64; 6] {
    let reach = spread.reach;
    let mut sum = [0.0; 6];
    for (point, weight) in gauss_legendre(200) {
        // z = ρ tan θ makes w dz = (1 + β cos 2θ)/π dθ.
        let angle = PI * point - FRAC_PI_2;
        let share = spread.share * (1.0 + spread.beta * (2.0 * angle).cos()) * weight;
        let stress = space.stress(0.0, [x, reach * angle.tan(), depth], steel().poisson());
        sum.iter_mut().zip(stress).for_each(|(sum, own)| *sum += share * own);
    }
    sum
}

/// A crack of 6 mm at 30 degrees.
fn line() -> CrackLine {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    CrackLine {
        points: vec![Vec2::default(), Vec2::new(6.0 * cos, -6.0 * sin)],
        tips: [false, true],
        width: f64::INFINITY,
    }
}

#[test]
fn averaged_along_the_front() {
    let own = PatchWheel::new(&[PatchLoad::sliding(&ellipse(4.0), [0.0, 2.0], [0.3, 0.0])], &steel());
    let space = WheelPatch::Ellipse(elliptic(4.0, 2.0, 0.0));
    let cracks = own.on_cracks(&[line()]).unwrap();
    for s in [0.7f64, 2.0, 3.3, 5.0, 5.9] {
        let point = line().points[1] * (s / 6.0);
        for xc in [-30.0, -6.0, -2.5, 0.0, 4.0, 9.5] {
            let stress = Arc::clone(&cracks).at(&[PlaceOnCrack { point, crack: 0, s }])(xc)[0];
            let error = off(stress, averaged(&space, [point.x - xc, -point.y], line().spread(s)));
            assert!(error < 2e-3, "s {s}, x_c {xc}: {error:.1e} p0");
        }
    }
    // Next to the mouth, with an edge of the contact over it.
    for s in [0.03f64, 0.1, 0.3] {
        let point = line().points[1] * (s / 6.0);
        for from_edge in [-0.5, -0.1, 0.0, 0.1, 0.5] {
            for edge in [-5.0, 5.0] {
                let xc = point.x - edge - from_edge;
                let stress = Arc::clone(&cracks).at(&[PlaceOnCrack { point, crack: 0, s }])(xc)[0];
                let error = off(stress, averaged(&space, [point.x - xc, -point.y], line().spread(s)));
                assert!(error < 4e-3, "s {s}, x_c {xc}: {error:.1e} p0");
            }
        }
    }
    let over = cracks.over_mouth(0, 1.0);
    let want = -averaged(&space, [-1.0, 1e-4], line().spread(3.0))[2];
    assert!((over - want).abs() < 2e-3 * PEAK, "{over} {want}");
}

#[test]
fn a_patch_given_by_strips_is_the_ellipse() {
    let (a, b) = (5.0, 7.0);
    let strip = |y: f64| {
        let share = (1.0 - (y / b).powi(2)).max(0.0).sqrt();
        let point = |i: usize| {
            let t = -(PI * f64::from(u32::try_from(i).unwrap()) / 160.0).cos();
            let p = PEAK * share * (1.0 - t * t).max(0.0).sqrt();
            StripTraction { x: a * share * t, traction: [p, 0.3 * p, 0.0] }
        };
        (0..=160).map(point).collect::<Vec<_>>()
    };
    let given = PatchWheel::new(&[PatchLoad::sampled([0.0, 1.0], [a, b], strip)], &steel());
    let known = PatchWheel::new(&[PatchLoad::sliding(&ellipse(b), [0.0, 1.0], [0.3, 0.0])], &steel());
    for x in [-9.0, -3.0, 0.0, 4.0] {
        for depth in [0.3, 1.5, 8.0] {
            let [one, other] = [&given, &known].map(|wheel| wheel.stress(Vec2::new(x, -depth), 0.0));
            let error = [one.xx - other.xx, one.yy - other.yy, one.xy - other.xy];
            let error = error.into_iter().map(f64::abs).fold(0.0, f64::max) / PEAK;
            assert!(error < 2e-3, "x {x}, depth {depth}: {error:.1e} p0");
        }
    }
}

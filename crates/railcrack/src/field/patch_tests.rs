//! Checks of a patch on the half-space.

use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use super::{CrackLine, PatchWheel, PlaceOnCrack, Wheel};
use crate::load::HertzEllipse;
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
use std::sync::Arc;

const NU: f64 = 0.3;

#[test]
fn on_the_axis_of_a_circle() {
    let ellipse = HertzEllipse { peak_pressure: 1000.0, along: 5.0, across: 5.0 };
    let patch = PatchDirections::new(&PatchLoad::sliding(&ellipse, [0.0; 2], [0.0; 2]), NU, 1);
    for z in [0.05f64, 0.5, 2.5, 5.0, 20.0, 200.0] {
        let stress = patch.stress(0.0, z, Spread::NONE);
        let t = z / 5.0;
        let normal = -1000.0 / (1.0 + t * t);
        let radial = -1000.0 * ((1.0 + NU) * (1.0 - t * (1.0 / t).atan()) + 0.5 * normal / 1000.0);
        assert!((stress.yy - normal).abs() < 0.02, "{z}: {} {normal}", stress.yy);
        assert!((stress.xx - radial).abs() < 0.02, "{z}: {} {radial}", stress.xx);
    }
}

/// Stresses at 250 places of a crack that kinks by 40°, as they are interpolated and as they are of
/// each place alone.
#[test]
fn many_places_have_the_stresses_of_each() {
    let ellipse = HertzEllipse { peak_pressure: 1000.0, along: 6.0, across: 4.0 };
    let load = PatchLoad::sliding(&ellipse, [0.5, 1.0], [0.3, 0.05]);
    let steel = IsotropicElastic::new(206_000.0, NU).unwrap();
    let at = |s: f64| {
        let (first, second) = (Vec2::new(0.906, -0.423), Vec2::new(0.423, -0.906));
        first * s.min(2.0) + second * (s - 2.0).max(0.0)
    };
    let points = vec![at(0.0), at(2.0), at(4.0)];
    let line = CrackLine { points, tips: [false, true], width: f64::INFINITY };
    let places: Vec<PlaceOnCrack> = (0..250)
        .map(|i| {
            // Denser at both ends.
            let s = 4.0 * (0.0063 * (f64::from(i) + 0.5)).sin().powi(2);
            PlaceOnCrack { point: at(s), crack: 0, s }
        })
        .collect();
    for (wheel, accepted) in [
        (PatchWheel::new(std::slice::from_ref(&load), &steel), 1e-3),
        (PatchWheel::coarse(std::slice::from_ref(&load), &steel), 3e-2),
    ] {
        let stresses = wheel.on_cracks(std::slice::from_ref(&line)).unwrap();
        let all = Arc::clone(&stresses).at(&places);
        let alone: Vec<_> =
            places.iter().map(|place| Arc::clone(&stresses).at(std::slice::from_ref(place))).collect();
        let most = (-400..400).map(|i| 0.03 * f64::from(i)).fold(0.0, |most: f64, xc| {
            let off =
                |a: &Stress, b: Stress| (a.xx - b.xx).abs().max((a.yy - b.yy).abs()).max((a.xy - b.xy).abs());
            all(xc).iter().zip(&alone).map(|(a, alone)| off(a, alone(xc)[0])).fold(most, f64::max)
        });
        assert!(most < accepted * ellipse.peak_pressure, "{most} MPa");
        assert!(most > 0.0, "nothing is interpolated");
    }
}

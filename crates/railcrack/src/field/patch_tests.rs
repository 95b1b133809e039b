//! Checks of a patch on the half-space.

use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use crate::load::HertzEllipse;

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

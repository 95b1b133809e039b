//! Planar cracks in the half-space against closed forms, published fits, an independent package and
//! the 2D engine.

mod contact;
mod fluid;
mod fold;
mod fronts;
mod groups;
mod growth;
mod kernel;
mod patch;
mod several;
mod stiffness;
mod strike;
mod track;
mod uncoupled_gap;
mod vertex;
mod wheel;
mod wide;

use crate::common::steel;
use railcrack::space::{FrontSif, SpaceBody, SpaceCrack, SpaceResolution, Surroundings, Symmetric};

/// The body with `crack`, `cells` from the middle to the sides of its block and as many in its
/// ring.
fn body(crack: &SpaceCrack, surroundings: Surroundings, cells: usize) -> SpaceBody {
    let resolution = SpaceResolution::new(cells, cells);
    SpaceBody::new(std::slice::from_ref(crack), &steel(), surroundings, resolution).unwrap()
}

/// The uniform stress with the tractions `normal`, `dip` and `trace` on a plane of the angle
/// `degrees`.
fn stress(degrees: f64, [normal, dip, trace]: [f64; 3]) -> Symmetric {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (n, s) = ([sin, 0.0, -cos], [cos, 0.0, sin]);
    let traction = [normal * n[0] + dip * s[0], trace, normal * n[2] + dip * s[2]];
    [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
        .map(|(i, j)| n[i] * traction[j] + n[j] * traction[i] - normal * n[i] * n[j])
}

/// K along the front of the open crack under a uniform stress.
fn open_sifs(body: &SpaceBody, stress: Symmetric) -> Vec<FrontSif> {
    body.sifs(&body.nodal_forces(|_| stress))
}

/// A quarter of a full circle of front points by their index: `share` of the front.
fn at(sifs: &[FrontSif], share: f64) -> FrontSif {
    sifs[(share * (sifs.len() - 1) as f64).round() as usize]
}

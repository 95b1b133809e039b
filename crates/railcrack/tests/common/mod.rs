//! Common parts of verification tests: tolerances with a reason, short constructors of bodies and
//! passages, reference tables.

// Each test program uses a part of this.
#![allow(dead_code, unused_imports)]

mod ledger;
mod passage;
mod random;
mod requirements;
mod table;
mod xfem;

pub use ledger::{measured, measured_as, measured_order};
pub use passage::{Rolling, RollingEngine, StepControl};
pub use random::Random;
pub use requirements::REQUIREMENTS;
pub use table::{History, column, histories, rows, table_histories};
pub use xfem::{Meshed, condition, misfit, sifs_under};

use railcrack::body::CrackedBody;
use railcrack::crack::{Crack, CrackEnd, CrackNetwork, End, Junction};
use railcrack::dislocation::{FaceResolution, cracked_body};
use railcrack::material::IsotropicElastic;
use railcrack::math::{Stress, Vec2};

/// The allowed difference of a number from its reference.
#[derive(Debug, Clone, Copy)]
pub enum Tolerance {
    /// As a fraction of the reference.
    Relative(f64),
    /// In the unit of the reference.
    Absolute(f64),
    /// As a fraction of the second number: a peak, a scale.
    Of(f64, f64),
}

pub use Tolerance::{Absolute, Of, Relative};

/// Panics with the measured error unless `got` is as close to `want` as `tolerance` requires, for
/// the given `reason`.
#[track_caller]
pub fn close(got: f64, want: f64, tolerance: Tolerance, reason: &str) {
    let (limit, scale) = match tolerance {
        Relative(share) => (share, want.abs()),
        Absolute(limit) => (limit, 1.0),
        Of(share, scale) => (share, scale),
    };
    let error = (got - want).abs() / scale;
    measured(error, limit, reason);
    assert!(error <= limit, "{got} against {want}: error {error:.3e}, allowed {limit:.1e} ({reason})");
}

/// The steel of all tests; stress intensity factors do not depend on it.
pub fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

/// A straight surface crack: mouth abscissa and length (mm), angle (degrees).
pub fn surface_crack(mouth: f64, length: f64, degrees: f64) -> Crack {
    Crack::surface_breaking(mouth, length, degrees.to_radians()).unwrap()
}

/// A straight buried crack of half-length `half` (mm) about `centre` (mm), walked at `degrees`
/// counter-clockwise from +x.
pub fn buried_crack(centre: Vec2, half: f64, degrees: f64) -> Crack {
    let along = Vec2::unit(degrees.to_radians()) * half;
    Crack::polyline(vec![centre - along, centre + along]).unwrap()
}

/// The body with `cracks`, `elements` along each.
pub fn body(cracks: &[Crack], elements: usize) -> CrackedBody {
    let network = CrackNetwork::new(cracks.to_vec()).unwrap();
    cracked_body(&network, &steel(), FaceResolution { elements }).unwrap()
}

/// A crack through `points` (mm).
pub fn polyline(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

/// The end `end` of crack `crack` joins crack `onto`, counted from 0.
pub fn junction(crack: usize, end: End, onto: usize) -> Junction {
    Junction { joining: CrackEnd { crack, end }, onto }
}

/// The body with `cracks` that meet at `junctions`, `elements` along each crack.
pub fn joined_body(cracks: &[Crack], junctions: &[Junction], elements: usize) -> CrackedBody {
    let network = CrackNetwork::joined(cracks.to_vec(), junctions.to_vec()).unwrap();
    cracked_body(&network, &steel(), FaceResolution { elements }).unwrap()
}

/// K_I and K_II (MPa √mm) per tip of an open body under the stress of the uncracked rail.
pub fn sifs_of(body: &CrackedBody, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
    body.sif_influence.times(&body.faces.nodal_forces(stress))
}

/// K_I and K_II (MPa √mm) per tip of open `cracks` under the stress of the uncracked rail.
pub fn open_sifs(cracks: &[Crack], elements: usize, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
    sifs_of(&body(cracks, elements), stress)
}

/// σ_xx = 1 MPa.
pub const TENSION: Stress = Stress { xx: 1.0, ..Stress::ZERO };

/// Elements along a crack by default.
pub fn default_elements() -> usize {
    FaceResolution::default().elements
}

/// The order of convergence from two errors whose meshes differ by a factor of two.
pub fn order(coarse: f64, fine: f64) -> f64 {
    (coarse.abs() / fine.abs()).log2()
}

/// The largest absolute value.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |m, v| m.max(v.abs()))
}

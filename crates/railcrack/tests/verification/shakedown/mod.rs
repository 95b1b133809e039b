//! The stabilised plastic state of a rolled rail against theory and independent computations, and
//! its consistency.

mod brute_force;
mod direct;
mod in_space;
mod invariance;
mod limits;
mod manufacturing;
mod marching;
mod reference;
mod resolution;

use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{Method, RolledRail, Stabilisation, StabilisedRail, Travel, stabilise};

/// σ_y, MPa, of all tests: k = 288.7 MPa.
pub const YIELD: f64 = 500.0;

/// A rail of σ_y = [`YIELD`] under `peak_pressure` (MPa), a = 6.75 mm, with `friction` and
/// hardening modulus `modulus` (MPa).
pub fn rail(peak_pressure: f64, friction: f64, modulus: f64) -> RolledRail {
    RolledRail {
        steel: IsotropicElastic::new(210e3, 0.3).unwrap(),
        hardening: KinematicHardening::new(YIELD, modulus).unwrap(),
        contact: HertzianContact { peak_pressure, half_width: 6.75, friction }.into(),
        travel: Travel::Forward,
        initial: None,
    }
}

/// The state after repeated passages at default settings.
pub fn stabilised(rail: &RolledRail) -> StabilisedRail {
    stabilise(rail, &Stabilisation::default(), |_| ()).unwrap()
}

/// The same by the direct method.
pub fn direct(rail: &RolledRail) -> StabilisedRail {
    let settings = Stabilisation { method: Method::Direct, ..Stabilisation::default() };
    stabilise(rail, &settings, |_| ()).unwrap()
}

/// The largest |σ_xx| or |σ_zz| of the residual stress, MPa.
pub fn peak(result: &StabilisedRail) -> f64 {
    result.profile.iter().map(|layer| layer.stress.xx.abs().max(layer.stress.zz.abs())).fold(0.0, f64::max)
}

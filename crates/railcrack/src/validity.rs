//! Whether the model still describes a case: checks that make a warning, not an error.

use crate::load::{HertzianContact, TableContact};
use crate::math::MPA_SQRT_MM;
use crate::shakedown::{first_yield_ratio, shakedown_limit_ratio};
use thiserror::Error;

/// A case, or a result, outside of what the model describes.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidityWarning {
    /// Pressure beyond first yield, and no residual stress is given.
    #[error(
        "the peak pressure of {peak_pressure:.0} MPa is beyond first yield at {limit:.0} MPa (friction {friction:.3}, \
         yield stress {yield_stress:.0} MPa), and no residual stress is given: the rail shakes down to a state with one"
    )]
    BeyondFirstYield {
        /// p0, MPa.
        peak_pressure: f64,
        /// p0 at first yield, MPa.
        limit: f64,
        /// Wheel–rail friction.
        friction: f64,
        /// σ_y, MPa.
        yield_stress: f64,
    },
    /// Pressure beyond elastic shakedown.
    #[error(
        "the peak pressure of {peak_pressure:.0} MPa is beyond the limit of elastic shakedown at {limit:.0} MPa \
         (friction {friction:.3}, yield stress {yield_stress:.0} MPa): the rail yields in every passage, and K of an elastic \
         rail does not describe it"
    )]
    BeyondShakedown {
        /// p0, MPa.
        peak_pressure: f64,
        /// p0 at the limit, MPa.
        limit: f64,
        /// Wheel–rail friction.
        friction: f64,
        /// σ_y, MPa.
        yield_stress: f64,
    },
    /// More shear than any friction of wheel and rail gives.
    #[error("the shear is up to {ratio:.2} of the pressure, friction gives {friction:.2} at most")]
    ShearBeyondFriction {
        /// The largest |q|/p.
        ratio: f64,
        /// μ that is allowed.
        friction: f64,
    },
    /// k1 beyond the toughness.
    #[error(
        "k1 reaches {k1:.1} MPa√m, {:.2} of the toughness of {toughness:.1} MPa√m: the rail breaks before it tires", k1 / toughness
    )]
    BeyondToughness {
        /// The largest k1, MPa√m.
        k1: f64,
        /// K_Ic, MPa√m.
        toughness: f64,
    },
    /// A deep crack under bending.
    #[error(
        "a crack is {depth:.1} mm deep, and beyond {limit:.0} mm the rail that bends is more compliant than a half-plane: K under bending \
         is too small"
    )]
    DeepCrackInBending {
        /// Depth of the deepest tip, mm.
        depth: f64,
        /// Depth to which the half-plane serves, mm.
        limit: f64,
    },
    /// A length that looks like metres.
    #[error("the half-width of the contact is {half_width} mm: if {half_width} m is meant, write {} mm", 1e3 * half_width)]
    LengthInMetres {
        /// a, mm.
        half_width: f64,
    },
}

impl ValidityWarning {
    /// A short name that does not change.
    pub fn name(&self) -> &'static str {
        match self {
            Self::BeyondFirstYield { .. } => "beyond-first-yield",
            Self::BeyondShakedown { .. } => "beyond-shakedown",
            Self::ShearBeyondFriction { .. } => "shear-beyond-friction",
            Self::BeyondToughness { .. } => "beyond-toughness",
            Self::DeepCrackInBending { .. } => "deep-crack-in-bending",
            Self::LengthInMetres { .. } => "length-in-metres",
        }
    }
}

/// Whether a residual stress is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResidualStress {
    /// A profile, or a plastic stress.
    Given,
    /// None.
    Absent,
}

/// Depth (mm) to which a half-plane has the compliance of a rail that bends: the depth of the rail
/// head's sides.
pub const BENDING_DEPTH: f64 = 20.0;
/// Half-widths (mm) below which metres are likely: a wheel of 1 kN on a rail has more.
pub const SHORTEST_HALF_WIDTH: f64 = 0.1;

/// Pressure against first yield and the limit of elastic shakedown of the same contact in full
/// sliding; ν = `poisson`, σ_y = `yield_stress` (MPa). With a residual stress only the latter
/// counts.
pub fn pressure(
    contact: &HertzianContact,
    poisson: f64,
    yield_stress: f64,
    residual: ResidualStress,
) -> Option<ValidityWarning> {
    let HertzianContact { peak_pressure, friction, .. } = *contact;
    let shear_yield = yield_stress / 3f64.sqrt();
    let limit = shear_yield * shakedown_limit_ratio(friction, poisson).ratio;
    if peak_pressure > limit {
        return Some(ValidityWarning::BeyondShakedown { peak_pressure, limit, friction, yield_stress });
    }
    let limit = shear_yield * first_yield_ratio(friction, poisson).ratio;
    (peak_pressure > limit && residual == ResidualStress::Absent)
        .then_some(ValidityWarning::BeyondFirstYield { peak_pressure, limit, friction, yield_stress })
}

/// Shear of a table against `friction`.
pub fn shear(table: &TableContact, friction: f64) -> Option<ValidityWarning> {
    let ratio = table.largest_friction();
    (ratio > friction).then_some(ValidityWarning::ShearBeyondFriction { ratio, friction })
}

/// The largest `k1` against the `toughness`, both MPa √mm.
pub fn toughness(k1: f64, toughness: f64) -> Option<ValidityWarning> {
    let [k1, toughness] = [k1, toughness].map(|k| k / MPA_SQRT_MM);
    (k1 > toughness).then_some(ValidityWarning::BeyondToughness { k1, toughness })
}

/// The `depth` (mm) of the deepest tip of a rail that bends.
pub fn depth_in_bending(depth: f64) -> Option<ValidityWarning> {
    (depth > BENDING_DEPTH).then_some(ValidityWarning::DeepCrackInBending { depth, limit: BENDING_DEPTH })
}

/// The half-width of the contact (mm) against metres.
pub fn half_width(half_width: f64) -> Option<ValidityWarning> {
    (half_width < SHORTEST_HALF_WIDTH).then_some(ValidityWarning::LengthInMetres { half_width })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERTZ: HertzianContact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.1 };

    #[test]
    fn pressures_are_compared_with_both_limits() {
        let of = |peak_pressure, residual| {
            pressure(&HertzianContact { peak_pressure, ..HERTZ }, 0.3, 500.0, residual)
                .map(|warning| warning.name())
        };
        // p0/k = 3.063 and 3.987 at friction 0.1: 884 and 1151 MPa.
        assert_eq!(of(880.0, ResidualStress::Absent), None);
        assert_eq!(of(890.0, ResidualStress::Absent), Some("beyond-first-yield"));
        assert_eq!(of(890.0, ResidualStress::Given), None);
        assert_eq!(of(1160.0, ResidualStress::Given), Some("beyond-shakedown"));
        let text = pressure(
            &HertzianContact { peak_pressure: 1600.0, friction: 0.4, ..HERTZ },
            0.3,
            500.0,
            ResidualStress::Absent,
        );
        assert!(
            text.unwrap()
                .to_string()
                .starts_with("the peak pressure of 1600 MPa is beyond the limit of elastic")
        );
    }

    #[test]
    fn other_limits_are_exact() {
        assert_eq!(toughness(29.0 * MPA_SQRT_MM, 29.0 * MPA_SQRT_MM), None);
        assert!(toughness(920.0, 917.0).is_some());
        assert_eq!((depth_in_bending(20.0), half_width(0.1)), (None, None));
        assert_eq!(depth_in_bending(25.0).unwrap().name(), "deep-crack-in-bending");
        let metres = half_width(0.006).unwrap().to_string();
        assert_eq!(metres, "the half-width of the contact is 0.006 mm: if 0.006 m is meant, write 6 mm");
    }
}

//! Temperature of a rail that cannot lengthen.

use crate::material::IsotropicElastic;
use crate::math::OutOfRange;

/// Temperature of a continuously welded rail: σ_xx = E α (T_neutral − T), tension in winter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Temperature {
    /// T, °C.
    pub rail: f64,
    /// T_neutral, at which the rail carries no axial force, °C.
    pub neutral: f64,
    /// α, 1/K.
    pub expansion: f64,
}

impl Temperature {
    /// α of rail steel, 1/K, as common in track engineering (1.15e-5 to 1.2e-5).
    pub const RAIL_STEEL_EXPANSION: f64 = 1.15e-5;

    /// Rejects temperatures that are not finite and an expansion that is not positive.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_finite("temperature of the rail (\u{b0}C)", self.rail)?;
        OutOfRange::unless_finite("neutral temperature (\u{b0}C)", self.neutral)?;
        OutOfRange::unless_positive("thermal expansion (1/K)", self.expansion)
    }

    /// σ_xx (MPa) in a rail of `steel`. A rail is free to contract sideways: σ_zz = 0.
    pub fn stress(&self, steel: &IsotropicElastic) -> f64 {
        steel.young() * self.expansion * (self.neutral - self.rail)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_kelvin_below_neutral() {
        let winter = Temperature { rail: -5.0, neutral: 25.0, expansion: Temperature::RAIL_STEEL_EXPANSION };
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        assert!((winter.stress(&steel) - 72.45).abs() < 1e-12);
        let nowhere = Temperature { rail: f64::NAN, ..winter };
        assert!(nowhere.check().unwrap_err().to_string().contains("must be finite"));
        assert!(Temperature { expansion: 0.0, ..winter }.check().is_err() && winter.check().is_ok());
    }
}

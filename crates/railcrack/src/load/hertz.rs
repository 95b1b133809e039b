//! Hertzian line contact of wheel on rail.

use super::contact_kind::{ContactKind, LineContact};
use crate::material::IsotropicElastic;
use crate::math::OutOfRange;

/// Hertzian line contact in full sliding: pressure p(x) = p0 √(1 − (x − x_c)²/a²), traction on the
/// rail t = (μ_w p, −p).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzianContact {
    /// p0, MPa, positive.
    pub peak_pressure: f64,
    /// a, mm, positive.
    pub half_width: f64,
    /// μ_w, signed: positive drags the rail along +x (a braking wheel).
    pub friction: f64,
}

impl HertzianContact {
    /// The contact of a cylinder: `line_load` P′ in N/mm, radii in mm (an infinite rail radius is a
    /// flat rail), `material` of both bodies, signed `friction`.
    ///
    /// 1/R = 1/R_wheel + 1/R_rail, E* = E / (2 (1 − ν²)), a² = 4 P′ R / (π E*), p0 = 2 P′ / (π a)
    /// (Johnson, Contact Mechanics, 4.43–4.45).
    pub fn from_line_load(
        line_load: f64,
        wheel_radius: f64,
        rail_radius: f64,
        material: &IsotropicElastic,
        friction: f64,
    ) -> Result<Self, OutOfRange> {
        let positive =
            |quantity, value: f64, accepted| OutOfRange::unless(value > 0.0, quantity, value, accepted);
        positive("line load (N/mm)", line_load, "positive")?;
        positive("wheel radius (mm)", wheel_radius, "positive")?;
        positive("rail radius (mm)", rail_radius, "positive, inf for a flat rail")?;
        let curvature = 1.0 / wheel_radius + 1.0 / rail_radius;
        positive("1/R_wheel + 1/R_rail (1/mm)", curvature, "positive")?;
        let modulus = 0.5 * material.plane_strain_modulus();
        let half_width = (4.0 * line_load / (curvature * std::f64::consts::PI * modulus)).sqrt();
        let peak_pressure = 2.0 * line_load / (std::f64::consts::PI * half_width);
        Ok(Self { peak_pressure, half_width, friction })
    }

    /// Rejects a contact without pressure or extent, and numbers that are not finite.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_positive("peak pressure p0 (MPa)", self.peak_pressure)?;
        OutOfRange::unless_positive("half-width a of the contact (mm)", self.half_width)?;
        OutOfRange::unless_finite("wheel\u{2013}rail friction", self.friction)
    }

    /// P′ = π a p0 / 2, N/mm.
    #[must_use]
    pub fn line_load(&self) -> f64 {
        0.5 * std::f64::consts::PI * self.half_width * self.peak_pressure
    }

    /// The mirror image: of a wheel that runs the other way.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { friction: -self.friction, ..*self }
    }
}

impl LineContact for HertzianContact {
    fn kind(&self) -> ContactKind {
        ContactKind::Hertz
    }

    fn checked(&self) -> Result<(), OutOfRange> {
        self.check()
    }

    fn highest_pressure(&self) -> f64 {
        self.peak_pressure
    }

    fn half_extent(&self) -> f64 {
        self.half_width
    }

    fn normal_force(&self) -> f64 {
        self.line_load()
    }

    fn force_ratio(&self) -> f64 {
        self.friction
    }

    fn shear_ratio(&self) -> f64 {
        self.friction.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_load_of_the_reference_case() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let hertz = HertzianContact::from_line_load(8959.4, 460.9, f64::INFINITY, &steel, 0.0).unwrap();
        assert!((hertz.peak_pressure - 845.0).abs() < 0.05, "{hertz:?}");
        assert!((hertz.half_width - 6.75).abs() < 5e-4, "{hertz:?}");
        assert!((hertz.line_load() - 8959.4).abs() < 1e-9);
    }

    #[test]
    fn a_contact_without_extent_is_refused() {
        let contact = HertzianContact { peak_pressure: 845.0, half_width: 0.0, friction: 0.0 };
        let text = "half-width a of the contact (mm) = 0: must be positive and finite";
        assert_eq!(contact.check().unwrap_err().to_string(), text);
        assert!(HertzianContact { half_width: 6.75, ..contact }.check().is_ok());
        assert!(HertzianContact { half_width: 6.75, friction: f64::INFINITY, ..contact }.check().is_err());
        assert!(HertzianContact { half_width: 6.75, peak_pressure: -1.0, ..contact }.check().is_err());
    }
}

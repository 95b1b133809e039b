//! Hertzian contact of wheel on rail, along a line and in an ellipse.

use super::contact_kind::{ContactKind, LineContact};
use crate::material::IsotropicElastic;
use crate::math::{OutOfRange, complete_elliptic};
use std::f64::consts::PI;

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

/// A wheel on a rail head, described by its load and radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelOnRail {
    /// P, N, positive.
    pub wheel_load: f64,
    /// Rolling radius of the wheel, mm, positive.
    pub wheel_radius: f64,
    /// Radius of the rail head across the rail, mm, positive; infinite where it is flat.
    pub rail_head_radius: f64,
    /// Radius of the wheel's profile across the rail, mm; infinite where it is straight, negative
    /// where it is concave.
    pub wheel_profile_radius: f64,
}

/// The contact ellipse of Hertz, x along the rail and z across: p = p0 √(1 − (x/a)² − (z/b)²).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzEllipse {
    /// p0 in the middle, MPa.
    pub peak_pressure: f64,
    /// a, semi-axis along the rail, mm.
    pub along: f64,
    /// b, semi-axis across the rail, mm.
    pub across: f64,
}

impl HertzEllipse {
    /// The ellipse under `wheel`, of wheels and rails of `material`.
    ///
    /// With m ≥ n the semi-axes, k = n/m, e² = 1 − k², K and E the complete elliptic integrals of
    /// modulus e and D = (K − E)/e², the curvatures along the major and the minor axis are
    ///
    /// 1/R_m = (p0/E*) (2 n/m²) D,  1/R_n = (p0/E*) (2 n/m²) (K − D)/k²,
    /// p0 = 3 P/(2π m n),  E* = E/(2 (1 − ν²)):
    ///
    /// their ratio gives k, and the load the size. Source: Johnson, Contact Mechanics, 4.26–4.32.
    ///
    /// Errors: no load, radii that are not positive, a concave profile that does not leave the rail
    /// head.
    pub fn new(wheel: &WheelOnRail, material: &IsotropicElastic) -> Result<Self, OutOfRange> {
        let WheelOnRail { wheel_load, wheel_radius, rail_head_radius, wheel_profile_radius } = *wheel;
        OutOfRange::unless_positive("wheel load (N)", wheel_load)?;
        OutOfRange::unless_positive("wheel radius (mm)", wheel_radius)?;
        let head = "rail head radius (mm)";
        OutOfRange::unless(rail_head_radius > 0.0, head, rail_head_radius, "positive, inf for a flat head")?;
        let profile = "wheel profile radius (mm)";
        let fine = wheel_profile_radius.abs() > 0.0;
        OutOfRange::unless(
            fine,
            profile,
            wheel_profile_radius,
            "other than 0; inf straight, negative concave",
        )?;
        let (along, across) = (1.0 / wheel_radius, 1.0 / rail_head_radius + 1.0 / wheel_profile_radius);
        let relative = "1/R_head + 1/R_profile (1/mm)";
        OutOfRange::unless(
            across > 0.0,
            relative,
            across,
            "positive: a concave profile must be flatter than the head",
        )?;
        // The larger curvature belongs to the shorter axis.
        let (major, minor) = (along.min(across), along.max(across));
        let k = axis_ratio(minor / major);
        let d = shape(k).0;
        let modulus = 0.5 * material.plane_strain_modulus();
        let longer = (3.0 * wheel_load * d / (PI * modulus * major)).cbrt();
        let shorter = k * longer;
        let (along, across) = if along >= across { (shorter, longer) } else { (longer, shorter) };
        Ok(Self { peak_pressure: 1.5 * wheel_load / (PI * longer * shorter), along, across })
    }

    /// P = 2π a b p0/3, N.
    #[must_use]
    pub fn load(&self) -> f64 {
        2.0 / 3.0 * PI * self.along * self.across * self.peak_pressure
    }

    /// a²/2R (mm), by how much wheels and rails of `material` with this contact would part at the
    /// end of a if they did not deform; 1/R is the curvature along the rail of [`Self::new`]. For a
    /// long ellipse it is a p0/E*, that of the line contact.
    pub fn depth_along(&self, material: &IsotropicElastic) -> f64 {
        let (a, b) = (self.along, self.across);
        let (minor, major) = (a.min(b), a.max(b));
        let (d, other) = shape(minor / major);
        let modulus = 0.5 * material.plane_strain_modulus();
        let curvature = 2.0 * self.peak_pressure * minor / (modulus * major * major);
        0.5 * a * a * curvature * if a <= b { other } else { d }
    }

    /// The line contact of the strip at `lateral` (z, mm), in full sliding with signed `friction`:
    /// p0 √(1 − (z/b)²) and a √(1 − (z/b)²).
    ///
    /// Errors: a strip outside the ellipse.
    pub fn strip(&self, lateral: f64, friction: f64) -> Result<HertzianContact, OutOfRange> {
        let within = lateral.abs() < self.across;
        OutOfRange::unless(within, "lateral offset (mm)", lateral, "inside of the contact ellipse")?;
        let share = (1.0 - (lateral / self.across).powi(2)).sqrt();
        Ok(HertzianContact {
            peak_pressure: self.peak_pressure * share,
            half_width: self.along * share,
            friction,
        })
    }
}

/// D and (K − D)/k² of the axis ratio k.
fn shape(k: f64) -> (f64, f64) {
    let integrals = complete_elliptic(k);
    (integrals.d, (integrals.k - integrals.d) / (k * k))
}

/// k for a ratio of the curvatures ≥ 1, by bisection in log k: the ratio falls from infinity to 1
/// as k rises to 1.
fn axis_ratio(curvatures: f64) -> f64 {
    // k ≈ (ratio)^(−2/3) and above its inverse; 60 halvings are round-off.
    let (mut low, mut high) = (-curvatures.ln() - 1.0, 0.0);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        let (d, other) = shape(middle.exp());
        if other / d > curvatures { low = middle } else { high = middle }
    }
    (0.5 * (low + high)).exp()
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

    fn steel() -> IsotropicElastic {
        IsotropicElastic::new(210e3, 0.3).unwrap()
    }

    const WHEEL: WheelOnRail = WheelOnRail {
        wheel_load: 100e3,
        wheel_radius: 460.0,
        rail_head_radius: 300.0,
        wheel_profile_radius: f64::INFINITY,
    };

    #[test]
    fn a_sphere_has_a_circle() {
        // Johnson 4.22 to 4.24: a³ = 3 P R/(4 E*), p0 = (6 P E*²/(π³ R²))^⅓.
        let sphere = WheelOnRail { rail_head_radius: 460.0, ..WHEEL };
        let ellipse = HertzEllipse::new(&sphere, &steel()).unwrap();
        let modulus = 0.5 * steel().plane_strain_modulus();
        let radius = (0.75 * 100e3 * 460.0 / modulus).cbrt();
        let peak = (6.0 * 100e3 * modulus * modulus / (PI.powi(3) * 460.0 * 460.0)).cbrt();
        for (value, want) in
            [(ellipse.along, radius), (ellipse.across, radius), (ellipse.peak_pressure, peak)]
        {
            assert!((value / want - 1.0).abs() < 1e-7, "{ellipse:?}"); // the ratio is flat at a circle
        }
    }

    #[test]
    fn the_curvatures_are_those_of_the_integrals() {
        // 1/R_x = (p0 a b/E*) ∫ dw/((a² + w) √((a² + w)(b² + w) w)) over w > 0 (Johnson 3.64), with
        // w = a² tan² φ: smooth and periodic, so that the midpoint rule is exact to round-off.
        let ellipse = HertzEllipse::new(&WHEEL, &steel()).unwrap();
        let HertzEllipse { peak_pressure, along, across } = ellipse;
        let curvature = |first: f64, second: f64| {
            let of_angle = |i: i32| {
                let phi = 0.005 * PI * (f64::from(i) + 0.5);
                let ratio = second / first;
                phi.cos().powi(2) / (ratio * ratio * phi.cos().powi(2) + phi.sin().powi(2)).sqrt()
            };
            let sum = 0.01 * PI * (0..100).map(of_angle).sum::<f64>() / first.powi(3);
            peak_pressure * along * across / (0.5 * steel().plane_strain_modulus()) * sum
        };
        assert!(
            (curvature(along, across) * 460.0 - 1.0).abs() < 1e-12,
            "{}",
            curvature(along, across) * 460.0
        );
        assert!(
            (curvature(across, along) * 300.0 - 1.0).abs() < 1e-12,
            "{}",
            curvature(across, along) * 300.0
        );
        let HertzEllipse { peak_pressure, along, across } = ellipse;
        let wheel_load = 2.0 / 3.0 * PI * along * across * peak_pressure;
        assert!((wheel_load / 100e3 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_long_ellipse_is_the_line_contact() {
        // Per width P′ = π a p0/2 in the middle; 1/R_head → 0. Terms of order k² ln k are left.
        let flat = WheelOnRail { rail_head_radius: 1e9, ..WHEEL };
        let ellipse = HertzEllipse::new(&flat, &steel()).unwrap();
        let strip = ellipse.strip(0.0, 0.1).unwrap();
        let line =
            HertzianContact::from_line_load(strip.line_load(), 460.0, f64::INFINITY, &steel(), 0.1).unwrap();
        assert!((line.half_width / strip.half_width - 1.0).abs() < 1e-5, "{line:?} {strip:?}");
    }

    #[test]
    fn depths_follow_from_the_radius_along_the_rail() {
        for head in [80.0, 300.0, 460.0, 2000.0] {
            let ellipse =
                HertzEllipse::new(&WheelOnRail { rail_head_radius: head, ..WHEEL }, &steel()).unwrap();
            let depth = ellipse.along * ellipse.along / (2.0 * 460.0);
            assert!((ellipse.depth_along(&steel()) / depth - 1.0).abs() < 1e-6, "{ellipse:?}");
        }
        let line = HertzEllipse { peak_pressure: 900.0, along: 6.0, across: 6e4 };
        let modulus = 0.5 * steel().plane_strain_modulus();
        assert!((line.depth_along(&steel()) * modulus / (900.0 * 6.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn strips_shrink_to_the_end_of_the_ellipse() {
        let ellipse = HertzEllipse::new(&WHEEL, &steel()).unwrap();
        let strip = ellipse.strip(0.6 * ellipse.across, -0.2).unwrap();
        assert!((strip.peak_pressure / ellipse.peak_pressure - 0.8).abs() < 1e-14);
        assert!((strip.half_width / ellipse.along - 0.8).abs() < 1e-14);
        assert!(ellipse.strip(1.01 * ellipse.across, 0.0).unwrap_err().to_string().contains("inside of the"));
    }

    #[test]
    fn a_concave_profile_must_leave_the_head() {
        let concave =
            |radius| HertzEllipse::new(&WheelOnRail { wheel_profile_radius: radius, ..WHEEL }, &steel());
        assert!(concave(-400.0).unwrap().across > HertzEllipse::new(&WHEEL, &steel()).unwrap().across);
        assert!(concave(-300.0).unwrap_err().to_string().contains("flatter than the head"));
        assert!(concave(0.0).is_err() && concave(f64::NAN).is_err());
        let unloaded = WheelOnRail { wheel_load: 0.0, ..WHEEL };
        assert!(
            HertzEllipse::new(&unloaded, &steel()).unwrap_err().to_string().starts_with("wheel load (N) = 0")
        );
    }
}

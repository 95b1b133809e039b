//! Line contact of wheel on rail in partial slip.

use super::contact_kind::{ContactKind, LineContact};
use super::{HertzianContact, Travel};
use crate::math::OutOfRange;
use std::f64::consts::PI;

/// Carter's rolling contact: Hertzian pressure, and a shear that sticks behind the leading edge,
///
/// q = ± μ p0 [√(1 − (u/a)²) − (c/a) √(1 − ((u − d)/c)²)],  c = a √(1 − |ξ|),  |d| = a − c,
///
/// u = x − x_c, the second root only where it is real. The stick zone d ± c touches the leading
/// edge. ξ = Q/(μ P) is signed as the shear on the rail along +x; |ξ| = 1 is full sliding.
///
/// Source: Carter 1926, Proc. R. Soc. A 112, 151–157; Johnson, Contact Mechanics, 8.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarterContact {
    /// p0, MPa, positive.
    pub peak_pressure: f64,
    /// a, mm, positive.
    pub half_width: f64,
    /// μ, wheel–rail friction where the contact slips, not negative.
    pub friction: f64,
    /// ξ, in [−1, 1].
    pub traction: f64,
    /// Direction of travel of the wheel.
    pub travel: Travel,
}

impl CarterContact {
    /// Rejects a contact without pressure or extent, a negative friction, and a traction beyond the
    /// friction limit.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.sliding().check()?;
        let friction = "wheel\u{2013}rail friction";
        OutOfRange::unless(self.friction >= 0.0, friction, self.friction, "zero or more")?;
        let within = self.traction.abs() <= 1.0;
        OutOfRange::unless(within, "traction Q/(\u{3bc} P)", self.traction, "in [-1, 1]")
    }

    /// The contact with the same pressure in full sliding, with the sign of this shear.
    pub fn sliding(&self) -> HertzianContact {
        HertzianContact {
            peak_pressure: self.peak_pressure,
            half_width: self.half_width,
            friction: self.signed_friction(),
        }
    }

    /// ± μ with the sign of the shear; 0 for a wheel that transmits no shear.
    fn signed_friction(&self) -> f64 {
        if self.traction == 0.0 { 0.0 } else { self.friction.copysign(self.traction) }
    }

    /// c, half the width of the stick zone, mm: 0 in full sliding.
    pub fn stick_half_width(&self) -> f64 {
        self.half_width * (1.0 - self.traction.abs()).sqrt()
    }

    /// d, the centre of the stick zone relative to that of the contact, mm.
    pub(crate) fn stick_centre(&self) -> f64 {
        (self.half_width - self.stick_half_width()) * self.travel.sign()
    }

    /// p at u = `from_centre` (mm), MPa.
    pub fn pressure(&self, from_centre: f64) -> f64 {
        self.peak_pressure * half_ellipse(from_centre / self.half_width)
    }

    /// q at u = `from_centre` (mm), MPa, along +x on the rail.
    pub fn shear(&self, from_centre: f64) -> f64 {
        let (a, c) = (self.half_width, self.stick_half_width());
        let stuck = if c > 0.0 { c / a * half_ellipse((from_centre - self.stick_centre()) / c) } else { 0.0 };
        self.signed_friction() * self.peak_pressure * (half_ellipse(from_centre / a) - stuck)
    }

    /// P′ = π a p0 / 2, N/mm.
    pub fn line_load(&self) -> f64 {
        0.5 * PI * self.half_width * self.peak_pressure
    }

    /// ∫ u q du, N: that of the half-ellipse which the stick zone takes off.
    pub(crate) fn shear_moment(&self) -> f64 {
        let c = self.stick_half_width();
        let taken = 0.5 * PI * self.signed_friction() * self.peak_pressure * c * c / self.half_width;
        -taken * self.stick_centre()
    }

    /// The creepage (μ a/R) (1 − √(1 − |ξ|)), without sign; R (mm) = `radius` of
    /// 1/R = 1/R_wheel + 1/R_rail.
    pub fn creepage(&self, radius: f64) -> f64 {
        self.friction * self.half_width / radius * (1.0 - (1.0 - self.traction.abs()).sqrt())
    }

    /// Abscissae from the centre of the contact at which pressure or shear are not smooth, mm,
    /// increasing.
    pub(crate) fn edges(&self) -> Vec<f64> {
        let a = self.half_width;
        let slip_begins = (a - 2.0 * self.stick_half_width()) * self.travel.sign();
        let partial = self.traction != 0.0 && self.traction.abs() < 1.0 && self.friction > 0.0;
        if partial { vec![-a, slip_begins, a] } else { vec![-a, a] }
    }

    /// The mirror image: of a wheel that runs the other way.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { traction: -self.traction, travel: self.travel.opposite(), ..*self }
    }
}

fn half_ellipse(x: f64) -> f64 {
    ((1.0 - x) * (1.0 + x)).max(0.0).sqrt()
}

impl LineContact for CarterContact {
    fn kind(&self) -> ContactKind {
        ContactKind::Carter
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
        self.traction * self.friction
    }

    fn shear_ratio(&self) -> f64 {
        if self.traction == 0.0 { 0.0 } else { self.friction }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gauss_legendre;

    const CARTER: CarterContact = CarterContact {
        peak_pressure: 845.0,
        half_width: 6.75,
        friction: 0.3,
        traction: -0.5,
        travel: Travel::Forward,
    };

    #[test]
    fn shear_load_is_traction_times_friction_times_load() {
        // Each half-ellipse by Gauss points in the angle: exact but for round-off.
        const TOLERANCE: f64 = 1e-13;
        for traction in [-1.0, -0.5, 0.0, 0.1, 0.9, 1.0] {
            for travel in [Travel::Forward, Travel::Backward] {
                let contact = CarterContact { traction, travel, ..CARTER };
                let mut cuts = contact.edges();
                cuts.dedup();
                let mut load = 0.0;
                for piece in cuts.windows(2) {
                    let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
                    for (t, weight) in gauss_legendre(60) {
                        let angle = PI * t;
                        load += contact.shear(middle - half * angle.cos()) * half * angle.sin() * PI * weight;
                    }
                }
                let want = traction * 0.3 * contact.line_load();
                assert!((load - want).abs() < TOLERANCE * contact.line_load() * 1e3, "{load}");
            }
        }
    }

    #[test]
    fn the_stick_zone_touches_the_leading_edge() {
        let (c, d) = (CARTER.stick_half_width(), CARTER.stick_centre());
        assert!((c - 6.75 * 0.5_f64.sqrt()).abs() < 1e-14);
        assert!((d + c - 6.75).abs() < 1e-14); // round-off
        let back = CarterContact { travel: Travel::Backward, ..CARTER };
        assert!((back.stick_centre() - back.stick_half_width() + 6.75).abs() < 1e-14);
        for u in [-6.0, -2.0, 1.0, 5.0, 6.7] {
            assert!((CARTER.shear(u) - back.shear(-u)).abs() < 1e-10, "mirrored at {u}");
            assert!(CARTER.shear(u).abs() <= 0.3 * CARTER.pressure(u) + 1e-12);
        }
        // In the slip zone the shear equals the friction limit.
        assert!((CARTER.shear(-5.0) + 0.3 * CARTER.pressure(-5.0)).abs() < 1e-12);
    }

    #[test]
    fn creepage_grows_with_the_traction_to_that_of_sliding() {
        let at = |traction| CarterContact { traction, ..CARTER }.creepage(460.0);
        assert_eq!(at(0.0), 0.0);
        assert!((at(1.0) - 0.3 * 6.75 / 460.0).abs() < 1e-15);
        assert!((at(-0.75) - 0.5 * at(1.0)).abs() < 1e-15);
    }

    #[test]
    fn refuses_more_than_sliding_and_friction_with_a_sign() {
        let message = |contact: CarterContact| contact.check().unwrap_err().to_string();
        assert!(message(CarterContact { traction: 1.2, ..CARTER }).contains("= 1.2: must be in [-1, 1]"));
        assert!(message(CarterContact { traction: f64::NAN, ..CARTER }).contains("in [-1, 1]"));
        assert!(message(CarterContact { friction: -0.3, ..CARTER }).contains("= -0.3: must be zero or more"));
        assert!(CARTER.check().is_ok());
    }
}

//! Limits of the shear along one strip.

use super::RollingPatch;

/// Limits of the shear along the strip at y, u from its middle: μp of Hertz, and the parabola of
/// the same normal force.
#[derive(Debug, Clone, Copy)]
pub(super) struct StripBound {
    /// Half the length of the strip, mm.
    pub half_length: f64,
    along: f64,
    /// μ p0, MPa.
    limit: f64,
}

/// Peak of the parabola over that of the ellipse, at equal normal force.
const PARABOLIC_PEAK: f64 = 4.0 / 3.0;

impl StripBound {
    pub fn of(patch: &RollingPatch, y: f64) -> Self {
        Self {
            half_length: patch.half_length(y),
            along: patch.ellipse.along,
            limit: patch.friction * patch.ellipse.peak_pressure,
        }
    }

    /// μp at `x`, MPa.
    pub fn elliptic(&self, x: f64) -> f64 {
        self.limit * self.square(x).max(0.0).sqrt()
    }

    /// The parabola at `x`, MPa.
    pub fn parabolic(&self, x: f64) -> f64 {
        PARABOLIC_PEAK * self.limit * self.square(x).max(0.0)
    }

    /// 1 − (x/a)² − (y/b)².
    fn square(&self, x: f64) -> f64 {
        (self.half_length - x) * (self.half_length + x) / (self.along * self.along)
    }
}

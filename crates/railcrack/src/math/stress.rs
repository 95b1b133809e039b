//! The plane-strain stress tensor.

use super::Vec2;
use std::ops::{Add, Mul, Sub};

/// Stress in plane strain, MPa, tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress {
    /// Along the rail.
    pub xx: f64,
    /// Vertical.
    pub yy: f64,
    /// Out of plane.
    pub zz: f64,
    /// Shear.
    pub xy: f64,
}

impl Stress {
    /// This stress in components along x and y, given its components in axes of which the first
    /// lies along the unit vector `first`.
    pub fn rotated(self, first: Vec2) -> Self {
        let (c, s) = (first.x, first.y);
        let shear = 2.0 * c * s * self.xy;
        Self {
            xx: c * c * self.xx + s * s * self.yy - shear,
            yy: s * s * self.xx + c * c * self.yy + shear,
            zz: self.zz,
            xy: c * s * (self.xx - self.yy) + (c * c - s * s) * self.xy,
        }
    }

    /// The unstressed state.
    pub const ZERO: Self = Self { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0 };

    /// The traction σ·n on the surface with unit normal `normal`.
    pub fn traction(self, normal: Vec2) -> Vec2 {
        Vec2::new(self.xx * normal.x + self.xy * normal.y, self.xy * normal.x + self.yy * normal.y)
    }

    /// σ:σ, MPa².
    pub fn squared(self) -> f64 {
        self.xx * self.xx + self.yy * self.yy + self.zz * self.zz + 2.0 * self.xy * self.xy
    }

    /// The deviator s in coordinates whose Euclidean norm is its Frobenius norm √(s:s), MPa:
    /// ((s_xx − s_yy)/√2, √(3/2) s_zz, √2 s_xy). √J2 is their norm over √2.
    pub fn deviator(self) -> [f64; 3] {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let zz = (2.0 * self.zz - self.xx - self.yy) / 3.0;
        [(self.xx - self.yy) / ROOT_2, 1.5_f64.sqrt() * zz, ROOT_2 * self.xy]
    }
}

impl Add for Stress {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { xx: self.xx + o.xx, yy: self.yy + o.yy, zz: self.zz + o.zz, xy: self.xy + o.xy }
    }
}

impl Sub for Stress {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + o * -1.0
    }
}

impl Mul<f64> for Stress {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { xx: self.xx * s, yy: self.yy * s, zz: self.zz * s, xy: self.xy * s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviator_keeps_the_frobenius_norm() {
        let s = Stress { xx: 3.0, yy: -1.0, zz: 4.0, xy: 2.0 };
        // Mean 2: s = diag(1, −3, 2), s_xy = 2, s:s = 1 + 9 + 4 + 2 · 4.
        let norm: f64 = s.deviator().iter().map(|c| c * c).sum();
        assert!((norm - 22.0).abs() < 1e-13); // round-off
        let pressure = Stress { xx: -5.0, yy: -5.0, zz: -5.0, xy: 0.0 };
        assert_eq!(pressure.deviator(), [0.0; 3]);
    }
}

//! Points, vectors and stresses of the plane, extents, ranges and units.

use serde::{Deserialize, Serialize};
use std::ops::{Add, Mul, Neg, Sub};
use thiserror::Error;

/// A point (mm) or a vector of the plane; y points up, the rail is y ≤ 0.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Vec2 {
    /// Along the running surface.
    pub x: f64,
    /// Upwards.
    pub y: f64,
}

impl Vec2 {
    /// The vector (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The unit vector at `angle` (radians, counter-clockwise from +x).
    pub fn unit(angle: f64) -> Self {
        Self::new(angle.cos(), angle.sin())
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The out-of-plane component of the vector product; positive when `other` lies
    /// counter-clockwise.
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Euclidean length.
    pub fn length(self) -> f64 {
        self.x.hypot(self.y)
    }

    /// This vector rotated by +90°; it turns x1 into x2.
    pub fn left(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// The angle from +x, in (−π, π].
    pub fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }

    /// This vector divided by its length. A zero vector gives NaN.
    pub fn normalised(self) -> Self {
        self * (1.0 / self.length())
    }
}

impl Add for Vec2 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y)
    }
}

impl Sub for Vec2 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y)
    }
}

impl Neg for Vec2 {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Mul<f64> for Vec2 {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self::new(self.x * s, self.y * s)
    }
}

/// The scalar product in space.
pub(crate) fn dot3(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

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

/// A rectangle below y = 0 that represents a rail or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailBox {
    /// Width, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
    /// Abscissa of its centre, mm.
    pub centre: f64,
}

/// The rail of the paper: 300 mm by 172 mm around x = 0.
impl Default for RailBox {
    fn default() -> Self {
        Self { width: 300.0, depth: 172.0, centre: 0.0 }
    }
}

impl RailBox {
    /// Abscissae of its two ends, mm.
    #[must_use]
    pub fn ends(self) -> (f64, f64) {
        (self.centre - 0.5 * self.width, self.centre + 0.5 * self.width)
    }
}

/// A quantity outside its admissible range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{quantity} = {value}: must be {accepted}")]
pub struct OutOfRange {
    /// Which quantity, with its unit.
    pub quantity: &'static str,
    /// The given value.
    pub value: f64,
    /// The accepted values.
    pub accepted: &'static str,
}

impl OutOfRange {
    /// Rejects a `value` that is not positive and finite.
    pub(crate) fn unless_positive(quantity: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value > 0.0 && value.is_finite(), quantity, value, "positive and finite")
    }

    /// Rejects a `value` that is not finite.
    pub(crate) fn unless_finite(quantity: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value.is_finite(), quantity, value, "finite")
    }

    /// Rejects `value` unless `fine` holds.
    pub(crate) fn unless(
        fine: bool,
        quantity: &'static str,
        value: f64,
        accepted: &'static str,
    ) -> Result<(), Self> {
        if fine { Ok(()) } else { Err(Self { quantity, value, accepted }) }
    }
}

/// √1000: MPa √mm in one MPa √m.
pub const MPA_SQRT_MM: f64 = 31.622_776_601_683_793;

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

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
    /// The unstressed state.
    pub const ZERO: Self = Self { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0 };

    /// The traction σ·n on the surface with unit normal `normal`.
    pub fn traction(self, normal: Vec2) -> Vec2 {
        Vec2::new(self.xx * normal.x + self.xy * normal.y, self.xy * normal.x + self.yy * normal.y)
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

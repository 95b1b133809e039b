//! Symmetric tensors in space.

use std::ops::{Add, Mul, Sub};

/// A stress (MPa, tension positive) or a strain (tensor shear) in space: x along the rail, y across
/// it, z down.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tensor {
    /// Along the rail.
    pub xx: f64,
    /// Across the rail.
    pub yy: f64,
    /// Vertical.
    pub zz: f64,
    /// Shear of the cross-section.
    pub yz: f64,
    /// Shear of vertical planes along the rail.
    pub xz: f64,
    /// Shear of horizontal planes.
    pub xy: f64,
}

const ROOT_2: f64 = std::f64::consts::SQRT_2;

impl Tensor {
    /// No stress or strain.
    pub const ZERO: Self = Self { xx: 0.0, yy: 0.0, zz: 0.0, yz: 0.0, xz: 0.0, xy: 0.0 };

    /// The tensor with the entries xx, yy, zz, yz, xz, xy.
    #[must_use]
    pub const fn of([xx, yy, zz, yz, xz, xy]: [f64; 6]) -> Self {
        Self { xx, yy, zz, yz, xz, xy }
    }

    /// The entries xx, yy, zz, yz, xz, xy.
    #[must_use]
    pub const fn entries(self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.yz, self.xz, self.xy]
    }

    /// Coordinates of the deviator, whose Euclidean norm is its Frobenius norm: ((t_xx − t_zz)/√2,
    /// √(3/2) of the deviator's yy, √2 t_xz, √2 t_xy, √2 t_yz). The first three are those of the
    /// plane y = 0.
    #[must_use]
    pub fn deviator(self) -> [f64; 5] {
        [
            (self.xx - self.zz) / ROOT_2,
            (2.0 * self.yy - self.xx - self.zz) / 6.0_f64.sqrt(),
            ROOT_2 * self.xz,
            ROOT_2 * self.xy,
            ROOT_2 * self.yz,
        ]
    }

    /// The deviator with these coordinates.
    #[must_use]
    pub fn from_deviator([difference, across, xz, xy, yz]: [f64; 5]) -> Self {
        let yy = (2.0 / 3.0_f64).sqrt() * across;
        Self {
            xx: 0.5 * (ROOT_2 * difference - yy),
            yy,
            zz: 0.5 * (-ROOT_2 * difference - yy),
            yz: yz / ROOT_2,
            xz: xz / ROOT_2,
            xy: xy / ROOT_2,
        }
    }

    /// √(2/3) |e| of a plastic strain e: the equivalent plastic strain of a proportional path.
    #[must_use]
    pub fn equivalent(self) -> f64 {
        (2.0 / 3.0 * self.deviator().iter().map(|d| d * d).sum::<f64>()).sqrt()
    }

    /// A third of the trace.
    #[must_use]
    pub fn mean(self) -> f64 {
        (self.xx + self.yy + self.zz) / 3.0
    }

    /// The largest magnitude of an entry.
    #[must_use]
    pub fn largest(self) -> f64 {
        self.entries().iter().fold(0.0, |most, entry| entry.abs().max(most))
    }

    /// The mirror image in the plane x = 0.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { xz: -self.xz, xy: -self.xy, ..self }
    }

    /// The mirror image in the plane y = 0.
    #[must_use]
    pub fn across(self) -> Self {
        Self { yz: -self.yz, xy: -self.xy, ..self }
    }

    /// Half the difference of the extreme principal values.
    #[must_use]
    pub fn largest_shear(self) -> f64 {
        let mean = self.mean();
        let [xx, yy, zz] = [self.xx - mean, self.yy - mean, self.zz - mean];
        let Self { yz, xz, xy, .. } = self;
        let second = 0.5 * (xx * xx + yy * yy + zz * zz) + yz * yz + xz * xz + xy * xy;
        let third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        let radius = (second / 3.0).sqrt();
        if radius == 0.0 {
            return 0.0;
        }
        // Lode: principal values 2 r cos(φ + 2π n/3), cos 3φ = J3 / (2 r³), 0 ≤ φ ≤ π/3.
        let cosine = (third / (2.0 * radius * radius * radius)).clamp(-1.0, 1.0);
        let angle = cosine.acos() / 3.0;
        3.0_f64.sqrt() * radius * (angle + std::f64::consts::FRAC_PI_3).sin()
    }
}

impl Add for Tensor {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.entries(), other.entries());
        Self::of(std::array::from_fn(|c| a[c] + b[c]))
    }
}

impl Sub for Tensor {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Tensor {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::of(self.entries().map(|entry| entry * factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Round-off.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn deviator_coordinates_are_inverted() {
        let tensor = Tensor { xx: 1.0, yy: -3.0, zz: 0.5, yz: 0.7, xz: -0.2, xy: 1.1 };
        let trace = Tensor { xx: 1.0, yy: 1.0, zz: 1.0, ..Tensor::ZERO } * tensor.mean();
        let back = Tensor::from_deviator(tensor.deviator()) + trace - tensor;
        assert!(back.largest() < ROUNDING, "{back:?}");
    }

    /// Uniaxial tension, pure shear and a tensor with known principal values.
    #[test]
    fn largest_shears() {
        for axis in 0..3 {
            let mut entries = [4.0; 6];
            entries[3..].fill(0.0);
            entries[axis] = 10.0;
            assert!((Tensor::of(entries).largest_shear() - 3.0).abs() < ROUNDING);
            let mut shear = [0.0; 6];
            shear[3 + axis] = -2.5;
            assert!((Tensor::of(shear).largest_shear() - 2.5).abs() < ROUNDING);
        }
        // 1, 2 and 5 turned by 30° about z, then seen with z exchanged for x.
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let (xx, yy, xy) = (cos * cos + 5.0 * sin * sin, sin * sin + 5.0 * cos * cos, 4.0 * sin * cos);
        let turned = Tensor { zz: xx, yy, yz: xy, xx: 2.0, xz: 0.0, xy: 0.0 };
        assert!((turned.largest_shear() - 2.0).abs() < ROUNDING);
    }
}

//! Plastic strain tensors.

/// A plastic strain: deviatoric, with tensor shear.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticStrain {
    /// Along the rail.
    pub xx: f64,
    /// Vertical.
    pub yy: f64,
    /// Out of plane.
    pub zz: f64,
    /// Shear, the tensor component.
    pub xy: f64,
}

impl PlasticStrain {
    /// The strain with the coordinates of [`crate::math::Stress::deviator`], whose Euclidean norm
    /// is the Frobenius norm: ((ε_xx − ε_yy)/√2, √(3/2) ε_zz, √2 ε_xy).
    pub(crate) fn from_deviator([difference, out, shear]: [f64; 3]) -> Self {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let zz = (2.0 / 3.0_f64).sqrt() * out;
        Self {
            xx: 0.5 * (ROOT_2 * difference - zz),
            yy: 0.5 * (-ROOT_2 * difference - zz),
            zz,
            xy: shear / ROOT_2,
        }
    }

    /// The coordinates of [`PlasticStrain::from_deviator`].
    pub(crate) fn deviator(self) -> [f64; 3] {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        [(self.xx - self.yy) / ROOT_2, 1.5_f64.sqrt() * self.zz, ROOT_2 * self.xy]
    }

    /// √(2/3) |ε_p|: the equivalent plastic strain of a proportional path.
    pub fn equivalent(self) -> f64 {
        let d = self.deviator();
        (2.0 / 3.0 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviator_coordinates_are_inverted() {
        let strain = PlasticStrain { xx: 1e-3, yy: -3e-3, zz: 2e-3, xy: 5e-4 };
        let back = PlasticStrain::from_deviator(strain.deviator());
        for (a, b) in [(strain.xx, back.xx), (strain.yy, back.yy), (strain.zz, back.zz), (strain.xy, back.xy)]
        {
            assert!((a - b).abs() < 1e-17, "{back:?}"); // round-off
        }
        // Simple tension: the equivalent strain is the axial one.
        let tension = PlasticStrain { xx: 2e-3, yy: -1e-3, zz: -1e-3, xy: 0.0 };
        assert!((tension.equivalent() - 2e-3).abs() < 1e-17);
    }
}

//! A patch in rolling contact.

use super::{Creepage, KalkerCoefficients, RollingTheory, StripOutline};
use crate::load::HertzEllipse;
use crate::material::IsotropicElastic;
use crate::math::OutOfRange;
use std::f64::consts::PI;
use thiserror::Error;

/// A Hertz ellipse, or a patch that is compared with one, on which a wheel rolls with creepage. x
/// runs with the travel, y across; tractions and forces act on the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingPatch {
    /// Pressure and semi-axes: a along the rail, b across. With an outline, p0 and a are those of
    /// the longest strip, and b gives the normal force; Kalker's coefficients are those of a/b.
    pub ellipse: HertzEllipse,
    /// Lengths of the strips where the patch is no ellipse; their pressure is p0/a √(a_y² − x²).
    pub outline: Option<StripOutline>,
    /// μ, not negative.
    pub friction: f64,
    /// ξ, η, φ.
    pub creepage: Creepage,
    /// Elasticity of wheel and rail.
    pub steel: IsotropicElastic,
    /// The theory of the shear.
    pub theory: RollingTheory,
}

/// A patch that cannot roll as described.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PatchError {
    /// A number out of range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// Creepage without friction.
    #[error(
        "friction = 0 with creepage: creepage without friction gives no force; friction must be positive"
    )]
    NoFriction,
    /// More force than friction allows.
    #[error(
        "the linear theory gives {ratio:.3} times the friction force: it holds for small creepage only; \
         use theory = \"fastrip\" or \"fastsim\""
    )]
    Saturated {
        /// |F|/(μN).
        ratio: f64,
    },
}

/// Flexibilities of the simplified theory, mm³/N.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flexibilities {
    pub l1: f64,
    pub l2: f64,
    pub l3: f64,
}

impl RollingPatch {
    /// Rejects a patch without extent or pressure, a negative friction, creepage without friction,
    /// and with the linear theory more force than friction allows.
    pub fn check(&self) -> Result<(), PatchError> {
        OutOfRange::unless_positive("peak pressure p0 (MPa)", self.ellipse.peak_pressure)?;
        OutOfRange::unless_positive("semi-axis a of the patch (mm)", self.ellipse.along)?;
        OutOfRange::unless_positive("semi-axis b of the patch (mm)", self.ellipse.across)?;
        let fine = self.friction >= 0.0 && self.friction.is_finite();
        OutOfRange::unless(fine, "wheel\u{2013}rail friction", self.friction, "zero or more")?;
        self.creepage.check()?;
        if self.friction == 0.0 && !self.creepage.is_none() {
            return Err(PatchError::NoFriction);
        }
        if self.theory == RollingTheory::Linear && !self.creepage.is_none() {
            let [along, across] = self.linear_force();
            let ratio = along.hypot(across) / (self.friction * self.normal_force());
            if ratio > 1.0 {
                return Err(PatchError::Saturated { ratio });
            }
        }
        Ok(())
    }

    /// N = 2π a b p0/3, N.
    #[must_use]
    pub fn normal_force(&self) -> f64 {
        self.ellipse.load()
    }

    /// Kalker's coefficients of the ellipse.
    #[must_use]
    pub fn coefficients(&self) -> KalkerCoefficients {
        KalkerCoefficients::of(self.ellipse.along / self.ellipse.across, self.steel.poisson())
    }

    /// F_x and F_y (N) of the linear theory: −G c² C11 ξ and −G c² (C22 η + c C23 φ), c² = a b.
    #[must_use]
    pub fn linear_force(&self) -> [f64; 2] {
        let KalkerCoefficients { c11, c22, c23 } = self.coefficients();
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let area = self.ellipse.along * self.ellipse.across;
        let stiffness = self.steel.shear_modulus() * area;
        [-stiffness * c11 * longitudinal, -stiffness * (c22 * lateral + area.sqrt() * c23 * spin)]
    }

    /// The mirror image across the rail: of the other rail under the same vehicle.
    #[must_use]
    pub fn mirrored_across(&self) -> Self {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let outline = self.outline.map(|own| {
            let [from, to] = own.ends();
            StripOutline::new([-to, -from], |y| own.half_length(-y))
        });
        Self { creepage: Creepage { longitudinal, lateral: -lateral, spin: -spin }, outline, ..*self }
    }

    /// y of the ends of the patch, mm.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.outline.map_or([-self.ellipse.across, self.ellipse.across], |outline| outline.ends())
    }

    /// a_y = a √(1 − (y/b)²), or that of the outline, mm: half the length of the strip at `y` (mm);
    /// 0 outside.
    #[must_use]
    pub fn half_length(&self, y: f64) -> f64 {
        if let Some(outline) = &self.outline {
            return outline.half_length(y);
        }
        let t = y / self.ellipse.across;
        self.ellipse.along * ((1.0 - t) * (1.0 + t)).max(0.0).sqrt()
    }

    /// L1 = 8a/(3GC11), L2 = 8a/(3GC22), L3 = πa√(a/b)/(4GC23) (Kalker 1982).
    pub(super) fn flexibilities(&self) -> Flexibilities {
        let KalkerCoefficients { c11, c22, c23 } = self.coefficients();
        let (a, b, shear) = (self.ellipse.along, self.ellipse.across, self.steel.shear_modulus());
        let l3 = PI * a * (a / b).sqrt() / (4.0 * shear * c23);
        Flexibilities { l1: 8.0 * a / (3.0 * shear * c11), l2: 8.0 * a / (3.0 * shear * c22), l3 }
    }
}

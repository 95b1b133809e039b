//! FASTSIM: Kalker's simplified theory of rolling contact.

use super::bound::StripBound;
use super::patch::Flexibilities;
use super::{Creepage, RollingPatch};

/// The shear of a strip, followed from its leading edge backwards.
///
/// Displacements are proportional to the shear at the same point, u = L q. Where wheel and rail
/// stick, dq_x/dx = ξ/L1 − φ y/L3 and dq_y/dx = η/L2 + φ x/L3. Where |q| would exceed the limit
/// they slip, and q keeps its direction at the limit, μ times the parabola 2N/(πab)(1 − (x/a)² −
/// (y/b)²).
///
/// Source: Kalker 1982, Vehicle System Dynamics 11, 1–13.
#[derive(Debug, Clone, Copy)]
pub(super) struct FastsimStrip {
    creepage: Creepage,
    flexibilities: Flexibilities,
    y: f64,
    /// q_x, q_y, MPa.
    pub shear: [f64; 2],
    /// Whether wheel and rail slip.
    pub slips: bool,
}

impl FastsimStrip {
    /// The leading edge of the strip at `y` (mm), without shear.
    pub fn entering(patch: &RollingPatch, y: f64) -> Self {
        Self {
            creepage: patch.creepage,
            flexibilities: patch.flexibilities(),
            y,
            shear: [0.0; 2],
            slips: false,
        }
    }

    /// A step of the length `step` (mm) to `x`, over which the spin acts at `at`.
    pub fn advance(&mut self, x: f64, at: f64, step: f64, bound: &StripBound) {
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let Flexibilities { l1, l2, l3 } = self.flexibilities;
        let shear = [
            self.shear[0] - step * (longitudinal / l1 - spin * self.y / l3),
            self.shear[1] - step * (lateral / l2 + spin * at / l3),
        ];
        let (size, limit) = (shear[0].hypot(shear[1]), bound.parabolic(x));
        self.slips = size > limit;
        self.shear = if self.slips { shear.map(|q| q * limit / size) } else { shear };
    }

    /// The unit vector along the shear; that against the rigid slip where there is none.
    pub fn direction(&self, x: f64) -> [f64; 2] {
        let unit = |[x, y]: [f64; 2]| {
            let size = x.hypot(y);
            if size > 0.0 { [x / size, y / size] } else { [0.0; 2] }
        };
        if self.shear != [0.0; 2] {
            return unit(self.shear);
        }
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        unit([spin * self.y - longitudinal, -lateral - spin * x])
    }
}

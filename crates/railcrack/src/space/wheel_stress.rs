//! The stress of the uncracked rail under a wheel.

use super::bilinear::WheelPatch;
use super::nuclei::Symmetric;
use super::wheel::EllipticWheel;

/// Stress of the uncracked rail under a wheel. Any function of the position and the point is one.
pub trait WheelStress: Sync {
    /// The stress (MPa) with the wheel at an abscissa (mm), at x, lateral and depth (mm).
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric;

    /// The contact of which it is the stress, if that is all: along the rail it may then be
    /// interpolated, with nothing singular but the edge of this ellipse.
    fn contact(&self) -> Option<&EllipticWheel> {
        None
    }
}

impl<F: Fn(f64, [f64; 3]) -> Symmetric + Sync> WheelStress for F {
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric {
        self(position, point)
    }
}

/// The contact of a wheel on a rail with this Poisson's ratio.
#[derive(Debug, Clone, Copy)]
pub struct PatchOnRail<'a> {
    /// The contact.
    pub patch: &'a WheelPatch,
    /// ν.
    pub poisson: f64,
}

impl WheelStress for PatchOnRail<'_> {
    fn stress(&self, position: f64, point: [f64; 3]) -> Symmetric {
        self.patch.stress(position, point, self.poisson)
    }

    fn contact(&self) -> Option<&EllipticWheel> {
        match self.patch {
            WheelPatch::Ellipse(wheel) => Some(wheel),
            WheelPatch::Bilinear(_) | WheelPatch::Several(_) => None,
        }
    }
}

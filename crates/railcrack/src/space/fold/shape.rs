//! Shape of a crack with a fold.

use super::super::plane::PlaneFrame;
use super::super::shape::{ShapeError, SpaceCrack};
use crate::growth::FrontDeviation;
use thiserror::Error;

/// A crack of two planes that meet in a straight fold parallel to the mouth: a rectangular strip
/// descends from the mouth to the fold, and the branch below it is half an ellipse about the middle
/// of the fold. The strike is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldedCrack {
    /// Angle between the strip, followed downwards, and +x, radians.
    pub mouth_dip: f64,
    /// The same for the branch.
    pub branch_dip: f64,
    /// Distance of the fold from the mouth along the strip, mm.
    pub fold: f64,
    /// Half the length of the mouth and of the fold, and semi-axis of the branch, mm.
    pub half_length: f64,
    /// Semi-axis of the branch down its dip, mm.
    pub branch: f64,
    /// x and lateral position of the middle of the mouth, mm.
    pub middle: [f64; 2],
    /// Deviation of the front of the branch from its ellipse; none for an ellipse.
    pub deviation: Option<FrontDeviation>,
}

/// An inadmissible folded crack.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FoldError {
    /// A length that is not positive and finite.
    #[error("{name} {value} mm of a folded crack: must be positive and finite")]
    Length {
        /// The measured length.
        name: &'static str,
        /// The given value, mm.
        value: f64,
    },
    /// A dip outside the admissible range.
    #[error("dip of {degrees}° of a plane of a folded crack: must lie between 5° and 175°")]
    Dip {
        /// The given value, degrees.
        degrees: f64,
    },
    /// Two planes whose angle is outside the admissible range.
    #[error("fold of {degrees}° of a crack: must lie between −90° and 90°")]
    Fold {
        /// The given value, degrees.
        degrees: f64,
    },
}

impl FoldedCrack {
    /// Returns the crack if it is admissible.
    ///
    /// Errors: a length that is not positive; a dip below 5° or above 175°; a fold of more than
    /// 90°.
    pub fn checked(self) -> Result<Self, FoldError> {
        let lengths =
            [("distance of the fold", self.fold), ("half-length", self.half_length), ("branch", self.branch)];
        for (name, value) in lengths {
            if !(value > 0.0 && value.is_finite()) {
                return Err(FoldError::Length { name, value });
            }
        }
        for dip in [self.mouth_dip, self.branch_dip] {
            let degrees = dip.to_degrees();
            if !(5.0 - 1e-9..=175.0 + 1e-9).contains(&degrees) {
                return Err(FoldError::Dip { degrees });
            }
        }
        let degrees = (self.branch_dip - self.mouth_dip).to_degrees();
        if degrees.abs() > 90.0 + 1e-9 {
            return Err(FoldError::Fold { degrees });
        }
        Ok(self)
    }

    /// The branch as half an ellipse, or with the front that it has become, about the middle of the
    /// trace of its plane.
    pub(super) fn branch_shape(&self) -> Result<SpaceCrack, ShapeError> {
        let ellipse = SpaceCrack::surface_breaking(self.branch_dip, self.half_length, self.branch)?;
        let deviation = self.deviation.map_or_else(Vec::new, |own| own.coefficients(false));
        SpaceCrack { deviation, ..ellipse }.checked()
    }

    /// The planes of the strip and of the branch.
    #[must_use]
    pub fn planes(&self) -> [PlaneFrame; 2] {
        [self.mouth_dip, self.branch_dip].map(PlaneFrame::new)
    }

    /// x, lateral and depth (mm) of the point at the distance s from the mouth, measured over the
    /// fold, and at ζ along it.
    #[must_use]
    pub fn position(&self, point: [f64; 2]) -> [f64; 3] {
        self.place(&self.planes(), point)
    }

    /// [`Self::position`] with the planes of the crack at hand.
    pub(super) fn place(&self, [strip, branch]: &[PlaneFrame; 2], [s, zeta]: [f64; 2]) -> [f64; 3] {
        let s = s.max(0.0);
        let above = strip.position(s.min(self.fold), zeta);
        let below = branch.position((s - self.fold).max(0.0), 0.0);
        let [x, lateral] = self.middle;
        [x + above[0] + below[0], lateral + above[1] + below[1], above[2] + below[2]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CRACK: FoldedCrack = FoldedCrack {
        mouth_dip: 0.4,
        branch_dip: 1.2,
        fold: 4.0,
        half_length: 6.0,
        branch: 3.0,
        middle: [1.0, -2.0],
        deviation: None,
    };

    #[test]
    fn positions_on_both_planes() {
        let [x, lateral, depth] = CRACK.position([5.5, 0.7]);
        assert!((x - 1.0 - 4.0 * 0.4f64.cos() - 1.5 * 1.2f64.cos()).abs() < 1e-14);
        assert!((lateral + 1.3).abs() < 1e-14);
        assert!((depth - 4.0 * 0.4f64.sin() - 1.5 * 1.2f64.sin()).abs() < 1e-14);
    }

    #[test]
    fn inadmissible_cracks() {
        assert!(CRACK.checked().is_ok());
        let none = FoldedCrack { fold: 0.0, ..CRACK }.checked().unwrap_err();
        assert!(none.to_string().starts_with("distance of the fold 0 mm"), "{none}");
        let flat = FoldedCrack { mouth_dip: 0.05, ..CRACK }.checked().unwrap_err();
        assert!(matches!(flat, FoldError::Dip { .. }), "{flat}");
        let sharp = FoldedCrack { branch_dip: 2.1, ..CRACK }.checked().unwrap_err();
        assert!(matches!(sharp, FoldError::Fold { .. }), "{sharp}");
    }
}

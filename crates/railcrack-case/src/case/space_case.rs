//! The parts of a case that only the engine in space knows, and its size.

use railcrack::growth::FrontShape;
use railcrack::space::{FoldedResolution, SpaceResolution};

/// The parts of a case that only the engine in space knows.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceCase {
    /// The cracks at the beginning, in the order of those of the case.
    pub shapes: Vec<FrontShape>,
    /// Weight of mode III in the range of Hourlier and Pineau, where it is given.
    pub mode_3_weight: Option<f64>,
}

/// Maximum number of face points: three unknowns at each make dense matrices of 300 MB.
pub(super) const MOST_SPACE_POINTS: usize = 2000;

impl SpaceCase {
    /// Points of the faces of all cracks of this resolution.
    #[must_use]
    pub fn face_points(&self, resolution: SpaceResolution) -> usize {
        let of = |shape: &FrontShape| {
            shape.division(resolution).face_points() + points_of_strip(shape, resolution)[0]
        };
        self.shapes.iter().map(of).sum()
    }

    /// Points of all fronts.
    #[must_use]
    pub fn front_points(&self, resolution: SpaceResolution) -> usize {
        let of = |shape: &FrontShape| {
            shape.division(resolution).front_points() + points_of_strip(shape, resolution)[1]
        };
        self.shapes.iter().map(of).sum()
    }
}

/// Points of the faces and of the front that the strip of a folded crack adds to those of its
/// branch.
fn points_of_strip(shape: &FrontShape, resolution: SpaceResolution) -> [usize; 2] {
    shape.strip.map_or([0; 2], |_| FoldedResolution::below(resolution).points_of_strip())
}

//! The parts of a case that only the engine in space knows, and its size.

use railcrack::growth::FrontShape;
use railcrack::space::{FoldedResolution, SpaceResolution, WheelPatch};

/// The parts of a case that only the engine in space knows.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceCase {
    /// The cracks at the beginning, in the order of those of the case.
    pub shapes: Vec<FrontShape>,
    /// The wheels, of a mix in its order.
    pub wheels: Vec<WheelPatch>,
    /// Weight of mode III in the range of Hourlier and Pineau, where it is given.
    pub mode_3_weight: Option<f64>,
}

/// Maximum number of face points: three unknowns at each make dense matrices of 300 MB.
pub(super) const MOST_SPACE_POINTS: usize = 2000;

impl SpaceCase {
    /// Points of the faces of all cracks of this resolution.
    pub(super) fn face_points(&self, resolution: SpaceResolution) -> usize {
        let of_strip = |shape: &FrontShape| points_of_strip(shape, resolution)[0];
        self.shapes
            .iter()
            .map(|shape| face_points(resolution, shape.buried.is_some()) + of_strip(shape))
            .sum()
    }

    /// Points of all fronts.
    pub(super) fn front_points(&self, resolution: SpaceResolution) -> usize {
        let of_strip = |shape: &FrontShape| points_of_strip(shape, resolution)[1];
        self.shapes
            .iter()
            .map(|shape| front_points(resolution, shape.buried.is_some()) + of_strip(shape))
            .sum()
    }
}

/// Points of the faces and of the front that the strip of a folded crack adds to those of its
/// branch.
fn points_of_strip(shape: &FrontShape, resolution: SpaceResolution) -> [usize; 2] {
    shape.strip.map_or([0; 2], |_| FoldedResolution::below(resolution).points_of_strip())
}

/// Points of the faces of a crack.
fn face_points(resolution: SpaceResolution, is_buried: bool) -> usize {
    let SpaceResolution { block, ring } = resolution;
    let rows = ring.saturating_sub(1);
    if is_buried {
        (2 * block + 1).pow(2) + 8 * block * rows
    } else {
        (2 * block + 1) * (block + 1) + (4 * block + 1) * rows
    }
}

/// Points of its front.
fn front_points(resolution: SpaceResolution, is_buried: bool) -> usize {
    if is_buried { 8 * resolution.block } else { 4 * resolution.block + 1 }
}

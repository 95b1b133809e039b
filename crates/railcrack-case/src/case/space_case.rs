//! The parts of a case that only the engine in space knows, and its size.

use crate::tables::PlasticSource;
use railcrack::growth::FrontShape;
use railcrack::space::{CellDivision, FoldedResolution, SpaceResolution};

/// The parts of a case that only the engine in space knows.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceCase {
    /// The cracks at the beginning, in the order of those of the case.
    pub shapes: Vec<FrontShape>,
    /// Cells of each crack.
    pub resolution: SpaceResolution,
    /// Weight of mode III in the range of Hourlier and Pineau, where it is given.
    pub mode_3_weight: Option<f64>,
    /// Plastic stress: that of the rolled rail, where the case asks for it.
    pub plastic_stress: Option<PlasticSource>,
}

impl SpaceCase {
    /// Points of the faces of all cracks.
    #[must_use]
    pub fn face_points(&self) -> usize {
        let of = |(division, strip): (CellDivision, [usize; 2])| division.face_points() + strip[0];
        self.divisions().zip(self.points_of_strips()).map(of).sum()
    }

    /// Points of all fronts.
    #[must_use]
    pub fn front_points(&self) -> usize {
        let of = |(division, strip): (CellDivision, [usize; 2])| division.front_points() + strip[1];
        self.divisions().zip(self.points_of_strips()).map(of).sum()
    }

    /// The cells of each crack; of a folded one those of its branch.
    pub fn divisions(&self) -> impl Iterator<Item = CellDivision> {
        self.shapes.iter().map(|shape| shape.division(self.resolution))
    }

    /// Points of the faces and of the front that the strip of a folded crack adds to those of its
    /// branch.
    fn points_of_strips(&self) -> impl Iterator<Item = [usize; 2]> {
        let strip = FoldedResolution::below(self.resolution).points_of_strip();
        self.shapes.iter().map(move |shape| shape.strip.map_or([0; 2], |_| strip))
    }
}

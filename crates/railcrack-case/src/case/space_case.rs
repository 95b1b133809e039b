//! The parts of a case that only the engine in space knows, and its size.

use crate::tables::PlasticSource;
use railcrack::growth::FrontShape;
use railcrack::space::{CellDivision, SpaceResolution};

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
        self.divisions().map(|division| division.face_points()).sum()
    }

    /// Points of all fronts.
    #[must_use]
    pub fn front_points(&self) -> usize {
        self.divisions().map(|division| division.front_points()).sum()
    }

    /// The cells of each crack.
    pub fn divisions(&self) -> impl Iterator<Item = CellDivision> {
        self.shapes.iter().map(|shape| shape.division(self.resolution))
    }
}

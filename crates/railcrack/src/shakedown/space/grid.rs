//! Columns, rows and layers of a rail in space.

use super::super::fourier::Layers;
use super::rail::Symmetry;
use std::ops::Range;

/// Extent of the strain across the rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Across {
    /// It is confined to the active rows of an endlessly wide rail.
    Confined,
    /// It repeats with the period of the rows.
    #[cfg_attr(not(test), expect(dead_code, reason = "loads that do not vary across, against the plane"))]
    Periodic,
}

/// One of the places of a strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Image {
    Own,
    Mirrored,
}

/// Columns along the rail, rows across it and layers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpaceGrid {
    /// Number of columns, a power of two.
    pub columns: usize,
    /// Their distance, mm.
    pub spacing: f64,
    /// Number of rows in a lateral period, a power of two.
    pub rows: usize,
    /// Their distance, mm.
    pub row_spacing: f64,
    /// Lateral place of the middle row, rows/2, mm.
    pub middle: f64,
    /// The rows that may yield; of a state that is its own mirror image, those on one side and the
    /// one in the middle.
    pub active: Range<usize>,
    pub layers: Layers,
    pub across: Across,
    pub symmetry: Symmetry,
}

impl SpaceGrid {
    /// Number of streamlines: the layers of all active rows.
    pub(super) fn streamlines(&self) -> usize {
        self.active.len() * self.layers.count()
    }

    /// Abscissa of column `i` from the centre of the contact, mm.
    pub(super) fn abscissa(&self, i: usize) -> f64 {
        (i as f64 - 0.5 * self.columns as f64) * self.spacing
    }

    /// Lateral place of row `row`, mm.
    pub(super) fn lateral(&self, row: usize) -> f64 {
        self.middle + (row as f64 - 0.5 * self.rows as f64) * self.row_spacing
    }

    /// The places of the strain of an active row: its row and that of its mirror image.
    pub(super) fn images(&self, row: usize) -> impl Iterator<Item = (usize, Image)> + use<> {
        let mirrored = self.rows - row;
        let is_other = self.symmetry == Symmetry::Mirrored && mirrored != row && mirrored < self.rows;
        let other = is_other.then_some((mirrored, Image::Mirrored));
        std::iter::once((row, Image::Own)).chain(other)
    }

    /// Period along the rail, mm.
    pub(super) fn length(&self) -> f64 {
        self.columns as f64 * self.spacing
    }

    /// Period across the rail, mm.
    pub(super) fn width(&self) -> f64 {
        self.rows as f64 * self.row_spacing
    }
}

//! Errors of a plastic stress given on a mesh.

use thiserror::Error;

/// An invalid plastic stress.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlasticFieldError {
    /// No array with the required name.
    #[error(
        "no array `{wanted}` on points or cells (there: {there}): it holds the plastic stress 2 G eps_p in MPa, 6 components XX, YY, \
         ZZ, XY, YZ, XZ or the first 4 of them"
    )]
    NoArray {
        /// Its name.
        wanted: &'static str,
        /// The arrays present.
        there: String,
    },
    /// An array that does not hold a stress.
    #[error("{reason}")]
    Array {
        /// The fault.
        reason: String,
    },
    /// No triangles or quadrilaterals.
    #[error("no triangles and no quadrilaterals: the plastic stress must be given on a mesh")]
    NoCells,
    /// A cell of an unsupported type.
    #[error("cell {cell} (from 0) is {found}: triangles and quadrilaterals are read, straight or quadratic")]
    Cell {
        /// Its number, from 0.
        cell: usize,
        /// The type found.
        found: String,
    },
    /// A cell that is folded, or has no area.
    #[error("cell {cell} (from 0) at ({x}, {y}) mm is folded or has no area")]
    Folded {
        /// Its number among triangles and quadrilaterals, from 0.
        cell: usize,
        /// Abscissa of its first node, mm.
        x: f64,
        /// Ordinate of its first node, mm.
        y: f64,
    },
    /// Cells on top of one another.
    #[error(
        "the {cells} cells lie on top of one another: together they have {filled:.3e} mm^2, in an extent of {extent:.3e} mm^2"
    )]
    Overlap {
        /// Number of triangles and quadrilaterals.
        cells: usize,
        /// Area of all of them together, mm².
        filled: f64,
        /// Area of the rectangle around the mesh, mm².
        extent: f64,
    },
    /// A mesh outside the rail.
    #[error(
        "the mesh reaches from y = {from} to {to} mm: the rail lies at y <= 0, with its running surface at y = 0"
    )]
    NotInRail {
        /// Smallest ordinate, mm.
        from: f64,
        /// Largest ordinate, mm.
        to: f64,
    },
    /// An implausibly large stress.
    #[error("{largest} MPa exceeds {limit} MPa, the largest plausible plastic stress of steel")]
    TooLarge {
        /// Largest component, MPa.
        largest: f64,
        /// The largest accepted value, MPa.
        limit: f64,
    },
}

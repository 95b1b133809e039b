//! The field of a cracked body on cells around its cracks.

use crate::field::Wheel;
use crate::math::{Stress, Vec2};

/// Cells around the cracks. No cell crosses a crack: cells on the two sides of a crack have
/// separate points at the same positions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FieldGrid {
    /// Points, mm.
    pub points: Vec<Vec2>,
    /// Where the stress of each point is evaluated, mm: at the point itself, or slightly inside the
    /// cell where the stress at the point is infinite.
    pub inside: Vec<Vec2>,
    /// Quadratic rectangles: corners counter-clockwise, then the midpoints of the sides, the first
    /// between the first two corners.
    pub quads: Vec<[usize; 8]>,
    /// Triangles, counter-clockwise.
    pub triangles: Vec<[usize; 3]>,
    /// Pieces of the crack faces, each on one side.
    pub lines: Vec<FieldLine>,
}

/// A straight piece of a crack face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldLine {
    /// The face that it belongs to.
    pub face: Face,
    /// Points at its ends, along the curve.
    pub ends: [usize; 2],
    /// For each end, face points of the body and their weights in the traction at that end.
    pub tractions: [[(usize, f64); 2]; 2],
}

/// A face of a crack; x2 points from − to +.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// The face on the x2 side.
    Plus,
    /// The face on the opposite side.
    Minus,
}

/// The load for which the field of a body is computed.
#[derive(Clone, Copy)]
pub struct FieldLoad<'a> {
    /// Nodal forces on the + faces, N/mm, 2p.
    pub forces: &'a [f64],
    /// The wheel whose field the ends of the rail cancel, and its position x_c (mm).
    pub wheel: Option<(&'a dyn Wheel, f64)>,
}

/// A field at the points of a [`FieldGrid`].
#[derive(Debug, Clone, PartialEq)]
pub struct PointField {
    /// Displacement at each point, mm.
    pub displacement: Vec<Vec2>,
    /// Stress at each point, MPa.
    pub stress: Vec<Stress>,
}

/// The fields of a body under several loads.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFields {
    /// The points and cells on which they are given.
    pub grid: FieldGrid,
    /// One field per load.
    pub loads: Vec<PointField>,
}

//! Ends, tips and junctions of cracks.

use super::{Crack, End};
use crate::math::Vec2;
use serde::{Deserialize, Serialize};

/// One end of one crack of a network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrackEnd {
    /// Index of the crack in the network, from 0.
    pub crack: usize,
    /// The end of that crack.
    pub end: End,
}

/// A tip: which crack of the network (from 0) and which of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrackTip {
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Index among the ends of the crack that lie below the surface, from 0; ends that have joined
    /// a crack count.
    pub tip: usize,
    /// The end of the crack.
    pub end: End,
}

impl CrackTip {
    /// The crack end at which the tip lies.
    pub(crate) fn crack_end(self) -> CrackEnd {
        CrackEnd { crack: self.crack, end: self.end }
    }
}

/// Kinds of crack end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EndKind {
    /// A tip in the steel, with a singular stress ahead; it may grow.
    Tip,
    /// A mouth at the running surface.
    Mouth,
    /// An end that lies on another crack.
    Junction,
}

/// An end of a crack that lies on another crack. It coincides with a vertex of the receiving crack,
/// bit for bit, so that later growth of either crack does not move the junction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Junction {
    /// The end that lies on the other crack.
    pub joining: CrackEnd,
    /// Index of the receiving crack in the network, from 0.
    pub onto: usize,
}

/// A point at which cracks of a network meet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JunctionPoint {
    /// Position, mm.
    pub position: Vec2,
    /// All crack ends at this point, in order of crack and end.
    pub ends: Vec<CrackEnd>,
    /// The crack that passes through the point; none where only ends meet.
    pub through: Option<Passing>,
}

/// A crack that passes through a junction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passing {
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Index of the junction among its points, from 0; segment `vertex` − 1 ends there and segment
    /// `vertex` begins.
    pub vertex: usize,
    /// Arc length from the crack's first point, mm: it changes when the first end of a buried crack
    /// grows.
    pub s: f64,
}

impl JunctionPoint {
    /// The first crack end at `position`.
    pub(super) fn at(position: Vec2) -> Self {
        Self { position, ends: Vec::new(), through: None }
    }

    /// Whether `crack` is at this point.
    pub(crate) fn holds(&self, crack: usize) -> bool {
        self.ends.iter().any(|end| end.crack == crack)
            || self.through.is_some_and(|passing| passing.crack == crack)
    }
}

impl Crack {
    /// Index of the vertex that equals `point` bit for bit, if there is one.
    pub fn vertex_at(&self, point: Vec2) -> Option<usize> {
        self.points().iter().position(|&p| p == point)
    }
}

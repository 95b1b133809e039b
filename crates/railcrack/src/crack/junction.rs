//! Ends, tips and junctions of cracks.

use super::{Crack, End};
use crate::math::Vec2;
use serde::{Deserialize, Serialize};

/// One end of one crack of a network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrackEnd {
    /// Index of the crack in the network, from 0.
    pub crack: usize,
    /// Which end of it.
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
    /// Which end of the crack it is.
    pub end: End,
}

impl CrackTip {
    /// The end of the crack that it is.
    pub(crate) fn crack_end(self) -> CrackEnd {
        CrackEnd { crack: self.crack, end: self.end }
    }
}

/// Kinds of crack ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EndKind {
    /// It ends in the steel: a singular stress ahead, and it may grow.
    Tip,
    /// It breaks the running surface.
    Mouth,
    /// It meets another crack.
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
    /// Where, mm.
    pub position: Vec2,
    /// The ends that lie there, in order of crack and end. No other end does.
    pub ends: Vec<CrackEnd>,
    /// The crack that goes on through the point; none where ends meet ends only.
    pub through: Option<Passing>,
}

/// A crack at a junction that is not at one of its ends.
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
    /// An end that lies at `position`.
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
    /// Index of the vertex at `point`, bit for bit; none where there is none.
    pub fn vertex_at(&self, point: Vec2) -> Option<usize> {
        self.points().iter().position(|&p| p == point)
    }
}

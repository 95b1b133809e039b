//! Crack curves: arc length, and the square-root parameter of the tips.

use super::{Crack, End};
use crate::math::Vec2;

/// The curve of a crack, parametrised by g so that a jump that vanishes like √r at a tip is linear
/// in g. At a mouth and at a junction the jump does not vanish; where neither end is a tip, g is
/// the arc length.
///
/// Crack of length L with a tip at the last point only: s = L − g², g from −√L to 0. Tip at the
/// first point only: s = g², g from 0 to √L. Tips at both: s = L sin²(g/2), g from 0 to π. No tip:
/// s = g.
#[derive(Debug, Clone)]
pub struct CrackCurve {
    points: Vec<Vec2>,
    tangents: Vec<Vec2>,
    /// Arc length from the first point, for each point.
    from_first: Vec<f64>,
    /// Arc length from the last point, for each point: exact near the tip.
    from_last: Vec<f64>,
    surface_breaking: bool,
    tips: Tips,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tips {
    None,
    First,
    Last,
    Both,
}

impl CrackCurve {
    /// The curve of `crack`, which meets no other crack: every end below the surface is a tip.
    pub fn new(crack: &Crack) -> Self {
        Self::with_tips(crack, &crack.tips())
    }

    /// The curve of `crack`, whose tips are the ends `tips`.
    pub(crate) fn with_tips(crack: &Crack, tips: &[End]) -> Self {
        let points = crack.points().to_vec();
        let lengths: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).length()).collect();
        let tangents = points.windows(2).map(|p| (p[1] - p[0]).normalised()).collect();
        let mut from_first = vec![0.0];
        for length in &lengths {
            from_first.push(from_first[from_first.len() - 1] + length);
        }
        let mut from_last = vec![0.0];
        for length in lengths.iter().rev() {
            from_last.push(from_last[from_last.len() - 1] + length);
        }
        from_last.reverse();
        let tips = match (tips.contains(&End::First), tips.contains(&End::Last)) {
            (false, false) => Tips::None,
            (true, false) => Tips::First,
            (false, true) => Tips::Last,
            (true, true) => Tips::Both,
        };
        Self { points, tangents, from_first, from_last, surface_breaking: crack.is_surface_breaking(), tips }
    }

    /// Whether the first point is a mouth.
    pub(crate) fn is_surface_breaking(&self) -> bool {
        self.surface_breaking
    }

    /// Whether `end` is a tip.
    pub(crate) fn has_tip(&self, end: End) -> bool {
        match end {
            End::First => matches!(self.tips, Tips::First | Tips::Both),
            End::Last => matches!(self.tips, Tips::Last | Tips::Both),
        }
    }

    /// Its points, mm.
    pub(crate) fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// The first point, mm.
    pub(crate) fn first_point(&self) -> Vec2 {
        self.points[0]
    }

    /// The last point, mm.
    pub(crate) fn last_point(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    /// Length, mm.
    pub(crate) fn length(&self) -> f64 {
        self.from_last[0]
    }

    /// The range of g.
    pub fn range(&self) -> (f64, f64) {
        match self.tips {
            Tips::None => (0.0, self.length()),
            Tips::First => (0.0, self.length().sqrt()),
            Tips::Last => (-self.length().sqrt(), 0.0),
            Tips::Both => (0.0, std::f64::consts::PI),
        }
    }

    /// dg/d√r at a tip.
    pub(crate) fn root_slope(&self) -> f64 {
        if self.tips == Tips::Both { 2.0 / self.length().sqrt() } else { 1.0 }
    }

    /// Arc length (mm) from the first point.
    pub(crate) fn s(&self, g: f64) -> f64 {
        match self.tips {
            Tips::None => g,
            Tips::First => g * g,
            Tips::Last => self.length() - g * g,
            Tips::Both => self.length() * (0.5 * g).sin().powi(2),
        }
    }

    /// ds/dg, not negative.
    pub(crate) fn ds(&self, g: f64) -> f64 {
        match self.tips {
            Tips::None => 1.0,
            Tips::First => 2.0 * g,
            Tips::Last => -2.0 * g,
            Tips::Both => 0.5 * self.length() * g.sin(),
        }
    }

    /// The parameter at arc length `s` from the first point.
    pub fn g(&self, s: f64) -> f64 {
        match self.tips {
            Tips::None => s,
            Tips::First => s.max(0.0).sqrt(),
            Tips::Last => -(self.length() - s).max(0.0).sqrt(),
            Tips::Both => 2.0 * (s / self.length()).clamp(0.0, 1.0).sqrt().asin(),
        }
    }

    /// Unit vector along segment `segment`.
    pub(crate) fn tangent(&self, segment: usize) -> Vec2 {
        self.tangents[segment]
    }

    /// The parameter at every vertex, both ends included.
    pub(crate) fn vertices(&self) -> Vec<f64> {
        let (start, end) = self.range();
        let n = self.points.len();
        (0..n)
            .map(|i| match i {
                0 => start,
                i if i == n - 1 => end,
                i if self.tips == Tips::Last => -self.from_last[i].sqrt(),
                i => self.g(self.from_first[i]),
            })
            .collect()
    }

    /// The point at `g`, which lies on `segment`.
    pub(crate) fn position(&self, segment: usize, g: f64) -> Vec2 {
        let tangent = self.tangents[segment];
        let ahead = |s: f64| self.points[segment] + tangent * (s - self.from_first[segment]);
        let back = |r: f64| self.points[segment + 1] - tangent * (r - self.from_last[segment + 1]);
        match self.tips {
            Tips::Last => back(g * g),
            Tips::Both if g >= 0.5 * std::f64::consts::PI => back(self.length() * (0.5 * g).cos().powi(2)),
            Tips::None | Tips::First | Tips::Both => ahead(self.s(g)),
        }
    }

    /// The segment on which g lies.
    pub(crate) fn segment_at(&self, g: f64, vertices: &[f64]) -> usize {
        vertices[1..vertices.len() - 1].partition_point(|&v| v < g)
    }

    /// Number of straight segments.
    pub(crate) fn segments(&self) -> usize {
        self.tangents.len()
    }

    /// Arc length (mm) from the first point to point `i` of the crack.
    pub(crate) fn arc_length_at(&self, i: usize) -> f64 {
        self.from_first[i]
    }

    /// The angle (radians, 0 to π) by which the curve turns at point `i`, which is not an end.
    pub(crate) fn turn(&self, i: usize) -> f64 {
        let (before, after) = (self.tangents[i - 1], self.tangents[i]);
        let angle = before.cross(after).asin().abs();
        if before.dot(after) < 0.0 { std::f64::consts::PI - angle } else { angle }
    }
}

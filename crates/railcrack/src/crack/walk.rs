//! The walk along one crack: arc length, and the square-root parameter of its tips.

use super::Crack;
use crate::math::Vec2;

/// A crack walked in the parameter g in which a jump that vanishes like √r at a tip is linear.
///
/// Surface crack of length L: s = L − g², g from −√L at the mouth to 0 at the tip. Buried crack: s = L sin²(g/2), g
/// from 0 at the first tip to π at the last.
#[derive(Debug, Clone)]
pub struct Walk {
    points: Vec<Vec2>,
    tangents: Vec<Vec2>,
    /// Arc length from the first point, for each point.
    from_first: Vec<f64>,
    /// Arc length from the last point, for each point: exact near the tip.
    from_last: Vec<f64>,
    surface_breaking: bool,
}

impl Walk {
    /// The walk along `crack`.
    pub fn new(crack: &Crack) -> Self {
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
        Self { points, tangents, from_first, from_last, surface_breaking: crack.is_surface_breaking() }
    }

    /// Whether the first point is a mouth.
    pub fn is_surface_breaking(&self) -> bool {
        self.surface_breaking
    }

    /// The first point, mm.
    pub fn first_point(&self) -> Vec2 {
        self.points[0]
    }

    /// Length, mm.
    pub fn length(&self) -> f64 {
        self.from_last[0]
    }

    /// The range of g.
    pub fn range(&self) -> (f64, f64) {
        if self.surface_breaking { (-self.length().sqrt(), 0.0) } else { (0.0, std::f64::consts::PI) }
    }

    /// dg/d√r at a tip.
    pub fn root_slope(&self) -> f64 {
        if self.surface_breaking { 1.0 } else { 2.0 / self.length().sqrt() }
    }

    /// Arc length (mm) from the first point.
    pub fn s(&self, g: f64) -> f64 {
        if self.surface_breaking { self.length() - g * g } else { self.length() * (0.5 * g).sin().powi(2) }
    }

    /// ds/dg, not negative.
    pub fn ds(&self, g: f64) -> f64 {
        if self.surface_breaking { -2.0 * g } else { 0.5 * self.length() * g.sin() }
    }

    /// The parameter at arc length `s` from the first point.
    pub fn g(&self, s: f64) -> f64 {
        if self.surface_breaking {
            -(self.length() - s).max(0.0).sqrt()
        } else {
            2.0 * (s / self.length()).clamp(0.0, 1.0).sqrt().asin()
        }
    }

    /// Unit vector along segment `segment`.
    pub fn tangent(&self, segment: usize) -> Vec2 {
        self.tangents[segment]
    }

    /// The parameter at the start of each segment, and at the end of the last.
    pub fn vertices(&self) -> Vec<f64> {
        let (start, end) = self.range();
        let n = self.points.len();
        (0..n)
            .map(|i| match i {
                0 => start,
                i if i == n - 1 => end,
                i if self.surface_breaking => -self.from_last[i].sqrt(),
                i => self.g(self.from_first[i]),
            })
            .collect()
    }

    /// The point at `g`, which lies on `segment`.
    pub fn position(&self, segment: usize, g: f64) -> Vec2 {
        let tangent = self.tangents[segment];
        if self.surface_breaking {
            self.points[segment + 1] - tangent * (g * g - self.from_last[segment + 1])
        } else if g < 0.5 * std::f64::consts::PI {
            self.points[segment] + tangent * (self.s(g) - self.from_first[segment])
        } else {
            let r = self.length() * (0.5 * g).cos().powi(2);
            self.points[segment + 1] - tangent * (r - self.from_last[segment + 1])
        }
    }

    /// The segment on which g lies.
    pub fn segment_at(&self, g: f64, vertices: &[f64]) -> usize {
        vertices[1..vertices.len() - 1].partition_point(|&v| v < g)
    }

    /// Number of straight segments.
    pub fn segments(&self) -> usize {
        self.tangents.len()
    }

    /// Arc length (mm) from the first point to point `i` of the crack.
    pub fn from_first(&self, i: usize) -> f64 {
        self.from_first[i]
    }

    /// The angle (radians, 0 to π) by which the walk turns at point `i`, not an end.
    pub fn turn(&self, i: usize) -> f64 {
        let (before, after) = (self.tangents[i - 1], self.tangents[i]);
        let angle = before.cross(after).asin().abs();
        if before.dot(after) < 0.0 { std::f64::consts::PI - angle } else { angle }
    }
}

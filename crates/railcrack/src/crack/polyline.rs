//! Polyline cracks, from a mouth to a tip or between two buried tips.

use crate::math::{Orientation, Vec2, orientation, segments_touch};
use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Points that do not define a crack.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CrackError {
    /// A coordinate that is not a finite number.
    #[error("point {index}: ({x}, {y}) mm must be finite")]
    NotFinite {
        /// Index of the point, from 1.
        index: usize,
        /// Abscissa, mm.
        x: f64,
        /// Ordinate, mm.
        y: f64,
    },
    /// Fewer than two points.
    #[error("a crack needs at least two points, {count} given")]
    TooFewPoints {
        /// How many were given.
        count: usize,
    },
    /// A point outside the rail.
    #[error(
        "point {index}: y = {y} mm lies {where_}; every point after the first must have y < 0, the first y <= 0"
    )]
    OutsideRail {
        /// Index of the point, from 1.
        index: usize,
        /// Ordinate, mm.
        y: f64,
        /// On or above the surface.
        where_: &'static str,
    },
    /// Two equal consecutive points.
    #[error("points {index} and {next} coincide", next = index + 1)]
    RepeatedPoint {
        /// Index of the first of them, from 1.
        index: usize,
    },
    /// A polyline that meets itself.
    #[error("segments {first} and {second} meet: a crack must not cross itself")]
    SelfCrossing {
        /// Index of a segment, from 1.
        first: usize,
        /// Index of another, from 1.
        second: usize,
    },
    /// A length that is not positive.
    #[error("crack length {value} mm: must be positive and finite")]
    Length {
        /// The value given, mm.
        value: f64,
    },
    /// An angle that does not point into the rail.
    #[error("crack angle {degrees} degrees: must lie in (0, 180), measured below the surface from +x")]
    Angle {
        /// The value given, degrees.
        degrees: f64,
    },
}

/// An end of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum End {
    /// The first point.
    First,
    /// The last point.
    Last,
}

impl Choice for End {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::First, Word::now("first", "the first point")),
        (Self::Last, Word::now("last", "the last point")),
    ];
}

/// A crack: points from the mouth (y = 0) to the tip, or between two tips when the first point is
/// buried.
///
/// Its frame: x1 points from the first point to the last, x2 is x1 turned by +90°, the + face is on
/// the x2 side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Crack {
    points: Vec<Vec2>,
}

impl Crack {
    /// A straight surface crack: mouth abscissa and length in mm, `angle` in radians in (0, π)
    /// below the surface from +x, so that tip = mouth + length (cos angle, −sin angle).
    pub fn surface_breaking(mouth: f64, length: f64, angle: f64) -> Result<Self, CrackError> {
        if !(length > 0.0 && length.is_finite()) {
            return Err(CrackError::Length { value: length });
        }
        if !(angle > 0.0 && angle < std::f64::consts::PI) {
            return Err(CrackError::Angle { degrees: angle.to_degrees() });
        }
        let mouth = Vec2::new(mouth, 0.0);
        Self::polyline(vec![mouth, mouth + Vec2::unit(-angle) * length])
    }

    /// A polyline crack through `points` (mm). The first point lies on the surface, or below it for
    /// a buried crack; all others below. Consecutive points differ and segments do not meet.
    pub fn polyline(points: Vec<Vec2>) -> Result<Self, CrackError> {
        if points.len() < 2 {
            return Err(CrackError::TooFewPoints { count: points.len() });
        }
        for (i, p) in points.iter().enumerate() {
            let index = i + 1;
            if !(p.x.is_finite() && p.y.is_finite()) {
                return Err(CrackError::NotFinite { index, x: p.x, y: p.y });
            }
            if p.y > 0.0 || (i > 0 && p.y == 0.0) {
                let where_ = if p.y > 0.0 { "above the surface" } else { "on the surface" };
                return Err(CrackError::OutsideRail { index, y: p.y, where_ });
            }
            if i > 0 && points[i - 1] == *p {
                return Err(CrackError::RepeatedPoint { index: i });
            }
        }
        let crack = Self { points };
        let segments = crack.segment_count();
        for i in 0..segments {
            for j in i + 1..segments {
                let (a, b) = crack.segment(i);
                let (c, d) = crack.segment(j);
                let meet = if j == i + 1 {
                    // Consecutive segments share b = c: they overlap where the polyline turns
                    // straight back.
                    (b - a).cross(d - c) == 0.0 && (b - a).dot(d - c) < 0.0
                } else {
                    segments_touch(a, b, c, d)
                };
                if meet {
                    return Err(CrackError::SelfCrossing { first: i + 1, second: j + 1 });
                }
            }
        }
        Ok(crack)
    }

    /// The points, first to last, mm.
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Number of straight segments.
    pub fn segment_count(&self) -> usize {
        self.points.len() - 1
    }

    /// Start and end of segment `i`, from 0.
    pub fn segment(&self, i: usize) -> (Vec2, Vec2) {
        (self.points[i], self.points[i + 1])
    }

    /// Whether the first point is a mouth at the running surface.
    pub fn is_surface_breaking(&self) -> bool {
        self.points[0].y == 0.0
    }

    /// The ends below the surface: the last point, preceded by the first one in a buried crack. All
    /// are tips in a crack on its own; in a network an end may join another crack instead
    /// ([`super::CrackNetwork::tips`]).
    pub fn tips(&self) -> Vec<End> {
        if self.is_surface_breaking() { vec![End::Last] } else { vec![End::First, End::Last] }
    }

    /// The position of the end `end`, mm.
    pub fn tip(&self, end: End) -> Vec2 {
        match end {
            End::First => self.points[0],
            End::Last => self.points[self.points.len() - 1],
        }
    }

    /// The unit vector x1 of the tip frame at `end`: straight ahead, out of the crack.
    pub fn ahead(&self, end: End) -> Vec2 {
        let n = self.points.len();
        match end {
            End::First => (self.points[0] - self.points[1]).normalised(),
            End::Last => (self.points[n - 1] - self.points[n - 2]).normalised(),
        }
    }

    /// Length of the polyline, mm.
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|p| (p[1] - p[0]).length()).sum()
    }

    /// Largest depth, mm.
    pub fn depth(&self) -> f64 {
        self.points.iter().fold(0.0, |depth, p| depth.max(-p.y))
    }

    /// This crack extended by `increment` (mm) at `end`, in a direction turned by `kink` (radians,
    /// counter-clockwise) from straight ahead. Errors as [`Crack::polyline`].
    pub fn extended(&self, end: End, increment: f64, kink: f64) -> Result<Self, CrackError> {
        let tip = self.tip(end) + Vec2::unit(self.ahead(end).angle() + kink) * increment;
        let mut points = self.points.clone();
        match end {
            End::First => points.insert(0, tip),
            End::Last => points.push(tip),
        }
        Self::polyline(points)
    }

    /// This crack moved by `distance` (mm) along +x.
    pub fn moved(&self, distance: f64) -> Self {
        Self { points: self.points.iter().map(|p| Vec2::new(p.x + distance, p.y)).collect() }
    }
}

/// The distance (mm) between the closed segments a–b and c–d; exactly zero when they touch.
pub fn segment_distance(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> f64 {
    if segments_touch(a, b, c, d) {
        return 0.0;
    }
    point_to_segment(a, c, d)
        .min(point_to_segment(b, c, d))
        .min(point_to_segment(c, a, b))
        .min(point_to_segment(d, a, b))
}

/// The distance (mm) of the point p from the closed segment a–b.
pub(crate) fn point_to_segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    from_nearest(p, a, b).length()
}

/// The vector (mm) from the nearest point of the closed segment a–b to the point p.
pub(crate) fn from_nearest(p: Vec2, a: Vec2, b: Vec2) -> Vec2 {
    let along = b - a;
    let squared = along.dot(along);
    let t = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p - (a + along * t)
}

/// Whether two cracks have a point in common other than `shared`, a vertex of both; exact.
pub(super) fn intersect_elsewhere(one: &Crack, other: &Crack, shared: Option<Vec2>) -> bool {
    one.points().windows(2).any(|p| other.points().windows(2).any(|q| segments_meet(p, q, shared)))
}

fn segments_meet(p: &[Vec2], q: &[Vec2], shared: Option<Vec2>) -> bool {
    let far_end = |s: &[Vec2], at: Vec2| if s[0] == at { Some(s[1]) } else { (s[1] == at).then_some(s[0]) };
    match shared.and_then(|at| Some((at, far_end(p, at)?, far_end(q, at)?))) {
        // Two segments from one point meet again only where they have the same direction.
        Some((at, a, b)) => orientation(at, a, b) == Orientation::On && (a - at).dot(b - at) > 0.0,
        None => segments_touch(p[0], p[1], q[0], q[1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossing_parallel_and_end_to_side() {
        let p = Vec2::new;
        assert_eq!(segment_distance(p(0., 0.), p(2., 2.), p(0., 2.), p(2., 0.)), 0.0);
        assert_eq!(segment_distance(p(0., 0.), p(4., 0.), p(1., 3.), p(2., 3.)), 3.0);
        assert_eq!(segment_distance(p(0., 0.), p(4., 0.), p(7., 4.), p(9., 9.)), 5.0);
        assert_eq!(segment_distance(p(0., 0.), p(0., 0.), p(-1., 2.), p(1., 2.)), 2.0);
    }
}

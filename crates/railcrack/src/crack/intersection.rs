//! Intersection of two cracks.

use super::Crack;
use crate::math::{Orientation, Vec2, orientation, segments_touch};

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

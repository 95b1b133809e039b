//! Cracks shortened at their mouths by wear and grinding.

use super::stops::spent_ligament;
use crate::crack::{Crack, Junction};
use crate::growth::least_length;
use crate::math::Vec2;

/// A crack after the surface above it has been removed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Worn {
    /// It remains, with its mouth further down. Ends that only a spent ligament separates from the
    /// surface are marked as broken out.
    Left {
        /// The crack.
        crack: Crack,
        /// Whether the first and the last end have broken out; a mouth does not count.
        broken_out: [bool; 2],
    },
    /// It is worn away; only a stub remains, since the body still contains it.
    Away(Crack),
}

/// `crack` after `depth` (mm) of the surface has been removed. `deferred` (mm) is the deferred
/// growth of its tips, `longest` (mm) its greatest length so far, `resolution` (mm) the length that
/// the engine resolves.
pub(super) fn worn(crack: &Crack, depth: f64, deferred: f64, longest: f64, resolution: f64) -> Worn {
    let lifted: Vec<Vec2> = crack.points().iter().map(|p| Vec2::new(p.x, p.y + depth)).collect();
    let ligament = spent_ligament(crack, resolution);
    let deepest = (0..lifted.len()).min_by(|&i, &j| lifted[i].y.total_cmp(&lifted[j].y)).unwrap_or(0);
    let mouth_at = if crack.is_surface_breaking() { 0.0 } else { -ligament };
    let (mut before, first) = up_to(lifted[..=deepest].iter().rev(), mouth_at);
    let (behind, last) = up_to(lifted[deepest..].iter(), -ligament);
    before.reverse();
    before.extend_from_slice(behind.get(1..).unwrap_or_default());
    let mut points = before;
    if crack.is_surface_breaking() {
        settle_mouth(&mut points, resolution);
    }
    let least = least_length(longest, resolution);
    let left = lifted[deepest].y < -ligament && points.len() > 1;
    let left = left.then(|| Crack::polyline(points).ok()).flatten();
    match left.filter(|left| left.length() + deferred > least) {
        Some(left) => {
            let broken_out = [first && !crack.is_surface_breaking(), last];
            Worn::Left { crack: left, broken_out }
        }
        None => Worn::Away(stub(crack, least)),
    }
}

/// The points of `walk`, which begins at the deepest one, as far as they lie below `limit` (mm),
/// with the point at which it rises to the limit, and whether it does so. An end that lies on the
/// surface is kept.
fn up_to<'a>(walk: impl Iterator<Item = &'a Vec2>, limit: f64) -> (Vec<Vec2>, bool) {
    let mut below: Vec<Vec2> = Vec::new();
    for &point in walk {
        if point.y < limit {
            below.push(point);
            continue;
        }
        if let Some(&last) = below.last() {
            let share = (limit - last.y) / (point.y - last.y);
            below.push(Vec2::new(last.x + share * (point.x - last.x), limit));
        }
        return (below, true);
    }
    (below, false)
}

/// Removes a first segment that is shorter than the resolution.
fn settle_mouth(points: &mut Vec<Vec2>, resolution: f64) {
    if points.len() > 2 && (points[1] - points[0]).length() < resolution {
        points.remove(1);
    }
}

/// The first `length` (mm) of a crack that is worn away, since a body cannot contain a crack of
/// zero length.
fn stub(crack: &Crack, length: f64) -> Crack {
    let (from, to) = crack.segment(0);
    let segment = to - from;
    let end = from + segment * f64::min(1.0, length / segment.length());
    Crack::polyline(vec![from, end]).unwrap_or_else(|_| crack.clone())
}

/// Whether the removal of `depth` (mm) takes a junction of `cracks` to the surface, or so close to
/// it that the ligament is spent.
pub(super) fn reaches_junction(
    cracks: &[Crack],
    junctions: &[Junction],
    depth: f64,
    resolution: f64,
) -> bool {
    junctions.iter().any(|junction| {
        let crack = &cracks[junction.joining.crack];
        crack.tip(junction.joining.end).y + depth > -spent_ligament(crack, resolution)
    })
}

/// Sine of the angle of `crack` at its mouth; `None` for a buried crack.
pub(super) fn mouth_sine(crack: &Crack) -> Option<f64> {
    let (mouth, next) = crack.segment(0);
    let segment = next - mouth;
    crack.is_surface_breaking().then(|| -segment.y / segment.length())
}

#[cfg(test)]
#[path = "worn_tests.rs"]
mod tests;

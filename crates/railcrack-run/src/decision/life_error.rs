//! The error of a life by the increments, where grindings decide whether a size is reached.
//!
//! Cycles in error by e shift growth over traffic, while grindings stay where they are. A crack
//! that becomes critical just before a grinding could do so only after it, and one that just failed
//! to could have done so before: the error of the life is then not e but the way to the next time.

use super::course::{Course, CoursePoint};
use railcrack::growth::{Grinding, Mgt, SurfaceRemoval};

/// Grindings followed beyond the end of a course at most.
const MOST_GRINDINGS: usize = 1000;

/// The error of the life (axles) until `size` (mm) of the cracks of `course` reaches `limit` (mm)
/// after `life` axles, where axles of `tonnes` pass and `removal` takes the surface: the farther of
/// the times at which the size plus and less its error reaches the limit. A course that ends is
/// continued at its last rate; the life itself where the size would then never reach the limit.
pub(super) fn life_error(
    course: &Course,
    size: impl Fn(&CoursePoint) -> f64,
    limit: f64,
    life: f64,
    tonnes: f64,
    removal: &SurfaceRemoval<Mgt>,
) -> f64 {
    let points = &course.points;
    let Some(Grinding { depth, interval: Mgt(interval), .. }) = removal.grinding else {
        return error_at(points, life);
    };
    let per_axle = 1e-6 * tonnes;
    let mut slope = 0.0;
    let mut ends: [Option<f64>; 2] = [None, None];
    let mut before: Option<(f64, [f64; 2])> = None;
    for (i, point) in points.iter().enumerate() {
        let passed = point.axles - i.checked_sub(1).map_or(0.0, |i| points[i].axles);
        if i > 0 && passed > 0.0 {
            slope = (size(point) - size(&points[i - 1])) / passed;
        }
        let error = point.axles_error * slope.max(0.0);
        let sizes = [size(point) + error, size(point) - error];
        for k in 0..2 {
            if ends[k].is_none() && sizes[k] >= limit {
                let share = |(axles, from): (f64, [f64; 2])| {
                    axles + (point.axles - axles) * (limit - from[k]) / (sizes[k] - from[k])
                };
                ends[k] = Some(before.map_or(point.axles, share));
            }
        }
        before = Some((point.axles, sizes));
    }
    let latest = ends[1].or_else(|| {
        let (last, (mut axles, [_, mut least])) = points.last().zip(before)?;
        let cut = depth * size(last) / last.depth;
        let done = (0..).find(|&done| removal.next_grinding(done).0 > per_axle * axles * (1.0 + 1e-9))?;
        for next in (done..done + MOST_GRINDINGS).map(|done| removal.next_grinding(done).0 / per_axle) {
            let until = axles + (limit - least) / slope;
            if slope > 0.0 && until <= next {
                return Some(until);
            }
            if slope * interval / per_axle <= cut {
                return None;
            }
            least += slope * (next - axles) - cut;
            axles = next;
        }
        None
    });
    let earliest = ends[0].unwrap_or(life);
    latest.map_or(life, |latest| (latest - life).max(life - earliest).max(error_at(points, life)))
}

/// The error of the axles (axles) of the first of `points` at `life` axles or later.
pub(super) fn error_at(points: &[CoursePoint], life: f64) -> f64 {
    let after = points.iter().find(|point| point.axles >= life * (1.0 - 1e-9));
    after.or(points.last()).map_or(0.0, |point| point.axles_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decision::course::CourseEnd;
    use railcrack::growth::WheelShares;

    /// Axles of 1 t, so that a million of them are an MGT; 0.1 mm is ground every 20 MGT.
    const REMOVAL: SurfaceRemoval<Mgt> = SurfaceRemoval {
        grinding: Some(Grinding { depth: 0.1, interval: Mgt(20.0), first: None }),
        ..SurfaceRemoval::NONE
    };

    /// A crack that grows by `rate` (mm/MGT) from 2 mm, with errors of 1 % of the axles, until
    /// `end` (MGT): 20 points in each interval, and one before each grinding.
    fn course(rate: f64, end: f64) -> Course {
        let mut points = Vec::new();
        let mut push = |mgt: f64, grindings: f64| {
            let removed = 0.1 * grindings;
            let depth = 2.0 + rate * mgt - removed;
            points.push(CoursePoint {
                axles: 1e6 * mgt,
                axles_error: 1e4 * mgt,
                work: rate * mgt + removed,
                removed,
                rate: 1e-6 * rate,
                delta_keq: 10.0,
                largest_k1: 0.0,
                depth,
                deepest: (0, 0),
                length: 2.0 * depth,
                longest: 0,
                own_depth: depth,
                own_length: 2.0 * depth,
                shares: WheelShares::default(),
            });
        };
        for step in 0..=(end as usize) {
            let mgt = step as f64;
            if step % 20 == 0 && step > 0 {
                push(mgt, mgt / 20.0 - 1.0);
            }
            push(mgt, (mgt / 20.0).floor());
        }
        Course { points, events: Vec::new(), end: CourseEnd::Unknown }
    }

    fn error(limit: f64, life: f64, end: f64) -> f64 {
        1e-6 * life_error(&course(0.01, end), |point| point.depth, limit, 1e6 * life, 1.0, &REMOVAL)
    }

    /// 0.01 mm/MGT less 0.1 mm every 20 MGT: the depth before the fifth grinding is 2.6 mm, and
    /// after it the crack needs 10 MGT to be so deep again.
    #[test]
    fn a_size_reached_just_before_a_grinding_may_be_reached_after_it() {
        let expected = 110.0 - 99.9;
        let (found, ended) = (error(2.599, 99.9, 200.0), error(2.599, 99.9, 99.0));
        assert!((found - expected).abs() < 1.2, "{found}"); // the error of the depth is 0.01 mm
        assert!((ended - expected).abs() < 1.2, "{ended}");
    }

    #[test]
    fn a_size_missed_before_a_grinding_may_be_reached_before_it() {
        let found = error(2.601, 110.1, 200.0);
        // With the error of the depth, 2.601 mm is reached after 99.11 MGT.
        assert!((found - 10.99).abs() < 0.01, "{found}");
    }

    #[test]
    fn between_grindings_the_error_is_that_of_the_axles() {
        let found = error(2.55, 95.0, 200.0);
        assert!((found - 0.95).abs() < 0.02, "{found}");
    }

    #[test]
    fn a_crack_that_grinding_holds_has_no_later_time() {
        let held = course(0.004, 19.0);
        let error = life_error(&held, |point| point.depth, 2.0799, 19.975e6, 1.0, &REMOVAL);
        assert_eq!(error, 19.975e6);
    }
}

//! Coalescence of increments with cracks and with each other.
//!
//! All tips of a growth step advance simultaneously, each along a straight line at its own constant
//! speed, from the end of its deferred growth to the end of its increment. A tip that comes closer
//! than the resolution to another crack, or to the path that another tip has covered by then,
//! coalesces with it; the others continue. Coalescences are handled in chronological order, so that
//! neither the order of the cracks nor a mirror image changes the result.

use super::step_state::Step;
use crate::crack::{Crack, End, point_to_segment};
use crate::math::{Ties, Vec2, golden_section, segments_touch};

/// Faces of the same crack count as another crack from this many resolved lengths behind the tip,
/// along the crack: nearer faces, including those of short increments, belong to the neighbourhood
/// of the tip itself.
const OWN_FACES_FROM: f64 = 3.0;
/// An increment ends where it crosses a crack if it does so within this many resolved lengths of
/// coming close; at shallower angles the tip turns to the nearest point, so that no thin wedge is
/// left.
const CROSSING_REACH: f64 = 4.0;
/// Times, and distances relative to the resolution, that differ by less are equal to within
/// round-off.
const SAME: f64 = 1e-9;
/// Bisections of a fraction of the increment, down to round-off.
const HALVINGS: usize = 60;
/// Golden-section steps, down to the square root of round-off.
const SECTIONS: usize = 48;

/// The coalescence of a tip with a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coalescence {
    /// The end of the increment, mm.
    pub at: Vec2,
    /// Index (from 0) of the crack that is met; that of the tip itself where it closes a loop.
    pub onto: usize,
    /// Where two tips meet, the index of the other tip's step.
    pub with: Option<usize>,
    /// The part of the step at which it occurs.
    pub time: f64,
}

/// The coalescences of `steps`, `None` for a tip that meets nothing or does not grow; `resolution`
/// (mm) is the length that the engine resolves.
pub(super) fn coalescences(
    steps: &[Option<Step>],
    cracks: &[Crack],
    resolution: f64,
) -> Vec<Option<Coalescence>> {
    let mut tips: Vec<Moving> =
        steps.iter().flatten().map(|step| Moving { step: *step, end: None }).collect();
    let numbers: Vec<usize> = (0..steps.len()).filter(|&i| steps[i].is_some()).collect();
    let mut coalescences: Vec<Option<Coalescence>> = vec![None; tips.len()];
    while let Some(event) = first_event(&tips, cracks, resolution) {
        let Event { tip, time, obstacle, .. } = event;
        match obstacle {
            Obstacle::Tip(other) => {
                let at = (tips[tip].position(time) + tips[other].position(time)) * 0.5;
                for (one, two) in [(tip, other), (other, tip)] {
                    let onto = tips[two].step.tip.crack;
                    coalescences[one] = Some(Coalescence { at, onto, with: Some(numbers[two]), time });
                }
                tips[tip].end = Some((at, time));
                tips[other].end = Some((at, time));
            }
            Obstacle::Faces(crack) => {
                let at = landing(&tips, tip, time, crack, cracks, resolution);
                coalescences[tip] = Some(Coalescence { at, onto: crack, with: None, time });
                tips[tip].end = Some((at, time));
            }
        }
    }
    let mut all = vec![None; steps.len()];
    for (number, coalescence) in numbers.into_iter().zip(coalescences) {
        all[number] = coalescence;
    }
    all
}

/// A tip in motion; time runs from 0 to 1 over the step.
#[derive(Debug, Clone, Copy)]
struct Moving {
    step: Step,
    /// The point and time at which it ended, if it has.
    end: Option<(Vec2, f64)>,
}

impl Moving {
    fn position(&self, time: f64) -> Vec2 {
        match self.end {
            Some((at, end)) if time >= end => at,
            _ => self.step.from + (self.step.to - self.step.from) * self.share(time),
        }
    }

    /// The share of its increment that it has covered at `time`, including any part covered before
    /// the step.
    fn share(&self, time: f64) -> f64 {
        self.step.deferred + (1.0 - self.step.deferred) * time
    }
}

#[derive(Debug, Clone, Copy)]
struct Event {
    tip: usize,
    time: f64,
    /// Distance to the obstacle at that time, mm: the resolution, or less where the tip was already
    /// closer.
    distance: f64,
    obstacle: Obstacle,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Obstacle {
    /// The faces of a crack, including its growth in this step.
    Faces(usize),
    /// Another growing tip.
    Tip(usize),
}

/// The first event of the tips that still grow. Of simultaneous events the nearest is taken, and of
/// equally near ones a meeting of two tips, so that neither tip is preferred.
fn first_event(tips: &[Moving], cracks: &[Crack], resolution: f64) -> Option<Event> {
    let mut first: Option<Event> = None;
    let is_before = |one: &Event, other: &Event| {
        if (one.time - other.time).abs() > SAME {
            return one.time < other.time;
        }
        if (one.distance - other.distance).abs() > SAME * resolution {
            return one.distance < other.distance;
        }
        matches!((one.obstacle, other.obstacle), (Obstacle::Tip(_), Obstacle::Faces(_)))
    };
    let mut offer = |event: Event| {
        if first.as_ref().is_none_or(|before| is_before(&event, before)) {
            first = Some(event);
        }
    };
    let growing = || (0..tips.len()).filter(|&i| tips[i].end.is_none());
    for tip in growing() {
        let step = &tips[tip].step;
        for (crack, one) in cracks.iter().enumerate() {
            for (a, b) in static_faces(one, step, crack, resolution) {
                let distance = |time: f64| point_to_segment(tips[tip].position(time), a, b);
                if let Some(time) = first_within(distance, resolution) {
                    let obstacle = Obstacle::Faces(crack);
                    offer(Event { tip, time, distance: distance(time), obstacle });
                }
            }
        }
        for other in (0..tips.len()).filter(|&other| other != tip) {
            let to_path = |time: f64| {
                point_to_segment(tips[tip].position(time), tips[other].step.from, tips[other].position(time))
            };
            let Some(time) = first_within(to_path, resolution) else { continue };
            // Up to the end of the other tip, an encounter with it was one with a growing tip.
            let time = tips[other].end.map_or(time, |(_, end)| time.max(end));
            let apart = (tips[tip].position(time) - tips[other].position(time)).length();
            let is_head_on = apart < HEAD_ON * resolution;
            let obstacle = if is_head_on && tips[other].end.is_none() {
                Obstacle::Tip(other)
            } else {
                Obstacle::Faces(tips[other].step.tip.crack)
            };
            offer(Event { tip, time, distance: to_path(time), obstacle });
        }
    }
    first
}

/// Two tips meet each other if they are closer than this many resolved lengths when one of them
/// comes within one resolved length of the other's path.
const HEAD_ON: f64 = 1.5;

/// The segments of `crack`, with index `index`, that the tip of `step` may meet.
fn static_faces(crack: &Crack, step: &Step, index: usize, resolution: f64) -> Vec<(Vec2, Vec2)> {
    if index == step.tip.crack {
        return faces_behind(crack, step.tip.end, OWN_FACES_FROM * resolution);
    }
    crack.points().windows(2).map(|p| (p[0], p[1])).collect()
}

/// The segments of `crack` at least `distance` (mm, along the crack) behind the tip at `end`; the
/// nearest one is cut off at that distance.
fn faces_behind(crack: &Crack, end: End, distance: f64) -> Vec<(Vec2, Vec2)> {
    let mut points = crack.points().to_vec();
    if end == End::Last {
        points.reverse();
    }
    let mut left_out = distance;
    let mut segments = Vec::new();
    for p in points.windows(2) {
        let length = (p[1] - p[0]).length();
        if left_out < length {
            let cut = p[0] + (p[1] - p[0]) * (left_out / length);
            segments.push((cut, p[1]));
        }
        left_out = f64::max(0.0, left_out - length);
    }
    segments
}

/// The first time in [0, 1] at which `distance`, a convex function of time, falls to `limit`;
/// `None` where it does not, or where the tip only moves away.
fn first_within(distance: impl Fn(f64) -> f64, limit: f64) -> Option<f64> {
    let nearest = argmin(&distance, 0.0, 1.0);
    let start = distance(0.0);
    if !(distance(nearest) < limit && distance(nearest) < start - SAME * limit) {
        return None;
    }
    if start <= limit {
        return Some(0.0);
    }
    let (mut outside, mut inside) = (0.0, nearest);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (outside + inside);
        if distance(middle) <= limit {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    Some(inside)
}

/// The argument at which a convex function is smallest on [a, b], including the ends.
fn argmin(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let middle = golden_section([a, b], SECTIONS, Ties::First, |t| -f(t));
    [a, middle].into_iter().fold(b, |best, t| if f(t) < f(best) { t } else { best })
}

/// The point at which `tip`, close to `crack` at `time`, ends on it: the crossing with its
/// increment if that is near enough, otherwise the nearest point. A vertex of the crack within the
/// resolution of that point takes its place.
fn landing(tips: &[Moving], tip: usize, time: f64, crack: usize, cracks: &[Crack], resolution: f64) -> Vec2 {
    let Moving { step, .. } = tips[tip];
    let now = tips[tip].share(time);
    let mut faces = static_faces(&cracks[crack], &step, crack, resolution);
    for (other, moving) in tips.iter().enumerate() {
        if other != tip && moving.step.tip.crack == crack {
            faces.push((moving.step.from, moving.position(time)));
        }
    }
    let length = (step.to - step.from).length();
    let until = f64::min(1.0, now + CROSSING_REACH * resolution / length);
    let crossing = faces
        .iter()
        .filter(|(a, b)| segments_touch(step.from, step.to, *a, *b))
        .filter_map(|&(a, b)| crossing(&step, a, b))
        .fold(f64::INFINITY, f64::min);
    let at = if crossing <= until {
        step.from + (step.to - step.from) * crossing
    } else {
        let distance = |t: f64| {
            let p = step.from + (step.to - step.from) * t;
            faces.iter().map(|&(a, b)| point_to_segment(p, a, b)).fold(f64::INFINITY, f64::min)
        };
        let closest = argmin(distance, now, until);
        nearest_point(step.from + (step.to - step.from) * closest, &faces)
    };
    let vertices = faces.iter().flat_map(|&(a, b)| [a, b]).filter(|v| cracks[crack].vertex_at(*v).is_some());
    let near = vertices.min_by(|a, b| (*a - at).length().total_cmp(&(*b - at).length()));
    near.filter(|v| (*v - at).length() < resolution).unwrap_or(at)
}

/// The fraction of the step at which it crosses a–b; `None` where they are parallel.
fn crossing(step: &Step, a: Vec2, b: Vec2) -> Option<f64> {
    let (increment, face) = (step.to - step.from, b - a);
    let determinant = increment.cross(face);
    (determinant != 0.0).then(|| ((a - step.from).cross(face) / determinant).clamp(0.0, 1.0))
}

/// The point of `faces` nearest to `p`.
fn nearest_point(p: Vec2, faces: &[(Vec2, Vec2)]) -> Vec2 {
    let foot = |&(a, b): &(Vec2, Vec2)| {
        let t = (p - a).dot(b - a) / (b - a).dot(b - a);
        // The path of a tip that has not moved yet has zero length.
        if t <= 0.0 || a == b {
            a
        } else if t >= 1.0 {
            b
        } else {
            a + (b - a) * t
        }
    };
    let feet = faces.iter().map(foot);
    feet.min_by(|a, b| (*a - p).length().total_cmp(&(*b - p).length())).unwrap_or(p)
}

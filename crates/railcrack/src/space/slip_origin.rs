//! Second-order integration of slip over load steps.
//!
//! At the end of a step, the friction force opposes slip that is measured from a reference, the
//! origin. If the origin is the jump at the start of the step (backward Euler), the error for a
//! turning slip direction is quadratic in the step, and a closing point is held where it was when
//! still open. Second-order backward differences (Gear 1971) take the slip of the previous step
//! into account; closing points are held where their extrapolated jumps would have met.

use super::contact::Guess;
use super::states::{SpaceFaces, SpaceStatus};

/// The faces with the wheel at a position.
#[derive(Debug, Clone)]
pub(super) struct WheelInstant {
    /// Abscissa of the centre of the contact, mm.
    pub position: f64,
    pub faces: SpaceFaces,
    /// Forces A ⟦w⟧ (N) that resist the jumps of the points that are solved for, where known.
    pub resisted: Option<Vec<f64>>,
}

impl WheelInstant {
    /// This state as the guess of another one.
    pub fn guess(&self) -> Guess {
        Guess { jumps: self.faces.jumps.clone(), resisted: self.resisted.clone() }
    }

    /// The state at this share of the way to another one, which may be negative.
    pub fn towards(&self, other: &Self, share: f64) -> Guess {
        let between = |own: &[f64], other: &[f64]| {
            own.iter().zip(other).map(|(own, other)| own + share * (other - own)).collect()
        };
        let resisted = self.resisted.as_deref().zip(other.resisted.as_deref());
        Guess {
            jumps: between(&self.faces.jumps, &other.faces.jumps),
            resisted: resisted.map(|(own, other)| between(own, other)),
        }
    }
}

/// A step longer than this many times the previous step ignores its history. A sequence in which
/// each step is longer than the last by 1 + √2 would be unstable (Grigorieff 1983); an accepted
/// step has at most twice the length of the last, and is compared with one of twice that length.
pub(super) const LONGEST: f64 = 4.0;

/// The jumps (mm), 3p, from which slip is measured in the step from `before` to the position `to`.
pub(super) fn slip_origin(earlier: Option<&WheelInstant>, before: &WheelInstant, to: f64) -> Vec<f64> {
    let mut origin = before.faces.jumps.clone();
    let Some(earlier) = earlier else { return origin };
    let ratio = (to - before.position) / (before.position - earlier.position);
    if ratio > LONGEST {
        return origin;
    }
    for (a, status) in before.faces.status.iter().enumerate() {
        let moved = |c: usize| before.faces.jumps[3 * a + c] - earlier.faces.jumps[3 * a + c];
        let share = match (earlier.faces.status[a], status) {
            (_, SpaceStatus::Stick) | (SpaceStatus::Open, SpaceStatus::Slip { .. }) => 0.0,
            (_, SpaceStatus::Slip { .. }) => ratio * ratio / (1.0 + 2.0 * ratio),
            // Extrapolation to the closure of the point, at most to the end of the step.
            (_, SpaceStatus::Open) if moved(0) < 0.0 => ratio.min(-before.faces.jumps[3 * a] / moved(0)),
            (_, SpaceStatus::Open) => 0.0,
        };
        (1..3).for_each(|c| origin[3 * a + c] += share * moved(c));
    }
    origin
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIP: SpaceStatus = SpaceStatus::Slip { direction: [1.0, 0.0] };

    fn instant(position: f64, status: SpaceStatus, jumps: [f64; 3]) -> WheelInstant {
        let faces = SpaceFaces {
            jumps: jumps.to_vec(),
            reactions: vec![0.0; 3],
            status: vec![status],
            fluid: Vec::new(),
        };
        WheelInstant { position, faces, resisted: None }
    }

    #[test]
    fn slip_of_a_parabola_is_exact() {
        // s = t²: the slip from the origin has the direction of the rate at the end, and the
        // magnitude given by Gear's formula (1971).
        let (h, before, step) = (0.3, 1.1, 0.5);
        let at = |t: f64| instant(t, SLIP, [0.0, t * t, -3.0 * t * t]);
        let origin = slip_origin(Some(&at(before - h)), &at(before), before + step);
        let end = before + step;
        let ratio: f64 = step / h;
        let size = step * (1.0 + ratio) / (1.0 + 2.0 * ratio) * 2.0 * end;
        assert!((end * end - origin[1] - size).abs() < 1e-14, "{origin:?}");
        assert!((-3.0 * end * end - origin[2] + 3.0 * size).abs() < 1e-14, "{origin:?}");
    }

    #[test]
    fn closing_points_are_held_where_they_meet() {
        let earlier = instant(0.0, SpaceStatus::Open, [4.0, 1.0, 0.0]);
        let before = instant(1.0, SpaceStatus::Open, [3.0, 2.0, 1.0]);
        assert_eq!(slip_origin(Some(&earlier), &before, 2.0), [3.0, 3.0, 2.0]);
        // A point that closes within a longer step.
        let near = instant(1.0, SpaceStatus::Open, [1.0, 2.0, 1.0]);
        assert_eq!(slip_origin(Some(&earlier), &near, 3.0), [1.0, 2.0 + 1.0 / 3.0, 1.0 + 1.0 / 3.0]);
        assert_eq!(slip_origin(Some(&earlier), &before, 6.0), before.faces.jumps);
        let opening = instant(0.0, SpaceStatus::Open, [2.0, 1.0, 0.0]);
        assert_eq!(slip_origin(Some(&opening), &before, 2.0), before.faces.jumps);
    }

    #[test]
    fn points_that_stick_or_have_just_closed_begin_anew() {
        let earlier = instant(0.0, SpaceStatus::Open, [1.0, 1.0, 0.0]);
        for (earlier, status) in
            [(Some(&earlier), SLIP), (Some(&earlier), SpaceStatus::Stick), (None, SpaceStatus::Open)]
        {
            let before = instant(1.0, status, [0.0, 2.0, 1.0]);
            assert_eq!(slip_origin(earlier, &before, 2.0), before.faces.jumps);
        }
    }
}

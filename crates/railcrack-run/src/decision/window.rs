//! The window of an inspection: the traffic in which it can find a crack before the rail fails.
//!
//! A crack that turns up, or is ground, may hide again: what an inspection can still find is the
//! crack since it became detectable for the last time.

use super::events::{Limits, Part};
use super::family::State;

/// The traffic in which an inspection can find a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    /// Million gross tonnes until the crack is first detectable.
    pub first: f64,
    /// Million gross tonnes until it becomes detectable for the last time.
    pub from: f64,
    /// Million gross tonnes until it fails, or hides before without coming back.
    pub to: f64,
    /// The longest stretch, in million gross tonnes, in which it hides after it was detectable.
    pub hidden: f64,
}

impl Window {
    /// Its traffic, million gross tonnes.
    pub fn length(&self) -> f64 {
        (self.to - self.from).max(0.0)
    }
}

/// A growing crack that inspections look for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Visibility {
    first: Option<f64>,
    /// Since when it is detectable, or was for the last time.
    from: f64,
    /// Since when it hides.
    hides: Option<f64>,
    longest: f64,
}

impl Visibility {
    /// Follows `part` up to `until` (million gross tonnes).
    pub fn follow(&mut self, part: &Part, limits: &Limits, until: f64) {
        let seen = |state: &State| limits.is_detectable(state);
        let (from, to) = (seen(&part.from), seen(&part.to));
        if part.mgt[0] <= until {
            self.turn(from, part.mgt[0]);
        }
        if from != to {
            let at = limits.crossing(part);
            if at <= until {
                self.turn(to, at);
            }
        }
    }

    /// The crack is detectable from `mgt` on, or is not any longer.
    fn turn(&mut self, is_detectable: bool, mgt: f64) {
        match (is_detectable, self.first, self.hides) {
            (true, None, _) => (self.first, self.from) = (Some(mgt), mgt),
            (true, Some(_), Some(since)) => {
                self.longest = self.longest.max(mgt - since);
                (self.from, self.hides) = (mgt, None);
            }
            (false, Some(_), None) => self.hides = Some(mgt),
            _ => {}
        }
    }

    /// The window of a crack that fails after `end` million gross tonnes; none where it is never
    /// detectable.
    pub fn window(&self, end: f64) -> Option<Window> {
        let at_last = self.hides.map_or(0.0, |since| end - since);
        Some(Window {
            first: self.first?,
            from: self.from,
            to: self.hides.unwrap_or(end),
            hidden: self.longest.max(at_last),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(depth: f64) -> State {
        State { own_reach: depth, reach: depth, ..State::default() }
    }

    /// A crack of the given depths (mm) after 0, 1, 2, … million gross tonnes, detectable from 2
    /// mm.
    fn window(depths: &[f64], end: f64) -> Option<Window> {
        let limits = Limits {
            critical_depth: None,
            critical_length: None,
            toughness: None,
            detectable_depth: Some(2.0),
            detectable_length: None,
            ignored: None,
        };
        let mut visibility = Visibility::default();
        for (i, pair) in depths.windows(2).enumerate() {
            let mgt = [i as f64, i as f64 + 1.0];
            let part =
                Part { from: state(pair[0]), to: state(pair[1]), slowness: [1.0; 2], mgt, work: [0.0; 2] };
            visibility.follow(&part, &limits, end);
        }
        visibility.window(end)
    }

    #[test]
    fn a_crack_that_hides_has_the_window_of_its_last_appearance() {
        let seen = |first: f64, from: f64, to: f64, hidden: f64| Some(Window { first, from, to, hidden });
        assert_eq!(window(&[1.0, 3.0, 5.0], 2.0), seen(0.5, 0.5, 2.0, 0.0));
        // Detectable at first, then hidden from 0.5 to 3.5.
        assert_eq!(window(&[3.0, 1.0, 1.0, 1.0, 3.0, 5.0], 5.0), seen(0.0, 3.5, 5.0, 3.0));
        // Hidden from 0.5 to the failure.
        assert_eq!(window(&[3.0, 1.0, 1.0], 2.0), seen(0.0, 0.0, 0.5, 1.5));
        // A grinding: two parts that do not meet.
        let limits_are_crossed = window(&[3.0, 3.0, 1.0, 3.0], 2.6);
        assert_eq!(limits_are_crossed, seen(0.0, 2.5, 2.6, 1.0));
        // What follows the failure does not count.
        assert_eq!(window(&[1.0, 1.5, 5.0], 1.1), None);
    }
}

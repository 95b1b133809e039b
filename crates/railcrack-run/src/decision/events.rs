//! A part of the way of a crack, and the events on it: critical sizes, fracture, the events of its
//! courses, and detection.

use super::course::FailureMode;
use super::family::{EVENTS, State};

/// How the way of a crack ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fate {
    /// The rail fails after so many million gross tonnes.
    Fails(FailureMode, f64),
    /// The last crack is worn away after so many million gross tonnes.
    Worn(f64),
    /// The rail is worn to the limit at which it is replaced after so many million gross tonnes.
    Replaced(f64),
    /// No crack grows any longer.
    Rests,
    /// It has not failed after so many million gross tonnes, where the courses end.
    Outlives(f64),
}

impl Fate {
    /// Million gross tonnes until then; infinite at rest.
    pub fn mgt(self) -> f64 {
        match self {
            Self::Fails(_, mgt) | Self::Worn(mgt) | Self::Replaced(mgt) | Self::Outlives(mgt) => mgt,
            Self::Rests => f64::INFINITY,
        }
    }

    /// Million gross tonnes until the rail fails; none where it does not.
    pub fn failure(self) -> Option<f64> {
        if let Self::Fails(_, mgt) = self { Some(mgt) } else { None }
    }

    /// That of `self` and `other` which comes first, `self` of equals.
    pub fn or_earlier(self, other: Self) -> Self {
        if other.mgt() < self.mgt() { other } else { self }
    }
}

/// Limits that end a way, and sizes that are looked for meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub critical_depth: Option<f64>,
    pub critical_length: Option<f64>,
    /// K_Ic (MPa√m) of a sample; none where the fractures of the courses count.
    pub toughness: Option<f64>,
    pub detectable_depth: Option<f64>,
    pub detectable_length: Option<f64>,
    /// A mode that does not end the way.
    pub ignored: Option<FailureMode>,
}

/// A part of a way, from one state to another.
pub(super) struct Part {
    pub from: State,
    pub to: State,
    /// 1/(ds/dN), MGT per mm, at both ends.
    pub slowness: [f64; 2],
    /// Traffic, million gross tonnes, at both ends.
    pub mgt: [f64; 2],
    /// Growth and removal, mm, at both ends.
    pub work: [f64; 2],
}

/// Critical lengths and depths are reached up to rounding.
const REACHED: f64 = 1e-8;

impl Limits {
    /// The first end of a way on `part`; its courses have their events with growth and removal of
    /// `of_courses` (mm).
    pub fn first(&self, part: &Part, of_courses: &[Option<f64>; EVENTS.len()]) -> Option<Fate> {
        let nearly = |size: f64| size * (1.0 - REACHED);
        let depth = self.critical_depth.and_then(|depth| part.reaches(State::depth, nearly(depth)));
        let length =
            self.critical_length.and_then(|length| part.reaches(|state| state.length, nearly(length)));
        let breaks = self.toughness.and_then(|toughness| part.reaches(|state| state.largest_k1, toughness));
        let own =
            [(FailureMode::Depth, depth), (FailureMode::Length, length), (FailureMode::Fracture, breaks)];
        let own = own.into_iter().filter_map(|(mode, mgt)| Some((Some(mode), mgt?)));
        let counts =
            |mode: &Option<FailureMode>| self.toughness.is_none() || *mode != Some(FailureMode::Fracture);
        let of_courses = EVENTS.iter().zip(of_courses).filter(|(mode, _)| counts(mode));
        let of_courses = of_courses.filter_map(|(mode, work)| Some((*mode, part.passes((*work)?)?)));
        own.chain(of_courses)
            .filter(|(mode, _)| mode.is_none() || *mode != self.ignored)
            .map(|(mode, mgt)| mode.map_or(Fate::Worn(mgt), |mode| Fate::Fails(mode, mgt)))
            .reduce(Fate::or_earlier)
    }

    /// Whether an inspection finds the crack; it does where nothing says what it finds.
    pub fn is_detectable(&self, state: &State) -> bool {
        self.beyond_detectable(state) >= 0.0
    }

    /// The tonnage on `part` at which the crack becomes detectable, or ceases to be so, where it is
    /// at one end of it alone.
    pub fn crossing(&self, part: &Part) -> f64 {
        let (from, to) = (self.beyond_detectable(&part.from), self.beyond_detectable(&part.to));
        part.at(from / (from - to))
    }

    /// Depth or length (mm) of the crack beyond that from which it is detectable.
    fn beyond_detectable(&self, state: &State) -> f64 {
        match (self.detectable_depth, self.detectable_length) {
            (Some(depth), _) => state.own_depth() - depth,
            (None, Some(length)) => state.own_length - length,
            (None, None) => 0.0,
        }
    }
}

impl Part {
    /// No way at all: `state` at `mgt`, with growth and removal of `work` (mm).
    pub fn at_rest(state: State, mgt: f64, work: f64) -> Self {
        Self { from: state, to: state, slowness: [0.0; 2], mgt: [mgt; 2], work: [work; 2] }
    }

    /// The tonnage at which `share` of the way lies behind: the slowness is linear along it.
    pub fn at(&self, share: f64) -> f64 {
        let [a, b] = self.slowness;
        let whole = 0.5 * (a + b);
        let part = if whole > 0.0 && whole.is_finite() {
            share * (a + 0.5 * share * (b - a)) / whole
        } else {
            share
        };
        self.mgt[0] + part * (self.mgt[1] - self.mgt[0])
    }

    /// The tonnage at which `quantity` first reaches `value`.
    pub fn reaches(&self, quantity: impl Fn(&State) -> f64, value: f64) -> Option<f64> {
        let (from, to) = (quantity(&self.from), quantity(&self.to));
        if from >= value {
            return Some(self.mgt[0]);
        }
        (to >= value).then(|| self.at((value - from) / (to - from)))
    }

    /// The tonnage at which growth and removal have come to `work` (mm).
    fn passes(&self, work: f64) -> Option<f64> {
        let [from, to] = self.work;
        if work > to {
            return None;
        }
        Some(if to > from { self.at(((work - from) / (to - from)).clamp(0.0, 1.0)) } else { self.mgt[1] })
    }
}

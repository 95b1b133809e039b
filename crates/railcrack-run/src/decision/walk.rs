//! The way of a sampled crack through a family of courses.

use super::course::{CourseEnd, FailureMode};
use super::family::{EVENTS, Family, Removal, Spot, State};
use crate::log::MixInfo;
use railcrack::growth::{MOST_WHEELS, WheelShares};

/// ΔK_eq (MPa√m) about which the exponent of the law scatters: there the rate keeps its scatter.
const PIVOT: f64 = 10.0;
/// Relative difference of tonnages that is rounding.
const ROUNDING: f64 = 1e-9;
/// Steps of a walk at most: grindings of a crack at rest that lasts for ever.
const MOST_STEPS: usize = 100_000;

/// Rates of a sample in relation to those of the run, and the removal of the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct SampledRates {
    /// C over that of the case.
    pub faster: f64,
    /// m less that of the case.
    pub steeper: f64,
    pub shares: SampledShares,
    pub removal: Removal,
    /// Rate (mm per axle) below which growth stops; zero where the surface is removed.
    pub arrest_rate: f64,
}

impl SampledRates {
    /// The rates of the case.
    pub fn of_case(tonnes: f64, removal: Removal) -> Self {
        let shares = SampledShares::of(&[], [1.0; MOST_WHEELS], tonnes);
        Self { faster: 1.0, steeper: 0.0, shares, removal, arrest_rate: 0.0 }
    }

    /// The rate over that of the case.
    fn factor(&self, state: &State, shares: &WheelShares) -> f64 {
        let steeper = match self.steeper {
            0.0 => 1.0,
            steeper => (state.delta_keq.max(1e-3) / PIVOT).powf(steeper),
        };
        self.faster * steeper * self.shares.factor(shares)
    }
}

/// Shares of the wheels of a mix in a sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct SampledShares {
    /// Each over that of the case; as many as there are wheels, none for one wheel.
    factors: [f64; MOST_WHEELS],
    wheels: usize,
    /// Mean load of an axle, t.
    pub tonnes: f64,
}

impl SampledShares {
    /// The shares of `mix`, each multiplied by its member of `factors` and then normalised to a sum
    /// of 1; `tonnes` is the mean load of an axle in the case.
    pub fn of(mix: &[MixInfo], factors: [f64; MOST_WHEELS], tonnes: f64) -> Self {
        let sum: f64 = mix.iter().zip(factors).map(|(wheel, factor)| wheel.share * factor).sum();
        let factors = factors.map(|factor| if sum > 0.0 { factor / sum } else { 1.0 });
        let loads: Option<f64> = mix
            .iter()
            .zip(factors)
            .map(|(wheel, factor)| Some(wheel.share * factor * wheel.axle_load?))
            .sum();
        let is_mix = mix.len() > 1;
        Self { factors, wheels: mix.len(), tonnes: loads.filter(|_| is_mix).unwrap_or(tonnes) }
    }

    fn factor(&self, shares: &WheelShares) -> f64 {
        let shares = shares.values();
        if self.wheels < 2 || shares.iter().sum::<f64>() == 0.0 {
            return 1.0;
        }
        shares.iter().zip(self.factors).map(|(share, factor)| share * factor).sum()
    }
}

/// Limits that end a walk, and sizes that are looked for meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub critical_depth: Option<f64>,
    pub critical_length: Option<f64>,
    /// K_Ic (MPa√m) of a sample; none where the fractures of the courses count.
    pub toughness: Option<f64>,
    pub detectable_depth: Option<f64>,
    pub detectable_length: Option<f64>,
    /// A mode that does not end the walk.
    pub ignored: Option<FailureMode>,
}

/// How a walk ends.
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

/// A walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Walked {
    pub fate: Fate,
    /// Million gross tonnes until the crack is detectable; infinite where it does not become so.
    pub detected: f64,
    /// Whether the crack grows into the depth at first.
    pub grows: bool,
    /// Where the walk ended.
    pub end: Spot,
}

/// Depths of a sample over traffic.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Track {
    /// Million gross tonnes.
    pub mgt: Vec<f64>,
    /// Depth of the deepest tip, mm.
    pub depth: Vec<f64>,
    /// Depth of the crack that is looked for, mm.
    pub own_depth: Vec<f64>,
}

impl Track {
    fn clear(&mut self) {
        self.mgt.clear();
        self.depth.clear();
        self.own_depth.clear();
    }

    fn push(&mut self, mgt: f64, state: &State) {
        self.mgt.push(mgt);
        self.depth.push(state.reach - state.removed);
        self.own_depth.push(state.own_reach - state.removed);
    }

    /// The end of `part`, and before it the place where the crack looked for becomes as deep as
    /// `found_from` (mm).
    fn follow(&mut self, part: &Part, found_from: Option<f64>) {
        if let Some(found) = found_from {
            let own = |state: &State| state.own_reach - state.removed;
            let (from, to) = (own(&part.from), own(&part.to));
            let share = (found - from) / (to - from);
            if from < found && found < to {
                let between = part.from.to(&part.to, share);
                self.mgt.push(part.at(share));
                self.depth.push(between.reach - between.removed);
                self.own_depth.push(found);
            }
        }
        self.push(part.mgt[1], &part.to);
    }

    /// The depth of the crack that is looked for over traffic; two points at one tonnage are a
    /// grinding.
    pub fn own_depths(&self) -> impl Iterator<Item = (f64, f64)> {
        self.mgt.iter().copied().zip(self.own_depth.iter().copied())
    }

    /// The value of `of`, one for each tonnage, at `mgt`, where the walk ended with `fate`:
    /// infinite once it is not known or the rail has failed.
    pub fn at(&self, of: &[f64], mgt: f64, fate: Fate) -> f64 {
        let next = self.mgt.partition_point(|here| *here <= mgt);
        match (next.checked_sub(1), self.mgt.get(next)) {
            (Some(i), Some(after)) => {
                let share = (mgt - self.mgt[i]) / (after - self.mgt[i]);
                of[i] + share * (of[i + 1] - of[i])
            }
            (Some(i), None) if self.mgt[i] == mgt => of[i],
            (Some(i), None) => match fate {
                Fate::Worn(_) | Fate::Replaced(_) => 0.0,
                Fate::Rests => of[i],
                Fate::Fails(..) | Fate::Outlives(_) => f64::INFINITY,
            },
            (None, _) => of.first().copied().unwrap_or(0.0),
        }
    }
}

/// Ways through a family of courses.
#[derive(Debug, Clone)]
pub(super) struct Walk<'a> {
    family: &'a Family,
    /// For each cell of the grid, the tonnage of the run over that of the rule.
    corrections: Vec<f64>,
    /// Tonnage of a cell in the run where the rule has none, million gross tonnes.
    waits: Vec<f64>,
}

/// A part of a walk from one state to another.
struct Part {
    from: State,
    to: State,
    /// 1/(ds/dN), MGT per mm, at both ends.
    slowness: [f64; 2],
    mgt: [f64; 2],
    work: [f64; 2],
}

impl Part {
    /// No way at all: `state` at `mgt`, with growth and removal of `work` (mm).
    fn at_rest(state: State, mgt: f64, work: f64) -> Self {
        Self { from: state, to: state, slowness: [0.0; 2], mgt: [mgt; 2], work: [work; 2] }
    }

    /// The tonnage at which `share` of the way lies behind: the slowness is linear along it.
    fn at(&self, share: f64) -> f64 {
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
    fn reaches(&self, quantity: impl Fn(&State) -> f64, value: f64) -> Option<f64> {
        let (from, to) = (quantity(&self.from), quantity(&self.to));
        if from >= value {
            return Some(self.mgt[0]);
        }
        (to >= value).then(|| self.at((value - from) / (to - from)))
    }

    /// The tonnage at which growth and removal have come to `work`.
    fn passes(&self, work: f64) -> Option<f64> {
        let [from, to] = self.work;
        if work > to {
            return None;
        }
        Some(if to > from { self.at(((work - from) / (to - from)).clamp(0.0, 1.0)) } else { self.mgt[1] })
    }
}

/// Iterations of the removal at the end of a cell: each reduces its error by two orders or more.
const ITERATIONS: usize = 4;
/// Critical lengths and depths are reached up to rounding.
const REACHED: f64 = 1e-8;

impl Limits {
    /// The first end of a walk on `part`, with the `events` of its courses.
    fn first(&self, part: &Part, events: &[Option<f64>; EVENTS.len()]) -> Option<Fate> {
        let depth = self.critical_depth.map(|depth| depth * (1.0 - REACHED));
        let depth = depth.and_then(|depth| part.reaches(|state| state.reach - state.removed, depth));
        let length = self.critical_length.map(|length| length * (1.0 - REACHED));
        let length = length.and_then(|length| part.reaches(|state| state.length, length));
        let breaks = self.toughness.and_then(|toughness| part.reaches(|state| state.largest_k1, toughness));
        let found =
            [(FailureMode::Depth, depth), (FailureMode::Length, length), (FailureMode::Fracture, breaks)];
        let found = found.into_iter().filter_map(|(mode, mgt)| Some((Some(mode), mgt?)));
        let counts =
            |mode: &Option<FailureMode>| self.toughness.is_none() || *mode != Some(FailureMode::Fracture);
        let of_courses = EVENTS.iter().zip(events).filter(|(mode, _)| counts(mode));
        let of_courses = of_courses.filter_map(|(mode, work)| Some((*mode, part.passes((*work)?)?)));
        let first = found
            .chain(of_courses)
            .filter(|(mode, _)| mode.is_none() || *mode != self.ignored)
            .reduce(|a, b| if b.1 < a.1 { b } else { a })?;
        Some(match first {
            (Some(mode), mgt) => Fate::Fails(mode, mgt),
            (None, mgt) => Fate::Worn(mgt),
        })
    }

    fn detects(&self, part: &Part) -> Option<f64> {
        match (self.detectable_depth, self.detectable_length) {
            (Some(depth), _) => part.reaches(|state| state.own_reach - state.removed, depth),
            (None, Some(length)) => part.reaches(|state| state.own_length, length),
            (None, None) => Some(0.0),
        }
    }
}

impl<'a> Walk<'a> {
    /// Walks through `family`, whose run has axles of `tonnes` and loses `removal` of its surface.
    pub fn through(family: &'a Family, tonnes: f64, removal: Removal) -> Self {
        let rates = SampledRates::of_case(tonnes, removal);
        let cells = family.places().saturating_sub(1);
        let (mut corrections, mut waits) = (vec![1.0; cells], vec![0.0; cells]);
        for cell in 0..cells {
            let states = family.of_run(cell).zip(family.of_run(cell + 1));
            let (Some(axles), Some((from, to))) = (family.axles(cell), states) else { continue };
            let mgt = 1e-6 * tonnes * axles;
            let slow = |state: &State| slowness(1e6 / tonnes * state.rate * rates.faster + removal.wear);
            let work = [0.0, 1.0].map(|share| family.work(Spot { cell, share }));
            let ruled = 0.5 * (slow(&from) + slow(&to)) * (work[1] - work[0]);
            if ruled > 0.0 {
                corrections[cell] = mgt / ruled;
            } else {
                waits[cell] = mgt;
            }
        }
        Self { family, corrections, waits }
    }

    /// The walk of a crack with `rates` up to the first of `limits`; its depths go to `track`.
    pub fn walk(&self, rates: &SampledRates, limits: &Limits, track: &mut Track) -> Walked {
        track.clear();
        let per_mgt = 1e6 / rates.shares.tonnes;
        let removal = rates.removal;
        let mut spot = Spot { cell: 0, share: 0.0 };
        let mut walked = Walked { fate: Fate::Rests, detected: f64::INFINITY, grows: false, end: spot };
        let Some((mut state, mut shares)) = self.family.state(spot, 0.0) else { return walked };
        let (mut mgt, mut done) = (0.0, 0);
        track.push(mgt, &state);
        // A rail that fails at once has no part of a way.
        let begin = Part::at_rest(state, mgt, self.family.work(spot));
        if let Some(fate) = limits.first(&begin, &self.family.events(spot, state.removed)) {
            let detected = limits.detects(&begin).unwrap_or(f64::INFINITY);
            return Walked { fate, detected, ..walked };
        }
        for step in 0..MOST_STEPS {
            let rate = state.rate * rates.factor(&state, shares);
            if rate < rates.arrest_rate {
                return Walked { fate: Fate::Rests, end: spot, ..walked };
            }
            let speed = per_mgt * rate + removal.wear;
            let next = removal.next(done);
            let due = next <= mgt * (1.0 + ROUNDING);
            let target = Spot { cell: spot.cell + 1, share: 0.0 };
            let is_last = target.cell >= self.family.places();
            let here = self.family.work(spot);
            if !due && is_last {
                let fate = self.end(spot, &state, mgt);
                return Walked { fate, end: spot, ..walked };
            }
            // The rest of this cell, up to the next grinding.
            let mut part = Part {
                from: state,
                to: state,
                slowness: [slowness(speed); 2],
                mgt: [mgt; 2],
                work: [here; 2],
            };
            if !due {
                let there = self.family.work(target);
                let cell = spot.cell;
                let wait = self.waits[cell];
                // The removal at the end of the cell follows from the tonnage, and this from it.
                let mut passed = if speed > 0.0 { (there - here) / speed } else { 0.0 };
                for _ in 0..if removal.wear > 0.0 { ITERATIONS } else { 1 } {
                    let gone = state.removed + removal.wear * passed;
                    let Some((ahead, of_wheels)) = self.family.state(target, gone) else {
                        let fate = self.end(spot, &state, mgt);
                        return Walked { fate, end: spot, ..walked };
                    };
                    if step == 0 {
                        let sinks = (ahead.reach - state.reach) / (there - here);
                        walked.grows = is_growing(sinks * speed, removal);
                    }
                    let end = per_mgt * ahead.rate * rates.factor(&ahead, of_wheels) + removal.wear;
                    part.slowness = [slowness(speed), slowness(end)];
                    let ruled = 0.5 * (part.slowness[0] + part.slowness[1]) * (there - here);
                    passed = if ruled > 0.0 {
                        self.corrections[cell] * ruled
                    } else if wait > 0.0 {
                        wait / rates.faster
                    } else {
                        f64::INFINITY
                    };
                    if passed == f64::INFINITY {
                        break;
                    }
                }
                let until = mgt + passed;
                let stays = next <= until * (1.0 - ROUNDING);
                if passed == f64::INFINITY && next == f64::INFINITY {
                    return Walked { fate: Fate::Rests, end: spot, ..walked };
                }
                if stays {
                    let share = if passed.is_finite() { (next - mgt) / passed } else { 0.0 };
                    let gone = state.removed + removal.wear * (next - mgt);
                    let at = here + share * (there - here);
                    let Some((spot_at, (to, to_shares))) =
                        self.family.spot(at).and_then(|spot| Some((spot, self.family.state(spot, gone)?)))
                    else {
                        return Walked { fate: Fate::Outlives(mgt), end: spot, ..walked };
                    };
                    part.to = to;
                    part.mgt[1] = next;
                    part.work[1] = at;
                    spot = spot_at;
                    shares = to_shares;
                } else {
                    let gone = state.removed + removal.wear * passed;
                    let Some((to, to_shares)) = self.family.state(target, gone) else {
                        return Walked { fate: Fate::Outlives(mgt), end: spot, ..walked };
                    };
                    part.to = to;
                    part.mgt[1] = until;
                    part.work[1] = there;
                    spot = target;
                    shares = to_shares;
                }
                state = part.to;
                mgt = part.mgt[1];
            }
            let events = self.family.events(spot, state.removed);
            if walked.detected == f64::INFINITY {
                walked.detected = limits.detects(&part).unwrap_or(f64::INFINITY);
            }
            track.follow(&part, limits.detectable_depth);
            let replaced = removal.limit.and_then(|limit| part.reaches(|state| state.removed, limit));
            if let Some(fate) = earlier(limits.first(&part, &events), replaced) {
                let (Fate::Fails(_, at) | Fate::Worn(at) | Fate::Replaced(at)) = fate else { continue };
                if walked.detected > at {
                    walked.detected = f64::INFINITY;
                }
                return Walked { fate, end: spot, ..walked };
            }
            if state.reach <= state.removed {
                return Walked { fate: Fate::Worn(mgt), end: spot, ..walked };
            }
            // The grinding that is due.
            if let Some((depth, ..)) = removal.grinding
                && removal.next(done) <= mgt * (1.0 + ROUNDING)
            {
                done += 1;
                let gone = state.removed + depth;
                let after = self.family.spot(self.family.work(spot) + depth);
                let after = after.and_then(|spot| Some((spot, self.family.state(spot, gone)?)));
                if state.reach <= gone {
                    return Walked { fate: Fate::Worn(mgt), end: spot, ..walked };
                }
                let Some((at, (ground, ground_shares))) = after else {
                    let fate = self.end(spot, &state, mgt);
                    return Walked { fate, end: spot, ..walked };
                };
                (spot, state, shares) = (at, ground, ground_shares);
                track.push(mgt, &state);
                let part = Part::at_rest(state, mgt, self.family.work(spot));
                if let Some(fate @ Fate::Worn(_)) =
                    limits.first(&part, &self.family.events(spot, state.removed))
                {
                    return Walked { fate, end: spot, ..walked };
                }
                if removal.limit.is_some_and(|limit| state.removed >= limit) {
                    return Walked { fate: Fate::Replaced(mgt), end: spot, ..walked };
                }
            }
        }
        Walked { fate: Fate::Outlives(mgt), end: spot, ..walked }
    }

    /// How a walk ends at `spot`, where no course goes on.
    fn end(&self, spot: Spot, state: &State, mgt: f64) -> Fate {
        match self.family.end(spot, state.removed) {
            CourseEnd::Rest => Fate::Rests,
            CourseEnd::Worn => Fate::Worn(mgt),
            CourseEnd::Unknown => Fate::Outlives(mgt),
        }
    }
}

/// The earlier of the end `first` of a part and the replacement of the rail.
fn earlier(first: Option<Fate>, replaced: Option<f64>) -> Option<Fate> {
    match (first, replaced) {
        (Some(Fate::Fails(_, at) | Fate::Worn(at)), Some(replaced)) if at <= replaced => first,
        (_, Some(replaced)) => Some(Fate::Replaced(replaced)),
        (first, None) => first,
    }
}

/// Whether the growth into the depth (mm per MGT) outpaces the removal in the mean.
fn is_growing(deeper: f64, removal: Removal) -> bool {
    let ground = removal.grinding.map_or(0.0, |(depth, interval, _)| depth / interval);
    deeper > removal.wear + ground
}

/// 1/speed; zero at rest, where traffic passes without growth.
fn slowness(speed: f64) -> f64 {
    if speed > 0.0 { speed.recip() } else { 0.0 }
}

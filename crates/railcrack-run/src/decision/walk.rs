//! The way of a sampled crack through a family of courses.

use super::course::CourseEnd;
use super::events::{Fate, Limits, Part};
use super::family::{CracksAt, EVENTS, Family, Spot, State};
use super::risk::interpolated;
use super::window::{Visibility, Window};
use crate::log::WheelInfo;
use railcrack::growth::{Axles, Grinding, MOST_WHEELS, Mgt, SurfaceRemoval, WheelShares};
use std::ops::ControlFlow;

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
    pub removal: SurfaceRemoval<Mgt>,
    /// Rate (mm per axle) below which growth stops; zero where the surface is removed.
    pub arrest_rate: f64,
}

impl SampledRates {
    /// The rates of the case.
    pub fn of_case(tonnes: f64, removal: SurfaceRemoval<Mgt>) -> Self {
        let shares = SampledShares::of(&[], [1.0; MOST_WHEELS], tonnes);
        Self { faster: 1.0, steeper: 0.0, shares, removal, arrest_rate: 0.0 }
    }

    /// The rate over that of the case.
    fn factor(&self, cracks: &CracksAt<'_>) -> f64 {
        let steeper = match self.steeper {
            0.0 => 1.0,
            steeper => (cracks.state.delta_keq.max(1e-3) / PIVOT).powf(steeper),
        };
        self.faster * steeper * self.shares.factor(cracks.shares)
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
    pub fn of(mix: &[WheelInfo], factors: [f64; MOST_WHEELS], tonnes: f64) -> Self {
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

/// A walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Walked {
    pub fate: Fate,
    /// The traffic in which an inspection can find the crack; none where it never becomes
    /// detectable.
    pub window: Option<Window>,
    /// Whether the crack grows into the depth at first.
    pub grows: bool,
}

/// Depth (mm) of the crack that is looked for in a sample, over million gross tonnes; two points at
/// one tonnage are a grinding.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Track(Vec<(f64, f64)>);

impl Track {
    fn push(&mut self, mgt: f64, state: &State) {
        self.0.push((mgt, state.own_depth()));
    }

    /// The end of `part`, and before it the place where the crack becomes as deep as `found_from`
    /// (mm).
    fn follow(&mut self, part: &Part, found_from: Option<f64>) {
        let (from, to) = (part.from.own_depth(), part.to.own_depth());
        if let Some(found) = found_from.filter(|found| from < *found && *found < to) {
            self.0.push((part.at((found - from) / (to - from)), found));
        }
        self.push(part.mgt[1], &part.to);
    }

    /// The points.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.0
    }

    /// The depth at `mgt`, where the walk ended with `fate`: infinite once it is not known or the
    /// rail has failed.
    pub fn at(&self, mgt: f64, fate: Fate) -> f64 {
        match self.0.last() {
            Some(last) if last.0 < mgt => match fate {
                Fate::Worn(_) | Fate::Replaced(_) => 0.0,
                Fate::Rests => last.1,
                Fate::Fails(..) | Fate::Outlives(_) => f64::INFINITY,
            },
            _ => interpolated(&self.0, mgt).or(self.0.first().map(|first| first.1)).unwrap_or(0.0),
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

/// Iterations of the removal at the end of a cell: each reduces its error by two orders or more,
/// and by as much as the one before, to which the last is extrapolated.
const ITERATIONS: usize = 2;

impl<'a> Walk<'a> {
    /// Walks through `family`, whose run has axles of `tonnes` and loses `removal` of its surface.
    pub fn through(family: &'a Family, tonnes: f64, removal: SurfaceRemoval<Mgt>) -> Self {
        let rates = SampledRates::of_case(tonnes, removal);
        let cells = family.places().saturating_sub(1);
        let (mut corrections, mut waits) = (vec![1.0; cells], vec![0.0; cells]);
        for cell in 0..cells {
            let states = family.of_run(cell).zip(family.of_run(cell + 1));
            let (Some(axles), Some((from, to))) = (family.axles(cell), states) else { continue };
            let Mgt(mgt) = Axles(axles).mgt(tonnes);
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
        track.0.clear();
        let Some(cracks) = self.family.cracks(Spot { cell: 0, share: 0.0 }, 0.0) else {
            return Walked { fate: Fate::Rests, window: None, grows: false };
        };
        track.push(0.0, &cracks.state);
        let (mgt, grindings, visibility, grows) = (0.0, 0, Visibility::default(), None);
        let mut walker =
            Walker { walk: self, rates, limits, track, cracks, mgt, grindings, visibility, grows };
        let fate = walker.fails_at_once().unwrap_or_else(|| walker.goes_on());
        let window = walker.visibility.window(fate.mgt());
        Walked { fate, window, grows: walker.grows.unwrap_or(false) }
    }
}

/// A crack on its walk.
struct Walker<'a> {
    walk: &'a Walk<'a>,
    rates: &'a SampledRates,
    limits: &'a Limits,
    track: &'a mut Track,
    /// Where it is.
    cracks: CracksAt<'a>,
    /// Million gross tonnes so far.
    mgt: f64,
    /// Grindings so far.
    grindings: usize,
    /// When it can be found.
    visibility: Visibility,
    /// Whether the crack grows into the depth at first, once it is known.
    grows: Option<bool>,
}

/// The way over a cell of the grid.
struct Crossing {
    /// Its traffic, million gross tonnes; infinite for a crack at rest.
    mgt: f64,
    /// 1/(ds/dN), MGT per mm, at both ends.
    slowness: [f64; 2],
}

impl Walker<'_> {
    /// The failure of a rail that fails before any traffic.
    fn fails_at_once(&mut self) -> Option<Fate> {
        let begin = self.rest();
        let fate = self.limits.first(&begin, &self.events())?;
        self.visibility.follow(&begin, self.limits, fate.mgt());
        Some(fate)
    }

    /// The walk to its end.
    fn goes_on(&mut self) -> Fate {
        for _ in 0..MOST_STEPS {
            if let ControlFlow::Break(fate) = self.step() {
                return fate;
            }
        }
        Fate::Outlives(self.mgt)
    }

    /// The rest of a cell or up to the next grinding, and the grinding if it is due then.
    fn step(&mut self) -> ControlFlow<Fate> {
        let part = if self.is_grinding_due() { self.rest() } else { self.grow()? };
        self.pass(&part)?;
        if self.is_grinding_due() { self.grind() } else { ControlFlow::Continue(()) }
    }

    /// The way over the rest of this cell, or up to the next grinding.
    fn grow(&mut self) -> ControlFlow<Fate, Part> {
        let (family, mgt) = (self.walk.family, self.mgt);
        let CracksAt { spot, state, .. } = self.cracks;
        let target = Spot { cell: spot.cell + 1, share: 0.0 };
        let rate = state.rate * self.rates.factor(&self.cracks);
        if rate < self.rates.arrest_rate {
            return ControlFlow::Break(Fate::Rests);
        }
        if target.cell >= family.places() {
            return ControlFlow::Break(self.end_of_course());
        }
        let work = [spot, target].map(|spot| family.work(spot));
        let crossing = self.cross(target, rate, work)?;
        let next = self.next_grinding();
        if crossing.mgt == f64::INFINITY && next == f64::INFINITY {
            return ControlFlow::Break(Fate::Rests);
        }
        let wear = self.rates.removal.wear;
        let (until, to, cracks) = if next <= (mgt + crossing.mgt) * (1.0 - ROUNDING) {
            let share = if crossing.mgt.is_finite() { (next - mgt) / crossing.mgt } else { 0.0 };
            let to = work[0] + share * (work[1] - work[0]);
            (next, to, family.cracks_with(to, state.removed + wear * (next - mgt)))
        } else {
            let removed = state.removed + wear * crossing.mgt;
            (mgt + crossing.mgt, work[1], family.cracks(target, removed))
        };
        let Some(cracks) = cracks else { return ControlFlow::Break(Fate::Outlives(mgt)) };
        (self.cracks, self.mgt) = (cracks, until);
        ControlFlow::Continue(Part {
            from: state,
            to: cracks.state,
            slowness: crossing.slowness,
            mgt: [mgt, until],
            work: [work[0], to],
        })
    }

    /// The way from here, where the crack grows by `rate` (mm per axle), to `target`; growth and
    /// removal are `work` (mm) at both. The removal at its end follows from its traffic, and this
    /// from the removal.
    fn cross(&mut self, target: Spot, rate: f64, work: [f64; 2]) -> ControlFlow<Fate, Crossing> {
        let SampledRates { faster, removal, .. } = *self.rates;
        let per_mgt = 1e6 / self.rates.shares.tonnes;
        let (cell, state, length) = (self.cracks.spot.cell, self.cracks.state, work[1] - work[0]);
        let wait = self.walk.waits[cell];
        let speed = per_mgt * rate + removal.wear;
        let begins = self.grows.is_none();
        let mut crossing =
            Crossing { mgt: if speed > 0.0 { length / speed } else { 0.0 }, slowness: [slowness(speed); 2] };
        let mut earlier = [crossing.mgt; 2];
        for _ in 0..if removal.wear > 0.0 { ITERATIONS } else { 1 } {
            earlier = [earlier[1], crossing.mgt];
            let gone = state.removed + removal.wear * crossing.mgt;
            let Some(ahead) = self.walk.family.cracks(target, gone) else {
                return ControlFlow::Break(self.end_of_course());
            };
            if begins {
                let sinks = (ahead.state.reach - state.reach) / length;
                self.grows = Some(sinks * speed > removal.mean_rate());
            }
            let end = per_mgt * ahead.state.rate * self.rates.factor(&ahead) + removal.wear;
            crossing.slowness[1] = slowness(end);
            let ruled = 0.5 * (crossing.slowness[0] + crossing.slowness[1]) * length;
            crossing.mgt = if ruled > 0.0 {
                self.walk.corrections[cell] * ruled
            } else if wait > 0.0 {
                wait / faster
            } else {
                f64::INFINITY
            };
            if crossing.mgt == f64::INFINITY {
                break;
            }
        }
        let [before, last] = [earlier[1] - earlier[0], crossing.mgt - earlier[1]];
        if last.abs() < 0.5 * before.abs() {
            crossing.mgt += last * last / (before - last);
        }
        ControlFlow::Continue(crossing)
    }

    /// The events on `part`, which ends here.
    fn pass(&mut self, part: &Part) -> ControlFlow<Fate> {
        self.track.follow(part, self.limits.detectable_depth);
        let replaced = self.rates.removal.reached_limit();
        let replaced = replaced.and_then(|limit| part.reaches(|state| state.removed, limit));
        let first = self.limits.first(part, &self.events());
        let fate = first.into_iter().chain(replaced.map(Fate::Replaced)).reduce(Fate::or_earlier);
        self.visibility.follow(part, self.limits, fate.map_or(f64::INFINITY, Fate::mgt));
        if let Some(fate) = fate {
            return ControlFlow::Break(fate);
        }
        if self.cracks.state.depth() <= 0.0 {
            return ControlFlow::Break(Fate::Worn(self.mgt));
        }
        ControlFlow::Continue(())
    }

    /// The grinding that is due.
    fn grind(&mut self) -> ControlFlow<Fate> {
        let Some(Grinding { depth, .. }) = self.rates.removal.grinding else {
            return ControlFlow::Continue(());
        };
        self.grindings += 1;
        let family = self.walk.family;
        let CracksAt { spot, state, .. } = self.cracks;
        let gone = state.removed + depth;
        if state.reach <= gone {
            return ControlFlow::Break(Fate::Worn(self.mgt));
        }
        let Some(ground) = family.cracks_with(family.work(spot) + depth, gone) else {
            return ControlFlow::Break(self.end_of_course());
        };
        self.cracks = ground;
        self.track.push(self.mgt, &ground.state);
        if let Some(fate @ Fate::Worn(_)) = self.limits.first(&self.rest(), &self.events()) {
            return ControlFlow::Break(fate);
        }
        match self.rates.removal.reached_limit() {
            Some(limit) if ground.state.removed >= limit => ControlFlow::Break(Fate::Replaced(self.mgt)),
            _ => ControlFlow::Continue(()),
        }
    }

    /// No way at all, from here.
    fn rest(&self) -> Part {
        Part::at_rest(self.cracks.state, self.mgt, self.walk.family.work(self.cracks.spot))
    }

    /// Where, in growth and removal, the events of the courses take place.
    fn events(&self) -> [Option<f64>; EVENTS.len()] {
        self.walk.family.events(self.cracks.spot, self.cracks.state.removed)
    }

    /// Million gross tonnes until the next grinding; infinite without any.
    fn next_grinding(&self) -> f64 {
        self.rates.removal.next_grinding(self.grindings).0
    }

    fn is_grinding_due(&self) -> bool {
        self.next_grinding() <= self.mgt * (1.0 + ROUNDING)
    }

    /// How the walk ends here, where no course goes on.
    fn end_of_course(&self) -> Fate {
        match self.walk.family.end(self.cracks.spot, self.cracks.state.removed) {
            CourseEnd::Rest => Fate::Rests,
            CourseEnd::Worn => Fate::Worn(self.mgt),
            CourseEnd::Unknown => Fate::Outlives(self.mgt),
        }
    }
}

/// 1/speed; zero at rest, where traffic passes without growth.
fn slowness(speed: f64) -> f64 {
    if speed > 0.0 { speed.recip() } else { 0.0 }
}

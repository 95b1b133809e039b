//! Courses of one rail that grow at different speeds, between which samples are made.
//!
//! Where the surface is removed, a crack depends on how much of it was removed while it grew:
//! depth, length and rates are functions of two coordinates, the growth and removal s that lie
//! behind, and the part r of it that is removal. Each run gives them along one curve r(s); a faster
//! one has less removal at the same s. Between two curves they are interpolated in r. Without
//! removal r is zero, and the run itself is the only curve.

use super::course::{Course, CourseEnd, CoursePoint, FailureMode};
use railcrack::growth::WheelShares;

/// States on the common grid that are closer than this (mm) are one.
const SAME: f64 = 1e-9;
/// A course that ends with a failure is continued along its last part by this fraction of the way,
/// so that slower ones can be compared with it.
const CONTINUED: f64 = 0.3;
/// How far beyond the outermost curves their difference is continued.
const BEYOND: f64 = 1.5;

/// The cracks of a course at a place.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct State {
    /// Removal, mm.
    pub removed: f64,
    /// The largest rate, mm per axle, with the growth law of the case.
    pub rate: f64,
    pub delta_keq: f64,
    pub largest_k1: f64,
    /// Depth below the first surface of the deepest tip, and of that of the crack looked for, mm.
    pub reach: f64,
    pub own_reach: f64,
    /// Length of the longest crack, and of the crack looked for, mm.
    pub length: f64,
    pub own_length: f64,
}

impl State {
    fn of(point: &CoursePoint) -> Self {
        Self {
            removed: point.removed,
            rate: point.rate,
            delta_keq: point.delta_keq,
            largest_k1: point.largest_k1,
            reach: point.depth + point.removed,
            own_reach: point.own_depth + point.removed,
            length: point.length,
            own_length: point.own_length,
        }
    }

    /// Depth of the deepest tip, mm.
    pub fn depth(&self) -> f64 {
        self.reach - self.removed
    }

    /// Depth of the deepest tip of the crack looked for, mm.
    pub fn own_depth(&self) -> f64 {
        self.own_reach - self.removed
    }

    /// Between `self` at 0 and `other` at 1; also beyond.
    pub fn to(&self, other: &Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + share * (b - a);
        let positive = |a: f64, b: f64| between(a, b).clamp(0.2 * a.min(b), 5.0 * a.max(b));
        Self {
            removed: between(self.removed, other.removed),
            rate: positive(self.rate, other.rate),
            delta_keq: positive(self.delta_keq, other.delta_keq),
            largest_k1: positive(self.largest_k1, other.largest_k1),
            reach: between(self.reach, other.reach),
            own_reach: between(self.own_reach, other.own_reach),
            length: between(self.length, other.length),
            own_length: between(self.own_length, other.own_length),
        }
    }
}

/// Events of a curve: modes of failure, and a crack of which nothing is left.
pub(super) const EVENTS: [Option<FailureMode>; 4] =
    [Some(FailureMode::Fracture), Some(FailureMode::Spall), Some(FailureMode::Detached), None];

/// A curve on the common grid.
#[derive(Debug, Clone)]
struct Curve {
    /// At each place of the grid as far as the course goes.
    states: Vec<State>,
    shares: Vec<WheelShares>,
    /// The place of each of [`EVENTS`].
    events: [Option<f64>; EVENTS.len()],
    end: CourseEnd,
}

/// Courses of one rail at different speeds, the fastest first.
#[derive(Debug, Clone)]
pub(crate) struct Family {
    /// Growth and removal, mm, ascending.
    grid: Vec<f64>,
    curves: Vec<Curve>,
    /// The run among them.
    nominal: usize,
    /// Axles of the run from each place of the grid to the next, as far as the run goes; none where
    /// it is ground.
    axles: Vec<Option<f64>>,
}

/// A place on the common grid: a cell, and the fraction of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    pub cell: usize,
    pub share: f64,
}

/// The cracks at a place on the common grid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CracksAt<'a> {
    pub spot: Spot,
    pub state: State,
    /// Shares of the wheels in the rate, those of the nearest place.
    pub shares: &'a WheelShares,
}

/// The neighbours of a state and its place between them.
#[derive(Debug, Clone, Copy)]
struct Between {
    faster: usize,
    slower: usize,
    share: f64,
}

impl Family {
    /// The run `nominal` alone.
    pub fn alone(nominal: &Course) -> Self {
        Self::of(nominal, &[], &[])
    }

    /// The run `nominal`, and runs of the same rail that are `faster` and `slower`, the fastest
    /// first in each.
    pub fn of(nominal: &Course, faster: &[&Course], slower: &[&Course]) -> Self {
        let all: Vec<&Course> =
            faster.iter().copied().chain([nominal]).chain(slower.iter().copied()).collect();
        let (mut grid, axles) = places_of(nominal);
        let last = grid.last().copied().unwrap_or(0.0);
        let mut later: Vec<f64> =
            all.iter().flat_map(|course| &course.points).map(|point| point.work).collect();
        later.retain(|work| *work > last);
        later.sort_by(f64::total_cmp);
        for work in later {
            if work - grid.last().copied().unwrap_or(0.0) > SAME {
                grid.push(work);
            }
        }
        let curves = all.iter().map(|course| Curve::of(course, &grid)).collect();
        Self { grid, curves, nominal: faster.len(), axles }
    }

    /// Number of places on the grid.
    pub fn places(&self) -> usize {
        self.grid.len()
    }

    /// The place `work`, mm.
    fn spot(&self, work: f64) -> Option<Spot> {
        let next = self.grid.partition_point(|place| *place <= work + SAME);
        let cell = next.checked_sub(1)?;
        if next == self.grid.len() {
            return (work <= self.grid[cell] + SAME).then_some(Spot { cell, share: 0.0 });
        }
        let share = (work - self.grid[cell]) / (self.grid[next] - self.grid[cell]);
        Some(Spot { cell, share: share.clamp(0.0, 1.0) })
    }

    /// Growth and removal at `spot`, mm.
    pub fn work(&self, spot: Spot) -> f64 {
        let at = self.grid[spot.cell];
        self.grid.get(spot.cell + 1).map_or(at, |next| at + spot.share * (next - at))
    }

    /// Axles of the run over the cell of the grid; none beyond its end and where it is ground.
    pub fn axles(&self, cell: usize) -> Option<f64> {
        self.axles.get(cell).copied().flatten()
    }

    /// The state of the run at the start of a cell; none beyond its end.
    pub fn of_run(&self, place: usize) -> Option<State> {
        self.curves[self.nominal].states.get(place).copied()
    }

    /// The cracks at `spot` with `removed` (mm) gone; none where no course goes that far.
    pub fn cracks(&self, spot: Spot, removed: f64) -> Option<CracksAt<'_>> {
        let Between { faster, slower, share } = self.between(spot, removed)?;
        let near = if share > 0.5 { slower } else { faster };
        let shares = self.curves[near].shares.get(spot.cell)?;
        let fast = self.curves[faster].at(spot)?;
        let state = match faster == slower {
            true => fast,
            false => State { removed, ..fast.to(&self.curves[slower].at(spot)?, share) },
        };
        Some(CracksAt { spot, state, shares })
    }

    /// The cracks with growth and removal of `work` (mm), of which `removed` (mm) are removal; none
    /// where no course goes that far.
    pub fn cracks_with(&self, work: f64, removed: f64) -> Option<CracksAt<'_>> {
        self.cracks(self.spot(work)?, removed)
    }

    /// Where, in growth and removal, each of [`EVENTS`] takes place for a crack at `spot` with
    /// `removed` (mm) gone; none where it does not.
    pub fn events(&self, spot: Spot, removed: f64) -> [Option<f64>; EVENTS.len()] {
        let Some(Between { faster, slower, share }) = self.between(spot, removed) else {
            return [None; EVENTS.len()];
        };
        let (fast, slow) = (&self.curves[faster], &self.curves[slower]);
        std::array::from_fn(|i| match (fast.events[i], slow.events[i]) {
            (Some(fast), Some(slow)) => Some(fast + share * (slow - fast)),
            (event, _) if share <= 0.5 => event,
            (_, event) => event,
        })
    }

    /// The end of the nearest course.
    pub fn end(&self, spot: Spot, removed: f64) -> CourseEnd {
        let nearest = self.curves.iter().min_by(|a, b| {
            let apart = |curve: &Curve| {
                let last = spot.cell.min(curve.states.len().saturating_sub(1));
                curve.states.get(last).map_or(f64::INFINITY, |state| (state.removed - removed).abs())
            };
            apart(a).total_cmp(&apart(b))
        });
        nearest.map_or(CourseEnd::Unknown, |curve| curve.end)
    }

    /// The neighbours at `spot` of a crack with `removed` (mm) gone.
    fn between(&self, spot: Spot, removed: f64) -> Option<Between> {
        let one = |curve| Between { faster: curve, slower: curve, share: 0.0 };
        let there = |i: usize| Some((i, self.curves[i].removed_at(spot)?));
        // The run itself wherever it is passed: without scatter, samples are the run.
        if let Some((nominal, gone)) = there(self.nominal)
            && (self.curves.len() == 1 || (gone - removed).abs() <= SAME)
        {
            return Some(one(nominal));
        }
        let mut last: Option<(usize, f64)> = None;
        let mut earlier: Option<(usize, f64)> = None;
        for (i, gone) in (0..self.curves.len()).filter_map(there) {
            if gone >= removed && last.is_some() {
                break;
            }
            if last.is_none_or(|(_, before)| gone > before + SAME) {
                earlier = last;
            }
            last = Some((i, gone));
        }
        let (left, from) = last?;
        let next = (left + 1..self.curves.len()).filter_map(there).find(|(_, gone)| *gone > from + SAME);
        let (pair, other) = match (next, earlier) {
            (Some(next), _) => ((left, from), next),
            (None, Some(earlier)) => (earlier, (left, from)),
            (None, None) => return Some(one(left)),
        };
        let share = (removed - pair.1) / (other.1 - pair.1);
        let share = share.clamp(-BEYOND, 1.0 + BEYOND);
        Some(Between { faster: pair.0, slower: other.0, share })
    }
}

/// Growth and removal (mm) of each place of the run `course`, and its axles from each to the next;
/// none where it is ground.
fn places_of(course: &Course) -> (Vec<f64>, Vec<Option<f64>>) {
    let mut grid: Vec<f64> = course.points.first().map(|point| point.work).into_iter().collect();
    let mut axles = Vec::new();
    let mut passed = 0.0;
    for pair in course.points.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        passed += to.axles - from.axles;
        if to.work - grid.last().copied().unwrap_or(0.0) > SAME {
            let is_ground = to.axles == from.axles && to.removed > from.removed + SAME;
            grid.push(to.work);
            axles.push((!is_ground).then_some(passed));
            passed = 0.0;
        }
    }
    (grid, axles)
}

/// The state at `work` (mm) on the continued last part of `points`; none too far beyond it.
fn beyond(points: &[CoursePoint], work: f64) -> Option<State> {
    let (first, last) = (points.first()?, points.last()?);
    let earlier = points.iter().rev().find(|point| point.work < last.work - SAME)?;
    let share = (work - earlier.work) / (last.work - earlier.work);
    let is_near = work - last.work <= CONTINUED * (last.work - first.work);
    is_near.then(|| State::of(earlier).to(&State::of(last), share))
}

impl Curve {
    fn of(course: &Course, grid: &[f64]) -> Self {
        let points = &course.points;
        let (mut states, mut shares) = (Vec::with_capacity(grid.len()), Vec::new());
        let fails = course.end == CourseEnd::Unknown && course.event(None).is_none();
        let mut next = 0;
        for &work in grid {
            while next < points.len() && points[next].work <= work + SAME {
                next += 1;
            }
            let Some(before) = next.checked_sub(1).map(|i| &points[i]) else { continue };
            let state = match points.get(next) {
                Some(after) => {
                    let share = (work - before.work) / (after.work - before.work);
                    State::of(before).to(&State::of(after), share.clamp(0.0, 1.0))
                }
                None if work <= before.work + SAME => State::of(before),
                None => match beyond(points, work).filter(|_| fails) {
                    Some(state) => state,
                    None => break,
                },
            };
            states.push(state);
            shares.push(before.shares);
        }
        let events = EVENTS.map(|mode| course.event(mode).map(|event| event.work));
        Self { states, shares, events, end: course.end }
    }

    fn removed_at(&self, spot: Spot) -> Option<f64> {
        let here = self.states.get(spot.cell)?.removed;
        if spot.share == 0.0 {
            return Some(here);
        }
        Some(here + spot.share * (self.states.get(spot.cell + 1)?.removed - here))
    }

    fn at(&self, spot: Spot) -> Option<State> {
        let here = self.states.get(spot.cell)?;
        if spot.share == 0.0 {
            return Some(*here);
        }
        Some(here.to(self.states.get(spot.cell + 1)?, spot.share))
    }
}

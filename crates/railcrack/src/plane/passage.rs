//! Passages of the wheel over fixed cracks: residual stress, then passages until the history
//! repeats.

use super::face_load::{FaceLoad, LoadPhase, RailLoad};
use super::mouth_pressures::{MOST_CHANGES, MouthPressures, PressuresChange, Settling, covered, over_mouths};
use super::tip_sifs::{TipMark, TipSifs};
use crate::body::FacePoint;
use crate::contact::{
    ContactSolver, Coupling, FaceProblem, FaceSolution, FaceState, FluidModel, FluidState, Pocket,
    StepControl, Stepper, SteppingCounts, SteppingError, SurfaceState,
};
use crate::fracture::SifHistory;
use crate::growth::{
    FaceRecord, GroupsError, Memory, Observer, PassageError, PassageRecord, PassageSettings, Repeated,
    Repeats, SolverCounts, StabilisedPassage, output_positions, until_repeated,
};

/// [`super::stabilised_passage`] of all faces together, under a known load on the faces.
pub(super) fn passages_of_all(
    face_load: &FaceLoad,
    load: RailLoad,
    solver: &dyn ContactSolver,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    let problem = face_load.problem;
    let xc = output_positions(&settings.passage, load.wheel.bending(), &places(problem));
    let expected = face_load.expected_slip(&xc);
    let interrupted = || observer.interrupted();
    let stepper = Stepper::new(problem, solver, settings.step_tolerance, &expected)
        .with_control(settings.step_control)
        .with_interruption(&interrupted);
    let near = distances(problem, load.wheel.half_width(), &xc);
    let mut wheel = Rolling::new(face_load, load, (&xc, near), settings.step_control, stepper);
    let mut tips = TipSifs::virgin(problem);
    if load.residual.is_some() {
        wheel.residual_stress(&mut tips)?;
    }
    wheel.seal_buried();
    let passed = until_repeated(settings, memory(problem), |number, before| {
        wheel.pass(number, before, &mut tips, observer)
    })?;
    Ok(stabilised(passed, wheel.stepper.counts(), wheel.edge_steps, problem, None))
}

/// The stabilised passage of `passed`, with the `effort` of the solver, from which `edge_steps` are
/// excluded, and the error of groups.
pub(super) fn stabilised(
    passed: Repeated<Pass>,
    effort: SteppingCounts,
    edge_steps: usize,
    problem: &FaceProblem,
    coupling: Option<GroupsError>,
) -> StabilisedPassage {
    let points = problem.body().faces.points.clone();
    StabilisedPassage {
        counts: SolverCounts {
            passages: passed.records.len(),
            substeps: effort.substeps + edge_steps,
            solves: effort.solves,
            iterations: effort.iterations,
            iterations_max: effort.iterations_max,
            complementarity_max: effort.violation_max,
        },
        passages: passed.records,
        histories: passed.last.histories,
        faces: FaceRecord { points, states: passed.last.states, across: None, surface: passed.last.surface },
        last_change: passed.change,
        coupling,
        delta_kiii: Vec::new(),
    }
}

/// The memory of the faces of `problem`.
pub(super) fn memory(problem: &FaceProblem) -> Memory {
    if problem.has_friction() { Memory::Friction } else { Memory::None }
}

impl Repeats for Pass {
    type Record = PassageRecord;

    fn record(&self) -> PassageRecord {
        self.record.clone()
    }

    fn change_from(&self, before: &PassageRecord) -> f64 {
        change(before, &self.record)
    }

    fn joins(&self) -> bool {
        self.joins
    }
}

/// Number of stations of the approach from infinity and of the departure to infinity, evenly spaced
/// in 1/distance, over which the load grows about linearly.
const FAR_STATIONS: usize = 8;
/// Number of stations of the ramp of residual stress, and of the wheel load where the wheel cannot
/// arrive from infinity.
const RAMP_STATIONS: usize = 8;

/// Shares of residual stress, the last one 1.
pub(super) fn ramp_stations() -> impl DoubleEndedIterator<Item = f64> {
    (1..=RAMP_STATIONS).map(|k| k as f64 / RAMP_STATIONS as f64)
}

/// Coordinates of an approach up to `near` (mm).
pub(super) fn far_stations(near: f64) -> impl DoubleEndedIterator<Item = f64> {
    (1..=FAR_STATIONS).map(move |k| k as f64 / FAR_STATIONS as f64 / near)
}

/// Distance from a contact edge, relative to a, within which stations resolve how it covers or
/// leaves a mouth.
const AHEAD: f64 = 1e-6;
/// Number of parts between two output positions in which the pressures over the mouths follow the
/// contact.
const PARTS_UNDER_PRESSURE: usize = 4;
/// Stations around the passage of a contact edge over a mouth, relative to a: the stress there
/// varies as the square root of the distance.
const EDGE_STATIONS: [f64; 7] = [-0.03, -0.015, -0.004, 0.0, 0.004, 0.015, 0.03];

/// The passages of the wheel over fixed cracks.
pub(super) struct Rolling<'a> {
    problem: &'a FaceProblem<'a>,
    face_load: &'a FaceLoad<'a>,
    /// Edges of the contact relative to x_c, mm.
    edges: &'a [f64],
    /// a, mm.
    half_width: f64,
    /// Output positions, mm.
    xc: &'a [f64],
    /// Length scales (mm) of the approach to the first and of the departure from the last of them.
    near: [f64; 2],
    /// Abscissae of the mouths, mm.
    mouths: Vec<f64>,
    control: StepControl,
    /// Whether the contact currently covers the mouth of each pocket whose fluid it can trap.
    covered: Vec<bool>,
    /// Whether the wheel currently feels the cracks.
    coupling: Coupling,
    /// The given pressures over the mouths while the wheel feels the cracks.
    over_mouths: Option<MouthPressures>,
    /// Abscissa (mm) of the mouth of the crack of each tip; `None` for buried cracks.
    tip_mouths: Vec<Option<f64>>,
    pub stepper: Stepper<'a>,
    /// Number of load steps to positions of [`EDGE_STATIONS`].
    pub edge_steps: usize,
}

/// Results of one passage.
pub(super) struct Pass {
    pub record: PassageRecord,
    pub histories: Vec<SifHistory>,
    pub states: Vec<Vec<FaceState>>,
    /// The running surface at each output position; empty for a wheel that does not feel the
    /// cracks.
    pub surface: Vec<Vec<SurfaceState>>,
    /// State of the faces at each output position.
    pub marks: Vec<Mark>,
    /// Whether it coincides with the previous passage from some position on.
    pub joins: bool,
}

/// The state that determines the rest of a passage.
pub(super) struct Mark {
    pub faces: FaceSolution,
    pub tips: TipMark,
}

impl Pass {
    /// Continues from its last position like `other`, which had the same state there.
    pub fn join(&mut self, other: &Self) {
        let from = self.marks.len();
        for (own, sifs) in self.record.sifs.iter_mut().zip(&other.record.sifs) {
            own.extend_from_slice(&sifs[from..]);
        }
        for (own, fluid) in self.record.fluid.iter_mut().zip(&other.record.fluid) {
            own.extend_from_slice(&fluid[from..]);
        }
        self.record.wheel.extend_from_slice(other.record.wheel.get(from..).unwrap_or_default());
        self.surface.extend_from_slice(other.surface.get(from..).unwrap_or_default());
        let past = other.marks[from - 1].tips.samples();
        for (own, history) in self.histories.iter_mut().zip(&other.histories) {
            own.samples.extend_from_slice(&history.samples[past..]);
        }
        self.states.extend_from_slice(&other.states[from..]);
        self.joins = true;
    }
}

impl<'a> Rolling<'a> {
    /// The passages of the wheel of `load` over the faces followed by `stepper`, with the output
    /// positions and the distances from the cracks at the first and the last of them.
    pub fn new(
        face_load: &'a FaceLoad<'a>,
        load: RailLoad<'a>,
        (xc, near): (&'a [f64], [f64; 2]),
        control: StepControl,
        stepper: Stepper<'a>,
    ) -> Self {
        let problem = face_load.problem;
        Self {
            problem,
            face_load,
            edges: load.wheel.edges(),
            half_width: load.wheel.half_width(),
            xc,
            near,
            mouths: mouths(problem),
            control,
            covered: vec![false; trapped(problem).len()],
            coupling: Coupling::Uncoupled,
            over_mouths: None,
            tip_mouths: tip_mouths(problem),
            stepper,
            edge_steps: 0,
        }
    }

    pub fn residual_stress(&mut self, tips: &mut TipSifs) -> Result<(), PassageError> {
        let problem = self.problem;
        let mut take = |solution: &FaceSolution, forces: &[f64]| tips.follow(problem, solution, forces);
        self.follow(LoadPhase::Ramp, 0.0, ramp_stations(), &mut take).map_err(failure(0, "residual stress"))
    }

    /// One passage, including approach and departure; `number` counts from 1.
    ///
    /// The memory of the faces fades: a sticking point was stopped by events of this passage, or
    /// has stuck from the start. At some position the faces reach the same state as in the passage
    /// `before`, from which on the rest of the passage is known.
    pub fn pass(
        &mut self,
        number: usize,
        before: Option<&Pass>,
        tips: &mut TipSifs,
        observer: &dyn Observer,
    ) -> Result<Pass, PassageError> {
        let problem = self.problem;
        let first = self.xc[0];
        let travel = (self.xc[self.xc.len() - 1] - first).signum();
        tips.begin();
        self.arrive(travel, tips).map_err(failure(number, "approach"))?;
        let mut pass = self.empty_pass();
        self.stepper.begin(first);
        self.cover(first, travel, tips).map_err(failure(number, "passage"))?;
        self.couple(first, travel, tips).map_err(failure(number, "passage"))?;
        for (i, &x) in self.xc.iter().enumerate() {
            let last = if i == 0 { x } else { self.xc[i - 1] };
            for station in self.edges_between(last, x).chain([x]) {
                let over = self.face_load.along(self.phase()).with_pressures(self.over_mouths.as_ref());
                self.edge_steps += usize::from(station != x);
                let mut take =
                    |solution: &FaceSolution, forces: &[f64]| tips.follow(problem, solution, forces);
                self.stepper.advance(&over, station, &mut take).map_err(failure(number, "passage"))?;
                self.cover(station, travel, tips).map_err(failure(number, "passage"))?;
                self.couple(station, travel, tips).map_err(failure(number, "passage"))?;
                self.settle_pressures(station, tips).map_err(failure(number, "passage"))?;
            }
            self.record(x, tips, &mut pass);
            observer.progress((i + 1) as f64 / self.xc.len() as f64);
            if let Some(before) = before
                && self.stepper.is_like(&before.marks[i].faces)
                && tips.is_like(&before.marks[i].tips)
            {
                pass.histories = tips.histories();
                pass.join(before);
                return Ok(pass);
            }
        }
        self.uncover(tips).map_err(failure(number, "departure"))?;
        self.uncouple(tips).map_err(failure(number, "departure"))?;
        self.leave(travel, tips).map_err(failure(number, "departure"))?;
        pass.histories = tips.histories();
        Ok(pass)
    }

    /// The wheel arrives at the first position, in the direction of `travel`.
    fn arrive(&mut self, travel: f64, tips: &mut TipSifs) -> Result<(), SteppingError> {
        let (problem, first) = (self.problem, self.xc[0]);
        let mut take = |solution: &FaceSolution, forces: &[f64]| tips.follow(problem, solution, forces);
        if problem.body().ends.is_some() {
            return self.follow(LoadPhase::Load { xc: first }, 0.0, ramp_stations(), &mut take);
        }
        let approach = LoadPhase::approach(first, travel, self.near[0]);
        self.follow(approach, 0.0, far_stations(self.near[0]), &mut take)
    }

    /// The wheel leaves from the last position, in the direction of `travel`.
    fn leave(&mut self, travel: f64, tips: &mut TipSifs) -> Result<(), SteppingError> {
        let (problem, last) = (self.problem, self.xc[self.xc.len() - 1]);
        let mut take = |solution: &FaceSolution, forces: &[f64]| tips.follow(problem, solution, forces);
        if problem.body().ends.is_some() {
            let down = ramp_stations().rev().skip(1).chain([0.0]);
            return self.follow(LoadPhase::Load { xc: last }, 1.0, down, &mut take);
        }
        let departure = LoadPhase::departure(last, travel, self.near[1]);
        let mut back = far_stations(self.near[1]).rev();
        let start = back.next().unwrap_or(0.0);
        self.follow(departure, start, back.chain([0.0]), &mut take)
    }

    /// A passage without results.
    fn empty_pass(&self) -> Pass {
        let tips = self.problem.body().tips.len();
        Pass {
            record: PassageRecord {
                xc: self.xc.to_vec(),
                sifs: vec![Vec::new(); tips],
                fluid: vec![Vec::new(); if self.problem.fluid().is_some() { tips } else { 0 }],
                kiii: Vec::new(),
                wheel: Vec::new(),
            },
            histories: Vec::new(),
            states: Vec::new(),
            surface: Vec::new(),
            marks: Vec::new(),
            joins: false,
        }
    }

    /// Adds the results at the output position `x` (mm) to `pass`.
    fn record(&self, x: f64, tips: &TipSifs, pass: &mut Pass) {
        pass.record.sifs.iter_mut().zip(tips.sifs()).for_each(|(tip, k)| tip.push(k));
        let fluid = self.fluid(x);
        pass.record.fluid.iter_mut().zip(fluid).for_each(|(tip, state)| tip.push(state));
        pass.states.push(self.stepper.solution().face_states(self.problem));
        if let Some(wheel) = self.problem.wheel() {
            let FaceSolution { jump, contact, loaded, .. } = self.stepper.solution();
            let is_coupled = self.coupling == Coupling::Coupled;
            let punch = is_coupled.then(|| self.face_load.punch(x));
            let state = punch.and_then(|punch| wheel.state((jump, loaded), x, (&self.tip_mouths, &punch)));
            let nodes = state.as_ref().map(|_| wheel.surface_states(jump, contact));
            pass.record.wheel.push(state);
            pass.surface.push(nodes.unwrap_or_default());
        }
        pass.marks.push(Mark { faces: self.stepper.solution().clone(), tips: tips.mark() });
    }

    /// Traps the fluid of buried cracks permanently.
    pub fn seal_buried(&mut self) {
        for (k, pocket) in trapped(self.problem).iter().enumerate() {
            if pocket.mouth.is_none() {
                self.stepper.seal(k);
            }
        }
    }

    /// Traps the fluid of cracks whose mouths the contact covers from `xc` (mm) on, and releases
    /// that of cracks whose mouths it leaves.
    fn cover(&mut self, xc: f64, travel: f64, tips: &mut TipSifs) -> Result<(), SteppingError> {
        if self.covered.is_empty() {
            return Ok(());
        }
        let ahead = match self.coupling {
            Coupling::Coupled => covered(self.problem, self.stepper.solution()),
            Coupling::Uncoupled => {
                let ahead = self.face_load.over_mouths(xc + travel * AHEAD * self.half_width, 1.0);
                ahead.into_iter().map(|pressure| pressure > 0.0).collect()
            }
        };
        for (k, covers) in ahead.into_iter().enumerate() {
            if covers && !self.covered[k] {
                self.stepper.seal(k);
            } else if !covers && self.covered[k] {
                self.release(k, tips)?;
            }
            self.covered[k] = covers;
        }
        Ok(())
    }

    /// The phase of a wheel over the cracks.
    fn phase(&self) -> LoadPhase {
        match self.coupling {
            Coupling::Coupled => LoadPhase::Coupled,
            Coupling::Uncoupled => LoadPhase::Over,
        }
    }

    /// Couples the wheel to the cracks from `xc` (mm) on, or uncouples it.
    fn couple(&mut self, xc: f64, travel: f64, tips: &mut TipSifs) -> Result<(), SteppingError> {
        let Some(wheel) = self.problem.wheel() else { return Ok(()) };
        let (from, to) = wheel.surface.coupled;
        let ahead = xc + travel * AHEAD * self.half_width;
        match (self.coupling, (from..=to).contains(&ahead)) {
            (Coupling::Uncoupled, true) => self.switch(Coupling::Coupled, tips),
            (Coupling::Coupled, false) => self.uncouple(tips),
            _ => Ok(()),
        }
    }

    /// Uncouples the wheel if it is coupled.
    fn uncouple(&mut self, tips: &mut TipSifs) -> Result<(), SteppingError> {
        match self.coupling {
            Coupling::Coupled => self.switch(Coupling::Uncoupled, tips),
            Coupling::Uncoupled => Ok(()),
        }
    }

    /// Solves the contact at the current position with another `coupling`.
    fn switch(&mut self, coupling: Coupling, tips: &mut TipSifs) -> Result<(), SteppingError> {
        self.coupling = coupling;
        let at = self.stepper.at();
        self.over_mouths = match coupling {
            Coupling::Coupled if self.problem.has_given_mouth_pressures() => {
                let pockets = self.problem.fluid().map_or(0, |fluid| fluid.pockets.len());
                Some(MouthPressures::none(pockets, at))
            }
            _ => None,
        };
        let path = self.face_load.along(self.phase()).with_pressures(self.over_mouths.as_ref());
        let mut take = |solution: &FaceSolution, forces: &[f64]| tips.follow(self.problem, solution, forces);
        self.stepper.couple(&path, coupling, &mut take)
    }

    /// Holds a wheel that feels the cracks at `xc` (mm) until the given pressures over the mouths
    /// are those of its contact.
    fn settle_pressures(&mut self, xc: f64, tips: &mut TipSifs) -> Result<(), SteppingError> {
        let Some(pressures) = &self.over_mouths else { return Ok(()) };
        let problem = self.problem;
        let mut tried = pressures.assumed(xc);
        let peak_pressure = problem.wheel().map_or(0.0, |wheel| wheel.surface.peak_pressure);
        let mut settling = Settling::new(peak_pressure);
        let mut take = |solution: &FaceSolution, forces: &[f64]| tips.follow(problem, solution, forces);
        for _ in 0..MOST_CHANGES {
            let solution = self.stepper.solution();
            // Fluid is under pressure where its mouth is covered.
            let found = over_mouths(problem, solution, &covered(problem, solution));
            let Some(next) = settling.next(&tried, &found) else { break };
            let start = self.stepper.load().to_vec();
            let path = PressuresChange { problem, start, from: &tried, to: &next };
            self.stepper.begin(0.0);
            let moved = self.stepper.advance(&path, 1.0, &mut take);
            self.stepper.begin(xc);
            moved?;
            tried = next;
        }
        if let Some(pressures) = &mut self.over_mouths {
            pressures.advance(xc, tried);
        }
        Ok(())
    }

    /// Releases all fluid trapped by the contact.
    fn uncover(&mut self, tips: &mut TipSifs) -> Result<(), SteppingError> {
        for k in 0..self.covered.len() {
            if std::mem::take(&mut self.covered[k]) {
                self.release(k, tips)?;
            }
        }
        Ok(())
    }

    fn release(&mut self, k: usize, tips: &mut TipSifs) -> Result<(), SteppingError> {
        let problem = self.problem;
        self.stepper.release(k, &mut |solution, forces| tips.follow(problem, solution, forces))
    }

    /// The fluid in the crack of each tip with the wheel at `xc` (mm).
    fn fluid(&self, xc: f64) -> Vec<FluidState> {
        let Some(fluid) = self.problem.fluid() else { return Vec::new() };
        let solution = self.stepper.solution();
        let mut pressures = self.face_load.in_pockets(xc, 1.0).unwrap_or_default();
        if let Some(given) = self.over_mouths.as_ref().filter(|_| !pressures.is_empty()) {
            pressures.clone_from(&given.now);
        }
        let state = |(k, pocket): (usize, &Pocket)| FluidState {
            pressure: solution
                .fluid
                .get(k)
                .map_or_else(|| pressures.get(k).copied().unwrap_or(0.0), |fluid| fluid.pressure),
            volume: pocket.fluid_volume(solution),
        };
        let states: Vec<FluidState> = fluid.pockets.iter().enumerate().map(state).collect();
        let in_crack = |crack: usize| {
            let pocket = fluid.pockets.iter().position(|pocket| pocket.cracks.contains(&crack));
            pocket.map_or(FluidState::default(), |k| states[k])
        };
        self.problem.body().tips.iter().map(|tip| in_crack(tip.crack)).collect()
    }

    /// Wheel positions between two output positions at which an edge of the contact is at or near a
    /// mouth, in the order of travel: the stress at the mouth varies too rapidly there to be
    /// resolved by the adjacent output positions.
    fn edges_between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> + use<> {
        let travel = (to - from).signum();
        let within = |x: &f64| (x - from) * travel > 0.0 && (to - x) * travel > 0.0;
        let adaptive = self.problem.has_friction() && self.control == StepControl::Adaptive;
        let mut stations: Vec<f64> = if adaptive || !self.covered.is_empty() {
            edge_stations(&self.mouths, self.edges, self.half_width).filter(within).collect()
        } else {
            Vec::new()
        };
        let switches = self.problem.wheel().map(|wheel| wheel.surface.coupled);
        stations.extend(switches.iter().flat_map(|(first, last)| [*first, *last]).filter(within));
        if self.over_mouths.is_some() {
            let parts = PARTS_UNDER_PRESSURE;
            stations.extend((1..parts).map(|k| from + (to - from) * k as f64 / parts as f64));
        }
        stations.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
        stations.into_iter()
    }

    /// Follows `part` from `start` through `stations`.
    fn follow(
        &mut self,
        part: LoadPhase,
        start: f64,
        stations: impl Iterator<Item = f64>,
        sample: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        self.stepper.begin(start);
        let path = self.face_load.along(part);
        for station in stations {
            self.stepper.advance(&path, station, sample)?;
        }
        Ok(())
    }
}

/// The pockets whose fluid the contact traps.
fn trapped<'a>(problem: &'a FaceProblem) -> &'a [Pocket] {
    match problem.fluid() {
        Some(fluid) if matches!(fluid.model, FluidModel::Trapped { .. }) => &fluid.pockets,
        _ => &[],
    }
}

/// Wheel positions (mm) at which an edge of the contact, at `edges` from its middle, is at or near
/// one of `mouths`.
pub(super) fn edge_stations(mouths: &[f64], edges: &[f64], half_width: f64) -> impl Iterator<Item = f64> {
    let at = mouths.iter().flat_map(move |mouth| edges.iter().map(move |edge| mouth - edge));
    at.flat_map(move |edge| EDGE_STATIONS.map(|share| edge + share * half_width))
}

/// Distances (mm) along the rail from the first and the last of the positions `xc` to the nearest
/// face, at least a; they are the length scales of the stress on the faces.
pub(super) fn distances(problem: &FaceProblem, half_width: f64, xc: &[f64]) -> [f64; 2] {
    let samples = &problem.body().faces.samples;
    let nearest = |x: f64| samples.iter().map(|s| (s.point.x - x).abs()).fold(f64::INFINITY, f64::min);
    [xc[0], xc[xc.len() - 1]].map(|x| nearest(x).max(half_width))
}

/// Abscissae of the points of the faces on the running surface, mm.
pub(super) fn mouths(problem: &FaceProblem) -> Vec<f64> {
    let points = problem.body().faces.points.iter();
    points.filter(|point| point.position.y == 0.0).map(|point| point.position.x).collect()
}

/// Abscissa (mm) of the mouth of the crack of each tip; `None` for buried cracks.
fn tip_mouths(problem: &FaceProblem) -> Vec<Option<f64>> {
    let body = problem.body();
    let mouth = |crack: usize| {
        let own = |point: &&FacePoint| point.crack == crack && point.position.y == 0.0;
        body.faces.points.iter().find(own).map(|point| point.position.x)
    };
    body.tips.iter().map(|tip| mouth(tip.crack)).collect()
}

/// Places along the rail at which bending matters, mm: the mouths, or the middle of the faces if
/// there are none.
pub(super) fn places(problem: &FaceProblem) -> Vec<f64> {
    let mouths = mouths(problem);
    if !mouths.is_empty() {
        return mouths;
    }
    let points = problem.body().faces.points.iter().map(|point| point.position.x);
    let (low, high) =
        points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low <= high { vec![0.5 * (low + high)] } else { Vec::new() }
}

fn failure(passage: usize, phase: &'static str) -> impl Fn(SteppingError) -> PassageError {
    move |source| match source {
        SteppingError::Interrupted { .. } => PassageError::Interrupted,
        SteppingError::NotConverged { .. } | SteppingError::TooManySteps { .. } => {
            PassageError::NotConverged { passage, phase, source }
        }
    }
}

/// The largest change of K at any tip and position, relative to the largest |K| of both passages.
fn change(before: &PassageRecord, after: &PassageRecord) -> f64 {
    let pairs = before.sifs.iter().flatten().zip(after.sifs.iter().flatten());
    let (mut difference, mut peak) = (0.0f64, 0.0f64);
    for (a, b) in pairs {
        difference = difference.max((a.ki - b.ki).abs()).max((a.kii - b.kii).abs());
        for k in [a.ki, a.kii, b.ki, b.kii] {
            peak = peak.max(k.abs());
        }
    }
    if difference == 0.0 { 0.0 } else { difference / peak }
}

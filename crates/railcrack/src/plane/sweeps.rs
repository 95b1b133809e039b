//! Passages of the wheel over many cracks, group by group, in sweeps until the groups agree.

use super::exchange::{Exchange, Group, History, groups, stations, weights};
use super::face_load::{FaceLoad, LoadPhase, RailLoad};
use super::passage::{
    Pass, Rolling, distances, edge_stations, far_stations, memory, places, ramp_stations, stabilised,
};
use super::tip_sifs::TipSifs;
use crate::body::BlockStiffness;
use crate::contact::{
    ContactSolver, FaceHistory, FaceProblem, FaceState, FluidState, NotConverged, Stepper, SteppingCounts,
    SteppingError,
};
use crate::fracture::{Sif, SifHistory};
use crate::growth::{
    GroupsError, KEPT, Observer, PassageError, PassageRecord, PassageSettings, StabilisedPassage, SweepError,
    SweepProgress, WithoutProgress, output_positions, until_repeated,
};
use crate::linear::LinearError;
use crate::math::{Matrix, Track, every_second};
use rayon::prelude::*;

/// [`super::stabilised_passage`] of a body built by groups.
pub(super) fn passages_by_groups(
    face_load: &FaceLoad,
    blocks: &BlockStiffness,
    load: RailLoad,
    solver: &dyn ContactSolver,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    let problem = face_load.problem;
    let xc = output_positions(&settings.passage, load.wheel.bending(), &places(problem));
    let half_width = load.wheel.half_width();
    let groups = groups(problem, blocks).map_err(unsolvable)?;
    // Jumps change rapidly where an edge of the contact passes a mouth.
    let points = &problem.body().faces.points;
    let is_mouth = |&p: &usize| points[p].position.y == 0.0;
    let mouths = |k: usize| -> Vec<f64> {
        let near = blocks.near[k].iter().flat_map(|(l, _)| blocks.units[*l].iter().copied());
        near.filter(is_mouth).map(|p| points[p].position.x).collect()
    };
    let group_stations = |(k, group): (usize, &Group)| {
        let edges: Vec<f64> = edge_stations(&mouths(k), load.wheel.edges(), half_width).collect();
        stations(&xc, &edges, group.extent, half_width)
    };
    let mut row = GroupRow {
        face_load,
        blocks,
        load,
        solver,
        settings,
        near: distances(problem, half_width, &xc),
        stations: groups.iter().enumerate().map(group_stations).collect(),
        xc: &xc,
        states: Vec::new(),
        histories: Vec::new(),
        last: Vec::new(),
        peaks: vec![0.0; problem.body().tips.len()],
        error: SweepError::new(0.0),
        counts: SteppingCounts::default(),
        edge_steps: 0,
        groups,
    };
    row.states = row.virgin()?;
    if load.residual.is_some() {
        row.settle(Leg::Residual, observer)?;
    }
    let passed = until_repeated(settings, memory(problem), |number, _| row.pass(number, problem, observer))?;
    let [interpolation, far] = row.interpolation_and_far()?;
    let error = GroupsError { sweeps: row.error.largest, interpolation, far };
    Ok(stabilised(passed, row.counts, row.edge_steps, problem, Some(error)))
}

fn unsolvable(_: LinearError) -> PassageError {
    let failure = NotConverged { iterations: 0, indicator: f64::INFINITY, tolerance: 0.0 };
    let source = SteppingError::NotConverged { at: 0.0, failure };
    PassageError::NotConverged { passage: 0, phase: "cracks that are indistinguishable", source }
}

/// A part of the history between two states of all faces.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Leg {
    Residual,
    /// Number of the passage, from 1.
    Passage(usize),
}

/// The state of a group between two legs.
#[derive(Clone)]
struct GroupState {
    faces: FaceHistory,
    tips: TipSifs,
}

/// Results of a group over a leg, for the group's own unit.
struct LegOfGroup {
    history: History,
    /// K of its tips at the stations of the group, or at the end.
    sifs: Vec<Vec<Sif>>,
    /// Its faces at the same places.
    faces: Vec<Vec<FaceState>>,
    histories: Vec<SifHistory>,
    /// The fluid in the cracks of its tips at the stations; empty for dry cracks.
    fluid: Vec<Vec<FluidState>>,
    end: GroupState,
    counts: SteppingCounts,
    edge_steps: usize,
}

/// All groups of a row, each followed event by event.
struct GroupRow<'a> {
    face_load: &'a FaceLoad<'a>,
    blocks: &'a BlockStiffness,
    load: RailLoad<'a>,
    solver: &'a dyn ContactSolver,
    settings: &'a PassageSettings,
    xc: &'a [f64],
    near: [f64; 2],
    groups: Vec<Group>,
    /// For each group, the positions at which it receives forces, and all positions to which it is
    /// followed.
    stations: Vec<(Vec<f64>, Vec<f64>)>,
    /// State of each group at the end of the last leg.
    states: Vec<GroupState>,
    /// History of each unit in the last sweep.
    histories: Vec<History>,
    /// K of the last sweep of the last passage.
    last: Vec<Vec<Vec<Sif>>>,
    /// The largest |K| of each tip so far.
    peaks: Vec<f64>,
    error: SweepError,
    counts: SteppingCounts,
    edge_steps: usize,
}

impl GroupRow<'_> {
    fn virgin(&self) -> Result<Vec<GroupState>, PassageError> {
        let state = |(group, (_, stations)): (&Group, &(Vec<f64>, Vec<f64>))| {
            let problem = problem(group)?;
            let expected = self.face_load.of_part(&problem)?.expected_slip(stations);
            let faces = FaceHistory::virgin(&problem, &expected);
            Ok(GroupState { faces, tips: TipSifs::virgin(&problem) })
        };
        self.groups.par_iter().zip(&self.stations).map(state).collect()
    }

    /// The phases of `leg` with their coordinates; while the wheel is over the cracks, the
    /// coordinates are those in `over`.
    fn parts(&self, leg: Leg, over: &[f64]) -> Vec<(LoadPhase, Vec<f64>)> {
        let from_zero =
            |stations: &mut dyn Iterator<Item = f64>| std::iter::once(0.0).chain(stations).collect();
        if leg == Leg::Residual {
            return vec![(LoadPhase::Ramp, from_zero(&mut ramp_stations()))];
        }
        let (first, last) = (self.xc[0], self.xc[self.xc.len() - 1]);
        let travel = (last - first).signum();
        let [near_first, near_last] = self.near;
        let mut departure: Vec<f64> = from_zero(&mut far_stations(near_last));
        departure.reverse();
        vec![
            (LoadPhase::approach(first, travel, near_first), from_zero(&mut far_stations(near_first))),
            (LoadPhase::Over, over.to_vec()),
            (LoadPhase::departure(last, travel, near_last), departure),
        ]
    }

    /// Sweeps over `leg` until K of all tips is within the tolerance.
    fn settle(&mut self, leg: Leg, observer: &dyn Observer) -> Result<Vec<LegOfGroup>, PassageError> {
        let repeats = self.histories.len() == self.groups.len() && matches!(leg, Leg::Passage(2..));
        if !repeats {
            self.histories = (0..self.groups.len()).map(|k| self.at_rest(k, leg)).collect();
            self.last.clear();
        }
        let mut sweep = self.error.begin();
        loop {
            let runs = self.sweep((leg, sweep), observer)?;
            let change = self.change(&runs);
            self.last = runs.iter().map(|run| run.sifs.clone()).collect();
            self.histories = runs.iter().map(|run| run.history.clone()).collect();
            let Some(next) = self.error.next(change, self.settings) else {
                for run in &runs {
                    self.counts.violation_max = self.counts.violation_max.max(run.counts.violation_max);
                }
                self.states = runs.iter().map(|run| run.end.clone()).collect();
                return Ok(runs);
            };
            sweep = next;
        }
    }

    /// The largest change of K since the last sweep, relative to its peak.
    fn change(&mut self, runs: &[LegOfGroup]) -> f64 {
        let mut largest = 0.0f64;
        for (k, (run, group)) in runs.iter().zip(&self.groups).enumerate() {
            for (i, ((tip, _), sifs)) in group.own_tips.iter().zip(&run.sifs).enumerate() {
                let peak = &mut self.peaks[*tip];
                for sif in sifs {
                    *peak = peak.max(sif.ki.abs()).max(sif.kii.abs());
                }
                let Some(last) = self.last.get(k) else { continue };
                for (now, last) in sifs.iter().zip(&last[i]) {
                    let by = (now.ki - last.ki).abs().max((now.kii - last.kii).abs());
                    if by > 0.0 {
                        largest = largest.max(by / *peak);
                    }
                }
            }
        }
        // Before the first sweep there is nothing to compare with.
        if self.last.is_empty() { 1.0 } else { largest }
    }

    /// The jumps of unit `k` at the end of the last leg, as a constant history over `leg`.
    fn at_rest(&self, k: usize, leg: Leg) -> History {
        let own = self.groups[k].own_points.clone();
        let jumps = &self.states[k].faces.solution.jump[2 * own.start..2 * own.end];
        let parts = self.parts(leg, &self.stations[k].1);
        let constant = |(part, at): (LoadPhase, Vec<f64>)| {
            let values = Matrix::from_fn(at.len(), jumps.len(), |_, i| jumps[i]);
            (part, Track::new(at, values))
        };
        parts.into_iter().map(constant).collect()
    }

    /// The estimated errors of K in the last passage, relative to its peak, due to the
    /// interpolation of stored jumps and due to the expansion of far forces, as if faces were free.
    ///
    /// Jumps are interpolated linearly, so that with half of the coordinates the error is four
    /// times as large.
    fn interpolation_and_far(&self) -> Result<[f64; 2], PassageError> {
        let nodes = |k: usize| -> Vec<Vec<f64>> {
            self.parts(Leg::Passage(1), &self.stations[k].0).into_iter().map(|(_, at)| at).collect()
        };
        let fewer_nodes = |k: usize| -> Vec<Vec<f64>> {
            nodes(k).into_iter().map(|at| every_second(at.len()).map(|i| at[i]).collect()).collect()
        };
        let halved: Vec<History> = self
            .histories
            .iter()
            .map(|history| history.iter().map(|(part, track)| (*part, track.halved())).collect())
            .collect();
        let new = |histories, nodes: &(dyn Fn(usize) -> Vec<Vec<f64>> + Sync)| {
            Exchange::new(self.blocks, &self.groups, histories, nodes).map_err(unsolvable)
        };
        let (all, half) = (new(&self.histories, &nodes)?, new(&halved, &fewer_nodes)?);
        let of_group = |k: usize| -> Result<[f64; 2], PassageError> {
            let group = &self.groups[k];
            let forces = all.forces_on(k, nodes(k)).map_err(unsolvable)?;
            let fewer = half.forces_on(k, fewer_nodes(k)).map_err(unsolvable)?;
            let at: Vec<Vec<f64>> = forces.iter().map(|(_, track)| track.at().to_vec()).collect();
            let far = all.far_forces_on(k, &at);
            let mut largest = [0.0f64; 2];
            for (((_, forces), (_, fewer)), far) in forces.iter().zip(&fewer).zip(&far) {
                let fewer = fewer.resampled(forces.at());
                for i in 0..forces.at().len() {
                    let rows = forces.values().row(i).iter().zip(fewer.row(i));
                    let by: Vec<f64> = rows.map(|(all, fewer)| all - fewer).collect();
                    let (steps, far) =
                        (self.share_of_peak(group, &by), self.share_of_peak(group, far.row(i)));
                    largest = [largest[0].max(steps / 3.0), largest[1].max(self.blocks.far.error * far)];
                }
            }
            Ok(largest)
        };
        let of_groups: Vec<[f64; 2]> =
            (0..self.groups.len()).into_par_iter().map(of_group).collect::<Result<_, _>>()?;
        Ok(of_groups.into_iter().fold([0.0; 2], |all, one| [all[0].max(one[0]), all[1].max(one[1])]))
    }

    /// The largest K of the own tips of `group` under `forces` (N/mm) on free faces, relative to
    /// its peak.
    fn share_of_peak(&self, group: &Group, forces: &[f64]) -> f64 {
        let influence = &group.body.sif_influence;
        let of_tip = |&(number, tip): &(usize, usize)| {
            let of_row = |row: usize| -> f64 {
                influence.row(row).iter().zip(forces).map(|(s, f)| s * f).sum::<f64>().abs()
            };
            let largest = of_row(2 * tip).max(of_row(2 * tip + 1));
            if largest > 0.0 { largest / self.peaks[number] } else { 0.0 }
        };
        group.own_tips.iter().map(of_tip).fold(0.0, f64::max)
    }

    fn sweep(
        &mut self,
        (leg, number): (Leg, usize),
        observer: &dyn Observer,
    ) -> Result<Vec<LegOfGroup>, PassageError> {
        let nodes = |k: usize| -> Vec<Vec<f64>> {
            self.parts(leg, &self.stations[k].0).into_iter().map(|(_, at)| at).collect()
        };
        let exchange =
            Exchange::new(self.blocks, &self.groups, &self.histories, &nodes).map_err(unsolvable)?;
        let progress = SweepProgress::new(observer, number, self.groups.len());
        let run = |k: usize| {
            let forces = exchange.forces_on(k, nodes(k)).map_err(unsolvable)?;
            let run = self.run(leg, k, forces, observer);
            progress.group_done();
            run
        };
        let runs: Vec<LegOfGroup> =
            (0..self.groups.len()).into_par_iter().map(run).collect::<Result<_, PassageError>>()?;
        for LegOfGroup { counts, edge_steps, .. } in &runs {
            self.counts.substeps += counts.substeps;
            self.counts.solves += counts.solves;
            self.counts.iterations += counts.iterations;
            self.counts.iterations_max = self.counts.iterations_max.max(counts.iterations_max);
            self.edge_steps += edge_steps;
        }
        Ok(runs)
    }

    /// Follows group `k` through `leg` under the wheel and `forces`.
    fn run(
        &self,
        leg: Leg,
        k: usize,
        forces: History,
        observer: &dyn Observer,
    ) -> Result<LegOfGroup, PassageError> {
        let group = &self.groups[k];
        let GroupState { faces, mut tips } = self.states[k].clone();
        let problem = problem(group)?;
        let face_load = self.face_load.of_part(&problem)?.with_others(forces);
        let interrupted = || observer.interrupted();
        let stepper = Stepper::from_history(&problem, self.solver, self.settings.step_tolerance, faces)
            .with_control(self.settings.step_control)
            .with_interruption(&interrupted)
            .with_visits(group.own_points.clone());
        let stations = &self.stations[k].1;
        let positions = (&stations[..], self.near);
        let mut wheel = Rolling::new(&face_load, self.load, positions, self.settings.step_control, stepper);
        let own = group.own_points.clone();
        let (mut sifs, mut histories, mut states) = (Vec::new(), Vec::new(), Vec::new());
        let mut fluid = Vec::new();
        if leg == Leg::Passage(1) {
            wheel.seal_buried();
        }
        match leg {
            Leg::Residual => {
                wheel.residual_stress(&mut tips)?;
                let ends: Vec<Sif> = tips.sifs().collect();
                sifs.extend(group.own_tips.iter().map(|&(_, tip)| vec![ends[tip]]));
            }
            Leg::Passage(number) => {
                let pass = wheel.pass(number, None, &mut tips, &WithoutProgress(observer))?;
                sifs.extend(group.own_tips.iter().map(|&(_, tip)| pass.record.sifs[tip].clone()));
                let of_tip = |&(_, tip): &(usize, usize)| pass.record.fluid.get(tip).cloned();
                fluid.extend(group.own_tips.iter().filter_map(of_tip));
                histories.extend(group.own_tips.iter().map(|&(_, tip)| pass.histories[tip].clone()));
                states.extend(pass.states.iter().map(|faces| faces[own.clone()].to_vec()));
            }
        }
        let visits = wheel.stepper.take_visits();
        let largest = visits.iter().flatten().flat_map(|(_, jump)| jump).fold(0.0f64, |m, w| m.max(w.abs()));
        let parts = self.parts(leg, stations);
        let tracks = visits.iter().map(|samples| Track::thinned(samples, KEPT * largest));
        let history = parts.into_iter().map(|(part, _)| part).zip(tracks).collect();
        let (counts, edge_steps) = (wheel.stepper.counts(), wheel.edge_steps);
        let end = GroupState { faces: wheel.stepper.history(), tips };
        Ok(LegOfGroup { history, sifs, faces: states, histories, fluid, end, counts, edge_steps })
    }

    /// Passage `number` of the row.
    fn pass(
        &mut self,
        number: usize,
        problem: &FaceProblem,
        observer: &dyn Observer,
    ) -> Result<Pass, PassageError> {
        let runs = self.settle(Leg::Passage(number), observer)?;
        let tips = problem.body().tips.len();
        let mut record = PassageRecord {
            xc: self.xc.to_vec(),
            sifs: vec![Vec::with_capacity(self.xc.len()); tips],
            fluid: vec![Vec::new(); if problem.fluid().is_some() { tips } else { 0 }],
            kiii: Vec::new(),
            wheel: Vec::new(),
        };
        let mut histories = vec![SifHistory::default(); tips];
        let mut states = vec![vec![None; problem.points()]; self.xc.len()];
        for (k, (run, group)) in runs.into_iter().zip(&self.groups).enumerate() {
            let stations = &self.stations[k].1;
            let at: Vec<Vec<(usize, f64)>> = self.xc.iter().map(|&x| weights(stations, x)).collect();
            for (((tip, _), sifs), history) in group.own_tips.iter().zip(&run.sifs).zip(run.histories) {
                let sum = |weights: &Vec<(usize, f64)>| {
                    let part = |mode: fn(&Sif) -> f64| -> f64 {
                        weights.iter().map(|(i, weight)| weight * mode(&sifs[*i])).sum()
                    };
                    Sif { ki: part(|k| k.ki), kii: part(|k| k.kii) }
                };
                record.sifs[*tip].extend(at.iter().map(sum));
                histories[*tip] = history;
            }
            for ((tip, _), fluid) in group.own_tips.iter().zip(&run.fluid) {
                record.fluid[*tip].extend(at.iter().map(|weights| fluid_between(fluid, weights)));
            }
            for (states, weights) in states.iter_mut().zip(&at) {
                for (own, &point) in self.blocks.units[k].iter().enumerate() {
                    states[point] = Some(between(&run.faces, own, weights));
                }
            }
        }
        let states = states.into_iter().map(|states| states.into_iter().flatten().collect()).collect();
        Ok(Pass { record, histories, states, surface: Vec::new(), marks: Vec::new(), joins: false })
    }
}

/// The state of face point `point` between stations; the status is that at the station of largest
/// weight.
fn between(faces: &[Vec<FaceState>], point: usize, weights: &[(usize, f64)]) -> FaceState {
    let largest = weights.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |weight| weight.0);
    let nearest = faces[largest][point];
    if weights.len() == 1 {
        return nearest;
    }
    let sum = |value: fn(&FaceState) -> f64| -> f64 {
        weights.iter().map(|(i, weight)| weight * value(&faces[*i][point])).sum()
    };
    FaceState {
        opening: sum(|state| state.opening),
        slip: sum(|state| state.slip),
        s22: sum(|state| state.s22),
        s12: sum(|state| state.s12),
        status: nearest.status,
    }
}

/// The fluid between stations; pressure and volume are never negative.
fn fluid_between(states: &[FluidState], weights: &[(usize, f64)]) -> FluidState {
    let sum = |value: fn(&FluidState) -> f64| -> f64 {
        weights.iter().map(|(i, weight)| weight * value(&states[*i])).sum::<f64>().max(0.0)
    };
    FluidState { pressure: sum(|state| state.pressure), volume: sum(|state| state.volume) }
}

fn problem(group: &Group) -> Result<FaceProblem<'_>, PassageError> {
    let dry = FaceProblem::new(&group.body, &group.friction);
    let dry = dry.map_err(|_| unsolvable(LinearError::Singular { order: 0 }))?;
    Ok(dry.with_fluid(group.fluid.clone()))
}

//! A part of the way of the wheel along a row of many cracks, with the cracks around it followed
//! event by event in a window, and all others as they are.

use super::face_load::{FaceLoad, Part, PartLoad};
use super::tip_sifs::{TipMark, TipSifs};
use super::{PassageError, RailLoad};
use crate::body::{BlockStiffness, CrackedBody, FaceMesh, FacePoint, FaceSample};
use crate::contact::{
    Columns, ContactSolver, FaceHistory, FaceProblem, FaceSolution, FrozenFaces, LoadPath, PointStatus,
    StepControl, Stepper, SteppingCounts, SteppingError, WindowTableau, demanded_beyond, far_forces,
};
use crate::fracture::Sif;
use crate::linear::LinearError;
use crate::math::{Matrix, axpy};
use rayon::prelude::*;
use std::ops::Range;

/// Positions of a span at which what the faces outside of the window exert is computed: it is
/// smooth, the wheel being far from them.
const NODES: usize = 8;
/// Corrections of statuses outside of the window at the end of a span, at most.
const MOST_CORRECTIONS: usize = 6;
/// The same for which all points are corrected at once, then those that are off most.
const CORRECTED_AT_ONCE: usize = 4;
/// Factor by which neighbours make a crack more compliant, at most.
const NEIGHBOURS: f64 = 2.0;

/// The faces of a row of many cracks on their way.
pub(super) struct RowFaces<'a> {
    pub problem: &'a FaceProblem<'a>,
    pub blocks: &'a BlockStiffness,
    pub face_load: &'a FaceLoad<'a>,
    pub load: RailLoad<'a>,
    pub solver: &'a dyn ContactSolver,
    pub tolerance: f64,
    pub control: StepControl,
    pub interrupted: &'a (dyn Fn() -> bool + Sync),
    frozen: FrozenFaces<'a>,
    carried: Option<WindowTableau>,
    /// The largest change of K in the last round of a span, over its largest value so far.
    pub coupling_error: f64,
    /// All faces at the end of the last span.
    pub history: FaceHistory,
    /// The samples of the faces of each group.
    samples: Vec<Vec<usize>>,
    pub counts: SteppingCounts,
    /// Number of the passage, from 1; 0 while residual stress is applied.
    pub passage: usize,
    /// The largest |K| of each tip so far.
    peaks: Vec<f64>,
}

/// A part of the way.
pub(super) struct Span<'s> {
    pub part: Part,
    pub from: f64,
    /// Path coordinates to go through, in order, the last one the end; true where the faces are to
    /// be known.
    pub stations: &'s [(f64, bool)],
    /// Groups that are followed event by event.
    pub window: Range<usize>,
}

/// The load on the faces of a window: that of the wheel, and what all other faces exert.
struct WindowLoad<'a> {
    own: PartLoad<'a>,
    nodes: Vec<f64>,
    /// The forces that are added at each node, N/mm.
    others: Vec<Vec<f64>>,
    /// Path coordinates between which the forces of far groups are linear, and these.
    far_at: Vec<f64>,
    far: Vec<Vec<f64>>,
}

impl LoadPath for WindowLoad<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let mut forces = self.own.nodal_forces(at);
        for (i, others) in self.others.iter().enumerate() {
            let factor = |j: usize| {
                if i == j { 1.0 } else { (at - self.nodes[j]) / (self.nodes[i] - self.nodes[j]) }
            };
            axpy((0..self.nodes.len()).map(factor).product(), others, &mut forces);
        }
        let last = self.far_at.len() - 1;
        let travel = self.far_at[last] - self.far_at[0];
        let after = self.far_at.partition_point(|x| (x - at) * travel <= 0.0).clamp(1, last.max(1));
        if last == 0 {
            axpy(1.0, &self.far[0], &mut forces);
        } else {
            let (x, y) = (self.far_at[after - 1], self.far_at[after]);
            let share = ((at - x) / (y - x)).clamp(0.0, 1.0);
            axpy(1.0 - share, &self.far[after - 1], &mut forces);
            axpy(share, &self.far[after], &mut forces);
        }
        forces
    }
}

/// Chebyshev points between two path coordinates.
fn nodes(from: f64, to: f64) -> Vec<f64> {
    let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / NODES as f64;
    (0..NODES).map(|i| 0.5 * (from + to) - 0.5 * (to - from) * angle(i).cos()).collect()
}

fn unsolvable(at: f64) -> impl Fn(LinearError) -> SteppingError {
    move |_| {
        let failure =
            crate::contact::NotConverged { iterations: 0, indicator: f64::INFINITY, tolerance: 0.0 };
        SteppingError::NotConverged { at, failure }
    }
}

impl<'a> RowFaces<'a> {
    pub fn new(
        face_load: &'a FaceLoad<'a>,
        blocks: &'a BlockStiffness,
        load: RailLoad<'a>,
        solver: &'a dyn ContactSolver,
        (tolerance, control): (f64, StepControl),
        expected: &[f64],
        interrupted: &'a (dyn Fn() -> bool + Sync),
    ) -> Self {
        let problem = face_load.problem;
        let faces = &problem.body().faces;
        let mut group_of = vec![0; faces.points.len()];
        for (k, points) in blocks.groups.iter().enumerate() {
            points.iter().for_each(|&point| group_of[point] = k);
        }
        let mut samples = vec![Vec::new(); blocks.groups.len()];
        for (i, sample) in faces.samples.iter().enumerate() {
            if let Some(share) = sample.shares.iter().find(|share| share.1 != 0.0) {
                samples[group_of[share.0]].push(i);
            }
        }
        let tips = problem.body().tips.len();
        Self {
            problem,
            blocks,
            face_load,
            load,
            solver,
            tolerance,
            control,
            interrupted,
            frozen: FrozenFaces::new(problem, blocks),
            carried: None,
            coupling_error: 0.0,
            history: FaceHistory::virgin(problem.points(), expected),
            samples,
            counts: SteppingCounts::default(),
            passage: 0,
            peaks: vec![0.0; tips],
        }
    }

    /// The body of the groups of `window` and its friction.
    fn window_body(&self, window: &Range<usize>) -> Result<(CrackedBody, Vec<f64>, Vec<usize>), LinearError> {
        let faces = &self.problem.body().faces;
        let points: Vec<usize> = window.clone().flat_map(|k| self.blocks.groups[k].iter().copied()).collect();
        let mut cracks: Vec<usize> = points.iter().map(|&i| faces.points[i].crack).collect();
        cracks.sort_unstable();
        cracks.dedup();
        let mut place = vec![0; faces.points.len()];
        points.iter().enumerate().for_each(|(own, &all)| place[all] = own);
        let own_crack = |crack: usize| cracks.binary_search(&crack).unwrap_or(0);
        let own_point = |&i: &usize| FacePoint { crack: own_crack(faces.points[i].crack), ..faces.points[i] };
        let own_sample = |&i: &usize| {
            let sample = &faces.samples[i];
            let shares = sample.shares.map(|(p, l)| if l == 0.0 { (0, 0.0) } else { (place[p], l) });
            FaceSample { shares, ..*sample }
        };
        let mesh = FaceMesh {
            points: points.iter().map(own_point).collect(),
            samples: window.clone().flat_map(|k| self.samples[k].iter().map(own_sample)).collect(),
        };
        let none = || Matrix::zeros(0, 0);
        let body = CrackedBody::new(mesh, Vec::new(), [none(), self.frozen.stiffness(window)?, none()]);
        let friction = |&crack: &usize| {
            let point = points.iter().find(|&&p| faces.points[p].crack == crack);
            point.map_or(0.0, |&p| self.problem.friction(p))
        };
        Ok((body, cracks.iter().map(friction).collect(), points))
    }

    /// Follows `span`; returns all faces where they are to be known, the end always last.
    pub fn follow(
        &mut self,
        span: &Span<'_>,
        tips: &mut TipSifs,
    ) -> Result<Vec<(FaceSolution, TipMark)>, PassageError> {
        let passage = self.passage;
        self.follow_span(span, tips).map_err(|source| match source {
            SteppingError::Interrupted { .. } => PassageError::Interrupted,
            source => PassageError::NotConverged { passage, phase: "in windows", source },
        })
    }

    fn follow_span(
        &mut self,
        span: &Span<'_>,
        tips: &mut TipSifs,
    ) -> Result<Vec<(FaceSolution, TipMark)>, SteppingError> {
        let Span { part, from, stations, ref window } = *span;
        let Some(&(to, _)) = stations.last() else { return Ok(Vec::new()) };
        let count = self.blocks.groups.len();
        let whole = *window == (0..count);
        self.frozen.set(&self.history.solution.status);
        let carried = match self.carried.take() {
            Some(carried) => {
                carried.moved(window, &mut self.frozen, self.interrupted).map_err(unsolvable(from))?
            }
            None => None,
        };
        if !self.frozen.enclose(window, self.interrupted).map_err(unsolvable(from))? {
            return Err(SteppingError::Interrupted { at: from });
        }
        // Forces at the nodes, and where all faces are to be known.
        let nodes = if whole { vec![from] } else { nodes(from, to) };
        let mut way: Vec<Station> = stations
            .iter()
            .enumerate()
            .map(|(i, &(at, wanted))| Station { at, wanted, known: wanted || i + 1 == stations.len() })
            .collect();
        way.extend(nodes.iter().filter(|_| !whole).map(|&at| Station { at, wanted: false, known: true }));
        way.sort_by(|a, b| ((a.at - b.at) * (to - from)).total_cmp(&0.0));
        // Two stations at one place are one: a result where one of them is.
        way.dedup_by(|next, first| {
            let same = (next.at - first.at).abs() <= SAME * (to - from).abs();
            if same {
                let at = if next.wanted || next.at == to { next.at } else { first.at };
                let (wanted, known) = (first.wanted || next.wanted, first.known || next.known);
                *first = Station { at, wanted, known };
            }
            same
        });
        let known: Vec<f64> = way.iter().filter(|station| station.known).map(|station| station.at).collect();
        let at: Vec<f64> = nodes.iter().chain(&known).copied().collect();
        let path = self.face_load.along(part);
        let loads: Vec<Vec<f64>> = at.par_iter().map(|&at| path.nodal_forces(at)).collect();
        let start = self.history.solution.jump.clone();
        let held = self.held(window, &start);
        let none: Columns = (0..count).map(|k| Matrix::zeros(self.blocks.components(k), 1)).collect();
        let forces = self.less(&loads[..nodes.len()], &held, &none);
        let column = |k: usize| {
            let own = self.blocks.gather(k, &start);
            Matrix::from_fn(own.len(), 1, |i, _| own[i])
        };
        let at_start: Columns = (0..count).map(column).collect();
        let mut far = self.far_on(window, &at_start).map_err(unsolvable(from))?;
        let mut far_at = vec![from];
        let net = self.frozen.towards(window, forces).map_err(unsolvable(from))?;
        let (body, friction, points) = self.window_body(window).map_err(unsolvable(from))?;
        let mobility = points
            .iter()
            .flat_map(|&p| [2 * p, 2 * p + 1])
            .map(|i| NEIGHBOURS.sqrt() * self.blocks.mobility[i])
            .collect();
        let problem = match FaceProblem::new(&body, &friction) {
            Ok(problem) => problem.with_mobility(mobility),
            Err(_) => return Err(unsolvable(from)(LinearError::Singular { order: 0 })),
        };
        let own_load = match FaceLoad::new(&problem, self.load, None) {
            Ok(own) => own,
            Err(_) => return Err(unsolvable(from)(LinearError::Singular { order: 0 })),
        };
        let others = |c: usize| -> Vec<f64> {
            let of_group = |k: usize| {
                let load = self.blocks.gather(k, &loads[c]);
                let net = &net[k];
                load.into_iter().enumerate().map(|(i, own)| net[(i, c)] - own).collect::<Vec<f64>>()
            };
            window.clone().flat_map(of_group).collect()
        };
        let others: Vec<Vec<f64>> = (0..nodes.len()).map(others).collect();
        let pick = |values: &[f64]| -> Vec<f64> {
            points.iter().flat_map(|&p| [values[2 * p], values[2 * p + 1]]).collect()
        };
        let mut history = FaceHistory {
            solution: FaceSolution {
                jump: pick(&self.history.solution.jump),
                contact: pick(&self.history.solution.contact),
                status: points.iter().map(|&p| self.history.solution.status[p]).collect(),
                fluid: Vec::new(),
            },
            scale: points.iter().map(|&p| self.history.scale[p]).collect(),
            largest: self.history.largest,
            load: Vec::new(),
        };
        let own_tips = self.tips_among(&points);
        let begun = tips.place();
        let mut carried = carried;
        let mut before: Option<Vec<FaceSolution>> = None;
        let mut round = 0;
        let (end, inside, mut marks) = loop {
            tips.return_to(&begun);
            let path = WindowLoad {
                own: own_load.along(part),
                nodes: nodes.clone(),
                others: others.clone(),
                far_at: far_at.clone(),
                far: far.clone(),
            };
            history.load = path.nodal_forces(from);
            let start_of = (history.clone(), carried.take());
            let mut stepper = Stepper::from_history(&problem, self.solver, self.tolerance, start_of, from)
                .with_control(self.control)
                .with_interruption(self.interrupted);
            stepper.settle(&path)?;
            let (mut inside, mut marks) = (Vec::new(), Vec::new());
            let peaks = &mut self.peaks;
            for station in &way {
                let mut take = |solution: &FaceSolution, _: &[f64]| {
                    for &(tip, point, gain) in &own_tips {
                        let sif = Sif {
                            ki: gain * solution.jump[2 * point + 1],
                            kii: gain * solution.jump[2 * point],
                        };
                        peaks[tip] = peaks[tip].max(sif.ki.abs()).max(sif.kii.abs());
                        let closed =
                            solution.status[point] != PointStatus::Open && problem.friction(point) > 0.0;
                        tips.follow_one(tip, sif, solution.jump[2 * point], closed);
                    }
                };
                if (station.at - from).abs() > SAME * (to - from).abs() {
                    stepper.advance(&path, station.at, &mut take)?;
                }
                if station.known {
                    inside.push(stepper.solution().clone());
                    marks.push(tips.mark());
                }
            }
            let counts = stepper.counts();
            self.counts.substeps += counts.substeps;
            self.counts.solves += counts.solves;
            self.counts.iterations += counts.iterations;
            self.counts.iterations_max = self.counts.iterations_max.max(counts.iterations_max);
            self.counts.violation_max = self.counts.violation_max.max(counts.violation_max);
            let end = stepper.history();
            let tableau = stepper.into_carried().map_err(unsolvable(to))?;
            let all_known = Known { window, points: &points, loads: &loads[nodes.len()..], inside: &inside };
            let solutions = self.everywhere(&all_known, &start).map_err(unsolvable(to))?;
            let change = self.change(before.as_deref(), &solutions);
            round += 1;
            if whole || change <= COUPLING * self.tolerance || round == MOST_ROUNDS {
                self.coupling_error = self.coupling_error.max(if whole { 0.0 } else { change });
                let carried =
                    WindowTableau::new(tableau, window.clone(), &self.frozen).map_err(unsolvable(to))?;
                self.carried = Some(carried);
                break (end, inside, marks);
            }
            let jumps: Columns = (0..count)
                .map(|k| {
                    let columns: Vec<Vec<f64>> =
                        solutions.iter().map(|solution| self.blocks.gather(k, &solution.jump)).collect();
                    Matrix::from_fn(self.blocks.components(k), known.len() + 1, |i, c| match c {
                        0 => at_start[k][(i, 0)],
                        c => columns[c - 1][i],
                    })
                })
                .collect();
            far = self.far_on(window, &jumps).map_err(unsolvable(from))?;
            far_at = std::iter::once(from).chain(known.iter().copied()).collect();
            carried = Some(tableau);
            before = Some(solutions);
        };

        // All faces where they are to be known.
        let known = Known { window, points: &points, loads: &loads[nodes.len()..], inside: &inside };
        let mut whole_solutions = self.everywhere(&known, &start).map_err(unsolvable(to))?;
        self.history.solution = whole_solutions[whole_solutions.len() - 1].clone();
        for (own, &p) in points.iter().enumerate() {
            self.history.scale[p] = end.scale[own];
        }
        self.history.largest = self.history.largest.including(&end.solution, &end.load);
        self.history.load = loads[loads.len() - 1].clone();
        if !whole && self.correct(&known, &start, to)? {
            whole_solutions = self.everywhere(&known, &start).map_err(unsolvable(to))?;
            self.history.solution = whole_solutions[whole_solutions.len() - 1].clone();
        }
        for (solution, mark) in whole_solutions.iter().zip(&mut marks) {
            for (tip, gain) in self.blocks.tips.iter().enumerate() {
                if own_tips.iter().any(|own| own.0 == tip) {
                    continue;
                }
                let sif = Sif {
                    ki: gain.gain * solution.jump[2 * gain.point + 1],
                    kii: gain.gain * solution.jump[2 * gain.point],
                };
                self.peaks[tip] = self.peaks[tip].max(sif.ki.abs()).max(sif.kii.abs());
                let closed = solution.status[gain.point] != PointStatus::Open
                    && self.problem.friction(gain.point) > 0.0;
                tips.follow_one(tip, sif, solution.jump[2 * gain.point], closed);
            }
            let now = tips.mark();
            let outside = |tip: &usize| own_tips.iter().all(|own| own.0 != *tip);
            (0..self.blocks.tips.len()).filter(outside).for_each(|tip| mark.take(tip, &now));
        }
        for (j, scale) in self.history.scale.iter_mut().enumerate() {
            let jump = &self.history.solution.jump;
            *scale = scale.max(jump[2 * j].abs()).max(jump[2 * j + 1].abs());
        }
        let results = whole_solutions.into_iter().zip(marks);
        let wanted = way.iter().filter(|station| station.known).zip(results);
        Ok(wanted.filter(|(station, _)| station.wanted).map(|(_, result)| result).collect())
    }

    /// Whether `one` and `other` differ by no more than the errors that steps may make, as far as
    /// what comes after them can tell.
    pub fn are_alike(&self, one: &FaceSolution, other: &FaceSolution) -> bool {
        let near = |i: usize| {
            (one.jump[i] - other.jump[i]).abs() <= ALIKE * self.tolerance * self.history.scale[i / 2]
        };
        (0..one.jump.len()).all(near)
    }

    /// Tips whose points are among `points`: tip, place there, gain.
    fn tips_among(&self, points: &[usize]) -> Vec<(usize, usize, f64)> {
        let place = |tip: usize| points.iter().position(|&p| p == self.blocks.tips[tip].point);
        let all = 0..self.blocks.tips.len();
        all.filter_map(|tip| place(tip).map(|at| (tip, at, self.blocks.tips[tip].gain))).collect()
    }

    /// The largest change of K at any tip from `before` to `after`, over its largest value so far.
    fn change(&self, before: Option<&[FaceSolution]>, after: &[FaceSolution]) -> f64 {
        let Some(before) = before else { return f64::INFINITY };
        let mut largest = 0.0f64;
        for (one, other) in before.iter().zip(after) {
            for (tip, peak) in self.blocks.tips.iter().zip(&self.peaks) {
                for i in [2 * tip.point, 2 * tip.point + 1] {
                    if *peak > 0.0 {
                        largest = largest.max(tip.gain * (one.jump[i] - other.jump[i]).abs() / peak);
                    }
                }
            }
        }
        largest
    }

    /// The forces on the groups of `window` of what all `jumps` exert between far groups, those
    /// between two of its own left out: by column of `jumps`.
    fn far_on(&self, window: &Range<usize>, jumps: &Columns) -> Result<Vec<Vec<f64>>, LinearError> {
        let mut far = far_forces(self.blocks, jumps, window)?;
        far.iter_mut().flat_map(Matrix::entries_mut).for_each(|force| *force = -*force);
        let net = self.frozen.towards(window, far)?;
        let columns = net.first().map_or(0, Matrix::columns);
        let column = |c: usize| {
            let of_group = |k: usize| (0..net[k].rows()).map(move |i| (k, i));
            window.clone().flat_map(of_group).map(|(k, i)| net[k][(i, c)]).collect()
        };
        Ok((0..columns).map(column).collect())
    }

    /// Held jumps by group, zero in `window`: of the points that stick now, where they were in the
    /// jumps `start` (mm, 2p).
    fn held(&self, window: &Range<usize>, start: &[f64]) -> Vec<Vec<f64>> {
        let status = &self.history.solution.status;
        (0..self.blocks.groups.len())
            .map(|k| {
                let mut held = vec![0.0; self.blocks.components(k)];
                if !window.contains(&k) {
                    for (i, &point) in self.blocks.groups[k].iter().enumerate() {
                        if status[point] == PointStatus::Stick {
                            held[2 * i] = start[2 * point];
                        }
                    }
                }
                held
            })
            .collect()
    }

    /// `loads` by group, less the forces of `held` jumps and those between far groups, one column
    /// or as many as loads.
    fn less(&self, loads: &[Vec<f64>], held: &[Vec<f64>], far: &Columns) -> Columns {
        (0..self.blocks.groups.len())
            .map(|k| {
                let columns: Vec<Vec<f64>> = loads.iter().map(|load| self.blocks.gather(k, load)).collect();
                let near = self.blocks.near_forces(k, held);
                let last = far[k].columns() - 1;
                Matrix::from_fn(near.len(), loads.len(), |i, c| {
                    columns[c][i] - near[i] - far[k][(i, c.min(last))]
                })
            })
            .collect()
    }

    /// All faces under the loads of `known`, with the present statuses outside of the window, where
    /// points that stick are held as in the jumps `start`.
    fn everywhere(&self, known: &Known<'_>, start: &[f64]) -> Result<Vec<FaceSolution>, LinearError> {
        let Known { window, points, loads, inside } = *known;
        let count = self.blocks.groups.len();
        let held = self.held(window, start);
        let mut place = 0;
        let own: Columns = (0..count)
            .map(|k| {
                let n = self.blocks.components(k);
                let own = window.contains(&k).then_some(place);
                place += if own.is_some() { n } else { 0 };
                Matrix::from_fn(n, loads.len(), |i, c| own.map_or(0.0, |own| inside[c].jump[own + i]))
            })
            .collect();
        // Outside of the window as at the start.
        let mut guess = own.clone();
        for k in (0..count).filter(|k| !window.contains(k)) {
            for (i, &jump) in self.blocks.gather(k, start).iter().enumerate() {
                guess[k].row_mut(i).fill(jump);
            }
        }
        let mut far = far_forces(self.blocks, &guess, &(0..0))?;
        let mut jumps = Columns::new();
        for _ in 0..FAR_ROUNDS {
            let forces = self.less(loads, &held, &far);
            let net = self.frozen.towards(window, forces)?;
            jumps = self.frozen.away(window, &net, own.clone())?;
            for (jumps, held) in jumps.iter_mut().zip(&held) {
                for (i, &held) in held.iter().enumerate().filter(|(_, held)| **held != 0.0) {
                    jumps.row_mut(i).fill(held);
                }
            }
            far = far_forces(self.blocks, &jumps, &(0..0))?;
        }
        let status = &self.history.solution.status;
        let solution = |c: usize| {
            let all: Vec<Vec<f64>> =
                jumps.iter().map(|jumps| (0..jumps.rows()).map(|i| jumps[(i, c)]).collect()).collect();
            let n = 2 * self.problem.points();
            let mut solution = FaceSolution {
                jump: vec![0.0; n],
                contact: vec![0.0; n],
                status: status.clone(),
                fluid: Vec::new(),
            };
            for k in (0..count).filter(|k| !window.contains(k)) {
                self.blocks.scatter(k, &all[k], &mut solution.jump);
                let near = self.blocks.near_forces(k, &all);
                let own = self.blocks.gather(k, &loads[c]);
                let contact: Vec<f64> = (0..near.len()).map(|i| near[i] + far[k][(i, c)] - own[i]).collect();
                self.blocks.scatter(k, &contact, &mut solution.contact);
            }
            for (own, &p) in points.iter().enumerate() {
                solution.jump[2 * p..2 * p + 2].copy_from_slice(&inside[c].jump[2 * own..2 * own + 2]);
                solution.contact[2 * p..2 * p + 2].copy_from_slice(&inside[c].contact[2 * own..2 * own + 2]);
                solution.status[p] = inside[c].status[own];
            }
            solution
        };
        Ok((0..loads.len()).into_par_iter().map(solution).collect())
    }

    /// Corrects the statuses outside of the window at the end of a span, at `to`, where the contact
    /// conditions ask for others, friction counted from the jumps `start`; whether there are any.
    fn correct(&mut self, known: &Known<'_>, start: &[f64], to: f64) -> Result<bool, SteppingError> {
        let last = known.loads.len() - 1;
        let end = Known { loads: &known.loads[last..], inside: &known.inside[last..], ..*known };
        let mut is_inside = vec![false; self.problem.points()];
        known.points.iter().for_each(|&p| is_inside[p] = true);
        for round in 0..MOST_CORRECTIONS {
            let solution = &self.history.solution;
            let mut demands: Vec<(usize, PointStatus)> = Vec::new();
            for (k, points) in self.blocks.groups.iter().enumerate() {
                for (i, &p) in points.iter().enumerate().filter(|(_, p)| !is_inside[**p]) {
                    let allowed = ALLOWED * self.tolerance * self.history.scale[p];
                    let spring = self.blocks.own[k][(2 * i + 1, 2 * i + 1)];
                    let demand = demanded_beyond(self.problem, solution, p, start[2 * p], (allowed, spring));
                    demands.extend(demand.map(|status| (p, status)));
                }
            }
            if demands.is_empty() {
                return Ok(round > 0);
            }
            self.counts.iterations += 1;
            let step = if round < CORRECTED_AT_ONCE { 1 } else { 3 };
            for &(p, status) in demands.iter().step_by(step) {
                self.history.solution.status[p] = status;
            }
            self.frozen.set(&self.history.solution.status);
            if !self.frozen.enclose(known.window, self.interrupted).map_err(unsolvable(to))? {
                return Err(SteppingError::Interrupted { at: to });
            }
            if let Some(solution) = self.everywhere(&end, start).map_err(unsolvable(to))?.pop() {
                self.history.solution = solution;
            }
        }
        Ok(true)
    }
}

/// A path coordinate to go through.
#[derive(Debug, Clone, Copy)]
struct Station {
    at: f64,
    /// Whether the faces there are results.
    wanted: bool,
    /// Whether all faces are to be known there.
    known: bool,
}

/// Where all faces are to be known: under each of some loads (N/mm, 2p) those inside of a window.
#[derive(Clone, Copy)]
struct Known<'k> {
    window: &'k Range<usize>,
    /// The points in the window.
    points: &'k [usize],
    loads: &'k [Vec<f64>],
    inside: &'k [FaceSolution],
}

/// Violation of the contact conditions outside of the window that is none, over the tolerance of
/// the load steps times the largest jump seen at the point.
const ALLOWED: f64 = 0.03;
/// Difference of two jumps over the largest seen, over the tolerance of the load steps, that is
/// none.
const ALIKE: f64 = 0.25;
/// Solutions outside of the window until the forces between far groups are those of their jumps.
const FAR_ROUNDS: usize = 2;
/// Change of K from round to round of a span over its peak, below which it is accepted, over the
/// tolerance of the load steps.
const COUPLING: f64 = 1.0;
/// Rounds of a span at most.
const MOST_ROUNDS: usize = 3;
/// Distance of two stations over the length of the span, up to which they are one.
const SAME: f64 = 1e-9;

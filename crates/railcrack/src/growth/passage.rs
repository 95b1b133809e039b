//! One geometry under the wheel: residual stress, then passages until the history repeats.

use super::{FacePoint, FaceRecord, PassageRecord, SolverCounts, Watch};
use crate::contact::{ContactSolver, FaceProblem, FaceSolution, LoadPath, Stepper, SteppingError};
use crate::field::{HertzField, StressField};
use crate::fracture::{Sif, SifHistory};
use crate::load::{HertzianContact, Passage};
use thiserror::Error;

/// The wheel's passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassageSettings {
    /// Output positions.
    pub passage: Passage,
    /// Passages at most.
    pub max_passages: usize,
    /// Change of K between two passages, relative to its peak, below which the history repeats.
    pub passage_tolerance: f64,
    /// Tolerance of the load steps on K, relative to its peak.
    pub step_tolerance: f64,
}

/// What loads the uncracked rail.
#[derive(Clone, Copy)]
pub struct RailLoad<'a> {
    /// The wheel.
    pub contact: HertzianContact,
    /// ν.
    pub poisson: f64,
    /// Balanced residual stress.
    pub residual: Option<&'a dyn StressField>,
}

/// The stabilised passage and those before it.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilisedPassage {
    /// All passages, the stabilised one last.
    pub passages: Vec<PassageRecord>,
    /// Histories of the stabilised passage per tip: all accepted substeps and both unloaded ends.
    pub histories: Vec<SifHistory>,
    /// The faces at the output positions of the stabilised passage.
    pub faces: FaceRecord,
    /// Effort of all passages.
    pub counts: SolverCounts,
    /// Change of K between the last two passages relative to its peak; none after a single passage.
    pub last_change: Option<f64>,
}

/// A passage that could not be computed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PassageError {
    /// Contact did not converge.
    #[error("passage {passage}, {phase}: {source}")]
    NotConverged {
        /// Passage, from 1; 0 while residual stress is applied.
        passage: usize,
        /// Which part of it.
        phase: &'static str,
        /// Where on its path and how.
        source: SteppingError,
    },
    /// The watcher asked to stop.
    #[error("interrupted")]
    Interrupted,
}

/// Load on the faces along one part of the history.
struct FaceLoad<'a> {
    problem: &'a FaceProblem<'a>,
    load: RailLoad<'a>,
    /// Nodal forces of the residual stress.
    residual: &'a [f64],
    kind: PathKind,
}

#[derive(Clone, Copy)]
enum PathKind {
    /// Coordinate: share of the residual stress, 0 to 1.
    Ramp,
    /// Coordinate: 1 / (distance in mm from `origin` towards `side`); 0 is infinitely far.
    Far { origin: f64, side: f64 },
    /// Coordinate: x_c, mm.
    Over,
}

impl LoadPath for FaceLoad<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let xc = match self.kind {
            PathKind::Ramp => return self.residual.iter().map(|f| f * at).collect(),
            PathKind::Far { .. } if at == 0.0 => return self.residual.to_vec(),
            PathKind::Far { origin, side } => origin + side / at,
            PathKind::Over => at,
        };
        let wheel = HertzField::new(&self.load.contact, self.load.poisson);
        let stress = |point| wheel.stress(point, xc);
        let mut forces = self.problem.body().faces().nodal_forces(stress);
        forces.iter_mut().zip(self.residual).for_each(|(f, r)| *f += r);
        forces
    }
}

/// Stations of the approach from infinity and of the departure to it, evenly spaced in 1/distance: the load grows about
/// linearly from station to station.
const FAR_STATIONS: usize = 16;
/// Stations of the ramp of residual stress.
const RAMP_STATIONS: usize = 8;

/// Residual stress is ramped up on virgin faces; then wheels pass until the SIF histories of two consecutive passages
/// agree. Frictionless faces have no memory: one passage is all. The wheel comes from infinitely far and leaves to
/// infinitely far.
pub fn stabilised_passage(
    problem: &FaceProblem,
    solver: &dyn ContactSolver,
    load: RailLoad,
    settings: &PassageSettings,
    watch: &dyn Watch,
) -> Result<StabilisedPassage, PassageError> {
    let faces = problem.body().faces();
    let residual = match load.residual {
        Some(field) => faces.nodal_forces(|point| field.stress(point)),
        None => vec![0.0; 2 * problem.points()],
    };
    let xc = settings.passage.abscissae();
    let path = |kind| FaceLoad { problem, load, residual: &residual, kind };
    let expected = expected_slip(problem, &path(PathKind::Over), &xc);
    let mut stepper = Stepper::new(problem, solver, settings.step_tolerance, &expected);
    let failed = |passage, phase| move |source| PassageError::NotConverged { passage, phase, source };

    if load.residual.is_some() {
        stepper.begin(0.0);
        for k in 1..=RAMP_STATIONS {
            let at = k as f64 / RAMP_STATIONS as f64;
            stepper
                .advance(&path(PathKind::Ramp), at, &mut |_, _| {})
                .map_err(failed(0, "residual stress"))?;
        }
    }
    let (first, last) = (xc[0], xc[xc.len() - 1]);
    let travel = (last - first).signum();
    let reach = |x: f64| {
        let near = faces.samples.iter().map(|s| (s.point.x - x).abs()).fold(f64::INFINITY, f64::min);
        near.max(load.contact.half_width)
    };
    let tips = problem.body().tips().len();
    let mut passages: Vec<PassageRecord> = Vec::new();
    loop {
        let number = passages.len() + 1;
        let mut histories = vec![SifHistory::default(); tips];
        let mut record = |solution: &FaceSolution, forces: &[f64]| {
            let sifs = solution.sifs(problem.body(), forces);
            for (history, k) in histories.iter_mut().zip(sifs.chunks_exact(2)) {
                history.samples.push(Sif { k1: k[0], k2: k[1] });
            }
        };
        record(stepper.solution(), stepper.load());

        let distance = reach(first);
        let far = PathKind::Far { origin: first + travel * distance, side: -travel };
        stepper.begin(0.0);
        for k in 1..FAR_STATIONS {
            let at = k as f64 / FAR_STATIONS as f64 / distance;
            stepper.advance(&path(far), at, &mut record).map_err(failed(number, "approach"))?;
        }
        let over = path(PathKind::Over);
        let mut passage = PassageRecord { xc: xc.clone(), sifs: vec![Vec::with_capacity(xc.len()); tips] };
        let mut states = Vec::with_capacity(xc.len());
        let from_far =
            first + travel * distance - travel * distance * FAR_STATIONS as f64 / (FAR_STATIONS - 1) as f64;
        stepper.begin(from_far);
        for (i, &x) in xc.iter().enumerate() {
            if watch.interrupted() {
                return Err(PassageError::Interrupted);
            }
            stepper.advance(&over, x, &mut record).map_err(failed(number, "passage"))?;
            let sifs = stepper.solution().sifs(problem.body(), stepper.load());
            for (tip, k) in passage.sifs.iter_mut().zip(sifs.chunks_exact(2)) {
                tip.push(Sif { k1: k[0], k2: k[1] });
            }
            states.push(stepper.solution().face_states(problem));
            watch.progress((i + 1) as f64 / xc.len() as f64);
        }
        let distance = reach(last);
        let far = PathKind::Far { origin: last - travel * distance, side: travel };
        stepper.begin(1.0 / distance);
        for k in (0..FAR_STATIONS).rev() {
            let at = k as f64 / FAR_STATIONS as f64 / distance;
            stepper.advance(&path(far), at, &mut record).map_err(failed(number, "departure"))?;
        }
        let last_change = passages.last().map(|before| change(before, &passage));
        passages.push(passage);
        let repeats = last_change.is_some_and(|change| change <= settings.passage_tolerance);
        if repeats || number >= settings.max_passages || !problem.has_friction() {
            let points = faces
                .points
                .iter()
                .map(|p| FacePoint { crack: p.crack, segment: p.segment, s: p.s })
                .collect();
            let effort = stepper.counts();
            let counts = SolverCounts {
                passages: number,
                substeps: effort.substeps,
                solves: effort.solves,
                iterations: effort.iterations,
                iterations_max: effort.iterations_max,
                complementarity_max: effort.violation_max,
            };
            return Ok(StabilisedPassage {
                passages,
                histories,
                faces: FaceRecord { points, states },
                counts,
                last_change,
            });
        }
    }
}

/// The largest slip of each point, over some of the positions, with the faces free to move.
fn expected_slip(problem: &FaceProblem, over: &dyn LoadPath, xc: &[f64]) -> Vec<f64> {
    let mut slips = vec![0.0f64; problem.points()];
    for &x in xc.iter().step_by((xc.len() / 30).max(1)) {
        let jump = problem.body().compliance().times(&over.nodal_forces(x));
        for (slip, jump) in slips.iter_mut().zip(jump.chunks_exact(2)) {
            *slip = slip.max(jump[0].abs());
        }
    }
    slips
}

/// The largest change of K at any tip and position, relative to the largest |K| of both passages.
fn change(before: &PassageRecord, after: &PassageRecord) -> f64 {
    let pairs = before.sifs.iter().flatten().zip(after.sifs.iter().flatten());
    let (mut difference, mut peak) = (0.0f64, 0.0f64);
    for (a, b) in pairs {
        difference = difference.max((a.k1 - b.k1).abs()).max((a.k2 - b.k2).abs());
        for k in [a.k1, a.k2, b.k1, b.k2] {
            peak = peak.max(k.abs());
        }
    }
    if difference == 0.0 { 0.0 } else { difference / peak }
}

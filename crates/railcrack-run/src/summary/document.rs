//! `summary.json`: a run in numbers.

use super::condensed::condensed;
use super::outcome::Outcome;
use super::parts::{
    CrackSummary, FractureSummary, FrontSummary, JunctionSummary, PhaseSeconds, PieceSummary, TipSummary,
    WarningSummary,
};
use super::validity;
use crate::decision::{Decision, Verdict};
use crate::disk::files::SUMMARY_FILE;
use crate::disk::{VERSION, words};
use crate::error::OutputError;
use crate::log::{ResidualSummary, RunInfo, RunLog, StepDigest};
use railcrack::bulk::Boundary;
use railcrack::crack::{CrackEnd, Junction};
use railcrack::growth::{Piece, RunStop, StepRecord, Warning, WarningKind};
use railcrack::math::Vec2;
use railcrack_case::{ContactSolver, Engine};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `summary.json`: its keys are the names of the fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of the program.
    pub version: String,
    /// Title of the case.
    pub title: String,
    /// Engine.
    #[serde(with = "words")]
    pub engine: Engine,
    /// Contact solver.
    #[serde(with = "words")]
    pub contact: ContactSolver,
    /// Boundary of the rail.
    #[serde(with = "words")]
    pub boundary: Boundary,
    /// Half-width a of the wheel contact, mm.
    pub half_width_mm: f64,
    /// First and last wheel position of `[passage]`, mm; a rail that bends has output positions
    /// beyond.
    #[serde(default)]
    pub passage_mm: Option<[f64; 2]>,
    /// Whether the run has ended; otherwise `--resume` continues it.
    pub complete: bool,
    /// Why the run ended; null while it is not complete.
    #[serde(with = "words::optional")]
    pub stop: Option<RunStop>,
    /// Number of increments done: the number of the last finished step.
    pub steps: usize,
    /// Number of finished steps, the initial geometry counted.
    pub steps_recorded: usize,
    /// Load cycles (axles) at the start of the last finished step.
    pub load_cycles: f64,
    /// Their estimated error by the increments.
    #[serde(default)]
    pub load_cycles_error: f64,
    /// The same in million gross tonnes, where the case gives the axle load.
    pub million_gross_tonnes: Option<f64>,
    /// The verdict of the decision; without axle loads only whether the model describes the run,
    /// null if it does.
    #[serde(default)]
    pub verdict: Option<Verdict>,
    /// From growth to a decision; null without axle loads.
    #[serde(default)]
    pub decision: Option<Decision>,
    /// Wall time of the run and its resumptions, seconds.
    pub wall_s: f64,
    /// Wall time by phase.
    pub phases_s: PhaseSeconds,
    /// Peak memory, MB; null if the system does not provide it.
    pub peak_memory_mb: Option<f64>,
    /// Displacement unknowns, maximum over all steps.
    pub dofs: usize,
    /// Points on the crack faces, maximum over all steps.
    pub face_points: usize,
    /// Load steps between output positions, all steps together.
    pub substeps: usize,
    /// Contact solutions, all steps together.
    pub contact_solves: usize,
    /// Contact iterations per solution.
    pub contact_iterations_mean: f64,
    /// Maximum number of iterations of one solution.
    pub contact_iterations_max: usize,
    /// Largest violation of the contact conditions, relative.
    pub complementarity_max: f64,
    /// Passages until the history repeated, maximum over all steps.
    pub passages: usize,
    /// The same for each step.
    pub passages_per_step: Vec<usize>,
    /// The residual stress of the rail; null where it carries none.
    pub residual_stress: Option<ResidualSummary>,
    /// The largest k1, and how far it is from the toughness; null where no tip ever opened.
    #[serde(default)]
    pub fracture: Option<FractureSummary>,
    /// Warnings, in order.
    pub warnings: Vec<WarningSummary>,
    /// Tips in the last finished step.
    pub tips: Vec<TipSummary>,
    /// Paths.
    pub cracks: Vec<CrackSummary>,
    /// The first crack in space; left out in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub front: Option<FrontSummary>,
    /// All cracks in space where there are several; else left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fronts: Vec<FrontSummary>,
    /// Where cracks have joined each other.
    #[serde(default)]
    pub junctions: Vec<JunctionSummary>,
    /// Pieces of the rail that were enclosed, in order.
    #[serde(default)]
    pub pieces: Vec<PieceSummary>,
    /// Checksum of each table and field file as far as the finished steps wrote it (SHA-256).
    #[serde(default)]
    pub checksums: BTreeMap<String, String>,
    /// How the run of a study ended, once it is done: nothing is added to it any more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outcome: Option<Outcome>,
}

impl Summary {
    /// The summary of a run so far; with the samples of its decision where it `is_sampled`.
    pub(crate) fn new(info: &RunInfo, log: &RunLog, is_sampled: bool) -> Self {
        let steps = &log.steps;
        let last = steps.last();
        let sum = |count: fn(&StepDigest) -> usize| steps.iter().map(count).sum::<usize>();
        let most = |count: fn(&StepDigest) -> usize| steps.iter().map(count).max().unwrap_or(0);
        let solves = sum(|step| step.counts.solves);
        let load_cycles = last.map_or(0.0, |step| step.load_cycles);
        let stop = last.and_then(|step| step.stop);
        let decision = Decision::of(info, log, is_sampled);
        let of_decision = decision.as_ref().map(|decision| decision.verdict.clone());
        Self {
            version: VERSION.to_owned(),
            title: info.title.clone(),
            engine: info.engine,
            contact: info.contact,
            boundary: info.boundary,
            half_width_mm: info.half_width(),
            passage_mm: Some(info.passage),
            complete: stop.is_some(),
            stop,
            steps: last.map_or(0, |step| step.step),
            steps_recorded: steps.len(),
            load_cycles,
            load_cycles_error: last.map_or(0.0, |step| step.cycles_error),
            million_gross_tonnes: info.axle_load.map(|tonnes| load_cycles * tonnes / 1e6),
            verdict: of_decision.or_else(|| Verdict::without_traffic(info, log)),
            decision,
            wall_s: log.now.wall_s,
            phases_s: phases(log),
            peak_memory_mb: log.now.peak_memory_mb,
            dofs: most(|step| step.dofs),
            face_points: most(|step| step.face_points),
            substeps: sum(|step| step.counts.substeps),
            contact_solves: solves,
            contact_iterations_mean: sum(|step| step.counts.iterations) as f64 / solves.max(1) as f64,
            contact_iterations_max: most(|step| step.counts.iterations_max),
            complementarity_max: steps.iter().map(|step| step.counts.complementarity_max).fold(0.0, f64::max),
            passages: most(|step| step.counts.passages),
            passages_per_step: steps.iter().map(|step| step.counts.passages).collect(),
            residual_stress: log.now.residual.clone(),
            warnings: warnings(info, log),
            fracture: fracture(info, log),
            tips: last.map_or_else(Vec::new, |step| step.tips.iter().map(tip_summary).collect()),
            cracks: cracks(log),
            front: front(steps, 0),
            fronts: Some(fronts(steps)).filter(|fronts| fronts.len() > 1).unwrap_or_default(),
            junctions: log.now.junctions.iter().map(|junction| junction_summary(junction, log)).collect(),
            pieces: log.pieces().map(piece_summary).collect(),
            checksums: BTreeMap::new(),
            outcome: None,
        }
    }
}

fn phases(log: &RunLog) -> PhaseSeconds {
    let seconds = |time: fn(&StepDigest) -> f64| log.steps.iter().map(time).sum::<f64>();
    PhaseSeconds {
        residual: log.now.residual.as_ref().map_or(0.0, |residual| residual.wall_s),
        body: seconds(|step| step.times.body_s),
        body_mesh: seconds(|step| step.times.parts.mesh_s),
        body_enrichment: seconds(|step| step.times.parts.enrichment_s),
        body_border: seconds(|step| step.times.parts.border_s),
        body_sif: seconds(|step| step.times.parts.sif_s),
        body_condensation: seconds(|step| step.times.parts.condensation_s),
        contact: seconds(|step| step.times.contact_s),
        growth: seconds(|step| step.times.growth_s),
        output: log.now.output_s,
    }
}

/// The warnings of the case, of its residual stress and of its steps.
fn warnings(info: &RunInfo, log: &RunLog) -> Vec<WarningSummary> {
    let of_case = info.warnings.iter().cloned().chain(of_residual(log)).map(WarningSummary::of_case);
    of_case.chain(validity::of_steps(info, log)).chain(condensed(log.warnings())).collect()
}

/// The paths of the cracks, also of what is removed of them.
fn cracks(log: &RunLog) -> Vec<CrackSummary> {
    let both = log.now.initial_cracks.iter().zip(&log.now.cracks).enumerate();
    both.map(|(i, (initial, now))| CrackSummary {
        initial_points_mm: points(initial.points()),
        points_mm: points(now.points()),
        path_mm: log.now.paths.get(i).map(|path| points(path)),
    })
    .collect()
}

/// The cracks in space of a run there.
fn fronts(steps: &[StepDigest]) -> Vec<FrontSummary> {
    let cracks =
        steps.last().map_or(0, |last| last.tips.iter().map(|tip| tip.tip.crack + 1).max().unwrap_or(0));
    (0..cracks).map_while(|crack| front(steps, crack)).collect()
}

/// A crack in space of a run there, counted from 0.
fn front(steps: &[StepDigest], crack: usize) -> Option<FrontSummary> {
    let (first, last) = (steps.first()?, steps.last()?);
    let axes = |step: &StepDigest| {
        let tip = step.tips.iter().find(|tip| tip.tip.crack == crack)?;
        let front = tip.front()?;
        Some((tip.length, front.half_length, front.strip))
    };
    let (initial, now) = (axes(first)?, axes(last)?);
    let own = || last.tips.iter().filter(|tip| tip.tip.crack == crack);
    let lateral = || own().filter_map(|tip| Some(tip.front()?.lateral));
    let deviations = own().filter_map(|tip| tip.front()?.deviation).map(f64::abs);
    Some(FrontSummary {
        initial_length_mm: initial.0,
        initial_surface_half_length_mm: initial.1,
        length_mm: now.0,
        surface_half_length_mm: now.1,
        fold_mm: now.2,
        depth_mm: own().map(|tip| -tip.y).fold(0.0, f64::max),
        z_mm: [lateral().fold(f64::INFINITY, f64::min), lateral().fold(f64::NEG_INFINITY, f64::max)],
        front_deviation: deviations.reduce(f64::max),
    })
}

/// The k1 of all steps and tips that is largest in relation to the toughness under its wheel.
fn fracture(info: &RunInfo, log: &RunLog) -> Option<FractureSummary> {
    let tips = log.steps.iter().flat_map(|step| step.tips.iter().map(move |tip| (step, tip)));
    let opened = tips.filter_map(|(step, tip)| Some((step, tip, tip.largest_k1?)));
    let (step, tip, largest) =
        opened.reduce(|most, next| if next.1.compared_k1() > most.1.compared_k1() { next } else { most })?;
    let k1 = largest.k1_mpa_sqrt_m();
    let toughness = info.toughness.map(|first| first * tip.toughness_ratio);
    Some(FractureSummary {
        largest_k1_mpa_sqrt_m: k1,
        step: step.step,
        crack: tip.tip.crack + 1,
        tip: tip.tip.tip + 1,
        x_mm: tip.x,
        y_mm: tip.y,
        xc_mm: step.largest_k1_at,
        kink_deg: largest.angle.to_degrees(),
        toughness_mpa_sqrt_m: toughness,
        of_toughness: toughness.map(|toughness| k1 / toughness),
    })
}

/// Notes on the residual stress, as warnings before the first step.
fn of_residual(log: &RunLog) -> impl Iterator<Item = Warning> {
    let notes = log.now.residual.iter().flat_map(|residual| &residual.notes);
    notes.map(|text| Warning {
        step: 0,
        kind: WarningKind::ResidualStress,
        text: text.clone(),
        severity: None,
    })
}

fn junction_summary(junction: &Junction, log: &RunLog) -> JunctionSummary {
    let CrackEnd { crack, end } = junction.joining;
    let at = log.now.cracks.get(crack).map_or_else(Default::default, |crack| crack.tip(end));
    JunctionSummary { crack: crack + 1, end, onto: junction.onto + 1, x_mm: at.x, y_mm: at.y }
}

fn piece_summary(piece: &Piece) -> PieceSummary {
    PieceSummary {
        kind: piece.kind,
        step: piece.step,
        crack: piece.crack + 1,
        area_mm2: piece.area,
        thickness_mm: piece.thickness,
        cause: piece.cause,
        outline_mm: piece.outline.iter().map(|point| [point.x, point.y]).collect(),
    }
}

fn tip_summary(tip: &railcrack::growth::TipRecord) -> TipSummary {
    TipSummary {
        crack: tip.tip.crack + 1,
        tip: tip.tip.tip + 1,
        x_mm: tip.x,
        y_mm: tip.y,
        length_mm: tip.length,
        waiting_mm: tip.plane().map_or(0.0, |plane| plane.deferred.length),
        rate_mm_per_cycle: tip.rate,
        stop: tip.stop,
    }
}

fn points(points: &[Vec2]) -> Vec<[f64; 2]> {
    points.iter().map(|point| [point.x, point.y]).collect()
}

/// Checks results that are in the summary but in no table.
pub(crate) fn finite_summary(record: &StepRecord) -> Result<(), OutputError> {
    let value = record.counts.complementarity_max;
    if value.is_finite() {
        return Ok(());
    }
    let (file, column) = (SUMMARY_FILE, "complementarity_max");
    Err(OutputError::NotFinite { file, column, row: format!("step {}", record.step), value })
}

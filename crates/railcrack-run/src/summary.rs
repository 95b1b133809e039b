//! `summary.json`: a run in numbers.

use super::VERSION;
use super::decision::Decision;
use super::residual::ResidualSummary;
use super::run_info::RunInfo;
use super::run_log::{RunLog, StepDigest};
use super::study::Outcome;
use super::validity;
use crate::words;
use railcrack::bulk::Boundary;
use railcrack::crack::{CrackEnd, End, Junction};
use railcrack::growth::{Piece, PieceKind, RunStop, StepRecord, TipStop, Warning, WarningKind};
use railcrack::math::Vec2;
use railcrack_case::{ContactSolver, Engine};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Wall time by phase, of the run and its resumptions, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseSeconds {
    /// The residual stress: the plastic state of the rolled rail where it is wanted, projection and
    /// balance.
    pub residual: f64,
    /// The cracked body.
    pub body: f64,
    /// Of it: the mesh without cracks and its factor.
    pub body_mesh: f64,
    /// Of it: cutting elements, choosing functions and face points.
    pub body_enrichment: f64,
    /// Of it: the stiffness of the enriched functions.
    pub body_border: f64,
    /// Of it: stress intensity factors as functionals.
    pub body_sif: f64,
    /// Of it: the elimination of the unknowns behind the faces.
    pub body_condensation: f64,
    /// Loads on the faces and contact.
    pub contact: f64,
    /// Direction, rate, increments.
    pub growth: f64,
    /// Tables, checkpoints, plots.
    pub output: f64,
}

/// A tip in the last finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TipSummary {
    /// Number of its crack, from 1.
    pub crack: usize,
    /// Number of the tip within its crack, from 1.
    pub tip: usize,
    /// Abscissa, mm.
    pub x_mm: f64,
    /// Ordinate, mm.
    pub y_mm: f64,
    /// Length of its crack, with the deferred growth at its tips, mm.
    pub length_mm: f64,
    /// Its deferred growth, mm.
    pub waiting_mm: f64,
    /// da/dN in the last finished step, mm per cycle.
    pub rate_mm_per_cycle: f64,
    /// Why it stopped, where it did.
    #[serde(with = "words::optional")]
    pub stop: Option<TipStop>,
}

/// The path of a crack: points (x, y) in mm from the first to the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrackSummary {
    /// In step 0.
    pub initial_points_mm: Vec<[f64; 2]>,
    /// In the last finished step.
    pub points_mm: Vec<[f64; 2]>,
    /// The whole path with what wear and grinding have removed of it, in the coordinates of the
    /// initial surface; left out where nothing is removed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_mm: Option<Vec<[f64; 2]>>,
}

/// A crack in space in the first and in the last finished step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontSummary {
    /// Half axis down the dip in step 0, mm.
    pub initial_length_mm: f64,
    /// Half axis along the surface in step 0, mm.
    pub initial_surface_half_length_mm: f64,
    /// Half axis down the dip, mm.
    pub length_mm: f64,
    /// Half axis along the surface, mm.
    pub surface_half_length_mm: f64,
    /// Depth of the deepest point of the front, mm.
    pub depth_mm: f64,
    /// Lateral positions of its ends, mm.
    pub z_mm: [f64; 2],
}

/// A piece of the rail that cracks, or cracks and the running surface, enclose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PieceSummary {
    /// How it came to be.
    #[serde(with = "words")]
    pub kind: PieceKind,
    /// The step in which a tip closed the outline.
    pub step: usize,
    /// Number of the crack of that tip, from 1.
    pub crack: usize,
    /// Area, mm².
    pub area_mm2: f64,
    /// Corners (x, y) in order, mm; the last is joined to the first.
    pub outline_mm: Vec<[f64; 2]>,
}

/// A crack that has joined another one by the last finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JunctionSummary {
    /// Number of the joining crack, from 1.
    pub crack: usize,
    /// Which of its ends.
    #[serde(with = "words")]
    pub end: End,
    /// Number of the crack that it has joined, from 1.
    pub onto: usize,
    /// Abscissa, mm.
    pub x_mm: f64,
    /// Ordinate, mm.
    pub y_mm: f64,
}

/// How far the run is from brittle fracture: the largest k1 of its stabilised passages, over all
/// kink angles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FractureSummary {
    /// k1, MPa √m.
    pub largest_k1_mpa_sqrt_m: f64,
    /// The step in which it is reached.
    pub step: usize,
    /// Number of the crack, from 1.
    pub crack: usize,
    /// Number of the tip within its crack, from 1.
    pub tip: usize,
    /// Abscissa of the tip, mm.
    pub x_mm: f64,
    /// Ordinate of the tip, mm.
    pub y_mm: f64,
    /// x_c of the output position at which it is largest, mm; null where it is between two
    /// passages.
    pub xc_mm: Option<f64>,
    /// Angle of the kink from straight ahead, degrees, counter-clockwise positive.
    pub kink_deg: f64,
    /// K_Ic of `[fracture]`, MPa √m; null where the case has none.
    pub toughness_mpa_sqrt_m: Option<f64>,
    /// k1 over K_Ic; at 1 the rail breaks.
    pub of_toughness: Option<f64>,
}

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
    /// Whether the run has ended; otherwise `--resume` goes on.
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
    /// The same in million gross tonnes, where the case gives the axle load.
    pub million_gross_tonnes: Option<f64>,
    /// From growth to a decision; null without axle loads.
    #[serde(default)]
    pub decision: Option<Decision>,
    /// Wall time of the run and its resumptions, seconds.
    pub wall_s: f64,
    /// Wall time by phase.
    pub phases_s: PhaseSeconds,
    /// The most memory held, MB; null where the system does not tell.
    pub peak_memory_mb: Option<f64>,
    /// Displacement unknowns, the most of all steps.
    pub dofs: usize,
    /// Points on the crack faces, the most of all steps.
    pub face_points: usize,
    /// Load steps between output positions, all steps together.
    pub substeps: usize,
    /// Contact solutions, all steps together.
    pub contact_solves: usize,
    /// Contact iterations per solution.
    pub contact_iterations_mean: f64,
    /// The most iterations of one solution.
    pub contact_iterations_max: usize,
    /// Largest violation of the contact conditions, relative.
    pub complementarity_max: f64,
    /// Passages until the history repeated, the most of all steps.
    pub passages: usize,
    /// The same for each step.
    pub passages_per_step: Vec<usize>,
    /// The residual stress of the rail; null where it carries none.
    pub residual_stress: Option<ResidualSummary>,
    /// The largest k1, and how far it is from the toughness; null where no tip ever opened.
    #[serde(default)]
    pub fracture: Option<FractureSummary>,
    /// Warnings, in order.
    pub warnings: Vec<Warning>,
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
    /// Checksum of each table and field file as far as the finished steps wrote it (FNV-1a, 64
    /// bits).
    #[serde(default)]
    pub checksums: BTreeMap<String, String>,
    /// How the run of a study ended, once it is done: nothing is added to it any more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outcome: Option<Outcome>,
}

impl Summary {
    pub(crate) fn new(info: &RunInfo, log: &RunLog) -> Self {
        let steps = &log.steps;
        let last = steps.last();
        let sum = |count: fn(&StepDigest) -> usize| steps.iter().map(count).sum::<usize>();
        let most = |count: fn(&StepDigest) -> usize| steps.iter().map(count).max().unwrap_or(0);
        let seconds = |time: fn(&StepDigest) -> f64| steps.iter().map(time).sum::<f64>();
        let solves = sum(|step| step.counts.solves);
        let load_cycles = last.map_or(0.0, |step| step.load_cycles);
        let stop = last.and_then(|step| step.stop);
        Self {
            version: VERSION.to_owned(),
            title: info.title.clone(),
            engine: info.engine,
            contact: info.contact,
            boundary: info.boundary,
            half_width_mm: info.half_width,
            passage_mm: Some(info.passage),
            complete: stop.is_some(),
            stop,
            steps: last.map_or(0, |step| step.step),
            steps_recorded: steps.len(),
            load_cycles,
            million_gross_tonnes: info.axle_load.map(|tonnes| load_cycles * tonnes / 1e6),
            decision: Decision::of(info, log),
            wall_s: log.now.wall_s,
            phases_s: PhaseSeconds {
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
            },
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
            warnings: info
                .warnings
                .iter()
                .cloned()
                .chain(of_residual(log))
                .chain(validity::of_steps(info, log))
                .chain(log.warnings().cloned())
                .collect(),
            fracture: fracture(info, log),
            tips: last.map_or_else(Vec::new, |step| step.tips.iter().map(tip_summary).collect()),
            cracks: (log.now.initial_cracks.iter().zip(&log.now.cracks).enumerate())
                .map(|(i, (initial, now))| CrackSummary {
                    initial_points_mm: points(initial.points()),
                    points_mm: points(now.points()),
                    path_mm: log.now.paths.get(i).map(|path| points(path)),
                })
                .collect(),
            front: front(steps, 0),
            fronts: Some(fronts(steps)).filter(|fronts| fronts.len() > 1).unwrap_or_default(),
            junctions: log.now.junctions.iter().map(|junction| junction_summary(junction, log)).collect(),
            pieces: log.pieces().map(piece_summary).collect(),
            checksums: BTreeMap::new(),
            outcome: None,
        }
    }
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
        Some((tip.length, tip.front()?.half_length))
    };
    let (initial, now) = (axes(first)?, axes(last)?);
    let own = || last.tips.iter().filter(|tip| tip.tip.crack == crack);
    let lateral = || own().filter_map(|tip| Some(tip.front()?.lateral));
    Some(FrontSummary {
        initial_length_mm: initial.0,
        initial_surface_half_length_mm: initial.1,
        length_mm: now.0,
        surface_half_length_mm: now.1,
        depth_mm: own().map(|tip| -tip.y).fold(0.0, f64::max),
        z_mm: [lateral().fold(f64::INFINITY, f64::min), lateral().fold(f64::NEG_INFINITY, f64::max)],
    })
}

/// The largest k1 of all steps and tips.
fn fracture(info: &RunInfo, log: &RunLog) -> Option<FractureSummary> {
    let tips = log.steps.iter().flat_map(|step| step.tips.iter().map(move |tip| (step, tip)));
    let opened = tips.filter_map(|(step, tip)| Some((step, tip, tip.largest_k1?)));
    let (step, tip, largest) = opened.reduce(|most, next| if next.2.k1 > most.2.k1 { next } else { most })?;
    let k1 = largest.k1_mpa_sqrt_m();
    Some(FractureSummary {
        largest_k1_mpa_sqrt_m: k1,
        step: step.step,
        crack: tip.tip.crack + 1,
        tip: tip.tip.tip + 1,
        x_mm: tip.x,
        y_mm: tip.y,
        xc_mm: step.largest_k1_at,
        kink_deg: largest.angle.to_degrees(),
        toughness_mpa_sqrt_m: info.toughness,
        of_toughness: info.toughness.map(|toughness| k1 / toughness),
    })
}

/// Notes on the residual stress, as warnings before the first step.
fn of_residual(log: &RunLog) -> impl Iterator<Item = Warning> {
    let notes = log.now.residual.iter().flat_map(|residual| &residual.notes);
    notes.map(|text| Warning { step: 0, kind: WarningKind::ResidualStress, text: text.clone() })
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

/// Checks what has no column in a table and yet goes into the summary.
pub(crate) fn finite_summary(record: &StepRecord) -> Result<(), super::OutputError> {
    let value = record.counts.complementarity_max;
    if value.is_finite() {
        return Ok(());
    }
    let (file, column) = (super::files::SUMMARY_FILE, "complementarity_max");
    Err(super::OutputError::NotFinite { file, column, row: format!("step {}", record.step), value })
}

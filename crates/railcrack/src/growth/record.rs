//! What a growth step leaves behind.

use super::{DeferredGrowth, FieldRecord, Piece};
use crate::body::{BodyTimes, FacePoint};
use crate::contact::FaceState;
use crate::crack::{Crack, CrackEnd, CrackTip, Junction};
use crate::fatigue::{DirectionCriterion, ParisLaw};
use crate::fracture::Sif;
use crate::math::{OutOfRange, Vec2};
use serde::{Deserialize, Serialize};

/// How cracks grow and when a run ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowthSettings {
    /// Number of increments; 0 computes the initial cracks only.
    pub steps: usize,
    /// Increment of the fastest tip as a fraction of its crack's current length.
    pub increment: f64,
    /// Rate.
    pub law: ParisLaw,
    /// Rate (mm per cycle) below which a tip is arrested.
    pub arrest_rate: f64,
    /// Direction.
    pub criterion: DirectionCriterion,
    /// A crack this long (mm) ends the run.
    pub critical_length: Option<f64>,
    /// This many load cycles end the run.
    pub stop_after_cycles: Option<f64>,
}

/// As a case file that says nothing: the reference values of the paper.
impl Default for GrowthSettings {
    fn default() -> Self {
        Self {
            steps: 25,
            increment: 0.04,
            law: ParisLaw::RAIL_STEEL,
            arrest_rate: 1e-9,
            criterion: DirectionCriterion::MaxRate,
            critical_length: None,
            stop_after_cycles: None,
        }
    }
}

impl GrowthSettings {
    /// Refuses an increment that is none, and limits that are not numbers.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let fraction = self.increment > 0.0 && self.increment.is_finite();
        OutOfRange::unless(fraction, "increment over the crack length", self.increment, "positive")?;
        let at_least_zero =
            |quantity, value: f64| OutOfRange::unless(value >= 0.0, quantity, value, "zero or more");
        at_least_zero("arrest rate (mm per cycle)", self.arrest_rate)?;
        at_least_zero("critical length (mm)", self.critical_length.unwrap_or(0.0))?;
        at_least_zero("cycles to stop after", self.stop_after_cycles.unwrap_or(0.0))
    }
}

/// A tip that broke out, and where its ligament ends on the running surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BreakOut {
    /// The tip: it stays where it was.
    pub tip: CrackEnd,
    /// The point of the surface, mm.
    pub surface: Vec2,
}

/// Why a tip stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TipStop {
    /// ΔK_eq at or below the threshold, or a rate below the arrest rate.
    Arrest,
    /// The ligament to the running surface is spent: a spall.
    BreakOut,
    /// It joins a crack, with the increment of this step where the step is made; without an increment, it came so close that no
    /// junction can be made.
    Coalescence,
    /// The next increment would leave the rail.
    LeavesRail,
}

impl TipStop {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrest => "arrest",
            Self::BreakOut => "break-out",
            Self::Coalescence => "meets-crack",
            Self::LeavesRail => "leaves-rail",
        }
    }
}

/// Why the run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum RunStop {
    /// All increments done.
    StepsDone,
    /// The number of load cycles asked for.
    Cycles,
    /// A crack reached the critical length.
    CriticalLength,
    /// A piece of the rail is wholly detached.
    Detached,
    /// No tip grows; the reason of the last one that stopped.
    NoTipGrows(TipStop),
}

impl RunStop {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::StepsDone => "steps-done",
            Self::Cycles => "cycles",
            Self::CriticalLength => "critical-length",
            Self::Detached => "detached",
            Self::NoTipGrows(stop) => stop.name(),
        }
    }
}

/// One passage on fixed cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct PassageRecord {
    /// Output positions x_c in the order of travel, mm.
    pub xc: Vec<f64>,
    /// `sifs[tip][position]`, MPa √mm.
    pub sifs: Vec<Vec<Sif>>,
}

/// The faces during the stabilised passage.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceRecord {
    /// The face points, crack by crack, along the walk.
    pub points: Vec<FacePoint>,
    /// `states[position][point]`.
    pub states: Vec<Vec<FaceState>>,
}

/// One tip at one step: the state at its start, and what was decided.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TipRecord {
    /// Which tip.
    pub tip: CrackTip,
    /// Abscissa of the tip, mm.
    pub x: f64,
    /// Ordinate of the tip, mm.
    pub y: f64,
    /// Length of its crack, with the deferred growth of its tips, mm.
    pub length: f64,
    /// Its growth that is not in the crack yet.
    pub deferred: DeferredGrowth,
    /// Largest K_I of the stabilised passage, MPa √mm.
    pub ki_max: f64,
    /// Range of K_I (clipped at zero), MPa √mm.
    pub delta_ki: f64,
    /// Range of K_II, MPa √mm.
    pub delta_kii: f64,
    /// ΔK_eq of the actual tip, MPa √mm.
    pub delta_keq: f64,
    /// Chosen kink, radians, counter-clockwise positive; none for a tip that does not load at all.
    pub kink: Option<f64>,
    /// The best other local maximum at least 15° away, radians.
    pub secondary: Option<f64>,
    /// Its rate over the best rate.
    pub secondary_ratio: Option<f64>,
    /// Increment to the next step, mm, in the crack or deferred; 0 in the last step and for a stopped tip. Negative for a tip that joins a
    /// crack which lies across its deferred growth.
    pub increment: f64,
    /// da/dN, mm per cycle.
    pub rate: f64,
    /// Why this tip does not grow, if it does not.
    pub stop: Option<TipStop>,
}

/// What the solvers did in one step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SolverCounts {
    /// Passages until the history repeated.
    pub passages: usize,
    /// Load steps between output positions, beyond the one that each position needs.
    pub substeps: usize,
    /// Contact solutions.
    pub solves: usize,
    /// Contact iterations, all solutions together.
    pub iterations: usize,
    /// The most iterations of one solution.
    pub iterations_max: usize,
    /// Largest violation of the law of the faces, relative to the largest traction and jump.
    pub complementarity_max: f64,
}

/// Wall time of the phases of one step, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseTimes {
    /// The cracked body: C and S, and its fields where they are wanted.
    pub body_s: f64,
    /// Parts of it, as far as the engine tells.
    pub parts: BodyTimes,
    /// Loads on the faces and contact through all passages.
    pub contact_s: f64,
    /// Direction, rate, increments.
    pub growth_s: f64,
}

/// What a warning is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WarningKind {
    /// How the engine represents the cracks.
    Engine,
    /// The other contact solver took over.
    ContactFallback,
    /// Two kinks are nearly as good.
    NearTie,
    /// The history of K still changes from passage to passage.
    Passages,
    /// The residual stress, and how it was balanced.
    ResidualStress,
}

impl WarningKind {
    /// The name in output files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Engine => "engine",
            Self::ContactFallback => "contact-fallback",
            Self::NearTie => "near-tie",
            Self::Passages => "passages",
            Self::ResidualStress => "residual-stress",
        }
    }
}

/// Something the reader of the results must know.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// The step at which it arose.
    pub step: usize,
    /// What it is about.
    pub kind: WarningKind,
    /// One sentence with its numbers.
    pub text: String,
}

/// One growth step: the cracks at its start, their stabilised passage, and the increments to the next step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepRecord {
    /// Step number; 0 is the initial geometry.
    pub step: usize,
    /// The cracks at the start of the step.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    /// All tips, in order of crack and tip; ends that have joined a crack are none.
    pub tips: Vec<TipRecord>,
    /// All passages; the last one is the stabilised one.
    pub passages: Vec<PassageRecord>,
    /// The faces during the stabilised passage.
    pub faces: FaceRecord,
    /// The fields around the cracks, where they are wanted and the engine has them.
    pub fields: Option<FieldRecord>,
    /// Load cycles at the start of the step.
    pub load_cycles: f64,
    /// Number of displacement unknowns of the body.
    pub dofs: usize,
    /// Solver effort.
    pub counts: SolverCounts,
    /// Wall times.
    pub times: PhaseTimes,
    /// Pieces of the rail that were enclosed in this step.
    pub pieces: Vec<Piece>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Set in the last step of a run.
    pub stop: Option<RunStop>,
}

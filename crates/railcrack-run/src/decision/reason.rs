//! Reasons for a verdict, and the levels that they lead to.

use super::act_on::RiskAtInterval;
use super::risk_summary::RiskSummary;
use super::tonnage::TonnageWords;
use railcrack::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// Consequence of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VerdictLevel {
    /// The rail does not fail within the run.
    Ok,
    /// The rail fails within the run, or too many cracks fail before an inspection finds them.
    Act,
    /// The run ends before its question is answered.
    Unknown,
    /// The rail fails at once, or before the crack is detectable.
    Stop,
    /// The model does not describe this.
    Outside,
}

impl VerdictLevel {
    /// Its word in results.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Act => "act",
            Self::Unknown => "unknown",
            Self::Stop => "stop",
            Self::Outside => "outside",
        }
    }
}

/// Kinds of reasons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReasonKind {
    /// The rail fails within the run.
    Failure,
    /// It fails within the first increment.
    AtOnce,
    /// It fails before the crack is detectable.
    BeforeDetectable,
    /// The probability that a crack fails before it is found exceeds the target.
    Risk,
    /// The end of the run, not of the rail.
    EndOfRun,
    /// The steps end before a failure, and before the traffic at which the run would end.
    Steps,
    /// The run was interrupted.
    Interrupted,
    /// The cracks leave the rail of the model.
    LeavesRail,
    /// K_I beyond the toughness of the steel, without `[fracture]`.
    Toughness,
    /// Fluid lifts the flap from what would press it down.
    LiftedFlap,
    /// Growth into the depth faster than cracks grow.
    Rate,
    /// A tip in the layer that yields in each passage.
    PlasticLayer,
    /// A growth law of another material, or in another unit.
    GrowthLaw,
}

/// A reason for a verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reason {
    /// Its kind.
    pub kind: ReasonKind,
    /// A sentence.
    pub text: String,
    /// Crack, from 1.
    pub crack: Option<usize>,
    /// Tip, from 1.
    pub tip: Option<usize>,
    /// Growth step of the worst case.
    pub step: Option<usize>,
    /// Million gross tonnes until then.
    pub mgt: Option<f64>,
    /// The value in question.
    pub value: Option<f64>,
    /// Its limit.
    pub limit: Option<f64>,
}

impl Choice for ReasonKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Failure, Word::now("failure", "failure within the run")),
        (Self::AtOnce, Word::now("at-once", "failure within the first increment")),
        (Self::BeforeDetectable, Word::now("before-detectable", "failure before the crack is detectable")),
        (Self::Risk, Word::now("risk", "risk between inspections above the target")),
        (Self::EndOfRun, Word::now("end-of-run", "no failure within the run")),
        (Self::Steps, Word::now("steps", "the steps end before the answer is known")),
        (Self::Interrupted, Word::now("interrupted", "the run was interrupted")),
        (Self::LeavesRail, Word::now("leaves-rail", "the cracks leave the rail of the model")),
        (Self::Toughness, Word::now("toughness", "K beyond the toughness of the steel")),
        (Self::LiftedFlap, Word::now("lifted-flap", "fluid lifts the flap")),
        (Self::Rate, Word::now("rate", "growth faster than cracks grow")),
        (Self::PlasticLayer, Word::now("plastic-layer", "a tip in the layer that flows")),
        (Self::GrowthLaw, Word::now("growth-law", "a growth law of another material or unit")),
    ];
}

impl ReasonKind {
    /// Its meaning in a few words.
    #[must_use]
    pub fn words(self) -> &'static str {
        self.meaning()
    }

    /// The level that it leads to.
    pub(super) fn level(self) -> VerdictLevel {
        match self {
            Self::EndOfRun => VerdictLevel::Ok,
            Self::Failure | Self::Risk => VerdictLevel::Act,
            Self::Steps | Self::Interrupted | Self::LeavesRail => VerdictLevel::Unknown,
            Self::AtOnce | Self::BeforeDetectable => VerdictLevel::Stop,
            Self::Toughness | Self::LiftedFlap | Self::Rate | Self::PlasticLayer | Self::GrowthLaw => {
                VerdictLevel::Outside
            }
        }
    }
}

impl Reason {
    /// Of `kind` with its `text` alone.
    pub(super) fn new(kind: ReasonKind, text: String) -> Self {
        Self { kind, text, crack: None, tip: None, step: None, mgt: None, value: None, limit: None }
    }

    /// A risk between inspections above its `target`.
    pub(super) fn of_risk(
        risk: &RiskSummary,
        (at, target): (RiskAtInterval, f64),
        words: TonnageWords,
    ) -> Self {
        let which = match risk.act_on {
            Some(of) => {
                format!("with inspections less often than every {}", words.of(of.interval_mgt))
            }
            None => "with inspections at any interval".to_owned(),
        };
        let text = format!(
            "{which}, the probability that a crack fails before it is found is above the target of {}",
            probability(target)
        );
        Self { value: Some(at.probability), limit: Some(target), ..Self::new(ReasonKind::Risk, text) }
    }
}

/// `value` with three digits.
fn probability(value: f64) -> String {
    if value > 0.0 && value < 1e-3 { format!("{value:.2e}") } else { format!("{value:.4}") }
}

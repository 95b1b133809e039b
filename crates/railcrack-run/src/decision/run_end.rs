//! The end of a run as a reason for its verdict: a failure, or why there is none.

use super::course::FailureMode;
use super::failure::{FailureSummary, Nominal};
use super::governing::DecisionPath;
use super::reason::{Reason, ReasonKind};
use super::tonnage::{TonnageWords, three_digits};
use crate::log::{RunInfo, StepDigest};
use railcrack::growth::{Piece, PieceCause, PieceKind, RunStop, TipStop};

/// Whether no crack grows any longer, for whatever traffic.
fn is_at_rest(stop: RunStop) -> bool {
    let rests = [TipStop::Arrest, TipStop::Coalescence, TipStop::WornAway, TipStop::BreakOut];
    matches!(stop, RunStop::NoTipGrows(stop) if rests.contains(&stop))
}

/// A run whose end is judged.
pub(super) struct Judged<'a> {
    pub info: &'a RunInfo,
    /// The path of its cracks.
    pub path: DecisionPath,
    pub steps: &'a [StepDigest],
    pub nominal: &'a Nominal,
    /// Mean load of an axle, t.
    pub tonnes: f64,
    pub words: TonnageWords,
}

impl<'a> Judged<'a> {
    /// Million gross tonnes until `step`.
    fn mgt(&self, step: &StepDigest) -> f64 {
        step.mgt(self.tonnes)
    }

    /// The steps up to the failure, the first among them in any case.
    pub fn steps_to_failure(&self) -> Vec<&'a StepDigest> {
        let end = self.nominal.failure.mgt.unwrap_or(f64::INFINITY);
        let steps = self.steps.iter().enumerate();
        let until = steps.filter(|(i, step)| *i == 0 || self.mgt(step) <= end * (1.0 + 1e-9));
        until.map(|(_, step)| step).collect()
    }

    /// The failure within the run.
    pub fn failure(&self) -> Option<Reason> {
        let FailureSummary { mode, mgt: until, mgt_error, crack, tip } = self.nominal.failure;
        let (mode, until) = (mode?, until?);
        let second = self.steps.get(1).map_or(f64::INFINITY, |step| self.mgt(step));
        let step = self.steps.iter().rev().find(|step| self.mgt(step) <= until * (1.0 + 1e-9));
        let whose = crack.map_or_else(String::new, |crack| format!(" of crack {crack}"));
        let what = format!("{}{whose}{}", mode.words(), self.lost_piece(mode, crack));
        let error = mgt_error.map(|error| 100.0 * error / until).filter(|percent| *percent > 0.0);
        let error = error.map(|percent| format!("± {:.1} % by the increments", percent.max(0.1)));
        let notes: Vec<&str> = self.path.note().into_iter().chain(error.as_deref()).collect();
        let notes = notes.join(", ");
        let life = self.words.noted(until, Some(notes.as_str()).filter(|notes| !notes.is_empty()));
        let (kind, text) = if until == 0.0 {
            (ReasonKind::AtOnce, format!("{what} at once"))
        } else if until <= second {
            (ReasonKind::AtOnce, format!("{what} within the first increment, after {life}"))
        } else if self.info.inspection.is_some()
            && self.nominal.detected.is_none_or(|detected| detected >= until)
        {
            (ReasonKind::BeforeDetectable, format!("{what} after {life}, before the crack is detectable"))
        } else {
            (ReasonKind::Failure, format!("{what} after {life}"))
        };
        Some(Reason {
            crack,
            tip,
            step: step.map(|step| step.step),
            mgt: Some(until),
            ..Reason::new(kind, text)
        })
    }

    /// The size of the piece whose loss is the failure, in brackets.
    fn lost_piece(&self, mode: FailureMode, crack: Option<usize>) -> String {
        let kind = match mode {
            FailureMode::Spall => PieceKind::Spall,
            FailureMode::Detached => PieceKind::Detached,
            _ => return String::new(),
        };
        let mut pieces = self.steps.iter().flat_map(|step| &step.pieces);
        let own = pieces.find(|piece| piece.kind == kind && Some(piece.crack + 1) == crack);
        own.map_or_else(String::new, |piece| {
            let [thickness, area] = [piece.thickness, piece.area].map(three_digits);
            format!(" ({thickness} mm thick, {area} mm² in section)")
        })
    }

    /// The end of a run without a failure.
    pub fn end_of_run(&self) -> Option<Reason> {
        let Self { info, nominal, words, .. } = *self;
        let last = self.steps.last()?;
        let until = words.of(self.mgt(last));
        let (kind, text) = match (nominal.replaced, nominal.worn, last.stop) {
            (Some(replaced), ..) => (
                ReasonKind::EndOfRun,
                format!("the rail is worn to the limit at which it is replaced after {}", words.of(replaced)),
            ),
            (None, Some(worn), _) => (
                ReasonKind::EndOfRun,
                format!("the cracks are worn away after {}{}", words.of(worn), self.flake()),
            ),
            (None, None, Some(stop)) if is_at_rest(stop) => {
                (ReasonKind::EndOfRun, format!("no crack grows any longer{}", self.flake()))
            }
            (None, None, Some(RunStop::StepsDone)) => (
                ReasonKind::Steps,
                format!(
                    "the {} steps of the run end after {until} without a failure, and what follows is not known: {}",
                    last.step,
                    remedy(info)
                ),
            ),
            (None, None, Some(RunStop::NoTipGrows(TipStop::LeavesRail))) => (
                ReasonKind::LeavesRail,
                format!("the cracks leave the rail of the model after {until}: what follows is not known"),
            ),
            (None, None, None) => {
                (ReasonKind::Interrupted, format!("the run is not complete: it has come to {until}"))
            }
            _ => (ReasonKind::EndOfRun, format!("no failure up to {until}, where the run ends")),
        };
        Some(Reason {
            step: Some(last.step),
            mgt: Some(nominal.replaced.or(nominal.worn).unwrap_or_else(|| self.mgt(last))),
            ..Reason::new(kind, text)
        })
    }

    /// The flakes that have come off without a failure, in words.
    fn flake(&self) -> String {
        let pieces = self.steps.iter().flat_map(|step| &step.pieces);
        let Some(piece) =
            pieces.reduce(|most, next| if next.thickness > most.thickness { next } else { most })
        else {
            return String::new();
        };
        let how = match piece.cause {
            PieceCause::Growth => "has broken out",
            PieceCause::Wear => "has come off by wear",
            PieceCause::Grinding => "has come off with a grinding",
        };
        format!(": {} {how}, which is no failure", flake_in_words(piece))
    }
}

/// A piece of the surface in words.
fn flake_in_words(piece: &Piece) -> String {
    let [thickness, area] = [piece.thickness, piece.area].map(three_digits);
    format!("a flake {thickness} mm thick, {area} mm² in section,")
}

/// The change to make where the steps of a run end too soon.
fn remedy(info: &RunInfo) -> &'static str {
    let critical_depth = info.inspection.and_then(|inspection| inspection.critical_depth);
    match critical_depth.or(info.critical_length).or(info.toughness) {
        Some(_) => {
            "leave out [growth] steps, with which the run goes on until its answer is known, or give stop_after_cycles for the traffic in question"
        }
        None => {
            "say what a failure is (critical_depth_mm in [inspection], critical_length_mm in [growth] or [fracture]), or give stop_after_cycles for the traffic in question"
        }
    }
}

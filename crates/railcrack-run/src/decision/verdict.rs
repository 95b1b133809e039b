//! The verdict: one level for the whole run, with its reasons.

use super::act_on::RiskAtInterval;
use super::course::FailureMode;
use super::failure::{FailureSummary, Nominal, NominalRun};
use super::governing::{DecisionPath, Governing};
use super::risk_summary::RiskSummary;
use super::tonnage::{TonnageWords, three_digits};
use crate::log::{RunInfo, RunLog, StepDigest};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{Piece, PieceCause, PieceKind, RunStop, TipRecord, TipStop};
use railcrack::math::MPA_SQRT_MM;
use railcrack::validity::{self, UNCOUPLED_OPENING};
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

/// The verdict on a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The level: that of the gravest reason.
    pub level: VerdictLevel,
    /// The reasons, the gravest first.
    pub reasons: Vec<Reason>,
}

/// Growth into the depth over that which needs a reason, beyond which the model does not describe
/// what happens: about thirty times the fastest that is measured in track at the same depth.
const BEYOND_FAST: f64 = 10.0;

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
    ];
}

impl ReasonKind {
    /// Its meaning in a few words.
    #[must_use]
    pub fn words(self) -> &'static str {
        self.meaning()
    }

    fn level(self) -> VerdictLevel {
        match self {
            Self::EndOfRun => VerdictLevel::Ok,
            Self::Failure | Self::Risk => VerdictLevel::Act,
            Self::Steps | Self::Interrupted | Self::LeavesRail => VerdictLevel::Unknown,
            Self::AtOnce | Self::BeforeDetectable => VerdictLevel::Stop,
            Self::Toughness | Self::LiftedFlap | Self::Rate | Self::PlasticLayer => VerdictLevel::Outside,
        }
    }
}

impl Reason {
    fn new(kind: ReasonKind, text: String) -> Self {
        Self { kind, text, crack: None, tip: None, step: None, mgt: None, value: None, limit: None }
    }

    /// A risk between inspections above its `target`.
    fn of_risk(risk: &RiskSummary, (at, target): (RiskAtInterval, f64), words: TonnageWords) -> Self {
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

impl Verdict {
    /// The verdict for `reasons`.
    fn of_reasons(mut reasons: Vec<Reason>) -> Self {
        reasons.sort_by_key(|reason| std::cmp::Reverse(reason.kind.level()));
        let level = reasons.first().map_or(VerdictLevel::Ok, |reason| reason.kind.level());
        Self { level, reasons }
    }

    /// The verdict on `run`, of the steps of `log`, by itself.
    pub(crate) fn of(info: &RunInfo, log: &RunLog, run: &NominalRun) -> Self {
        Self::along(info, log, run, &Governing::alone(run, &log.steps))
    }

    /// The verdict on `run`, of the steps of `log`, with the failure along the path that governs it:
    /// whether the model describes it is asked of the run.
    pub(crate) fn along(info: &RunInfo, log: &RunLog, run: &NominalRun, governing: &Governing<'_>) -> Self {
        let tonnes = run.question.tonnes;
        let words = TonnageWords::of_year(info);
        let of = |path, nominal, steps| Judged { info, path, steps, nominal, tonnes, words };
        let own = of(DecisionPath::Nominal, &run.nominal, log.steps.as_slice());
        let judged = of(governing.path, &governing.run.nominal, governing.steps);
        let steps = own.steps_to_failure();
        let mut reasons = limits_of_model(info, &steps);
        reasons.extend(rate(&steps, tonnes));
        for reason in &mut reasons {
            let step = steps.iter().find(|step| Some(step.step) == reason.step);
            reason.mgt = step.map(|step| step.mgt(tonnes));
        }
        reasons.extend(judged.failure());
        if reasons.is_empty() {
            reasons.extend(judged.end_of_run());
        }
        Self::of_reasons(reasons)
    }

    /// The verdict on a run without axle loads: whether the model describes it; none if it does.
    pub(crate) fn without_traffic(info: &RunInfo, log: &RunLog) -> Option<Self> {
        let steps: Vec<&StepDigest> = log.steps.iter().collect();
        let reasons = limits_of_model(info, &steps);
        (!reasons.is_empty()).then(|| Self::of_reasons(reasons))
    }

    /// The verdict with the reason that the `risk` exceeds its target, if it does; the end of a run
    /// is no reason beside it.
    pub(super) fn with_risk(mut self, risk: &RiskSummary, words: TonnageWords) -> Self {
        let Some(exceeded) = risk.exceeds_target() else { return self };
        self.reasons.push(Reason::of_risk(risk, exceeded, words));
        self.reasons.retain(|reason| reason.kind != ReasonKind::EndOfRun);
        Self::of_reasons(self.reasons)
    }

    /// The kinds of its reasons, the gravest first, each once, separated by spaces.
    #[must_use]
    pub fn kinds(&self) -> String {
        let mut kinds: Vec<&str> = Vec::new();
        for reason in &self.reasons {
            if !kinds.contains(&reason.kind.word()) {
                kinds.push(reason.kind.word());
            }
        }
        kinds.join(" ")
    }

    /// Whether intervals mean anything.
    #[must_use]
    pub fn gives_intervals(&self) -> bool {
        self.level < VerdictLevel::Unknown
    }
}

/// `value` with three digits.
fn probability(value: f64) -> String {
    if value > 0.0 && value < 1e-3 { format!("{value:.2e}") } else { format!("{value:.4}") }
}

/// A reason at the tip of `worst`, with its step.
fn of_tip(reason: Reason, step: &StepDigest, tip: &TipRecord, value: f64, limit: f64) -> Reason {
    Reason {
        crack: Some(tip.tip.crack + 1),
        tip: Some(tip.tip.tip + 1),
        step: Some(step.step),
        value: Some(value),
        limit: Some(limit),
        ..reason
    }
}

/// The tip of all steps with the largest value of `of`.
fn worst<'a>(
    steps: &[&'a StepDigest],
    of: impl Fn(&TipRecord) -> Option<f64>,
) -> Option<(&'a StepDigest, &'a TipRecord, f64)> {
    let tips = steps.iter().flat_map(|step| step.tips.iter().map(move |tip| (*step, tip)));
    let valued = tips.filter_map(|(step, tip)| Some((step, tip, of(tip)?)));
    valued.reduce(|most, next| if next.2 > most.2 { next } else { most })
}

/// The limits of the model that `steps` exceed, whatever the traffic.
fn limits_of_model(info: &RunInfo, steps: &[&StepDigest]) -> Vec<Reason> {
    [toughness(info, steps), flap(info, steps), layer(info, steps)].into_iter().flatten().collect()
}

fn toughness(info: &RunInfo, steps: &[&StepDigest]) -> Option<Reason> {
    if info.toughness.is_some() {
        return None;
    }
    let steel = info.steel.unwrap_or(RailSteel::USUAL);
    let limit = steel.mean_toughness;
    let text = |what: &str, value: f64| {
        format!(
            "{what} is {value:.0} MPa√m, beyond the toughness of {limit:.0} MPa√m of {}: give [fracture], with which the run ends there",
            steel.name
        )
    };
    // A kink that arrests is a pop-in; in space no kink is tested, and open faces count.
    let breaks = steps.iter().filter_map(|step| {
        let test = step.pop_in_test.filter(|test| !test.arrests(MPA_SQRT_MM * limit))?;
        // A kink that cannot be computed is not known to arrest.
        Some(match test.k1_after {
            Some(after) => (step, after / MPA_SQRT_MM, "k1 at the end of a real kink"),
            None => (step, test.k1 / MPA_SQRT_MM, "k1 of a kink"),
        })
    });
    let largest = breaks.reduce(|most, next| if next.1 > most.1 { next } else { most });
    if let Some((step, value, what)) = largest {
        let reason = Reason::new(ReasonKind::Toughness, text(what, value));
        return Some(Reason { step: Some(step.step), value: Some(value), limit: Some(limit), ..reason });
    }
    let opened = |tip: &TipRecord| Some(tip.ki_max / MPA_SQRT_MM);
    let (step, tip, value) = worst(steps, opened).filter(|(_, _, value)| *value > limit)?;
    Some(of_tip(Reason::new(ReasonKind::Toughness, text("K_I", value)), step, tip, value, limit))
}

fn flap(info: &RunInfo, steps: &[&StepDigest]) -> Option<Reason> {
    let step =
        steps.iter().filter(|_| info.fluid).max_by(|a, b| a.unfelt_opening.total_cmp(&b.unfelt_opening))?;
    let opening = step.unfelt_opening;
    validity::flap(opening)?;
    let wheel = match info.engine.is_in_space() {
        true => "",
        false => "let the wheel feel the cracks ([contact] coupled = true) or ",
    };
    let text = format!(
        "fluid lifts the flap above a crack by {opening:.3} mm, which the wheel would press shut: {wheel}limit the pressure ([fluid] pressure_cap_mpa)"
    );
    let reason = Reason { step: Some(step.step), ..Reason::new(ReasonKind::LiftedFlap, text) };
    Some(Reason { value: Some(opening), limit: Some(UNCOUPLED_OPENING), ..reason })
}

/// Growth of each tip into the depth, from its rate and from its depths.
fn rate(steps: &[&StepDigest], tonnes: f64) -> Option<Reason> {
    let all = (0..steps.len()).filter_map(|i| Some((steps[i], deepening(steps, i, tonnes)?)));
    let limit = |tip: &TipRecord| BEYOND_FAST * validity::fast_growth(tip.depth());
    let excess = |(_, (tip, value)): &(&StepDigest, (&TipRecord, f64))| value / limit(tip);
    let fastest = all.reduce(|most, next| if excess(&next) > excess(&most) { next } else { most });
    let (step, (tip, value)) = fastest.filter(|fastest| excess(fastest) > 1.0)?;
    let text = format!(
        "a crack {} mm deep gets deeper by {} mm per million gross tonnes, about {:.0} times the fastest growth that is measured in track at that depth: calibrate the growth law (railcrack calibrate) or check the loads",
        three_digits(tip.depth()),
        three_digits(value),
        value / validity::measured_growth(validity::FASTEST_MEASURED, tip.depth())
    );
    Some(of_tip(Reason::new(ReasonKind::Rate, text), step, tip, value, limit(tip)))
}

/// The tip that gets deeper fastest in step `i`, mm per million gross tonnes.
pub(crate) fn deepening<'a>(steps: &[&'a StepDigest], i: usize, tonnes: f64) -> Option<(&'a TipRecord, f64)> {
    let here = *steps.get(i)?;
    let next = steps.get(i + 1);
    let deeper = |tip: &TipRecord| {
        // The sine of the way in the steel; of cracks that were not followed, that at the mouth.
        let sine = match next {
            Some(next) => {
                let same = next.tips.iter().find(|other| other.tip == tip.tip)?;
                let steel = (same.depth() + next.removed) - (tip.depth() + here.removed);
                (tip.increment > 0.0).then(|| (steel / tip.increment).min(1.0))?
            }
            None if steps.len() == 1 => tip.mouth_sine?,
            None => return None,
        };
        let value = 1e6 / tonnes * tip.rate * sine;
        value.is_finite().then_some(value)
    };
    let all = here.tips.iter().filter_map(|tip| Some((tip, deeper(tip)?)));
    all.reduce(|most, next| if next.1 > most.1 { next } else { most })
}

fn layer(info: &RunInfo, steps: &[&StepDigest]) -> Option<Reason> {
    let [top, bottom] = info.flowing?;
    let below = |tip: &TipRecord| {
        let flows = tip.depth() > top && tip.depth() < bottom && tip.rate > 0.0;
        flows.then_some(bottom - tip.depth())
    };
    let (step, tip, _) = worst(steps, below)?;
    let text = format!(
        "the contact is beyond the limit of plastic shakedown, and a tip is {:.2} mm deep, in the layer from {top:.2} to {bottom:.2} mm that flows in each passage: K of an elastic rail does not describe it",
        tip.depth()
    );
    Some(of_tip(Reason::new(ReasonKind::PlasticLayer, text), step, tip, tip.depth(), bottom))
}

/// Whether no crack grows any longer, for whatever traffic.
fn is_at_rest(stop: RunStop) -> bool {
    let rests = [TipStop::Arrest, TipStop::Coalescence, TipStop::WornAway, TipStop::BreakOut];
    matches!(stop, RunStop::NoTipGrows(stop) if rests.contains(&stop))
}

/// A run whose end is judged.
struct Judged<'a> {
    info: &'a RunInfo,
    /// The path of its cracks.
    path: DecisionPath,
    steps: &'a [StepDigest],
    nominal: &'a Nominal,
    /// Mean load of an axle, t.
    tonnes: f64,
    words: TonnageWords,
}

impl<'a> Judged<'a> {
    /// Million gross tonnes until `step`.
    fn mgt(&self, step: &StepDigest) -> f64 {
        step.mgt(self.tonnes)
    }

    /// The steps up to the failure, the first among them in any case.
    fn steps_to_failure(&self) -> Vec<&'a StepDigest> {
        let end = self.nominal.failure.mgt.unwrap_or(f64::INFINITY);
        let steps = self.steps.iter().enumerate();
        let until = steps.filter(|(i, step)| *i == 0 || self.mgt(step) <= end * (1.0 + 1e-9));
        until.map(|(_, step)| step).collect()
    }

    /// The failure within the run.
    fn failure(&self) -> Option<Reason> {
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
    fn end_of_run(&self) -> Option<Reason> {
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

/// What to change where the steps of a run end too soon.
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

//! The verdict: one level for the whole run, with its reasons.

use super::failure::{FailureSummary, Nominal, NominalRun};
use super::risk_summary::{RiskAtInterval, RiskSummary};
use super::tonnage::{TonnageWords, three_digits};
use crate::log::{RunInfo, RunLog, StepDigest};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{RunStop, TipRecord, TipStop};
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
    /// The steps of the case end before a failure that it asks for, and before the traffic at
    /// which it would end.
    StepLimit,
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

/// The verdict on a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The level: that of the gravest reason.
    pub level: VerdictLevel,
    /// The reasons, the gravest first.
    pub reasons: Vec<Reason>,
}

/// Growth into the depth (mm per million gross tonnes) beyond which the model does not describe
/// what happens: ten times what the fastest head checks in track are found to grow.
const LARGEST_RATE: f64 = 3.0;

impl Choice for ReasonKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Failure, Word::now("failure", "failure within the run")),
        (Self::AtOnce, Word::now("at-once", "failure within the first increment")),
        (Self::BeforeDetectable, Word::now("before-detectable", "failure before the crack is detectable")),
        (Self::Risk, Word::now("risk", "risk between inspections above the target")),
        (Self::EndOfRun, Word::now("end-of-run", "no failure within the run")),
        (Self::StepLimit, Word::now("step-limit", "the steps end before the traffic that is asked for")),
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

    fn level(self) -> VerdictLevel {
        match self {
            Self::EndOfRun => VerdictLevel::Ok,
            Self::Failure | Self::Risk | Self::StepLimit => VerdictLevel::Act,
            Self::AtOnce | Self::BeforeDetectable => VerdictLevel::Stop,
            Self::Toughness | Self::LiftedFlap | Self::Rate | Self::PlasticLayer | Self::GrowthLaw => {
                VerdictLevel::Outside
            }
        }
    }
}

impl Reason {
    fn new(kind: ReasonKind, text: String) -> Self {
        Self { kind, text, crack: None, tip: None, step: None, mgt: None, value: None, limit: None }
    }

    /// A risk between inspections above its `target`.
    fn of_risk(at: RiskAtInterval, target: f64, words: TonnageWords) -> Self {
        let text = format!(
            "with inspections every {}, the probability that a crack fails before it is found is {}, above the target of {}",
            words.of(at.interval_mgt),
            probability(at.probability),
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

    /// The verdict on `run`, of the steps of `log`.
    pub(crate) fn of(info: &RunInfo, log: &RunLog, run: &NominalRun) -> Self {
        let tonnes = run.question.tonnes;
        let judged = Judged { info, log, nominal: &run.nominal, tonnes, words: TonnageWords::of_year(info) };
        let steps = judged.steps_to_failure();
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
        let Some((at, target)) = risk.exceeds_target() else { return self };
        self.reasons.push(Reason::of_risk(at, target, words));
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
        self.level < VerdictLevel::Stop
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
    let law = info.unusual_law.clone().map(|text| Reason::new(ReasonKind::GrowthLaw, text));
    [law, toughness(info, steps), flap(info, steps), layer(info, steps)].into_iter().flatten().collect()
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
    let fastest = all.reduce(|most, next| if next.1.1 > most.1.1 { next } else { most });
    let (step, (tip, value)) = fastest.filter(|(_, (_, value))| *value > LARGEST_RATE)?;
    let text = format!(
        "a crack gets deeper by {} mm per million gross tonnes, more than {LARGEST_RATE}, which is ten times what the fastest head checks in track are found to grow: calibrate the growth law (railcrack calibrate) or check the loads",
        three_digits(value)
    );
    Some(of_tip(Reason::new(ReasonKind::Rate, text), step, tip, value, LARGEST_RATE))
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
    matches!(stop, RunStop::NoTipGrows(TipStop::Arrest | TipStop::Coalescence | TipStop::WornAway))
}

/// Whether the case says what a failure is.
fn asks_for_failure(info: &RunInfo) -> bool {
    let critical_depth = info.inspection.and_then(|inspection| inspection.critical_depth);
    critical_depth.or(info.critical_length).or(info.toughness).is_some()
}

/// A run whose end is judged.
struct Judged<'a> {
    info: &'a RunInfo,
    log: &'a RunLog,
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
        let steps = self.log.steps.iter().enumerate();
        let until = steps.filter(|(i, step)| *i == 0 || self.mgt(step) <= end * (1.0 + 1e-9));
        until.map(|(_, step)| step).collect()
    }

    /// The failure within the run.
    fn failure(&self) -> Option<Reason> {
        let FailureSummary { mode, mgt: until, mgt_error, crack, tip } = self.nominal.failure;
        let (mode, until) = (mode?, until?);
        let second = self.log.steps.get(1).map_or(f64::INFINITY, |step| self.mgt(step));
        let step = self.log.steps.iter().rev().find(|step| self.mgt(step) <= until * (1.0 + 1e-9));
        let whose = crack.map_or_else(String::new, |crack| format!(" of crack {crack}"));
        let what = format!("{}{whose}", mode.words());
        let life = match mgt_error.map(|error| 100.0 * error / until).filter(|percent| *percent > 0.0) {
            Some(percent) => {
                self.words.noted(until, Some(&format!("± {:.1} % by the increments", percent.max(0.1))))
            }
            None => self.words.of(until),
        };
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

    /// The end of a run without a failure.
    fn end_of_run(&self) -> Option<Reason> {
        let Self { info, nominal, words, .. } = *self;
        let last = self.log.steps.last()?;
        let is_over = nominal.worn.or(nominal.replaced).is_some();
        // Without steps a run is one of K alone, unless somebody is to decide by it.
        let decides = last.step > 0 || info.inspection.is_some();
        let is_cut = !is_over && last.stop == Some(RunStop::StepsDone) && decides;
        let is_unknown = asks_for_failure(info) || last.step == 0;
        let kind = if is_cut && is_unknown { ReasonKind::StepLimit } else { ReasonKind::EndOfRun };
        let text = match (nominal.worn, last.stop) {
            _ if nominal.replaced.is_some() => format!(
                "the rail is worn to the limit at which it is replaced after {}",
                words.of(nominal.replaced.unwrap_or_default())
            ),
            (Some(worn), _) => format!("the cracks are worn away after {}", words.of(worn)),
            (None, Some(stop)) if is_at_rest(stop) => "no crack grows any longer".to_owned(),
            _ if kind == ReasonKind::StepLimit => format!(
                "the {} steps of the case end after {} without a failure, and what follows is not known: give more steps in [growth], or stop_after_cycles for the traffic in question",
                last.step,
                words.of(self.mgt(last))
            ),
            _ => {
                format!(
                    "the run ends after {} without a failure: what follows is not known",
                    words.of(self.mgt(last))
                )
            }
        };
        Some(Reason {
            step: Some(last.step),
            mgt: Some(nominal.replaced.or(nominal.worn).unwrap_or_else(|| self.mgt(last))),
            ..Reason::new(kind, text)
        })
    }
}

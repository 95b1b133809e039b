//! The verdict: one level for the whole run, with its reasons.

use super::failure::NominalRun;
use super::governing::{DecisionPath, Governing};
use super::reason::{Reason, ReasonKind, VerdictLevel};
use super::risk_summary::RiskSummary;
use super::run_end::Judged;
use super::tonnage::{TonnageWords, three_digits};
use crate::log::{RunInfo, RunLog, StepDigest};
use railcrack::fatigue::RailSteel;
use railcrack::growth::TipRecord;
use railcrack::math::MPA_SQRT_MM;
use railcrack::validity::{self, UNCOUPLED_OPENING};
use railcrack::words::Choice;
use serde::{Deserialize, Serialize};

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

    /// The verdict on `run`, of the steps of `log`, with the failure along the path that governs
    /// it: whether the model describes it is asked of the run.
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
        "the contact is beyond the limit of elastic shakedown, and a tip is {:.2} mm deep, in the layer from {top:.2} to {bottom:.2} mm that flows in each passage: K of an elastic rail does not describe it",
        tip.depth()
    );
    Some(of_tip(Reason::new(ReasonKind::PlasticLayer, text), step, tip, tip.depth(), bottom))
}

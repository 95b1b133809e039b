//! Warnings where a case or its results are outside the validity of the model.

use crate::log::{RunInfo, RunLog, StepDigest};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{Warning, WarningKind};
use railcrack::math::MPA_SQRT_MM;
use railcrack::shakedown::ContactBounds;
use railcrack::validity::{self, ResidualStress, ValidityWarning};
use railcrack_case::{Case, GivenWheel};

/// The steel whose toughness is used if the case gives none.
const USUAL_STEEL: &str = "R260";

/// Warnings that follow from the case alone.
pub fn of_case(case: &Case) -> Vec<Warning> {
    let shortest = case.cracks.cracks().iter().map(|crack| crack.length()).fold(f64::INFINITY, f64::min);
    let mut warnings: Vec<Warning> =
        validity::crack_length(shortest).iter().map(|warning| at_step(0, warning)).collect();
    if case.mix.is_empty() {
        warnings.extend(of_wheel(case, &case.wheel));
    }
    for mixed in &case.mix {
        let of_one = of_wheel(case, &mixed.wheel);
        warnings.extend(
            of_one
                .into_iter()
                .map(|warning| Warning { text: format!("{}: {}", mixed.name, warning.text), ..warning }),
        );
    }
    warnings
}

/// Warnings that follow from the load of one wheel.
fn of_wheel(case: &Case, wheel: &GivenWheel) -> Vec<Warning> {
    let contact = wheel.contact();
    let is_given = case.residual_stress.is_some() || case.plastic_stress.is_some();
    let residual = if is_given { ResidualStress::Given } else { ResidualStress::Absent };
    let yield_stress = case.shakedown.hardening.yield_stress();
    let of_bounds = |bounds: &ContactBounds| validity::pressure(contact, bounds, yield_stress, residual);
    let all = [
        validity::half_width(contact.half_width()),
        wheel.contact_bounds(&case.steel, of_bounds).flatten(),
        validity::shear(contact),
        wheel.load.track.as_ref().and_then(validity::axles),
    ];
    all.into_iter().flatten().map(|warning| at_step(0, &warning)).collect()
}

/// Warnings that follow from the finished steps: each where it first applies.
pub(crate) fn of_steps(info: &RunInfo, log: &RunLog) -> Vec<Warning> {
    let first = |of: &dyn Fn(&StepDigest) -> Option<ValidityWarning>| {
        log.steps.iter().find_map(|step| Some(at_step(step.step, &of(step)?)))
    };
    let depth = |step: &StepDigest| {
        let deepest = step.tips.iter().map(|tip| -tip.y).fold(0.0, f64::max);
        info.bends.then(|| validity::depth_in_bending(deepest)).flatten()
    };
    let usual = RailSteel::of(USUAL_STEEL);
    let toughness = |step: &StepDigest| {
        let usual = usual.filter(|_| info.toughness.is_none())?;
        let k1 = step.tips.iter().filter_map(|tip| Some(tip.largest_k1?.k1)).fold(0.0, f64::max);
        validity::toughness(k1, MPA_SQRT_MM * usual.mean_toughness, usual.name)
    };
    // The fastest tip determines the life of the rail.
    let growth = |step: &StepDigest| {
        let fastest = step.tips.iter().filter(|tip| tip.increment > 0.0);
        let fastest = fastest.max_by(|a, b| a.rate.total_cmp(&b.rate))?;
        validity::growth(fastest.delta_keq / MPA_SQRT_MM, info.law_table)
    };
    let flap = |step: &StepDigest| info.fluid.then(|| validity::flap(step.largest_opening)).flatten();
    [first(&depth), first(&toughness), first(&growth), first(&flap)].into_iter().flatten().collect()
}

fn at_step(step: usize, warning: &ValidityWarning) -> Warning {
    Warning { step, kind: WarningKind::Validity, text: warning.to_string() }
}

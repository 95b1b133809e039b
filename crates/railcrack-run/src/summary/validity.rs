//! Warnings where a case or its results are outside the validity of the model.

use crate::log::{RunInfo, RunLog, StepDigest};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{TipRecord, Warning, WarningKind};
use railcrack::math::MPA_SQRT_MM;
use railcrack::shakedown::ContactBounds;
use railcrack::validity::{self, ResidualStress, Steel, SteelOrigin, ValidityWarning};
use railcrack_case::{Case, GivenWheel};
use std::f64::consts::FRAC_PI_2;

/// Warnings that follow from the case alone.
pub fn of_case(case: &Case) -> Vec<Warning> {
    let shortest = case.cracks.cracks().iter().map(|crack| crack.length()).fold(f64::INFINITY, f64::min);
    let angles = case.cracks.cracks().iter().map(|crack| {
        let (first, next) = crack.segment(0);
        (next - first).angle().to_degrees().abs()
    });
    let flattest = angles.fold(f64::INFINITY, f64::min);
    let of_cracks = [validity::crack_length(shortest), validity::crack_angle(flattest)];
    let mut warnings: Vec<Warning> = of_cracks.iter().flatten().map(|warning| at_step(0, warning)).collect();
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

/// The text of a warning with `#` instead of its numbers: what runs that differ in numbers share.
pub fn pattern(text: &str) -> String {
    let mut pattern = String::with_capacity(text.len());
    for letter in text.chars() {
        let is_of_number = letter.is_ascii_digit() || (letter == '.' && pattern.ends_with('#'));
        if !is_of_number {
            pattern.push(letter);
        } else if !pattern.ends_with('#') {
            pattern.push('#');
        }
    }
    pattern
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

/// Depths (mm) between which the steel flows in each passage: where a wheel is beyond the limit of
/// shakedown of the depth. None where all wheels are within it.
pub(crate) fn flowing(case: &Case) -> Option<[f64; 2]> {
    let shear_yield = case.shakedown.hardening.yield_stress() / 3f64.sqrt();
    let depths: Vec<f64> = (0..=FLOW_DEPTHS).map(|i| i as f64 * DEEPEST_FLOW / FLOW_DEPTHS as f64).collect();
    let of_wheel = |wheel: &GivenWheel| {
        let (peak, half_width) = (wheel.contact().peak_pressure(), wheel.half_width());
        wheel.contact_bounds(&case.steel, |bounds: &ContactBounds| {
            if peak <= shear_yield * bounds.shakedown_limit().ratio {
                return None;
            }
            let by_depth = bounds.by_depth(&depths);
            let flows = by_depth.iter().filter(|depth| peak > shear_yield * depth.shakedown);
            let all = flows.map(|depth| depth.depth_over_a * half_width);
            all.fold(None, |range: Option<[f64; 2]>, depth| {
                Some(range.map_or([depth; 2], |[top, bottom]| [top.min(depth), bottom.max(depth)]))
            })
        })
    };
    let wheels = case.mix.iter().map(|mixed| &mixed.wheel).chain([&case.wheel]);
    let ranges = wheels.filter_map(|wheel| of_wheel(wheel).flatten());
    ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// Depths over the half-width at which flow is looked for.
const FLOW_DEPTHS: usize = 100;
const DEEPEST_FLOW: f64 = 3.0;

/// Warnings that follow from the finished steps: each where it first applies.
pub(crate) fn of_steps(info: &RunInfo, log: &RunLog) -> Vec<Warning> {
    let first = |of: &dyn Fn(&StepDigest) -> Option<ValidityWarning>| {
        log.steps.iter().find_map(|step| Some(at_step(step.step, &of(step)?)))
    };
    let depth = |step: &StepDigest| {
        let deepest = step.tips.iter().map(|tip| -tip.y).fold(0.0, f64::max);
        info.bends.then(|| validity::depth_in_bending(deepest)).flatten()
    };
    let steel = Steel {
        toughness: info.steel.unwrap_or(RailSteel::USUAL).mean_toughness,
        name: info.steel.unwrap_or(RailSteel::USUAL).name,
        origin: if info.steel.is_some() { SteelOrigin::Case } else { SteelOrigin::Assumed },
    };
    let tests = || {
        let tests = log.steps.iter().filter_map(|step| Some((step.step, step.pop_in_test?)));
        tests.filter(|_| info.toughness.is_none())
    };
    // In space no kink is tested.
    let in_space = |step: &StepDigest| {
        info.engine.is_in_space().then_some(()).filter(|()| info.toughness.is_none())?;
        let k1 = step.tips.iter().filter_map(|tip| Some(tip.largest_k1?.k1)).fold(0.0, f64::max);
        validity::toughness(k1, None, &steel)
    };
    let limit = MPA_SQRT_MM * steel.toughness;
    // The first kink that breaks the rail; if there is none, the first that arrests.
    let kink = tests().find(|(_, test)| !test.arrests(limit)).or_else(|| tests().next());
    let kink = kink.and_then(|(step, test)| {
        let after = validity::KinkAfter { length: test.length, k1: test.k1_after };
        Some(at_step(step, &validity::toughness(test.k1, Some(after), &steel)?))
    });
    // The fastest tip determines the life of the rail.
    let growth = |step: &StepDigest| {
        let fastest = step.tips.iter().filter(|tip| tip.increment > 0.0);
        let fastest = fastest.max_by(|a, b| a.rate.total_cmp(&b.rate))?;
        validity::growth(fastest.delta_keq / MPA_SQRT_MM, info.law_table)
    };
    let wish = |step: &StepDigest| {
        let distance =
            |tip: &&TipRecord| tip.front().map_or(f64::INFINITY, |front| (front.phi - FRAC_PI_2).abs());
        let deepest = step.tips.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?.front()?;
        validity::out_of_plane(deepest.wanted_kink?.to_degrees(), deepest.wanted_ratio?)
    };
    let flap = |step: &StepDigest| info.fluid.then(|| validity::flap(step.largest_opening)).flatten();
    [first(&depth), kink.or_else(|| first(&in_space)), first(&growth), first(&flap), first(&wish)]
        .into_iter()
        .flatten()
        .collect()
}

fn at_step(step: usize, warning: &ValidityWarning) -> Warning {
    Warning { step, kind: WarningKind::Validity, text: warning.to_string() }
}

#[cfg(test)]
mod tests {
    use super::pattern;

    #[test]
    fn a_pattern_has_no_numbers() {
        assert_eq!(pattern("p0 of 845.5 MPa, step 12."), "p# of # MPa, step #");
        assert_eq!(pattern("beyond 1.0: no"), pattern("beyond 23.75: no"));
    }
}

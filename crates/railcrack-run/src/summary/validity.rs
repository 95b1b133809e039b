//! Warnings where a case or its results are outside the validity of the model.

use super::parts::WarningSummary;
use crate::decision::deepening;
use crate::log::{RunInfo, RunLog, StepDigest};
use crate::setup::{self, EffectInPlane, WheelBounds};
use railcrack::bulk::Boundary;
use railcrack::fatigue::RailSteel;
use railcrack::growth::{TipRecord, Warning, WarningKind};
use railcrack::math::MPA_SQRT_MM;
use railcrack::validity::{self, LineContact, ResidualStress, Steel, SteelOrigin, ValidityWarning};
use railcrack_case::{Case, GivenWheel, Implausible, Topic, implausible};
use std::cell::LazyCell;
use std::f64::consts::FRAC_PI_2;

/// Change of the growth rate from which on a wheel should feel the cracks.
const LARGE_EFFECT: f64 = 0.05;

/// [`of_case`], and the warning about a wheel that does not feel the cracks, where that changes
/// their growth.
pub fn before_a_run(case: &Case) -> Vec<Warning> {
    let effect = LazyCell::new(|| EffectInPlane::of_case(case));
    let uncoupled = |text| Warning { step: 0, kind: WarningKind::Validity, text, severity: None };
    let of_case = with_effect(case, || *effect);
    of_case.into_iter().chain(uncoupled_wheel(case, *effect).map(uncoupled)).collect()
}

fn uncoupled_wheel(case: &Case, effect: Option<EffectInPlane>) -> Option<String> {
    let rate = effect?.rate;
    let remedy = match case.space().is_some() {
        true => "the space engine has no such wheel, the plane engines do",
        false => "set contact.coupled = true",
    };
    ((rate - 1.0).abs() > LARGE_EFFECT).then(|| {
        format!(
            "under a wheel that feels the crack, the first crack, alone and dry in the plane, would grow at {rate:.2} times the rate: {remedy}"
        )
    })
}

/// Warnings that follow from the case alone.
pub fn of_case(case: &Case) -> Vec<Warning> {
    with_effect(case, || EffectInPlane::of_case(case))
}

/// [`of_case`], with the effect of a wheel that feels the first crack where it is asked for.
fn with_effect(case: &Case, effect: impl Fn() -> Option<EffectInPlane>) -> Vec<Warning> {
    let of_input = |remark: Implausible| Warning {
        step: 0,
        kind: WarningKind::Input,
        text: remark.text,
        severity: None,
    };
    let mut warnings: Vec<Warning> = implausible(case).into_iter().map(of_input).collect();
    let widths = case.plane().map_or(&[][..], |plane| &plane.widths);
    let narrowest = 2.0 * widths.iter().copied().fold(f64::INFINITY, f64::min);
    warnings.extend(validity::crack_width(narrowest).iter().map(|warning| at_step(0, warning)));
    if case.has_fluid() && setup::rolls_on_patches(case) {
        warnings.push(at_step(0, &ValidityWarning::FluidUnderPatch));
    }
    if let Some(steel) = case.growth_steel
        && let Some(typical) = steel.typical()
    {
        let text = format!(
            "growth.steel = \"{}\" is the fastest growth that EN 13674-1 accepts, a limit and not the growth of a rail; steel = \"{}\" is a fifth of it",
            steel.name, typical.name
        );
        warnings.push(Warning { step: 0, kind: WarningKind::Validity, text, severity: None });
    }
    let of_table = case.wheel_table.as_ref().map_or(case.wheels.len(), |table| table.first);
    for (number, wheel) in case.wheels[..of_table].iter().enumerate() {
        let named = |warning: Warning| match case.is_mix() {
            true => Warning { text: format!("{}: {}", wheel.name, warning.text), ..warning },
            false => warning,
        };
        warnings.extend(of_wheel(case, number).into_iter().map(named));
    }
    warnings.extend(of_wheel_table(case));
    warnings.extend(uncoupled_gap(case, effect));
    warnings.extend(case.companions().iter().filter_map(|file| {
        let text = unused_columns(file.given, file.unused)?;
        Some(Warning { step: 0, kind: WarningKind::Input, text, severity: None })
    }));
    warnings
}

/// Where the user's book says what warnings of these kinds mean and what to do; none for none.
pub fn warning_pages(kinds: impl Iterator<Item = WarningKind>) -> Option<String> {
    let mut pages: Vec<String> = Vec::new();
    for page in kinds.map(WarningKind::page) {
        if !pages.contains(&page) {
            pages.push(page);
        }
    }
    (!pages.is_empty()).then(|| pages.join(", "))
}

/// The remark on the growth law of `case`, where no life follows from it.
pub(crate) fn unusual_law(case: &Case) -> Option<String> {
    implausible(case).into_iter().find(|remark| remark.topic == Topic::GrowthLaw).map(|remark| remark.text)
}

/// A warning of the columns `unused` that the file `name` has and railcrack does not read.
pub fn unused_columns(name: &str, unused: &[String]) -> Option<String> {
    let names: Vec<String> = unused.iter().map(|column| format!("`{column}`")).collect();
    (!names.is_empty()).then(|| format!("{name}: these columns are not read: {}", names.join(", ")))
}

/// Gap over a²/2R from which on a wheel should feel the crack.
const LARGE_GAP: f64 = 0.05;

/// A warning where a wheel over a crack in space would feel it.
fn uncoupled_gap(case: &Case, effect: impl Fn() -> Option<EffectInPlane>) -> Option<Warning> {
    let gap = setup::uncoupled_gap(case).filter(|gap| *gap > LARGE_GAP)?;
    let in_plane = effect().map_or_else(String::new, |plane| {
        format!(
            "; in the plane, where it is {:.0} %, the coupled wheel of the plane engines makes the rate {:.2} times",
            100.0 * plane.gap,
            plane.rate
        )
    });
    let text = format!(
        "the surface beside the first crack leaves the wheel by up to {:.0} % of the depth by which the contact flattens it, and the space engine computes the contact on the uncracked rail only{in_plane}",
        100.0 * gap
    );
    Some(Warning { step: 0, kind: WarningKind::Validity, text, severity: Some(gap) })
}

/// Warnings about the wheels of a table: of its representatives one of each kind, and the error of
/// their mean rate.
fn of_wheel_table(case: &Case) -> Vec<Warning> {
    let Some(table) = &case.wheel_table else { return Vec::new() };
    let Some(groups) = &table.groups else { return Vec::new() };
    let representatives = case.wheels.iter().enumerate().skip(table.first).take(groups.representatives.len());
    let mut kinds: Vec<(String, Warning, usize)> = Vec::new();
    for (number, mixed) in representatives {
        for warning in of_wheel(case, number) {
            let kind = pattern(&warning.text);
            match kinds.iter_mut().find(|(known, ..)| *known == kind) {
                Some((_, _, count)) => *count += 1,
                None => {
                    let text = format!("{}: {}", mixed.name, warning.text);
                    kinds.push((kind, Warning { text, ..warning }, 1));
                }
            }
        }
    }
    let of = |(_, warning, count): (String, Warning, usize)| match count {
        1 => warning,
        _ => {
            let all = groups.representatives.len();
            let text = format!("{count} of {all} representatives, such as {}", warning.text);
            Warning { text, ..warning }
        }
    };
    let mut warnings: Vec<Warning> = kinds.into_iter().map(of).collect();
    if groups.error.abs() > table.accepted {
        let text = format!(
            "the mean growth rate of the representatives is off by {:.2} % of that of all wheels by the coarse crack, more than representatives_error",
            100.0 * groups.error
        );
        warnings.push(Warning { step: 0, kind: WarningKind::Validity, text, severity: None });
    }
    warnings
}

/// The text of a warning with `#` instead of its numbers, signs included: what runs, or steps, that
/// differ in numbers share.
pub fn pattern(text: &str) -> String {
    let mut pattern = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let before_digit = letters.peek().is_some_and(char::is_ascii_digit);
        let is_sign = letter == '-' && before_digit && pattern.ends_with([' ', '(', 'e']);
        let is_of_number = is_sign || letter.is_ascii_digit() || (letter == '.' && pattern.ends_with('#'));
        if !is_of_number {
            pattern.push(letter);
        } else if !pattern.ends_with('#') {
            pattern.push('#');
        }
    }
    pattern
}

/// Warnings that follow from the load of the wheel `number`, from 0.
fn of_wheel(case: &Case, number: usize) -> Vec<Warning> {
    let wheel = &case.wheels[number].wheel;
    let Some(contact) = wheel.contact() else { return Vec::new() };
    let is_given = case.residual_stress.is_some() || case.plastic_stress().is_some();
    let residual = if is_given { ResidualStress::Given } else { ResidualStress::Absent };
    let yield_stress = case.shakedown.hardening.yield_stress();
    let of_bounds = |bounds: WheelBounds| {
        let limits = [bounds.first_yield.ratio, bounds.shakedown.ratio];
        validity::pressure(contact, limits, yield_stress, residual)
    };
    let all = [
        WheelBounds::of(case, number).and_then(of_bounds),
        validity::shear(contact),
        setup::patch_beside(case, number).and_then(validity::patch_beside),
        strip_of_patch(case, wheel),
        wheel.track.as_ref().and_then(validity::axles),
    ];
    all.into_iter().flatten().map(|warning| at_step(0, &warning)).collect()
}

/// A patch of which a wheel that feels the cracks, or a block of rail, takes a strip.
fn strip_of_patch(case: &Case, wheel: &GivenWheel) -> Option<ValidityWarning> {
    let given = wheel.given().filter(|given| given.origin.is_patch())?;
    let taken_by = match &given.coupling {
        Some(_) => LineContact::CoupledWheel,
        None if case.boundary() != Boundary::HalfPlane => LineContact::Block,
        None => return None,
    };
    Some(ValidityWarning::StripOfPatch { taken_by })
}

/// Depths (mm) between which the steel flows in each passage: where a wheel is beyond the limit of
/// shakedown of the depth. None where all wheels are within it.
pub(crate) fn flowing(case: &Case) -> Option<[f64; 2]> {
    let shear_yield = case.shakedown.hardening.yield_stress() / 3f64.sqrt();
    let depths: Vec<f64> = (0..=FLOW_DEPTHS).map(|i| i as f64 * DEEPEST_FLOW / FLOW_DEPTHS as f64).collect();
    let of_wheel = |number: usize| {
        let wheel = &case.wheels[number].wheel;
        let (peak, half_width) = (wheel.contact()?.peak_pressure(), wheel.half_width());
        let bounds = WheelBounds::of(case, number)?;
        if peak <= shear_yield * bounds.shakedown.ratio {
            return None;
        }
        let by_depth = bounds.by_depth(&depths);
        let flows = by_depth.iter().filter(|depth| peak > shear_yield * depth.shakedown);
        let all = flows.map(|depth| depth.depth_over_a * half_width);
        all.fold(None, |range: Option<[f64; 2]>, depth| {
            Some(range.map_or([depth; 2], |[top, bottom]| [top.min(depth), bottom.max(depth)]))
        })
    };
    let ranges = (0..case.wheels.len()).filter_map(of_wheel);
    ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// Depths over the half-width at which flow is looked for.
const FLOW_DEPTHS: usize = 100;
const DEEPEST_FLOW: f64 = 3.0;

/// Warnings that follow from the finished steps: each with the numbers of the worst step, and the
/// number of steps concerned.
pub(crate) fn of_steps(info: &RunInfo, log: &RunLog) -> Vec<WarningSummary> {
    let steps: Vec<&StepDigest> = log.steps.iter().collect();
    let depth = |i: usize| {
        let deepest = steps[i].tips.iter().map(|tip| -tip.y).fold(0.0, f64::max);
        let warning = info.bends.then(|| validity::depth_in_bending(deepest)).flatten();
        Some((deepest, warning?))
    };
    // The fastest tip determines the life of the rail.
    let delta_k = |i: usize| {
        let growing = steps[i].tips.iter().filter(|tip| tip.increment > 0.0);
        let fastest = growing.max_by(|a, b| a.rate.total_cmp(&b.rate))?;
        Some(fastest.delta_keq / MPA_SQRT_MM)
    };
    let beyond = |i: usize, sign: f64| {
        let delta_k = delta_k(i)?;
        let warning = validity::growth(delta_k, info.law_table)?;
        let ValidityWarning::OutsideLaw { least, .. } = warning else { return None };
        let above = if delta_k < least { -1.0 } else { 1.0 };
        (above == sign).then_some((sign * delta_k, warning))
    };
    let deeper = |i: usize| {
        let (tip, rate) = deepening(&steps, i, info.axle_load?)?;
        Some((rate, validity::depth_rate(rate, tip.depth())?))
    };
    let flap = |i: usize| {
        let opening = steps[i].unfelt_opening;
        Some((opening, info.fluid.then(|| validity::flap(opening)).flatten()?))
    };
    let wish = |i: usize| {
        let distance =
            |tip: &&TipRecord| tip.front().map_or(f64::INFINITY, |front| (front.phi - FRAC_PI_2).abs());
        let deepest = steps[i].tips.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?.front()?;
        if deepest.turn.is_some() {
            return None;
        }
        let (kink, ratio) = (deepest.wanted_kink?.to_degrees(), deepest.wanted_ratio?);
        Some((ratio, validity::out_of_plane(kink, ratio)?))
    };
    let worst = |of: &dyn Fn(usize) -> Option<(f64, ValidityWarning)>| worst(&steps, of);
    let all = [
        worst(&depth),
        kinks(info, &steps),
        worst(&deeper),
        worst(&|i| beyond(i, 1.0)),
        worst(&|i| beyond(i, -1.0)),
        worst(&flap),
        worst(&wish),
    ];
    all.into_iter().flatten().collect()
}

/// The worst of the warnings `of` the steps, by the larger of the first members, and the number of
/// steps with one.
fn worst(
    steps: &[&StepDigest],
    of: &dyn Fn(usize) -> Option<(f64, ValidityWarning)>,
) -> Option<WarningSummary> {
    let concerned: Vec<_> = (0..steps.len()).filter_map(|i| Some((steps[i].step, of(i)?))).collect();
    let (step, (_, warning)) =
        concerned.iter().reduce(|most, next| if next.1.0 > most.1.0 { next } else { most })?;
    let own = WarningSummary::of_step(at_step(*step, warning));
    Some(WarningSummary { steps: Some(concerned.len()), ..own })
}

/// Kinks beyond the usual toughness in a case without a toughness: those that break the rail; if
/// none does, those that arrest.
fn kinks(info: &RunInfo, steps: &[&StepDigest]) -> Option<WarningSummary> {
    if info.toughness.is_some() {
        return None;
    }
    let steel = Steel {
        toughness: info.steel.unwrap_or(RailSteel::USUAL).mean_toughness,
        name: info.steel.unwrap_or(RailSteel::USUAL).name,
        origin: if info.steel.is_some() { SteelOrigin::Case } else { SteelOrigin::Assumed },
    };
    let limit = MPA_SQRT_MM * steel.toughness;
    let tested = |breaks: bool| {
        worst(steps, &|i| {
            let test = steps[i].pop_in_test.filter(|test| test.arrests(limit) != breaks)?;
            let after = validity::KinkAfter { length: test.length, k1: test.k1_after };
            Some((test.k1_after.unwrap_or(test.k1), validity::toughness(test.k1, Some(after), &steel)?))
        })
    };
    // In space no kink is tested.
    let in_space = |i: usize| {
        info.engine.is_in_space().then_some(())?;
        let k1 = steps[i].tips.iter().filter_map(|tip| Some(tip.largest_k1?.k1)).fold(0.0, f64::max);
        Some((k1, validity::toughness(k1, None, &steel)?))
    };
    let warning = tested(true).or_else(|| tested(false)).or_else(|| worst(steps, &in_space))?;
    // A kink is tested again only where k1 has grown.
    let opened = |step: &&&StepDigest| step.tips.iter().any(|tip| tip.compared_k1() > limit);
    let concerned = steps.iter().filter(opened).count();
    Some(WarningSummary { steps: warning.steps.map(|steps| steps.max(concerned)), ..warning })
}

fn at_step(step: usize, warning: &ValidityWarning) -> Warning {
    Warning { step, kind: WarningKind::Validity, text: warning.to_string(), severity: None }
}

#[cfg(test)]
mod tests {
    use super::{pattern, warning_pages};
    use railcrack::growth::WarningKind;

    #[test]
    fn every_kind_of_warning_has_its_section() {
        let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/warnings.md"));
        let page = page.unwrap();
        for kind in WarningKind::ALL {
            assert!(page.contains(&format!("\n## {}\n", kind.name())), "{}", kind.name());
        }
        let twice = [WarningKind::Input, WarningKind::Engine, WarningKind::Input];
        let pages = warning_pages(twice.into_iter());
        assert_eq!(pages.as_deref(), Some("docs/warnings.md#input, docs/warnings.md#engine"));
    }

    #[test]
    fn a_pattern_has_no_numbers() {
        assert_eq!(pattern("p0 of 845.5 MPa, step 12."), "p# of # MPa, step #");
        assert_eq!(pattern("beyond 1.0: no"), pattern("beyond 23.75: no"));
        assert_eq!(pattern("by -1.2e-3 or (-4)"), pattern("by 3.4e2 or (5)"));
    }
}

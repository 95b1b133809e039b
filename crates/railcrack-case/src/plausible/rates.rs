//! Rates of a growth law against those of rail steel.

use super::topic::{Implausible, Topic};
use super::usual::rounded;
use crate::case::Case;
use railcrack::fatigue::{LawInput, OtherRateUnit, RateLaw};

/// The remark on the growth law of `case`, where its rates are not those of rail steel and not
/// fitted to measured cracks either.
pub(super) fn of_law(case: &Case) -> Option<Implausible> {
    if case.calibration.sites.is_some() {
        return None;
    }
    let law = &case.growth.law.rate;
    let unusual = law.unusual_rate()?;
    let times = match unusual.ratio {
        0.0 => "none, where rail steel has".to_owned(),
        ratio if ratio < 1.0 => {
            format!("1/{} of the", rounded(format!("{:.1e}", ratio.recip()).parse().unwrap_or(ratio)))
        }
        ratio => format!("{} times the", rounded(format!("{ratio:.1e}").parse().unwrap_or(ratio))),
    };
    let text = format!(
        "the growth law gives {:.1e} mm per cycle at a range of {} MPa sqrt(m), {times} {:.1e} of rail steel: {}",
        unusual.rate,
        rounded(unusual.range),
        unusual.of_steel,
        unusual.unit.as_ref().map_or_else(
            || "no usual pair of units makes it that of a steel; a law that is fitted to cracks in track has [calibration] sites".to_owned(),
            |unit| meant(law, unit)
        )
    );
    Some(Implausible { topic: Topic::GrowthLaw, text })
}

/// The unit in which the numbers of `law` probably are, and what to write.
fn meant(law: &RateLaw, unit: &OtherRateUnit) -> String {
    let probably = format!("it is probably in {} per cycle with ranges in {}", unit.length, unit.range);
    match (law.declaration().input, unit.coefficient) {
        (LawInput::Constants(of), Some(value)) => {
            format!(
                "{probably}; then {} = {} in mm per cycle and MPa sqrt(m)",
                of.coefficient.key,
                short_exponent(value)
            )
        }
        _ => format!(
            "{probably}: multiply rates by {} and divide ranges by {}",
            rounded(unit.rate_factor),
            rounded(unit.range_factor)
        ),
    }
}

/// Four digits with an exponent.
fn short_exponent(value: f64) -> String {
    let digits: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    format!("{digits:e}")
}

//! The growth law of `[growth]`: its name, its constants, and the steels that have one.

use super::growth::{
    EQUIVALENT, GROWTH_STEEL, LAW, MODE_2_WEIGHT, TABLE_PROFILE, THRESHOLD_2, is_of_the_law,
};
use super::law_keys::row;
use crate::files::{RatesFile, read_rates};
use crate::schema::{Choice, Report, SectionValues};
use railcrack::fatigue::{GrowthLaw, LawDeclaration, LawInput, RailSteel};
use std::path::Path;

/// A growth law, and its origin where that has a name.
pub(super) struct GivenLaw {
    pub law: GrowthLaw,
    pub steel: Option<&'static RailSteel>,
    pub rates: Option<RatesFile>,
}

/// A range of K (MPa √m) that every rail survives many times, and the fastest growth at it, mm per
/// cycle: a millimetre per cycle is fracture.
const FASTEST: (f64, f64) = (10.0, 1.0);

/// The law that `section` gives; none if there is an error, which is added to `report`.
pub(super) fn read_law(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<GivenLaw> {
    if let Some(name) = section.get(GROWTH_STEEL) {
        refuse_beside_steel(section, report);
        let steel = RailSteel::of(name.word())?;
        let own = steel.growth_law();
        let threshold_2 =
            if section.is_given(THRESHOLD_2) { section.get(THRESHOLD_2)? } else { own.threshold_2 };
        let law = GrowthLaw { threshold_2, ..own };
        return Some(GivenLaw { law, steel: Some(steel), rates: None });
    }
    let declaration = section.get(LAW)?;
    if let Some(own) = declaration.own_range
        && section.is_given(MODE_2_WEIGHT)
    {
        let says = format!("{}, without a weight", own.reason);
        let help = "leave `mode_2_weight` out, or choose another law";
        report.add(section.fault(MODE_2_WEIGHT, says).help(help));
    }
    let mut rates = None;
    let rate = match declaration.input {
        LawInput::Constants(of) => {
            let values: Option<Vec<f64>> = of.all.iter().map(|constant| section.get(row(constant))).collect();
            (of.law)(&values?)?
        }
        LawInput::Table => {
            let file = read_rates(section, TABLE_PROFILE, folder, report)?;
            let table = file.content().clone();
            rates = Some(file);
            table.into()
        }
    };
    let equivalent = match declaration.own_range {
        Some(own) => own.range,
        None => section.get(EQUIVALENT)?.range(section.get(MODE_2_WEIGHT))?,
    };
    let threshold_2 = section.get(THRESHOLD_2)?;
    if let Some(own) = declaration.own_range
        && threshold_2 > 0.0
    {
        let says = format!("{}, with a threshold of both modes", own.reason);
        let help = "leave `threshold_2_mpa_sqrt_m` out, or choose another law";
        return report.refuse(section.fault(THRESHOLD_2, says).help(help));
    }
    let law = GrowthLaw { rate, equivalent, threshold_2 };
    check_pace(section, declaration, &law, report)?;
    Some(GivenLaw { law, steel: None, rates })
}

/// Refuses a law that would break a rail within one passage.
fn check_pace(
    section: &SectionValues,
    declaration: &LawDeclaration,
    law: &GrowthLaw,
    report: &mut Report,
) -> Option<()> {
    let (range, fastest) = FASTEST;
    let rate = law.rate.rate(range, 0.0);
    if rate <= fastest {
        return Some(());
    }
    let (key, exponent) = match declaration.input {
        LawInput::Constants(of) => (of.coefficient.key, of.exponent),
        LawInput::Table => (TABLE_PROFILE.key.name, None),
    };
    let exponent = exponent.and_then(|m| Some(format!("with {} = {} ", m.key, section.get(row(&m))?)));
    let with = exponent.unwrap_or_default();
    let says = format!(
        "{with}a crack grows by {rate:.3e} mm per cycle at dKeq = {range} MPa sqrt(m); it must not exceed {fastest}"
    );
    let help = "rail steels grow by about 1e-5 mm per cycle there";
    report.refuse(section.fault_of_name(key, says).help(help))
}

/// A steel defines its own law and constants.
fn refuse_beside_steel(section: &SectionValues, report: &mut Report) {
    for key in section.section.keys.iter().filter(|key| is_of_the_law(key)) {
        if section.is_given_name(key.name) {
            let says = "says the same thing as `steel`, which defines its own law and constants: give one or the other";
            report.add(section.fault_of_name(key.name, says));
        }
    }
}

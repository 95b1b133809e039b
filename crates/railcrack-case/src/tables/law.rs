//! The growth law of `[growth]`: its name, its constants, and the steels that have one.

use super::growth::{
    BOLD_C, EQUIVALENT, FORMAN_C, FORMAN_KC, FORMAN_M, GROWTH_STEEL, LAW, LAW_KEYS, MODE_2_WEIGHT,
    NASGRO_ALPHA, NASGRO_C, NASGRO_KC, NASGRO_N, NASGRO_P, NASGRO_Q, NASGRO_S, NASGRO_THRESHOLD, PARIS_C,
    PARIS_M, TABLE_PROFILE, THRESHOLD, WALKER_C, WALKER_GAMMA, WALKER_M,
};
use super::law_names::{EquivalentName, LawName};
use crate::files::{RatesFile, read_rates};
use crate::schema::{KeyRow, Report, SectionValues};
use railcrack::fatigue::{
    Bold, EquivalentRange, Forman, GrowthLaw, Nasgro, Paris, ParisThreshold, RailSteel, RateLaw, Walker,
};
use railcrack::words::Choice;
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

/// The law that `section` gives; none where something is wrong, which `report` then says.
pub(super) fn read_law(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<GivenLaw> {
    if let Some(name) = section.get(GROWTH_STEEL) {
        refuse_beside_steel(section, report);
        let steel = RailSteel::of(name.word())?;
        return Some(GivenLaw { law: steel.growth_law(), steel: Some(steel), rates: None });
    }
    let name = section.get(LAW)?;
    if name == LawName::Bold && section.is_given(MODE_2_WEIGHT) {
        let says = "the law of Bold, Brown and Allen has an equivalent range of its own, without a weight";
        let help = "leave `mode_2_weight` out, or choose another law";
        report.add(section.fault(MODE_2_WEIGHT, says).help(help));
    }
    let get = |row: KeyRow<f64>| section.get(row);
    let threshold = || get(THRESHOLD);
    let mut rates = None;
    let rate = match name {
        LawName::Paris => {
            RateLaw::Paris(Paris { c: get(PARIS_C)?, m: get(PARIS_M)?, threshold: threshold()? })
        }
        LawName::ParisThreshold => {
            let (c, m) = (get(PARIS_C)?, get(PARIS_M)?);
            RateLaw::ParisThreshold(ParisThreshold { c, m, threshold: threshold()? })
        }
        LawName::Bold => RateLaw::Bold(Bold { c: get(BOLD_C)? }),
        LawName::Walker => {
            let (c, m, gamma) = (get(WALKER_C)?, get(WALKER_M)?, get(WALKER_GAMMA)?);
            RateLaw::Walker(Walker { c, m, gamma, threshold: threshold()? })
        }
        LawName::Forman => {
            let (c, m, kc) = (get(FORMAN_C)?, get(FORMAN_M)?, get(FORMAN_KC)?);
            RateLaw::Forman(Forman { c, m, kc, threshold: threshold()? })
        }
        LawName::Nasgro => RateLaw::Nasgro(Nasgro {
            c: get(NASGRO_C)?,
            n: get(NASGRO_N)?,
            p: get(NASGRO_P)?,
            q: get(NASGRO_Q)?,
            threshold: get(NASGRO_THRESHOLD)?,
            kc: get(NASGRO_KC)?,
            alpha: get(NASGRO_ALPHA)?,
            s: get(NASGRO_S)?,
        }),
        LawName::Table => {
            let file = read_rates(section, TABLE_PROFILE, folder, report)?;
            let table = file.content().clone();
            rates = Some(file);
            RateLaw::Table(table)
        }
    };
    let equivalent = match (name, section.get(EQUIVALENT)) {
        (LawName::Bold, _) => EquivalentRange::Bold,
        (_, Some(EquivalentName::HourlierPineau)) => {
            EquivalentRange::HourlierPineau { mode_2_weight: section.get(MODE_2_WEIGHT)? }
        }
        (_, Some(EquivalentName::Tanaka)) => EquivalentRange::Tanaka,
        (_, Some(EquivalentName::Richard)) => EquivalentRange::Richard,
        (_, None) => return None,
    };
    let law = GrowthLaw { rate, equivalent };
    check_pace(section, name, &law, report)?;
    Some(GivenLaw { law, steel: None, rates })
}

/// Refuses a law that breaks a rail in a passage.
fn check_pace(section: &SectionValues, name: LawName, law: &GrowthLaw, report: &mut Report) -> Option<()> {
    let (range, fastest) = FASTEST;
    let rate = law.rate.rate(range, 0.0);
    if rate <= fastest {
        return Some(());
    }
    let (row, beside) = match name {
        LawName::Paris | LawName::ParisThreshold => (PARIS_C, Some(PARIS_M)),
        LawName::Walker => (WALKER_C, Some(WALKER_M)),
        LawName::Forman => (FORMAN_C, Some(FORMAN_M)),
        LawName::Nasgro => (NASGRO_C, Some(NASGRO_N)),
        LawName::Bold | LawName::Table => (BOLD_C, None),
    };
    let exponent = beside.and_then(|row| Some(format!("{} = {}", row.key.name, section.get(row)?)));
    let with = exponent.map_or(String::new(), |exponent| format!("with {exponent} "));
    let says = format!(
        "{with}a crack grows by {rate:.3e} mm per cycle at dKeq = {range} MPa sqrt(m); it must not exceed {fastest}"
    );
    let help = "rail steels grow by about 1e-5 mm per cycle there";
    let fault =
        if name == LawName::Table { section.fault(TABLE_PROFILE, says) } else { section.fault(row, says) };
    report.add(fault.help(help));
    None
}

/// A steel has law and constants of its own.
fn refuse_beside_steel(section: &SectionValues, report: &mut Report) {
    for key in section.section.keys {
        let constant = key.only_with.is_some_and(|with| with.key == LAW.key.name);
        if (constant || LAW_KEYS.contains(&key.name)) && section.is_given_name(key.name) {
            let says =
                "says the same thing as `steel`, whose law has constants of its own: give one or the other";
            report.add(section.fault_of_name(key.name, says));
        }
    }
}

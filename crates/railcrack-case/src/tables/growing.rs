//! The growth of the cracks as a case gives it.

use super::growth::{ARREST_RATE, CRITICAL_LENGTH, DIRECTION, INCREMENT, STEPS, STOP_AFTER_CYCLES};
use super::law::read_law;
use crate::files::RatesFile;
use crate::schema::{Report, SectionValues};
use railcrack::fatigue::RailSteel;
use railcrack::growth::GrowthSettings;
use std::path::Path;

/// The growth of the cracks as a case gives it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Growing {
    pub settings: GrowthSettings,
    /// The steel whose law it is.
    pub steel: Option<&'static RailSteel>,
    /// The table whose law it is.
    pub rates: Option<RatesFile>,
}

/// The growth of the cracks; files are relative to `folder`.
pub(crate) fn read_growth(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<Growing> {
    let given = read_law(section, folder, report)?;
    let settings = GrowthSettings {
        toughness: None,
        maintenance: None,
        steps: section.get(STEPS)?,
        increment: section.get(INCREMENT)?,
        law: given.law,
        arrest_rate: section.get(ARREST_RATE)?,
        criterion: section.get(DIRECTION)?,
        critical_length: section.get(CRITICAL_LENGTH),
        stop_after_cycles: section.get(STOP_AFTER_CYCLES),
    };
    Some(Growing { settings, steel: given.steel, rates: given.rates })
}

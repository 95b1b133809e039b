//! `[fracture]`: brittle fracture of the rail.

use crate::files::{ToughnessFile, read_toughness};
use crate::schema::{
    Choice, Report, SectionValues, Word, choice, closed, file, number, read_by_word, section,
};
use railcrack::fatigue::{RailSteel, Toughness};
use railcrack::load::Temperature;
use std::path::Path;

section! {
    FRACTURE "fracture", Optional,
        "Brittle fracture: the run ends when the largest k1 of a passage over all kink angles reaches the toughness, unless the kink arrests.",
        forms [[TOUGHNESS], [FRACTURE_STEEL], [FRACTURE_PROFILE]];
    TOUGHNESS: f64 = number("toughness_mpa_sqrt_m", "MPa sqrt(m)", closed(0.1, 1e3), 29.0, "Fracture toughness K_Ic.").required();
    FRACTURE_STEEL: SteelName = choice("steel", "Rail steel, with its mean toughness by EN 13674-1 at -20 degrees C.")
        .required();
    FRACTURE_PROFILE: String = file("profile", "inputs/toughness.csv", "toughness.csv",
        "CSV file with the columns temperature_c,toughness_mpa_sqrt_m; linear between rows. Requires [temperature].").required();
    CRITERION: FractureCriterion = choice("criterion", "When a k1 that reaches the toughness breaks the rail.");
    POP_IN: f64 = number("pop_in_mm", "mm", closed(0.01, 100.0), 2.0,
        "Length of the kink added at the largest k1, a pop-in after which growth goes on if k1 at its tip is below the toughness.")
        .only_with(CRITERION, "arrest", "only this criterion extends the crack");
}

/// When a tip breaks the rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FractureCriterion {
    Arrest,
    K1,
}

impl Choice for FractureCriterion {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Arrest, Word::now("arrest", "if k1 at the tip of a kink of pop_in_mm reaches it as well")),
        (Self::K1, Word::now("k1", "at once; in space always")),
    ];
}

read_by_word!(SteelName, FractureCriterion);

/// The steels that are known by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SteelName {
    R260,
    R350Ht,
}

impl Choice for SteelName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::R260, Word::now("R260", "29 MPa sqrt(m)")),
        (Self::R350Ht, Word::now("R350HT", "32 MPa sqrt(m)")),
    ];
}

/// Brittle fracture of the rail.
#[derive(Debug, Clone, PartialEq)]
pub struct Fracture {
    /// The toughness over temperature.
    pub toughness: Toughness,
    /// K_Ic at the temperature of the rail, under the first wheel, MPa√m.
    pub at_rail: f64,
    /// The name of the steel where it is one with a name.
    pub steel: Option<&'static str>,
    /// The file where it comes from one.
    pub file: Option<ToughnessFile>,
    /// Length (mm) of the kink that has to arrest for the rail not to break; `None` where k1 of a
    /// virtual kink breaks it.
    pub pop_in: Option<f64>,
}

impl Fracture {
    /// Files are relative to `folder`; `temperatures` are those of the rail, where they are given.
    pub(crate) fn read(
        section: &SectionValues,
        temperatures: &[Temperature],
        folder: &Path,
        report: &mut Report,
    ) -> Option<Self> {
        let pop_in = match section.get(CRITERION)? {
            FractureCriterion::Arrest => Some(section.get(POP_IN)?),
            FractureCriterion::K1 => None,
        };
        let of = |toughness: Toughness, steel, file| {
            let at_rail = toughness.at(temperatures.first().map_or(20.0, |first| first.rail));
            Some(Self { toughness, at_rail, steel, file, pop_in })
        };
        if let Some(toughness) = section.get(TOUGHNESS) {
            let toughness = Toughness::constant(toughness);
            let toughness = toughness.map_err(|error| report.add(section.fault(TOUGHNESS, error))).ok()?;
            return of(toughness, None, None);
        }
        if let Some(steel) = section.get(FRACTURE_STEEL) {
            let steel = RailSteel::of(steel.word())?;
            return of(steel.toughness()?, Some(steel.name), None);
        }
        let file = read_toughness(section, FRACTURE_PROFILE, folder, report)?;
        if temperatures.is_empty() {
            let says = "depends on temperature, and no [temperature] gives that of the rail";
            let help =
                "add a [temperature] section, with rail_c = neutral_c for a rail without thermal stress";
            return report.refuse(section.fault(FRACTURE_PROFILE, says).help(help));
        }
        of(file.content().clone(), None, Some(file))
    }
}

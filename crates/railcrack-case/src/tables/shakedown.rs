//! `[shakedown]`: plastic behaviour of the rail, and the criterion of crack initiation.

use crate::files::{ProfileFile, read_profile};
use crate::schema::{
    Choice, Report, SectionValues, Word, choice, closed, file, integer, number, read_by_word, section,
};
use railcrack::fatigue::{DangVan, RailSteel};
use railcrack::material::KinematicHardening;
use railcrack::shakedown::Method;
use std::path::Path;

section! {
    SHAKEDOWN "shakedown", Defaulted,
        "Plasticity of the rail under repeated passages, and the Dang Van criterion.";
    YIELD_STRESS: f64 = number("yield_stress_mpa", "MPa", closed(1.0, 1e4), 500.0,
        "Cyclic yield stress in tension, by default that of the steel of [growth] if it names one; not with steel.");
    YIELDING_STEEL: YieldingSteel = choice("steel", "Rail steel with its monotonic 0.2 % proof stress as yield stress (docs/parameters.md).")
        .optional();
    HARDENING_MODULUS: f64 = number("hardening_modulus_mpa", "MPa", closed(1.0, 1e7), 20e3,
        "Modulus C of the linear kinematic hardening X = (2/3) C eps_p.");
    METHOD: Method = choice("method", "Method for the stabilised state.");
    WHEELS: RollingWheels = choice("wheels", "Wheels of a mix that roll the rail; a line contact is that of the heaviest alone.");
    MAX_PASSES: usize = integer("max_passes", (1, 100_000), 500,
        "Passages after which the rail counts as not stabilised.");
    INITIAL_RESIDUAL: String = file("initial_residual", "inputs/initial-residual.csv", "manufacturing.csv",
        "Balanced stress before the first passage, in the format of [residual_stress] profile.").optional();
    DANG_VAN_A: f64 = number("dang_van_a", "", closed(0.0, 10.0), 0.3, "Slope of the Dang Van criterion.");
    DANG_VAN_B: f64 = number("dang_van_b_mpa", "MPa", closed(0.1, 1e4), 250.0,
        "Fatigue limit in pure shear of the Dang Van criterion.");
}

read_by_word!(Method, RollingWheels, YieldingSteel);

/// The steels whose yield stress is known by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum YieldingSteel {
    R260,
    R350Ht,
}

impl Choice for YieldingSteel {
    const WORDS: &'static [(Self, Word)] =
        &[(Self::R260, Word::now("R260", "480 MPa")), (Self::R350Ht, Word::now("R350HT", "800 MPa"))];
}

/// The wheels of a mix that roll the rail with their patches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollingWheels {
    /// All of them.
    InTurn,
    /// One of them.
    Heaviest,
}

impl Choice for RollingWheels {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::InTurn, Word::now("in turn", "all, each at its lateral place, the heaviest first")),
        (Self::Heaviest, Word::now("heaviest", "only the wheel nearest to its limit of elastic shakedown")),
    ];
}

/// Plastic behaviour of the rail and the criterion of crack initiation.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakedownSettings {
    /// Yield stress and hardening of the steel.
    pub hardening: KinematicHardening,
    /// The steel whose yield stress it is, where it is one with a name.
    pub steel: Option<&'static RailSteel>,
    /// Method of computing the stabilised state.
    pub method: Method,
    /// The wheels that roll the rail with their patches.
    pub wheels: RollingWheels,
    /// Maximum number of passages, after which the rail counts as not stabilised.
    pub max_passes: usize,
    /// Balanced profile present before the first passage.
    pub initial_residual: Option<ProfileFile>,
    /// The criterion of crack initiation.
    pub dang_van: DangVan,
}

impl ShakedownSettings {
    /// Files are relative to `folder`; the yield stress is by default that of `of_law`, the steel
    /// of the growth law.
    pub(crate) fn read(
        section: &SectionValues,
        of_law: Option<&'static RailSteel>,
        folder: &Path,
        report: &mut Report,
    ) -> Option<Self> {
        let initial_residual = read_profile(section, INITIAL_RESIDUAL, folder, report);
        let named = section.get(YIELDING_STEEL).and_then(|steel| RailSteel::of(steel.word()));
        let is_given = section.is_given(YIELD_STRESS) || section.is_refused(YIELD_STRESS);
        if named.is_some() && is_given {
            let says = "says the same thing as `yield_stress_mpa`: give one or the other";
            return report.refuse(section.fault(YIELDING_STEEL, says));
        }
        let steel = named.or(of_law.filter(|_| !is_given));
        let yield_stress = match steel {
            Some(steel) => steel.yield_stress,
            None => section.get(YIELD_STRESS)?,
        };
        let modulus = section.get(HARDENING_MODULUS)?;
        let hardening = KinematicHardening::new(yield_stress, modulus)
            .map_err(|error| report.add(section.fault_of_all(error)))
            .ok()?;
        Some(Self {
            hardening,
            steel,
            method: section.get(METHOD)?,
            wheels: section.get(WHEELS)?,
            max_passes: section.get(MAX_PASSES)?,
            initial_residual,
            dang_van: DangVan { slope: section.get(DANG_VAN_A)?, limit: section.get(DANG_VAN_B)? },
        })
    }
}

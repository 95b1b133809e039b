//! `[growth]`: rate and direction of crack growth, and the end of a run.

use super::law_keys;
use crate::schema::{
    Choice, Key, SectionValues, Word, choice, closed, file, integer, number, read_by_word, section,
};
use railcrack::fatigue::{DirectionCriterion, LawDeclaration, RailSteel, RangeForm};
use railcrack::growth::Turning;

section! {
    GROWTH "growth", Defaulted, "Crack growth: da/dN by an equivalent range dKeq of dKI and dKII.";
    STEPS: usize = integer("steps", (0, 10_000), 25,
        "Largest number of increments, apart from grindings and increments cut short; 0 computes the initial cracks only. By default 25; with critical_depth_mm, critical_length_mm, [fracture] or stop_after_cycles, until the answer is known, at most 1000.").optional();
    INCREMENT: f64 = number("increment", "", closed(1e-4, 0.5), 0.04,
        "Increment of the fastest tip, as a fraction of its crack's length; by default chosen for the tolerance, or 0.04 with turning = \"kink\".").optional();
    TOLERANCE: f64 = number("tolerance", "", closed(1e-5, 0.2), 0.01,
        "Allowed relative error of the life by the increments, by default 0.01; not with increment or turning = \"kink\".").optional();
    TURNING: Turns = choice("turning", "How a path turns towards the best kink of the direction criterion.");
    TURNING_LENGTH: f64 = number("turning_length_mm", "mm", closed(0.0, f64::INFINITY), Turning::DEFAULT_LENGTH,
        "Length l over which a path turns by its best kink theta*, dtheta/ds = theta*/l. inf: straight ahead; 0: the limit path, where theta* is zero.")
        .only_with(TURNING, "smooth", "a kink has no length");
    STRAIGHT_TO: f64 = number("straight_to_mm", "mm", closed(0.0, 1e3), STRAIGHT_BY_DEFAULT,
        "Tip depth down to which a path goes straight ahead, 2 to 3 in measured head checks; by default 2.5 with [inspection] and without turning_length_mm, otherwise 0. In space only with surface = \"turned\".")
        .only_with(TURNING, "smooth", "every increment kinks").optional();
    KINK_ANGLE: f64 = number("kink_angle_deg", "deg", closed(1.0, 110.0), 30.0,
        "Best kink from which a path kinks at once.")
        .only_with(TURNING, "smooth", "every increment kinks");
    KINK_FRICTION: f64 = number("kink_friction", "", closed(0.0, 10.0), 0.0,
        "Friction coefficient of the virtual kinks that decide the direction.");
    LAW: &'static LawDeclaration = law_keys::LAW;
    EQUIVALENT: RangeForm = choice("equivalent", "Equivalent range dKeq.")
        .only_with_words(LAW, law_keys::WITH_A_RANGE, law_keys::OWN_RANGE);
    ..law_keys::OF_DEFAULT_LAW;
    MODE_2_WEIGHT: f64 = number("mode_2_weight", "", closed(0.0, 100.0), 0.772, "Weight w of mode II.")
        .only_with(EQUIVALENT, "hourlier-pineau", "only this range has a weight of mode II");
    MODE_3_WEIGHT: f64 = number("mode_3_weight", "", closed(0.0, 100.0), 1.103,
        "Weight of mode III in space; by default mode_2_weight/(1 - nu).")
        .only_with(EQUIVALENT, "hourlier-pineau", "only this range has a weight of mode III").optional();
    FRONT: FrontForm = choice("front", "Shape of the crack fronts; only in space.");
    SURFACE: CrackSurface = choice("surface", "Surface of the cracks; only in space.");
    FRONT_HARMONICS: usize = integer("front_harmonics", (2, 8), 6,
        "Harmonics of a free front, an even number; it has a node every 180/front_harmonics degrees.")
        .only_with(FRONT, "free", "an ellipse has semi-axes");
    ..law_keys::OF_OTHER_LAWS;
    THRESHOLD_2: f64 = number("threshold_2_mpa_sqrt_m", "MPa sqrt(m)", closed(0.0, 1e3), 0.0,
        "Threshold of dKII, in space of all shear; 0: none. With a threshold dKth of the law, a crack grows where (dKI/dKth)^2 + (dKII/threshold_2)^2 > 1; without, dKII counts only above it. Not with bold.");
    TABLE_PROFILE: String = file("table_profile", "inputs/rates.csv", "rates.csv",
        "CSV file with the columns delta_keq_mpa_sqrt_m,rate_mm_per_cycle; linear in log-log scale, no growth below the first row.")
        .required()
        .only_with_words(LAW, law_keys::OF_RATES, "every other law has its own constants");
    GROWTH_STEEL: SteelName = choice("steel", "Rail steel with its growth law, instead of law and its constants (docs/parameters.md).").optional();
    ARREST_RATE: f64 = number("arrest_rate_mm_per_cycle", "mm/cycle", closed(0.0, 1.0), 1e-9,
        "Rate below which a tip is arrested.");
    DIRECTION: DirectionCriterion = choice("direction", "Criterion of the growth direction.");
    CRITICAL_LENGTH: f64 =
        number("critical_length_mm", "mm", closed(1e-3, 1e5), 20.0, "Crack length at which the run ends.").optional();
    STOP_AFTER_CYCLES: f64 = number("stop_after_cycles", "cycles", closed(1e-3, 1e18), 1e7,
        "Load cycles after which the run ends.").optional();
}

/// Depth (mm) to which measured head checks grow straight at their angle before they turn
/// (validation T15 and T16: 2 to 3 mm).
pub(crate) const STRAIGHT_BY_DEFAULT: f64 = 2.5;

/// The shape that the front of a crack in space keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontForm {
    /// An ellipse or half of one.
    Ellipse,
    /// None.
    Free,
}

impl Choice for FrontForm {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Ellipse, Word::now("ellipse", "the ellipse nearest to the local rates")),
        (Self::Free, Word::now("free", "the front follows the local rates, smoothed by front_harmonics")),
    ];
}

/// Surface of a crack in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CrackSurface {
    /// That in which it begins.
    Given,
    /// One that turns.
    Turned,
}

impl Choice for CrackSurface {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Given, Word::now("plane", "the crack keeps its plane, a folded one that of its branch")),
        (
            Self::Turned,
            Word::now("turned", "the crack turns as a path in the plane, about the direction of its mouth"),
        ),
    ];
}

/// The steels that have a growth law of their name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SteelName {
    R260,
    R350Ht,
    TypicalR260,
    TypicalR350Ht,
    U71Mn,
}

impl Choice for SteelName {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::R260, Word::now("R260", "the limit of EN 13674-1, not the growth of a rail")),
        (Self::R350Ht, Word::now("R350HT", "the same limit")),
        (Self::TypicalR260, Word::now("R260-typical", "typical, a fifth of the limit")),
        (Self::TypicalR350Ht, Word::now("R350HT-typical", "the same, with more scatter")),
        (Self::U71Mn, Word::now("U71Mn", "2.56e-9 dKeq^3.18, as measured at R = 0.1")),
    ];
}

/// How a path turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turns {
    Smooth,
    Kink,
}

impl Choice for Turns {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Smooth, Word::now("smooth", "over turning_length_mm")),
        (Self::Kink, Word::now("kink", "by a whole kink in each increment, on which the path depends")),
    ];
}

read_by_word!(
    Turns,
    FrontForm,
    CrackSurface,
    DirectionCriterion,
    &'static LawDeclaration,
    RangeForm,
    SteelName
);

/// Whether a stored case takes `key` of `[growth]` from its steel again: the law and, where it is
/// not given, the threshold of mode II.
pub(crate) fn is_of_the_steel(section: &SectionValues, steel: &RailSteel, key: &Key) -> bool {
    let is_own = steel.growth_law().threshold_2 > 0.0 && !section.is_given(THRESHOLD_2);
    is_of_the_law(key) || is_own && key.name == THRESHOLD_2.key.name
}

/// Whether `key` of `[growth]` concerns the law: with a steel, the law is that of the steel.
pub(crate) fn is_of_the_law(key: &Key) -> bool {
    let is_one_of = |rows: &[&str]| rows.contains(&key.name);
    is_one_of(&[LAW.key.name, MODE_2_WEIGHT.key.name])
        || key.only_with.is_some_and(|with| with.key == LAW.key.name)
}

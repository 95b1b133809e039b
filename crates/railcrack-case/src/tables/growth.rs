//! `[growth]`: rate and direction of crack growth, and the end of a run.

use super::law_names::{EquivalentName, LawName, SteelName};
use crate::schema::{choice, closed, file, integer, number, positive, read_by_word, section};
use railcrack::fatigue::DirectionCriterion;

const OWN_CONSTANTS: &str = "every law has constants of its own";
const OWN_THRESHOLD: &str = "the law has a threshold of its own";

section! {
    GROWTH "growth", Defaulted, "Crack growth: da/dN under an equivalent range dKeq of dKI and dKII.";
    STEPS: usize =
        integer("steps", (0, 10_000), 25, "Number of increments; 0 computes the initial cracks only.");
    INCREMENT: f64 = number("increment", "", closed(1e-4, 0.5), 0.04,
        "Increment of the fastest tip, as a fraction of its crack's length; 10 000 of the smallest double it.");
    LAW: LawName = choice("law", "Growth law.");
    EQUIVALENT: EquivalentName = choice("equivalent", "Equivalent range dKeq.")
        .only_with_any(LAW, "paris", &["paris-threshold", "walker", "forman", "nasgro", "table"],
            "the law of Bold, Brown and Allen has an equivalent range of its own");
    PARIS_C: f64 = number("paris_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1.0), 2e-9,
        "Coefficient C of the law; at dKeq = 10 MPa sqrt(m) the rate is at most a millimetre per cycle.")
        .only_with_any(LAW, "paris", &["paris-threshold"], OWN_CONSTANTS);
    PARIS_M: f64 = number("paris_m", "", closed(0.1, 20.0), 3.33, "Exponent m of the law.")
        .only_with_any(LAW, "paris", &["paris-threshold"], OWN_CONSTANTS);
    MODE_2_WEIGHT: f64 = number("mode_2_weight", "", closed(0.0, 100.0), 0.772, "Weight w of mode II.")
        .only_with(EQUIVALENT, "hourlier-pineau", "only this range has a weight of mode II");
    MODE_3_WEIGHT: f64 = number("mode_3_weight", "", closed(0.0, 100.0), 1.103,
        "Weight of mode III in the engine space; without it mode_2_weight/(1 - nu), with which modes II and III count by \
         their energy release rates.")
        .only_with(EQUIVALENT, "hourlier-pineau", "only this range has a weight of mode III").optional();
    THRESHOLD: f64 = number("threshold_mpa_sqrt_m", "MPa sqrt(m)", closed(0.0, 1e3), 0.0,
        "Threshold of dKeq, at or below which a crack does not grow.")
        .only_with_any(LAW, "paris", &["paris-threshold", "walker", "forman"], OWN_THRESHOLD);
    BOLD_C: f64 = number("bold_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1.0), 5.07e-10,
        "Coefficient C of C (dKeq^3.74 - 4^3.74).").only_with(LAW, "bold", OWN_CONSTANTS);
    WALKER_C: f64 = number("walker_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1.0), 2e-9,
        "Coefficient C of C [dKeq / (1-R)^(1-gamma)]^m.").only_with(LAW, "walker", OWN_CONSTANTS);
    WALKER_M: f64 = number("walker_m", "", closed(0.1, 20.0), 3.33, "Exponent m.").only_with(LAW, "walker", OWN_CONSTANTS);
    WALKER_GAMMA: f64 = number("walker_gamma", "", closed(0.0, 1.0), 0.6,
        "Exponent gamma: 1 is Paris' law, 0 a law of the largest K.").only_with(LAW, "walker", OWN_CONSTANTS);
    FORMAN_C: f64 = number("forman_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1e3), 5e-8,
        "Coefficient C of C dKeq^m / ((1-R) Kc - dKeq).").only_with(LAW, "forman", OWN_CONSTANTS);
    FORMAN_M: f64 = number("forman_m", "", closed(0.1, 20.0), 3.0, "Exponent m.").only_with(LAW, "forman", OWN_CONSTANTS);
    FORMAN_KC: f64 = number("forman_kc", "MPa sqrt(m)", closed(0.1, 1e3), 60.0,
        "Kc, at which the crack runs away: the run ends with fracture.").only_with(LAW, "forman", OWN_CONSTANTS);
    NASGRO_C: f64 = number("nasgro_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1.0), 1e-9,
        "Coefficient C of C [(1-f)/(1-R) dKeq]^n (1 - dKth/dKeq)^p / (1 - Kmax/Kc)^q.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_N: f64 = number("nasgro_n", "", closed(0.1, 20.0), 3.0, "Exponent n.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_P: f64 = number("nasgro_p", "", closed(0.0, 10.0), 0.5, "Exponent p.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_Q: f64 = number("nasgro_q", "", closed(0.0, 10.0), 0.5, "Exponent q.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_THRESHOLD: f64 = number("nasgro_threshold", "MPa sqrt(m)", closed(0.0, 1e3), 5.0, "dKth.")
        .only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_KC: f64 = number("nasgro_kc", "MPa sqrt(m)", closed(0.1, 1e3), 40.0,
        "Kc, at which the crack runs away: the run ends with fracture.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_ALPHA: f64 = number("nasgro_alpha", "", closed(1.0, 3.0), 2.5,
        "Constraint alpha of Newman's f: 1 in plane stress, 3 in plane strain.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    NASGRO_S: f64 = number("nasgro_s", "", closed(0.0, 0.99), 0.3,
        "Largest stress over flow stress in Newman's f.").only_with(LAW, "nasgro", OWN_CONSTANTS);
    TABLE_PROFILE: String = file("table_profile", "inputs/rates.csv", "rates.csv",
        "CSV read by header, delta_keq_mpa_sqrt_m,rate_mm_per_cycle: log-log linear, no growth below the first row.")
        .required().only_with(LAW, "table", OWN_CONSTANTS);
    GROWTH_STEEL: SteelName = choice("steel", "Rail steel with a law of its name, instead of law and constants.").optional();
    ARREST_RATE: f64 = number("arrest_rate_mm_per_cycle", "mm/cycle", closed(0.0, 1.0), 1e-9,
        "A tip slower than this is arrested.");
    DIRECTION: DirectionCriterion = choice("direction", "Criterion of the growth direction.");
    CRITICAL_LENGTH: f64 =
        number("critical_length_mm", "mm", positive(1e5), 20.0, "A crack this long ends the run.").optional();
    STOP_AFTER_CYCLES: f64 = number("stop_after_cycles", "cycles", positive(1e18), 1e7,
        "This many load cycles end the run.").optional();
}

read_by_word!(DirectionCriterion);

/// Keys of the law: with a steel, the law is that of the steel.
pub(crate) const LAW_KEYS: &[&str] = &[
    LAW.key.name,
    EQUIVALENT.key.name,
    PARIS_C.key.name,
    PARIS_M.key.name,
    MODE_2_WEIGHT.key.name,
    THRESHOLD.key.name,
];

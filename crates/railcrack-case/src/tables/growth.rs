//! `[growth]`: rate and direction of crack growth, and the end of a run.

use crate::schema::{
    Report, SectionValues, choice, closed, integer, number, positive, read_by_word, section,
};
use railcrack::fatigue::{DirectionCriterion, ParisLaw};
use railcrack::growth::GrowthSettings;

section! {
    GROWTH "growth", Defaulted, "Crack growth: da/dN = C dKeq^m, dKeq^2 = dKI^2 + w dKII^2.";
    STEPS: usize =
        integer("steps", (0, 10_000), 25, "Number of increments; 0 computes the initial cracks only.");
    INCREMENT: f64 = number("increment", "", closed(1e-4, 0.5), 0.04,
        "Increment of the fastest tip, as a fraction of its crack's length; 10 000 of the smallest double it.");
    PARIS_C: f64 = number("paris_c", "mm/cycle, MPa sqrt(m)", closed(1e-30, 1.0), 2e-9,
        "Coefficient C of the law; at dKeq = 10 MPa sqrt(m) the rate is at most a millimetre per cycle.");
    PARIS_M: f64 = number("paris_m", "", closed(0.1, 20.0), 3.33, "Exponent m of the law.");
    MODE_2_WEIGHT: f64 = number("mode_2_weight", "", closed(0.0, 100.0), 0.772, "Weight w of mode II.");
    THRESHOLD: f64 = number("threshold_mpa_sqrt_m", "MPa sqrt(m)", closed(0.0, 1e3), 0.0,
        "Threshold of dKeq, at or below which a crack does not grow.");
    ARREST_RATE: f64 = number("arrest_rate_mm_per_cycle", "mm/cycle", closed(0.0, 1.0), 1e-9,
        "A tip slower than this is arrested.");
    DIRECTION: DirectionCriterion = choice("direction", "Criterion of the growth direction.");
    CRITICAL_LENGTH: f64 =
        number("critical_length_mm", "mm", positive(1e5), 20.0, "A crack this long ends the run.").optional();
    STOP_AFTER_CYCLES: f64 = number("stop_after_cycles", "cycles", positive(1e18), 1e7,
        "This many load cycles end the run.").optional();
}

read_by_word!(DirectionCriterion);

/// A range of K (MPa √m) that every rail survives many times, and the fastest growth at it, mm per
/// cycle: a millimetre per cycle is fracture.
const FASTEST: (f64, f64) = (10.0, 1.0);

/// The growth of the cracks.
pub(crate) fn read_growth(section: &SectionValues, report: &mut Report) -> Option<GrowthSettings> {
    let law = ParisLaw {
        c: section.get(PARIS_C)?,
        m: section.get(PARIS_M)?,
        mode_2_weight: section.get(MODE_2_WEIGHT)?,
        threshold: section.get(THRESHOLD)?,
    };
    let (range, fastest) = FASTEST;
    let rate = law.c * range.powf(law.m);
    if rate > fastest {
        let says = format!(
            "with {} = {} a crack grows by {rate:.3e} mm per cycle at dKeq = {range} MPa sqrt(m); it must not exceed {fastest}",
            PARIS_M.key.name, law.m
        );
        report.add(section.fault(PARIS_C, says).help("rail steels grow by about 1e-5 mm per cycle there"));
        return None;
    }
    Some(GrowthSettings {
        toughness: None,
        steps: section.get(STEPS)?,
        increment: section.get(INCREMENT)?,
        law,
        arrest_rate: section.get(ARREST_RATE)?,
        criterion: section.get(DIRECTION)?,
        critical_length: section.get(CRITICAL_LENGTH),
        stop_after_cycles: section.get(STOP_AFTER_CYCLES),
    })
}

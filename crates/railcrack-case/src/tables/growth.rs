//! `[growth]`: rate and direction of crack growth, and the end of a run.

use crate::schema::{Choice, SectionValues, Word, choice, closed, integer, number, positive, section};
use railcrack::fatigue::{DirectionCriterion, ParisLaw};
use railcrack::growth::GrowthSettings;

section! {
    GROWTH "growth", Defaulted, "Crack growth: da/dN = C dKeq^m, dKeq^2 = dKI^2 + w dKII^2.";
    STEPS: usize =
        integer("steps", (0, 10_000), 25, "Number of increments; 0 computes the initial cracks only.");
    INCREMENT: f64 = number("increment", "", positive(0.5), 0.04,
        "Increment of the fastest tip, as a fraction of its crack's length.");
    PARIS_C: f64 = number("paris_c", "mm/cycle, MPa sqrt(m)", positive(1.0), 2e-9, "Coefficient C of the law.");
    PARIS_M: f64 = number("paris_m", "", positive(20.0), 3.33, "Exponent m of the law.");
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

impl Choice for DirectionCriterion {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::MaxRate, Word::now("max-rate", "the largest growth rate of the kink (Hourlier-Pineau)")),
        (
            Self::MaxRateUnclipped,
            Word::now("max-rate-unclipped", "the same, with negative k1 kept where max-rate takes zero"),
        ),
        (Self::MaxDeltaK1, Word::now("max-delta-k1", "the largest range of k1")),
        (Self::MaxK1, Word::now("max-k1", "the largest k1")),
    ];
}

/// The growth of the cracks.
pub(crate) fn read_growth(section: &SectionValues) -> Option<GrowthSettings> {
    Some(GrowthSettings {
        steps: section.get(STEPS)?,
        increment: section.get(INCREMENT)?,
        law: ParisLaw {
            c: section.get(PARIS_C)?,
            m: section.get(PARIS_M)?,
            mode_2_weight: section.get(MODE_2_WEIGHT)?,
            threshold: section.get(THRESHOLD)?,
        },
        arrest_rate: section.get(ARREST_RATE)?,
        criterion: section.get(DIRECTION)?,
        critical_length: section.get(CRITICAL_LENGTH),
        stop_after_cycles: section.get(STOP_AFTER_CYCLES),
    })
}

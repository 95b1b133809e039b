//! `growth.csv`: every tip at every step.

use super::{Rows, header};
use railcrack::growth::StepRecord;
use railcrack::math::MPA_SQRT_MM;

pub const GROWTH_FILE: &str = "growth.csv";

/// Columns of `growth.csv`.
pub const GROWTH_COLUMNS: [&str; 17] = [
    "step",
    "crack",
    "tip",
    "tip_x_mm",
    "tip_y_mm",
    "length_mm",
    "ki_max_mpa_sqrt_m",
    "delta_ki_mpa_sqrt_m",
    "delta_kii_mpa_sqrt_m",
    "delta_keq_mpa_sqrt_m",
    "kink_angle_deg",
    "rival_angle_deg",
    "rival_ratio",
    "increment_mm",
    "rate_mm_per_cycle",
    "load_cycles",
    "stop",
];

pub fn growth_header() -> String {
    header(
        &[
            "One row per step and tip: the state at the start of the step, and the increment that follows it",
            "step: 0 is the initial geometry; crack: from 1; tip: from 1 within its crack",
            "lengths and coordinates: mm, y upwards, the rail is y <= 0; length_mm: of the whole crack, with what waits at its tips",
            "K: MPa sqrt(m), ranges over the stabilised passage, K_I clipped at zero",
            "angles: degrees from straight ahead, counter-clockwise positive; empty: a tip that is not loaded, or no rival direction",
            "rival_ratio: growth rate in the rival direction over the chosen one",
            "load_cycles: axles up to the start of the step (explicit Euler); stop: why the tip, or in the last step the run, stopped",
            "increments of a slow tip wait, and are put into its crack together: until then the tip stays where it is",
        ],
        &GROWTH_COLUMNS,
    )
}

/// Appends the rows of a step, tip by tip.
pub fn growth_rows(rows: &mut Rows, record: &StepRecord) {
    let [_, _, _, x, y, length, ki_max, dki, dkii, dkeq, kink, rival, ratio, increment, rate, cycles, _] =
        GROWTH_COLUMNS;
    for tip in &record.tips {
        rows.count(record.step);
        rows.count(tip.tip.crack + 1);
        rows.count(tip.tip.tip + 1);
        rows.real(x, tip.x);
        rows.real(y, tip.y);
        rows.real(length, tip.length);
        rows.real(ki_max, tip.ki_max / MPA_SQRT_MM);
        rows.real(dki, tip.delta_ki / MPA_SQRT_MM);
        rows.real(dkii, tip.delta_kii / MPA_SQRT_MM);
        rows.real(dkeq, tip.delta_keq / MPA_SQRT_MM);
        rows.optional(kink, tip.kink.map(f64::to_degrees));
        rows.optional(rival, tip.secondary.map(f64::to_degrees));
        rows.optional(ratio, tip.secondary_ratio);
        rows.real(increment, tip.increment);
        rows.real(rate, tip.rate);
        rows.real(cycles, record.load_cycles);
        let own = tip.stop.map(|stop| stop.name());
        rows.name(own.or(record.stop.map(|stop| stop.name())).unwrap_or(""));
        rows.end();
    }
}

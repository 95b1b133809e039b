//! `sif.csv`: K_I and K_II of every tip at every wheel position.

use super::{Rows, header};
use railcrack::growth::StepRecord;
use railcrack::math::MPA_SQRT_MM;

pub const SIF_FILE: &str = "sif.csv";

/// Columns of `sif.csv`.
pub const SIF_COLUMNS: [&str; 9] =
    ["step", "passage", "crack", "tip", "position", "xc_mm", "xc_over_a", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"];

/// What `xc_over_a` is measured by.
#[derive(Debug, Clone, Copy)]
pub struct SifScale {
    /// Mouth of the first crack in the initial geometry (its first point where it is buried), mm.
    pub origin: f64,
    /// Half-width a of the wheel contact, mm.
    pub half_width: f64,
}

impl SifScale {
    /// `xc_over_a` of the wheel position `xc`, mm.
    pub fn over_a(self, xc: f64) -> f64 {
        (xc - self.origin) / self.half_width
    }
}

pub fn sif_header() -> String {
    header(
        &[
            "Stress intensity factors of every tip at every wheel position, all passages of each step",
            "step: 0 is the initial geometry; passage, position, crack: from 1; tip: from 1 within its crack",
            "the last passage of a step is the stabilised one",
            "xc_mm: abscissa of the Hertz centre, mm; xc_over_a: from the first crack's mouth (its initial first point if buried), over the half-width a",
            "ki, kii: MPa sqrt(m); K_II > 0: shear stress > 0 ahead of the tip, the + face moves along the crack's walk",
        ],
        &SIF_COLUMNS,
    )
}

/// Appends the rows of a step: passage by passage, tip by tip, position by position.
pub fn sif_rows(rows: &mut Rows, record: &StepRecord, scale: SifScale) {
    let [_, _, _, _, _, xc_mm, xc_over_a, ki, kii] = SIF_COLUMNS;
    for (p, passage) in record.passages.iter().enumerate() {
        for (tip, history) in record.tips.iter().zip(&passage.sifs) {
            for (i, (&xc, sif)) in passage.xc.iter().zip(history).enumerate() {
                rows.count(record.step);
                rows.count(p + 1);
                rows.count(tip.tip.crack + 1);
                rows.count(tip.tip.tip + 1);
                rows.count(i + 1);
                rows.real(xc_mm, xc);
                rows.real(xc_over_a, scale.over_a(xc));
                rows.real(ki, sif.ki_mpa_sqrt_m());
                rows.real(kii, sif.kii_mpa_sqrt_m());
                rows.end();
            }
        }
    }
}

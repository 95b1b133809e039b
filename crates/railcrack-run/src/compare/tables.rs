//! `compare.csv` and `compare-positions.csv`.

use super::align::Aligned;
use super::tip::{SifDifference, TipSifs, percent};
use crate::csv::table;
use railcrack::growth::RunStop;

table! {
    /// A tip at a growth step in two runs.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct TipComparison in "compare.csv", [
        "Comparison of two runs: a row per step and tip present in both; _1 and _2: first and second run",
        "dki, dkii: absolute difference of K over the stabilised passage, MPa sqrt(m): its maximum, the position of the maximum, and its root mean square",
        "percent_of_step, percent_of_case: of the largest |K_I| or |K_II| of both runs in the step, in all common steps",
        "lengths and coordinates: mm, y upwards; angles: degrees from straight ahead, counter-clockwise positive",
        "empty: no common wheel position, an unloaded tip, or no rival direction",
    ] {
        /// Step, crack and tip.
        step: usize = "step";
        /// Step, crack and tip.
        crack: usize = "crack";
        /// Step, crack and tip.
        tip: usize = "tip";
        /// Number of wheel positions compared; 0 if the passages have none in common, and then the
        /// differences of K are empty.
        positions: usize = "positions";
        /// Largest absolute difference of K_I, K_II over the passage, MPa√m.
        dki: Option<f64> = "dki_max_mpa_sqrt_m";
        /// This difference in per cent of `step_peak_mpa_sqrt_m`.
        dki_of_step: Option<f64> = "dki_percent_of_step";
        /// This difference in per cent of the largest \|K\| of both runs in all common steps.
        dki_of_case: Option<f64> = "dki_percent_of_case";
        /// Wheel position x_c/a of that difference.
        dki_xc_over_a: Option<f64> = "dki_xc_over_a";
        /// Root mean square of the difference over the positions, MPa√m.
        dki_rms: Option<f64> = "dki_rms_mpa_sqrt_m";
        /// Largest absolute difference of K_I, K_II over the passage, MPa√m.
        dkii: Option<f64> = "dkii_max_mpa_sqrt_m";
        /// This difference in per cent of `step_peak_mpa_sqrt_m`.
        dkii_of_step: Option<f64> = "dkii_percent_of_step";
        /// This difference in per cent of the largest \|K\| of both runs in all common steps.
        dkii_of_case: Option<f64> = "dkii_percent_of_case";
        /// Wheel position x_c/a of that difference.
        dkii_xc_over_a: Option<f64> = "dkii_xc_over_a";
        /// Root mean square of the difference over the positions, MPa√m.
        dkii_rms: Option<f64> = "dkii_rms_mpa_sqrt_m";
        /// Largest \|K_I\| or \|K_II\| of both runs in the step, all tips, MPa√m.
        step_peak: f64 = "step_peak_mpa_sqrt_m";
        /// Position of the tip, mm.
        first_place: [f64; 2] = "tip_x_1_mm" "tip_y_1_mm";
        /// Position of the tip, mm.
        second_place: [f64; 2] = "tip_x_2_mm" "tip_y_2_mm";
        /// Distance between the two, mm.
        distance: f64 = "tip_distance_mm";
        /// As in `growth.csv`.
        lengths: [f64; 2] = "length_1_mm" "length_2_mm";
        /// As in `growth.csv`.
        load_cycles: [f64; 2] = "load_cycles_1" "load_cycles_2";
        /// As in `growth.csv`.
        kink_deg: [Option<f64>; 2] = "kink_angle_1_deg" "kink_angle_2_deg";
        /// As in `growth.csv`.
        rival_deg: [Option<f64>; 2] = "rival_angle_1_deg" "rival_angle_2_deg";
        /// As in `growth.csv`.
        rival_ratio: [Option<f64>; 2] = "rival_ratio_1" "rival_ratio_2";
        /// As in `growth.csv`.
        stops: [Option<RunStop>; 2] = "stop_1" "stop_2";
    }
}

impl TipComparison {
    /// Differences of K; none where the passages have no position in common.
    pub fn sifs(&self) -> Option<TipSifs> {
        let ki = SifDifference { largest: self.dki?, xc_over_a: self.dki_xc_over_a?, rms: self.dki_rms? };
        let kii = SifDifference { largest: self.dkii?, xc_over_a: self.dkii_xc_over_a?, rms: self.dkii_rms? };
        Some(TipSifs { positions: self.positions, ki, kii })
    }

    /// The tip with the largest |K| of its step and of all steps.
    pub(super) fn with_peaks(self, step_peak: f64, peak: f64) -> Self {
        let of = |k: Option<f64>, peak| k.map(|k| percent(k, peak));
        Self {
            step_peak,
            dki_of_step: of(self.dki, step_peak),
            dki_of_case: of(self.dki, peak),
            dkii_of_step: of(self.dkii, step_peak),
            dkii_of_case: of(self.dkii, peak),
            ..self
        }
    }

    /// `k` (MPa √m) in per cent of the largest |K| of the step.
    pub fn percent(&self, k: f64) -> f64 {
        percent(k, self.step_peak)
    }
}

table! {
    /// K of two runs at a common wheel position.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PositionRow in "compare-positions.csv", [
        "K of two runs over the stabilised passage of each step, at common wheel positions in ascending order",
        "_1 and _2: first and second run; dki, dkii: second minus first, MPa sqrt(m)",
    ] {
        /// Step, crack and tip.
        step: usize = "step";
        /// Step, crack and tip.
        crack: usize = "crack";
        /// Step, crack and tip.
        tip: usize = "tip";
        /// Wheel position x_c/a, in ascending order.
        xc_over_a: f64 = "xc_over_a";
        /// K_I of both runs, MPa√m.
        ki: [f64; 2] = "ki_1_mpa_sqrt_m" "ki_2_mpa_sqrt_m";
        /// Difference of K_I, second minus first, MPa√m.
        dki: f64 = "dki_mpa_sqrt_m";
        /// K_II of both runs, MPa√m.
        kii: [f64; 2] = "kii_1_mpa_sqrt_m" "kii_2_mpa_sqrt_m";
        /// Difference of K_II, second minus first, MPa√m.
        dkii: f64 = "dkii_mpa_sqrt_m";
    }
}

impl PositionRow {
    pub(super) fn of_tip<'a>((tip, k): (&'a TipComparison, &'a Aligned)) -> impl Iterator<Item = Self> + 'a {
        k.xc_over_a.iter().enumerate().map(move |(i, &xc_over_a)| {
            let [ki, kii] = [&k.ki, &k.kii].map(|k| [k[0][i], k[1][i]]);
            let TipComparison { step, crack, tip, .. } = *tip;
            Self { step, crack, tip, xc_over_a, ki, dki: ki[1] - ki[0], kii, dkii: kii[1] - kii[0] }
        })
    }
}

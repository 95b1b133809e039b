//! The folder of a comparison.

use super::Comparison;
use super::json::json_text;
use crate::csv::{Rows, header};
use crate::folder::{Durability, REPORT_FILE, replace_file};
use crate::{Existing, OutputError};
use std::path::Path;

pub(super) const TABLE: &str = "compare.csv";
pub(super) const POSITIONS: &str = "compare-positions.csv";
/// The comparison in numbers.
pub const JSON_FILE: &str = "compare.json";
/// A plot of the comparison.
pub const FIRST_STEP: &str = "compare-sif-first.svg";
/// A plot of the comparison.
pub const LAST_STEP: &str = "compare-sif-last.svg";
/// A plot of the comparison.
pub const PATHS: &str = "compare-paths.svg";

const FILES: [&str; 7] = [TABLE, POSITIONS, JSON_FILE, FIRST_STEP, LAST_STEP, PATHS, REPORT_FILE];

/// Columns of `compare.csv`.
pub const COMPARE_COLUMNS: [&str; 32] = [
    "step",
    "crack",
    "tip",
    "positions",
    "dki_max_mpa_sqrt_m",
    "dki_percent_of_step",
    "dki_percent_of_case",
    "dki_xc_over_a",
    "dki_rms_mpa_sqrt_m",
    "dkii_max_mpa_sqrt_m",
    "dkii_percent_of_step",
    "dkii_percent_of_case",
    "dkii_xc_over_a",
    "dkii_rms_mpa_sqrt_m",
    "step_peak_mpa_sqrt_m",
    "tip_x_1_mm",
    "tip_y_1_mm",
    "tip_x_2_mm",
    "tip_y_2_mm",
    "tip_distance_mm",
    "length_1_mm",
    "length_2_mm",
    "load_cycles_1",
    "load_cycles_2",
    "kink_angle_1_deg",
    "kink_angle_2_deg",
    "rival_angle_1_deg",
    "rival_angle_2_deg",
    "rival_ratio_1",
    "rival_ratio_2",
    "stop_1",
    "stop_2",
];

/// Columns of `compare-positions.csv`.
pub const COMPARE_POSITIONS_COLUMNS: [&str; 10] = [
    "step",
    "crack",
    "tip",
    "xc_over_a",
    "ki_1_mpa_sqrt_m",
    "ki_2_mpa_sqrt_m",
    "dki_mpa_sqrt_m",
    "kii_1_mpa_sqrt_m",
    "kii_2_mpa_sqrt_m",
    "dkii_mpa_sqrt_m",
];

impl Comparison {
    /// Writes tables, `compare.json`, plots and report to `folder`, which is created where it does not exist. `tolerance`: a
    /// largest difference of K, in per cent of the largest |K| of the case, that `compare.json` is to judge by.
    ///
    /// Errors: the folder holds a comparison and `existing` says to leave it alone; the system refuses.
    pub fn write(
        &self,
        folder: &Path,
        existing: Existing,
        tolerance: Option<f64>,
    ) -> Result<(), OutputError> {
        let there = FILES.into_iter().find(|file| folder.join(file).exists());
        if let (Existing::Refuse, Some(file)) = (existing, there) {
            return Err(OutputError::HoldsComparison { folder: folder.to_path_buf(), file });
        }
        std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
        let put = |file: &str, content: &[u8]| replace_file(&folder.join(file), content, Durability::Cached);
        put(TABLE, &self.table()?)?;
        put(POSITIONS, &self.positions()?)?;
        put(JSON_FILE, json_text(self, tolerance).as_bytes())?;
        Ok(())
    }

    /// The runs as plots and texts name them: by folder and engine.
    pub fn names(&self) -> [String; 2] {
        let [first, second] = self.runs.each_ref().map(|run| {
            run.folder.file_name().map_or_else(|| ".".to_owned(), |name| name.to_string_lossy().into_owned())
        });
        let names = if first == second {
            self.runs.each_ref().map(|run| run.folder.display().to_string())
        } else {
            [first, second]
        };
        let [first, second] = names;
        [format!("{first} ({})", self.runs[0].engine), format!("{second} ({})", self.runs[1].engine)]
    }

    fn table(&self) -> Result<Vec<u8>, OutputError> {
        let mut rows = Rows::default();
        for tip in &self.tips {
            let mut columns = COMPARE_COLUMNS.into_iter().skip(4);
            let mut real = |rows: &mut Rows, value: Option<f64>| {
                rows.optional(columns.next().unwrap_or_default(), value);
            };
            for count in [tip.step, tip.crack, tip.tip, tip.sifs.map_or(0, |sifs| sifs.positions)] {
                rows.count(count);
            }
            for mode in [tip.sifs.map(|sifs| sifs.ki), tip.sifs.map(|sifs| sifs.kii)] {
                real(&mut rows, mode.map(|mode| mode.largest));
                real(&mut rows, mode.map(|mode| tip.percent(mode.largest)));
                real(&mut rows, mode.map(|mode| self.percent(mode.largest)));
                real(&mut rows, mode.map(|mode| mode.xc_over_a));
                real(&mut rows, mode.map(|mode| mode.rms));
            }
            real(&mut rows, Some(tip.step_peak));
            for value in tip.places.as_flattened() {
                real(&mut rows, Some(*value));
            }
            real(&mut rows, Some(tip.distance));
            for value in tip.lengths.into_iter().chain(tip.load_cycles) {
                real(&mut rows, Some(value));
            }
            for value in [tip.kink_deg, tip.rival_deg, tip.rival_ratio].as_flattened() {
                real(&mut rows, *value);
            }
            for name in &tip.stops {
                rows.name(name);
            }
            rows.end();
        }
        let comments = [
            "Two runs set against each other: a row per step and tip that both have; _1 and _2: first and second run",
            "dki, dkii: absolute difference of K over the stabilised passage, MPa sqrt(m): the largest, where, and its root mean square",
            "percent_of_step, percent_of_case: of the largest |K_I| or |K_II| of both runs in the step, in all common steps",
            "lengths and coordinates: mm, y upwards; angles: degrees from straight ahead, counter-clockwise positive",
            "empty: no common wheel position, a tip that is not loaded, or no rival direction",
        ];
        Ok(with_header(&comments, &COMPARE_COLUMNS, rows.text(TABLE)?))
    }

    fn positions(&self) -> Result<Vec<u8>, OutputError> {
        let [_, _, _, xc, ki_1, ki_2, dki, kii_1, kii_2, dkii] = COMPARE_POSITIONS_COLUMNS;
        let mut rows = Rows::default();
        for (tip, aligned) in self.tips.iter().zip(&self.aligned) {
            for (i, &x) in aligned.xc_over_a.iter().enumerate() {
                for count in [tip.step, tip.crack, tip.tip] {
                    rows.count(count);
                }
                rows.real(xc, x);
                for (k, [one, other, difference]) in
                    [(&aligned.ki, [ki_1, ki_2, dki]), (&aligned.kii, [kii_1, kii_2, dkii])]
                {
                    rows.real(one, k[0][i]);
                    rows.real(other, k[1][i]);
                    rows.real(difference, k[1][i] - k[0][i]);
                }
                rows.end();
            }
        }
        let comments = [
            "K of two runs over the stabilised passage of each step, at common wheel positions in ascending order",
            "_1 and _2: first and second run; dki, dkii: second minus first, MPa sqrt(m)",
        ];
        Ok(with_header(&comments, &COMPARE_POSITIONS_COLUMNS, rows.text(POSITIONS)?))
    }
}

fn with_header(comments: &[&str], columns: &[&str], rows: &[u8]) -> Vec<u8> {
    let mut table = header(comments, columns).into_bytes();
    table.extend_from_slice(rows);
    table
}

//! Calibration of the coefficient of the growth law, in closed form.

use crate::csv::TipRow;
use crate::error::OutputError;
use railcrack_case::{CaseErrors, Column, Columns};
use std::path::Path;
use thiserror::Error;

/// The measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Depth of the tip.
    Depth,
    /// Length of the crack.
    Length,
}

/// A measured crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Million gross tonnes since the crack had the size with which the case begins.
    pub mgt: f64,
    /// Its depth or length, mm.
    pub size: f64,
}

/// A measured crack and the computed one of the same size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    /// The measurement.
    pub measured: Measured,
    /// Million gross tonnes at which the run reaches that size.
    pub computed_mgt: f64,
    /// The coefficient with which it would do so at the measured tonnage, over that of the case.
    pub ratio: f64,
}

/// The fitted coefficient of the growth law.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The measurements that were used, in their order.
    pub used: Vec<Compared>,
    /// The median of the coefficient over that of the case.
    pub factor: f64,
    /// Standard deviation of ln C from measurement to measurement; none for a single one.
    pub log_std: Option<f64>,
    /// The factor is between these with 95 %, if the scatter is log-normal; none for a single
    /// measurement.
    pub interval: Option<(f64, f64)>,
}

/// Measurements that cannot be used for calibration.
#[derive(Debug, Error)]
pub enum CalibrationError {
    /// A run folder that cannot be read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A parameter without effect.
    #[error("{key} has no effect on the tonnage at which the measured sizes are reached")]
    NoInfluence {
        /// The parameter.
        key: String,
    },
    /// No measurement within the sizes of the run.
    #[error(
        "no measurement lies within the sizes of the run, from {from:.3} to {to:.3} mm (the first excluded), at a tonnage above 0 MGT"
    )]
    NothingToCompare {
        /// The smallest and the largest size of the run, mm.
        from: f64,
        /// See `from`.
        to: f64,
    },
}

/// A file of measurements.
const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("mgt"), Column::Alternative("depth_mm"), Column::Alternative("length_mm")],
    largest: 1e6,
    help: "a file of measurements begins with the header mgt,depth_mm or mgt,length_mm and has a row for each measurement",
};

/// The measurements in the CSV file `path` with the header `mgt,depth_mm` or `mgt,length_mm`.
///
/// Errors: it cannot be read; another header; a row that is not two finite numbers.
pub fn read_measured(path: &Path) -> Result<(Measure, Vec<Measured>), CaseErrors> {
    let read = COLUMNS.read_file(path)?;
    let (measure, column) = if read.is_given[1] { (Measure::Depth, 1) } else { (Measure::Length, 2) };
    let measured = read.rows.iter().map(|row| Measured { mgt: row[0], size: row[column] }).collect();
    Ok((measure, measured))
}

impl Measure {
    /// The quantity in a row, mm.
    fn of(self, row: &TipRow) -> f64 {
        match self {
            Self::Depth => row.depth.unwrap_or(-row.place[1]),
            Self::Length => row.length,
        }
    }
}

/// The `measured` cracks with those of a run; none for a crack outside its sizes.
pub fn compared(
    rows: &[TipRow],
    tonnes: f64,
    measure: Measure,
    measured: &[Measured],
) -> Vec<Option<Compared>> {
    let size = |row: &TipRow| measure.of(row);
    let mgt = |row: &TipRow| 1e-6 * tonnes * row.load_cycles;
    let computed = |wanted: f64| {
        let pair = rows.windows(2).find(|pair| size(&pair[0]) < wanted && size(&pair[1]) >= wanted)?;
        let share = (wanted - size(&pair[0])) / (size(&pair[1]) - size(&pair[0]));
        Some(mgt(&pair[0]) + share * (mgt(&pair[1]) - mgt(&pair[0])))
    };
    let compare = |measured: &Measured| {
        let computed_mgt = computed(measured.size).filter(|mgt| *mgt > 0.0 && measured.mgt > 0.0)?;
        Some(Compared { measured: *measured, computed_mgt, ratio: computed_mgt / measured.mgt })
    };
    measured.iter().map(compare).collect()
}

/// Fits the coefficient of the growth law of a run to `measured` cracks; `rows` are those of its
/// deepest tip, and axles have `tonnes` in the mean.
///
/// The number of cycles between two sizes is in proportion to 1/C, so that each measurement gives a
/// C in closed form: that of the run times computed over measured tonnage. The fit is the mean of
/// ln C, its scatter that from measurement to measurement, the interval that of Student.
///
/// Errors: no measurement is within the sizes of the run.
pub fn calibrate(
    rows: &[TipRow],
    tonnes: f64,
    measure: Measure,
    measured: &[Measured],
) -> Result<Calibration, CalibrationError> {
    let used: Vec<Compared> = compared(rows, tonnes, measure, measured).into_iter().flatten().collect();
    if used.is_empty() {
        let size = |row: &TipRow| measure.of(row);
        let (from, to) = (rows.first().map_or(0.0, size), rows.last().map_or(0.0, size));
        return Err(CalibrationError::NothingToCompare { from, to });
    }
    let count = used.len() as f64;
    let mean = used.iter().map(|compared| compared.ratio.ln()).sum::<f64>() / count;
    let squares: f64 = used.iter().map(|compared| (compared.ratio.ln() - mean).powi(2)).sum();
    let log_std = (used.len() > 1).then(|| (squares / (count - 1.0)).sqrt());
    let interval = log_std.map(|std| {
        let reach = student(used.len() - 1) * std / count.sqrt();
        ((mean - reach).exp(), (mean + reach).exp())
    });
    Ok(Calibration { used, factor: mean.exp(), log_std, interval })
}

/// Student's t of 97.5 % for some `degrees` of freedom: a table, between its entries from above.
pub(super) fn student(degrees: usize) -> f64 {
    const TABLE: [(usize, f64); 14] = [
        (1, 12.706),
        (2, 4.303),
        (3, 3.182),
        (4, 2.776),
        (5, 2.571),
        (6, 2.447),
        (7, 2.365),
        (8, 2.306),
        (9, 2.262),
        (10, 2.228),
        (15, 2.131),
        (20, 2.086),
        (30, 2.042),
        (60, 2.000),
    ];
    let below = TABLE.iter().rev().find(|(n, _)| *n <= degrees);
    if degrees > 120 { 1.98 } else { below.map_or(TABLE[0].1, |(_, t)| *t) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tip that is 2 + MGT/10 mm deep.
    fn rows() -> Vec<TipRow> {
        let row = |step: usize| TipRow {
            place: [0.0, -2.0 - step as f64],
            length: 4.0 + 2.0 * step as f64,
            load_cycles: 5e5 * step as f64,
            ..TipRow::idle(step)
        };
        (0..5).map(row).collect()
    }

    #[test]
    fn synthetic_data_give_their_coefficient_back() {
        // A crack that grows 1.5 times as fast, measured with 10 % of scatter that cancels out.
        let at =
            |depth: f64, scatter: f64| Measured { mgt: 10.0 * (depth - 2.0) / 1.5 * scatter, size: depth };
        let data = [at(2.5, 1.1), at(3.5, 1.0 / 1.1), at(4.5, 1.1), at(5.5, 1.0 / 1.1), at(7.0, 1.0)];
        let fit = calibrate(&rows(), 20.0, Measure::Depth, &data).unwrap();
        assert_eq!(fit.used.len(), 4, "one is deeper than the run");
        assert!((fit.factor - 1.5).abs() < 1e-12, "{fit:?}");
        let std = 1.1_f64.ln() * (4.0_f64 / 3.0).sqrt();
        assert!((fit.log_std.unwrap() - std).abs() < 1e-12);
        let (low, high) = fit.interval.unwrap();
        assert!(low < 1.5 && 1.5 < high && (high / 1.5 - (3.182 * std / 2.0).exp()).abs() < 1e-12);
    }

    #[test]
    fn files_of_measurements() {
        let folder = std::env::temp_dir().join(format!("railcrack-measured-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let read = |text: &str| {
            let path = folder.join("m.csv");
            std::fs::write(&path, text).unwrap();
            read_measured(&path)
        };
        let (measure, data) = read("# a rail\nmgt,length_mm\n10, 5.5\n").unwrap();
        assert_eq!((measure, data), (Measure::Length, vec![Measured { mgt: 10.0, size: 5.5 }]));
        assert_eq!(
            read("depth_mm,mgt\n2,1\n").unwrap(),
            (Measure::Depth, vec![Measured { mgt: 1.0, size: 2.0 }])
        );
        for (text, line, says) in [
            ("depth,mgt\n", 1, "unknown column `depth`; nearest known column: `depth_mm`"),
            ("mgt\n1\n", 1, "column `depth_mm` or `length_mm` is missing"),
            (
                "mgt,depth_mm,length_mm\n1,2,3\n",
                1,
                "column `depth_mm` or `length_mm` must be given, and only one of them",
            ),
            ("mgt,depth_mm\n1,2\n3,x\n", 3, "`depth_mm = x`: must be a number in [-1e6, 1e6]"),
            ("mgt,depth_mm\n1,2,3\n", 2, "3 values in a row of 2 columns"),
        ] {
            let errors = read(text).unwrap_err();
            let error = &errors.errors()[0];
            assert!(error.message().starts_with(says) && error.file().ends_with("m.csv"), "{says}: {error}");
            assert!(
                error.help().is_some_and(|help| help.contains("mgt,depth_mm or mgt,length_mm")),
                "{text}"
            );
            assert_eq!(error.position().map(|place| place.0), Some(line), "{text}");
        }
        assert!(
            read_measured(&folder.join("none.csv"))
                .unwrap_err()
                .to_string()
                .contains("there is no such file")
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn measurements_beyond_the_run_are_refused() {
        let far = [Measured { mgt: 1.0, size: 50.0 }];
        let refused = calibrate(&rows(), 20.0, Measure::Depth, &far).unwrap_err().to_string();
        assert!(refused.contains("from 2.000 to 6.000"), "{refused}");
    }
}

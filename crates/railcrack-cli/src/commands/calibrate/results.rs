//! Results of both kinds of calibration: the rows of the deepest tip, measured and computed sizes
//! over traffic.

use crate::exit::Failure;
use railcrack_report::{Chart, ChartAxis, ChartSheet, Curve, CurveDots, CurveLook, put};
use railcrack_run::OutputError;
use railcrack_run::calibration::{Measure, Measured};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::RunError;
use std::path::Path;

pub(super) fn from_output(error: OutputError) -> Failure {
    Failure::Run(error.into())
}

/// The rows of the tip that is deepest in the last step.
pub(super) fn deepest(growth: &[TipRow]) -> Vec<TipRow> {
    let last = growth.last().map_or(0, |row| row.step);
    let tips = growth.iter().filter(|row| row.step == last);
    let Some(deepest) = tips.reduce(|a, b| if b.place[1] < a.place[1] { b } else { a }) else {
        return Vec::new();
    };
    growth.iter().filter(|row| (row.crack, row.tip) == (deepest.crack, deepest.tip)).copied().collect()
}

/// A run: its name, its rows, and how many times as fast it is drawn.
pub(super) type Drawn<'a> = (&'a str, &'a [TipRow], f64);

/// Measured and computed sizes over traffic.
pub(super) fn plot(
    title: &str,
    tonnes: f64,
    measure: Measure,
    measured: &[Measured],
    runs: &[Drawn],
) -> String {
    let (what, size): (&str, fn(&TipRow) -> f64) = match measure {
        Measure::Depth => ("Depth", |row| -row.place[1]),
        Measure::Length => ("Length", |row| row.length),
    };
    let curve = |(name, rows, factor): &Drawn| {
        let points = rows.iter().map(|row| [1e-6 * tonnes * row.load_cycles / factor, size(row)]);
        Curve::line(name, points.collect())
    };
    let points = measured.iter().map(|one| [one.mgt, one.size]).collect();
    let chart = Chart {
        id: "calibration".to_owned(),
        caption: format!("{what} over traffic: measured, computed, and computed with the fitted value."),
        x: ChartAxis::linear("Traffic", "million gross tonnes"),
        y: ChartAxis::linear(what, "mm"),
        curves: runs
            .iter()
            .map(curve)
            .chain([
                Curve { look: CurveLook::Dots, ..Curve::line("measured", points) }.with_dots(CurveDots::All)
            ])
            .collect(),
        ..Chart::default()
    };
    ChartSheet::of(title, &format!("{what} over traffic"), chart).svg()
}

pub(super) fn write(folder: &Path, name: &str, text: &str) -> Result<(), Failure> {
    Ok(put(&folder.join(name), text).map_err(RunError::from)?)
}

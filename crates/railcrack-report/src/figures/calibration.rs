//! Measured and computed sizes over traffic.

use crate::chart::{Chart, ChartAxis, Curve, CurveDots, CurveLook};
use railcrack_run::calibration::{Finding, Measure, Measured, Site, quantities};
use railcrack_run::csv::TipRow;

/// A run that is drawn with measurements.
#[derive(Debug, Clone, Copy)]
pub struct CalibratedRun<'a> {
    /// Its name in the legend.
    pub name: &'a str,
    /// The rows of one tip.
    pub rows: &'a [TipRow],
    /// How many times as fast it is drawn as it was computed.
    pub speed: f64,
}

/// Measured and computed sizes over traffic with axles of `tonnes` t, a chart for each quantity.
pub fn calibration_charts(tonnes: f64, sites: &[Site], runs: &[CalibratedRun]) -> Vec<Chart> {
    quantities(sites).into_iter().map(|measure| sizes(measure, tonnes, sites, runs)).collect()
}

fn sizes(measure: Measure, tonnes: f64, sites: &[Site], runs: &[CalibratedRun]) -> Chart {
    let (what, id) = match measure {
        Measure::Depth => ("Depth", "calibration-depth"),
        Measure::Length => ("Length", "calibration-length"),
    };
    let size = |row: &TipRow| match measure {
        Measure::Depth => row.depth.unwrap_or(-row.place[1]),
        Measure::Length => row.length,
    };
    let curve = |run: &CalibratedRun| {
        let points = run.rows.iter().map(|row| [1e-6 * tonnes * row.load_cycles / run.speed, size(row)]);
        Curve::line(run.name, points.collect())
    };
    let measured = sites.iter().filter(|site| site.measure == measure).map(|site| {
        let points = site.measured.iter().map(at).collect();
        Curve { look: CurveLook::Dots, ..Curve::line(&site.name, points) }.with_dots(CurveDots::All)
    });
    Chart {
        id: id.to_owned(),
        caption: format!(
            "{what} over traffic: measured (classes at their middle, open ones at their bound), computed, and computed with the fitted value."
        ),
        x: ChartAxis::linear("Traffic", "million gross tonnes"),
        y: ChartAxis::linear(what, "mm"),
        curves: runs.iter().map(curve).chain(measured).collect(),
        ..Chart::default()
    }
}

/// The place of a measurement: MGT, mm.
fn at(measured: &Measured) -> [f64; 2] {
    let size = match measured.finding {
        Finding::Size(size) => size,
        Finding::Within(from, to) if from.is_finite() && to.is_finite() => 0.5 * (from + to),
        Finding::Within(from, _) if from.is_finite() => from,
        Finding::Within(_, to) => to,
    };
    [measured.mgt, size]
}

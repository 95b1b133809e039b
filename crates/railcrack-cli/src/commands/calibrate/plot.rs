//! Measured and computed sizes over traffic.

use super::table::quantities;
use railcrack_report::{Chart, ChartAxis, ChartSheet, Curve, CurveDots, CurveLook};
use railcrack_run::calibration::{Finding, Measure, Measured, Site};
use railcrack_run::csv::TipRow;

/// A run: its name, its rows, and how many times as fast it is drawn.
pub(super) type Drawn<'a> = (&'a str, &'a [TipRow], f64);

/// The chart of measured and computed sizes, by quantity.
pub(super) struct Plot {
    pub charts: Vec<Chart>,
}

impl Plot {
    /// All of it on a sheet.
    pub fn sheet(&self, title: &str) -> ChartSheet {
        let first = self.charts.first().cloned().unwrap_or_default();
        ChartSheet::of(title, "measured and computed sizes over traffic", first)
    }
}

/// Measured and computed sizes over traffic.
pub(super) fn plot(tonnes: f64, sites: &[Site], runs: &[Drawn]) -> Plot {
    let chart = |measure: Measure| {
        let (what, id) = match measure {
            Measure::Depth => ("Depth", "calibration-depth"),
            Measure::Length => ("Length", "calibration-length"),
        };
        let size = |row: &TipRow| match measure {
            Measure::Depth => row.depth.unwrap_or(-row.place[1]),
            Measure::Length => row.length,
        };
        let curve = |(name, rows, factor): &Drawn| {
            let points = rows.iter().map(|row| [1e-6 * tonnes * row.load_cycles / factor, size(row)]);
            Curve::line(name, points.collect())
        };
        let measured = sites.iter().filter(|site| site.measure == measure).map(|site| {
            let at = |measured: &Measured| {
                let size = match measured.finding {
                    Finding::Size(size) => size,
                    Finding::Within(from, to) if from.is_finite() && to.is_finite() => 0.5 * (from + to),
                    Finding::Within(from, to) => {
                        if from.is_finite() {
                            from
                        } else {
                            to
                        }
                    }
                };
                [measured.mgt, size]
            };
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
    };
    Plot { charts: quantities(sites).into_iter().map(chart).collect() }
}

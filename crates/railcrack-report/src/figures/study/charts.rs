//! The charts of a study.

use super::run::StudyRun;
use super::styles::Styles;
use crate::chart::{Chart, ChartAxis, ChartLegend, Curve, CurveDots};
use crate::figures::sif::Mode;
use crate::figures::{cycles, paths, sif};
use railcrack_run::run_folder::RepresentativeTip;

/// K of the initial cracks, paths and growth of `runs`, those with a finished step among them.
pub(crate) fn study_charts(runs: &[&StudyRun], styles: &Styles) -> Vec<Chart> {
    let with_tip: Vec<(&StudyRun, &RepresentativeTip)> =
        runs.iter().filter_map(|run| Some((*run, run.tip()?))).collect();
    if with_tip.is_empty() {
        return Vec::new();
    }
    let of_tip = |points: &dyn Fn(&RepresentativeTip) -> Vec<[f64; 2]>| -> Vec<Curve> {
        with_tip.iter().map(|(run, tip)| styles.curve(run, points(tip))).collect()
    };
    let mut charts: Vec<Chart> = Mode::BOTH
        .into_iter()
        .map(|mode| {
            let caption = format!("{} of the initial cracks over the passage.", mode.symbol());
            sif::chart(mode.id(), mode.symbol(), caption, of_tip(&|tip| mode.points(&tip.history)))
        })
        .collect();
    let cracks = || {
        let summaries = with_tip.iter().filter_map(|(run, _)| Some((*run, run.row.summary.as_ref()?)));
        summaries.flat_map(|(run, summary)| summary.cracks.iter().map(move |crack| (run, crack)))
    };
    let grown = cracks().map(|(run, crack)| {
        let has_grown = paths::whole(crack).len() > crack.initial_points_mm.len();
        let dots = if has_grown { CurveDots::Last } else { CurveDots::None };
        styles.curve(run, paths::by_depth(paths::whole(crack))).with_dots(dots)
    });
    charts.push(paths::chart("Crack paths to scale.", grown.collect(), cracks().map(|(_, crack)| crack)));
    if with_tip.iter().any(|(_, tip)| tip.rows.len() > 1) {
        let lengths = of_tip(&|tip| tip.rows.iter().map(|row| [row.load_cycles, row.length]).collect());
        let lengths = lengths.into_iter().map(|curve| curve.with_dots(CurveDots::Last)).collect();
        let chart = cycles::chart("Crack length against load cycles.", lengths);
        // Lives differ by powers of ten: on a linear axis most curves would coincide with the axis.
        charts.push(Chart { x: ChartAxis::logarithmic(&chart.x.label, &chart.x.unit), ..chart });
        charts.push(Chart {
            id: "rate-length".to_owned(),
            caption: "Growth rate against crack length.".to_owned(),
            x: ChartAxis::linear("Crack length", "mm"),
            y: ChartAxis::logarithmic("da/dN", "mm/cycle"),
            curves: of_tip(&|tip| tip.rows.iter().map(|row| [row.length, row.rate]).collect()),
            ..Chart::default()
        });
    }
    charts.into_iter().map(|chart| Chart { legend: ChartLegend::Pointer, ..chart }).collect()
}

//! The charts and SVG files of a study.

use super::bands::{MANY, band_charts};
use super::styles::{StudyRun, Styles};
use crate::chart::{
    Chart, ChartAxis, ChartLegend, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, LegendEntry,
    SheetLegend,
};
use crate::figures::plot::Plot;
use crate::figures::sif::Mode;
use crate::figures::{paths, sif};
use railcrack_run::files::STUDY_PLOTS;
use railcrack_run::run_folder::RepresentativeTip;
use railcrack_run::study::StudyPlan;

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
        let chart = paths::lengths_chart("Crack length against load cycles.", lengths);
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

/// The plots of a study for its runs with a finished step; none without such runs.
pub(crate) fn study_plots(plan: &StudyPlan, runs: &[StudyRun], styles: &Styles) -> Vec<Plot> {
    if runs.len() > MANY {
        return band_plots(plan, runs);
    }
    let drawn: Vec<&StudyRun> = runs.iter().filter(|run| run.tip().is_some()).collect();
    let of_all = if drawn.len() == runs.len() { String::new() } else { format!(" of {}", runs.len()) };
    // The subtitle says which tip is shown if a run has several.
    let several = |run: &&StudyRun| {
        run.row.summary.as_ref().is_some_and(|summary| summary.cracks.len() > 1)
            || run.tip().is_some_and(|tip| tip.first.tip > 1)
    };
    let of_tip = if drawn.iter().any(several) { ", tip with the largest growth in each run" } else { "" };
    let sheet = |chart: Chart| {
        let file = STUDY_PLOTS.into_iter().find(|file| file.strip_suffix(".svg") == Some(&chart.id))?;
        let caption = chart.caption.trim_end_matches('.');
        let mut legend = styles.legend();
        let of_tip = if chart.id == "paths" { "" } else { of_tip };
        if chart.id == "paths" {
            legend.insert(0, LegendEntry::curve("initial crack", CurveLook::Line, CurveColour::Ink));
        }
        let subtitle = format!("{caption}{of_tip} · {}{of_all} runs", drawn.len());
        Some(Plot::sheet(
            file,
            ChartSheet {
                legend: SheetLegend::Entries(legend),
                ..ChartSheet::of(&plan.title, &subtitle, chart)
            },
        ))
    };
    study_charts(&drawn, styles).into_iter().filter_map(sheet).collect()
}

/// The plots of a study with many runs: quantile bands, without paths.
fn band_plots(plan: &StudyPlan, runs: &[StudyRun]) -> Vec<Plot> {
    let sheet = |chart: Chart| {
        let file = STUDY_PLOTS.into_iter().find(|file| file.strip_suffix(".svg") == Some(&chart.id))?;
        let subtitle = format!("{} · {} runs", chart.caption.trim_end_matches('.'), runs.len());
        Some(Plot::sheet(file, ChartSheet::of(&plan.title, &subtitle, chart)))
    };
    band_charts(runs).into_iter().filter_map(sheet).collect()
}

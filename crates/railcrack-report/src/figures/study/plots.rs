//! The SVG files of a study.

use super::bands::{MANY, band_charts};
use super::charts::study_charts;
use super::run::StudyRun;
use super::styles::Styles;
use crate::chart::{Chart, ChartSheet, CurveColour, CurveLook, LegendEntry, SheetLegend};
use crate::figures::plot::Plot;
use railcrack_run::files::STUDY_PLOTS;
use railcrack_run::study::StudyPlan;

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

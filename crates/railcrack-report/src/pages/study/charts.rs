//! The charts on the page of a study.

use crate::chart::{Chart, ChartAxis, Curve, CurveColour, CurveDots};
use crate::figures::{Plot, StudyRun, Styles, study_charts};
use crate::page::Block;
use crate::pages::pictures::still;
use railcrack_run::study::{StudyAxis, StudyPlan};
use std::collections::BTreeMap;

/// Runs on the charts; of more, evenly chosen ones.
const MOST_SHOWN: usize = 150;
/// Curves on the chart of the effect of an axis.
const MOST_COMBINATIONS: usize = 7;

/// The charts; none where no run has a step.
pub(super) fn charts(plan: &StudyPlan, runs: &[StudyRun], styles: &Styles, plots: &[Plot]) -> Vec<Block> {
    let with_tip: Vec<&StudyRun> = runs.iter().filter(|run| run.tip().is_some()).collect();
    let shown: Vec<&StudyRun> =
        with_tip.iter().copied().step_by(with_tip.len().div_ceil(MOST_SHOWN).max(1)).collect();
    let mut charts = study_charts(&shown, styles).into_iter();
    let (Some(ki), Some(kii)) = (charts.next(), charts.next()) else { return Vec::new() };
    let mut blocks = vec![Block::charts([ki, kii]), Block::charts(charts.chain(effect(plan, &with_tip)))];
    blocks.extend(plots.iter().filter_map(|plot| still(plots, plot.file, "")));
    if shown.len() < with_tip.len() {
        blocks.push(Block::Text(format!(
            "The charts show {} of {} runs, evenly chosen; summary.csv has all.",
            shown.len(),
            with_tip.len()
        )));
    }
    blocks
}

/// Growth rate of the initial cracks against the values of the axis with the colours, a curve for
/// each choice of the others; none where these values are no numbers, or where there are too many
/// curves.
fn effect(plan: &StudyPlan, runs: &[&StudyRun]) -> Option<Chart> {
    let axis: &StudyAxis = plan.axes.get(plan.colour_axis)?;
    let numbers = axis.numbers().filter(|numbers| numbers.len() > 1)?;
    let mut by_others: BTreeMap<Vec<usize>, Vec<[f64; 2]>> = BTreeMap::new();
    for run in runs {
        let mut others = run.planned.choice.clone();
        let value = *numbers.get(others.get(plan.colour_axis).copied()?)?;
        others.remove(plan.colour_axis);
        by_others.entry(others).or_default().push([value, run.tip()?.first.rate]);
    }
    if by_others.len() > MOST_COMBINATIONS {
        return None;
    }
    let axes: Vec<&StudyAxis> =
        plan.axes.iter().enumerate().filter(|(i, _)| *i != plan.colour_axis).map(|(_, axis)| axis).collect();
    let curve = |(place, (others, mut points)): (usize, (Vec<usize>, Vec<[f64; 2]>))| {
        let named =
            axes.iter().zip(&others).map(|(axis, &value)| format!("{} {}", axis.name(), axis.value(value)));
        points.sort_by(|one, other| one[0].total_cmp(&other[0]));
        Curve::line(&named.collect::<Vec<_>>().join("; "), points)
            .with_dots(CurveDots::All)
            .with_colour(CurveColour::Category(place))
    };
    Some(Chart {
        id: "effect".to_owned(),
        caption: format!(
            "Growth rate of the initial cracks against {}; a rate of zero is left out.",
            axis.name()
        ),
        x: ChartAxis::linear(&axis.name(), ""),
        y: ChartAxis::logarithmic("da/dN of the initial crack", "mm per load cycle"),
        curves: by_others.into_iter().enumerate().map(curve).collect(),
        ..Chart::default()
    })
}

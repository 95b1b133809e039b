//! The charts on the page of a study.

use crate::chart::{Chart, ChartAxis, Curve, CurveColour, CurveDots};
use crate::figures::{Plot, StudyRun, Styles, stratified, study_charts};
use crate::page::Block;
use crate::pages::pictures::still;
use railcrack_run::run_folder::RepresentativeTip;
use railcrack_run::study::{StudyAxis, StudyPlan};
use std::collections::{BTreeMap, BTreeSet};

/// Runs on the charts; of more, chosen ones that show every value.
const MOST_SHOWN: usize = 150;
/// Choices of keys that vary together on the chart of the effect of an axis: samples are no curve.
const MOST_TOGETHER: usize = 12;
/// Curves on the chart of the effect of an axis.
const MOST_COMBINATIONS: usize = 9;

/// The charts; none where no run has a step.
pub(super) fn charts(plan: &StudyPlan, runs: &[StudyRun], styles: &Styles, plots: &[Plot]) -> Vec<Block> {
    let with_tip: Vec<&StudyRun> = runs.iter().filter(|run| run.tip().is_some()).collect();
    let planned: Vec<_> = with_tip.iter().map(|run| run.planned).collect();
    let shown: Vec<&StudyRun> = stratified(&planned, &extremes(&with_tip), MOST_SHOWN)
        .into_iter()
        .map(|place| with_tip[place])
        .collect();
    let mut charts = study_charts(&shown, styles).into_iter();
    let (Some(ki), Some(kii)) = (charts.next(), charts.next()) else { return Vec::new() };
    let mut blocks = Vec::new();
    if shown.len() < with_tip.len() {
        blocks.push(Block::Text(left_out(plan, &with_tip, &shown)));
    }
    blocks.extend([Block::charts([ki, kii]), Block::charts(charts.chain(effect(plan, &with_tip)))]);
    blocks.extend(plots.iter().filter_map(|plot| still(plots, plot.file, "")));
    blocks
}

/// Places of the runs that end the axes of the charts: the fewest and the most load cycles, the
/// slowest and the fastest initial crack, the shortest and the longest final one.
fn extremes(runs: &[&StudyRun]) -> Vec<usize> {
    let quantities: [fn(&RepresentativeTip) -> f64; 3] =
        [|tip| tip.last().load_cycles, |tip| tip.first.rate, |tip| tip.last().length];
    let mut places = Vec::new();
    for quantity in quantities {
        let value = |place: &usize| runs[*place].tip().map_or(0.0, quantity);
        let by_value = |one: &usize, other: &usize| value(one).total_cmp(&value(other));
        places.extend((0..runs.len()).min_by(by_value));
        places.extend((0..runs.len()).max_by(by_value));
    }
    places
}

/// Runs and values that the charts leave out, a sentence or two.
fn left_out(plan: &StudyPlan, all: &[&StudyRun], shown: &[&StudyRun]) -> String {
    let values = |runs: &[&StudyRun], axis: usize| {
        runs.iter().filter_map(|run| run.planned.choice.get(axis)).collect::<BTreeSet<_>>().len()
    };
    let mut text = format!(
        "The charts show {} of {} runs, chosen so that all values of every key are shown as evenly as that \
         number allows, the extreme runs among them; summary.csv has all.",
        shown.len(),
        all.len()
    );
    for (i, axis) in plan.axes.iter().enumerate() {
        let (there, drawn) = (values(all, i), values(shown, i));
        if drawn < there {
            text.push_str(&format!(" Of {} they show {drawn} of {there} values.", axis.name()));
        }
    }
    text
}

/// Growth rate of the initial cracks against the values of the axis with the colours, a curve for
/// each choice of the others; none where these values are no numbers, where many keys that vary
/// together have each its part in it, or where there are too many curves.
fn effect(plan: &StudyPlan, runs: &[&StudyRun]) -> Option<Chart> {
    let axis: &StudyAxis = plan.axes.get(plan.colour_axis)?;
    let numbers = axis.numbers().filter(|numbers| numbers.len() > 1)?;
    if axis.keys.len() > 1 && numbers.len() > MOST_TOGETHER {
        return None;
    }
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
        y: ChartAxis::logarithmic("Initial da/dN", "mm/cycle"),
        curves: by_others.into_iter().enumerate().map(curve).collect(),
        ..Chart::default()
    })
}

//! The charts on the page of a study.

use crate::chart::{Chart, ChartAxis, Curve, CurveColour, CurveDots};
use crate::figures::{StudyRun, Styles, stratified, study_charts};
use crate::page::Block;
use railcrack_run::run_folder::RepresentativeTip;
use railcrack_run::study::{StudyAxis, StudyPlan};
use std::collections::{BTreeMap, BTreeSet};

/// Maximum number of runs on the charts; of more runs, a selection that shows every value.
const MOST_SHOWN: usize = 150;
/// Maximum number of combinations of coupled keys on that chart; random samples do not form curves.
const MOST_TOGETHER: usize = 12;
/// Maximum number of curves on the chart of the effect of an axis.
const MOST_COMBINATIONS: usize = 9;

/// The charts; none if no run has a finished step.
pub(super) fn charts(plan: &StudyPlan, runs: &[StudyRun], styles: &Styles) -> Vec<Block> {
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
    blocks
}

/// Indices of the extreme runs: fewest and most load cycles, slowest and fastest initial crack,
/// shortest and longest final crack.
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

/// Note on runs and values that the charts omit.
fn left_out(plan: &StudyPlan, all: &[&StudyRun], shown: &[&StudyRun]) -> String {
    let values = |runs: &[&StudyRun], axis: usize| {
        runs.iter().filter_map(|run| run.planned.choice.get(axis)).collect::<BTreeSet<_>>().len()
    };
    let mut text = format!(
        "The charts show {} of {} runs, selected to cover the values of every key as evenly as possible and to include the \
         extreme runs; summary.csv has all.",
        shown.len(),
        all.len()
    );
    for (i, axis) in plan.axes.iter().enumerate() {
        let (there, drawn) = (values(all, i), values(shown, i));
        if drawn < there {
            text.push_str(&format!(" They show {drawn} of {there} values of {}.", axis.name()));
        }
    }
    text
}

/// Growth rate of the initial cracks against the values of the coloured axis, one curve for each
/// combination of the others; none if these values are not numbers, if many coupled keys affect the
/// rate, or if there are too many curves.
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
            "Growth rate of the initial cracks against {}; zero rates are omitted.",
            axis.name()
        ),
        x: ChartAxis::linear(&axis.name(), ""),
        y: ChartAxis::logarithmic("Initial da/dN", "mm/cycle"),
        curves: by_others.into_iter().enumerate().map(curve).collect(),
        ..Chart::default()
    })
}

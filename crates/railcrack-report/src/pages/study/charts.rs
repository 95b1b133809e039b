//! All runs of a study on one chart each.

use super::styles::Styles;
use super::{MOST_SHOWN, StudyRun};
use crate::{Block, ChartAspect, ChartAxis, ChartLegend, ChartScale, Curve, CurveLook, LineChart};
use railcrack_run::representative::RepresentativeTip;
use railcrack_run::study::{StudyAxis, StudyPlan};
use std::collections::BTreeMap;

/// Curves on the chart of the effect of an axis.
const MOST_COMBINATIONS: usize = 7;

/// The charts; nothing where no run has a step.
pub(super) fn charts(
    plan: &StudyPlan,
    all: &[StudyRun],
    styles: &Styles,
    pictures: &[(&'static str, String)],
) -> Vec<Block> {
    let with_tip: Vec<(&StudyRun, &RepresentativeTip)> =
        all.iter().filter_map(|run| Some((run, run.tip()?))).collect();
    if with_tip.is_empty() {
        return Vec::new();
    }
    let every = with_tip.len().div_ceil(MOST_SHOWN);
    let shown: Vec<(&StudyRun, &RepresentativeTip)> = with_tip.iter().copied().step_by(every).collect();
    let picture =
        |file: &str| pictures.iter().find(|(name, _)| *name == file).map(|(_, picture)| picture.clone());
    let of_tip = |points: &dyn Fn(&RepresentativeTip) -> Vec<[f64; 2]>| -> Vec<Curve> {
        shown.iter().map(|(run, tip)| styles.curve(run.planned, &run.name, points(tip))).collect()
    };
    let chart = |id: &str, caption: &str, [x, y]: [ChartAxis; 2], curves: Vec<Curve>| LineChart {
        id: id.to_owned(),
        caption: caption.to_owned(),
        x,
        y,
        curves,
        legend: ChartLegend::Pointer,
        picture: picture(&format!("{id}.svg")),
        ..LineChart::default()
    };
    let xc = || ChartAxis::linear("Wheel position x_{c}/a");
    let history = |k: fn(&RepresentativeTip) -> &[f64]| {
        move |tip: &RepresentativeTip| {
            tip.history.xc_over_a.iter().zip(k(tip)).map(|(&x, &k)| [x, k]).collect()
        }
    };
    let mut blocks = vec![Block::Beside(vec![
        Block::Chart(chart(
            "ki",
            "K_{I} of the initial cracks over the passage.",
            [xc(), ChartAxis::linear("K_{I} (MPa√m)")],
            of_tip(&history(|tip| &tip.history.ki)),
        )),
        Block::Chart(chart(
            "kii",
            "K_{II} of the initial cracks over the passage.",
            [xc(), ChartAxis::linear("K_{II} (MPa√m)")],
            of_tip(&history(|tip| &tip.history.kii)),
        )),
    ])];
    let paths = LineChart {
        aspect: ChartAspect::Equal,
        ..chart(
            "paths",
            "Crack paths to scale.",
            [
                ChartAxis::linear("x (mm)"),
                ChartAxis { scale: ChartScale::Depth, ..ChartAxis::linear("Depth (mm)") },
            ],
            path_curves(&shown, styles),
        )
    };
    let mut others = vec![Block::Chart(paths)];
    if shown.iter().any(|(_, tip)| tip.rows.len() > 1) {
        others.push(Block::Chart(chart(
            "length-cycles",
            "Crack length against load cycles (axles).",
            [ChartAxis::linear("Load cycles (axles)"), ChartAxis::linear("Crack length (mm)")],
            of_tip(&|tip| tip.rows.iter().map(|row| [row.load_cycles, row.length]).collect()),
        )));
        others.push(Block::Chart(chart(
            "rate-length",
            "Growth rate against crack length.",
            [ChartAxis::linear("Crack length (mm)"), ChartAxis::logarithmic("da/dN (mm per load cycle)")],
            of_tip(&|tip| tip.rows.iter().map(|row| [row.length, row.rate]).collect()),
        )));
    }
    others.extend(effect(plan, &with_tip).map(Block::Chart));
    blocks.push(Block::Beside(others));
    if every > 1 {
        let text = format!(
            "The charts show {} of {} runs, evenly chosen; summary.csv has all.",
            shown.len(),
            with_tip.len()
        );
        blocks.push(Block::Text(text));
    }
    blocks
}

fn path_curves(shown: &[(&StudyRun, &RepresentativeTip)], styles: &Styles) -> Vec<Curve> {
    let of_run = |(run, _): &(&StudyRun, &RepresentativeTip)| {
        let cracks = run.row.summary.as_ref().map_or(&[][..], |summary| &summary.cracks);
        let curve = |points: &[[f64; 2]]| {
            let points = points.iter().map(|&[x, y]| [x, -y]).collect();
            styles.curve(run.planned, &run.name, points)
        };
        cracks.iter().map(|crack| curve(&crack.points_mm)).collect::<Vec<_>>()
    };
    shown.iter().flat_map(of_run).collect()
}

/// Growth rate of the initial cracks against the values of the axis with the colours, a curve for each choice of the others; none
/// where these values are no numbers, or where there are too many curves.
fn effect(plan: &StudyPlan, with_tip: &[(&StudyRun, &RepresentativeTip)]) -> Option<LineChart> {
    let axis: &StudyAxis = plan.axes.get(plan.colour_axis)?;
    let numbers = axis.numbers().filter(|numbers| numbers.len() > 1)?;
    let mut by_others: BTreeMap<Vec<usize>, Vec<[f64; 2]>> = BTreeMap::new();
    for (run, tip) in with_tip {
        let mut others = run.planned.choice.clone();
        let value = *numbers.get(others.get(plan.colour_axis).copied()?)?;
        others.remove(plan.colour_axis);
        by_others.entry(others).or_default().push([value, tip.first.rate]);
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
            .with_look(CurveLook::Dotted)
            .with_colour(place)
    };
    Some(LineChart {
        id: "effect".to_owned(),
        caption: format!(
            "Growth rate of the initial cracks against {}; a rate of zero is left out.",
            axis.name()
        ),
        x: ChartAxis::linear(&axis.name()),
        y: ChartAxis::logarithmic("da/dN at first (mm per load cycle)"),
        curves: by_others.into_iter().enumerate().map(curve).collect(),
        ..LineChart::default()
    })
}

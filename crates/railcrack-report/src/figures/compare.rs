//! Two runs: K of both and its difference, crack paths, lengths.

use super::paths;
use super::plot::Plot;
use super::sif::{self, Mode};
use super::wheel_passage::ROUND_OFF;
use crate::chart::{
    Chart, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, CurveWidth, LegendEntry, SheetLegend,
};
use railcrack_run::Comparison;
use railcrack_run::compare::TipComparison;
use railcrack_run::compare::{self, Aligned};

/// A tip of both runs with K at common positions.
type Tip<'a> = (&'a TipComparison, &'a Aligned);

/// The plots of a comparison; none if the runs have no common step.
pub(crate) fn comparison_plots(comparison: &Comparison) -> Vec<Plot> {
    if comparison.common_steps == 0 {
        return Vec::new();
    }
    let last = comparison.common_steps - 1;
    vec![
        Plot::sheet(compare::FIRST_STEP, sifs(comparison, 0)),
        Plot::sheet(compare::LAST_STEP, sifs(comparison, last)),
        Plot::sheet(compare::PATHS, paths_of_both(comparison)),
    ]
}

/// The first and the last common step.
pub(crate) fn steps_of_both(comparison: &Comparison) -> Vec<usize> {
    let mut steps = vec![0, comparison.common_steps.saturating_sub(1)];
    steps.dedup();
    steps
}

/// K of both runs and its difference in `step`.
fn sifs(comparison: &Comparison, step: usize) -> ChartSheet {
    let names = comparison.names();
    let all = comparison.tips.iter().zip(&comparison.aligned);
    let tips: Vec<Tip> = all.filter(|(tip, _)| tip.step == step).collect();
    let near = |curve: Curve| near_part(curve, comparison);
    let row = |mode: Mode| {
        let symbol = mode.symbol();
        let both = sif::chart(
            &format!("{}-{step}", mode.id()),
            symbol,
            format!("{symbol} of both runs; second run dashed."),
            tips.iter()
                .enumerate()
                .flat_map(|tip| both_runs(&names, mode, tip, tips.len()))
                .map(&near)
                .collect(),
        );
        let difference = sif::chart(
            &format!("{}-difference-{step}", mode.id()),
            &format!("{symbol}, second − first"),
            format!("Difference of {symbol}, second minus first."),
            tips.iter().enumerate().map(|tip| difference(mode, tip, tips.len())).map(&near).collect(),
        );
        vec![both, difference]
    };
    // A rail that bends has positions many metres away, at which K near the crack would be a line.
    let far = |mode: Mode| {
        let symbol = mode.symbol();
        let curves = tips.iter().enumerate().flat_map(|tip| both_runs(&names, mode, tip, tips.len()));
        let chart = sif::far_chart(
            &format!("{}-far-{step}", mode.id()),
            symbol,
            format!("{symbol} of both runs over the whole passage; second run dashed."),
            curves.map(|curve| in_metres(curve, comparison)).collect(),
        );
        vec![chart]
    };
    let mut rows = Mode::BOTH.map(row).to_vec();
    if is_far(comparison, &tips) {
        rows.extend(Mode::BOTH.map(far));
    }
    let mut legend = Vec::new();
    if tips.len() > 1 {
        legend.extend(LegendEntry::solid_and_dashed([&names[0], &names[1]]));
        let every = tips.len().div_ceil(16);
        legend.extend(tips.iter().enumerate().step_by(every).map(|(place, (tip, _))| {
            LegendEntry::curve(&tip_name(tip), CurveLook::Line, CurveColour::of(place, tips.len()))
        }));
    }
    ChartSheet {
        title: format!("{} and {}", names[0], names[1]),
        subtitle: format!(
            "K of the stabilised passage at step {step}; left: both runs, right: second minus first"
        ),
        rows,
        legend: if legend.is_empty() { SheetLegend::default() } else { SheetLegend::Entries(legend) },
    }
}

/// Positions (x_c/a) near the cracks in both runs.
fn near_ends(comparison: &Comparison) -> Option<[f64; 2]> {
    let [first, second] = comparison.runs.each_ref().map(|run| run.near_over_a);
    let ([a, b], [c, d]) = (first?, second?);
    Some([a.max(c) - ROUND_OFF, b.min(d) + ROUND_OFF])
}

/// The part of a curve over x_c/a that is near the cracks.
fn near_part(mut curve: Curve, comparison: &Comparison) -> Curve {
    if let Some([from, to]) = near_ends(comparison) {
        curve.points.retain(|point| (from..=to).contains(&point[0]));
    }
    curve
}

/// Whether some of the common positions are far from the cracks.
fn is_far(comparison: &Comparison, tips: &[Tip]) -> bool {
    let Some([from, to]) = near_ends(comparison) else { return false };
    tips.iter().any(|(_, aligned)| aligned.xc_over_a.iter().any(|x| !(from..=to).contains(x)))
}

/// The same curve over the wheel position from the first mouth, metres.
fn in_metres(mut curve: Curve, comparison: &Comparison) -> Curve {
    let metres = 1e-3 * comparison.runs[0].half_width_mm;
    curve.points.iter_mut().for_each(|point| point[0] *= metres);
    curve
}

fn k(mode: Mode, aligned: &Aligned) -> &[Vec<f64>; 2] {
    match mode {
        Mode::I => &aligned.ki,
        Mode::II => &aligned.kii,
    }
}

fn tip_name(tip: &TipComparison) -> String {
    format!("crack {}, tip {}", tip.crack, tip.tip)
}

/// K of a tip in both runs. Colours denote the runs for a single tip, the tips for several.
fn both_runs(
    names: &[String; 2],
    mode: Mode,
    (place, (tip, aligned)): (usize, &Tip),
    count: usize,
) -> [Curve; 2] {
    let curve = |run: usize| {
        let points = aligned.xc_over_a.iter().zip(&k(mode, aligned)[run]).map(|(&x, &k)| [x, k]);
        let name = if count == 1 { names[run].clone() } else { format!("{}, {}", tip_name(tip), names[run]) };
        let colour = if count == 1 { CurveColour::Category(run) } else { CurveColour::of(place, count) };
        of_run(run, Curve::line(&name, points.collect())).with_colour(colour)
    };
    [curve(0), curve(1)]
}

/// `curve` of the first or the second run; the first is wider, so that it is visible below the
/// second.
fn of_run(run: usize, curve: Curve) -> Curve {
    let curve = curve.with_colour(CurveColour::Category(run));
    if run == 0 { curve.with_width(CurveWidth::Wide) } else { curve.with_look(CurveLook::Dashed) }
}

fn difference(mode: Mode, (place, (tip, aligned)): (usize, &Tip), count: usize) -> Curve {
    let [first, second] = k(mode, aligned);
    let values = first.iter().zip(second).map(|(first, second)| second - first);
    let points = aligned.xc_over_a.iter().copied().zip(values).map(|(x, k)| [x, k]).collect();
    if count == 1 {
        return Curve::line("", points).with_colour(CurveColour::Category(2));
    }
    Curve::line(&tip_name(tip), points).with_colour(CurveColour::of(place, count))
}

fn paths_of_both(comparison: &Comparison) -> ChartSheet {
    let names = comparison.names();
    let curve = |run: usize| {
        let name = &names[run];
        comparison.cracks[run]
            .iter()
            .map(move |crack| of_run(run, paths::path(name, crack)).with_dots(paths::increments(crack)))
    };
    let curves = (0..2).flat_map(curve).collect();
    let chart =
        paths::chart("Crack paths to scale; second run dashed.", curves, comparison.cracks.iter().flatten());
    ChartSheet::of(
        &format!("{} and {}", names[0], names[1]),
        "Crack paths to scale, dots mark the ends of the increments",
        chart,
    )
}

/// Lengths of the cracks in the common steps.
pub(crate) fn lengths_of_both(comparison: &Comparison) -> Chart {
    let names = comparison.names();
    let mut cracks: Vec<usize> = comparison.tips.iter().map(|tip| tip.crack).collect();
    cracks.sort_unstable();
    cracks.dedup();
    let curve = |run: usize, crack: usize| {
        let rows = comparison.tips.iter().filter(|tip| (tip.crack, tip.tip) == (crack, 1));
        let points = rows.map(|tip| [tip.load_cycles[run], tip.lengths[run]]).collect();
        let dots = if run == 0 { CurveDots::All } else { CurveDots::None };
        of_run(run, Curve::line(&names[run], points)).with_dots(dots)
    };
    let curves = (0..2).flat_map(|run| cracks.iter().map(move |&crack| (run, crack)));
    paths::lengths_chart(
        "Crack length against load cycles in the common steps; second run dashed.",
        curves.map(|(run, crack)| curve(run, crack)).collect(),
    )
}

//! All runs of a study in one picture.

use super::paths::{draw_rail, equal_axes};
use super::{HEADING, draw_title, shortened, wheel_position};
use crate::svg::{
    Axes, Axis, CATEGORIES, Entry, Frame, INK, Mark, Span, Stroke, Svg, draw_legend, legend_width, sequence,
};
use railcrack_run::CrackSummary;
use railcrack_run::representative::RepresentativeTip;
use railcrack_run::study::{PlannedRun, StudyAxis, StudyPlan, StudyRow};

/// Every plot that a study may have.
pub(crate) const STUDY_PLOTS: [&str; 4] = ["ki.svg", "kii.svg", "paths.svg", "length-cycles.svg"];

/// The most values of an axis in the legend: further ones are told by their place in the order of colours.
const LEGEND_VALUES: usize = 12;
/// Dashes of the values of the second axis.
const DASHES: [&str; 4] = ["", "7 4", "2 3", "9 3 2 3"];
/// Letters of a line of the legend.
const LEGEND_LETTERS: f64 = 34.0;
const FRAME: Frame = Frame { left: 76.0, top: HEADING, width: 600.0, height: 380.0 };

/// The plots of a study for the runs that have a step: file name and picture.
pub(crate) fn study_plots(plan: &StudyPlan, rows: &[StudyRow]) -> Vec<(&'static str, String)> {
    let overlay = Overlay::new(plan, rows);
    if overlay.curves.is_empty() {
        return Vec::new();
    }
    let mut plots = vec![
        ("ki.svg", overlay.sif("I", |tip| &tip.history.ki)),
        ("kii.svg", overlay.sif("II", |tip| &tip.history.kii)),
        ("paths.svg", overlay.paths()),
    ];
    if overlay.curves.iter().any(|curve| curve.tip.rows.len() > 1) {
        plots.push(("length-cycles.svg", overlay.lengths()));
    }
    plots
}

/// A run in the picture.
struct Curve<'a> {
    tip: &'a RepresentativeTip,
    cracks: &'a [CrackSummary],
    stroke: Stroke,
}

/// What all pictures of a study have in common.
struct Overlay<'a> {
    plan: &'a StudyPlan,
    curves: Vec<Curve<'a>>,
    legend: Vec<Entry>,
}

impl<'a> Overlay<'a> {
    fn new(plan: &'a StudyPlan, rows: &'a [StudyRow]) -> Self {
        let styles = Styles::new(plan);
        let curve = |(row, run): (&'a StudyRow, &PlannedRun)| {
            let (tip, summary) = (row.representative.as_ref()?, row.summary.as_ref()?);
            Some(Curve { tip, cracks: &summary.cracks, stroke: styles.stroke(run) })
        };
        let curves = rows.iter().zip(&plan.runs).filter_map(curve).collect();
        Self { plan, curves, legend: styles.legend() }
    }

    /// An empty picture around `frame`, with title and legend.
    fn picture(&self, frame: Frame, shows: &[Span], legend: &[Entry]) -> Svg {
        let width = frame.right() + 20.0 + legend_width(legend);
        let height = (frame.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * legend.len() as f64);
        let mut svg = Svg::new(width, height);
        let mut spans = shows.to_vec();
        let (drawn, all) = (self.curves.len(), self.plan.runs.len());
        let of_all = if drawn == all { String::new() } else { format!(" of {all}") };
        spans.push(Span::Plain(format!(" \u{b7} {drawn}{of_all} runs")));
        draw_title(&mut svg, frame.left, width - frame.left, &self.plan.title, &spans);
        draw_legend(&mut svg, [frame.right() + 16.0, frame.top], legend);
        svg
    }

    /// Whose K and length are shown, where a run has several tips.
    fn of_tip(&self) -> &'static str {
        let several = |curve: &Curve| curve.cracks.len() > 1 || curve.tip.first.tip > 1;
        if self.curves.iter().any(several) { ", of each run the tip that grew most" } else { "" }
    }

    fn sif(&self, mode: &'static str, k: fn(&RepresentativeTip) -> &[f64]) -> String {
        let symbol = [Span::Italic("K"), Span::Sub(mode)];
        let mut shows = symbol.to_vec();
        shows.push(Span::Plain(format!(" of the initial cracks{}", self.of_tip())));
        let mut svg = self.picture(FRAME, &shows, &self.legend);
        let positions = || self.curves.iter().flat_map(|curve| curve.tip.history.xc_over_a.iter().copied());
        let (first, last) =
            positions().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let all = self.curves.iter().flat_map(|curve| k(curve.tip).iter().copied());
        let axes =
            Axes { frame: FRAME, x: Axis::exact(first, last, 13), y: Axis::around(all.chain([0.0]), 8) };
        axes.draw_grid(&mut svg);
        axes.clip(&mut svg);
        for curve in &self.curves {
            let values = curve.tip.history.xc_over_a.iter().zip(k(curve.tip));
            let points: Vec<[f64; 2]> = values.map(|(&x, &k)| axes.at(x, k)).collect();
            svg.polyline("series", &points, &curve.stroke);
        }
        svg.unclip();
        let mut y_title = symbol.to_vec();
        y_title.push(Span::plain("  (MPa\u{221a}m)"));
        axes.draw_frame(&mut svg, &wheel_position(), &y_title);
        svg.finish(&format!("K_{mode} of all runs against the wheel position: {}", self.plan.title))
    }

    fn lengths(&self) -> String {
        let shows = [Span::Plain(format!("Crack length{}", self.of_tip()))];
        let mut svg = self.picture(FRAME, &shows, &self.legend);
        let growth = || self.curves.iter().flat_map(|curve| &curve.tip.rows);
        let last = growth().map(|row| row.load_cycles).fold(0.0, f64::max);
        let x = if last > 0.0 { Axis::exact(0.0, 1.04 * last, 8) } else { Axis::exact(-1.0, 1.0, 2) };
        let axes = Axes { frame: FRAME, x, y: Axis::around(growth().map(|row| row.length), 8) };
        axes.draw_grid(&mut svg);
        axes.clip(&mut svg);
        for curve in &self.curves {
            let points: Vec<[f64; 2]> =
                curve.tip.rows.iter().map(|row| axes.at(row.load_cycles, row.length)).collect();
            svg.polyline("series", &points, &curve.stroke);
            // The end of a line that is lost among others.
            if let Some(end) = points.last() {
                svg.dot(*end, 2.6, &curve.stroke.colour);
            }
        }
        svg.unclip();
        axes.draw_frame(
            &mut svg,
            &[Span::plain("Load cycles (axles)")],
            &[Span::plain("Crack length  (mm)")],
        );
        svg.finish(&format!("Crack length of all runs against load cycles: {}", self.plan.title))
    }

    fn paths(&self) -> String {
        let all: Vec<CrackSummary> = self.curves.iter().flat_map(|curve| curve.cracks).cloned().collect();
        let axes = equal_axes(&all);
        let frame = axes.frame;
        let initial = Stroke::solid(INK, 3.2);
        let mut legend = vec![Entry { mark: Mark::Line(initial.clone()), words: "initial crack".to_owned() }];
        legend.extend(self.legend.iter().cloned());
        let mut svg = self.picture(frame, &[Span::plain("Crack paths to scale")], &legend);
        draw_rail(&mut svg, &axes);
        axes.draw_grid(&mut svg);
        axes.clip(&mut svg);
        let at =
            |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|[x, y]| axes.at(*x, -y)).collect() };
        for curve in &self.curves {
            for crack in curve.cracks {
                let grown = at(&crack.points_mm);
                svg.polyline("series", &grown, &curve.stroke);
                if crack.points_mm.len() > crack.initial_points_mm.len()
                    && let Some(tip) = grown.last()
                {
                    svg.dot(*tip, 2.6, &curve.stroke.colour);
                }
            }
        }
        for crack in &all {
            svg.polyline("initial", &at(&crack.initial_points_mm), &initial);
        }
        svg.unclip();
        let [_, surface] = axes.at(0.0, 0.0);
        let line = [[frame.left, surface], [frame.right(), surface]];
        svg.polyline("surface", &line, &Stroke::solid(INK, 2.2));
        axes.draw_frame(&mut svg, &[Span::Italic("x"), Span::plain("  (mm)")], &[Span::plain("Depth  (mm)")]);
        svg.finish(&format!("Crack paths of all runs: {}", self.plan.title))
    }
}

/// Colours and dashes by the values of the axes.
struct Styles<'a> {
    plan: &'a StudyPlan,
    colours: Vec<String>,
    /// The axis whose values have the dashes.
    dashed: Option<usize>,
}

impl<'a> Styles<'a> {
    fn new(plan: &'a StudyPlan) -> Self {
        let few = |(_, axis): &(usize, &StudyAxis)| (2..=DASHES.len()).contains(&axis.len());
        let others = plan.axes.iter().enumerate().filter(|(i, _)| *i != plan.colour_axis);
        Self {
            plan,
            colours: plan.axes.get(plan.colour_axis).map_or_else(Vec::new, colours),
            dashed: others.into_iter().find(few).map(|(i, _)| i),
        }
    }

    fn stroke(&self, run: &PlannedRun) -> Stroke {
        let value = run.choice.get(self.plan.colour_axis).copied().unwrap_or(0);
        let colour = self.colours.get(value).map_or(INK, String::as_str);
        let dashes = self.dashed.and_then(|axis| run.choice.get(axis)).map_or("", |&value| DASHES[value]);
        Stroke { dashes, ..Stroke::solid(colour, 1.8) }
    }

    fn legend(&self) -> Vec<Entry> {
        let heading = |words: String| Entry { mark: Mark::Heading, words: shortened(&words, LEGEND_LETTERS) };
        let mut legend = Vec::new();
        if let Some(axis) = self.plan.axes.get(self.plan.colour_axis) {
            legend.push(heading(axis.name()));
            let shown = axis.len().div_ceil(LEGEND_VALUES).max(1);
            legend.extend((0..axis.len()).step_by(shown).map(|i| Entry {
                mark: Mark::Line(Stroke::solid(&self.colours[i], 1.8)),
                words: shortened(&axis.value(i), LEGEND_LETTERS),
            }));
        }
        for (i, axis) in self.plan.axes.iter().enumerate().filter(|(i, _)| *i != self.plan.colour_axis) {
            if Some(i) == self.dashed {
                legend.push(heading(axis.name()));
                legend.extend((0..axis.len()).map(|value| Entry {
                    mark: Mark::Line(Stroke { dashes: DASHES[value], ..Stroke::solid("#444444", 1.6) }),
                    words: shortened(&axis.value(value), LEGEND_LETTERS),
                }));
            } else if axis.len() > 1 {
                legend.push(heading(format!("a line for each {}", axis.name())));
            }
        }
        legend
    }
}

/// Colours of the values of an axis: of numbers, by their order; of words, distinct ones.
fn colours(axis: &StudyAxis) -> Vec<String> {
    let count = axis.len();
    let place = |rank: usize| sequence(rank as f64 / (count - 1).max(1) as f64);
    match axis.numbers() {
        Some(numbers) => {
            let below = |x: &f64| numbers.iter().filter(|other| *other < x).count();
            numbers.iter().map(|x| place(below(x))).collect()
        }
        None if count <= CATEGORIES.len() => CATEGORIES[..count].iter().map(|&c| c.to_owned()).collect(),
        None => (0..count).map(place).collect(),
    }
}

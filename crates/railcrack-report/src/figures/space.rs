//! Plots of a run in space: K over the passage, ranges along the front, fronts from above, from the
//! side and in their plane, half axes against load cycles.

use super::near::{near, origin};
use super::plot::Plot;
use super::sif::far_chart;
use crate::chart::{
    Chart, ChartAspect, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveDots, CurveLook,
    CurveWidth, LegendEntry, SheetLegend,
};
use crate::shown::ShownRun;
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;
use railcrack_run::histories::History;

/// Points of the front whose histories are drawn, degrees: the last two where the two sides differ.
const DRAWN: [f64; 5] = [90.0, 60.0, 30.0, 120.0, 150.0];
/// Sides whose ranges differ by less of the largest are the same.
const MIRRORED: f64 = 1e-3;
/// Fronts that are drawn, at most.
const FRONTS: usize = 9;

/// The plots of the run with this `summary`, the rows of `growth.csv` and what is `shown`. A run
/// without a finished step has none.
pub(crate) fn space_plots(summary: &Summary, growth: &[TipRow], shown: &ShownRun) -> Vec<Plot> {
    if summary.steps_recorded == 0 {
        return Vec::new();
    }
    let model = "half-space, engine space";
    let mut plots: Vec<Plot> =
        MODES.iter().map(|mode| history_plot(summary, model, growth, shown, mode)).collect();
    plots.push(ranges(summary, model, growth));
    plots.push(fronts(summary, model, growth));
    plots.push(half_axes(summary, model, growth));
    plots
}

/// A mode of fracture: name of its chart, its file, symbol, its values.
struct Mode {
    id: &'static str,
    file: &'static str,
    symbol: &'static str,
    of: fn(&History) -> &[f64],
}

const MODES: [Mode; 3] = [
    Mode { id: "ki", file: "ki.svg", symbol: "K_{I}", of: |history| &history.ki },
    Mode { id: "kii", file: "kii.svg", symbol: "K_{II}", of: |history| &history.kii },
    Mode { id: "kiii", file: "kiii.svg", symbol: "K_{III}", of: |history| &history.kiii },
];

fn rows_of(growth: &[TipRow], step: usize) -> impl Iterator<Item = &TipRow> {
    growth.iter().filter(move |row| row.step == step)
}

/// The points of the front nearest to the drawn angles, as (tip, degrees), each once.
fn drawn_points(growth: &[TipRow]) -> Vec<(usize, f64)> {
    let mut points: Vec<(usize, f64)> = Vec::new();
    let count = if is_mirrored(growth) { 3 } else { DRAWN.len() };
    for wanted in DRAWN.into_iter().take(count) {
        let of = |row: &TipRow| Some((row.tip, row.phi_deg?));
        let nearest = rows_of(growth, 0)
            .filter_map(of)
            .min_by(|a, b| (a.1 - wanted).abs().total_cmp(&(b.1 - wanted).abs()));
        points.extend(nearest.filter(|nearest| points.iter().all(|point| point.0 != nearest.0)));
    }
    points
}

/// Whether both sides of the front are loaded alike.
fn is_mirrored(growth: &[TipRow]) -> bool {
    let ranges: Vec<f64> = rows_of(growth, 0).map(|row| row.delta_keq).collect();
    let largest = ranges.iter().copied().fold(0.0, f64::max);
    ranges.iter().zip(ranges.iter().rev()).all(|(a, b)| (a - b).abs() <= MIRRORED * largest)
}

fn history_plot(summary: &Summary, model: &str, growth: &[TipRow], shown: &ShownRun, mode: &Mode) -> Plot {
    let points = drawn_points(growth);
    let steps = shown.steps();
    let ends: Vec<usize> =
        steps.first().into_iter().chain(steps.last().filter(|_| steps.len() > 1)).copied().collect();
    let (mut curves, mut far) = (Vec::new(), Vec::new());
    for (place, step) in ends.iter().enumerate() {
        for (number, (tip, phi)) in points.iter().enumerate() {
            let Some(history) = shown.histories(*step).iter().find(|history| history.tip == *tip) else {
                continue;
            };
            let values: Vec<[f64; 2]> =
                history.xc_over_a.iter().zip((mode.of)(history)).map(|(&x, &k)| [x, k]).collect();
            let curve = |values: Vec<[f64; 2]>| {
                let curve =
                    Curve::line(&format!("φ = {phi:.0}°"), values).with_colour(CurveColour::Category(number));
                if place == 0 { curve } else { curve.with_look(CurveLook::Dashed) }
            };
            let near = near(summary, &history.xc_over_a);
            if near.len() < values.len() {
                let metres = |x: f64| 1e-3 * (origin(summary) + x * summary.half_width_mm);
                far.push(curve(values.iter().map(|[x, k]| [metres(*x), *k]).collect()));
            }
            curves.push(curve(values[near].to_vec()));
        }
    }
    let words = format!("{} over the stabilised passage at points of the front", mode.symbol);
    let chart = Chart {
        id: mode.id.to_owned(),
        caption: format!("{words}."),
        x: ChartAxis::linear("Wheel position x_{c}/a", "").over(ChartRange::Tight),
        y: ChartAxis::linear(mode.symbol, "MPa√m").over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let mut sheet = ChartSheet::of(&summary.title, &format!("{words} · {model}"), chart);
    if !far.is_empty() {
        let caption = format!("{words}, the whole passage.");
        sheet.rows.push(vec![far_chart(&format!("{}-far", mode.id), mode.symbol, caption, far)]);
    }
    if ends.len() > 1 {
        let last = format!("step {}", ends[1]);
        sheet.legend = SheetLegend::Names(LegendEntry::solid_and_dashed(["initial crack", &last]).to_vec());
    }
    Plot::sheet(mode.file, sheet)
}

/// A quantity of a front point.
type OfRow = fn(&TipRow) -> f64;

/// Ranges along the front in the first step, and dashed in the last.
fn ranges(summary: &Summary, model: &str, growth: &[TipRow]) -> Plot {
    let quantities: [(&str, OfRow); 4] = [
        ("ΔK_{I}", |row| row.delta_ki),
        ("ΔK_{II}", |row| row.delta_kii),
        ("ΔK_{III}", |row| row.delta_kiii.unwrap_or(0.0)),
        ("ΔK_{eq}", |row| row.delta_keq),
    ];
    let last = summary.steps_recorded - 1;
    let ends: Vec<usize> = if last > 0 { vec![0, last] } else { vec![0] };
    let mut curves = Vec::new();
    for &step in &ends {
        for (number, (name, of)) in quantities.iter().enumerate() {
            let points = rows_of(growth, step).filter_map(|row| Some([row.phi_deg?, of(row)])).collect();
            let curve = Curve::line(name, points)
                .with_dots(CurveDots::All)
                .with_colour(CurveColour::Category(number));
            curves.push(if step == 0 { curve } else { curve.with_look(CurveLook::Dashed) });
        }
    }
    let words = "Ranges over the stabilised passage along the front";
    let chart = Chart {
        id: "along-front".to_owned(),
        caption: format!(
            "{words}; φ = 90° is the deepest point. Next to the surface the numbers depend on the cells."
        ),
        x: ChartAxis::linear("φ", "°").over(ChartRange::Tight),
        y: ChartAxis::linear("Range", "MPa√m").over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let mut sheet = ChartSheet::of(&summary.title, &format!("{words} · {model}"), chart);
    if ends.len() > 1 {
        let words = format!("step {last}");
        sheet.legend = SheetLegend::Names(LegendEntry::solid_and_dashed(["initial crack", &words]).to_vec());
    }
    Plot::sheet("along-front.svg", sheet)
}

/// The fronts from above and from the side.
fn fronts(summary: &Summary, model: &str, growth: &[TipRow]) -> Plot {
    let last = summary.steps_recorded - 1;
    let parts = last.clamp(1, FRONTS - 1);
    let mut steps: Vec<usize> = (0..=parts).map(|part| (part * last + parts / 2) / parts).collect();
    steps.dedup();
    let is_closed = growth.iter().any(|row| row.phi_deg.is_some_and(|phi| phi > 180.5));
    let curves = |of: &dyn Fn(&TipRow) -> Option<[f64; 2]>, closes: bool| -> Vec<Curve> {
        let curve = |(place, &step): (usize, &usize)| {
            let mut points: Vec<[f64; 2]> = rows_of(growth, step).filter_map(of).collect();
            let first = points.first().copied().filter(|_| closes && is_closed);
            points.extend(first);
            let (name, colour) = match step {
                0 => ("initial front".to_owned(), CurveColour::Ink),
                step => (format!("step {step}"), CurveColour::Along(place as f64 / steps.len() as f64)),
            };
            let curve = Curve::line(&name, points).with_colour(colour);
            if step == 0 { curve.with_width(CurveWidth::Wide) } else { curve }
        };
        steps.iter().enumerate().map(curve).collect()
    };
    let above = Chart {
        id: "from-above".to_owned(),
        heading: "From above".to_owned(),
        caption: "The front from above, to scale.".to_owned(),
        x: ChartAxis::linear("z, across the rail", "mm"),
        y: ChartAxis::linear("x, along the rail", "mm"),
        curves: curves(&|row| Some([row.lateral?, row.place[0]]), true),
        aspect: ChartAspect::Equal,
        ..Chart::default()
    };
    let side = Chart {
        id: "from-the-front".to_owned(),
        heading: "Along the rail".to_owned(),
        caption: "The front as seen along the rail, to scale.".to_owned(),
        x: ChartAxis::linear("z, across the rail", "mm"),
        y: ChartAxis::depth(),
        curves: curves(&|row| Some([row.lateral?, -row.place[1]]), true),
        aspect: ChartAspect::Equal,
        ..Chart::default()
    };
    let sheet = ChartSheet {
        title: summary.title.clone(),
        subtitle: format!("Fronts to scale, from above and along the rail · {model}"),
        rows: vec![vec![above], vec![side]],
        legend: SheetLegend::default(),
    };
    Plot::sheet("paths.svg", sheet)
}

/// Both half axes against load cycles.
fn half_axes(summary: &Summary, model: &str, growth: &[TipRow]) -> Plot {
    let of = |name: &str, value: fn(&TipRow) -> Option<f64>, colour: usize| {
        let rows = growth.iter().filter(|row| row.tip == 1);
        let points = rows.filter_map(|row| Some([row.load_cycles, value(row)?])).collect();
        Curve::line(name, points).with_dots(CurveDots::All).with_colour(CurveColour::Category(colour))
    };
    let curves = vec![
        of("half axis down the dip", |row| Some(row.length), 0),
        of("half axis along the surface", |row| row.half_length, 1),
    ];
    let caption = "Half axes of the crack against load cycles (axles); a dot for each growth step.";
    let chart = Chart { curves, ..super::cycles::chart(caption, Vec::new()) };
    let subtitle = format!("Half axes of the crack, a dot for each growth step · {model}");
    Plot::sheet("length-cycles.svg", ChartSheet::of(&summary.title, &subtitle, chart))
}

//! Plots of a run in space: K over the passage, ranges along the fronts, fronts from above and
//! along the rail, semi-axes against load cycles.

use super::plot::Plot;
use super::sif::far_chart;
use super::smooth::{LineEnds, smooth};
use super::wheel_passage::{near, origin};
use crate::chart::{
    Chart, ChartAspect, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveDots, CurveLook,
    CurveWidth, SheetLegend,
};
use crate::page_data::PageData;
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::History;

/// Points of the front whose histories are shown, degrees; the last two only if the two sides
/// differ. For several cracks the deepest point of each is shown.
const DRAWN: [f64; 5] = [90.0, 60.0, 30.0, 120.0, 150.0];
/// Relative difference of the ranges below which both sides count as equal.
const MIRRORED: f64 = 1e-3;
/// Maximum number of fronts shown.
const FRONTS: usize = 9;

/// The plots of the run with this `summary`, the rows of `growth.csv` and what is `shown`. A run
/// without a finished step has none.
pub(crate) fn space_plots(summary: &Summary, growth: &[TipRow], page_data: &PageData) -> Vec<Plot> {
    if summary.steps_recorded == 0 {
        return Vec::new();
    }
    let model = "half-space, space engine";
    let mut plots: Vec<Plot> =
        MODES.iter().map(|mode| history_plot(summary, model, growth, page_data, mode)).collect();
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

/// Number of cracks.
fn cracks(growth: &[TipRow]) -> usize {
    growth.iter().map(|row| row.crack).max().unwrap_or(0)
}

/// A point of a front whose history is shown, and its name.
struct Drawn {
    crack: usize,
    tip: usize,
    name: String,
}

/// The points of the front nearest to the angles shown, each once; for several cracks the deepest
/// point of each.
fn drawn_points(growth: &[TipRow]) -> Vec<Drawn> {
    let nearest = |crack: usize, wanted: f64| {
        rows_of(growth, 0)
            .filter(|row| row.crack == crack)
            .filter_map(|row| Some((row.tip, row.phi_deg?)))
            .min_by(|a, b| (a.1 - wanted).abs().total_cmp(&(b.1 - wanted).abs()))
    };
    let count = cracks(growth);
    if count > 1 {
        let deepest = |crack: usize| {
            let (tip, _) = nearest(crack, DRAWN[0])?;
            Some(Drawn { crack, tip, name: format!("crack {crack}") })
        };
        return (1..=count).filter_map(deepest).collect();
    }
    let mut points: Vec<Drawn> = Vec::new();
    let count = if is_mirrored(growth) { 3 } else { DRAWN.len() };
    for wanted in DRAWN.into_iter().take(count) {
        let Some((tip, phi)) = nearest(1, wanted) else { continue };
        if points.iter().all(|point| point.tip != tip) {
            points.push(Drawn { crack: 1, tip, name: format!("φ = {phi:.0}°") });
        }
    }
    points
}

/// Whether both sides of the front have the same loading.
fn is_mirrored(growth: &[TipRow]) -> bool {
    let ranges: Vec<f64> = rows_of(growth, 0).map(|row| row.delta_keq).collect();
    let largest = ranges.iter().copied().fold(0.0, f64::max);
    ranges.iter().zip(ranges.iter().rev()).all(|(a, b)| (a - b).abs() <= MIRRORED * largest)
}

fn history_plot(
    summary: &Summary,
    model: &str,
    growth: &[TipRow],
    page_data: &PageData,
    mode: &Mode,
) -> Plot {
    let points = drawn_points(growth);
    let steps = page_data.steps();
    let ends: Vec<usize> =
        steps.first().into_iter().chain(steps.last().filter(|_| steps.len() > 1)).copied().collect();
    let (mut curves, mut far) = (Vec::new(), Vec::new());
    for (place, step) in ends.iter().enumerate() {
        for (number, Drawn { crack, tip, name }) in points.iter().enumerate() {
            let is_own = |history: &&History| (history.crack, history.tip) == (*crack, *tip);
            let Some(history) = page_data.histories(*step).iter().find(is_own) else { continue };
            let values: Vec<[f64; 2]> =
                history.xc_over_a.iter().zip((mode.of)(history)).map(|(&x, &k)| [x, k]).collect();
            let curve = |values: Vec<[f64; 2]>| {
                let colour = CurveColour::of(number, points.len());
                of_step(place, *step, name, values).with_colour(colour)
            };
            let near = near(summary, &history.xc_over_a);
            if near.len() < values.len() {
                let metres = |x: f64| 1e-3 * (origin(summary) + x * summary.half_width_mm);
                far.push(curve(values.iter().map(|[x, k]| [metres(*x), *k]).collect()));
            }
            curves.push(curve(values[near].to_vec()));
        }
    }
    let where_drawn = if cracks(growth) > 1 { "the deepest points" } else { "points of the front" };
    let words = format!("{} over the stabilised passage at {where_drawn}", mode.symbol);
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
    Plot::sheet(mode.file, sheet)
}

/// A curve of the first step, or a dashed one of the last, which its name then says.
fn of_step(place: usize, step: usize, name: &str, points: Vec<[f64; 2]>) -> Curve {
    if place == 0 {
        return Curve::line(name, points);
    }
    Curve::line(&format!("{name}, step {step}"), points).with_look(CurveLook::Dashed)
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
    let count = cracks(growth);
    let mut curves = Vec::new();
    for (place, &step) in ends.iter().enumerate() {
        let along = |crack: usize, of: OfRow| {
            let own = rows_of(growth, step).filter(move |row| row.crack == crack);
            own.filter_map(move |row| Some([row.phi_deg?, of(row)])).collect()
        };
        if count > 1 {
            let of_crack = |crack: usize| {
                let points = along(crack, |row| row.delta_keq);
                let curve = of_step(place, step, &format!("crack {crack}"), points);
                curve.with_dots(CurveDots::All).with_colour(CurveColour::of(crack - 1, count))
            };
            curves.extend((1..=count).map(of_crack));
        } else {
            let of_range = |(number, (name, of)): (usize, &(&str, OfRow))| {
                let curve = of_step(place, step, name, along(1, *of));
                curve.with_dots(CurveDots::All).with_colour(CurveColour::Category(number))
            };
            curves.extend(quantities.iter().enumerate().map(of_range));
        }
    }
    let words = if count > 1 {
        "ΔK_{eq} over the stabilised passage along the fronts"
    } else {
        "Ranges over the stabilised passage along the front"
    };
    let chart = Chart {
        id: "along-front".to_owned(),
        caption: format!(
            "{words}; φ = 90° is the deepest point. Near the surface the values depend on the discretisation."
        ),
        x: ChartAxis::linear("φ", "°").over(ChartRange::Tight),
        y: ChartAxis::linear("Range", "MPa√m").over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let mut sheet = ChartSheet::of(&summary.title, &format!("{words} · {model}"), chart);
    sheet.rows.extend(shares(growth, &ends).map(|chart| vec![chart]));
    Plot::sheet("along-front.svg", sheet)
}

/// Shares of the wheels of a mix in the growth of the points of the fronts, against their lateral
/// position, in the first of the steps `ends`, and dashed in the last; `None` of a single wheel.
fn shares(growth: &[TipRow], ends: &[usize]) -> Option<Chart> {
    let wheels = growth.first()?.shares.values().len();
    if wheels < 2 {
        return None;
    }
    let mut curves = Vec::new();
    for (place, &step) in ends.iter().enumerate() {
        for wheel in 0..wheels {
            for crack in 1..=cracks(growth) {
                let own = rows_of(growth, step).filter(|row| row.crack == crack);
                let of_row = |row: &TipRow| Some([row.lateral?, 100.0 * row.shares.values().get(wheel)?]);
                // One entry in the legend for all cracks.
                let name = if crack == 1 { format!("wheel {}", wheel + 1) } else { String::new() };
                let mut curve = of_step(place, step, &name, own.filter_map(of_row).collect());
                if crack > 1 {
                    curve.name = String::new();
                }
                curves.push(curve.with_dots(CurveDots::All).with_colour(CurveColour::of(wheel, wheels)));
            }
        }
    }
    Some(Chart {
        id: "wheels-along-front".to_owned(),
        heading: "Wheels of the mix".to_owned(),
        caption: "Shares of the wheels in the growth rate at the points of the front.".to_owned(),
        x: ChartAxis::linear("z, across the rail", "mm").over(ChartRange::Tight),
        y: ChartAxis::linear("Share of the growth", "%").over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    })
}

/// The fronts from above and from the side.
fn fronts(summary: &Summary, model: &str, growth: &[TipRow]) -> Plot {
    let view = |id: &str, heading: &str, caption: &str, [x, y]: [ChartAxis; 2], curves: Vec<Curve>| Chart {
        id: id.to_owned(),
        heading: heading.to_owned(),
        caption: caption.to_owned(),
        x,
        y,
        curves,
        aspect: ChartAspect::Equal,
        ..Chart::default()
    };
    let across = || ChartAxis::linear("z, across the rail", "mm");
    let along = || ChartAxis::linear("x, along the rail", "mm");
    let above = view(
        "from-above",
        "From above",
        "Crack fronts from above, to scale.",
        [across(), along()],
        front_curves(summary, growth, |row| Some([row.lateral?, row.place[0]])),
    );
    let side = view(
        "from-the-front",
        "Along the rail",
        "Crack fronts viewed along the rail, to scale.",
        [across(), ChartAxis::depth()],
        front_curves(summary, growth, |row| Some([row.lateral?, -row.place[1]])),
    );
    let turns =
        |row: &TipRow| row.phi_deg.is_some_and(is_on_strip) || row.turn_deg.is_some_and(|turn| turn != 0.0);
    let from_the_side = growth.iter().any(turns).then(|| {
        view(
            "from-the-side",
            "From the side",
            "Fronts from the side, to scale, of cracks that turn or have a fold.",
            [along(), ChartAxis::depth()],
            front_curves(summary, growth, |row| Some([row.place[0], -row.place[1]])),
        )
    });
    let sheet = ChartSheet {
        title: summary.title.clone(),
        subtitle: format!("Fronts to scale, from above and along the rail · {model}"),
        rows: [above, side].into_iter().chain(from_the_side).map(|chart| vec![chart]).collect(),
        legend: SheetLegend::default(),
    };
    Plot::sheet("paths.svg", sheet)
}

/// The steps whose fronts are drawn.
pub(super) fn front_steps(summary: &Summary) -> Vec<usize> {
    let last = summary.steps_recorded.saturating_sub(1);
    let parts = last.clamp(1, FRONTS - 1);
    let mut steps: Vec<usize> = (0..=parts).map(|part| (part * last + parts / 2) / parts).collect();
    steps.dedup();
    steps
}

/// How the points of the fronts of `crack` are joined by a smooth curve; none of a folded crack,
/// whose front has corners.
pub(crate) fn front_ends(growth: &[TipRow], crack: usize) -> Option<LineEnds> {
    let own = growth.iter().filter(|row| row.crack == crack);
    if own.clone().filter_map(|row| row.phi_deg).any(is_on_strip) {
        return None;
    }
    Some(if has_closed_front(own) { LineEnds::Joined } else { LineEnds::Apart })
}

/// The fronts of all cracks in some of the steps, at the places `of` their points.
fn front_curves(
    summary: &Summary,
    growth: &[TipRow],
    of: impl Fn(&TipRow) -> Option<[f64; 2]>,
) -> Vec<Curve> {
    let steps = front_steps(summary);
    let curve = |place: usize, crack: usize| {
        let step = steps[place];
        let rows = rows_of(growth, step).filter(|row| row.crack == crack);
        let points: Vec<[f64; 2]> = rows.filter_map(&of).collect();
        let points = match front_ends(growth, crack) {
            Some(ends) => smooth(&points, ends),
            None => points,
        };
        let (name, colour) = match step {
            0 => ("initial front".to_owned(), CurveColour::Ink),
            step => (format!("step {step}"), CurveColour::Along(place as f64 / steps.len() as f64)),
        };
        // One entry in the legend for all cracks.
        let name = if crack == 1 { name } else { String::new() };
        let curve = Curve::line(&name, points).with_colour(colour);
        if step == 0 { curve.with_width(CurveWidth::Wide) } else { curve }
    };
    let of_step = |place: usize| (1..=cracks(growth)).map(move |crack| (place, crack));
    (0..steps.len()).flat_map(of_step).map(|(place, crack)| curve(place, crack)).collect()
}

/// Whether the front point at φ (degrees) lies on the side of the strip of a folded crack where ζ
/// is positive.
fn is_on_strip(phi: f64) -> bool {
    phi < 0.0
}

/// Whether a front among `rows` is closed: that of a buried crack, without sides of a strip.
pub(crate) fn has_closed_front<'a>(rows: impl Iterator<Item = &'a TipRow> + Clone) -> bool {
    let angles = rows.filter_map(|row| row.phi_deg);
    angles.clone().any(|phi| phi > 180.5) && !angles.clone().any(is_on_strip)
}

/// Both semi-axes against load cycles.
fn half_axes(summary: &Summary, model: &str, growth: &[TipRow]) -> Plot {
    let of = |name: &str, crack: usize, value: fn(&TipRow) -> Option<f64>| {
        let rows = growth.iter().filter(move |row| row.crack == crack && row.tip == 1);
        let points = rows.filter_map(|row| Some([row.load_cycles, value(row)?])).collect();
        Curve::line(name, points).with_dots(CurveDots::All)
    };
    let down: fn(&TipRow) -> Option<f64> = |row| Some(row.length);
    let along: fn(&TipRow) -> Option<f64> = |row| row.half_length;
    let count = cracks(growth);
    let is_folded = growth.iter().filter_map(|row| row.phi_deg).any(is_on_strip);
    let curves = match count {
        0 | 1 => vec![
            of(if is_folded { "length over the fold" } else { "semi-axis down the dip" }, 1, down)
                .with_colour(CurveColour::Category(0)),
            of("semi-axis along the surface", 1, along).with_colour(CurveColour::Category(1)),
        ],
        count => (1..=count)
            .flat_map(|crack| {
                let colour = CurveColour::of(crack - 1, count);
                let [down, along] =
                    [("down the dip", down), ("along the surface", along)].map(|(axis, value)| {
                        of(&format!("crack {crack}, {axis}"), crack, value).with_colour(colour)
                    });
                [down, along.with_look(CurveLook::Dashed)]
            })
            .collect(),
    };
    let caption = "Semi-axes of the cracks against load cycles (axles); dots mark the growth steps.";
    let chart = Chart { curves, ..super::paths::lengths_chart(caption, Vec::new()) };
    let subtitle = format!("Semi-axes of the cracks, dots mark the growth steps · {model}");
    Plot::sheet("length-cycles.svg", ChartSheet::of(&summary.title, &subtitle, chart))
}

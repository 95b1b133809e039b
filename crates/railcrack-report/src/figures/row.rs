//! Charts of many cracks: by position along the rail, and all in grey with a few highlighted ones
//! above them.

use super::plot::Plot;
use crate::chart::{
    Chart, ChartAspect, ChartAxis, ChartNote, ChartRange, ChartScale, ChartSheet, Curve, CurveColour,
    CurveDots, CurveLook, CurveWidth, LegendEntry, SheetLegend,
};
use crate::row::{CrackRow, CrackState, NamedCrack};
use crate::svg::ends;
use railcrack_run::Summary;

/// The largest growth of a crack of the row, mm, with a lower bound if none grows.
pub(super) fn most_growth(row: &CrackRow) -> f64 {
    row.cracks.iter().map(|crack| crack.growth()).fold(1e-6, f64::max)
}

/// The plot `row.svg`.
pub(super) fn plot(summary: &Summary, row: &CrackRow, named: &[NamedCrack], model: &str) -> Plot {
    let of = |id: &str, words: &str, y: ChartAxis, value: fn(&CrackState) -> f64| -> Chart {
        let mut chart = Chart {
            id: id.to_owned(),
            caption: format!("{words} of the cracks by position along the rail."),
            x: ChartAxis::linear("Position of the mouth along the rail", "mm"),
            y: y.clone().over(room(row, y.scale, value)),
            curves: curves(row, value),
            aspect: ChartAspect::Long,
            ..Chart::default()
        };
        let note = |named: &NamedCrack| {
            let crack = row.cracks.get(named.crack - 1)?;
            let at = value(crack.last()).max(value(crack.first()));
            Some(ChartNote { at: [crack.mouth, at], words: named.crack.to_string() })
        };
        chart.notes = named.iter().filter_map(note).collect();
        chart
    };
    let rows = vec![
        vec![of("row-length", "Length", ChartAxis::linear("Length", "mm"), |state| state.length)],
        vec![of("row-keq", "ΔK_{eq}", ChartAxis::linear("ΔK_{eq}", "MPa√m"), |state| state.delta_keq)],
        vec![of("row-rate", "Growth rate", ChartAxis::logarithmic("da/dN", "mm/cycle"), |state| state.rate)],
    ];
    let last = row.steps.last().copied().unwrap_or(0);
    let mut entries = vec![LegendEntry::curve("step 0", CurveLook::Dots, CurveColour::Quiet)];
    if last > 0 {
        entries.extend(colour_bar(&format!("Step {last}, by growth (mm)"), most_growth(row)));
    }
    if !named.is_empty() {
        entries.push(LegendEntry::heading("Numbered cracks"));
        entries.extend(
            named.iter().map(|named| LegendEntry::note(&format!("{}: {}", named.crack, named.words))),
        );
    }
    let sheet = ChartSheet {
        title: summary.title.clone(),
        subtitle: format!("{} cracks in step 0 and in step {last} · {model}", row.cracks.len()),
        rows,
        legend: SheetLegend::Entries(entries),
    };
    Plot::sheet("row.svg", sheet)
}

/// The range of a quantity on an axis of `scale`, with room for numbers above.
fn room(row: &CrackRow, scale: ChartScale, value: fn(&CrackState) -> f64) -> ChartRange {
    let is_logarithmic = scale == ChartScale::Logarithmic;
    let values = row.cracks.iter().flat_map(|crack| [crack.first(), crack.last()].map(value));
    let values = values.filter(|&value| !is_logarithmic || value > 0.0);
    let [low, high] = ends(values.map(|value| if is_logarithmic { value.ln() } else { value }));
    let span = (high - low).max(1e-3 * high.abs()).max(1e-9);
    let [low, high] = [low - 0.06 * span, high + 0.14 * span];
    ChartRange::Exact(if is_logarithmic { [low.exp(), high.exp()] } else { [low, high] })
}

/// For each crack a dot for its first state, a dot for its last state in the colour of its growth,
/// and a line between them.
fn curves(row: &CrackRow, value: fn(&CrackState) -> f64) -> Vec<Curve> {
    let most = most_growth(row);
    let mut curves = Vec::new();
    for crack in &row.cracks {
        let [from, to] = [crack.first(), crack.last()].map(|state| [crack.mouth, value(state)]);
        let colour = CurveColour::Along(crack.growth() / most);
        let first = Curve::line("", vec![from]).with_look(CurveLook::Dots).with_colour(CurveColour::Quiet);
        if row.steps.len() > 1 {
            let way = Curve::line("", vec![from, to]).with_colour(colour).with_width(CurveWidth::Usual);
            let last = Curve::line("", vec![to]).with_look(CurveLook::Dots).with_colour(colour);
            curves.extend([way, first, last]);
        } else {
            curves.push(first);
        }
    }
    curves
}

/// Maximum number of grey curves; of more, evenly spaced ones are chosen.
const BUNDLE: usize = 150;
/// Name of the grey curves in a legend.
const OTHERS: &str = "other cracks";
/// Steps of a colour bar.
const BAR: usize = 5;

/// The `curves` of cracks by number, named after their crack or tip: the `named` cracks in colour,
/// above the others, which are thin and grey. The note of a curve is its crack.
pub(crate) fn bundle(named: &[NamedCrack], curves: Vec<(usize, Curve)>) -> Vec<Curve> {
    let (coloured, others): (Vec<_>, Vec<_>) =
        curves.into_iter().partition(|(crack, _)| named.iter().any(|named| named.crack == *crack));
    let every = others.len().div_ceil(BUNDLE).max(1);
    let quiet = others.into_iter().step_by(every).map(|(_, curve)| Curve {
        note: curve.name,
        name: OTHERS.to_owned(),
        colour: Some(CurveColour::Quiet),
        width: CurveWidth::Fine,
        dots: CurveDots::None,
        look: CurveLook::Line,
        ..curve
    });
    let mut drawn: Vec<Curve> = quiet.collect();
    for (place, named) in named.iter().enumerate() {
        let own = coloured.iter().filter(|(crack, _)| *crack == named.crack).map(|(_, curve)| Curve {
            note: curve.name.clone(),
            name: named.title(),
            colour: Some(CurveColour::Category(place)),
            ..curve.clone()
        });
        drawn.extend(own);
    }
    drawn
}

/// A legend of colours from 0 to `most` of a quantity, with round values, the largest first.
pub(super) fn colour_bar(heading: &str, most: f64) -> Vec<LegendEntry> {
    let step = crate::svg::round_step(most, BAR);
    let decimals = crate::svg::decimals_of(step);
    let count = (most / step + 1e-9).floor() as usize;
    let entry = |k: usize| {
        let value = k as f64 * step;
        let look = CurveLook::Line;
        LegendEntry::curve(&format!("{value:.decimals$}"), look, CurveColour::Along(value / most))
    };
    let mut entries = vec![LegendEntry::heading(heading)];
    entries.extend((0..=count).rev().map(entry));
    entries
}

//! The SVG files of the figures: the main set-ups, both bodies and both ways of travel.

use super::charts::{Quantity, TableCurve, cracks, drawn};
use super::tables::DIGITISED;
use crate::figure::{Figure, Kind};
use crate::setup::SETUPS;
use crate::verdict::MAIN;
use railcrack_report::{
    Chart, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, CurveWidth, LegendEntry, SheetLegend,
};

/// Points of an initial crack: all are straight.
const INITIAL_POINTS: usize = 2;
/// Cracks of a run in the block whose K leaves the other curves readable.
const FEW_CRACKS: usize = 2;
/// Colours of things without order.
const COLOURS: usize = 9;
/// Length over depth of paths that are shown one below the other.
const LONG: f64 = 5.0;

/// The sheet of `figure` from the curves of its quantities.
pub(crate) fn sheet(figure: &Figure, quantities: &[(Quantity, Vec<TableCurve>)]) -> ChartSheet {
    let rows = match figure.kind {
        Kind::Sif => quantities.iter().map(|(quantity, curves)| sif_row(figure, *quantity, curves)).collect(),
        Kind::Paths => {
            let all = quantities.iter().flat_map(|(quantity, curves)| path_panels(figure, *quantity, curves));
            let panels: Vec<Chart> = all.collect();
            // Long rows of cracks need the whole width for their growth to be visible.
            let columns = if panels.iter().any(is_long) { 1 } else { 2 };
            panels.chunks(columns).map(<[Chart]>::to_vec).collect()
        }
        Kind::Profile => {
            quantities.iter().map(|(quantity, curves)| vec![profiles(figure, *quantity, curves)]).collect()
        }
    };
    let mut sheet = ChartSheet {
        title: format!("Trollé et al. (2014), Fig. {}, recomputed", figure.number),
        subtitle: figure.title.to_owned(),
        rows,
        legend: SheetLegend::default(),
    };
    if figure.kind == Kind::Sif {
        let bodies = LegendEntry::solid_and_dashed(["half-plane", "block, bottom clamped"]);
        sheet.legend = SheetLegend::Names(bodies.into());
    }
    sheet
}

/// Whether a panel of paths is much longer than deep.
fn is_long(panel: &Chart) -> bool {
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let extent = |c: usize| {
        let ends = points()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[c]), high.max(p[c])]);
        ends[1] - ends[0]
    };
    extent(0) > LONG * extent(1)
}

/// K for cracks that lean along the travel and against it: half-plane solid, block dashed.
fn sif_row(figure: &Figure, quantity: Quantity, curves: &[TableCurve]) -> Vec<Chart> {
    let column = |(way, words): (&str, &str)| {
        let [half_plane, block] = ["half-plane", "block"].map(|body| format!("{body}, {way}"));
        let is_block = move |curve: &TableCurve| curve.setup == block;
        let is_shown = |curve: &TableCurve| {
            curve.setup == DIGITISED
                || curve.setup == half_plane
                || is_block(curve) && cracks(curves, &curve.name) <= FEW_CRACKS
        };
        let look = |(table, curve): (&TableCurve, Curve)| {
            if is_block(table) { curve.with_look(CurveLook::Dashed) } else { curve }
        };
        let curves = drawn(figure, curves, is_shown).map(look).collect();
        let heading =
            if quantity == Quantity::Ki { format!("Cracks lean {words} the travel") } else { String::new() };
        Chart { heading, curves, ..quantity.chart(figure) }
    };
    [("along", "along"), ("against", "against")].map(column).into()
}

/// The paths in each main set-up that has any.
fn path_panels(figure: &Figure, quantity: Quantity, curves: &[TableCurve]) -> Vec<Chart> {
    let mut names: Vec<&str> = Vec::new();
    for curve in curves.iter().filter(|curve| curve.setup != DIGITISED) {
        if !names.contains(&curve.name.as_str()) {
            names.push(&curve.name);
        }
    }
    let is_crowded = names.iter().map(|name| cracks(curves, name)).sum::<usize>() > COLOURS;
    let panel = |name: &'static str| {
        let paths = drawn(figure, curves, move |curve| curve.setup == name || curve.setup == DIGITISED);
        let dotted = |(table, curve): (&TableCurve, Curve)| {
            let curve = curve.with_dots(CurveDots::AllBut(0..INITIAL_POINTS));
            match names.iter().position(|name| *name == table.name) {
                Some(place) if is_crowded && table.setup != DIGITISED => {
                    by_curve(figure, table, curve, place)
                }
                _ => curve,
            }
        };
        let paths: Vec<Curve> = paths.map(dotted).collect();
        let is_ours = |path: &&Curve| path.look != CurveLook::Dots;
        let initial = |path: &Curve| {
            let points = path.points.iter().take(INITIAL_POINTS).copied().collect();
            Curve::line("initial crack", points).with_colour(CurveColour::Ink).with_width(CurveWidth::Wide)
        };
        let initial: Vec<Curve> = paths.iter().filter(is_ours).map(initial).collect();
        let body = name.split(',').next().unwrap_or(name);
        let side = if name.ends_with("against") { "left" } else { "right" };
        Chart {
            heading: format!("{body}: wheel rolls to the {side}"),
            curves: paths.into_iter().chain(initial).collect(),
            ..quantity.chart(figure)
        }
    };
    let panels = SETUPS[..MAIN].iter().map(|setup| panel(setup.name));
    panels.filter(|chart| chart.curves.iter().any(|curve| curve.look != CurveLook::Dots)).collect()
}

/// A path among more paths than colours: all paths of a curve of the paper have the same colour,
/// and the first curve is visible below the others.
fn by_curve(figure: &Figure, table: &TableCurve, curve: Curve, place: usize) -> Curve {
    let width = if place == 0 { CurveWidth::Wide } else { CurveWidth::Usual };
    let colour = Some(CurveColour::Category(place));
    Curve { name: figure.words(&table.name).to_owned(), colour, width, ..curve }
}

/// The readings of Fig. 21 solid, rolled rails dashed.
fn profiles(figure: &Figure, quantity: Quantity, curves: &[TableCurve]) -> Chart {
    let look = |(table, curve): (&TableCurve, Curve)| {
        if table.name.starts_with("rolled") { curve.with_look(CurveLook::Dashed) } else { curve }
    };
    Chart { curves: drawn(figure, curves, |_| true).map(look).collect(), ..quantity.chart(figure) }
}

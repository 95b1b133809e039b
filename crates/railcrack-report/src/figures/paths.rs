//! Crack growth: paths to scale, lengths against load cycles.

use super::plot::Plot;
use super::row::{bundle, colour_bar, most_growth};
use crate::chart::{
    Chart, ChartArea, ChartAspect, ChartAxis, ChartNote, ChartRange, ChartSheet, Curve, CurveColour,
    CurveDots, CurveLook, CurveWidth, LegendEntry, LegendMark, SheetLegend,
};
use crate::row::{CrackRow, NamedCrack};
use crate::svg::ends;
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use railcrack_run::{CrackSummary, PieceSummary, Summary};

/// Maximum number of crack labels on a chart; of more, evenly spaced ones are chosen.
const NUMBERS: usize = 20;
/// Approximate number of cracks per strip.
const STRIP: usize = 25;
/// Smallest distance of a label from the ends of a strip, as a fraction of its length.
const EDGE: f64 = 0.013;

/// Points (x, depth) of points (x, y).
pub(super) fn by_depth(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|&[x, y]| [x, -y]).collect()
}

/// The path of `crack`; the caller sets name and appearance.
pub(super) fn path(name: &str, crack: &CrackSummary) -> Curve {
    Curve::line(name, by_depth(whole(crack)))
}

/// The whole path of `crack`, in the coordinates of the initial surface.
pub(super) fn whole(crack: &CrackSummary) -> &[[f64; 2]] {
    crack.path_mm.as_deref().unwrap_or(&crack.points_mm)
}

/// Dots at the ends of the increments of `crack`.
pub(super) fn increments(crack: &CrackSummary) -> CurveDots {
    let initial = &crack.initial_points_mm;
    let from = whole(crack).iter().position(|point| initial.contains(point)).unwrap_or(0);
    CurveDots::AllBut(from..from + initial.len())
}

/// A chart of paths with the initial `cracks` above them.
pub(super) fn chart<'a>(
    caption: &str,
    mut curves: Vec<Curve>,
    cracks: impl Iterator<Item = &'a CrackSummary>,
) -> Chart {
    curves.extend(cracks.map(|crack| {
        Curve::line("initial crack", by_depth(&crack.initial_points_mm))
            .with_colour(CurveColour::Ink)
            .with_width(CurveWidth::Wide)
    }));
    Chart {
        id: "paths".to_owned(),
        caption: caption.to_owned(),
        x: ChartAxis::linear("x", "mm"),
        y: ChartAxis::depth(),
        curves,
        aspect: ChartAspect::Equal,
        ..Chart::default()
    }
}

fn area(piece: &PieceSummary) -> ChartArea {
    ChartArea {
        name: format!("{}, {:.3} mm²", piece.kind.word(), piece.area_mm2),
        outline: by_depth(&piece.outline_mm),
    }
}

/// The paths of a run on the model `model`, with the pieces of rail that they enclose.
pub(super) fn plot(summary: &Summary, model: &str) -> Plot {
    let cracks = &summary.cracks;
    let curve = |(i, crack): (usize, &CrackSummary)| {
        let grown = whole(crack) != crack.initial_points_mm.as_slice();
        let name = match cracks.len() {
            _ if !grown => String::new(),
            1 => format!("growth, {} increments", summary.steps),
            _ => format!("crack {}", i + 1),
        };
        path(&name, crack).with_dots(increments(crack)).with_colour(CurveColour::of(i, cracks.len()))
    };
    let curves = cracks.iter().enumerate().map(curve).collect();
    let mut chart = chart("Crack paths to scale.", curves, cracks.iter());
    chart.areas.extend(summary.pieces.iter().map(area));
    if cracks.len() > 1 {
        let every = cracks.len().div_ceil(NUMBERS);
        let mouths = cracks.iter().enumerate().step_by(every);
        chart.notes.extend(mouths.filter_map(|(i, crack)| {
            let [x, _] = *crack.initial_points_mm.first()?;
            Some(ChartNote { at: [x, 0.0], words: (i + 1).to_string() })
        }));
    }
    let subtitle = format!("Crack paths to scale, dots mark the ends of the increments · {model}");
    Plot::sheet("paths.svg", ChartSheet::of(&summary.title, &subtitle, chart))
}

/// The paths of the many cracks of `row` in strips, one below the other at the same scale, coloured
/// by growth.
pub(super) fn strips(summary: &Summary, row: &CrackRow, model: &str) -> Plot {
    let cracks = &summary.cracks;
    let [left, right] = ends(cracks.iter().flat_map(whole).map(|point| point[0]));
    let air = 0.01 * (right - left).max(1e-3);
    let (left, right) = (left - air, right + air);
    let count = cracks.len().div_ceil(STRIP);
    let length = (right - left) / count as f64;
    let most = most_growth(row);
    let strip = |place: usize| {
        let from = left + place as f64 * length;
        let is_there = |points: &[[f64; 2]]| {
            let [first, last] = ends(points.iter().map(|point| point[0]));
            first <= from + length && last >= from
        };
        let there: Vec<usize> = (0..cracks.len()).filter(|&i| is_there(whole(&cracks[i]))).collect();
        let curve = |&i: &usize| {
            let growth = row.cracks.get(i).map_or(0.0, |crack| crack.growth());
            path("", &cracks[i])
                .with_dots(increments(&cracks[i]))
                .with_colour(CurveColour::Along(growth / most))
        };
        let mut chart = chart("", there.iter().map(curve).collect(), there.iter().map(|&i| &cracks[i]));
        chart.areas.extend(summary.pieces.iter().filter(|piece| is_there(&piece.outline_mm)).map(area));
        let mouths = there.iter().filter_map(|&i| Some((i, cracks[i].initial_points_mm.first()?[0])));
        let inside = mouths.filter(|(_, x)| (from..from + length).contains(x));
        // A label at an end of the strip is moved inside.
        let within = |x: f64| x.clamp(from + EDGE * length, from + (1.0 - EDGE) * length);
        let note = |(i, x): (usize, f64)| ChartNote { at: [within(x), 0.0], words: (i + 1).to_string() };
        chart.notes.extend(inside.map(note));
        Chart { x: chart.x.clone().over(ChartRange::Exact([from, from + length])), ..chart }
    };
    let colour = CurveColour::Ink;
    let initial =
        LegendMark::Curve { look: CurveLook::Line, dots: CurveDots::None, width: CurveWidth::Wide, colour };
    let mut entries = vec![LegendEntry { mark: initial, words: "initial crack".to_owned() }];
    if row.steps.len() > 1 {
        entries.extend(colour_bar("Growth (mm)", most));
    }
    if !summary.pieces.is_empty() {
        entries.push(LegendEntry { mark: LegendMark::Area, words: "detached piece".to_owned() });
    }
    let subtitle =
        format!("Paths of {} cracks to scale, dots mark the ends of the increments · {model}", cracks.len());
    let sheet = ChartSheet {
        title: summary.title.clone(),
        subtitle,
        rows: (0..count).map(|place| vec![strip(place)]).collect(),
        legend: SheetLegend::Entries(entries),
    };
    Plot::sheet("paths.svg", sheet)
}

/// A chart of lengths.
pub(super) fn lengths_chart(caption: &str, curves: Vec<Curve>) -> Chart {
    Chart {
        id: "length-cycles".to_owned(),
        caption: caption.to_owned(),
        x: ChartAxis::linear("Load cycles", "axles"),
        y: ChartAxis::linear("Crack length", "mm"),
        curves,
        ..Chart::default()
    }
}

/// The lengths in a run on the model `model`; for many cracks the `named` ones are highlighted.
pub(super) fn lengths(
    summary: &Summary,
    growth: &[TipRow],
    named: Option<&[NamedCrack]>,
    model: &str,
) -> Plot {
    // Both tips of a buried crack have the same length, so the first represents the crack.
    let cracks: Vec<usize> =
        growth.iter().filter(|row| row.step == 0 && row.tip == 1).map(|row| row.crack).collect();
    let curve = |(place, &crack): (usize, &usize)| {
        let rows = growth.iter().filter(|row| row.crack == crack && row.tip == 1);
        let name = if cracks.len() > 1 { format!("crack {crack}") } else { String::new() };
        Curve::line(&name, rows.map(|row| [row.load_cycles, row.length]).collect())
            .with_dots(CurveDots::All)
            .with_colour(CurveColour::of(place, cracks.len()))
    };
    let curves: Vec<Curve> = cracks.iter().enumerate().map(curve).collect();
    let curves = match named {
        Some(named) => bundle(named, cracks.into_iter().zip(curves).collect()),
        None => curves,
    };
    let caption = "Crack length against load cycles (axles); dots mark the growth steps.";
    let subtitle = format!("Crack length, dots mark the growth steps · {model}");
    Plot::sheet(
        "length-cycles.svg",
        ChartSheet::of(&summary.title, &subtitle, lengths_chart(caption, curves)),
    )
}

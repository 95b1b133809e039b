//! Crack paths to scale.

use super::plot::Plot;
use crate::chart::{
    Chart, ChartArea, ChartAspect, ChartAxis, ChartNote, ChartSheet, Curve, CurveColour, CurveDots,
    CurveWidth,
};
use railcrack::words::Choice;
use railcrack_run::{CrackSummary, Summary};

/// Numbers of cracks on a chart; of more, evenly chosen ones.
const NUMBERS: usize = 20;

/// Points (x, depth) of points (x, y).
pub(super) fn by_depth(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|&[x, y]| [x, -y]).collect()
}

/// The path of `crack`: `name` and other looks are given afterwards.
pub(super) fn path(name: &str, crack: &CrackSummary) -> Curve {
    Curve::line(name, by_depth(whole(crack)))
}

/// The whole path of `crack`, in the coordinates of the surface that it began at.
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

/// The paths of a run on the model `model`, with the pieces of rail that they enclose.
pub(super) fn plot(summary: &Summary, model: &str) -> Plot {
    let cracks = &summary.cracks;
    let curve = |(i, crack): (usize, &CrackSummary)| {
        let grown = whole(crack).len() > crack.initial_points_mm.len();
        let name = match cracks.len() {
            _ if !grown => String::new(),
            1 => format!("growth, {} increments", summary.steps),
            _ => format!("crack {}", i + 1),
        };
        path(&name, crack).with_dots(increments(crack)).with_colour(CurveColour::of(i, cracks.len()))
    };
    let curves = cracks.iter().enumerate().map(curve).collect();
    let mut chart = chart("Crack paths to scale.", curves, cracks.iter());
    chart.areas.extend(summary.pieces.iter().map(|piece| ChartArea {
        name: format!("{}, {:.3} mm²", piece.kind.word(), piece.area_mm2),
        outline: by_depth(&piece.outline_mm),
    }));
    if cracks.len() > 1 {
        let every = cracks.len().div_ceil(NUMBERS);
        let mouths = cracks.iter().enumerate().step_by(every);
        chart.notes.extend(mouths.filter_map(|(i, crack)| {
            let [x, _] = *crack.initial_points_mm.first()?;
            Some(ChartNote { at: [x, 0.0], words: (i + 1).to_string() })
        }));
    }
    let subtitle = format!("Crack paths to scale, a dot at the end of each increment · {model}");
    Plot::sheet("paths.svg", ChartSheet::of(&summary.title, &subtitle, chart))
}

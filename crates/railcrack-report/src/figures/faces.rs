//! The face map: wheel position × arc length, status and pressure.

use super::cells::{CellMap, level_colour, level_words};
use crate::chart::{HEADING, draw_heading};
use crate::page_data::CrackFaces;
use crate::svg::{
    Anchor, Axes, Axis, BLUE, Entry, Frame, INK, Mark, ORANGE, Svg, TextStyle, draw_legend, legend_width,
    quantity, round_step, text,
};
use railcrack::contact::FaceStatus;
use std::ops::Range;

/// Maximum number of cracks in one picture.
const SHOWN_CRACKS: usize = 9;
/// Maximum number of pressure classes.
const LEVELS: usize = 8;
const OPEN: &str = "#f0f0f0";

/// The faces of all cracks in one step.
pub(super) struct FaceMap<'a> {
    pub step: usize,
    /// x_c/a by position.
    pub xc_over_a: &'a [f64],
    /// The positions shown.
    pub near: Range<usize>,
    /// Number of cracks in the rail.
    pub of: usize,
    pub cracks: Vec<CrackMap<'a>>,
}

/// The faces of one crack.
pub(super) struct CrackMap<'a> {
    /// Length of the crack, mm.
    pub length: f64,
    pub faces: &'a CrackFaces,
}

/// The picture of `map` for the run called `title` on the model `model`.
pub(super) fn face_map(title: &str, model: &str, map: &FaceMap) -> String {
    let shown = &map.cracks[..map.cracks.len().min(SHOWN_CRACKS)];
    let row_height = (560.0 / shown.len().max(1) as f64).clamp(90.0, 260.0);
    let step = pressure_step(shown);
    let legend = legend(step, shown);
    let (left, panel, gap) = (72.0, 420.0, 44.0);
    let right = left + 2.0 * panel + gap;
    let width = right + 18.0 + legend_width(&legend);
    let bottom = HEADING + 20.0 + shown.len() as f64 * (row_height + 14.0) - 14.0;
    let mut svg = Svg::new(width, bottom + 56.0);
    let some = if shown.len() < map.of {
        let numbers: Vec<String> = shown.iter().map(|crack| crack.faces.crack.to_string()).collect();
        format!(" (cracks {} of {})", numbers.join(", "), map.of)
    } else {
        String::new()
    };
    let subtitle = format!("Crack faces, step {}{some} · {model}", map.step);
    draw_heading(&mut svg, left, width - left, title, &subtitle);
    let cells = borders(map.xc_over_a, None);
    let (first, last) = match (cells.get(map.near.start), cells.get(map.near.end)) {
        (Some(&a), Some(&b)) => (a.min(b), a.max(b)),
        _ => (0.0, 0.0),
    };
    for (row, crack) in shown.iter().enumerate() {
        let top = HEADING + 20.0 + row as f64 * (row_height + 14.0);
        for column in [Column::Status, Column::Pressure] {
            let beside = if column == Column::Status { 0.0 } else { panel + gap };
            let frame = Frame { left: left + beside, top, width: panel, height: row_height };
            let y_ticks = (row_height / 36.0) as usize + 1;
            let axes = Axes {
                frame,
                x: Axis::exact(first, last, 8),
                y: Axis::exact(0.0, crack.length.max(f64::MIN_POSITIVE), y_ticks),
            };
            draw_cells(&mut svg, &axes, &cells, crack, &map.near, column, step);
            let x_title = quantity(if row + 1 == shown.len() { "Wheel position x_{c}/a" } else { "" });
            axes.draw_frame(&mut svg, &x_title, &[]);
            if row == 0 {
                draw_column_title(&mut svg, frame, column);
            }
            if shown.len() > 1 {
                axes.note(&mut svg, &format!("crack {}", crack.faces.crack));
            }
        }
    }
    let arc = quantity("Arc length s (mm)");
    let style = TextStyle { size: 13.0, anchor: Anchor::Upwards, colour: INK, weight: "normal" };
    svg.text([left - 36.0, 0.5 * (HEADING + 20.0 + bottom)], &arc, style);
    draw_legend(&mut svg, [right + 14.0, HEADING + 20.0], &legend);
    svg.finish(&format!("Crack faces in step {}: {title}", map.step))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Status,
    Pressure,
}

fn draw_column_title(svg: &mut Svg, frame: Frame, column: Column) {
    let words = match column {
        Column::Status => "Status",
        Column::Pressure => "Contact pressure",
    };
    let style = TextStyle { size: 12.5, anchor: Anchor::Start, colour: INK, weight: "bold" };
    svg.text([frame.left, frame.top - 7.0], &text(words), style);
}

/// One class of cells: 0 is an open face in either column.
fn class(state: (FaceStatus, f64), column: Column, step: f64) -> usize {
    match (column, state.0) {
        (_, FaceStatus::Open) => 0,
        (Column::Status, FaceStatus::Stick) => 1,
        (Column::Status, FaceStatus::Slip) => 2,
        (Column::Pressure, _) => 1 + ((state.1.max(0.0) / step) as usize).min(LEVELS - 1),
    }
}

fn colour(class: usize, column: Column) -> String {
    match (column, class) {
        (_, 0) => OPEN.to_owned(),
        (Column::Status, 1) => BLUE.to_owned(),
        (Column::Status, _) => ORANGE.to_owned(),
        (Column::Pressure, level) => level_colour(level - 1, LEVELS - 1),
    }
}

fn draw_cells(
    svg: &mut Svg,
    axes: &Axes,
    cells: &[f64],
    crack: &CrackMap,
    near: &Range<usize>,
    column: Column,
    step: f64,
) {
    let faces = crack.faces;
    let map = CellMap {
        axes,
        columns: cells,
        shown: near.start..faces.positions().min(cells.len().saturating_sub(1)).min(near.end),
        rows: &borders(&faces.s, Some((0.0, crack.length))),
        classes: LEVELS + 1,
    };
    let class = |position: usize, point: usize| class(faces.state(position, point), column, step);
    map.draw(svg, class, |class| colour(class, column));
}

/// Borders of the cells around `centres`: halfway between neighbours; the outer ones at `ends`, or
/// at the same distance as the nearest inner border.
fn borders(centres: &[f64], ends: Option<(f64, f64)>) -> Vec<f64> {
    let n = centres.len();
    if n == 0 {
        return Vec::new();
    }
    let mut borders = Vec::with_capacity(n + 1);
    let half = |i: usize| if n > 1 { 0.5 * (centres[i + 1] - centres[i]) } else { 0.5 };
    borders.push(ends.map_or(centres[0] - half(0), |(start, _)| start));
    borders.extend(centres.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    borders.push(ends.map_or(centres[n - 1] + half(n.saturating_sub(2)), |(_, end)| end));
    borders
}

/// A round step of pressure with at most [`LEVELS`] classes, MPa.
fn pressure_step(cracks: &[CrackMap]) -> f64 {
    let most = states(cracks).map(|state| state.1).fold(0.0, f64::max);
    round_step(most, LEVELS)
}

fn states(cracks: &[CrackMap]) -> impl Iterator<Item = (FaceStatus, f64)> {
    cracks.iter().flat_map(|crack| crack.faces.states())
}

fn legend(step: f64, cracks: &[CrackMap]) -> Vec<Entry> {
    let entry = |fill: String, words: String| Entry { mark: Mark::Box(fill), words };
    let heading = |words: &str| Entry { mark: Mark::Heading, words: words.to_owned() };
    let mut entries = vec![
        heading("Status"),
        entry(OPEN.to_owned(), "open".to_owned()),
        entry(BLUE.to_owned(), "stick".to_owned()),
        entry(ORANGE.to_owned(), "slip".to_owned()),
    ];
    let highest = states(cracks).map(|state| class(state, Column::Pressure, step)).max().unwrap_or(0);
    if highest > 0 {
        entries.extend([heading(""), heading("Pressure")]);
    }
    for level in (1..=highest).rev() {
        let words = format!("{} MPa", level_words(level - 1, step));
        entries.push(entry(colour(level, Column::Pressure), words));
    }
    entries
}

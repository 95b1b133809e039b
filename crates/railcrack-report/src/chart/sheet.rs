//! A sheet of charts as an SVG file.

use super::types::{
    Chart, ChartAspect, ChartAxis, ChartRange, ChartScale, ChartSheet, LegendEntry, LegendMark, SheetLegend,
};
use super::types::{Curve, CurveColour, CurveDots, CurveLook, CurveWidth};
use crate::html::escaped;
use crate::markup::plain;
use crate::numbers::shortened;
use crate::svg::{
    AREA, Anchor, Axes, Axis, CATEGORIES, Entry, Frame, GREY, INK, Mark, ORANGE, RAIL, Span, Stroke, Svg,
    TextStyle, around, coordinate, draw_legend, ends, legend_width, quantity, sequence, text,
};

/// Inside of the only chart of a sheet, and of one of several, pixels.
const SIZES: [[f64; 2]; 2] = [[600.0, 360.0], [420.0, 230.0]];
/// Width of charts to scale, one below the other.
const LONG: f64 = 920.0;
/// Height of a long chart that is not to scale.
const LONG_HEIGHT: f64 = 200.0;
/// Space above the surface of a strip, for crack labels, and below its deepest point.
const STRIP: [f64; 2] = [20.0, 24.0];
/// Heights of a chart to scale in a file.
const TO_SCALE: [f64; 2] = [150.0, 560.0];
/// The least height of a row of cracks over the whole width, and its length over its depth.
const TO_SCALE_ROW: f64 = 110.0;
const ROW: f64 = 5.0;
/// Room at the left of a chart: ticks and title of its y axis.
const LEFT: f64 = 76.0;
/// Room below a chart with a title of its x axis, and below one without.
const BELOW: [f64; 2] = [56.0, 24.0];
/// Height of the heading of a sheet, and of that of a chart.
pub(crate) const HEADING: f64 = 58.0;
const CHART_HEADING: f64 = 20.0;
/// Maximum number of entries of an automatic legend; of more, evenly spaced ones are chosen.
const LEGEND: usize = 18;
/// Maximum number of letters in a line of the legend.
const LEGEND_LETTERS: f64 = 60.0;
/// Colour of a background curve.
const FINE: &str = "#bdbdbd";

/// Title and subtitle of a picture, the title cut to `room` pixels.
pub(crate) fn draw_heading(svg: &mut Svg, left: f64, room: f64, title: &str, subtitle: &str) {
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    let quiet = TextStyle { size: 12.0, colour: GREY, weight: "normal", ..bold };
    svg.text([left, 24.0], &[Span::Plain(shortened(title, room / 8.6))], bold);
    svg.text([left, 43.0], &text(subtitle), quiet);
}

impl ChartSheet {
    /// The file.
    pub fn svg(&self) -> String {
        let is_column = self.rows.iter().all(|row| row.len() == 1);
        let is_to_scale = self.charts().all(|chart| chart.aspect == ChartAspect::Equal);
        let is_long = self.charts().any(|chart| chart.aspect == ChartAspect::Long);
        let size = match self.charts().count() {
            _ if is_long => [LONG, LONG_HEIGHT],
            0 | 1 => SIZES[0],
            // Long rows of cracks, one below the other.
            _ if is_column && is_to_scale => [LONG, SIZES[1][1]],
            _ => SIZES[1],
        };
        let mut placed: Vec<(Axes, &Chart, bool)> = Vec::new();
        let mut top = HEADING;
        for (r, row) in self.rows.iter().enumerate() {
            top += if row.iter().any(|chart| !chart.heading.is_empty()) { CHART_HEADING } else { 0.0 };
            let (mut bottom, mut below) = (top, BELOW[1]);
            for (column, chart) in row.iter().enumerate() {
                let (x, y, height) = scales(chart, &self.charts().collect::<Vec<_>>(), size, TO_SCALE[1]);
                let left = LEFT + column as f64 * (size[0] + LEFT + 16.0);
                let frame = Frame { left, top, width: size[0], height };
                // The chart below has the labels.
                let next = self.rows.get(r + 1).and_then(|row| row.get(column));
                let is_titled = next.is_none_or(|next| next.x != chart.x || !next.heading.is_empty());
                below = if is_titled { BELOW[0] } else { below };
                bottom = f64::max(bottom, frame.bottom());
                placed.push((Axes { frame, x, y }, chart, is_titled));
            }
            top = bottom + below;
        }
        let entries = self.entries();
        let right = placed.iter().map(|(axes, ..)| axes.frame.right()).fold(0.0, f64::max);
        let width = right + 24.0 + legend_width(&entries);
        let mut svg = Svg::new(width, top.max(HEADING + 20.0 + 18.0 * entries.len() as f64));
        draw_heading(&mut svg, LEFT, width - LEFT, &self.title, &self.subtitle);
        for (axes, chart, is_titled) in &placed {
            draw(&mut svg, axes, chart, *is_titled, Ground::File);
        }
        draw_legend(&mut svg, [right + 16.0, HEADING], &entries);
        svg.finish(&format!("{}: {}", plain(&self.subtitle), self.title))
    }

    /// The legend; of many names, evenly chosen ones.
    fn entries(&self) -> Vec<Entry> {
        let others = match &self.legend {
            SheetLegend::Entries(entries) => return entries.iter().map(entry).collect(),
            SheetLegend::Names(others) => others,
        };
        let mut entries: Vec<LegendEntry> = Vec::new();
        for chart in self.charts() {
            let curve = |(place, curve): (usize, &Curve)| LegendEntry {
                mark: LegendMark::Curve {
                    look: curve.look,
                    dots: curve.dots.clone(),
                    width: curve.width,
                    colour: curve.colour.unwrap_or(CurveColour::Category(place)),
                },
                words: curve.name.clone(),
            };
            let areas =
                chart.areas.iter().map(|a| LegendEntry { mark: LegendMark::Area, words: a.name.clone() });
            for new in areas.chain(chart.curves.iter().enumerate().map(curve)) {
                if !new.words.is_empty() && !entries.iter().any(|entry| entry.words == new.words) {
                    entries.push(new);
                }
            }
        }
        let every = entries.len().div_ceil(LEGEND).max(1);
        entries.iter().step_by(every).chain(others).map(entry).collect()
    }
}

/// Where a chart stands: in a file on white, or in a page in its light or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ground {
    File,
    Page,
}

/// The scales of `chart` on `width` pixels and its height: that of `size`, to scale at most `most`.
/// Axes with the same title as one of `charts` have the same scale.
pub(super) fn scales(chart: &Chart, charts: &[&Chart], size: [f64; 2], most: f64) -> (Axis, Axis, f64) {
    let [width, height] = size;
    let values = |c: usize| {
        let axis = |chart: &Chart| if c == 0 { chart.x.title() } else { chart.y.title() };
        let alike = charts.iter().filter(|other| axis(other) == axis(chart));
        let points = |chart: &Chart| -> Vec<f64> {
            let areas = chart.areas.iter().flat_map(|area| &area.outline);
            chart.curves.iter().flat_map(|curve| &curve.points).chain(areas).map(|point| point[c]).collect()
        };
        alike.flat_map(|chart| points(chart)).collect::<Vec<f64>>()
    };
    let (x, y) = (values(0), values(1));
    if chart.aspect == ChartAspect::Equal {
        return match (chart.x.range, chart.y.range) {
            (ChartRange::Exact(of_x), ChartRange::Exact(of_y)) => exact(chart, [of_x, of_y], width, most),
            (ChartRange::Exact(of_x), _) => strip(of_x, ends(y)[1], width),
            _ => equal(ends(x), ends(y), width, most),
        };
    }
    let axis = |axis: &ChartAxis, values: Vec<f64>, length: f64| {
        let is_logarithmic = axis.scale == ChartScale::Logarithmic;
        let values = values.into_iter().filter(|&value| !is_logarithmic || value > 0.0);
        let [low, high] = match (axis.range, axis.scale) {
            (ChartRange::Exact(ends), _) => ends,
            (_, ChartScale::Logarithmic) => around(values.map(f64::ln)).map(f64::exp),
            (ChartRange::Tight, _) => ends(values),
            (ChartRange::Around, _) => around(values),
            (ChartRange::AroundZero, _) => around(values.chain([0.0])),
        };
        let ticks = (length / 40.0).round() as usize;
        match axis.scale {
            ChartScale::Linear => Axis::exact(low, high, ticks),
            ChartScale::Depth => Axis::exact(high, low, ticks),
            ChartScale::Logarithmic => Axis::logarithmic(low, high),
        }
    };
    (axis(&chart.x, x, width), axis(&chart.y, y, height), height)
}

/// Scales over `x` and `y` with the same unit both ways: the height that they need on `width`
/// pixels, at most `most`, for which x is widened.
fn exact(chart: &Chart, [x, y]: [[f64; 2]; 2], width: f64, most: f64) -> (Axis, Axis, f64) {
    let (across, up) = ((x[1] - x[0]).max(1e-6), (y[1] - y[0]).max(1e-6));
    let scale = (width / across).min(most / up);
    let (half, middle, height) = (0.5 * width / scale, 0.5 * (x[0] + x[1]), scale * up);
    let ticks = |length: f64| (length / 55.0) as usize + 1;
    let x = Axis::exact(middle - half, middle + half, ticks(width));
    let y = match chart.y.scale {
        ChartScale::Depth => Axis::exact(y[1], y[0], 2 * ticks(height)).starting_at_zero(),
        _ => Axis::exact(y[0], y[1], ticks(height)),
    };
    (x, y, height)
}

/// Scales around the points between `x` and `y` with the same unit both ways, depth downwards, on
/// `width` pixels; the height that they need, at most `most`.
fn equal([left, right]: [f64; 2], [_, deep]: [f64; 2], width: f64, most: f64) -> (Axis, Axis, f64) {
    let (across, deep) = ((right - left).max(1e-6), deep.max(1e-6));
    let air = 0.12 * across.max(deep);
    // Rows of cracks need the whole width of a page, because growth is small compared with it.
    let is_row = width >= LONG && across > ROW * deep;
    let (air, least) = if is_row { (0.25 * air, TO_SCALE_ROW) } else { (air, TO_SCALE[0]) };
    // The room above the surface takes notes.
    let above = 0.6 * air;
    let (x_span, y_span) = (across + 2.0 * air, deep + air + above);
    let scale = (width / x_span).min(most / y_span);
    let height = (scale * y_span).max(least);
    let (half, middle) = (0.5 * width / scale, 0.5 * (left + right));
    let ticks = |length: f64| (length / 55.0) as usize + 1;
    let x = Axis::exact(middle - half, middle + half, ticks(width));
    (x, Axis::exact(height / scale - above, -above, ticks(height)), height)
}

/// Scales of a strip from `left` to `right` down to `deep` with the same unit both ways, and the
/// height that it needs.
fn strip([left, right]: [f64; 2], deep: f64, width: f64) -> (Axis, Axis, f64) {
    let deep = deep.max(1e-6);
    let scale = (width / (right - left).max(1e-6)).min((TO_SCALE[1] - STRIP[0] - STRIP[1]) / deep);
    let height = STRIP[0] + scale * deep + STRIP[1];
    let (half, middle) = (0.5 * width / scale, 0.5 * (left + right));
    let x = Axis::exact(middle - half, middle + half, (width / 55.0) as usize + 1);
    let y = Axis::exact(deep + STRIP[1] / scale, -STRIP[0] / scale, (height / 16.0) as usize);
    (x, y, height)
}

/// Draws a chart into its axes; with titles of both axes, or of y alone.
pub(super) fn draw(svg: &mut Svg, axes: &Axes, chart: &Chart, is_titled: bool, ground: Ground) {
    let frame = axes.frame;
    let [_, surface] = axes.at(0.0, 0.0);
    let is_rail = chart.aspect == ChartAspect::Equal && chart.y.scale == ChartScale::Depth;
    if is_rail {
        let top = surface.max(frame.top);
        svg.rectangle([frame.left, top, frame.width, frame.bottom() - top], RAIL, "none");
    }
    axes.draw_grid(svg);
    axes.clip(svg, if ground == Ground::Page { &chart.id } else { "" });
    let at = |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|&[x, y]| axes.at(x, y)).collect() };
    for area in &chart.areas {
        let corners = at(&area.outline);
        let path: Vec<String> =
            corners.iter().map(|[x, y]| format!("{} {}", coordinate(*x), coordinate(*y))).collect();
        svg.area("piece", &format!("M{}Z", path.join("L")), AREA);
        let closed: Vec<[f64; 2]> = corners.iter().chain(corners.first()).copied().collect();
        svg.polyline("outline", &closed, &Stroke { dashes: "4 3", ..Stroke::solid(ORANGE, 1.2) });
    }
    for (place, curve) in chart.curves.iter().enumerate() {
        draw_curve(svg, axes, chart, (place, curve), ground);
    }
    svg.end();
    if is_rail && surface >= frame.top {
        let line = [[frame.left, surface], [frame.right(), surface]];
        svg.polyline("surface", &line, &Stroke::solid(INK, 2.2));
    }
    let style = TextStyle { size: 11.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
    for note in &chart.notes {
        let [x, y] = axes.at(note.at[0], note.at[1]);
        svg.text([x, y - 7.0], &text(&note.words), style);
    }
    let heading = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    if !chart.heading.is_empty() && ground == Ground::File {
        svg.text([frame.left, frame.top - 9.0], &text(&chart.heading), heading);
    }
    let x_title = if is_titled { titled(&chart.x, &axes.x) } else { Vec::new() };
    axes.draw_frame(svg, &x_title, &titled(&chart.y, &axes.y));
}

fn draw_curve(svg: &mut Svg, axes: &Axes, chart: &Chart, (place, curve): (usize, &Curve), ground: Ground) {
    let colour = curve.colour.unwrap_or(CurveColour::Category(place));
    let has_place = |i: usize| {
        let [x, y] = curve.points[i];
        let fits = |axis: &ChartAxis, value: f64| axis.scale != ChartScale::Logarithmic || value > 0.0;
        (fits(&chart.x, x) && fits(&chart.y, y)).then(|| (i, axes.at(x, y)))
    };
    let shown: Vec<(usize, [f64; 2])> = (0..curve.points.len()).filter_map(has_place).collect();
    let stroke = stroke(curve.look, curve.width, colour, ground);
    if ground == Ground::Page {
        svg.begin(&names(curve));
    }
    if curve.look != CurveLook::Dots {
        let is_initial = colour == CurveColour::Ink && curve.width == CurveWidth::Wide;
        let class = if is_initial { "initial" } else { "series" };
        let line: Vec<[f64; 2]> = shown.iter().map(|(_, at)| *at).collect();
        svg.polyline(class, &line, &stroke);
    }
    for (_, at) in shown.iter().filter(|(i, _)| curve.has_dot(*i)) {
        svg.dot(*at, 2.4, &stroke.colour);
    }
    if ground == Ground::Page {
        svg.end();
    }
}

/// Attributes of a curve that the script of a page reads.
fn names(curve: &Curve) -> String {
    let mut names = format!(r#" class="curve" data-name="{}""#, escaped(&plain(&curve.name)));
    if !curve.note.is_empty() {
        names.push_str(&format!(r#" data-note="{}""#, escaped(&plain(&curve.note))));
    }
    if !curve.choices.is_empty() {
        let choices: Vec<String> = curve.choices.iter().map(usize::to_string).collect();
        names.push_str(&format!(r#" data-choices="{}""#, choices.join(",")));
    }
    names
}

/// The title of an axis with the power of ten that its labels leave out.
fn titled(axis: &ChartAxis, scale: &Axis) -> Vec<Span> {
    let power = match scale.exponent() {
        0 => return quantity(&axis.title()),
        exponent => format!("10^{{{exponent}}}").replace('-', "\u{2212}"),
    };
    let unit = if axis.unit.is_empty() { format!("\u{d7}{power}") } else { format!("{power} {}", axis.unit) };
    quantity(&format!("{} ({unit})", axis.label))
}

/// Dashes of the varied looks.
const VARIED: [&str; 10] = [
    "14 4",
    "9 3 2 3 2 3",
    "2 6",
    "14 3 2 3",
    "4 4",
    "14 3 5 3",
    "6 3 2 3 2 3 2 3",
    "1 3",
    "10 8",
    "20 4 2 4",
];

/// Dashes of a line, in pixels; empty for a solid one.
pub(crate) fn dashes(look: CurveLook) -> &'static str {
    match look {
        CurveLook::Line | CurveLook::Dots => "",
        CurveLook::Dashed => "6 4",
        CurveLook::FineDashed => "2 3",
        CurveLook::DashDotted => "9 3 2 3",
        CurveLook::Varied(number) => VARIED[usize::from(number) % VARIED.len()],
    }
}

pub(super) fn stroke(look: CurveLook, width: CurveWidth, colour: CurveColour, ground: Ground) -> Stroke {
    let colour = match colour {
        _ if ground == Ground::Page => format!("var(--{})", colour.name()),
        CurveColour::Category(number) => CATEGORIES[number % CATEGORIES.len()].to_owned(),
        CurveColour::Along(place) => sequence(place),
        CurveColour::Ink => INK.to_owned(),
        CurveColour::Quiet if width == CurveWidth::Fine => FINE.to_owned(),
        CurveColour::Quiet => GREY.to_owned(),
    };
    let width = match width {
        CurveWidth::Fine => 0.8,
        CurveWidth::Usual => 1.7,
        CurveWidth::Wide => 3.2,
    };
    Stroke { dashes: dashes(look), ..Stroke::solid(&colour, width) }
}

fn entry(entry: &LegendEntry) -> Entry {
    let mark = match &entry.mark {
        LegendMark::Heading => Mark::Heading,
        LegendMark::Note => Mark::Note,
        LegendMark::Area => Mark::Box(AREA.to_owned()),
        LegendMark::Curve { look, dots, width, colour } => {
            let stroke = stroke(*look, *width, *colour, Ground::File);
            match (look, dots) {
                (CurveLook::Dots, _) => Mark::Dot(stroke.colour),
                (_, CurveDots::None | CurveDots::Last) => Mark::Line(stroke),
                (_, CurveDots::All | CurveDots::AllBut(_)) => Mark::Dotted(stroke),
            }
        }
    };
    Entry { mark, words: shortened(&entry.words, LEGEND_LETTERS) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(y: &str, points: &[[f64; 2]]) -> Chart {
        Chart {
            x: ChartAxis::linear("x", "mm"),
            y: ChartAxis::logarithmic(y, "mm"),
            curves: vec![Curve::line("curve", points.to_vec()).with_dots(CurveDots::All)],
            ..Chart::default()
        }
    }

    #[test]
    fn axes_with_the_same_title_have_the_same_scale() {
        let rows =
            vec![vec![chart("y", &[[0.0, 1e-6]]), chart("y", &[[5.0, 1e-2]]), chart("z", &[[1.0, 1.0]])]];
        let sheet = ChartSheet { rows, ..ChartSheet::default() };
        let charts: Vec<&Chart> = sheet.charts().collect();
        let [first, second, third] = [0, 1, 2].map(|i| scales(charts[i], &charts, SIZES[1], TO_SCALE[1]));
        assert!(first.0 == second.0 && first.1 == second.1 && first.0 == third.0 && first.1 != third.1);
    }

    #[test]
    fn zero_has_no_place_on_a_logarithmic_axis() {
        let svg = ChartSheet::of("t", "s", chart("y", &[[0.0, 0.0], [1.0, 1e-3], [2.0, 1e-1]])).svg();
        assert_eq!(svg.matches("<circle").count(), 2 + 3, "two points, three dots of the legend");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

//! Cracks in space, seen at an angle from above.

use super::smooth::smooth;
use super::space::{front_ends, front_steps};
use crate::svg::{
    AREA, Anchor, GREY, INK, LIGHT, RAIL, Stroke, Svg, TextStyle, coordinate, ends, quantity, round_step,
    sequence, text,
};
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;

/// Direction of view: its angle to the rail in the running surface, and below the horizontal.
const AZIMUTH: f64 = 0.6;
const ELEVATION: f64 = 0.5;
/// Pixels of the picture, and of the margin around it.
const WIDTH: f64 = 520.0;
const MARGIN: f64 = 34.0;
/// Lines of the grid on the running surface.
const GRID: usize = 8;

/// x along the rail, z across it and depth, mm.
type Place = [f64; 3];

/// The parallel projection to pixels.
struct View {
    scale: f64,
    from: [f64; 2],
}

/// To the right and down, mm.
fn projected([x, z, depth]: Place) -> [f64; 2] {
    let (sin, cos) = AZIMUTH.sin_cos();
    let away = z * cos - x * sin;
    [x * cos + z * sin, depth * ELEVATION.cos() - away * ELEVATION.sin()]
}

impl View {
    /// The view of all `places`, with the height of its picture.
    fn of(places: &[Place]) -> (Self, f64) {
        let flat: Vec<[f64; 2]> = places.iter().map(|place| projected(*place)).collect();
        let [across, down] = [0, 1].map(|c| ends(flat.iter().map(|point| point[c])));
        let scale = (WIDTH - 2.0 * MARGIN) / (across[1] - across[0]).max(1e-6);
        let from = [across[0] - MARGIN / scale, down[0] - MARGIN / scale];
        (Self { scale, from }, scale * (down[1] - down[0]) + 2.0 * MARGIN)
    }

    fn at(&self, place: Place) -> [f64; 2] {
        let point = projected(place);
        [0, 1].map(|c| self.scale * (point[c] - self.from[c]))
    }
}

/// The fronts of all cracks in some steps below the running surface, to scale; the faces of the
/// last one filled. Also the distance of the lines on the surface, mm.
pub(crate) fn space_view(summary: &Summary, growth: &[TipRow]) -> (String, f64) {
    let place = |row: &TipRow| Some([row.place[0], row.lateral?, -row.place[1]]);
    let places: Vec<Place> = growth.iter().filter_map(place).collect();
    let of = |c: usize| ends(places.iter().map(|place| place[c]));
    let (x, z) = (of(0), of(1));
    let step = round_step((x[1] - x[0]).max(z[1] - z[0]).max(1e-3), GRID);
    let (x, z) = (to_lines(x, step), to_lines(z, step));
    let corners = [[x[0], z[0], 0.0], [x[1], z[0], 0.0], [x[1], z[1], 0.0], [x[0], z[1], 0.0]];
    let all: Vec<Place> = places.iter().copied().chain(corners).collect();
    let (view, height) = View::of(&all);
    let mut svg = Svg::new(WIDTH, height);
    svg.area("surface", &outline(&view, &corners), RAIL);
    let line = |svg: &mut Svg, ends: [Place; 2]| {
        svg.polyline("grid", &ends.map(|end| view.at(end)), &Stroke::solid(LIGHT, 1.0));
    };
    for at in crate::svg::multiples(x[0], x[1], step) {
        line(&mut svg, [[at, z[0], 0.0], [at, z[1], 0.0]]);
    }
    for at in crate::svg::multiples(z[0], z[1], step) {
        line(&mut svg, [[x[0], at, 0.0], [x[1], at, 0.0]]);
    }
    let steps = front_steps(summary);
    let cracks = growth.iter().map(|row| row.crack).max().unwrap_or(0);
    for crack in 1..=cracks {
        let front = |step: usize| -> Vec<Place> {
            let rows: Vec<&TipRow> =
                growth.iter().filter(|row| (row.step, row.crack) == (step, crack)).collect();
            let points: Vec<Place> = rows.iter().filter_map(|row| place(row)).collect();
            match front_ends(growth, crack) {
                Some(ends) => smooth(&points, ends),
                None => points,
            }
        };
        if let Some(last) = steps.last() {
            svg.area("face", &outline(&view, &front(*last)), AREA);
        }
        for (number, step) in steps.iter().enumerate() {
            let stroke = match step {
                0 => Stroke::solid(INK, 2.4),
                _ => Stroke::solid(&sequence(number as f64 / steps.len() as f64), 1.7),
            };
            let line: Vec<[f64; 2]> = front(*step).iter().map(|place| view.at(*place)).collect();
            svg.polyline("front", &line, &stroke);
        }
    }
    label(&mut svg, &view, places.iter().copied().max_by(|a, b| a[2].total_cmp(&b[2])));
    let style = TextStyle { size: 12.0, anchor: Anchor::Middle, colour: GREY, weight: "normal" };
    let below = |ends: [Place; 2]| {
        let [a, b] = ends.map(|end| view.at(end));
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) + 16.0]
    };
    svg.text(below([corners[0], corners[1]]), &quantity("x along the rail"), style);
    // The cracks are in front of the right edge.
    let [x, y] = below([corners[3], corners[0]]);
    svg.text([x - 10.0, y - 24.0], &quantity("z across"), TextStyle { anchor: Anchor::End, ..style });
    (svg.finish("Cracks below the running surface"), step)
}

/// The range with its ends moved out to lines at multiples of `step`.
fn to_lines([low, high]: [f64; 2], step: f64) -> [f64; 2] {
    [((low / step).floor() - 1.0) * step, ((high / step).ceil() + 1.0) * step]
}

fn outline(view: &View, places: &[Place]) -> String {
    let corner = |place: &Place| {
        let [x, y] = view.at(*place).map(coordinate);
        format!("{x} {y}")
    };
    format!("M{}Z", places.iter().map(corner).collect::<Vec<_>>().join("L"))
}

/// The depth of the deepest point, below the surface above it.
fn label(svg: &mut Svg, view: &View, deepest: Option<Place>) {
    let Some(place) = deepest else { return };
    let (below, above) = (view.at(place), view.at([place[0], place[1], 0.0]));
    svg.polyline("depth", &[above, below], &Stroke { dashes: "2 3", ..Stroke::solid(GREY, 1.2) });
    let style = TextStyle { size: 12.0, anchor: Anchor::Start, colour: INK, weight: "normal" };
    svg.text([below[0] + 6.0, below[1] + 14.0], &text(&format!("{:.1} mm deep", place[2])), style);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_view_is_from_above() {
        let [[_, surface], [_, deep]] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(projected);
        assert!(deep > surface);
        // What is far is higher, and the rail goes to the right.
        assert!(projected([0.0, 1.0, 0.0])[1] < surface && projected([1.0, 0.0, 0.0])[0] > 0.0);
    }
}

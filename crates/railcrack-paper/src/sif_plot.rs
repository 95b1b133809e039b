//! K_I and K_II against the wheel position, both bodies and both ways of travel in one picture.

use super::figure::Figure;
use super::verdict::MAIN;
use super::{CURVES, CrackGrowth, Results, SETUPS, SetupResults};
use railcrack_report::svg::{
    Anchor, Axes, Axis, CATEGORIES, Entry, Frame, GREY, INK, Mark, Span, Stroke, Svg, TextStyle, draw_legend,
    legend_width, sequence,
};

const PANEL: [f64; 2] = [400.0, 230.0];
const LEFT: f64 = 70.0;
const TOP: f64 = 78.0;
const GAP: [f64; 2] = [70.0, 22.0];

/// One line: a crack of a curve.
struct Line<'a> {
    words: String,
    colour: String,
    crack: &'a CrackGrowth,
    dashes: &'static str,
}

/// Dashes of the block.
pub(super) const DASHES: &str = "5 3";

/// The picture of `figure`.
pub(super) fn draw(figure: &Figure, results: &Results) -> String {
    let columns: [Vec<Line>; 2] =
        [["half-plane, with", "block, with"], ["half-plane, against", "block, against"]].map(|setups| {
            setups.iter().filter_map(|name| results.setup(name)).flat_map(|r| lines(figure, r)).collect()
        });
    let mut entries: Vec<Entry> = Vec::new();
    for line in columns.iter().flatten().filter(|line| line.dashes.is_empty()) {
        let mark = Mark::Line(Stroke::solid(&line.colour, 1.8));
        if !entries.iter().any(|entry| entry.words == line.words) {
            entries.push(Entry { mark, words: line.words.clone() });
        }
    }
    if columns.iter().flatten().any(|line| !line.dashes.is_empty()) {
        entries.push(Entry { mark: Mark::Line(Stroke::solid(INK, 1.6)), words: "half-plane".into() });
        let dashed = Stroke { dashes: DASHES, ..Stroke::solid(INK, 1.4) };
        entries.push(Entry { mark: Mark::Line(dashed), words: "block, bottom clamped".into() });
    }
    let right = LEFT + 2.0 * PANEL[0] + GAP[0];
    let bottom = TOP + 2.0 * PANEL[1] + GAP[1];
    let mut svg = Svg::new(right + 24.0 + legend_width(&entries), bottom + 56.0);
    heading(&mut svg, figure);
    for (column, lines) in columns.iter().enumerate() {
        column_title(&mut svg, column);
        for row in 0..2 {
            panel(&mut svg, [column, row], lines, &columns);
        }
    }
    draw_legend(&mut svg, [right + 16.0, TOP], &entries);
    svg.finish(&format!("Fig. {}: {}", figure.number, figure.title))
}

fn heading(svg: &mut Svg, figure: &Figure) {
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    let text = format!("Trollé et al. (2014), Fig. {} recomputed: {}", figure.number, figure.title);
    svg.text([LEFT, 24.0], &[Span::Plain(text)], bold);
}

fn column_title(svg: &mut Svg, column: usize) {
    let style = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    let text = ["Crack leans along the travel", "Crack leans against the travel"][column];
    let x = LEFT + column as f64 * (PANEL[0] + GAP[0]);
    svg.text([x, TOP - 10.0], &[Span::plain(text)], style);
}

fn lines<'a>(figure: &Figure, r: SetupResults<'a>) -> Vec<Line<'a>> {
    let dashes = if r.setup().name.starts_with("block") { DASHES } else { "" };
    let shown = figure.curves.iter().filter_map(|name| {
        let curve = CURVES.iter().find(|curve| curve.name == *name)?;
        Some((curve, r.run(name)?))
    });
    let mut lines = Vec::new();
    let mut place = 0;
    for (curve, run) in shown {
        let count = run.cracks.len();
        if count > 2 && !dashes.is_empty() {
            // Nine lines more would hide the others.
            continue;
        }
        for (i, crack) in run.cracks.iter().enumerate() {
            let colour = if count > 2 {
                sequence(i as f64 / (count - 1) as f64)
            } else {
                let colour = CATEGORIES[place % CATEGORIES.len()].to_owned();
                place += 1;
                colour
            };
            let words = if count > 1 { format!("crack {}", i + 1) } else { figure.words(curve).to_owned() };
            lines.push(Line { words, colour, crack, dashes });
        }
    }
    lines
}

fn panel(svg: &mut Svg, [column, row]: [usize; 2], lines: &[Line], all: &[Vec<Line>; 2]) {
    let k = |line: &Line| -> Vec<f64> {
        if row == 0 { line.crack.sif.ki.clone() } else { line.crack.sif.kii.clone() }
    };
    let frame = Frame {
        left: LEFT + column as f64 * (PANEL[0] + GAP[0]),
        top: TOP + row as f64 * (PANEL[1] + GAP[1]),
        width: PANEL[0],
        height: PANEL[1],
    };
    let positions = all.iter().flatten().flat_map(|line| line.crack.sif.position.iter().copied());
    let (low, high) = positions.fold((0.0, 0.0), |(l, h): (f64, f64), x| (l.min(x), h.max(x)));
    let axes = Axes {
        frame,
        x: Axis::exact(low, high, 9),
        y: Axis::around(all.iter().flatten().flat_map(k).chain([0.0]), 6),
    };
    axes.draw_grid(svg);
    axes.clip(svg);
    for line in lines {
        let points: Vec<[f64; 2]> =
            line.crack.sif.position.iter().zip(k(line)).map(|(&x, k)| axes.at(x, k)).collect();
        let stroke = Stroke { dashes: line.dashes, ..Stroke::solid(&line.colour, 1.5) };
        svg.polyline("series", &points, &stroke);
    }
    svg.unclip();
    let x_title = if row == 1 {
        vec![
            Span::Italic("x"),
            Span::Sub("c"),
            Span::plain(" / "),
            Span::Italic("a"),
            Span::plain(", along the travel"),
        ]
    } else {
        Vec::new()
    };
    let mode = if row == 0 { "I" } else { "II" };
    axes.draw_frame(svg, &x_title, &[Span::Italic("K"), Span::Sub(mode), Span::plain("  (MPa\u{221a}m)")]);
}

/// The columns of a table of K.
pub const SIF_FIGURE_COLUMNS: &str = "setup,curve,crack,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m";

/// The table of `figure`: every curve that it shows in every set-up.
pub(super) fn table(figure: &Figure, results: &Results) -> String {
    let mut text = format!("{SIF_FIGURE_COLUMNS}\n");
    for r in results.setups() {
        for name in figure.curves {
            let Some(run) = r.run(name) else { continue };
            for (i, crack) in run.cracks.iter().enumerate() {
                let sif = &crack.sif;
                for ((x, ki), kii) in sif.position.iter().zip(&sif.ki).zip(&sif.kii) {
                    text.push_str(&format!("\"{}\",{name},{},{x:?},{ki:?},{kii:?}\n", r.setup().name, i + 1));
                }
            }
        }
    }
    text
}

/// Both engines on the case of Fig. 13, and their difference.
pub(super) fn engines(results: &Results) -> Option<String> {
    let first = results.setup("half-plane, with")?.run("fig13")?.crack();
    let second = results.setup("half-plane xfem, with")?.run("fig13")?.crack();
    let difference = second.sif.minus(&first.sif);
    let entries = [
        Entry { mark: Mark::Line(Stroke::solid(CATEGORIES[0], 3.2)), words: "dislocations".into() },
        Entry {
            mark: Mark::Line(Stroke { dashes: DASHES, ..Stroke::solid(CATEGORIES[1], 1.6) }),
            words: "finite elements".into(),
        },
    ];
    let right = LEFT + 2.0 * PANEL[0] + GAP[0];
    let bottom = TOP + 2.0 * PANEL[1] + GAP[1];
    let mut svg = Svg::new(right + 24.0 + legend_width(&entries), bottom + 56.0);
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    svg.text([LEFT, 24.0], &[Span::plain("Two engines on the case of Fig. 13, half-plane")], bold);
    let quiet = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    svg.text([LEFT, TOP - 10.0], &[Span::plain("K of both")], quiet);
    svg.text(
        [LEFT + PANEL[0] + GAP[0], TOP - 10.0],
        &[Span::plain("Finite elements less dislocations, per cent of the peak")],
        quiet,
    );
    for row in 0..2 {
        let top = TOP + row as f64 * (PANEL[1] + GAP[1]);
        let frame = |column: f64| Frame {
            left: LEFT + column * (PANEL[0] + GAP[0]),
            top,
            width: PANEL[0],
            height: PANEL[1],
        };
        let k = |crack: &CrackGrowth| if row == 0 { crack.sif.ki.clone() } else { crack.sif.kii.clone() };
        let points =
            |x: &[f64], y: &[f64]| -> Vec<[f64; 2]> { x.iter().zip(y).map(|(&x, &y)| [x, y]).collect() };
        let both = [points(&first.sif.position, &k(first)), points(&second.sif.position, &k(second))];
        let strokes = [
            Stroke::solid(CATEGORIES[0], 3.2),
            Stroke { dashes: DASHES, ..Stroke::solid(CATEGORIES[1], 1.6) },
        ];
        let peak = first.sif.peak();
        let off: Vec<[f64; 2]> = difference.iter().map(|d| [d[0], 100.0 * d[1 + row] / peak]).collect();
        let x_title = if row == 1 {
            vec![Span::Italic("x"), Span::Sub("c"), Span::plain(" / "), Span::Italic("a")]
        } else {
            Vec::new()
        };
        let mode = if row == 0 { "I" } else { "II" };
        let y_title = [Span::Italic("K"), Span::Sub(mode), Span::plain("  (MPa\u{221a}m)")];
        series(&mut svg, frame(0.0), &both, &strokes, [&x_title, &y_title]);
        let off_title =
            [Span::plain("Difference of "), Span::Italic("K"), Span::Sub(mode), Span::plain("  (%)")];
        series(&mut svg, frame(1.0), &[off], &[Stroke::solid(INK, 1.4)], [&x_title, &off_title]);
    }
    draw_legend(&mut svg, [right + 16.0, TOP], &entries);
    Some(svg.finish("Two engines on the case of Fig. 13"))
}

fn series(svg: &mut Svg, frame: Frame, lines: &[Vec<[f64; 2]>], strokes: &[Stroke], titles: [&[Span]; 2]) {
    let all = |c: usize| lines.iter().flatten().map(move |point| point[c]);
    let (low, high) = all(0).fold((0.0, 0.0), |(l, h): (f64, f64), x| (l.min(x), h.max(x)));
    let axes = Axes { frame, x: Axis::exact(low, high, 9), y: Axis::around(all(1).chain([0.0]), 6) };
    axes.draw_grid(svg);
    axes.clip(svg);
    for (line, stroke) in lines.iter().zip(strokes) {
        let points: Vec<[f64; 2]> = line.iter().map(|&[x, y]| axes.at(x, y)).collect();
        svg.polyline("series", &points, stroke);
    }
    svg.unclip();
    axes.draw_frame(svg, titles[0], titles[1]);
}

/// The main set-ups.
pub(super) fn main_setups() -> impl Iterator<Item = &'static str> {
    SETUPS[..MAIN].iter().map(|setup| setup.name)
}

//! Charts and data of the explorer of cracks in space.

use super::stored::RunFolder;
use super::wheels::passage_of;
use crate::chart::{Chart, ChartAspect, ChartAxis, ChartRange};
use crate::figures::{WheelPassage, front_ends, smooth};
use crate::numbers::{number, numbers};
use crate::page::{Block, Section};
use crate::page_data::{Deflated, PageData};
use crate::svg::ends;
use railcrack::space::{VERTEX_LAYER, WheelPatch};
use railcrack_case::{Case, SpaceCase};
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::History;
use serde_json::{Value, json};

const EXPLORER_SCRIPT: &str = include_str!("../../assets/space.js");

/// Number of cracks.
pub(super) fn cracks(run: &RunFolder) -> usize {
    run.summary.cracks.len()
}

/// The passage of every wheel over the fronts.
pub(super) fn explorer(run: &RunFolder, space: &SpaceCase, page_data: &PageData) -> Section {
    let viewer = Block::Viewer {
        id: "explorer",
        html: super::EXPLORER,
        blocks: vec![Block::charts(views(run, space).into_iter().chain(k_charts(run, page_data)))],
        data_id: "space-data",
        data: data(run, space, page_data),
        script: EXPLORER_SCRIPT,
    };
    Section::new("passage", "Passage of the wheel", vec![viewer])
}

/// The range of `values` with a margin at both ends.
fn aired(values: impl IntoIterator<Item = f64>) -> ChartRange {
    let [low, high] = ends(values);
    let air = 0.06 * if high > low { high - low } else { 1.0 };
    ChartRange::Exact([low - air, high + air])
}

/// An empty chart, which the script fills.
fn chart(id: &str, caption: &str, [x, y]: [ChartAxis; 2], aspect: ChartAspect) -> Chart {
    Chart { id: id.to_owned(), caption: caption.to_owned(), x, y, aspect, ..Chart::default() }
}

/// The fronts in space: their axes hold for all steps, cracks, wheels and positions.
fn views(run: &RunFolder, space: &SpaceCase) -> [Chart; 3] {
    let rows = &run.growth;
    let wheels = || run.patches.iter().map(WheelPatch::outline);
    let widest = wheels().map(|wheel| wheel.half_width).fold(0.0, f64::max);
    let [left, right] = ends(rows.iter().map(|row| row.place[0]));
    let along_rail = || ChartAxis::linear("x", "mm").over(aired([left - widest, right + widest]));
    let sides = wheels().flat_map(|wheel| {
        [wheel.lateral - wheel.lateral_half_width, wheel.lateral + wheel.lateral_half_width]
    });
    let across = aired(rows.iter().filter_map(|row| row.lateral).chain(sides));
    let deepest = rows.iter().map(|row| -row.place[1]).fold(1e-6, f64::max);
    let load = 0.35 * deepest.max(0.5 * widest);
    let places = plane_places(run, space);
    let along_mouth = aired(places.iter().map(|place| place[0]));
    let down_dip = aired(places.iter().map(|place| place[1]).chain([0.0]));
    [
        chart(
            "above",
            "Seen from above, to scale: fronts in this growth step (thick), in the first (dotted) and in the last (thin), crack \
             mouths (dashed), and the contact ellipse. The dot is the selected point of the front.",
            [along_rail(), ChartAxis::linear("z, across the rail", "mm").over(across)],
            ChartAspect::Equal,
        ),
        chart(
            "side",
            "Seen from the side, to scale: the cracks projected onto a plane along the rail, below the pressure of the wheel.",
            [along_rail(), ChartAxis::depth().over(aired([-1.2 * load, deepest]))],
            ChartAspect::Equal,
        ),
        chart(
            "plane",
            "In the plane of the crack, to scale: the fronts of the growth steps on this page, from the surface down the dip.",
            [
                ChartAxis::linear("Along the mouth", "mm").over(along_mouth),
                ChartAxis { label: "Down the dip".to_owned(), ..ChartAxis::depth() }.over(down_dip),
            ],
            ChartAspect::Equal,
        ),
    ]
}

/// K along the fronts, and at a point over the passage; their axes hold for all steps too.
fn k_charts(run: &RunFolder, page_data: &PageData) -> [Chart; 2] {
    let turn = match ends(run.growth.iter().filter_map(|row| row.phi_deg)) {
        [first, _] if first < -0.5 => [-90.0, 270.0],
        [_, last] if last > 180.5 => [0.0, 360.0],
        _ => [0.0, 180.0],
    };
    let steps = page_data.steps();
    let histories = || steps.iter().flat_map(|step| page_data.by_wheel(*step)).flatten();
    let k = |history: &History| [&history.ki, &history.kii, &history.kiii].map(Clone::clone).concat();
    let k_axis = || ChartAxis::linear("K", "MPa√m").over(aired(histories().flat_map(k).chain([0.0])));
    let under = page_data.by_wheel(0).iter().enumerate();
    let positions = ends(under.flat_map(|(wheel, histories)| {
        let xs: &[f64] = histories.first().map_or(&[], |history| &history.xc_over_a);
        xs[passage_of(run, wheel).near(xs)].to_vec()
    }));
    [
        chart(
            "along",
            "K along the front. Curves: K at the wheel position of the slider; bands: the range over the passage. Dotted lines \
             bound the surface layer that the cells do not resolve.",
            [ChartAxis::linear("φ along the front", "°").over(ChartRange::Exact(turn)), k_axis()],
            ChartAspect::Free,
        ),
        chart(
            "history",
            "K at the chosen point over the passage.",
            [ChartAxis::linear("Wheel position x_{c}/a", "").over(ChartRange::Exact(positions)), k_axis()],
            ChartAspect::Free,
        ),
    ]
}

/// Places of all front points in the planes into which their cracks unroll: along the mouth from
/// its middle, and down the dip, mm.
fn plane_places(run: &RunFolder, space: &SpaceCase) -> Vec<[f64; 2]> {
    let place = |row: &TipRow| {
        let shape = space.shapes.get(row.crack.checked_sub(1)?)?;
        let (sin, cos) = shape.strike.sin_cos();
        let (x, z) = (row.place[0] - shape.middle[0], row.lateral.unwrap_or(0.0) - shape.middle[1]);
        Some([z * cos - x * sin, row.down?])
    };
    run.growth.iter().filter_map(place).collect()
}

fn data(run: &RunFolder, space: &SpaceCase, page_data: &PageData) -> Value {
    let histories = page_data.by_wheel(0);
    let passages: Vec<WheelPassage> = (0..histories.len()).map(|wheel| passage_of(run, wheel)).collect();
    let steps: Vec<Value> =
        page_data.steps().into_iter().map(|step| step_data(run, page_data, step, &passages)).collect();
    let cracks = run.summary.cracks.first();
    let origin = cracks.and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |p| p[0]);
    let wheel =
        |(i, ((passage, histories), patch)): (usize, ((&WheelPassage, &Vec<History>), &WheelPatch))| {
            let wheel = patch.outline();
            let mixed = run.case.wheels.get(i).filter(|_| run.case.is_mix());
            let xc_over_a: &[f64] = histories.first().map_or(&[], |history| &history.xc_over_a);
            json!({
                "name": mixed.map(|mixed| &mixed.name),
                "share": mixed.map(|mixed| number(mixed.share)),
                "half_width": number(wheel.half_width),
                "lateral_half_width": number(wheel.lateral_half_width),
                "lateral": number(wheel.lateral),
                // With bending the passage has distant positions, which the charts in metres show.
                "xc_over_a": numbers(xc_over_a[passage.near(xc_over_a)].iter().copied()),
            })
        };
    let wheels = passages.iter().zip(histories).zip(&run.patches).enumerate().map(wheel);
    json!({
        "wheels": wheels.collect::<Vec<_>>(),
        "origin": origin,
        "cracks": space.shapes.iter().map(|shape| json!({
            "dip": shape.dip,
            "strike": shape.strike,
            "middle": shape.middle.map(number),
            "buried": shape.buried.is_some(),
        })).collect::<Vec<_>>(),
        "layer": layer(&run.case).to_degrees(),
        "last_step": run.summary.steps_recorded.saturating_sub(1),
        "steps": steps,
    })
}

/// Half-width (radians of φ) of the layer next to the surface in which K does not count.
pub(super) fn layer(case: &Case) -> f64 {
    let divisions = case.space().into_iter().flat_map(SpaceCase::divisions);
    divisions.map(|division| division.layer()).fold(VERTEX_LAYER, f64::min)
}

/// The smooth line through the points `own` of the front of `crack`.
fn outline(run: &RunFolder, crack: usize, own: &[&TipRow]) -> Vec<Value> {
    let point =
        |row: &&TipRow| [row.place[0], -row.place[1], row.lateral.unwrap_or(0.0), row.down.unwrap_or(0.0)];
    let points: Vec<[f64; 4]> = own.iter().map(point).collect();
    let line = match front_ends(&run.growth, crack) {
        Some(ends) => smooth(&points, ends),
        None => points,
    };
    let place = |[x, depth, z, down]: &[f64; 4]| json!({ "x": number(*x), "depth": number(*depth), "z": number(*z), "down": number(*down) });
    line.iter().map(place).collect()
}

fn step_data(run: &RunFolder, page_data: &PageData, step: usize, passages: &[WheelPassage]) -> Value {
    let rows: Vec<&TipRow> = run.growth.iter().filter(|row| row.step == step).collect();
    let point = |row: &&TipRow| {
        let is_own = |history: &&History| (history.crack, history.tip) == (row.crack, row.tip);
        let under = |(passage, histories): (&WheelPassage, &Vec<History>)| {
            let history = histories.iter().find(is_own);
            let packed = |k: fn(&History) -> &[f64]| {
                history.map(|history| Deflated::singles(&k(history)[passage.near(&history.xc_over_a)]))
            };
            json!({
                "ki": packed(|history| &history.ki),
                "kii": packed(|history| &history.kii),
                "kiii": packed(|history| &history.kiii),
            })
        };
        json!({
            "phi": number(row.phi_deg.unwrap_or(0.0)),
            "x": number(row.place[0]),
            "depth": number(-row.place[1]),
            "down": row.down.map(number),
            "z": number(row.lateral.unwrap_or(0.0)),
            "delta_keq": number(row.delta_keq),
            "rate": number(row.rate),
            "wanted": row.wanted_kink_deg.map(number),
            "wheels": passages.iter().zip(page_data.by_wheel(step)).map(under).collect::<Vec<_>>(),
        })
    };
    let crack = |number_of: usize| {
        let own: Vec<&TipRow> = rows.iter().copied().filter(|row| row.crack == number_of).collect();
        let is_at_end = |row: &&&TipRow| row.phi_deg == Some(0.0) && own[0].phi_deg != Some(0.0);
        let fold = own.iter().find(is_at_end).and_then(|row| row.down).map(number);
        json!({
            "depth": own.first().map(|row| number(row.length)),
            "fold": fold,
            "half_length": own.first().and_then(|row| row.half_length).map(number),
            "outline": outline(run, number_of, &own),
            "front": own.iter().map(point).collect::<Vec<_>>(),
        })
    };
    json!({
        "step": step,
        "cycles": rows.first().map(|row| row.load_cycles),
        "cracks": (1..=cracks(run)).map(crack).collect::<Vec<_>>(),
    })
}

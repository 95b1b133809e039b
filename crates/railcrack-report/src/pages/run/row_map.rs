//! The row of many cracks: a map for selecting one of them, and a table of all.

use super::data::{nearest, pieces};
use super::facts;
use super::stored::RunFolder;
use crate::chart::{Chart, ChartAspect, ChartAxis, ChartRange};
use crate::figures::{Plot, chart};
use crate::numbers::numbers;
use crate::page::{Block, Section};
use crate::page_data::Deflated;
use crate::row::{CrackRow, CrackState, NamedCrack};
use crate::svg::ends;
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use serde_json::{Value, json};
use std::collections::BTreeMap;

const MAP: &str = include_str!("../../assets/row.html");
const MAP_SCRIPT: &str = include_str!("../../assets/row.js");
/// Maximum number of crack states on a page (cracks × steps), of about 15 bytes each.
const STATES: usize = 30_000;
/// The word for a crack that has not stopped.
const GROWS: &str = "grows";

/// The section of the `row`, with the `named` cracks highlighted.
pub(super) fn section(run: &RunFolder, row: &CrackRow, named: &[NamedCrack], plots: &[Plot]) -> Section {
    let data = data(run, row, named);
    let mut blocks = vec![Block::Viewer {
        id: "row-map",
        html: MAP,
        blocks: charts(run, row, plots).into_iter().map(Block::Chart).collect(),
        data_id: "row-data",
        data,
        script: MAP_SCRIPT,
    }];
    blocks.extend(facts::cracks(run).map(|table| Block::Folded {
        heading: format!("Table of the {} cracks", row.cracks.len()),
        blocks: vec![Block::Table(table.sortable())],
    }));
    Section::new("row", "The row of cracks", blocks)
}

/// The charts of the map: the cracks along the rail by depth and by other quantities, over all
/// steps. Without a script they show what the plots do.
fn charts(run: &RunFolder, row: &CrackRow, plots: &[Plot]) -> Vec<Chart> {
    let states = || row.cracks.iter().flat_map(|crack| &crack.states);
    let cracks = run.summary.cracks.iter();
    let points = cracks.flat_map(|crack| crack.points_mm.iter().chain(crack.path_mm.iter().flatten()));
    let [left, right] = ends(points.clone().map(|point| point[0]));
    let air = 0.008 * (right - left) + 0.2;
    let deepest = points.map(|point| -point[1]).fold(1e-6, f64::max);
    let over = |id: &str, caption: &str, y: ChartAxis| Chart {
        id: format!("row-{id}"),
        caption: caption.to_owned(),
        x: ChartAxis::linear("x along the rail", "mm").over(ChartRange::Exact([left - air, right + air])),
        y,
        curves: chart(plots, &format!("row-{id}")).map_or_else(Vec::new, |chart| chart.curves),
        aspect: ChartAspect::Long,
        ..Chart::default()
    };
    let around = |label: &str, unit: &str, of: &dyn Fn(&CrackState) -> f64| {
        let [low, high] = ends(states().map(of));
        let air = 0.06 * (high - low).max(1e-3 * high.abs()).max(1e-9);
        ChartAxis::linear(label, unit).over(ChartRange::Exact([low - air, high + air]))
    };
    let [low, high] = ends(states().map(|state| state.rate).filter(|rate| *rate > 0.0));
    let rates =
        if high > low { [0.8 * low, 1.25 * high] } else { [0.5 * high.max(1e-12), 2.0 * high.max(1e-12)] };
    let growths = row
        .cracks
        .iter()
        .flat_map(|crack| crack.states.iter().map(|state| state.length - crack.first().length));
    let [least, most] = ends(growths.chain([0.0]));
    let growths = [least - 0.06 * (most - least).max(1e-6), most + 0.06 * (most - least).max(1e-6)];
    vec![
        over(
            "depth",
            "Paths of the cracks.",
            ChartAxis::depth().over(ChartRange::Exact([0.0, 1.06 * deepest])),
        ),
        over("length", "Length of the cracks.", around("Length", "mm", &|state| state.length)),
        over(
            "growth",
            "Growth of the cracks.",
            ChartAxis::linear("Growth since step 0", "mm").over(ChartRange::Exact(growths)),
        ),
        over("keq", "ΔK_{eq} of the cracks.", around("ΔK_{eq}", "MPa√m", &|state| state.delta_keq)),
        over(
            "rate",
            "Growth rate of the cracks.",
            ChartAxis::logarithmic("Growth rate", "mm per cycle").over(ChartRange::Exact(rates)),
        ),
    ]
}

/// The places among the steps of `row` that the page has: all, or every 2ⁿ-th and the last.
fn shown_places(row: &CrackRow) -> Vec<usize> {
    let (steps, mut every) = (row.steps.len(), 1);
    while steps.div_ceil(every) * row.cracks.len() > STATES && every < steps {
        every *= 2;
    }
    (0..steps).filter(|place| place.is_multiple_of(every) || place + 1 == steps).collect()
}

/// The data of the map; what has a value per step and crack is in that order.
fn data(run: &RunFolder, row: &CrackRow, named: &[NamedCrack]) -> Value {
    let places = shown_places(row);
    let states = || places.iter().flat_map(|&place| row.cracks.iter().map(move |crack| crack.states[place]));
    let mut words = vec![GROWS];
    let mut codes = Vec::new();
    for state in states() {
        let word = state.stop.map_or(GROWS, Choice::word);
        let code = words.iter().position(|known| *known == word).unwrap_or_else(|| {
            words.push(word);
            words.len() - 1
        });
        codes.push(code as u8);
    }
    let packed =
        |of: fn(&CrackState) -> f64| Deflated::singles(&states().map(|state| of(&state)).collect::<Vec<_>>());
    let worn = run.summary.cracks.iter().any(|crack| crack.path_mm.is_some());
    let path = |crack: &railcrack_run::CrackSummary| -> Vec<Value> {
        crack.path_mm.as_ref().unwrap_or(&crack.points_mm).iter().map(|point| numbers(*point)).collect()
    };
    let (points, removed) = end_points(run, row, &places);
    json!({
        "steps": places.iter().map(|&place| row.steps[place]).collect::<Vec<_>>(),
        "last_step": row.steps.last(),
        "cycles": places.iter().map(|&place| row.cycles[place]).collect::<Vec<_>>(),
        "axle_load": run.case.axle_load,
        "mouth": numbers(row.cracks.iter().map(|crack| crack.mouth)),
        "length": packed(|state| state.length),
        "depth": packed(|state| state.depth),
        "keq": packed(|state| state.delta_keq),
        "rate": packed(|state| state.rate),
        "stop": Deflated::of(&codes),
        "stops": words.iter().map(|word| stop_words(word)).collect::<Vec<_>>(),
        "ends": Deflated::levels(&points, points.len()),
        "removed": numbers(removed),
        // Without removal of the surface, the explorer has the paths.
        "paths": worn.then(|| run.summary.cracks.iter().map(path).collect::<Vec<_>>()),
        "pieces": pieces(run),
        "named": named.iter().map(|named| json!([named.crack, named.words])).collect::<Vec<_>>(),
    })
}

/// Words for a state.
fn stop_words(word: &str) -> String {
    match word {
        "meets-crack" => "has joined another crack".to_owned(),
        "break-out" => "has broken out".to_owned(),
        "leaves-rail" => "leaves the rail".to_owned(),
        "arrest" => "is arrested".to_owned(),
        "worn-away" => "is worn away".to_owned(),
        "fracture" => "breaks the rail".to_owned(),
        other => other.to_owned(),
    }
}

/// By step and crack, the first and the last point of the path that the crack has; and what of the
/// surface is removed by step.
fn end_points(run: &RunFolder, row: &CrackRow, places: &[usize]) -> (Vec<u16>, Vec<f64>) {
    let cracks = &run.summary.cracks;
    let path = |crack: usize| cracks[crack].path_mm.as_ref().unwrap_or(&cracks[crack].points_mm);
    let index = |place: usize| u16::try_from(place).unwrap_or(u16::MAX);
    // An end without a tip is that of the final crack: a mouth, or where it has joined another one.
    let whole: Vec<[u16; 2]> =
        (0..cracks.len()).map(|crack| [0, index(path(crack).len().saturating_sub(1))]).collect();
    let mut side: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let (mut points, mut removed) = (Vec::new(), Vec::new());
    for (place, rows) in run.growth.chunk_by(|one, next| one.step == next.step).enumerate() {
        let mut of_cracks = whole.clone();
        let of_step = rows[0].removed.unwrap_or(0.0);
        for TipRow { crack, tip, place, .. } in rows {
            let Some(at) = crack.checked_sub(1).filter(|&at| at < cracks.len()) else { continue };
            // Which end of the crack is the tip's, the initial crack says.
            let end = *side
                .entry((*crack, *tip))
                .or_insert_with(|| usize::from(nearest(&cracks[at].initial_points_mm, *place) > 0));
            of_cracks[at][end] = index(nearest(path(at), [place[0], place[1] - of_step]));
        }
        if place < row.steps.len() && places.contains(&place) {
            points.extend(of_cracks.into_iter().flatten());
            removed.push(of_step);
        }
    }
    (points, removed)
}

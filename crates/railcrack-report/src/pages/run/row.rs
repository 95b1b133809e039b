//! The row of many cracks: a map for selecting one of them, and a table of all.

use super::data::{nearest, pieces};
use super::facts;
use super::stored::RunFolder;
use crate::figures::Plot;
use crate::numbers::numbers;
use crate::page::{Block, Section};
use crate::pages::pictures::still;
use crate::row::{CrackRow, NamedCrack};
use crate::shown::Deflated;
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
    let mut blocks = vec![Block::Viewer { html: MAP, data_id: "row-data", data, script: MAP_SCRIPT }];
    blocks.extend(still(plots, "row.svg", ""));
    blocks.extend(facts::cracks(run).map(|table| Block::Folded {
        heading: format!("Table of the {} cracks", row.cracks.len()),
        blocks: vec![Block::Table(table.sortable())],
    }));
    Section { id: "row".to_owned(), heading: "The row of cracks".to_owned(), blocks }
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
    let packed = |of: fn(&crate::row::CrackState) -> f64| {
        Deflated::singles(&states().map(|state| of(&state)).collect::<Vec<_>>())
    };
    let worn = run.summary.cracks.iter().any(|crack| crack.path_mm.is_some());
    let path = |crack: &railcrack_run::CrackSummary| -> Vec<Value> {
        crack.path_mm.as_ref().unwrap_or(&crack.points_mm).iter().map(|point| numbers(*point)).collect()
    };
    let (ends, removed) = ends(run, row, &places);
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
        "ends": Deflated::levels(&ends, ends.len()),
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
fn ends(run: &RunFolder, row: &CrackRow, places: &[usize]) -> (Vec<u16>, Vec<f64>) {
    let cracks = &run.summary.cracks;
    let path = |crack: usize| cracks[crack].path_mm.as_ref().unwrap_or(&cracks[crack].points_mm);
    let index = |place: usize| u16::try_from(place).unwrap_or(u16::MAX);
    // An end without a tip is that of the final crack: a mouth, or where it has joined another one.
    let whole: Vec<[u16; 2]> =
        (0..cracks.len()).map(|crack| [0, index(path(crack).len().saturating_sub(1))]).collect();
    let mut side: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let (mut ends, mut removed) = (Vec::new(), Vec::new());
    for (place, rows) in run.growth.chunk_by(|one, next| one.step == next.step).enumerate() {
        let mut now = whole.clone();
        let of_step = rows[0].removed.unwrap_or(0.0);
        for TipRow { crack, tip, place, .. } in rows {
            let Some(at) = crack.checked_sub(1).filter(|&at| at < cracks.len()) else { continue };
            // Which end of the crack is the tip's, the initial crack says.
            let end = *side
                .entry((*crack, *tip))
                .or_insert_with(|| usize::from(nearest(&cracks[at].initial_points_mm, *place) > 0));
            now[at][end] = index(nearest(path(at), [place[0], place[1] - of_step]));
        }
        if place < row.steps.len() && places.contains(&place) {
            ends.extend(now.into_iter().flatten());
            removed.push(of_step);
        }
    }
    (ends, removed)
}

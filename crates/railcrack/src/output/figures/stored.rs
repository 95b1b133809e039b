//! What the plots need of the tables.

use crate::output::OutputError;
use crate::output::csv::{FACES_FILE, Row, SIF_FILE, TipRow, read_steps, waiting};
use std::collections::BTreeMap;
use std::path::Path;

/// Steps at which the histories of a single tip are shown, at most.
const SHOWN_STEPS: usize = 5;

/// K of one tip over the stabilised passage of one step.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct History {
    pub step: usize,
    pub crack: usize,
    pub tip: usize,
    /// x_c/a by position.
    pub xc_over_a: Vec<f64>,
    /// K_I, MPa √m.
    pub ki: Vec<f64>,
    /// K_II, MPa √m.
    pub kii: Vec<f64>,
}

/// What a face point does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    Open,
    Stick,
    Slip,
}

/// The faces of one crack: `states[position][point]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CrackFaces {
    pub crack: usize,
    /// Length of the crack, mm.
    pub length: f64,
    /// Arc length of the points, mm.
    pub s: Vec<f64>,
    /// Status and pressure −s22 (MPa).
    pub states: Vec<Vec<(Status, f64)>>,
}

/// The faces of all cracks in one step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FaceMap {
    pub step: usize,
    /// x_c/a by position.
    pub xc_over_a: Vec<f64>,
    pub cracks: Vec<CrackFaces>,
}

/// The steps whose histories are shown: evenly spaced ones for a single tip, first and last for several.
pub(super) fn chosen_steps(growth: &[TipRow]) -> Vec<usize> {
    let last = growth.iter().map(|row| row.step).max().unwrap_or(0);
    let tips = growth.iter().filter(|row| row.step == 0).count();
    let count = if tips > 1 { 2 } else { SHOWN_STEPS };
    let parts = (count - 1).min(last).max(1);
    let mut steps: Vec<usize> = (0..=parts).map(|part| (part * last + parts / 2) / parts).collect();
    steps.dedup();
    steps
}

/// The stabilised passage of every tip at `steps`, in the order of the table.
pub(crate) fn read_histories(folder: &Path, steps: &[usize]) -> Result<Vec<History>, OutputError> {
    let mut histories: Vec<History> = Vec::new();
    let mut passage = 0;
    let columns = ["step", "passage", "crack", "tip", "xc_over_a", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"];
    read_steps(
        &folder.join(SIF_FILE),
        &columns,
        |step| steps.contains(&step),
        |row| {
            let (step, crack, tip) = (row.count(0)?, row.count(2)?, row.count(3)?);
            // The last passage of a step is the stabilised one: a later passage takes the place of an earlier one.
            let now = row.count(1)?;
            if now != passage {
                passage = now;
                histories.retain(|history| history.step != step);
            }
            let known = histories.last().is_some_and(|h| (h.step, h.crack, h.tip) == (step, crack, tip));
            if !known {
                histories.push(History { step, crack, tip, ..History::default() });
            }
            if let Some(history) = histories.last_mut() {
                history.xc_over_a.push(row.real(4)?);
                history.ki.push(row.real(5)?);
                history.kii.push(row.real(6)?);
            }
            Ok(())
        },
    )?;
    Ok(histories)
}

/// The faces at `step`, whose positions and lengths are those of `histories` and `growth`.
pub(super) fn read_faces(
    folder: &Path,
    step: usize,
    histories: &[History],
    growth: &[TipRow],
) -> Result<FaceMap, OutputError> {
    let mut cracks: BTreeMap<usize, CrackFaces> = BTreeMap::new();
    let columns = ["position", "crack", "s_mm", "s22_mpa", "status"];
    read_steps(
        &folder.join(FACES_FILE),
        &columns,
        |found| found == step,
        |row| {
            let (position, crack) = (row.count(0)?, row.count(1)?);
            let faces = cracks.entry(crack).or_default();
            if position == 1 {
                faces.s.push(row.real(2)?);
            }
            if faces.states.len() < position {
                faces.states.resize_with(position, Vec::new);
            }
            let state = (status(row, 4)?, -row.real(3)?);
            if let Some(states) = position.checked_sub(1).and_then(|i| faces.states.get_mut(i)) {
                states.push(state);
            }
            Ok(())
        },
    )?;
    for (&crack, faces) in &mut cracks {
        faces.crack = crack;
        let rows = || growth.iter().filter(|row| row.step == step && row.crack == crack);
        let waiting: f64 = rows().map(|row| waiting(growth, row)).sum();
        // A crack that has joined others at all its ends has no row: it reaches to a little beyond its last point.
        let last = || faces.s.last().copied().unwrap_or(0.0);
        faces.length = rows().next().map_or_else(last, |row| row.length - waiting);
    }
    let xc_over_a =
        histories.iter().find(|history| history.step == step).map_or_else(Vec::new, |h| h.xc_over_a.clone());
    Ok(FaceMap { step, xc_over_a, cracks: cracks.into_values().collect() })
}

fn status(row: &Row, i: usize) -> Result<Status, OutputError> {
    match row.text(i) {
        "open" => Ok(Status::Open),
        "stick" => Ok(Status::Stick),
        "slip" => Ok(Status::Slip),
        _ => Err(row.unreadable(i, "open, stick or slip")),
    }
}

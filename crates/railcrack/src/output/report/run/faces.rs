//! The faces of the cracks, as the page holds them.

use crate::output::OutputError;
use crate::output::csv::{FACES_FILE, StepBlock, read_step_blocks};
use crate::output::report::pack::{packed_bytes, packed_singles, quantised};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Steps that are packed at once: as many as may stand in memory.
const AT_ONCE: usize = 4;

const COLUMNS: [&str; 8] =
    ["position", "crack", "s_mm", "opening_mm", "slip_mm", "s22_mpa", "s12_mpa", "status"];

/// The faces of one crack; what has a value per position and point is in that order.
#[derive(Debug, Default)]
struct CrackFaces {
    s: Vec<f64>,
    opening: Vec<f64>,
    slip: Vec<f64>,
    pressure: Vec<f64>,
    shear: Vec<f64>,
    status: Vec<u8>,
}

/// The faces in every step of `steps`, in this order, at the positions that are `kept` (numbers from 1).
///
/// Errors: the table is damaged; the system refuses.
pub(super) fn packed_faces(
    folder: &Path,
    steps: &BTreeSet<usize>,
    kept: impl Fn(usize) -> bool + Sync,
) -> Result<BTreeMap<usize, Value>, OutputError> {
    let path = folder.join(FACES_FILE);
    let mut packed = BTreeMap::new();
    let mut waiting = Vec::new();
    let mut pack = |waiting: &mut Vec<StepBlock>| -> Result<(), OutputError> {
        let ready: Result<Vec<(usize, Value)>, OutputError> =
            waiting.par_iter().map(|block| Ok((block.step, packed_step(block, &kept)?))).collect();
        packed.extend(ready?);
        waiting.clear();
        Ok(())
    };
    read_step_blocks(
        &path,
        &COLUMNS,
        |step| steps.contains(&step),
        |block| {
            waiting.push(block);
            if waiting.len() == AT_ONCE { pack(&mut waiting) } else { Ok(()) }
        },
    )?;
    pack(&mut waiting)?;
    Ok(packed)
}

fn packed_step(block: &StepBlock, kept: &impl Fn(usize) -> bool) -> Result<Value, OutputError> {
    let mut cracks: BTreeMap<usize, CrackFaces> = BTreeMap::new();
    let mut first = None;
    block.rows(|row| {
        let position = row.count(0)?;
        if !kept(position) {
            return Ok(());
        }
        let faces = cracks.entry(row.count(1)?).or_default();
        if *first.get_or_insert(position) == position {
            faces.s.push(row.real(2)?);
        }
        faces.opening.push(row.real(3)?);
        faces.slip.push(row.real(4)?);
        faces.pressure.push(-row.real(5)?);
        faces.shear.push(row.real(6)?);
        faces.status.push(match row.text(7) {
            "open" => 0,
            "stick" => 1,
            "slip" => 2,
            _ => return Err(row.unreadable(7, "open, stick or slip")),
        });
        Ok(())
    })?;
    let crack = |(crack, faces): (usize, CrackFaces)| {
        let points = faces.s.len();
        let positions = faces.status.len() / points.max(1);
        let along = |values: &[f64]| quantised(&by_point(values, points), positions);
        json!({
            "crack": crack,
            "s": packed_singles(&faces.s),
            "opening": along(&faces.opening),
            "slip": along(&faces.slip),
            "pressure": along(&faces.pressure),
            "shear": along(&faces.shear),
            "status": packed_bytes(&by_point(&faces.status, points)),
        })
    };
    Ok(Value::Array(cracks.into_iter().map(crack).collect()))
}

/// Values by position and point as values by point and position: along the passage they change little.
fn by_point<T: Copy>(values: &[T], points: usize) -> Vec<T> {
    (0..points).flat_map(|point| values.iter().skip(point).step_by(points.max(1)).copied()).collect()
}

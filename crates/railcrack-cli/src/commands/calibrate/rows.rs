//! The growth of a run that is compared with measurements.

use crate::exit::Failure;
use railcrack_run::RunFolder;
use railcrack_run::csv::TipRow;
use std::path::Path;

/// The rows of the run in `folder` of the tip that is deepest in its last step.
pub(super) fn deepest(folder: &Path) -> Result<Vec<TipRow>, Failure> {
    let growth =
        RunFolder::open(folder).and_then(|run| run.growth()).map_err(|error| Failure::Run(error.into()))?;
    let last = growth.last().map_or(0, |row| row.step);
    let tips = growth.iter().filter(|row| row.step == last);
    let Some(deepest) = tips.reduce(|a, b| if b.place[1] < a.place[1] { b } else { a }) else {
        return Ok(Vec::new());
    };
    Ok(growth.iter().filter(|row| (row.crack, row.tip) == (deepest.crack, deepest.tip)).copied().collect())
}

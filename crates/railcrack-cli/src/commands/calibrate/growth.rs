//! The growth of a run that is compared with measurements.

use crate::exit::Failure;
use railcrack_run::RunFolder;
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::{Ending, RunEntry, Simulation};
use std::path::Path;

/// Runs `simulation` in `folder`: the rows of the tip that is deepest in its last step; none where
/// it is interrupted.
pub(super) fn deepest_tip(
    simulation: &Simulation,
    folder: &Path,
    entry: RunEntry,
) -> Result<Option<Vec<TipRow>>, Failure> {
    if simulation.run_in(folder, entry)?.ending == Ending::Interrupted {
        return Ok(None);
    }
    let growth =
        RunFolder::open(folder).and_then(|run| run.growth()).map_err(|error| Failure::Run(error.into()))?;
    let last = growth.last().map_or(0, |row| row.step);
    let tips = growth.iter().filter(|row| row.step == last);
    let Some(deepest) = tips.reduce(|a, b| if b.place[1] < a.place[1] { b } else { a }) else {
        return Ok(Some(Vec::new()));
    };
    let of_tip = growth.iter().filter(|row| (row.crack, row.tip) == (deepest.crack, deepest.tip));
    Ok(Some(of_tip.copied().collect()))
}

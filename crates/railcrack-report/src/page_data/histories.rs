//! K over the stabilised passages.

use super::step_table::StepTable;
use super::thinned::Thinned;
use crate::chart::CATEGORIES;
use railcrack_run::OutputError;
use railcrack_run::csv::{SifRow, StepBlock};
use railcrack_run::run_folder::History;

/// Maximum number of values of K shown (tips × positions × steps), for a page below 3 MB.
const VALUES: usize = 300_000;
/// The same for many tips, of which the page shows the part near each crack.
const OF_MANY: usize = 4 * VALUES;

/// The histories of the steps shown, by wheel. Those of a mix in the plane may take twice as much.
#[derive(Debug, Clone, Default)]
pub(crate) struct HistoryData {
    pub steps: Thinned<Vec<Vec<History>>>,
}

impl StepTable for HistoryData {
    type OfStep = Vec<Vec<History>>;
    type TableRow = SifRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<SifRow>) -> Result<Vec<Vec<History>>, OutputError> {
        History::by_wheel(block.rows())
    }

    fn push(&mut self, step: usize, wheels: Vec<Vec<History>>) {
        let tips = wheels.first().map_or(0, Vec::len);
        let most = if tips > CATEGORIES { OF_MANY } else { VALUES };
        let is_in_space = wheels.iter().flatten().any(|history| !history.kiii.is_empty());
        let times = if is_in_space { 1 } else { wheels.len().min(2) };
        self.steps.push(step, wheels);
        let values = |wheels: &Vec<Vec<History>>| {
            wheels.iter().flatten().map(|history| history.ki.len()).sum::<usize>()
        };
        self.steps.thin_to(times * most, values);
    }
}

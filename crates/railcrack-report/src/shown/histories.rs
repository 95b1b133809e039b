//! K over the stabilised passages.

use super::of_steps::OfSteps;
use super::thinned::Thinned;
use crate::chart::CATEGORIES;
use railcrack_run::OutputError;
use railcrack_run::csv::{SifRow, StepBlock};
use railcrack_run::run_folder::History;

/// Maximum number of values of K shown (tips × positions × steps), for a page below 3 MB.
const VALUES: usize = 300_000;
/// The same for many tips, of which the page shows the part near each crack.
const OF_MANY: usize = 4 * VALUES;

/// The histories of the steps shown.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShownHistories {
    pub steps: Thinned<Vec<History>>,
}

impl OfSteps for ShownHistories {
    type OfStep = Vec<History>;
    type TableRow = SifRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<SifRow>) -> Result<Vec<History>, OutputError> {
        History::of_step(block.rows())
    }

    fn push(&mut self, step: usize, histories: Vec<History>) {
        let most = if histories.len() > CATEGORIES { OF_MANY } else { VALUES };
        self.steps.push(step, histories);
        self.steps.thin_to(most, |histories| histories.iter().map(|history| history.ki.len()).sum());
    }
}

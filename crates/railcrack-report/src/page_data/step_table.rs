//! Parts of a table of the run folder, collected step by step.

use railcrack_run::OutputError;
use railcrack_run::csv::{StepBlock, StepBlocks, Table};
use rayon::prelude::*;
use std::path::Path;

/// Number of steps of a table read at once, limited by memory.
const AT_ONCE: usize = 4;

/// Parts of a table, collected step by step.
pub(super) trait StepTable: Sync {
    /// The part of one step.
    type OfStep: Send;
    /// The rows of the table.
    type TableRow: Table;

    /// Whether a step is shown once there are newer ones, as far as is known by now.
    fn keeps(&self, step: usize) -> bool;

    /// Errors: the table is damaged.
    fn read(&self, block: &StepBlock<Self::TableRow>) -> Result<Self::OfStep, OutputError>;

    /// Adds the step after the last one. Steps that are not kept may be omitted.
    fn push(&mut self, step: usize, part: Self::OfStep);
}

/// The shown part of a table for the first `steps` steps of the run in `folder`.
///
/// Errors: the table is damaged; the system refuses.
pub(super) fn read_table<S: StepTable + Default>(folder: &Path, steps: usize) -> Result<S, OutputError> {
    let mut shown = S::default();
    let mut waiting: Vec<StepBlock<S::TableRow>> = Vec::new();
    let take = |shown: &mut S, waiting: &mut Vec<StepBlock<S::TableRow>>| -> Result<(), OutputError> {
        let read = |block: &StepBlock<S::TableRow>| Ok((block.step, shown.read(block)?));
        let parts: Result<Vec<_>, OutputError> = waiting.par_iter().map(read).collect();
        waiting.clear();
        parts?.into_iter().for_each(|(step, part)| shown.push(step, part));
        Ok(())
    };
    for block in StepBlocks::open(folder, 0..steps)? {
        let block = block?;
        if shown.keeps(block.step) || block.step + 1 == steps {
            waiting.push(block);
        }
        if waiting.len() == AT_ONCE {
            take(&mut shown, &mut waiting)?;
        }
    }
    take(&mut shown, &mut waiting)?;
    Ok(shown)
}

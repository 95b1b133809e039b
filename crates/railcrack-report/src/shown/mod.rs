//! Histories of K, crack faces and fields as plots and page show them, beyond the short tables of a
//! run. It is gathered step by step, from the records of a run that is being computed or from the
//! files of one that was, and holds no more than is shown. Both give the same numbers, since the
//! tables hold every number to its last bit.

mod faces;
mod histories;
mod neighbourhood;
mod pack;
mod thinned;

use faces::{FacesOfStep, ShownFaces};
use histories::ShownHistories;
use neighbourhood::PackedFields;
use railcrack::growth::StepRecord;
use railcrack_run::OutputError;
use railcrack_run::csv::{SifRow, SifScale, StepBlock, StepBlocks, Table};
use railcrack_run::histories::History;
use rayon::prelude::*;
use std::path::Path;
use thinned::Thinned;

pub(crate) use faces::{CrackFaces, PackedFaces, StepFaces};
pub(crate) use neighbourhood::ShownFields;
pub(crate) use pack::Deflated;

/// Steps of a table that are read at once: as many as may stand in memory.
const AT_ONCE: usize = 4;

/// Parts of a table, gathered step by step.
trait OfSteps: Sync {
    /// The part of one step.
    type Part: Send;
    /// The rows of the table.
    type Row: Table;

    /// Whether a step is shown once there are newer ones, as far as is known by now.
    fn keeps(&self, step: usize) -> bool;

    /// Errors: the table is damaged.
    fn read(&self, block: &StepBlock<Self::Row>) -> Result<Self::Part, OutputError>;

    /// Takes up the step after the last one. Steps that are not kept may be left out.
    fn push(&mut self, step: usize, part: Self::Part);
}

/// The shown part of a table for the first `steps` steps of the run in `folder`.
///
/// Errors: the table is damaged; the system refuses.
fn read_table<S: OfSteps + Default>(folder: &Path, steps: usize) -> Result<S, OutputError> {
    let mut shown = S::default();
    let mut waiting: Vec<StepBlock<S::Row>> = Vec::new();
    let take = |shown: &mut S, waiting: &mut Vec<StepBlock<S::Row>>| -> Result<(), OutputError> {
        let read = |block: &StepBlock<S::Row>| Ok((block.step, shown.read(block)?));
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

/// The shown part of a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShownRun {
    histories: ShownHistories,
    faces: ShownFaces,
    pub fields: ShownFields,
}

/// The shown part of one step.
#[derive(Debug)]
pub(crate) struct ShownStep {
    step: usize,
    histories: Vec<History>,
    faces: FacesOfStep,
    fields: Option<PackedFields>,
}

impl ShownRun {
    /// The shown part of the first `steps` steps of the run in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    pub(crate) fn read(folder: &Path, steps: usize) -> Result<Self, OutputError> {
        if steps == 0 {
            return Ok(Self::default());
        }
        let (faces, (histories, fields)) = rayon::join(
            || read_table(folder, steps),
            || (read_table(folder, steps), ShownFields::read(folder, steps)),
        );
        // In the order in which a reader of the folder would meet what is wrong.
        Ok(Self { histories: histories?, faces: faces?, fields: fields? })
    }

    /// The shown part of a recorded step.
    ///
    /// Errors: its fields do not belong together.
    pub(crate) fn of_record(&self, record: &StepRecord, scale: SifScale) -> Result<ShownStep, OutputError> {
        Ok(ShownStep {
            step: record.step,
            histories: History::of_step(SifRow::of_step(record, scale).map(Ok))?,
            faces: self.faces.of_record(record)?,
            fields: ShownFields::of_record(record)?,
        })
    }

    /// Takes up the step after the last one.
    pub(crate) fn push(&mut self, step: ShownStep) {
        self.histories.push(step.step, step.histories);
        self.faces.push(step.step, step.faces);
        if let Some(fields) = step.fields {
            self.fields.push(fields);
        }
    }

    /// The steps that are shown: the first and the last among them.
    pub(crate) fn steps(&self) -> Vec<usize> {
        let steps = self.histories.steps.iter().map(|(step, _)| step);
        steps.filter(|&step| self.faces.steps.get(step).is_some()).collect()
    }

    /// K of the tips in a step that is shown.
    pub(crate) fn histories(&self, step: usize) -> &[History] {
        self.histories.steps.get(step).map_or(&[], Vec::as_slice)
    }

    /// The crack faces in a step that is shown.
    pub(crate) fn faces(&self, step: usize) -> Option<&PackedFaces> {
        self.faces.steps.get(step)
    }

    /// Every how many positions [`ShownRun::faces`] has.
    pub(crate) fn face_stride(&self) -> usize {
        self.faces.stride
    }

    /// Status and pressure on the crack faces: of the first step, and of the last where it is
    /// another one.
    pub(crate) fn end_faces(&self) -> impl Iterator<Item = (usize, &StepFaces)> {
        self.faces.ends.iter().map(|(step, faces)| (*step, faces))
    }
}

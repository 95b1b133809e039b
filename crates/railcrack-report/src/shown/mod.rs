//! The long results of a run as plots and page show them: K, crack faces, fields. It is
//! gathered step by step, from the records of a run that is being computed or from the files of one
//! that was, and holds no more than is shown. Both give the same numbers, since the tables hold
//! every number to its last bit.

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
use railcrack_run::csv::{SifScale, StepBlock, read_step_blocks};
use railcrack_run::histories::History;
use rayon::prelude::*;
use std::path::Path;
use thinned::Thinned;

pub(crate) use faces::{CrackFaces, PackedFaces, StepFaces};
pub(crate) use neighbourhood::ShownFields;
pub(crate) use pack::Deflated;

/// Steps of a table that are read at once: as many as may stand in memory.
const AT_ONCE: usize = 4;

/// A selection from a table, gathered step by step.
trait OfSteps: Sync {
    /// The selection from one step.
    type Part: Send;
    /// The table.
    const FILE: &'static str;
    /// Its columns that are needed.
    const COLUMNS: &'static [&'static str];

    /// Whether a step is shown once there are newer ones, as far as is known by now.
    fn keeps(&self, step: usize) -> bool;

    /// Errors: the table is damaged.
    fn read(&self, block: &StepBlock) -> Result<Self::Part, OutputError>;

    /// Takes up the step after the last one. Steps that are not kept may be left out.
    fn push(&mut self, step: usize, part: Self::Part);
}

/// The selection from a table for the first `steps` steps of the run in `folder`.
///
/// Errors: the table is damaged; the system refuses.
fn read_table<S: OfSteps + Default>(folder: &Path, steps: usize) -> Result<S, OutputError> {
    let path = folder.join(S::FILE);
    let mut shown = S::default();
    let mut pending: Vec<StepBlock> = Vec::new();
    let take = |shown: &mut S, pending: &mut Vec<StepBlock>| -> Result<(), OutputError> {
        let read = |block: &StepBlock| Ok((block.step, shown.read(block)?));
        let parts: Result<Vec<_>, OutputError> = pending.par_iter().map(read).collect();
        pending.clear();
        parts?.into_iter().for_each(|(step, part)| shown.push(step, part));
        Ok(())
    };
    read_step_blocks(
        &path,
        S::COLUMNS,
        |step| step < steps,
        |block| {
            if shown.keeps(block.step) || block.step + 1 == steps {
                pending.push(block);
            }
            if pending.len() == AT_ONCE { take(&mut shown, &mut pending) } else { Ok(()) }
        },
    )?;
    take(&mut shown, &mut pending)?;
    Ok(shown)
}

/// The long results of a run, as far as they are shown.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShownRun {
    histories: ShownHistories,
    faces: ShownFaces,
    pub fields: ShownFields,
}

/// The selection from one step.
#[derive(Debug)]
pub(crate) struct ShownStep {
    step: usize,
    histories: Vec<History>,
    faces: FacesOfStep,
    fields: Option<PackedFields>,
}

impl ShownRun {
    /// The selection from the first `steps` steps of the run in `folder`.
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

    /// The selection from a recorded step.
    ///
    /// Errors: its fields do not belong together.
    pub(crate) fn of_record(&self, record: &StepRecord, scale: SifScale) -> Result<ShownStep, OutputError> {
        Ok(ShownStep {
            step: record.step,
            histories: History::of_record(record, scale),
            faces: self.faces.of_record(record),
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

//! The data that a page shows of a run, and of its tables step by step.

use super::contact::{ContactData, ContactOfStep, PackedContact};
use super::faces::{CrackWindows, FacesData, FacesOfStep, OtherFaces, PackedFaces, StepFaces};
use super::fields::{FieldData, PackedFields};
use super::step_table::{StepTable, read_table};
use super::thinned::HistoryData;
use railcrack::growth::StepRecord;
use railcrack_run::OutputError;
use railcrack_run::csv::{ContactRow, SifRow, SifScale, Table};
use railcrack_run::run_folder::History;
use std::ops::Range;
use std::path::Path;

/// The shown part of a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct PageData {
    histories: HistoryData,
    faces: FacesData,
    contact: ContactData,
    pub fields: FieldData,
}

/// The shown part of one step.
#[derive(Debug)]
pub(crate) struct PageStep {
    step: usize,
    histories: Vec<Vec<History>>,
    faces: FacesOfStep,
    contact: ContactOfStep,
    fields: Option<PackedFields>,
}

impl PageData {
    /// The shown part of the first `steps` steps of the run in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    pub(crate) fn read(folder: &Path, steps: usize) -> Result<Self, OutputError> {
        if steps == 0 {
            return Ok(Self::default());
        }
        let (faces, (histories, fields)) = rayon::join(
            || read_table(folder, steps),
            || (read_table(folder, steps), FieldData::read(folder, steps)),
        );
        // Only wheels that feel the cracks have this table.
        let is_coupled = folder.join(ContactRow::FILE).is_file();
        let contact = if is_coupled { read_table(folder, steps)? } else { ContactData::default() };
        // In the order of the files, so that the first error is reported.
        Ok(Self { histories: histories?, faces: faces?, contact, fields: fields? })
    }

    /// The shown part of a recorded step.
    ///
    /// Errors: its fields do not belong together.
    pub(crate) fn of_record(&self, record: &StepRecord, scale: &SifScale) -> Result<PageStep, OutputError> {
        Ok(PageStep {
            step: record.step,
            histories: History::by_wheel(SifRow::of_step(record, scale).map(Ok))?,
            faces: self.faces.of_record(record)?,
            contact: ContactData::of_record(record)?,
            fields: FieldData::of_record(record)?,
        })
    }

    /// Adds the step after the last one.
    pub(crate) fn push(&mut self, step: PageStep) {
        self.histories.push(step.step, step.histories);
        self.faces.push(step.step, step.faces);
        self.contact.push(step.step, step.contact);
        if let Some(fields) = step.fields {
            self.fields.push(fields);
        }
    }

    /// The steps that are shown: the first and the last among them.
    pub(crate) fn steps(&self) -> Vec<usize> {
        let steps = self.histories.steps.iter().map(|(step, _)| step);
        steps.filter(|&step| self.faces.steps.get(step).is_some()).collect()
    }

    /// K of the tips under the first wheel in a step that is shown.
    pub(crate) fn histories(&self, step: usize) -> &[History] {
        self.by_wheel(step).first().map_or(&[], Vec::as_slice)
    }

    /// K of the tips under every wheel in a step that is shown.
    pub(crate) fn by_wheel(&self, step: usize) -> &[Vec<History>] {
        self.histories.steps.get(step).map_or(&[], Vec::as_slice)
    }

    /// The crack faces in a step that is shown.
    pub(crate) fn faces(&self, step: usize) -> Option<&PackedFaces> {
        self.faces.steps.get(step)
    }

    /// The pressures of `wheel`, from 0, if it feels the cracks, in a step that is shown.
    pub(crate) fn contact(&self, wheel: usize, step: usize) -> Option<&PackedContact> {
        self.contact.under(wheel, step)
    }

    /// The crack faces under the other wheels of a mix; of many cracks, of those in the windows of
    /// each wheel.
    pub(crate) fn other_faces(&self, windows: Option<&[CrackWindows]>) -> OtherFaces {
        self.faces.others(windows)
    }

    /// Of many cracks the faces in a step, the first or the last, of those of `windows`, by number.
    pub(crate) fn faces_of(&self, step: usize, windows: &[(usize, Range<usize>)]) -> Option<PackedFaces> {
        self.faces.near(step, windows)
    }

    /// Stride of the positions in [`PageData::faces`].
    pub(crate) fn face_stride(&self) -> usize {
        self.faces.stride
    }

    /// Status and pressure on the crack faces: of the first step, and of the last where it is
    /// another one.
    pub(crate) fn end_faces(&self) -> impl Iterator<Item = (usize, &StepFaces)> {
        self.faces.ends.iter().map(|(step, faces)| (*step, faces))
    }
}

//! Plots and pages of results, made by a crate above this one as results become available, or not
//! at all.

use crate::csv::SifScale;
use crate::error::OutputError;
use crate::study::{StudyFolder, StudyResults};
use railcrack::growth::StepRecord;
use railcrack_case::Output;
use std::fmt::Debug;
use std::path::Path;

/// Maker of plots and pages from the results.
pub trait Presentation: Sync {
    /// Gathers what is shown of a run from its beginning; `output` selects what is shown.
    fn run(&self, output: Output) -> Box<dyn RunPresentation>;

    /// Gathers what is shown of a resumed run: its folder has the first `steps` steps.
    ///
    /// Errors: a file is damaged; the system refuses.
    fn resumed_run(
        &self,
        folder: &Path,
        steps: usize,
        output: Output,
    ) -> Result<Box<dyn RunPresentation>, OutputError>;

    /// Plots and page of the stabilised plastic state in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    fn shakedown(&self, _folder: &Path) -> Result<(), OutputError> {
        Ok(())
    }

    /// Plots and page of the grinding plans in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    fn plan(&self, _folder: &Path) -> Result<(), OutputError> {
        Ok(())
    }

    /// Plots and page of the comparison in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    fn comparison(&self, _folder: &Path) -> Result<(), OutputError> {
        Ok(())
    }

    /// Plots and page of the study in `folder` with its present `results`.
    ///
    /// Errors: the system refuses.
    fn study(&self, _folder: &StudyFolder, _results: &StudyResults) -> Result<(), OutputError> {
        Ok(())
    }
}

/// Plots and page of one run, gathered step by step.
pub trait RunPresentation: Debug + Send {
    /// Takes what is shown of the step `record`. It counts once the step is [kept](Self::keep).
    ///
    /// Errors: its fields do not belong together.
    fn take(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError>;

    /// Keeps the step that was taken last: its files are written.
    fn keep(&mut self);

    /// Writes plots and page of the run in `folder`.
    ///
    /// Errors: a file is damaged; the system refuses.
    fn finish(&self, folder: &Path) -> Result<(), OutputError>;
}

/// No plots and pages: tables and summaries only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TablesOnly;

impl Presentation for TablesOnly {
    fn run(&self, _: Output) -> Box<dyn RunPresentation> {
        Box::new(Self)
    }

    fn resumed_run(&self, _: &Path, _: usize, _: Output) -> Result<Box<dyn RunPresentation>, OutputError> {
        Ok(Box::new(Self))
    }
}

impl RunPresentation for TablesOnly {
    fn take(&mut self, _: &StepRecord, _: &SifScale) -> Result<(), OutputError> {
        Ok(())
    }

    fn keep(&mut self) {}

    fn finish(&self, _: &Path) -> Result<(), OutputError> {
        Ok(())
    }
}

//! Files that may be cases or studies.

use super::expand::Study;
use super::variation::is_study;
use crate::case::{Case, Overrides};
use crate::schema::{CaseErrors, Report, Source, from_file, parse_document};
use std::path::Path;

/// A case or a study.
#[derive(Debug, Clone)]
pub enum Input {
    /// One case.
    Case(Box<Case>),
    /// A study: it has `[study]`, or a list instead of a value.
    Study(Box<Study>),
}

impl Input {
    /// The case or study in the file `path`, with `overrides` replacing values in it.
    ///
    /// Errors: all of the file.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        from_file(path, |text, name, folder| Self::parse_with(text, name, folder, overrides))
    }

    /// The case or study written in `text`, with `overrides` replacing values in it; errors
    /// call it `name`, relative file names are relative to `folder`.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        if says_study(text) {
            let study = Study::parse_with(text, name, folder, overrides)?;
            return Ok(Self::Study(Box::new(study)));
        }
        Case::parse_with(text, name, folder, overrides).map(|case| Self::Case(Box::new(case)))
    }
}

fn says_study(text: &str) -> bool {
    let mut report = Report::new(Source::new("", text));
    parse_document(text, &mut report).is_some_and(|root| is_study(root.get_ref()))
}

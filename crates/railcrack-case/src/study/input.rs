//! Files that may be cases or studies.

use super::expand::Study;
use super::variation::is_study;
use crate::case::{Case, Overrides};
use crate::schema::{CaseErrors, Report, Source, parse_document, read_file};
use std::path::Path;
use std::sync::Arc;

/// A case or a study.
#[derive(Debug, Clone)]
pub enum Input {
    /// One case.
    Case(Box<Case>),
    /// A study: it has `[study]`, or a list in place of a value.
    Study(Box<Study>),
}

impl Input {
    /// The case or study in the file `path`.
    ///
    /// Errors: all of the file.
    pub fn read(path: &Path) -> Result<Self, CaseErrors> {
        Self::read_with(path, &Overrides::default())
    }

    /// The same with `overrides` in place of the values in the file.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        let source = read_file(path)?;
        Self::parse_with(&source.text, &source.name, path.parent().unwrap_or(Path::new("")), overrides)
    }

    /// The case or study written in `text`; errors call it `name`, relative file names are relative
    /// to `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, CaseErrors> {
        Self::parse_with(text, name, folder, &Overrides::default())
    }

    /// The same with `overrides` in place of the values in the text.
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
    let mut report = Report::new(Source { name: String::new(), text: Arc::from(text) });
    parse_document(text, &mut report).is_some_and(|root| is_study(root.get_ref()))
}

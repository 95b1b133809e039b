//! Files that may be cases or studies.

use super::expand::Study;
use super::variation::is_study;
use crate::case::{Case, Overrides};
use crate::schema::{CaseErrors, Report, Source, parse_document};
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
        match std::fs::read_to_string(path) {
            Ok(text) if says_study(&text) => {
                Study::read_with(path, &Overrides::default()).map(|study| Self::Study(Box::new(study)))
            }
            // The reader of cases knows what to say of a file that cannot be read.
            _ => Case::read(path).map(|case| Self::Case(Box::new(case))),
        }
    }

    /// The case or study written in `text`; errors call it `name`, relative file names are relative
    /// to `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, CaseErrors> {
        if says_study(text) {
            let study = Study::parse_with(text, name, folder, &Overrides::default())?;
            return Ok(Self::Study(Box::new(study)));
        }
        Case::parse(text, name, folder).map(|case| Self::Case(Box::new(case)))
    }
}

fn says_study(text: &str) -> bool {
    let mut report = Report::new(Source { name: String::new(), text: Arc::from(text) });
    parse_document(text, &mut report).is_some_and(|root| is_study(root.get_ref()))
}

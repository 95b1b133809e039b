//! Why a page does not compute a case.

use railcrack_case::{CaseError, CaseErrors, NotInPage};
use railcrack_run::simulation::RunError;
use serde_json::{Value, json};

/// An error of a case, or a reason why it is not computed: a sentence, with its place in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Key, value given and what is accepted.
    pub message: String,
    /// The key with its section.
    pub key: Option<String>,
    /// Line and column in the text of the case, from 1.
    pub position: Option<(usize, usize)>,
    /// A remedy.
    pub help: Option<String>,
}

impl Refusal {
    /// A reason why a page does not compute a case.
    pub(crate) fn of_page(reason: &NotInPage) -> Self {
        let NotInPage { key, message, help } = reason;
        let help = format!("{help}, or compute the case with the program");
        Self { message: message.clone(), key: Some((*key).into()), position: None, help: Some(help) }
    }

    /// A run that failed.
    pub(crate) fn of_run(error: &RunError) -> Self {
        Self { message: error.to_string(), key: None, position: None, help: None }
    }

    /// All errors of a case.
    pub(crate) fn of_case(errors: &CaseErrors) -> Vec<Self> {
        let of = |error: &CaseError| Self {
            message: error.message().into(),
            key: error.key().map(Into::into),
            position: error.position(),
            help: error.help().map(Into::into),
        };
        errors.errors().iter().map(of).collect()
    }

    /// As an object of JSON.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let Self { message, key, position, help } = self;
        let (line, column) = position.unzip();
        json!({ "message": message, "key": key, "line": line, "column": column, "help": help })
    }
}

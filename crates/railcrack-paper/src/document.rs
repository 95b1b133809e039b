//! `statements.json`: the decisions of `railcrack paper`.

use railcrack_run::OutputError;
use railcrack_run::disk::{Durability, read_if_there, replace_file};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name of the file.
pub const STATEMENTS_FILE: &str = "statements.json";

/// All statements and decisions of `railcrack paper`. Keys are the names of the fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperRecord {
    /// Version of the program.
    pub version: String,
    /// Number of runs.
    pub runs: usize,
    /// The figures that were recomputed, in their order.
    pub figures: Vec<FigureRecord>,
    /// The curves of these figures.
    pub curves: Vec<CurveRecord>,
    /// The set-ups that were computed, the main ones first.
    pub setups: Vec<SetupRecord>,
    /// The statements that these figures decide.
    pub statements: Vec<StatementRecord>,
    /// Runs that a step ended early.
    pub failures: Vec<FailureRecord>,
}

/// A figure: `figures/fig13.svg` and `figures/fig13.csv`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FigureRecord {
    /// Its number in the paper.
    pub number: u8,
    /// Its title.
    pub title: String,
}

/// A curve of the figures.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CurveRecord {
    /// Its name in the tables.
    pub name: String,
    /// Its words in a legend.
    pub legend: String,
}

/// One choice of the inputs that the paper does not specify.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetupRecord {
    /// Its name in the tables.
    pub name: String,
    /// Its description.
    pub words: String,
    /// The set-up that it varies; null for the main ones.
    pub varies: Option<String>,
}

/// A statement of the paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StatementRecord {
    /// Its name.
    pub id: String,
    /// Where the paper says it.
    pub place: String,
    /// The statement.
    pub statement: String,
    /// When it counts as true.
    pub rule: String,
    /// The verdict over all set-ups.
    pub verdict: String,
    /// The reason, as far as known; empty otherwise.
    pub why: String,
    /// The decision in each set-up.
    pub decisions: Vec<DecisionRecord>,
}

/// The decision on a statement in one set-up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DecisionRecord {
    /// The set-up.
    pub setup: String,
    /// Whether the statement holds in it.
    pub holds: bool,
    /// The numbers that decide.
    pub numbers: Vec<NumberRecord>,
    /// Warnings of the runs behind it, a sentence for each run that has any.
    #[serde(default)]
    pub warnings: Vec<String>,
}

/// A number that decides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NumberRecord {
    /// Its description.
    pub name: String,
    /// Its value; null where it is not finite.
    pub value: Option<f64>,
}

/// A run that ended early.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FailureRecord {
    /// Its name.
    pub run: String,
    /// Why.
    pub reason: String,
}

impl StatementRecord {
    /// The decision in `setup`; none where it does not decide.
    pub fn decision(&self, setup: &str) -> Option<&DecisionRecord> {
        self.decisions.iter().find(|decision| decision.setup == setup)
    }
}

impl PaperRecord {
    /// The set-ups that vary no other.
    pub fn main_setups(&self) -> impl Iterator<Item = &SetupRecord> {
        self.setups.iter().filter(|setup| setup.varies.is_none())
    }

    /// The record in `folder`.
    ///
    /// Errors: there is none; it is damaged; the system refuses.
    pub fn read(folder: &Path) -> Result<Self, OutputError> {
        let path = folder.join(STATEMENTS_FILE);
        let Some(text) = read_if_there(&path)? else {
            return Err(OutputError::NothingToReport { folder: folder.to_path_buf() });
        };
        serde_json::from_slice(&text).map_err(|reason| OutputError::damaged(&path, reason.to_string()))
    }

    /// Writes the record into `folder`.
    ///
    /// Errors: the system refuses.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(STATEMENTS_FILE);
        let mut text = serde_json::to_string_pretty(self)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        text.push('\n');
        replace_file(&path, text.as_bytes(), Durability::Cached)
    }
}

//! `summary.json`: a run in numbers, its warnings, and how it ended.

mod condensed;
mod document;
mod outcome;
mod parts;
pub mod validity;

pub use document::Summary;
pub(crate) use document::finite_summary;
pub use outcome::{Outcome, RunEnd};
pub use parts::{
    CrackSummary, FractureSummary, FrontSummary, JunctionSummary, PhaseSeconds, PieceSummary, TipSummary,
    WarningSummary,
};

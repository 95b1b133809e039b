//! The results of Trollé et al. 2014 recomputed: every figure, and every statement of the text
//! compared with the numbers.
//!
//! [`curves`](CURVES) are the cases of the paper, [`SETUPS`] the choices that it leaves open,
//! [`CLAIMS`] its statements, each with the rule that decides it. [`reproduce`] computes what the
//! chosen figures need and writes figures, tables and the page.

mod case_run;
mod claim;
mod claims;
mod closest;
mod computation;
mod curve;
mod document;
mod edit;
mod error;
mod figure;
mod figure_group;
mod figures;
mod files;
mod group_page;
mod increment;
mod measure;
mod page;
mod path_shape;
mod plan;
mod profile;
mod record;
mod report_page;
mod reproduce;
mod results;
mod rolled;
mod setup;
mod steel;
mod stored;
mod telling;
mod verdict;

pub use case_run::{CaseRun, CrackGrowth, Effort, SifCurve};
pub use claim::{Claim, Decision, Number};
pub use claims::CLAIMS;
pub use curve::{CURVES, PaperCurve};
pub use document::STATEMENTS_FILE;
pub use error::PaperError;
pub use figure::{FIGURES, Figure, UnknownFigure, parse_figures};
pub use figure_group::{FigureGroup, GROUPS};
pub use figures::Overlay;
pub use path_shape::{Branch, PathShape, Side};
pub use reproduce::{Reproduction, rebuild_report, reproduce};
pub use results::{Results, SetupResults};
pub use setup::{Extent, SETUPS, Setup};
pub use telling::{Earlier, Telling};
pub use verdict::Verdict;

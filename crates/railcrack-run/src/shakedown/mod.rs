//! The folder of `railcrack shakedown`: the stabilised plastic state of a rail under repeated
//! passages.

mod document;
mod fields;
mod folder;
mod recorder;
mod results;
mod tables;

pub use document::{
    AdmissibilitySummary, AlternatingZone, Bound, BoundsRow, BoundsVerdict, DangVanPoint, DangVanSummary,
    MapRow, MethodComparison, PeakStress, ResidualPoint, ShakedownSummary, StressComponent,
};
pub use folder::{CycleField, ShakedownFolder};
pub(crate) use recorder::ShakedownRecorder;
pub(crate) use results::{SectionResults, ShakedownResults};
pub use tables::{LayerRow, PassRow, SectionRow};

//! The run folder of a stabilised plastic state.

mod document;
mod fields;
mod recorder;
mod stored;
mod tables;

pub use document::BoundsRow;
pub use document::ShakedownSummary;
pub use recorder::{Extent, ShakedownRecorder, ShakedownResults};
pub use tables::{PASSES_COLUMNS, PROFILE_COLUMNS};

pub use stored::{StoredCycle, StoredLayer, StoredPass, StoredState};

pub const PASSES_FILE: &str = "passes.csv";
pub const PROFILE_FILE: &str = "profile.csv";
/// The state in numbers.
pub const SHAKEDOWN_FILE: &str = "shakedown.json";
/// The plastic stress that rolling has left, as a field of the rail.
pub const PLASTIC_FILE: &str = "plastic.vtu";
pub const CYCLE_FILE: &str = "cycle.vtu";

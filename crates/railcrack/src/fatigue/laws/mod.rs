//! Laws of the growth rate: a file for each, and the table of all of them.

mod bold;
mod forman;
mod law;
mod nasgro;
mod paris;
mod paris_threshold;
mod rate_law;
mod table;
mod walker;

pub use bold::Bold;
pub use forman::Forman;
pub use law::RUNAWAY;
pub use nasgro::Nasgro;
pub use paris::Paris;
pub use paris_threshold::ParisThreshold;
pub use rate_law::RateLaw;
pub use table::{RateTable, RateTableError};
pub use walker::Walker;

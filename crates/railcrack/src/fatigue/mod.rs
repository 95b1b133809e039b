//! Growth rate and direction under non-proportional mixed mode.

mod hourlier_pineau;
mod hull;
mod kink;
mod law;
mod ranges;

pub use hourlier_pineau::{HourlierPineau, Kink, Rival};
pub use kink::KinkFunctions;
pub use law::{DirectionCriterion, KINK_ANGLES, ParisLaw};
pub use ranges::SifRanges;

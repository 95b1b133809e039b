//! Fatigue criteria on histories: crack initiation, and rate and direction of growth under
//! non-proportional mixed mode.

mod dang_van;
mod hourlier_pineau;
mod hull;
mod initiation;
mod kink;
mod largest_k1;
mod law;
mod ranges;
mod toughness;

pub use dang_van::{DangVan, DangVanValue};
pub(crate) use hourlier_pineau::SECONDARY_DISTANCE;
pub use hourlier_pineau::{HourlierPineau, Kink, SecondaryMaximum};
pub use initiation::{DepthValue, Initiation};
pub use kink::{KinkFunctions, KinkSif};
pub use largest_k1::LargestK1;
pub use law::{DirectionCriterion, KINK_ANGLES, ParisLaw};
pub use ranges::SifRanges;
pub use toughness::{RAIL_STEELS, RailSteel, Toughness, ToughnessError};

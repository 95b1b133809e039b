//! Fatigue criteria on histories: crack initiation, and rate and direction of growth under
//! non-proportional mixed-mode loading.

mod criterion;
mod dang_van;
mod equivalent;
mod hourlier_pineau;
mod hull;
mod initiation;
mod kink;
mod kink_ranges;
mod largest_k1;
mod law;
mod laws;
mod maxima;
mod ranges;
mod steel;
mod toughness;

pub use criterion::{DirectionCriterion, KINK_ANGLES};
pub use dang_van::{DangVan, DangVanValue};
pub use equivalent::{EquivalentRange, RangeForm};
pub use hourlier_pineau::{HourlierPineau, Kink, SecondaryMaximum};
pub(crate) use hourlier_pineau::{SECONDARY_DISTANCE, WheelHistory};
pub(crate) use hull::convex_hull;
pub use initiation::{DepthValue, Initiation};
pub use kink::{KinkFunctions, KinkSif};
pub use largest_k1::LargestK1;
pub use law::{GrowthLaw, LoadRange};
// A law has its name in the table of `laws` alone.
pub use laws::*;
pub use ranges::SifRanges;
pub use steel::{ACCEPTANCE_RANGES, ACCEPTED_GROWTH, RAIL_STEELS, RailSteel, SteelGrowth};
pub use toughness::{Toughness, ToughnessError};

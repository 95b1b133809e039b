//! Fatigue criteria on histories: crack initiation, and rate and direction of growth under
//! non-proportional mixed-mode loading.

mod dang_van;
mod hourlier_pineau;
mod kink;
mod largest_k1;
mod law;
mod laws;
mod steel;
mod unusual_rate;

pub use dang_van::{DangVan, DangVanValue, DepthValue, Initiation};
pub use hourlier_pineau::{DirectionCriterion, HourlierPineau, KINK_ANGLES, Kink, SecondaryMaximum};
pub(crate) use hourlier_pineau::{SECONDARY_DISTANCE, WheelHistory};
pub(crate) use kink::convex_hull;
pub use kink::{KinkFunctions, KinkSif};
pub use largest_k1::{LargestK1, Toughness, ToughnessError};
pub use law::{EquivalentRange, GrowthLaw, LoadRange, RangeForm, SifRanges};
// A law has its name in the table of `laws` alone.
pub use laws::*;
pub use steel::{ACCEPTANCE_RANGES, ACCEPTED_GROWTH, RAIL_STEELS, RailSteel, SteelGrowth};
pub use unusual_rate::{OtherRateUnit, UnusualRate};

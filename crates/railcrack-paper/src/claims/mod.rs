//! The statements of sections 4 to 6 of the paper about its results, each with its rule.

mod faces;
mod inclination;
mod network;
mod pair;
mod stress;
mod table;
mod validation;
mod wheel;

pub use table::CLAIMS;

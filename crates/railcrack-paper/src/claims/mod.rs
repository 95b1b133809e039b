//! The statements of the paper's sections 4 to 6 about its results, each beside its rule.

mod faces;
mod inclination;
mod network;
mod pair;
mod stress;
mod table;
mod validation;
mod wheel;

pub use table::CLAIMS;

//! Plausibility of a case: every quantity that a user types against its usual range, and numbers
//! against each other.

mod json_schema;
mod keys;
mod loads;
mod page;
mod pass;
mod ranges;
mod rates;
mod spin;
mod stresses;
mod topic;
mod usual;
mod wheel_rows;

pub use json_schema::json_schema;
pub use page::usual_ranges;
pub use pass::implausible;
pub use ranges::{ANY, USUAL};
pub use topic::{Implausible, Topic};
pub use usual::Usual;

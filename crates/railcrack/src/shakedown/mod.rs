//! Plasticity under repeated passages.

mod bounds;

pub use bounds::{FirstYield, ShakedownLimit, first_yield_ratio, shakedown_limit_ratio};

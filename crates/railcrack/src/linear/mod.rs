//! Dense linear algebra on faer; the only module that names it. Everything runs on the calling thread, so that
//! results are the same bits whatever the number of threads.

mod dense;

pub use dense::{LinearError, general_inverse, spd_inverse};

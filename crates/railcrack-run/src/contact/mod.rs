//! The wheels of a case by their patches and by the growth that each of them causes.

mod across;
mod conclusions;
mod rows;
mod table;

pub use across::GrowthAcross;
pub use conclusions::sentences;
pub use rows::{WheelRow, by_growth};
pub use table::{
    PATCH_INTERVALS, across_table, patch_strips, patch_table, patches_table, strips_table, wheels_table,
};

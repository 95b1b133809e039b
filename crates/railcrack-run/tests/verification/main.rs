//! Runs of cases against theory, finer increments, the other engine and each other.

#[path = "../../../railcrack/tests/common/mod.rs"]
mod common;

mod engine_paths;
mod groups_run;
mod junction_run;
mod patch_in_plane;
mod path;
mod plastic_stress;
mod rolled_rail;
mod slow_tips;

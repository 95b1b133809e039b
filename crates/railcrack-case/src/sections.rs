//! Every section and key of the case file, once.

use super::problem::{CONTACT, CRACK, PASSAGE, PLASTIC_STRESS, RAIL, RESIDUAL_STRESS, TOP};
use super::settings::{GROWTH, MESH, OUTPUT, SHAKEDOWN, SOLVER, TRAFFIC};
use super::table::Section;

/// The case file, in the order in which it is written.
pub const SECTIONS: &[Section] = &[
    TOP,
    RAIL,
    CONTACT,
    PASSAGE,
    CRACK,
    RESIDUAL_STRESS,
    PLASTIC_STRESS,
    SHAKEDOWN,
    GROWTH,
    MESH,
    SOLVER,
    TRAFFIC,
    OUTPUT,
];

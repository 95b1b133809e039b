//! All statements in the order of the paper.

use super::{faces, inclination, network, pair, stress, validation, wheel};
use crate::claim::Claim;

/// All statements in the order of the paper, section by section.
pub static CLAIMS: &[&[Claim]] = &[
    validation::CLAIMS,
    wheel::CLAIMS,
    faces::CLAIMS,
    inclination::CLAIMS,
    stress::CLAIMS,
    pair::CLAIMS,
    network::NINE,
    network::NINE_WITH_STRESS,
];

//! `[output]`: fields that are written.

use crate::schema::{SectionValues, integer, numbers, section, within};

section! {
    OUTPUT "output", Defaulted,
        "Fields of displacement and stress around the cracks, by the finite-element engine.";
    FIELDS_OVER_A: Vec<f64> = numbers("fields_over_a", "a", within(1e3), &[-1.0, 0.0, 1.0],
        "Wheel positions, from the mouth of the first crack: of each, the nearest output position.");
    FIELDS_EVERY: usize = integer("fields_every", (0, 10_000), 25,
        "Interval between growth steps with fields, from step 0 on; 0 writes none.");
}

/// Fields that are written.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOutput {
    /// Wheel positions x_c/a, from the mouth of the first crack.
    pub over_a: Vec<f64>,
    /// Interval between growth steps with fields, from step 0 on; 0 is never.
    pub every: usize,
}

impl FieldOutput {
    pub(crate) fn read(section: &SectionValues) -> Option<Self> {
        Some(Self { over_a: section.get(FIELDS_OVER_A)?, every: section.get(FIELDS_EVERY)? })
    }
}

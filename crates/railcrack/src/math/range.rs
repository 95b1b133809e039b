//! Range checks of input quantities.

use thiserror::Error;

/// A quantity outside its admissible range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{quantity} = {value}: must be {accepted}")]
pub struct OutOfRange {
    /// Which quantity, with its unit.
    pub quantity: &'static str,
    /// The given value.
    pub value: f64,
    /// The accepted values.
    pub accepted: &'static str,
}

impl OutOfRange {
    /// Rejects a `value` that is not positive and finite.
    pub(crate) fn unless_positive(quantity: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value > 0.0 && value.is_finite(), quantity, value, "positive and finite")
    }

    /// Rejects a `value` that is not finite.
    pub(crate) fn unless_finite(quantity: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value.is_finite(), quantity, value, "finite")
    }

    /// Rejects `value` unless `fine` holds.
    pub(crate) fn unless(
        fine: bool,
        quantity: &'static str,
        value: f64,
        accepted: &'static str,
    ) -> Result<(), Self> {
        if fine { Ok(()) } else { Err(Self { quantity, value, accepted }) }
    }
}

//! The other wheels of a mix.

use super::rail_load::RailLoad;
use crate::field::{StressField, Wheel};
use crate::growth::PassageSettings;

/// A wheel of a mix other than the first one, with what may be its own.
pub struct MixedWheel {
    /// Its field.
    pub wheel: Box<dyn Wheel>,
    /// Share of the axles.
    pub share: f64,
    /// Stress of the rail while it passes that stays between passages, temperature included.
    pub residual: Option<Box<dyn StressField>>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; none where the rail does not break.
    pub toughness: Option<f64>,
}

impl MixedWheel {
    pub(super) fn load(&self) -> RailLoad<'_> {
        RailLoad { wheel: self.wheel.as_ref(), residual: self.residual.as_deref() }
    }
}

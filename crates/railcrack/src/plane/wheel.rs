//! The other wheels of a mix.

use super::crack_fluid::CrackFluid;
use super::rail_load::RailLoad;
use crate::coupling::WheelCoupling;
use crate::field::{StressField, Wheel};
use crate::growth::PassageSettings;

/// A wheel of a mix other than the first one, with its own stress state, fluid, passages and
/// toughness.
pub struct MixedWheel {
    /// Its field.
    pub wheel: Box<dyn Wheel>,
    /// Share of the axles.
    pub share: f64,
    /// Stress of the rail that is present with and without the wheel, including thermal stress.
    pub residual: Option<Box<dyn StressField>>,
    /// Fluid in the cracks while it passes; `None` for dry cracks.
    pub fluid: Option<CrackFluid>,
    /// How it feels the cracks; `None` for the contact on the uncracked rail.
    pub coupling: Option<WheelCoupling>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; `None` where fracture is not considered.
    pub toughness: Option<f64>,
}

impl MixedWheel {
    pub(super) fn load(&self) -> RailLoad<'_> {
        RailLoad { wheel: self.wheel.as_ref(), residual: self.residual.as_deref() }
    }
}

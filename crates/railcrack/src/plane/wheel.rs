//! A wheel over cracks in the plane.

use crate::contact::CrackFluid;
use crate::coupling::WheelCoupling;
use crate::field::{StressField, Wheel};
use crate::growth::PassageSettings;

/// A wheel over cracks in the plane, with its own stress state, fluid, passages and toughness.
pub struct PlaneWheel {
    /// Its field.
    pub wheel: Box<dyn Wheel>,
    /// Share of the axles; the shares of all wheels of a rail add up to 1.
    pub share: f64,
    /// Stress of the rail that is present with and without the wheel, balanced, including thermal
    /// stress.
    pub residual: Option<Box<dyn StressField>>,
    /// Fluid in the cracks while it passes; `None` for dry cracks.
    pub fluid: Option<CrackFluid>,
    /// How it feels the cracks; `None` for the contact on the uncracked rail.
    pub coupling: Option<WheelCoupling>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; `None` for that of the growth settings.
    pub toughness: Option<f64>,
}

impl PlaneWheel {
    /// The only wheel of a rail without residual stress, over dry cracks that it does not feel.
    #[must_use]
    pub fn new(wheel: Box<dyn Wheel>) -> Self {
        Self {
            wheel,
            share: 1.0,
            residual: None,
            fluid: None,
            coupling: None,
            passages: PassageSettings::default(),
            toughness: None,
        }
    }
}

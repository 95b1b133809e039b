//! A wheel of a mix as it is read.

use crate::schema::SectionValues;
use crate::tables::GivenWheel;
use railcrack::load::Travel;

/// A wheel of a mix before the cracks are known.
pub(super) struct ReadWheel {
    pub name: String,
    pub share: f64,
    pub axle_load: Option<f64>,
    pub wheel: GivenWheel,
    pub travel: Travel,
    /// Its own `[wheel.fluid]`; without it, that of the case applies.
    pub fluid: Option<SectionValues>,
}

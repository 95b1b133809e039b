//! A wheel of the traffic.

use crate::tables::GivenWheel;
use railcrack::contact::CrackFluid;
use railcrack::growth::PassageSettings;

/// A wheel of the traffic.
#[derive(Debug, Clone, PartialEq)]
pub struct TrafficWheel {
    /// Its name in reports.
    pub name: String,
    /// Share of the axles.
    pub share: f64,
    /// Load of one of its axles, t.
    pub axle_load: Option<f64>,
    /// Contact, track, temperature.
    pub wheel: GivenWheel,
    /// Fluid in the cracks while it passes, if any.
    pub fluid: Option<CrackFluid>,
    /// Its passages, in its direction of travel: positions are measured in its own half-width.
    pub passages: PassageSettings,
}

/// Mean load (t) of an axle of `wheels`; none where the load of one of them is not known.
pub(super) fn mean_axle_load(wheels: &[TrafficWheel]) -> Option<f64> {
    wheels.iter().map(|wheel| Some(wheel.share * wheel.axle_load?)).sum()
}

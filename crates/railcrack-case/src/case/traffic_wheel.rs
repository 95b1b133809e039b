//! A wheel of the traffic.

use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{GivenWheel, PossibleExtent, read_fluid};
use railcrack::contact::CrackFluid;
use railcrack::crack::CrackNetwork;
use railcrack::growth::PassageSettings;
use railcrack::material::IsotropicElastic;
use std::path::Path;

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

/// The parts of the case that its wheels depend on.
#[derive(Clone, Copy)]
pub(super) struct TrafficContext<'a> {
    pub sections: &'a Sections,
    pub steel: Option<&'a IsotropicElastic>,
    pub network: Option<&'a CrackNetwork>,
    /// The parts of the contacts that can load the cracks.
    pub extent: PossibleExtent,
    pub folder: &'a Path,
}

impl TrafficContext<'_> {
    /// The fluid of `section`, dry cracks without it; none where it cannot be read.
    #[expect(clippy::option_option, reason = "dry cracks, and a section with errors")]
    pub(super) fn fluid(
        self,
        section: Option<&SectionValues>,
        report: &mut Report,
    ) -> Option<Option<CrackFluid>> {
        match section {
            Some(section) => read_fluid(section, self.network?, report),
            None => Some(None),
        }
    }
}

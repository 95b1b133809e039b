//! The load of one wheel: `[contact]`, `[track]`, `[temperature]`.

use super::contact::{ContactExtent, ContactOrigin, KIND, read_contact};
use super::coupling::read_coupling;
use super::rolling::read_rolling;
use super::track::{read_temperature, read_track};
use crate::files::Companion;
use crate::schema::{Report, SectionValues};
use railcrack::coupling::WheelCoupling;
use railcrack::field::{Uniform, Wheel, wheel_under};
use railcrack::growth::output_positions;
use railcrack::load::{Bending, Contact, ContactKind, Passage, Travel, WheelLoad};
use railcrack::material::IsotropicElastic;
use railcrack::math::OutOfRange;
use std::path::Path;

/// The load of one wheel as a case gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenWheel {
    /// Contact, bending, temperature.
    pub load: WheelLoad,
    /// Origin of the contact.
    pub origin: ContactOrigin,
    /// How the wheel feels the cracks; `None` for the contact on the uncracked rail.
    pub coupling: Option<WheelCoupling>,
}

/// The sections of one wheel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WheelSections<'a> {
    pub contact: &'a SectionValues,
    pub track: Option<&'a SectionValues>,
    pub temperature: Option<&'a SectionValues>,
    pub extent: ContactExtent,
}

impl GivenWheel {
    /// The wheel of `sections` on a rail of `steel`, running towards `travel`; files are relative
    /// to `folder`. None where something is wrong or missing, which `report` then says.
    pub(crate) fn read(
        sections: WheelSections,
        steel: &IsotropicElastic,
        travel: Travel,
        folder: &Path,
        report: &mut Report,
    ) -> Option<Self> {
        let contact = match sections.contact.get(KIND) {
            Some(ContactKind::Rolling) => {
                read_rolling(sections.contact, steel, travel, sections.extent, folder, report)
            }
            _ => read_contact(sections.contact, steel, travel, sections.extent, folder, report),
        };
        let track = sections.track.map(|s| read_track(s, Some(sections.contact), report));
        let temperature = sections.temperature.map(|s| read_temperature(s, report));
        let (contact, origin) = contact?;
        let coupling = read_coupling(sections.contact, &contact, steel, report)?;
        // A section that is present but cannot be read must not count as absent.
        let load = WheelLoad { contact, track: all_or_none(track)?, temperature: all_or_none(temperature)? };
        Some(Self { load, origin, coupling })
    }

    /// The contact.
    #[must_use]
    pub fn contact(&self) -> &Contact {
        &self.load.contact
    }

    /// a, mm.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.load.contact.half_width()
    }

    /// The field that moves with the wheel on a rail of `steel`. Errors: [`wheel_under`]; a checked
    /// case has none.
    pub fn field(&self, steel: &IsotropicElastic) -> Result<Box<dyn Wheel>, OutOfRange> {
        wheel_under(&self.load, steel)
    }

    /// The thermal stress in a rail of `steel`, which stays between passages.
    #[must_use]
    pub fn thermal_stress(&self, steel: &IsotropicElastic) -> Option<Uniform> {
        self.load.temperature.map(|temperature| Uniform::along_rail(temperature.stress(steel)))
    }

    /// The bending of a rail of `steel`; none where there is no track.
    #[must_use]
    pub fn bending(&self, steel: &IsotropicElastic) -> Option<Bending> {
        self.load.track.as_ref()?.bending(steel).ok()
    }

    /// The positions of `passage` that are written, over cracks with mouths at `places` (mm), in
    /// the order of travel: also those far away where the rail of `steel` bends.
    #[must_use]
    pub fn positions(&self, passage: &Passage, places: &[f64], steel: &IsotropicElastic) -> Vec<f64> {
        output_positions(passage, self.bending(steel).as_ref(), places)
    }

    /// The files, stored with a case, from which its contact is read.
    pub(crate) fn companions(&self) -> Vec<Companion<'_>> {
        match &self.origin {
            ContactOrigin::Table(file) => vec![file.companion()],
            ContactOrigin::Profiles(own) => vec![own.rail.companion(), own.wheel.companion()],
            _ => Vec::new(),
        }
    }
}

/// None where a part is there and could not be read.
fn all_or_none<T>(part: Option<Option<T>>) -> Option<Option<T>> {
    match part {
        Some(None) => None,
        Some(read) => Some(read),
        None => Some(None),
    }
}

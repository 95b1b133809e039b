//! The load of one wheel: `[contact]`, `[track]`, `[temperature]`.

use super::contact::{ContactExtent, ContactOrigin, KIND, PossibleExtent, read_contact};
use super::coupling::read_coupling;
use super::rolling::read_rolling;
use super::track::{read_temperature, read_track};
use crate::files::Companion;
use crate::schema::{Report, SectionValues};
use railcrack::coupling::WheelCoupling;
use railcrack::field::Uniform;
use railcrack::growth::output_positions;
use railcrack::load::{Bending, Contact, ContactKind, Passage, Temperature, Track, Travel};
use railcrack::material::IsotropicElastic;
use std::path::Path;

/// The load of one wheel as a case gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenWheel {
    /// Its load on the running surface over the cracks.
    pub loading: WheelLoading,
    /// The rail as a beam; none where it does not bend.
    pub track: Option<Track>,
    /// Temperature of the rail, where it is given.
    pub temperature: Option<Temperature>,
}

/// Load of a wheel on the running surface over the cracks.
#[derive(Debug, Clone, PartialEq)]
pub enum WheelLoading {
    /// Its contact passes over them.
    Contact(Box<GivenContact>),
    /// Its patches miss them: only bending, temperature and fluid load them.
    Misses {
        /// Half-width (mm) in which the positions of its passage are measured.
        half_width: f64,
    },
}

/// The contact of a wheel over the cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenContact {
    /// Pressure and shear; of a whole patch, those of its middle strip.
    pub contact: Contact,
    /// The part of a patch that loads the cracks; a line contact has none but its strip.
    pub extent: ContactExtent,
    /// Origin of their numbers.
    pub origin: ContactOrigin,
    /// How the wheel feels the cracks; `None` for the contact on the uncracked rail.
    pub coupling: Option<WheelCoupling>,
}

impl GivenContact {
    /// Whether a patch loads the cracks, and not a line contact.
    #[must_use]
    pub fn is_patch(&self) -> bool {
        let is_line = matches!(
            self.origin,
            ContactOrigin::Given | ContactOrigin::LineLoad { .. } | ContactOrigin::Table(_)
        );
        self.extent == ContactExtent::Patch && !is_line
    }
}

/// The sections of one wheel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WheelSections<'a> {
    pub contact: &'a SectionValues,
    pub track: Option<&'a SectionValues>,
    pub temperature: Option<&'a SectionValues>,
    /// The parts of a patch that the engine and the boundary of the rail can take.
    pub extent: PossibleExtent,
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
        let extent = sections.extent.of_contact(sections.contact, report);
        let contact = match sections.contact.get(KIND) {
            Some(ContactKind::Rolling) => {
                read_rolling(sections.contact, steel, travel, extent, folder, report)
            }
            _ => read_contact(sections.contact, steel, travel, extent, folder, report),
        };
        let track = sections.track.map(|s| read_track(s, Some(sections.contact), report));
        let temperature = sections.temperature.map(|s| read_temperature(s, report));
        let (contact, origin) = contact?;
        let coupling = read_coupling(sections.contact, &contact, steel, report)?;
        let loading = WheelLoading::Contact(Box::new(GivenContact { contact, extent, origin, coupling }));
        // A section that is present but cannot be read must not count as absent.
        Some(Self { loading, track: all_or_none(track)?, temperature: all_or_none(temperature)? })
    }

    /// Its contact over the cracks; none where it misses them.
    #[must_use]
    pub fn given(&self) -> Option<&GivenContact> {
        match &self.loading {
            WheelLoading::Contact(given) => Some(given),
            WheelLoading::Misses { .. } => None,
        }
    }

    /// Pressure and shear over the cracks; none where it misses them.
    #[must_use]
    pub fn contact(&self) -> Option<&Contact> {
        self.given().map(|given| &given.contact)
    }

    /// How the wheel feels the cracks, if it does.
    #[must_use]
    pub fn coupling(&self) -> Option<&WheelCoupling> {
        self.given()?.coupling.as_ref()
    }

    /// a, mm: the unit of its positions.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        match &self.loading {
            WheelLoading::Contact(given) => given.contact.half_width(),
            WheelLoading::Misses { half_width } => *half_width,
        }
    }

    /// The thermal stress in a rail of `steel`, which stays between passages.
    #[must_use]
    pub fn thermal_stress(&self, steel: &IsotropicElastic) -> Option<Uniform> {
        self.temperature.map(|temperature| Uniform::along_rail(temperature.stress(steel)))
    }

    /// The bending of a rail of `steel`; none where there is no track.
    #[must_use]
    pub fn bending(&self, steel: &IsotropicElastic) -> Option<Bending> {
        self.track.as_ref()?.bending(steel).ok()
    }

    /// The positions of `passage` that are written, over cracks with mouths at `places` (mm), in
    /// the order of travel: also those far away where the rail of `steel` bends.
    #[must_use]
    pub fn positions(&self, passage: &Passage, places: &[f64], steel: &IsotropicElastic) -> Vec<f64> {
        output_positions(passage, self.bending(steel).as_ref(), places)
    }

    /// The files, stored with a case, from which its contact is read.
    pub(crate) fn companions(&self) -> Vec<Companion<'_>> {
        match self.given().map(|given| &given.origin) {
            Some(ContactOrigin::Table(file)) => vec![file.companion()],
            Some(ContactOrigin::Profiles(own)) => vec![own.rail.companion(), own.wheel.companion()],
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

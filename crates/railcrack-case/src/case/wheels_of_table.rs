//! `[[wheel]] table`: the wheels of a table.

use super::traffic_wheel::{TrafficContext, TrafficWheel};
use super::wheel_table::{TabledWheel, WheelTable};
use crate::files::{TableWheel, WheelReading, WheelTableFile, read_wheel_table};
use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{
    CRACK, CRACK_LATERAL, ContactExtent, ContactOrigin, Engine, GivenContact, GivenWheel, PASSAGE, PLACE,
    PLACE_WINDOW, REPRESENTATIVES, REPRESENTATIVES_ERROR, TABLE, TABLE_EXTENT, TABLE_SIGN, TABLE_THEORY,
    TEMPERATURE, TRACK, WHEEL_CONTACT, WHEEL_TEMPERATURE, WHEEL_TRACK, WheelLoading, engine_of,
    read_passages, read_temperature, read_track,
};
use railcrack::contact::CrackFluid;
use railcrack::load::{Contact, Travel};
use railcrack::rolling::PlacedPatch;

/// Common properties of the wheels of a table.
pub(super) struct TableContext<'a> {
    pub of_traffic: TrafficContext<'a>,
    pub travel: Travel,
    /// Share of the axles that the other wheels of the mix leave.
    pub share: f64,
    /// Load of an axle, t, where the table gives none.
    pub axle_load: Option<f64>,
    /// Number of its first wheel in the case.
    pub first: usize,
    pub fluid: Option<CrackFluid>,
}

/// The wheels for the table of `given`, and the table; none if something is wrong; errors are added
/// to `report`.
pub(super) fn read_wheels_of_table(
    given: &SectionValues,
    context: TableContext<'_>,
    report: &mut Report,
) -> Option<(Vec<TrafficWheel>, WheelTable)> {
    let TableContext { of_traffic, travel, first, .. } = context;
    let TrafficContext { sections, steel, network, extent, folder } = of_traffic;
    if let Some(contact) = sections.part(given, &WHEEL_CONTACT) {
        let says = "says the same thing as `table`, whose rows are the contacts: give one or the other";
        return report.refuse(contact.fault_of_all(says));
    }
    let extent = extent.chosen(given, TABLE_EXTENT, report);
    let is_whole = extent == ContactExtent::Patch;
    // Cracks in space each lie at their own place.
    let (lateral, of_patches) = match engine_of(sections) {
        Some(Engine::Space) => (sections.all(&CRACK).next()?.get(CRACK_LATERAL).unwrap_or(0.0), 0.0),
        _ => [lateral_place(sections, report)?; 2].into(),
    };
    let (sign, theory) = (given.get(TABLE_SIGN)?, given.get(TABLE_THEORY)?);
    let reading = WheelReading { steel: steel?, sign, theory };
    let file = read_wheel_table(given, TABLE, reading, folder, report)?;
    let wheels = passing(&file, given, context.share, report)?;
    let loadings: Vec<WheelLoading> =
        wheels.iter().map(|wheel| loading(&wheel.wheel, of_patches, (extent, travel))).collect();
    if loadings.iter().all(|loading| matches!(loading, WheelLoading::Misses { .. })) {
        let says =
            format!("no patch of its {} wheels meets the crack at lateral_mm = {lateral}", wheels.len());
        let help = "lateral_mm of [[crack]] and y_rail_mm of the table are measured from the same origin";
        return report.refuse(given.fault(TABLE, says).help(help));
    }
    let track = match sections.part(given, &WHEEL_TRACK).or_else(|| sections.one(&TRACK)) {
        Some(section) => Some(read_track(section, None, report)?),
        None => None,
    };
    let temperature = match sections.part(given, &WHEEL_TEMPERATURE).or_else(|| sections.one(&TEMPERATURE)) {
        Some(section) => Some(read_temperature(section, report)?),
        None => None,
    };
    let (network, passage) = (network?, sections.one(&PASSAGE)?);
    let read = |(wheel, loading): (&TabledWheel, WheelLoading)| {
        let load = GivenWheel { loading, track: track.clone(), temperature };
        Some(TrafficWheel {
            name: format!("wheel {}", wheel.wheel.number),
            share: wheel.share,
            axle_load: wheel.wheel.axle_load.or(context.axle_load),
            passages: read_passages(passage, load.half_width(), travel, network)?,
            wheel: load,
            fluid: context.fluid.clone(),
        })
    };
    let traffic: Option<Vec<TrafficWheel>> = wheels.iter().zip(loadings).map(read).collect();
    let table = WheelTable {
        file,
        lateral,
        is_whole,
        travel,
        wheels,
        first,
        most: given.get(REPRESENTATIVES)?,
        accepted: given.get(REPRESENTATIVES_ERROR)?,
        groups: None,
    };
    Some((traffic?, table))
}

/// Load of a wheel of a table, which runs towards `travel`, on the running surface over cracks at
/// `lateral` (mm).
fn loading(wheel: &TableWheel, lateral: f64, (extent, travel): (ContactExtent, Travel)) -> WheelLoading {
    let of_patch = |contact: Contact, own: PlacedPatch| {
        let origin = ContactOrigin::Rolling { patch: Box::new(own.patch), lateral: own.y, travel };
        WheelLoading::Contact(Box::new(GivenContact { contact, extent, origin, coupling: None }))
    };
    let heaviest = wheel.heaviest();
    let met = match extent {
        ContactExtent::Patch => {
            let own = PlacedPatch { patch: heaviest.patch, y: lateral - heaviest.y_rail, x: heaviest.x };
            heaviest.patch.plane_contact(0.0, travel).ok().map(|contact| of_patch(contact, own))
        }
        ContactExtent::Strip => {
            let patches = wheel.over(lateral);
            let over = patches.iter().find(|own| own.patch.half_length(own.y) > 0.0).copied();
            PlacedPatch::plane_contact(&patches, travel)
                .zip(over)
                .map(|(contact, own)| of_patch(contact, own))
        }
    };
    met.unwrap_or(WheelLoading::Misses { half_width: heaviest.patch.ellipse.along })
}

/// The lateral place of the cracks, which is the same for all of them.
fn lateral_place(sections: &Sections, report: &mut Report) -> Option<f64> {
    let mut places = sections.all(&CRACK).map(|crack| (crack, crack.get(CRACK_LATERAL).unwrap_or(0.0)));
    let (_, place) = places.next()?;
    if let Some((other, _)) = places.find(|(_, other)| *other != place) {
        let says = format!(
            "must be {place} as of the first crack: a wheel of a table meets all cracks of a plane at one place"
        );
        return report.refuse(other.fault(CRACK_LATERAL, says));
    }
    Some(place)
}

/// The wheels of the table at the place of the section, with their shares of the `whole` table's
/// share of the axles.
fn passing(
    file: &WheelTableFile,
    given: &SectionValues,
    whole: f64,
    report: &mut Report,
) -> Option<Vec<TabledWheel>> {
    let (place, window) = (given.get(PLACE), given.get(PLACE_WINDOW)?);
    let is_here = |wheel: &&TableWheel| match place {
        Some(place) => wheel.place.is_some_and(|own| (own - place).abs() <= 0.5 * window),
        None => true,
    };
    let here: Vec<&TableWheel> = file.content().iter().filter(is_here).collect();
    if here.is_empty() {
        let says = format!("no wheel of the table has a place_m within {} m of it", 0.5 * window);
        return report.refuse(given.fault(PLACE, says));
    }
    let sum: f64 = here.iter().map(|wheel| wheel.share.unwrap_or(1.0)).sum();
    let of = |wheel: &&TableWheel| TabledWheel {
        wheel: (*wheel).clone(),
        share: whole * (wheel.share.unwrap_or(1.0) / sum),
    };
    Some(here.iter().map(of).collect())
}

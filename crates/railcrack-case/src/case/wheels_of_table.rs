//! `[[wheel]] table`: the wheels of a table, grouped, as wheels of the mix.

use super::front_shape::first_front;
use super::read_wheel::ReadWheel;
use super::representatives::{FirstCrack, group};
use super::wheel_table::{TabledWheel, WheelTable};
use crate::files::{TableWheel, WheelReading, WheelTableFile, read_wheel_table};
use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{
    CRACK, CRACK_FRICTION, CRACK_LATERAL, ContactExtent, ContactOrigin, GivenWheel, PLACE, PLACE_WINDOW,
    REPRESENTATIVES, REPRESENTATIVES_ERROR, TABLE, TABLE_SIGN, TABLE_THEORY, TEMPERATURE, TRACK,
    WHEEL_CONTACT, WHEEL_FLUID, WHEEL_TEMPERATURE, WHEEL_TRACK, read_temperature, read_track,
};
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::GrowthLaw;
use railcrack::load::{Contact, HertzianContact, Travel, WheelLoad};
use railcrack::material::IsotropicElastic;
use railcrack::rolling::PlacedPatch;
use std::path::Path;

/// Peak pressure (MPa) of the wheel of the mix that stands for those that miss the crack: it loads
/// the crack by nothing that counts, and keeps their share, their fluid and their bending.
const NOTHING: f64 = 1e-3;

/// Common properties of the wheels of a table.
pub(super) struct TableContext<'a> {
    pub sections: &'a Sections,
    pub steel: &'a IsotropicElastic,
    pub travel: Travel,
    pub network: &'a CrackNetwork,
    pub law: &'a GrowthLaw,
    /// Share of the axles that the other wheels of the mix leave.
    pub share: f64,
    /// Load of an axle, t, where the table gives none.
    pub axle_load: Option<f64>,
    /// Number of its first wheel in the mix.
    pub first: usize,
    pub folder: &'a Path,
    /// The part of its patches that loads the cracks.
    pub extent: ContactExtent,
}

/// The wheels of the mix for the table of `given`, and the table; none if something is wrong;
/// errors are added to `report`.
pub(super) fn read_wheels_of_table(
    given: &SectionValues,
    context: &TableContext<'_>,
    report: &mut Report,
) -> Option<(Vec<ReadWheel>, WheelTable)> {
    let TableContext { sections, steel, travel, network, law, folder, first, .. } = *context;
    if let Some(contact) = sections.part(given, &WHEEL_CONTACT) {
        let says = "says the same thing as `table`, whose rows are the contacts: give one or the other";
        report.add(contact.fault_of_all(says));
        return None;
    }
    let in_space = context.extent == ContactExtent::Ellipse;
    // Cracks in space each lie at their own place.
    let lateral = match in_space {
        true => sections.all(&CRACK).next()?.get(CRACK_LATERAL).unwrap_or(0.0),
        false => lateral_place(sections, report)?,
    };
    let front = if in_space { Some(first_front(sections, network)?) } else { None };
    let (sign, theory) = (given.get(TABLE_SIGN)?, given.get(TABLE_THEORY)?);
    let reading = WheelReading { steel, sign, theory };
    let file = read_wheel_table(given, TABLE, reading, folder, report)?;
    let mut wheels = passing(&file, given, context, lateral, report)?;
    let loaded: Vec<usize> = (0..wheels.len()).filter(|i| wheels[*i].contact.is_some()).collect();
    if loaded.is_empty() {
        let says =
            format!("no patch of its {} wheels meets the crack at lateral_mm = {lateral}", wheels.len());
        let help = "lateral_mm of [[crack]] and y_rail_mm of the table are measured from the same origin";
        report.add(given.fault(TABLE, says).help(help));
        return None;
    }
    let most = given.get(REPRESENTATIVES)?;
    let friction = sections.all(&CRACK).next().and_then(|crack| crack.get(CRACK_FRICTION))?;
    let crack = front.as_ref().map_or(FirstCrack::Plane(network), FirstCrack::Space);
    let groups = group((&wheels, travel), &loaded, most, (crack, friction), (steel, law));
    for (i, group) in loaded.iter().zip(&groups.group_of) {
        wheels[*i].represented_by = first + group;
    }
    let count = groups.representatives.len();
    let missed: f64 = wheels.iter().filter(|wheel| wheel.contact.is_none()).map(|wheel| wheel.share).sum();
    wheels
        .iter_mut()
        .filter(|wheel| wheel.contact.is_none())
        .for_each(|wheel| wheel.represented_by = first + count);
    let track = match sections.part(given, &WHEEL_TRACK).or_else(|| sections.one(&TRACK)) {
        Some(section) => Some(read_track(section, None, report)?),
        None => None,
    };
    let temperature = match sections.part(given, &WHEEL_TEMPERATURE).or_else(|| sections.one(&TEMPERATURE)) {
        Some(section) => Some(read_temperature(section, report)?),
        None => None,
    };
    let read = |name: String, share: f64, contact: Contact, origin: ContactOrigin, group: usize| ReadWheel {
        name,
        share,
        axle_load: mean_axle_load(&wheels, first + group).or(context.axle_load),
        wheel: GivenWheel {
            load: WheelLoad { contact, track: track.clone(), temperature },
            origin,
            coupling: None,
        },
        travel,
        fluid: sections.part(given, &WHEEL_FLUID).cloned(),
    };
    let mut mix = Vec::with_capacity(count + 1);
    for (group, (own, share)) in groups.representatives.iter().zip(&groups.shares).enumerate() {
        let wheel = &wheels[loaded[*own]];
        let alike = groups.group_of.iter().filter(|other| **other == group).count();
        let name = match alike {
            1 => format!("wheel {}", wheel.wheel.number),
            _ => format!("wheel {} and {} like it", wheel.wheel.number, alike - 1),
        };
        let origin = match in_space {
            true => {
                let own = wheel.wheel.heaviest();
                ContactOrigin::Rolling { patch: Box::new(own.patch), lateral: -own.y_rail, travel }
            }
            false => {
                let patches = wheel.wheel.over(lateral);
                let own = patches.iter().find(|own| own.patch.half_length(own.y) > 0.0)?;
                ContactOrigin::Rolling { patch: Box::new(own.patch), lateral: own.y, travel }
            }
        };
        mix.push(read(name, *share, wheel.contact.clone()?, origin, group));
    }
    if missed > 0.0 {
        let half_width = mix[0].wheel.half_width();
        let nothing = HertzianContact { peak_pressure: NOTHING, half_width, friction: 0.0 };
        mix.push(read(
            "wheels that miss the crack".into(),
            missed,
            nothing.into(),
            ContactOrigin::Given,
            count,
        ));
    }
    let table = WheelTable {
        file,
        lateral,
        in_space,
        chosen: groups.representatives.iter().map(|own| loaded[*own]).collect(),
        travel,
        wheels,
        first,
        representatives: count,
        missed,
        error: groups.error,
        accepted: given.get(REPRESENTATIVES_ERROR)?,
    };
    Some((mix, table))
}

/// The lateral place of the cracks, which is the same for all of them.
fn lateral_place(sections: &Sections, report: &mut Report) -> Option<f64> {
    let mut places = sections.all(&CRACK).map(|crack| (crack, crack.get(CRACK_LATERAL).unwrap_or(0.0)));
    let (_, place) = places.next()?;
    if let Some((other, _)) = places.find(|(_, other)| *other != place) {
        let says = format!(
            "must be {place} as of the first crack: a wheel of a table meets all cracks of a plane at one place"
        );
        report.add(other.fault(CRACK_LATERAL, says));
        return None;
    }
    Some(place)
}

/// The wheels of the table at the place of the section, with their shares and loads.
fn passing(
    file: &WheelTableFile,
    given: &SectionValues,
    context: &TableContext<'_>,
    lateral: f64,
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
        report.add(given.fault(PLACE, says));
        return None;
    }
    let sum: f64 = here.iter().map(|wheel| wheel.share.unwrap_or(1.0)).sum();
    let contact = |wheel: &TableWheel| match context.extent {
        ContactExtent::Ellipse => wheel.heaviest().patch.plane_contact(0.0, context.travel).ok(),
        ContactExtent::Strip => PlacedPatch::plane_contact(&wheel.over(lateral), context.travel),
    };
    let of = |wheel: &&TableWheel| TabledWheel {
        wheel: (*wheel).clone(),
        share: context.share * (wheel.share.unwrap_or(1.0) / sum),
        contact: contact(wheel),
        represented_by: 0,
    };
    Some(here.iter().map(of).collect())
}

/// The mean load of the axles that the wheel `group` of the mix represents; none where it is not
/// known of all of them.
fn mean_axle_load(wheels: &[TabledWheel], group: usize) -> Option<f64> {
    let own = || wheels.iter().filter(|wheel| wheel.represented_by == group);
    let tonnes: Option<f64> = own().map(|wheel| Some(wheel.share * wheel.wheel.axle_load?)).sum();
    let share: f64 = own().map(|wheel| wheel.share).sum();
    tonnes.filter(|_| share > 0.0).map(|tonnes| tonnes / share)
}

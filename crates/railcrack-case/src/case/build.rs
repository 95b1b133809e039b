//! From accepted values to a case: checks that involve several keys.

use super::case::Case;
use super::cracks::{Meetings, check_fit, place_cracks};
use super::known_sizes::KnownSizes;
use super::limits::check_size;
use super::mix::{MixedWheel, ReadWheel, read_mix};
use super::space::{read_space, refuse_strike};
use crate::files::read_profile;
use crate::schema::{Report, SectionValues, Sections, Value, Written, short};
use crate::tables::{
    AXLE_LOAD, CENTRE, CONTACT, CRACK, ContactExtent, ContactSolver, ENGINE, Engine, EngineDomain, FLUID,
    FOUNDATION, FRACTURE, FROM, FieldOutput, Fracture, GROWTH, GivenWheel, INSPECTION, MAINTENANCE, MESH,
    MeshSettings, NETWORK, OUTPUT, Output, PASSAGE, PLASTIC_STRESS, PROFILE, PlasticSource, RAIL,
    RAIL_TEMPERATURE, RESIDUAL_STRESS, Rail, SCATTER, SHAKEDOWN, SOLVER, SOLVER_CONTACT, Scattering,
    ShakedownSettings, TEMPERATURE, TITLE, TO, TOP, TRACK, TRAFFIC, WHEEL, WIDTH, WheelSections,
    is_of_the_law, read_fluid, read_growth, read_inspection, read_maintenance, read_passage, read_passages,
    read_scatter, read_steel, read_travel,
};
use railcrack::bulk::Boundary;
use railcrack::crack::CrackNetwork;
use railcrack::growth::GrowthSettings;
use railcrack::load::{Passage, Temperature};
use railcrack::material::IsotropicElastic;
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::NetworkContact;
use std::path::Path;

/// The case that `sections` describe; none if something is wrong or missing; errors are added to
/// `report`.
///
/// Every part is built, even where another is wrong, so that all errors are found at once. `sizes`
/// are those of other cases of the same study.
pub(crate) fn build(
    mut sections: Sections,
    folder: &Path,
    sizes: &KnownSizes,
    report: &mut Report,
) -> Option<Case> {
    let rail_section = sections.one(&RAIL);
    let steel = rail_section.and_then(|s| read_steel(s, report));
    let mix = if sections.all(&WHEEL).next().is_some() {
        read_mix(&sections, steel.as_ref(), contact_extent(&sections), folder, report).map(Some)
    } else {
        Some(None)
    };
    let wheel = match &mix {
        Some(Some(mix)) => mix.first().map(|first| first.wheel.clone()),
        Some(None) => read_wheel(&sections, steel.as_ref(), folder, report),
        None => None,
    };
    let crack_sections: Vec<&SectionValues> = sections.all(&CRACK).collect();
    let meetings = if is_in_space(&sections) { Meetings::InSpace } else { Meetings::InThePlane };
    let placed = place_cracks(&crack_sections, meetings, report);
    let network = placed.as_ref().map(|placed| &placed.network);
    let rail = rail_section.and_then(|s| Rail::read(s, network));
    if let (Some(rail), Some(placed)) = (&rail, &placed) {
        check_fit(placed, rail, &crack_sections, report);
    }
    let passage = sections
        .one(&PASSAGE)
        .and_then(|s| read_passage(s, wheel.as_ref().map(GivenWheel::half_width), network, report));
    if let Some(rail) = rail.filter(|rail| rail.boundary != Boundary::HalfPlane) {
        check_block(&rail, &sections, wheel.as_ref().zip(passage.as_ref()), report);
    }
    let mix = mix.and_then(|mix| {
        let place = |read: ReadWheel| place_wheel(read, &sections, network, report);
        mix.unwrap_or_default().into_iter().map(place).collect::<Option<Vec<MixedWheel>>>()
    });
    if let (Some(mix), Some(rail)) = (&mix, rail.filter(|rail| rail.boundary != Boundary::HalfPlane)) {
        for other in mix.iter().skip(1) {
            check_block(&rail, &sections, Some((&other.wheel, &other.passages.passage)), report);
        }
    }
    let residual_section = sections.one(&RESIDUAL_STRESS);
    let residual_stress = residual_section.and_then(|s| read_profile(s, PROFILE, folder, report));
    let plastic_section = sections.one(&PLASTIC_STRESS);
    let plastic_stress = plastic_section.and_then(|s| PlasticSource::read(s, folder, report));
    if let (Some(PlasticSource::Rolled), Some(section), Some(_)) =
        (&plastic_stress, plastic_section, residual_section)
    {
        refuse_counting_twice(section, report);
    }
    if matches!(plastic_stress, Some(PlasticSource::Rolled)) {
        check_rolled(&sections, report);
    }
    if let (Some(PlasticSource::Rolled), Some(section), true) =
        (&plastic_stress, plastic_section, mix.as_ref().is_some_and(|mix| !mix.is_empty()))
    {
        let says = "without a field, this is the stress left by rolling under a single wheel, but [[wheel]] gives several";
        report.add(section.fault_of_all(says).help("give a field or profile in [plastic_stress]"));
    }
    let shakedown = sections.one(&SHAKEDOWN).and_then(|s| ShakedownSettings::read(s, folder, report));
    let growth = sections.one(&GROWTH).and_then(|s| read_growth(s, folder, report));
    if growth.as_ref().is_some_and(|growth| growth.steel.is_some()) {
        sections.leave_out(&GROWTH, is_of_the_law);
    }
    let temperature = wheel.as_ref().and_then(|wheel| wheel.load.temperature);
    let fracture = read_fracture(&sections, temperature, folder, report);
    let fluid = match sections.one(&FLUID).zip(network) {
        Some((section, network)) => read_fluid(section, network, report),
        None => Some(None),
    };
    let traffic = sections.one(&TRAFFIC).and_then(|s| s.get(AXLE_LOAD));
    let mean = |mix: &Vec<MixedWheel>| -> Option<f64> {
        mix.iter().map(|wheel| Some(wheel.share * wheel.axle_load?)).sum()
    };
    let axle_load = mix.as_ref().and_then(|mix| if mix.is_empty() { traffic } else { mean(mix) });
    let maintenance = sections.one(&MAINTENANCE);
    let maintenance = maintenance.map(|s| read_maintenance(s, axle_load.is_some(), report));
    let inspection = sections.one(&INSPECTION);
    let inspection = inspection.map(|s| read_inspection(s, axle_load.is_some(), report));
    let toughness = fracture.as_ref().and_then(|fracture| Some(fracture.as_ref()?.at_rail));
    let steel_of_law = growth.as_ref().and_then(|growth| growth.steel);
    let scatter = sections.one(&SCATTER);
    let scattering = Scattering {
        toughness,
        steel: steel_of_law,
        has_tonnes: axle_load.is_some(),
        is_maintained: maintenance.is_some(),
        is_mix: mix.as_ref().is_none_or(|mix| mix.len() > 1),
    };
    let scatter = scatter.map(|s| read_scatter(s, scattering, report));
    let space = match is_in_space(&sections) {
        true => {
            let wheels: Option<Vec<&GivenWheel>> = match &mix {
                Some(mix) if !mix.is_empty() => Some(mix.iter().map(|mixed| &mixed.wheel).collect()),
                _ => wheel.as_ref().map(|wheel| vec![wheel]),
            };
            read_space(&sections, placed.as_ref(), wheels.as_deref(), rail.as_ref(), report).map(Some)
        }
        false => {
            refuse_strike(&sections, report);
            Some(None)
        }
    };
    let (placed, rail) = (placed?, rail?);
    let maintenance = match maintenance {
        Some(read) => Some(read?),
        None => None,
    };
    // A stored case records the middle of the rail, and how far it reaches.
    sections.settle(&RAIL, CENTRE, Value::Number(rail.extent.centre));
    sections.settle(&RAIL, WIDTH, Value::Number(rail.extent.width));
    let is_block = matches!(rail.boundary, Boundary::Block { .. });
    check_network(&sections, (fluid.as_ref().is_some_and(Option::is_some), is_block), report);
    let solver = sections.one(&SOLVER)?;
    let case = Case {
        title: sections.one(&TOP)?.get(TITLE)?,
        steel: steel?,
        rail,
        wheel: wheel?,
        passages: read_passages(sections.one(&PASSAGE)?, passage?)?,
        cracks: placed.network,
        crack_friction: placed.friction,
        residual_stress,
        plastic_stress,
        fluid: fluid?,
        shakedown: shakedown?,
        growth: GrowthSettings {
            toughness: fracture.as_ref()?.as_ref().map(|fracture| MPA_SQRT_MM * fracture.at_rail),
            pop_in: fracture
                .as_ref()?
                .as_ref()
                .filter(|_| space.as_ref().is_some_and(Option::is_none))
                .and_then(|fracture| fracture.pop_in),
            maintenance: maintenance.zip(axle_load).map(|(plan, tonnes)| plan.per_axle(tonnes)),
            ..growth.as_ref()?.settings.clone()
        },
        growth_steel: growth.as_ref()?.steel,
        growth_rates: growth?.rates,
        fracture: fracture?,
        space: space?,
        mesh: MeshSettings::read(sections.one(&MESH)?),
        engine: solver.get(ENGINE)?,
        contact_solver: solver.get(SOLVER_CONTACT)?,
        network: solver.get(NETWORK)?,
        fields: FieldOutput::read(sections.one(&OUTPUT)?)?,
        output: Output::read(sections.one(&OUTPUT)?)?,
        axle_load,
        mix: mix?,
        maintenance,
        inspection: match inspection {
            Some(read) => Some(read?),
            None => None,
        },
        scatter: match scatter {
            Some(read) => Some(read?),
            None => None,
        },
        written: Written::of(&sections),
    };
    check_size(&case, &sections, sizes, report).then_some(case)
}

/// A wheel of a mix with its passage, in its own half-width.
fn place_wheel(
    read: ReadWheel,
    sections: &Sections,
    network: Option<&CrackNetwork>,
    report: &mut Report,
) -> Option<MixedWheel> {
    let section = sections.one(&PASSAGE)?;
    let passage = read_passage(section, Some(read.wheel.half_width()), network, report)?;
    let passages = read_passages(section, passage)?;
    let ReadWheel { name, share, axle_load, wheel } = read;
    Some(MixedWheel { name, share, axle_load, wheel, passages })
}

/// Whether the engine is that in space.
fn is_in_space(sections: &Sections) -> bool {
    let engine = sections.one(&SOLVER).and_then(|solver| solver.get(ENGINE));
    engine.is_some_and(Engine::is_in_space)
}

/// The part of the contacts that the engine needs.
fn contact_extent(sections: &Sections) -> ContactExtent {
    if is_in_space(sections) { ContactExtent::Ellipse } else { ContactExtent::Strip }
}

/// The one wheel of the case.
fn read_wheel(
    sections: &Sections,
    steel: Option<&IsotropicElastic>,
    folder: &Path,
    report: &mut Report,
) -> Option<GivenWheel> {
    let of_wheel = WheelSections {
        contact: sections.one(&CONTACT)?,
        track: sections.one(&TRACK),
        temperature: sections.one(&TEMPERATURE),
        extent: contact_extent(sections),
    };
    let travel = sections.one(&PASSAGE).and_then(read_travel)?;
    GivenWheel::read(of_wheel, steel?, travel, folder, report)
}

/// Fracture where it is given; none where it cannot be read.
#[expect(clippy::option_option, reason = "a case without it, and a section with errors")]
fn read_fracture(
    sections: &Sections,
    temperature: Option<Temperature>,
    folder: &Path,
    report: &mut Report,
) -> Option<Option<Fracture>> {
    if sections.one(&TEMPERATURE).is_some() && temperature.is_none() {
        return None;
    }
    match sections.one(&FRACTURE) {
        Some(section) => Fracture::read(section, temperature.as_ref(), folder, report).map(Some),
        None => Some(None),
    }
}

/// The plastic state is that of the contact alone.
fn check_rolled(sections: &Sections, report: &mut Report) {
    let help = "give a field or profile in [plastic_stress], computed for the same rail without this section";
    if let Some(track) = sections.one(&TRACK) {
        let says =
            "bends the rail, but the plastic state of [plastic_stress] is computed for the contact alone";
        report.add(track.fault(FOUNDATION, says).help(help));
    }
    if let Some(temperature) = sections.one(&TEMPERATURE) {
        let says =
            "stresses the rail, but the plastic state of [plastic_stress] is computed for the contact alone";
        report.add(temperature.fault(RAIL_TEMPERATURE, says).help(help));
    }
}

/// Smallest gap between the contact and the side of a block, over the half-width: if it is closer,
/// the sides carry part of the contact load.
const SIDE_GAP: f64 = 1.0;

/// Groups are for dry cracks in a half-plane and Newton's method.
fn check_network(sections: &Sections, (has_fluid, is_block): (bool, bool), report: &mut Report) {
    let Some(solver) = sections.one(&SOLVER) else { return };
    if solver.get(NETWORK) != Some(NetworkContact::Groups) {
        return;
    }
    let help = "network = \"whole\" solves all cracks together, with either plane engine";
    let mut refuse = |says: &str| report.add(solver.fault(NETWORK, says).help(help));
    if solver.get(ENGINE).is_some_and(Engine::is_in_space) {
        refuse("is \"groups\", which is not available with solver.engine = \"space\"");
    }
    if is_block {
        refuse("is \"groups\", which requires rail.boundary = \"half-plane\"");
    }
    if solver.get(SOLVER_CONTACT) == Some(ContactSolver::Latin) {
        refuse("is \"groups\", which requires solver.contact = \"newton\"");
    }
    if has_fluid {
        refuse("is \"groups\", which requires dry cracks, and there is a section [fluid]");
    }
}

/// A block needs the finite-element engine, and a wheel that stays on its top.
fn check_block(
    rail: &Rail,
    sections: &Sections,
    wheel: Option<(&GivenWheel, &Passage)>,
    report: &mut Report,
) {
    if let Some(solver) = sections.one(&SOLVER)
        && solver.get(ENGINE).is_some_and(|engine| engine.domain() == EngineDomain::HalfPlane)
    {
        let says = "computes a half-plane only, and rail.boundary is \"block\"";
        let help = "engine = \"xfem\" computes a block; boundary = \"half-plane\" suits both engines";
        report.add(solver.fault(ENGINE, says).help(help));
    }
    if let Some(track) = sections.one(&TRACK) {
        let says = "bends a rail over several metres, but a block of rail.width_mm bends on its own supports";
        let help = "use rail.boundary = \"half-plane\", or leave [track] out";
        report.add(track.fault(FOUNDATION, says).help(help));
    }
    if let Some(temperature) = sections.one(&TEMPERATURE) {
        let says = "describes a long rail that is restrained lengthwise, but the sides of a block would move";
        let help = "use rail.boundary = \"half-plane\", or leave [temperature] out";
        report.add(temperature.fault(RAIL_TEMPERATURE, says).help(help));
    }
    let (Some((wheel, passage)), Some(section)) = (wheel, sections.one(&PASSAGE)) else { return };
    let contact = wheel.contact();
    let reach = 0.5 * rail.extent.width - contact.reach() - SIDE_GAP * contact.half_width();
    let (left, right) = (rail.extent.centre - reach, rail.extent.centre + reach);
    for (key, at) in [(FROM, passage.from), (TO, passage.to)] {
        if (at - rail.extent.centre).abs() > reach {
            let [at, left, right] = [at, left, right].map(short);
            let says = format!(
                "puts the wheel at x = {at} mm; on top of the block it must stay between {left} and {right} mm"
            );
            report.add(
                section.fault(key, says).help("use a wider block ([rail] width_mm) or a shorter passage"),
            );
        }
    }
}

/// A residual stress is a total, and the computed state starts from a manufacturing stress of its
/// own.
fn refuse_counting_twice(plastic: &SectionValues, report: &mut Report) {
    let says =
        "without a field, this is the stress left by rolling, but `[residual_stress]` is already the total";
    let help = "give a stress that was present before the first passage as `initial_residual` of [shakedown]";
    report.add(plastic.fault_of_all(says).help(help));
}

//! From accepted values to a case: checks that involve several keys.

use super::by_geometry::ByGeometry;
use super::case::Case;
use super::coupled::check_coupled;
use super::cracks::{Meetings, check_fit, place_cracks};
use super::finite_section::check_section;
use super::in_page::check_explorer;
use super::limits::{WantedSize, check_size};
use super::mix::{MixedWheel, read_mix, require_axle_load};
use super::read_wheel::ReadWheel;
use super::space::{read_space, refuse_free_front, refuse_strike};
use crate::files::read_profile;
use crate::schema::{Report, SectionValues, Sections, Value, Written, short};
use crate::tables::{
    AXLE_LOAD, CALIBRATION, CENTRE, CONTACT, CRACK, CalibrationPrior, ContactExtent, ContactSolver, ENGINE,
    Engine, EngineDomain, FLUID, FOUNDATION, FRACTURE, FROM, FieldOutput, Fracture, GROWTH, GivenWheel,
    INSPECTION, MAINTENANCE, MESH, MGT_PER_YEAR, MeshSettings, NETWORK, OUTPUT, Output, PASSAGE,
    PLASTIC_STRESS, PROFILE, PlasticSource, RAIL, RAIL_TEMPERATURE, RESIDUAL_STRESS, Rail, SCATTER,
    SHAKEDOWN, SOLVER, SOLVER_CONTACT, Scattering, ShakedownSettings, TEMPERATURE, TITLE, TO, TOP, TRACK,
    TRAFFIC, WHEEL, WHEEL_TEMPERATURE, WHEEL_TRACK, WIDTH, WheelSections, YIELD_STRESS, is_of_the_steel,
    read_calibration, read_fluid, read_growth, read_inspection, read_maintenance, read_passage,
    read_passages, read_risk, read_scatter, read_steel, read_travel,
};
use railcrack::bulk::Boundary;
use railcrack::contact::{CrackFluid, FluidModel};
use railcrack::crack::CrackNetwork;
use railcrack::growth::{GrowthSettings, NetworkContact};
use railcrack::load::{Passage, Temperature};
use railcrack::material::IsotropicElastic;
use railcrack::math::MPA_SQRT_MM;
use std::path::Path;

/// The case that `sections` describe; none if something is wrong or missing; errors are added to
/// `report`.
///
/// Every part is built, even where another is wrong, so that all errors are found at once. `sizes`
/// are those of other cases of the same study.
pub(crate) fn build(
    mut sections: Sections,
    folder: &Path,
    sizes: &ByGeometry<WantedSize>,
    report: &mut Report,
) -> Option<Case> {
    let rail_section = sections.one(&RAIL);
    let steel = rail_section.and_then(|s| read_steel(s, report));
    let crack_sections: Vec<&SectionValues> = sections.all(&CRACK).collect();
    let meetings = if is_in_space(&sections) { Meetings::InSpace } else { Meetings::InThePlane };
    let placed = place_cracks(&crack_sections, meetings, report);
    let network = placed.as_ref().map(|placed| &placed.network);
    let growth = sections.one(&GROWTH).and_then(|s| read_growth(s, folder, report));
    let mut wheel_table = None;
    let mix = if sections.all(&WHEEL).next().is_some() {
        let law = growth.as_ref().map(|growth| &growth.settings.law);
        let extent = contact_extent(&sections);
        let read = read_mix(&sections, steel.as_ref(), extent, (network, law), folder, report);
        read.map(|(wheels, table)| {
            wheel_table = table;
            Some(wheels)
        })
    } else {
        Some(None)
    };
    let first = mix.as_ref().and_then(|mix| mix.as_ref()?.first());
    let wheel = match &mix {
        Some(Some(_)) => first.map(|first| first.wheel.clone()),
        Some(None) => read_wheel(&sections, steel.as_ref(), folder, report),
        None => None,
    };
    let travel = first.map(|first| first.travel).or_else(|| sections.one(&PASSAGE).and_then(read_travel));
    let rail = rail_section.and_then(|s| Rail::read(s, network));
    if let (Some(rail), Some(placed)) = (&rail, &placed) {
        check_fit(placed, rail, &crack_sections, report);
    }
    let passage = sections
        .one(&PASSAGE)
        .and_then(|s| read_passage(s, wheel.as_ref().map(GivenWheel::half_width), travel, network, report));
    if let Some(rail) = rail.filter(|rail| rail.boundary != Boundary::HalfPlane) {
        check_block(&rail, &sections, wheel.as_ref().zip(passage.as_ref()), report);
    }
    let fluid = match sections.one(&FLUID).zip(network) {
        Some((section, network)) => read_fluid(section, network, report),
        None => Some(None),
    };
    let mix = mix.and_then(|mix| {
        let place = |read: ReadWheel| place_wheel(read, &sections, fluid.as_ref(), network, report);
        // All of them, so that all errors are found at once.
        let placed: Vec<Option<MixedWheel>> = mix.unwrap_or_default().into_iter().map(place).collect();
        placed.into_iter().collect::<Option<Vec<MixedWheel>>>()
    });
    let fluid = match mix.as_ref().and_then(|mix| mix.first()) {
        Some(first) => Some(first.fluid.clone()),
        None => fluid,
    };
    let of_wheels = mix.iter().flatten().filter_map(|wheel| wheel.fluid.as_ref());
    let fluids = fluid.iter().flatten().chain(of_wheels);
    check_coupled(&sections, rail.as_ref().map(|rail| rail.boundary), fluids, report);
    let bent = wheel.iter().chain(mix.iter().flatten().map(|mixed| &mixed.wheel));
    check_section(&sections, rail.as_ref(), bent.filter_map(|wheel| wheel.load.track.as_ref()), report);
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
    if let Some(steel) = growth.as_ref().and_then(|growth| growth.steel)
        && let Some(section) = sections.one(&GROWTH).cloned()
    {
        sections.leave_out(&GROWTH, |key| is_of_the_steel(&section, steel, key));
    }
    let of_law = growth.as_ref().and_then(|growth| growth.steel);
    let shakedown = sections.one(&SHAKEDOWN).and_then(|s| ShakedownSettings::read(s, of_law, folder, report));
    if shakedown.as_ref().is_some_and(|shakedown| shakedown.steel.is_some()) {
        // A stored case takes the yield stress from the steel again.
        sections.leave_out(&SHAKEDOWN, |key| key.name == YIELD_STRESS.key.name);
    }
    let temperature = wheel.as_ref().and_then(|wheel| wheel.load.temperature);
    let fracture = read_fracture(&sections, temperature, folder, report);
    let traffic = sections.one(&TRAFFIC).and_then(|s| s.get(AXLE_LOAD));
    let mean = |mix: &Vec<MixedWheel>| -> Option<f64> {
        mix.iter().map(|wheel| Some(wheel.share * wheel.axle_load?)).sum()
    };
    let axle_load = mix.as_ref().and_then(|mix| if mix.is_empty() { traffic } else { mean(mix) });
    if let (Some(section), Some(_), None) = (sections.one(&TRAFFIC), &mix, axle_load) {
        require_axle_load(section, report);
    }
    // A missing axle load is one error.
    let counts_tonnes = axle_load.is_some() || sections.one(&TRAFFIC).is_some();
    let maintenance = sections.one(&MAINTENANCE);
    let maintenance = maintenance.map(|s| read_maintenance(s, counts_tonnes, report));
    let inspection = sections.one(&INSPECTION);
    let risk = inspection.map(|s| read_risk(s, folder, report));
    let inspection = inspection.map(|s| read_inspection(s, counts_tonnes, report));
    let toughness = fracture.as_ref().and_then(|fracture| Some(fracture.as_ref()?.at_rail));
    let steel_of_law = growth.as_ref().and_then(|growth| growth.steel);
    let scatter = sections.one(&SCATTER);
    let scattering = Scattering {
        toughness,
        steel: steel_of_law,
        has_tonnes: counts_tonnes,
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
            let wheels = (wheels.as_deref(), wheel_table.as_ref());
            read_space(&sections, placed.as_ref(), wheels, rail.as_ref(), report).map(Some)
        }
        false => {
            refuse_strike(&sections, report);
            refuse_free_front(&sections, report);
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
    let traps = |fluid: &CrackFluid| matches!(fluid.model, FluidModel::Trapped { .. });
    let is_trapped = fluid.iter().flatten().any(&traps)
        || mix.iter().flatten().filter_map(|wheel| wheel.fluid.as_ref()).any(&traps);
    check_network(&sections, (is_trapped, is_block), report);
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
            maintenance: maintenance.zip(axle_load).map(|(removal, tonnes)| removal.over_axles(tonnes)),
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
        wheel_table,
        maintenance,
        inspection: match inspection {
            Some(read) => Some(read?),
            None => None,
        },
        inspection_risk: match risk {
            Some(read) => Some(read?),
            None => None,
        },
        mgt_per_year: sections.one(&TRAFFIC).and_then(|s| s.get(MGT_PER_YEAR)),
        scatter: match scatter {
            Some(read) => Some(read?),
            None => None,
        },
        calibration: calibration(&sections),
        written: Written::of(&sections),
    };
    let is_possible = check_size(&case, &sections, sizes, report);
    if is_possible {
        check_explorer(&case, &sections, report);
    }
    is_possible.then_some(case)
}

/// A wheel of a mix with its passage, in its own half-width, and its fluid, by default that of the
/// case.
fn place_wheel(
    read: ReadWheel,
    sections: &Sections,
    of_case: Option<&Option<CrackFluid>>,
    network: Option<&CrackNetwork>,
    report: &mut Report,
) -> Option<MixedWheel> {
    let section = sections.one(&PASSAGE)?;
    let ReadWheel { name, share, axle_load, wheel, travel, fluid } = read;
    let fluid = match &fluid {
        Some(own) => read_fluid(own, network?, report),
        None => of_case.cloned(),
    };
    let passage = read_passage(section, Some(wheel.half_width()), Some(travel), network, report)?;
    let passages = read_passages(section, passage)?;
    Some(MixedWheel { name, share, axle_load, wheel, fluid: fluid?, passages })
}

/// Whether the engine is that in space.
fn is_in_space(sections: &Sections) -> bool {
    let engine = sections.one(&SOLVER).and_then(|solver| solver.get(ENGINE));
    engine.is_some_and(Engine::is_in_space)
}

/// The prior of a calibration, by default that of the validation suite in the geometry of the case.
fn calibration(sections: &Sections) -> CalibrationPrior {
    let suite = if is_in_space(sections) { CalibrationPrior::SPACE } else { CalibrationPrior::PLANE };
    sections.one(&CALIBRATION).and_then(|section| read_calibration(section, suite)).unwrap_or(suite)
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

/// Smallest gap between the contact and the side of a block, over the half-width: if it is closer,
/// the sides carry part of the contact load.
const SIDE_GAP: f64 = 1.0;

/// Groups are for cracks in a half-plane, Newton's method and engines that compute the forces
/// between cracks one pair at a time.
fn check_network(sections: &Sections, (is_trapped, is_block): (bool, bool), report: &mut Report) {
    let Some(solver) = sections.one(&SOLVER) else { return };
    if solver.get(NETWORK) != Some(NetworkContact::Groups) {
        return;
    }
    let whole = "network = \"whole\" solves all cracks together";
    let mut refuse = |says: &str, help: &str| report.add(solver.fault(NETWORK, says).help(help));
    if is_block {
        refuse("is \"groups\", which requires rail.boundary = \"half-plane\"", whole);
    } else if solver.get(ENGINE).is_some_and(|engine| engine.domain() == EngineDomain::Rail) {
        let help = "engine = \"dislocation\" follows long rows of cracks in groups; network = \"whole\" solves all cracks together";
        refuse("is \"groups\", which finite elements do not support", help);
    }
    if is_trapped {
        refuse("is \"groups\", which does not resolve the seal of trapped fluid", whole);
    }
    if solver.get(SOLVER_CONTACT) == Some(ContactSolver::Latin) {
        refuse("is \"groups\", which requires solver.contact = \"newton\"", whole);
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
    if let Some(track) = sections.one(&TRACK).or_else(|| sections.all(&WHEEL_TRACK).next()) {
        let says = "bends a rail over several metres, but a block of rail.width_mm bends on its own supports";
        let help = "use rail.boundary = \"half-plane\", or leave [track] out";
        report.add(track.fault(FOUNDATION, says).help(help));
    }
    let temperature = sections.one(&TEMPERATURE).or_else(|| sections.all(&WHEEL_TEMPERATURE).next());
    if let Some(temperature) = temperature {
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

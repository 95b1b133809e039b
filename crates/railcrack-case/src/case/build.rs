//! From accepted values to a case: checks that involve several keys.

use super::by_geometry::ByGeometry;
use super::case::Case;
use super::coupled::check_coupled;
use super::cracks::{Meetings, check_fit, place_cracks};
use super::finite_section::check_section;
use super::in_page::check_explorer;
use super::limits::{WantedSize, check_size};
use super::space::{read_space, refuse_free_front, refuse_strike};
use super::traffic::{Traffic, TrafficContext, read_traffic, require_axle_load};
use super::traffic_wheel::{TrafficWheel, mean_axle_load};
use crate::files::read_profile;
use crate::schema::{KeyRow, Report, SectionValues, Sections, Value, Written, short};
use crate::tables::{
    CALIBRATION, CENTRE, CRACK, CalibrationPrior, ContactExtent, ContactSolver, ENGINE, Engine, EngineDomain,
    FOUNDATION, FRACTURE, FROM, FieldOutput, Fracture, GROWTH, INSPECTION, MAINTENANCE, MESH, MGT_PER_YEAR,
    MeshSettings, NETWORK, OUTPUT, Output, PASSAGE, PLASTIC_STRESS, PROFILE, PlasticSource, RAIL,
    RAIL_TEMPERATURE, RESIDUAL_STRESS, Rail, SCATTER, SHAKEDOWN, SOLVER, SOLVER_CONTACT, Scattering,
    ShakedownSettings, TEMPERATURE, TITLE, TO, TOP, TRACK, TRAFFIC, WHEEL_TEMPERATURE, WHEEL_TRACK, WIDTH,
    YIELD_STRESS, is_of_the_steel, read_calibration, read_growth, read_inspection, read_maintenance,
    read_risk, read_scatter, read_steel,
};
use railcrack::bulk::Boundary;
use railcrack::contact::{CrackFluid, FluidModel};
use railcrack::growth::{GrowthSettings, NetworkContact};
use railcrack::load::Temperature;
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
    let context = TrafficContext {
        sections: &sections,
        steel: steel.as_ref(),
        network,
        extent: contact_extent(&sections),
        folder,
    };
    let traffic = read_traffic(context, report);
    let wheels = traffic.as_ref().map(|traffic| traffic.wheels.as_slice());
    let rail = rail_section.and_then(|s| Rail::read(s, network));
    if let (Some(rail), Some(placed)) = (&rail, &placed) {
        check_fit(placed, rail, &crack_sections, report);
    }
    if let Some(rail) = rail.filter(|rail| rail.boundary != Boundary::HalfPlane) {
        check_block(&rail, &sections, wheels.unwrap_or_default(), report);
    }
    let of_wheels = || wheels.into_iter().flatten();
    let fluids = || of_wheels().filter_map(|wheel| wheel.fluid.as_ref());
    check_coupled(&sections, rail.as_ref().map(|rail| rail.boundary), fluids(), report);
    let tracks = of_wheels().filter_map(|wheel| wheel.wheel.track.as_ref());
    check_section(&sections, rail.as_ref(), tracks, report);
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
    let temperature = wheels.and_then(|wheels| wheels.first()?.wheel.temperature);
    let fracture = read_fracture(&sections, temperature, folder, report);
    let axle_load = wheels.and_then(mean_axle_load);
    if let (Some(section), Some(_), None) = (sections.one(&TRAFFIC), wheels, axle_load) {
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
        is_mix: wheels.is_none_or(|wheels| wheels.len() > 1),
    };
    let scatter = scatter.map(|s| read_scatter(s, scattering, report));
    let space = match is_in_space(&sections) {
        true => read_space(&sections, placed.as_ref(), wheels, rail.as_ref(), report).map(Some),
        false => {
            refuse_strike(&sections, report);
            refuse_free_front(&sections, report);
            Some(None)
        }
    };
    let maintenance = match maintenance {
        Some(read) => Some(read?),
        None => None,
    };
    let is_block = rail.is_some_and(|rail| matches!(rail.boundary, Boundary::Block { .. }));
    let traps = |fluid: &CrackFluid| matches!(fluid.model, FluidModel::Trapped { .. });
    let is_trapped = fluids().any(traps);
    check_network(&sections, (is_trapped, is_block), report);
    let (Traffic { wheels, table: wheel_table }, placed, rail) = (traffic?, placed?, rail?);
    // A stored case records the middle of the rail, and how far it reaches.
    sections.settle(&RAIL, CENTRE, Value::Number(rail.extent.centre));
    sections.settle(&RAIL, WIDTH, Value::Number(rail.extent.width));
    let solver = sections.one(&SOLVER)?;
    let case = Case {
        title: sections.one(&TOP)?.get(TITLE)?,
        steel: steel?,
        rail,
        wheels,
        wheel_table,
        cracks: placed.network,
        crack_friction: placed.friction,
        residual_stress,
        plastic_stress,
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

/// A block needs the finite-element engine, and wheels that stay on its top.
fn check_block(rail: &Rail, sections: &Sections, wheels: &[TrafficWheel], report: &mut Report) {
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
    let Some(section) = sections.one(&PASSAGE) else { return };
    let left = |wheel: &TrafficWheel| {
        let contact = wheel.wheel.contact()?;
        let reach = 0.5 * rail.extent.width - contact.reach() - SIDE_GAP * contact.half_width();
        let passage = wheel.passages.passage;
        let ends = [(FROM, passage.from), (TO, passage.to)];
        let beyond = |(_, at): &(KeyRow<f64>, f64)| (at - rail.extent.centre).abs() > reach;
        Some((ends.into_iter().filter(beyond).collect::<Vec<_>>(), reach))
    };
    // Of many wheels the first that leaves it.
    if let Some((ends, reach)) = wheels.iter().filter_map(left).find(|(ends, _)| !ends.is_empty()) {
        for (key, at) in ends {
            let centre = rail.extent.centre;
            let [at, left, right] = [at, centre - reach, centre + reach].map(short);
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

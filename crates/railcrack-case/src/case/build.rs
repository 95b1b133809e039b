//! From accepted values to a case: checks that involve several keys.

use super::by_geometry::ByGeometry;
use super::case::Case;
use super::coupled::check_coupled;
use super::crack_rows::write_out;
use super::cracks::{PlacedCracks, check_fit, place_cracks};
use super::finite_section::check_section;
use super::geometry::Geometry;
use super::in_page::check_explorer;
use super::limits::{WantedSize, check_size};
use super::plane::read_plane;
use super::space::read_space;
use super::traffic::{Traffic, read_traffic, require_axle_load};
use super::traffic_wheel::TrafficContext;
use super::traffic_wheel::{TrafficWheel, mean_axle_load};
use crate::files::{CrackTableFile, ProfileFile, read_profile};
use crate::schema::{KeyRow, Report, SectionValues, Sections, Value, Written, short};
use crate::tables::{
    BOUNDARY, BoundaryKind, CALIBRATION, CENTRE, CRACK, CalibrationPrior, ContactSolver, ENGINE, Engine,
    FOUNDATION, FRACTURE, FROM, FieldOutput, Fracture, GROWTH, Growing, INSPECTION, Inspection,
    InspectionRisk, MAINTENANCE, MGT_PER_YEAR, NETWORK, OUTPUT, Output, PASSAGE, PROFILE, PathGiven,
    PlaneEngine, PossibleExtent, RAIL, RAIL_TEMPERATURE, RESIDUAL_STRESS, Rail, SCATTER, SHAKEDOWN, SOLVER,
    SOLVER_CONTACT, STRAIGHT_BY_DEFAULT, STRAIGHT_TO, Scatter, Scattering, ShakedownSettings, TEMPERATURE,
    TITLE, TO, TOP, TRACK, TRAFFIC, WHEEL_TEMPERATURE, WHEEL_TRACK, WIDTH, YIELD_STRESS, engine_of,
    is_of_the_steel, read_calibration, read_growth, read_inspection, read_maintenance, read_risk,
    read_scatter, read_steel,
};
use railcrack::bulk::Boundary;
use railcrack::contact::{CrackFluid, FluidModel};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{Answer, GrowthSettings, Mgt, NetworkContact, SurfaceRemoval};
use railcrack::load::Temperature;
use railcrack::material::IsotropicElastic;
use railcrack::math::MPA_SQRT_MM;
use std::path::Path;

/// The case that the sections `given` describe; none if something is wrong or missing; errors are
/// added to `report`.
///
/// Every part is built, even where another is wrong, so that all errors are found at once. `sizes`
/// are those of other cases of the same study.
pub(crate) fn build(
    mut given: Sections,
    folder: &Path,
    sizes: &ByGeometry<WantedSize>,
    report: &mut Report,
) -> Option<Case> {
    let (sections, crack_table) = write_out(&given, folder, report);
    let parts = Parts::read(&sections, folder, report);
    parts.check(&sections, report);
    let upkeep = Upkeep::read(&parts, &sections, folder, report);
    parts.settle(&mut given);
    let case = case_of(parts, upkeep, &sections, (Written::of(&given), crack_table))?;
    let is_possible = check_size(&case, &sections, sizes, report);
    if is_possible {
        check_explorer(&case, &sections, report);
    }
    is_possible.then_some(case)
}

/// Something is wrong, as the report says.
struct Refused;

/// The value of a section that may be left out: none without it.
///
/// Errors: the section has errors.
fn optional<T>(
    section: Option<&SectionValues>,
    read: impl FnOnce(&SectionValues) -> Option<T>,
) -> Result<Option<T>, Refused> {
    section.map(|section| read(section).ok_or(Refused)).transpose()
}

/// Rail, cracks, wheels, stresses and growth of a case, each none where something is wrong with it.
struct Parts {
    steel: Option<IsotropicElastic>,
    placed: Option<PlacedCracks>,
    rail: Option<Rail>,
    traffic: Option<Traffic>,
    residual_stress: Result<Option<ProfileFile>, Refused>,
    growth: Option<Growing>,
    shakedown: Option<ShakedownSettings>,
    fracture: Result<Option<Fracture>, Refused>,
    geometry: Option<Geometry>,
}

impl Parts {
    fn read(sections: &Sections, folder: &Path, report: &mut Report) -> Self {
        let rail = sections.one(&RAIL);
        let steel = rail.and_then(|section| read_steel(section, report));
        let cracks: Vec<&SectionValues> = sections.all(&CRACK).collect();
        let engine = engine_of(sections);
        let placed = place_cracks(&cracks, engine, report);
        let network = placed.as_ref().map(|placed| &placed.network);
        let growth = sections.one(&GROWTH).and_then(|section| read_growth(section, folder, report));
        let extent = possible_extent(sections);
        let context = TrafficContext { sections, steel: steel.as_ref(), network, extent, folder };
        let traffic = read_traffic(context, report);
        let wheels = traffic.as_ref().map(|traffic| traffic.wheels.as_slice());
        let rail = rail.and_then(|section| {
            let track = sections.one(&TRACK).or_else(|| sections.all(&WHEEL_TRACK).next());
            Rail::read(section, track, network)
        });
        let of_law = growth.as_ref().and_then(|growth| growth.steel);
        let shakedown = sections.one(&SHAKEDOWN);
        let temperatures: Vec<Temperature> =
            wheels.into_iter().flatten().filter_map(|wheel| wheel.wheel.temperature).collect();
        let geometry = match engine {
            Some(Engine::Space) => {
                read_space(sections, placed.as_ref(), wheels, rail.as_ref(), folder, report)
                    .map(Geometry::Space)
            }
            _ => read_plane(sections, placed.as_ref(), rail.as_ref(), folder, report).map(Geometry::Plane),
        };
        Self {
            residual_stress: optional(sections.one(&RESIDUAL_STRESS), |section| {
                read_profile(section, PROFILE, folder, report)
            }),
            shakedown: shakedown.and_then(|section| ShakedownSettings::read(section, of_law, folder, report)),
            fracture: optional(sections.one(&FRACTURE), |section| {
                // A temperature with errors is not an absent one.
                let is_known = !temperatures.is_empty() || sections.one(&TEMPERATURE).is_none();
                is_known.then(|| Fracture::read(section, &temperatures, folder, report)).flatten()
            }),
            steel,
            rail,
            placed,
            traffic,
            growth,
            geometry,
        }
    }

    fn wheels(&self) -> Option<&[TrafficWheel]> {
        self.traffic.as_ref().map(|traffic| traffic.wheels.as_slice())
    }

    /// The steel of the growth law, where it has a name.
    fn steel_of_law(&self) -> Option<&'static RailSteel> {
        self.growth.as_ref().and_then(|growth| growth.steel)
    }

    /// Reports sections that exclude one another.
    fn check(&self, sections: &Sections, report: &mut Report) {
        let wheels = self.wheels().unwrap_or_default();
        if let (Some(rail), Some(placed)) = (&self.rail, &self.placed) {
            check_fit(placed, rail.extent, &sections.all(&CRACK).collect::<Vec<_>>(), report);
        }
        let boundary = self.rail.map(|rail| rail.boundary);
        let block = self.rail.filter(|rail| rail.boundary != Boundary::HalfPlane);
        if let Some(rail) = &block {
            check_block(rail, sections, wheels, report);
        }
        let fluids = || wheels.iter().filter_map(|wheel| wheel.fluid.as_ref());
        check_coupled(sections, boundary, fluids(), report);
        let tracks = wheels.iter().filter_map(|wheel| wheel.wheel.track.as_ref());
        check_section(sections, self.rail.as_ref(), tracks, report);
        check_network(sections, (fluids().any(traps), block.is_some()), report);
    }

    /// Whether paths go straight on as those of head checks are measured to do: in the plane, where
    /// the case is inspected and says nothing of its paths.
    fn goes_straight(&self, sections: &Sections) -> bool {
        let is_silent = self.growth.as_ref().is_some_and(|growth| growth.path == PathGiven::ByDefault);
        let is_plane = engine_of(sections) != Some(Engine::Space);
        is_silent && is_plane && sections.one(&INSPECTION).is_some()
    }

    /// Makes the text of the case say what follows from its other keys.
    fn settle(&self, sections: &mut Sections) {
        if let (Some(steel), Some(section)) = (self.steel_of_law(), sections.one(&GROWTH).cloned()) {
            sections.leave_out(&GROWTH, |key| is_of_the_steel(&section, steel, key));
        }
        if self.shakedown.as_ref().is_some_and(|shakedown| shakedown.steel.is_some()) {
            // A stored case takes the yield stress from the steel again.
            sections.leave_out(&SHAKEDOWN, |key| key.name == YIELD_STRESS.key.name);
        }
        if self.goes_straight(sections) {
            sections.settle(&GROWTH, STRAIGHT_TO, Value::Number(STRAIGHT_BY_DEFAULT));
        }
        // A stored case records the middle of the rail, and how far it reaches.
        if let Some(rail) = self.rail {
            sections.settle(&RAIL, CENTRE, Value::Number(rail.extent.centre));
            sections.settle(&RAIL, WIDTH, Value::Number(rail.extent.width));
        }
    }
}

/// Traffic in tonnes, and the sections that count in them.
struct Upkeep {
    axle_load: Option<f64>,
    maintenance: Result<Option<SurfaceRemoval<Mgt>>, Refused>,
    inspection: Result<Option<Inspection>, Refused>,
    inspection_risk: Result<Option<InspectionRisk>, Refused>,
    scatter: Result<Option<Scatter>, Refused>,
}

impl Upkeep {
    fn read(parts: &Parts, sections: &Sections, folder: &Path, report: &mut Report) -> Self {
        let axle_load = parts.wheels().and_then(mean_axle_load);
        if let (Some(section), Some(_), None) = (sections.one(&TRAFFIC), parts.wheels(), axle_load) {
            require_axle_load(section, report);
        }
        // A missing axle load is one error.
        let has_tonnes = axle_load.is_some() || sections.one(&TRAFFIC).is_some();
        let fracture = parts.fracture.as_ref().ok().and_then(Option::as_ref);
        let scattering = Scattering {
            toughness: fracture.map(|fracture| fracture.at_rail),
            steel: parts.steel_of_law(),
            has_tonnes,
            prior: calibration(sections),
            is_maintained: sections.one(&MAINTENANCE).is_some(),
            is_mix: parts.wheels().is_none_or(|wheels| wheels.len() > 1),
        };
        let inspection = sections.one(&INSPECTION);
        Self {
            axle_load,
            maintenance: optional(sections.one(&MAINTENANCE), |section| {
                read_maintenance(section, has_tonnes, report)
            }),
            inspection_risk: optional(inspection, |section| read_risk(section, folder, report)),
            inspection: optional(inspection, |section| read_inspection(section, has_tonnes, report)),
            scatter: optional(sections.one(&SCATTER), |section| read_scatter(section, scattering, report)),
        }
    }
}

/// The case of parts without errors, with its text and the list of its cracks.
fn case_of(
    parts: Parts,
    upkeep: Upkeep,
    sections: &Sections,
    (written, crack_table): (Written, Option<CrackTableFile>),
) -> Option<Case> {
    let goes_straight = parts.goes_straight(sections);
    let Traffic { wheels, table: wheel_table } = parts.traffic?;
    let (placed, growth, fracture, geometry) =
        (parts.placed?, parts.growth?, parts.fracture.ok()?, parts.geometry?);
    let (maintenance, axle_load) = (upkeep.maintenance.ok()?, upkeep.axle_load);
    let inspection = upkeep.inspection.ok()?;
    let (solver, output) = (sections.one(&SOLVER)?, sections.one(&OUTPUT)?);
    // A crack in space has no kink to test.
    let arresting = fracture.as_ref().filter(|_| matches!(geometry, Geometry::Plane(_)));
    let case = Case {
        title: sections.one(&TOP)?.get(TITLE)?,
        steel: parts.steel?,
        rail: parts.rail?.extent,
        wheels,
        wheel_table,
        cracks: placed.network,
        crack_friction: placed.friction,
        crack_table,
        residual_stress: parts.residual_stress.ok()?,
        shakedown: parts.shakedown?,
        growth: GrowthSettings {
            toughness: fracture.as_ref().map(|fracture| MPA_SQRT_MM * fracture.at_rail),
            pop_in: arresting.and_then(|fracture| fracture.pop_in),
            maintenance: maintenance.zip(axle_load).map(|(removal, tonnes)| removal.over_axles(tonnes)),
            straight_depth: if goes_straight { STRAIGHT_BY_DEFAULT } else { growth.settings.straight_depth },
            ..asking(&growth.settings, inspection.as_ref(), fracture.is_some())
        },
        growth_steel: growth.steel,
        growth_rates: growth.rates,
        fracture,
        geometry,
        network: NetworkContact::Whole,
        fields: FieldOutput::read(output)?,
        output: Output::read(output)?,
        axle_load,
        maintenance,
        inspection,
        inspection_risk: upkeep.inspection_risk.ok()?,
        mgt_per_year: sections.one(&TRAFFIC).and_then(|section| section.get(MGT_PER_YEAR)),
        scatter: upkeep.scatter.ok()?,
        calibration: calibration(sections),
        written,
    };
    let network = solver.get(NETWORK).unwrap_or_else(|| network_by_default(&case));
    Some(Case { network, ..case })
}

/// Whether `fluid` is trapped, so that its pressure depends on when the mouth is sealed.
fn traps(fluid: &CrackFluid) -> bool {
    matches!(fluid.model, FluidModel::Trapped { .. })
}

/// Cracks from which on groups are faster than all cracks together, twice at 30.
const MANY_CRACKS: usize = 24;

/// How the contact conditions of `case` are solved where it does not say.
fn network_by_default(case: &Case) -> NetworkContact {
    let allows_groups = case.engine() == Engine::Plane(PlaneEngine::Dislocation)
        && case.contact_solver() == ContactSolver::Newton
        && case.plane().is_some_and(|plane| plane.section.is_none())
        && case.fields.every == 0
        && !case.has_coupled_wheel()
        && !case.wheels.iter().filter_map(|wheel| wheel.fluid.as_ref()).any(traps);
    match allows_groups && case.cracks.cracks().len() >= MANY_CRACKS {
        true => NetworkContact::Groups,
        false => NetworkContact::Whole,
    }
}

/// The `settings` in a case with `inspection` whose rail may break if it `has_fracture`: without a
/// number of increments, the run goes on until it has its answer, if it is asked for one.
fn asking(settings: &GrowthSettings, inspection: Option<&Inspection>, has_fracture: bool) -> GrowthSettings {
    let settings = settings.clone();
    if settings.answer.is_none() {
        return settings;
    }
    let critical_depth = inspection.and_then(|inspection| inspection.critical_depth);
    let limits = [critical_depth, settings.critical_length, settings.stop_after_cycles];
    if has_fracture || limits.iter().any(Option::is_some) {
        return GrowthSettings { answer: Some(Answer { critical_depth }), ..settings };
    }
    GrowthSettings { answer: None, steps: GrowthSettings::REFERENCE.steps, ..settings }
}

/// The prior of a calibration, by default that of the validation suite in the geometry of the case.
fn calibration(sections: &Sections) -> CalibrationPrior {
    let suite = match engine_of(sections) {
        Some(Engine::Space) => CalibrationPrior::SPACE,
        _ => CalibrationPrior::PLANE,
    };
    sections.one(&CALIBRATION).and_then(|section| read_calibration(section, suite)).unwrap_or(suite)
}

/// The parts of the contacts by which cracks can be loaded.
fn possible_extent(sections: &Sections) -> PossibleExtent {
    let boundary = sections.one(&RAIL).and_then(|rail| rail.get(BOUNDARY));
    match (engine_of(sections), boundary) {
        (Some(Engine::Space), _) => PossibleExtent::Patch,
        (_, Some(BoundaryKind::Block)) => PossibleExtent::Strip,
        _ => PossibleExtent::Any,
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
    } else if solver.get(ENGINE) == Some(Engine::Plane(PlaneEngine::Xfem)) {
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
        && solver.get(ENGINE) == Some(Engine::Plane(PlaneEngine::Dislocation))
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

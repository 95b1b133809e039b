//! `railcrack check`.

use super::check_study::{study_json, study_summary};
use crate::display::{stdout_columns, wrapped};
use crate::exit::{Exit, Failure};
use crate::input::{self, Set, default_folder};
use crate::json::Json;
use clap::Args;
use railcrack::contact::{CrackFluid, FluidModel, StepControl};
use railcrack::crack::Crack;
use railcrack::fatigue::{ACCEPTANCE_RANGES, ACCEPTED_GROWTH, DirectionCriterion, RailSteel, RateLaw};
use railcrack::growth::{Grinding, Turning};
use railcrack::load::{Contact, HertzEllipse};
use railcrack::rolling::{Creepage, RollingPatch};
use railcrack::shakedown::DepthBounds;
use railcrack::space::CellDivision;
use railcrack::words::Choice;
use railcrack_case::{
    Case, ContactOrigin, GivenContact, GivenWheel, Input, Overrides, PlasticSource, ProfileOrigin,
    TrafficWheel,
};
use railcrack_report::{PageEngine, formula, short};
use railcrack_run::machine::{Budget, Needs, long_step, mb, step_seconds};
use railcrack_run::setup::{
    EffectInPlane, HeaviestWheel, RunSize, contact_bounds, represented, wheel_patches,
};
use railcrack_run::simulation::{RunError, plastic_stress_left_out, rolled_by};
use railcrack_run::summary::validity::of_case;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Validate a case or study file and show what would be computed
///
/// Nothing is written, and nothing is computed but one passage over the first crack. The exit code
/// is 0 for a valid case and 2 otherwise; all errors of the file are reported at once.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The case file, or a study; `-` is standard input
    #[arg(value_name = "CASE")]
    case: PathBuf,
    #[command(flatten)]
    set: Set,
    #[command(flatten)]
    json: Json,
}

/// Validates the case or study and prints what would be computed.
pub fn check(arguments: &CheckArguments) -> Result<Exit, Failure> {
    arguments.json.told(|| {
        let folder = default_folder(&arguments.case);
        let overrides = Overrides { settings: arguments.set.set.clone(), ..Overrides::default() };
        match input::either(&arguments.case, &overrides)? {
            Input::Case(case) => {
                if case.output.explorer {
                    PageEngine::find().map_err(RunError::from)?;
                }
                let case = represented(&case);
                let text = || wrapped(&summary(&case, &folder), stdout_columns());
                arguments.json.print(text, || case_json(&case, &folder))?
            }
            Input::Study(study) => {
                let text = || wrapped(&study_summary(&study, &folder), stdout_columns());
                arguments.json.print(text, || study_json(&study))?;
            }
        }
        Ok(Exit::Done)
    })
}

/// The case as one object: the numbers, and every line of the summary by its heading.
fn case_json(case: &Case, folder: &Path) -> Value {
    let size = RunSize::estimate(case);
    let needs = Needs::with(case, &size);
    let mut said = Map::new();
    for (heading, rows) in parts(case, folder) {
        let named = rows.into_iter().filter(|(name, _)| !name.is_empty());
        let lines: Map<String, Value> = named.map(|(name, value)| (name.to_owned(), value.into())).collect();
        if !lines.is_empty() {
            said.insert(heading, Value::Object(lines));
        }
    }
    json!({
        "exit": Exit::Done.code(),
        "kind": "case",
        "title": case.title,
        "engine": case.engine.word(),
        "contact": case.contact_solver.word(),
        "cracks": case.cracks.cracks().len(),
        "tips": size.tips,
        "face_points": size.face_points,
        "displacements": size.displacements,
        "positions": case.first_wheel().passages.passage.positions,
        "increments": case.growth.steps,
        "memory_bytes": needs.memory,
        "disk_bytes": needs.disk,
        "step_seconds": step_seconds(case, &size),
        "warnings": warning_texts(case),
        "summary": said,
    })
}

/// Name and value in one line of the summary.
type CheckLine = (&'static str, String);

/// The summary of a case.
pub fn summary(case: &Case, folder: &Path) -> String {
    let mut text = format!("{}\n", case.title);
    for (heading, rows) in parts(case, folder) {
        if !rows.is_empty() {
            text.push_str(&format!("\n{heading}\n"));
        }
        for (name, value) in rows {
            let line = if name.is_empty() { value } else { format!("{name:<20} {value}") };
            text.push_str(&format!("  {line}\n"));
        }
    }
    text
}

/// The parts of the summary: of a mix, one for each wheel.
fn parts(case: &Case, folder: &Path) -> Vec<(String, Vec<CheckLine>)> {
    let mut parts = vec![("rail".to_owned(), rail(case))];
    if !case.is_mix() && case.wheel_table.is_none() {
        let first = case.first_wheel();
        parts.push(("contact".to_owned(), contact(case, &first.wheel)));
        parts.push(("track".to_owned(), track(case, first)));
        parts.push(("temperature".to_owned(), temperature(case, &first.wheel)));
    } else {
        parts.push(("mix".to_owned(), mix(case)));
        let wheels = case.wheels.iter().enumerate();
        parts.extend(
            wheels.map(|(i, wheel)| (format!("wheel {}, {}", i + 1, wheel.name), of_mix(case, wheel))),
        );
    }
    let common = [
        ("passage", passage(case)),
        ("cracks", cracks(case)),
        ("crack in space", in_space(case)),
        ("residual stress", residual_stress(case)),
        ("plastic stress", plastic_stress(case)),
        ("solution", solution(case)),
        ("growth", growth(case)),
        ("maintenance", maintenance(case)),
        ("plastic state", plastic_state(case)),
        ("bounds", bounds(case)),
        ("machine", machine(case, folder)),
        ("warnings", warnings(case)),
    ];
    parts.extend(common.map(|(heading, rows)| (heading.to_owned(), rows)));
    parts
}

fn rail(case: &Case) -> Vec<CheckLine> {
    let rail = &case.rail;
    let (left, right) = rail.extent.ends();
    let boundary = match rail.section {
        Some(section) => format!("{}, cracked with the section {}", rail.boundary.word(), section.name),
        None => rail.boundary.word().into(),
    };
    vec![
        (
            "elasticity",
            format!("E = {} MPa, nu = {}", short(case.steel.young()), short(case.steel.poisson())),
        ),
        ("boundary", boundary),
        (
            "cracks stay within",
            format!("x = {} to {} mm, depth {} mm", short(left), short(right), short(rail.extent.depth)),
        ),
    ]
}

fn contact(case: &Case, wheel: &GivenWheel) -> Vec<CheckLine> {
    let Some(GivenContact { contact, origin, .. }) = wheel.given() else {
        return vec![("contact", "misses the cracks".to_owned())];
    };
    let mut rows = from_origin(case, origin);
    rows.extend([
        ("peak pressure p0", format!("{} MPa", short(contact.peak_pressure()))),
        ("half width a", format!("{} mm", short(contact.half_width()))),
        ("line load", format!("{} N/mm", short(contact.line_load()))),
    ]);
    match contact {
        Contact::Hertz(contact) => rows.push(("friction", short(contact.friction))),
        Contact::Carter(carter) => {
            let stick = carter.stick_half_width();
            rows.push(("friction", format!("{} where it slips", short(carter.friction))));
            rows.push((
                "traction Q/(mu P)",
                format!(
                    "{}: sticks over {} mm behind the leading edge",
                    short(carter.traction),
                    short(2.0 * stick)
                ),
            ));
            if let Some(radius) = origin.radius() {
                rows.push(("creepage", format!("{} %", short(100.0 * carter.creepage(radius)))));
            }
        }
        Contact::Table(table) => {
            let last = table.rows().len() - 1;
            let (from, to) = (table.rows()[0].u, table.rows()[last].u);
            rows.push(("extent", format!("u = {} to {} mm, {} rows", short(from), short(to), last + 1)));
            rows.push(("largest |q| / p", short(table.largest_friction())));
        }
    }
    if !matches!(contact, Contact::Hertz(_)) {
        rows.push(("shear Q/P", short(contact.adhesion())));
    }
    rows
}

/// Origin of the contact data.
fn from_origin(case: &Case, origin: &ContactOrigin) -> Vec<CheckLine> {
    match origin {
        ContactOrigin::Given | ContactOrigin::LineLoad { .. } => Vec::new(),
        ContactOrigin::Ellipse { wheel, ellipse, lateral, .. } => vec![
            ("wheel load", format!("{} kN", short(1e-3 * wheel.wheel_load))),
            hertz_ellipse(ellipse),
            offset(case, *lateral),
        ],
        ContactOrigin::GivenEllipse { ellipse, lateral, .. } => {
            vec![hertz_ellipse(ellipse), offset(case, *lateral)]
        }
        ContactOrigin::Table(file) => vec![("table", file.given_name().into())],
        ContactOrigin::Rolling { patch, lateral, .. } => rolling(case, patch, *lateral),
        ContactOrigin::Profiles(own) => profiles(own),
    }
}

/// A patch in rolling contact, with its forces.
fn rolling(case: &Case, patch: &RollingPatch, lateral: f64) -> Vec<CheckLine> {
    let Creepage { longitudinal, lateral: across, spin } = patch.creepage;
    let forces = patch.forces();
    let [along, over] = forces.force.map(|force| short(1e-3 * force));
    vec![
        ("normal force", format!("{} kN", short(1e-3 * patch.normal_force()))),
        hertz_ellipse(&patch.ellipse),
        offset(case, lateral),
        ("creepage", format!("x {}, y {}, spin {} per mm", short(longitudinal), short(across), short(spin))),
        (
            "patch forces",
            format!(
                "x {along} kN, y {over} kN; {} % of the patch slips, Tgamma = {} N",
                short(100.0 * forces.slip_share),
                short(forces.t_gamma)
            ),
        ),
    ]
}

/// The patches of a pair of profiles, and their forces.
fn profiles(own: &ProfileOrigin) -> Vec<CheckLine> {
    let mut rows: Vec<CheckLine> = vec![
        ("profiles", format!("{} on {}", own.wheel.given_name(), own.rail.given_name())),
        ("crack", format!("y = {} mm on the rail", short(own.lateral))),
    ];
    for (contact, placed) in own.contacts.iter().zip(&own.placed) {
        let forces = placed.patch.forces();
        let [along, over] = forces.force.map(|force| short(1e-3 * force));
        let ellipse = &contact.ellipse;
        rows.push((
            "patch",
            format!(
                "y = {} mm, {} degrees; {} kN, p0 = {} MPa, area {} mm2, a = {} mm; approach {} um",
                short(contact.y),
                short(contact.angle.to_degrees()),
                short(1e-3 * contact.normal_force),
                short(ellipse.peak_pressure),
                short(contact.area),
                short(ellipse.along),
                short(1e3 * contact.approach),
            ),
        ));
        rows.push((
            "patch forces",
            format!(
                "x {along} kN, y {over} kN; {} % of the patch slips, Tgamma = {} N",
                short(100.0 * forces.slip_share),
                short(forces.t_gamma)
            ),
        ));
    }
    rows
}

fn hertz_ellipse(ellipse: &HertzEllipse) -> CheckLine {
    let [along, across, peak] = [ellipse.along, ellipse.across, ellipse.peak_pressure].map(short);
    ("Hertz ellipse", format!("a = {along} mm along, b = {across} mm across, p0 = {peak} MPa"))
}

/// Strip of the ellipse in a plane case, lateral position of the ellipse in a space case.
fn offset(case: &Case, lateral: f64) -> CheckLine {
    match case.space {
        Some(_) => ("lateral", format!("middle at z = {} mm", short(lateral))),
        None => ("strip", format!("{} mm to the side of its middle", short(lateral))),
    }
}

/// The cracks of a case in space.
fn in_space(case: &Case) -> Vec<CheckLine> {
    let Some(space) = &case.space else { return Vec::new() };
    let mut rows = Vec::new();
    for shape in &space.shapes {
        let [down, along] = [shape.length, shape.half_length].map(short);
        if let Some(strip) = shape.strip {
            let [length, dip] = [strip.length, strip.dip.to_degrees()].map(short);
            rows.push((
                "to the fold",
                format!("{length} mm from the mouth, at {dip} degrees; below it the branch:"),
            ));
        }
        rows.push(("semi-axes", format!("{down} mm down the dip, {along} mm along the surface")));
        rows.push(("dip", format!("{} degrees", short(shape.dip.to_degrees()))));
        rows.push(("strike", format!("{} degrees", short(shape.strike.to_degrees()))));
        let [x, z] = shape.middle.map(short);
        rows.push(("middle", format!("x = {x} mm, z = {z} mm")));
        if let Some(centre) = shape.buried {
            rows.push(("buried", format!("{} mm down the dip", short(centre))));
        }
    }
    let mut divisions: Vec<CellDivision> = Vec::new();
    for division in space.shapes.iter().map(|shape| shape.division(case.mesh.space)) {
        if !divisions.contains(&division) {
            divisions.push(division);
        }
    }
    for CellDivision { columns, rows: own, ring, .. } in divisions {
        let rows_of_block = if own == columns { String::new() } else { format!(" in {own} rows") };
        rows.push((
            "cells",
            format!("{columns} on each side of the middle{rows_of_block}, {ring} to the front"),
        ));
    }
    let lateral: Vec<f64> =
        wheel_patches(case).iter().map(|wheel| wheel.outline().lateral_friction).collect();
    if lateral.iter().any(|friction| *friction != 0.0) {
        rows.push((
            "lateral friction",
            lateral.iter().map(|friction| short(*friction)).collect::<Vec<_>>().join(", "),
        ));
    }
    rows
}

/// The wheels of a mix, a line for each.
fn mix(case: &Case) -> Vec<CheckLine> {
    let line = |wheel: &TrafficWheel| {
        let load = wheel.axle_load.map_or_else(String::new, |load| format!(", {} t", short(load)));
        let contact = wheel.wheel.contact().map_or_else(String::new, |contact| {
            format!(
                ", p0 = {} MPa, a = {} mm, shear Q/P = {}",
                short(contact.peak_pressure()),
                short(contact.half_width()),
                short(contact.adhesion())
            )
        });
        format!("{}: {} % of the axles{load}{contact}", wheel.name, short(100.0 * wheel.share))
    };
    let mut rows: Vec<CheckLine> = case.wheels.iter().map(|wheel| ("wheel", line(wheel))).collect();
    if let Some(table) = &case.wheel_table
        && let Some(groups) = &table.groups
    {
        rows.push((
            "table",
            format!(
                "{}: {} wheels, {} representatives, mean rate off by {} % by the coarse crack",
                table.file.given_name(),
                table.wheels.len(),
                groups.representatives.len(),
                short(100.0 * groups.error)
            ),
        ));
        let missed = (
            "missed",
            format!(
                "{} % of the axles have no patch over the crack at lateral_mm = {}",
                short(100.0 * table.missed(groups)),
                short(table.lateral)
            ),
        );
        let ys = || table.wheels.iter().flat_map(|wheel| &wheel.wheel.patches).map(|own| own.y_rail);
        let (from, to) = (ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max));
        let places =
            ("places", format!("patches with their middles from z = {} to {} mm", short(from), short(to)));
        rows.push(if table.in_space { places } else { missed });
    }
    if !rows.is_empty() {
        rows.push((
            "",
            "run reports the share of each wheel in the growth, and which wheel turns the crack".into(),
        ));
    }
    rows
}

/// A wheel of a mix: its share, passage and fluid, its contact, track and temperature, and the
/// pressure at which the rail yields under it.
fn of_mix(case: &Case, mixed: &TrafficWheel) -> Vec<CheckLine> {
    let (wheel, passage) = (&mixed.wheel, mixed.passages.passage);
    let mut rows = vec![
        ("share of the axles", format!("{} %", short(100.0 * mixed.share))),
        ("runs towards", passage.travel().word().into()),
        ("from, to", format!("x = {} to {} mm", short(passage.from), short(passage.to))),
        ("fluid", mixed.fluid.as_ref().map_or_else(|| "none".into(), fluid_text)),
    ];
    rows.extend(mixed.axle_load.map(|load| ("axle load", format!("{} t", short(load)))));
    rows.extend(contact(case, wheel));
    rows.extend(track(case, mixed));
    rows.extend(temperature(case, wheel));
    if let (Some(fracture), Some(at)) = (&case.fracture, wheel.temperature) {
        rows.push(("breaks at k1", format!("{} MPa sqrt(m)", short(fracture.toughness.at(at.rail)))));
    }
    let shear_yield = case.shakedown.hardening.shear_yield_stress();
    let all = contact_bounds(wheel, &case.steel, |bounds| (bounds.first_yield(), bounds.shakedown_limit()));
    rows.extend(wheel.contact().zip(all).map(|(contact, (first_yield, limit))| {
        let ratio = contact.peak_pressure() / shear_yield;
        let state = yielding(ratio, first_yield.ratio, limit.ratio);
        let says = format!(
            "{}; first yield at {:.4}, shakedown limit {:.4}: {state}",
            short(ratio),
            first_yield.ratio,
            limit.ratio
        );
        ("p0 / k", says)
    }));
    rows
}

/// The fate of a rail under p0/k = `ratio`.
fn yielding(ratio: f64, first_yield: f64, limit: f64) -> &'static str {
    if ratio <= first_yield {
        "the virgin rail stays elastic"
    } else if ratio <= limit {
        "the rail yields; elastic shakedown is possible"
    } else {
        "beyond elastic shakedown: every passage yields"
    }
}

fn track(case: &Case, wheel: &TrafficWheel) -> Vec<CheckLine> {
    let (Some(track), Some(bending)) = (&wheel.wheel.track, wheel.wheel.bending(&case.steel)) else {
        return Vec::new();
    };
    let axles: Vec<String> = track
        .axles
        .iter()
        .map(|axle| format!("{} kN at {} mm", short(1e-3 * axle.wheel_load), short(axle.at)))
        .collect();
    let length = bending.length();
    let positions = case.positions(wheel);
    let (first, last) = (positions.first().copied().unwrap_or(0.0), positions.last().copied().unwrap_or(0.0));
    vec![
        ("axles", axles.join(", ")),
        (
            "section",
            format!(
                "I = {} mm^4, neutral axis {} mm deep",
                short(track.section.second_moment),
                short(track.section.neutral_axis_depth)
            ),
        ),
        ("foundation", format!("{} MPa", short(track.foundation))),
        ("length 1 / beta", format!("{} mm", short(length))),
        (
            "under this wheel",
            format!(
                "M = {} kN m, sigma_xx = {} MPa at the surface",
                short(1e-6 * bending.moment(0.0)),
                short(bending.stress(0.0, 0.0))
            ),
        ),
        (
            "passage of the beam",
            format!(
                "x = {} to {} m, {} output positions in all",
                short(1e-3 * first),
                short(1e-3 * last),
                positions.len()
            ),
        ),
    ]
}

fn temperature(case: &Case, wheel: &GivenWheel) -> Vec<CheckLine> {
    let Some(temperature) = wheel.temperature else { return Vec::new() };
    vec![
        (
            "rail, neutral",
            format!("{} and {} degrees C", short(temperature.rail), short(temperature.neutral)),
        ),
        ("sigma_xx", format!("{} MPa", short(temperature.stress(&case.steel)))),
    ]
}

fn passage(case: &Case) -> Vec<CheckLine> {
    let settings = &case.first_wheel().passages;
    let passage = &settings.passage;
    let first_mouth = case.cracks.cracks().first().map_or(0.0, |c| c.points()[0].x);
    let over_a = |x: f64| short((x - first_mouth) / case.half_width());
    let mut rows = Vec::new();
    if !case.is_mix() {
        rows.extend([
            ("wheel runs towards", passage.travel().word().into()),
            ("from, to", format!("x = {} to {} mm", short(passage.from), short(passage.to))),
            ("over a", format!("{} to {} from the first crack", over_a(passage.from), over_a(passage.to))),
        ]);
    }
    rows.extend([
        ("output positions", passage.positions.to_string()),
        (
            "passages",
            format!(
                "until K repeats to {}, at most {}",
                short(settings.passage_tolerance),
                settings.max_passages
            ),
        ),
        (
            "load steps",
            match settings.step_control {
                StepControl::Adaptive => {
                    format!(
                        "substeps until K changes by less than {} of its peak",
                        short(settings.step_tolerance)
                    )
                }
                StepControl::Fixed => "one per output position".into(),
            },
        ),
    ]);
    rows
}

fn cracks(case: &Case) -> Vec<CheckLine> {
    let columns = "   #   x mm        y mm        length mm   angle deg   friction   tips mm";
    let mut rows = vec![("number", case.cracks.cracks().len().to_string()), ("", columns.into())];
    for (i, (crack, friction)) in case.cracks.cracks().iter().zip(&case.crack_friction).enumerate() {
        rows.push(("", crack_line(i + 1, crack, *friction)));
    }
    rows
}

fn crack_line(count: usize, crack: &Crack, friction: f64) -> String {
    let (first, next) = crack.segment(0);
    let angle = -(next - first).angle().to_degrees();
    let tips: Vec<String> = crack
        .tips()
        .into_iter()
        .map(|end| crack.tip(end))
        .map(|tip| format!("({}, {})", short(tip.x), short(tip.y)))
        .collect();
    format!(
        "{count:>4}   {:<11} {:<11} {:<11} {:<11} {:<10} {}",
        short(first.x),
        short(first.y),
        short(crack.length()),
        short(angle),
        short(friction),
        tips.join(" ")
    )
}

fn residual_stress(case: &Case) -> Vec<CheckLine> {
    let Some(file) = &case.residual_stress else { return Vec::new() };
    let rows = file.content().rows();
    let extreme = |pick: fn(f64, f64) -> f64| rows.iter().map(|r| r.1).reduce(pick).unwrap_or(0.0);
    let deepest = rows.last().map_or(0.0, |r| r.0);
    vec![
        ("profile", file.given_name().into()),
        ("rows", format!("{} to depth {} mm", rows.len(), short(deepest))),
        ("sigma_xx", format!("{} to {} MPa", short(extreme(f64::min)), short(extreme(f64::max)))),
    ]
}

fn plastic_stress(case: &Case) -> Vec<CheckLine> {
    match &case.plastic_stress {
        Some(PlasticSource::Field(file)) => {
            let (left, right, depth) = file.content().extent();
            vec![
                ("field", file.given_name().into()),
                (
                    "extent",
                    format!("x = {} to {} mm, to depth {} mm", short(left), short(right), short(depth)),
                ),
            ]
        }
        Some(PlasticSource::Profile(file)) => vec![("profile", file.given_name().into())],
        Some(PlasticSource::Rolled) => {
            let mut rows = vec![("stabilised state", "computed first, from [shakedown]".into())];
            rows.extend(rolled_by(case).map(|by| ("", by)));
            rows
        }
        None => plastic_stress_left_out(case).map(|note| ("none", note)).into_iter().collect(),
    }
}

fn solution(case: &Case) -> Vec<CheckLine> {
    let size = RunSize::estimate(case);
    let mut rows =
        vec![("engine", case.engine.word().into()), ("contact", case.contact_solver.word().into())];
    if size.displacements > 0 {
        rows.push(("displacements", format!("{} unknowns, factored once", size.displacements)));
    }
    rows.extend([
        ("face points", size.face_points.to_string()),
        ("face unknowns", size.unknowns.to_string()),
        ("tips", size.tips.to_string()),
        ("memory", format!("about {} MB", size.memory_bytes.div_ceil(1 << 20))),
    ]);
    rows
}

fn growth(case: &Case) -> Vec<CheckLine> {
    let growth = &case.growth;
    let law = &growth.law;
    let direction = match growth.criterion {
        DirectionCriterion::MaxRate => "largest growth rate of the kink",
        DirectionCriterion::MaxRateUnclipped => "largest growth rate of the kink, negative k1 counted",
        DirectionCriterion::MaxDeltaK1 => "largest range of k1",
        DirectionCriterion::MaxK1 => "largest k1",
        DirectionCriterion::Coplanar => "straight ahead",
        DirectionCriterion::MaxTangentialStress => "largest tangential stress ahead of the tip",
        DirectionCriterion::MaxDeltaCtd => "largest range of the displacement at the tip of the kink",
    };
    let steps = match (growth.steps, growth.tolerance) {
        (0, _) => "0: the initial cracks only".into(),
        (steps, Some(tolerance)) => {
            format!("{steps}, at most, chosen for an error of the life of {} %", short(100.0 * tolerance))
        }
        (steps, None) => format!("{steps}, each {} % of the length", short(100.0 * growth.increment)),
    };
    let path = match growth.turning {
        Turning::Kink => "a whole kink in each increment: the path depends on the increment".to_owned(),
        Turning::Over(0.0) => "limit path: at each tip the best kink is zero".to_owned(),
        Turning::Over(f64::INFINITY) => "straight ahead".to_owned(),
        Turning::Over(length) => format!("turns towards the best kink over {} mm", short(length)),
    };
    let mut rows = vec![
        ("increments", steps),
        ("path", path),
        ("law", format!("{} mm/cycle, MPa sqrt(m)", formula(&law.rate.formula()))),
        ("range", formula(&law.equivalent.formula())),
        ("EN 13674-1", acceptance(&law.rate)),
        ("in track", case.calibration.sites.map_or_else(|| IN_TRACK.to_owned(), calibrated_by)),
        ("arrest below", format!("{} mm/cycle", short(growth.arrest_rate))),
        ("direction", direction.into()),
    ];
    if let Some(steel) = case.growth_steel {
        rows.insert(1, ("steel", steel_text(steel)));
    }
    if let Some(threshold) = law.shear_threshold() {
        rows.push(("threshold", format!("{} MPa sqrt(m)", formula(&threshold))));
    }
    if let Some(length) = growth.critical_length {
        rows.push(("stops at length", format!("{} mm", short(length))));
    }
    if let Some(cycles) = growth.stop_after_cycles {
        rows.push(("stops after", format!("{} cycles", crate::progress::cycles(cycles))));
    }
    if let Some(fluid) = case.first_wheel().fluid.as_ref().filter(|_| !case.is_mix()) {
        rows.push(("fluid", fluid_text(fluid)));
    }
    if let Some(fracture) = &case.fracture {
        let steel = fracture.steel.map_or(String::new(), |steel| format!(" ({steel})"));
        rows.push(("breaks at k1", format!("{} MPa sqrt(m){steel}", short(fracture.at_rail))));
    }
    if let Some(load) = case.axle_load {
        rows.push(("axle load", format!("{} t", short(load))));
    }
    if let Some(inspection) = &case.inspection {
        let from = match (inspection.detectable_depth, inspection.detectable_length) {
            (Some(depth), _) => format!("from a depth of {} mm", short(depth)),
            (None, Some(length)) => format!("from a length of {} mm", short(length)),
            (None, None) => "from the start".to_owned(),
        };
        rows.push(("inspection", format!("{from}, safety factor {}", short(inspection.safety_factor))));
    }
    if let Some(scatter) = &case.scatter {
        rows.push(("scatter", format!("{} samples, ln C +- {}", scatter.samples, short(scatter.c_log_std))));
    }
    rows
}

/// Absolute rates without a calibration.
const IN_TRACK: &str =
    "rates are known to a factor of about ten either way until C is calibrated (docs/validation.md)";

fn calibrated_by(sites: usize) -> String {
    format!("calibrated by {sites} measured {}", if sites == 1 { "site" } else { "sites" })
}

/// The name of a steel, and what its growth is.
fn steel_text(steel: &RailSteel) -> String {
    match steel.typical() {
        Some(typical) => format!(
            "{}: the fastest growth that EN 13674-1 accepts, a limit and not the growth of a rail; typical growth: steel = \"{}\"",
            steel.name, typical.name
        ),
        None => format!("{}: {}", steel.name, steel.source),
    }
}

/// Rates at R = 0.5 and the limits of the standard.
fn acceptance(law: &RateLaw) -> String {
    let of = |(range, limit): (f64, f64)| {
        // Metres in 1e9 cycles.
        format!("{} of {limit} m/Gcycle at \u{394}K = {range}", short(1e6 * law.rate(range, 0.5)))
    };
    let [low, high] = ACCEPTANCE_RANGES;
    format!("{}, {}, R = 0.5", of((low, ACCEPTED_GROWTH[0])), of((high, ACCEPTED_GROWTH[1])))
}

/// Wear and grinding, and the growth rate that balances them.
fn maintenance(case: &Case) -> Vec<CheckLine> {
    let Some(removal) = &case.maintenance else { return Vec::new() };
    let mut rows = vec![("wear", format!("{} mm/MGT", short(removal.wear)))];
    if let Some(Grinding { depth, interval, .. }) = removal.grinding {
        rows.push(("grinding", format!("{} mm every {} MGT", short(depth), short(interval.0))));
    }
    rows.push(("removal", format!("{} mm/MGT on average", short(removal.mean_rate()))));
    let first = case.cracks.cracks().first().filter(|crack| crack.is_surface_breaking());
    let wheels = case.axle_load.zip(first);
    rows.extend(wheels.map(|(tonnes, crack)| {
        let (mouth, next) = crack.segment(0);
        let sine = (mouth.y - next.y) / (next - mouth).length();
        let rate = 1e-6 * tonnes * removal.mean_rate() / sine;
        (
            "balance",
            format!("the first crack grows deeper if its tip grows by more than {rate:.3e} mm per cycle"),
        )
    }));
    rows
}

/// Summary of the stabilised plastic state that `railcrack shakedown` would compute.
fn plastic_state(case: &Case) -> Vec<CheckLine> {
    let shakedown = &case.shakedown;
    let hardening = &shakedown.hardening;
    let mut rows = vec![
        (
            "yield, hardening",
            format!(
                "{} MPa{}, C = {} MPa",
                short(hardening.yield_stress()),
                shakedown
                    .steel
                    .map_or_else(String::new, |steel| format!(" ({}, 0.2 % proof stress)", steel.name)),
                short(hardening.modulus())
            ),
        ),
        ("method", format!("{}, at most {} passages", shakedown.method.word(), shakedown.max_passes)),
        (
            "Dang Van",
            format!("a = {}, b = {} MPa", short(shakedown.dang_van.slope), short(shakedown.dang_van.limit)),
        ),
    ];
    if let Some(file) = &shakedown.initial_residual {
        rows.push(("initial residual", file.given_name().into()));
    }
    rows
}

/// The warnings that a run would begin with.
fn warnings(case: &Case) -> Vec<CheckLine> {
    warning_texts(case).into_iter().map(|text| ("", text)).collect()
}

/// The warnings about a case, and whether its wheel should feel the cracks.
fn warning_texts(case: &Case) -> Vec<String> {
    let mut texts: Vec<String> = of_case(case).into_iter().map(|warning| warning.text).collect();
    let rate = EffectInPlane::of_case(case).map(|effect| effect.rate);
    let felt = rate.filter(|rate| (rate - 1.0).abs() > FELT);
    texts.extend(felt.map(|rate| {
        let remedy = if case.engine.is_in_space() {
            "the space engine has no such wheel, the plane engines do"
        } else {
            "set contact.coupled = true"
        };
        format!(
            "under a wheel that feels the crack, the first crack, alone and dry in the plane, would grow at {rate:.2} times the rate: {remedy}"
        )
    }));
    texts
}

/// Change of the growth rate from which on a wheel should feel the cracks.
const FELT: f64 = 0.05;

/// Needs of the run and the resources of the machine.
fn machine(case: &Case, folder: &Path) -> Vec<CheckLine> {
    let (size, budget) = (RunSize::estimate(case), Budget::of(folder));
    let needs = Needs::with(case, &size);
    let of = |has: Option<u64>| has.map_or_else(String::new, |has| format!(" of {} MB", mb(has)));
    let mut rows = vec![
        ("memory", format!("about {} MB{}", mb(needs.memory), of(budget.memory))),
        ("disk", format!("about {} MB of tables{}", mb(needs.disk), of(budget.disk))),
    ];
    if let Err(over) = budget.allows(needs, 1, 1) {
        rows.push(("too large", over.to_string()));
    }
    rows.extend(long_step(step_seconds(case, &size), &size).map(|says| ("slow", says)));
    rows
}

/// Depths over the half-width of the contact at which bounds are printed.
const BOUND_DEPTHS: [f64; 8] = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0];

/// Peak pressure compared with first yield and the shakedown limit.
fn bounds(case: &Case) -> Vec<CheckLine> {
    let shear_yield = case.shakedown.hardening.shear_yield_stress();
    let HeaviestWheel { wheel: number, of_limit } = HeaviestWheel::of_case(case);
    let heaviest = &case.wheels[number];
    let wheel = &heaviest.wheel;
    let Some(contact) = wheel.contact() else { return Vec::new() };
    let ratio = contact.peak_pressure() / shear_yield;
    let all = contact_bounds(wheel, &case.steel, |bounds| {
        (bounds.first_yield(), bounds.shakedown_limit(), bounds.by_depth(&BOUND_DEPTHS))
    });
    let Some((first_yield, shakedown, by_depth)) = all else { return Vec::new() };
    let state = yielding(ratio, first_yield.ratio, shakedown.ratio);
    let a = wheel.half_width();
    let verdict = |bounds: &DepthBounds| {
        let verdict = if ratio <= bounds.first_yield {
            "elastic"
        } else if ratio <= bounds.shakedown {
            "yields, shakedown possible"
        } else {
            "no elastic shakedown"
        };
        let line = format!(
            "{:>8}   {:>11.4}   {:>15.4}   {verdict}",
            short(bounds.depth_over_a * a),
            bounds.first_yield,
            bounds.shakedown
        );
        ("", line)
    };
    let at = |depth_over_a: f64| format!("depth {} mm", short(depth_over_a * a));
    let mut rows = Vec::new();
    if case.is_mix() {
        rows.push(("heaviest wheel", format!("{}: {of_limit:.2} of its shakedown limit", heaviest.name)));
    }
    rows.extend([
        ("shear yield stress k", format!("{} MPa", short(shear_yield))),
        ("p0 / k", format!("{}: {state}", short(ratio))),
        ("first yield", format!("p0 / k = {:.4}, {}", first_yield.ratio, at(first_yield.depth_over_a))),
        ("shakedown limit", format!("p0 / k = {:.4}, {}", shakedown.ratio, at(shakedown.depth_over_a))),
        ("", "depth mm   first yield   shakedown limit   p0 / k of the case".into()),
    ]);
    rows.extend(by_depth.iter().map(verdict));
    rows
}

/// The fluid in the cracks.
fn fluid_text(fluid: &CrackFluid) -> String {
    let cracks = fluid.cracks.as_ref().map_or_else(String::new, |cracks| {
        let numbers: Vec<String> = cracks.iter().map(|crack| (crack + 1).to_string()).collect();
        format!(", in cracks {}", numbers.join(", "))
    });
    match fluid.model {
        FluidModel::Mouth { cap } => {
            let most = if cap.is_finite() { format!(", at most {} MPa", short(cap)) } else { String::new() };
            format!("contact pressure at the mouth, {} along the crack{most}{cracks}", fluid.profile.word())
        }
        FluidModel::Trapped { bulk_modulus, .. } => {
            let modulus = match bulk_modulus.is_finite() {
                true => format!("bulk modulus {} MPa", short(bulk_modulus)),
                false => "incompressible".to_owned(),
            };
            format!("trapped under the wheel, {modulus}{cracks}; buried cracks are filled from the start")
        }
    }
}

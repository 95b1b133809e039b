//! The wheels of a case: contact, shear, track, temperature, fluid, passage.

use super::row::{Part, Row};
use super::stress::yielding;
use crate::numbers::short;
use crate::setup::WheelBounds;
use railcrack::contact::{CrackFluid, FluidModel, StepControl};
use railcrack::load::{CarterContact, Contact, HertzEllipse};
use railcrack::profiles::ProfileContact;
use railcrack::rolling::RollingPatch;
use railcrack::words::Choice;
use railcrack_case::{Case, ContactOrigin, GivenContact, GivenWheel, ProfileOrigin, TrafficWheel};

/// The wheel, or the mix and each of its wheels.
pub(super) fn wheels(case: &Case) -> Vec<Part> {
    if !case.is_mix() && case.wheel_table.is_none() {
        let first = case.first_wheel();
        return vec![
            Part::new("contact", contact(case, &first.wheel)),
            Part::new("track", track(case, first)),
            Part::new("temperature", temperature(case, &first.wheel)),
        ];
    }
    let numbered = case.wheels.iter().enumerate();
    let of = |(i, wheel): (usize, &TrafficWheel)| {
        Part::new(format!("wheel {}, {}", i + 1, wheel.name), wheel_of_mix(case, i))
    };
    std::iter::once(Part::new("mix", mix(case))).chain(numbered.map(of)).collect()
}

fn contact(case: &Case, wheel: &GivenWheel) -> Vec<Row> {
    let Some(given) = wheel.given() else {
        return vec![Row::text("contact", "misses the cracks")];
    };
    let GivenContact { contact, origin, coupling, .. } = given;
    let is_patch = given.is_patch();
    let mut rows = from_origin(case, given);
    rows.extend([
        Row::number("peak pressure p0", contact.peak_pressure(), "MPa"),
        Row::number("half width a", contact.half_width(), "mm"),
    ]);
    if !is_patch {
        rows.push(Row::number("line load", contact.line_load(), "N/mm"));
    }
    match contact {
        Contact::Hertz(contact) => rows.push(Row::number("friction", contact.friction, "")),
        Contact::Carter(carter) => rows.extend(partial_slip(carter, origin)),
        Contact::Table(table) => {
            let last = table.rows().len() - 1;
            let (from, to) = (table.rows()[0].u, table.rows()[last].u);
            rows.push(Row::with(
                "extent",
                "u = {from:} to {to}, {rows} rows",
                [("from", from, "mm"), ("to", to, "mm"), ("rows", (last + 1) as f64, "")],
            ));
            rows.push(Row::number("largest |q| / p", table.largest_friction(), ""));
        }
    }
    if !matches!(contact, Contact::Hertz(_)) {
        rows.push(Row::number("shear Q/P", contact.adhesion(), ""));
    }
    let drags = match contact.adhesion() {
        0.0 => "there is none",
        shear if shear > 0.0 => "drags the rail along +x",
        _ => "drags the rail along -x",
    };
    rows.extend([Row::text("pressure", contact.kind().described(is_patch)), Row::text("shear", drags)]);
    rows.push(match coupling {
        Some(coupling) => Row::with(
            "cracks",
            "within {within} a of a mouth the contact is that of a smooth elastic wheel on the cracked rail",
            [("within", coupling.within, "")],
        ),
        None => Row::text("cracks", "do not affect the contact"),
    });
    rows
}

fn partial_slip(carter: &CarterContact, origin: &ContactOrigin) -> Vec<Row> {
    let mut rows = vec![
        Row::with("friction", "{friction} where it slips", [("friction", carter.friction, "")]),
        Row::with(
            "traction Q/(mu P)",
            "{traction}: sticks over {stick} behind the leading edge",
            [("traction", carter.traction, ""), ("stick", 2.0 * carter.stick_half_width(), "mm")],
        ),
    ];
    let creepage = origin.radius().map(|radius| 100.0 * carter.creepage(radius));
    rows.extend(creepage.map(|creepage| Row::number("creepage", creepage, "%")));
    rows
}

/// The data from which the contact is computed.
fn from_origin(case: &Case, given: &GivenContact) -> Vec<Row> {
    let is_patch = given.is_patch();
    match &given.origin {
        ContactOrigin::Given | ContactOrigin::LineLoad { .. } => Vec::new(),
        ContactOrigin::Ellipse { wheel, ellipse, lateral, .. } => vec![
            Row::number("wheel load", 1e-3 * wheel.wheel_load, "kN"),
            hertz_ellipse(ellipse),
            offset(case, is_patch, *lateral),
        ],
        ContactOrigin::GivenEllipse { ellipse, lateral, .. } => {
            vec![hertz_ellipse(ellipse), offset(case, is_patch, *lateral)]
        }
        ContactOrigin::Table(file) => vec![Row::text("table", file.given_name())],
        ContactOrigin::Rolling { patch, lateral, .. } => {
            // The place of the crack in the patch.
            let lateral = if is_patch { 0.0 - lateral } else { *lateral };
            rolling(patch, offset(case, is_patch, lateral))
        }
        ContactOrigin::Profiles(own) => profiles(own),
    }
}

/// A patch in rolling contact, with its forces.
fn rolling(patch: &RollingPatch, offset: Row) -> Vec<Row> {
    let creepage = patch.creepage;
    vec![
        Row::number("normal force", 1e-3 * patch.normal_force(), "kN"),
        hertz_ellipse(&patch.ellipse),
        offset,
        Row::with(
            "creepage",
            "x {x}, y {y}, spin {spin}",
            [
                ("x", creepage.longitudinal, ""),
                ("y", creepage.lateral, ""),
                ("spin", creepage.spin, "per mm"),
            ],
        ),
        Row::text("theory", patch.theory.word()),
        patch_forces(patch),
    ]
}

fn patch_forces(patch: &RollingPatch) -> Row {
    let forces = patch.forces();
    let [along, across] = forces.force.map(|force| 1e-3 * force);
    Row::with(
        "patch forces",
        "x {x}, y {y}; {slips} of the patch slips, Tgamma = {Tgamma}",
        [
            ("x", along, "kN"),
            ("y", across, "kN"),
            ("slips", 100.0 * forces.slip_share, "%"),
            ("Tgamma", forces.t_gamma, "N"),
        ],
    )
}

/// The patches of a pair of profiles, and their forces.
fn profiles(own: &ProfileOrigin) -> Vec<Row> {
    let mut rows = vec![
        Row::text("profiles", format!("{} on {}", own.wheel.given_name(), own.rail.given_name())),
        Row::with("crack", "y = {y} on the rail", [("y", own.lateral, "mm")]),
    ];
    rows.push(flange(own));
    for (contact, placed) in own.contacts.iter().zip(&own.placed) {
        rows.extend([profile_patch(contact), patch_forces(&placed.patch)]);
    }
    rows.push(Row::line(
        "the pressure is that of interpenetrating surfaces with the ellipse correction of CONTACT (KPEC)",
    ));
    rows
}

/// Where the flange of the wheel lies, and to which side the rail is inclined.
fn flange(own: &ProfileOrigin) -> Row {
    let side = match own.rail.content().gauge_side() {
        Some(side) if side < 0.0 => "the rail falls to negative y",
        Some(_) => "the rail falls to positive y",
        None => "the rail is not inclined",
    };
    match own.wheel.content().flange() {
        Some([y, fall]) => {
            let text = format!("at y = {{y}} of the wheel, {{fall}} below the tread; {side}");
            Row::with("flange", &text, [("y", y, "mm"), ("fall", fall, "mm")])
        }
        None => Row::text("flange", format!("none in the profile of the wheel; {side}")),
    }
}

fn profile_patch(contact: &ProfileContact) -> Row {
    let ellipse = &contact.ellipse;
    Row::with(
        "patch",
        "y = {y}, {tilt}; {force}, p0 = {p0}, area {area}, a = {a}; approach {approach}",
        [
            ("y", contact.y, "mm"),
            ("tilt", contact.angle.to_degrees(), "degrees"),
            ("force", 1e-3 * contact.normal_force, "kN"),
            ("p0", ellipse.peak_pressure, "MPa"),
            ("area", contact.area, "mm2"),
            ("a", ellipse.along, "mm"),
            ("approach", 1e3 * contact.approach, "um"),
        ],
    )
}

fn hertz_ellipse(ellipse: &HertzEllipse) -> Row {
    Row::with(
        "Hertz ellipse",
        "a = {a} along, b = {b} across, p0 = {p0}",
        [("a", ellipse.along, "mm"), ("b", ellipse.across, "mm"), ("p0", ellipse.peak_pressure, "MPa")],
    )
}

/// The lateral place of an ellipse, or of the strip of it that loads cracks.
fn offset(case: &Case, is_patch: bool, lateral: f64) -> Row {
    let lateral = [("z", lateral, "mm")];
    match (is_patch, case.space().is_some()) {
        (false, _) => Row::with("strip", "{z} to the side of its middle", lateral),
        (true, true) => Row::with("lateral", "middle at z = {z}", lateral),
        (true, false) => {
            Row::with("lateral", "middle at z = {z}, averaged along the fronts of the cracks", lateral)
        }
    }
}

/// The wheels of a mix, a line for each.
fn mix(case: &Case) -> Vec<Row> {
    let row = |wheel: &TrafficWheel| {
        let load = wheel.axle_load.map_or_else(String::new, |load| format!(", {} t", short(load)));
        let contact = wheel.wheel.contact().map_or_else(String::new, |contact| {
            format!(
                ", p0 = {} MPa, a = {} mm, shear Q/P = {}",
                short(contact.peak_pressure()),
                short(contact.half_width()),
                short(contact.adhesion())
            )
        });
        let text = format!("{{share}} of the axles{load}{contact}");
        Row::with("wheel", &text, [("share", 100.0 * wheel.share, "%")]).about(&wheel.name)
    };
    let mut rows: Vec<Row> = case.wheels.iter().map(row).collect();
    rows.extend(table_of_wheels(case));
    if !rows.is_empty() {
        rows.push(Row::line(
            "run reports the share of each wheel in the growth, and which wheel turns the crack",
        ));
    }
    rows
}

/// The table of wheels, and the places of its patches.
fn table_of_wheels(case: &Case) -> Vec<Row> {
    let Some((table, groups)) =
        case.wheel_table.as_ref().and_then(|table| Some((table, table.groups.as_ref()?)))
    else {
        return Vec::new();
    };
    let represented = Row::with(
        "table",
        "{wheels} wheels, {representatives} representatives, mean rate off by {error} by the coarse crack",
        [
            ("wheels", table.wheels.len() as f64, ""),
            ("representatives", groups.representatives.len() as f64, ""),
            ("error", 100.0 * groups.error, "%"),
        ],
    )
    .about(table.file.given_name());
    let places = match table.is_whole {
        true => {
            let ys = || table.wheels.iter().flat_map(|wheel| &wheel.wheel.patches).map(|own| own.y_rail);
            let (from, to) = (ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max));
            Row::with(
                "places",
                "patches with their middles from z = {from:} to {to}",
                [("from", from, "mm"), ("to", to, "mm")],
            )
        }
        false => Row::with(
            "missed",
            "{missed} of the axles have no patch over the crack at lateral_mm = {lateral}",
            [("missed", 100.0 * table.missed(groups), "%"), ("lateral", table.lateral, "")],
        ),
    };
    vec![represented, places]
}

/// A wheel of a mix: its share, passage and fluid, its contact, track and temperature, and the
/// pressure at which the rail yields under it.
fn wheel_of_mix(case: &Case, number: usize) -> Vec<Row> {
    let mixed = &case.wheels[number];
    let (wheel, passage) = (&mixed.wheel, mixed.passages.passage);
    let mut rows = vec![
        Row::number("share of the axles", 100.0 * mixed.share, "%"),
        Row::text("runs towards", passage.travel().word()),
        between("from, to", passage.from, passage.to),
        mixed.fluid.as_ref().map_or_else(|| Row::text("fluid", "none"), fluid),
    ];
    rows.extend(mixed.axle_load.map(|load| Row::number("axle load", load, "t")));
    rows.extend(contact(case, wheel));
    rows.extend(track(case, mixed));
    rows.extend(temperature(case, wheel));
    if let (Some(fracture), Some(at)) = (&case.fracture, wheel.temperature) {
        rows.push(Row::number("breaks at k1", fracture.toughness.at(at.rail), "MPa sqrt(m)"));
    }
    let shear_yield = case.shakedown.hardening.shear_yield_stress();
    let bounds = WheelBounds::of(case, number);
    rows.extend(wheel.contact().zip(bounds).map(|(contact, bounds)| {
        let [first_yield, limit] = [bounds.first_yield, bounds.shakedown];
        let ratio = contact.peak_pressure() / shear_yield;
        let text = format!(
            "{{p0/k}}; first yield at {:.4}, shakedown limit {:.4}: {}",
            first_yield.ratio,
            limit.ratio,
            yielding(ratio, first_yield.ratio, limit.ratio)
        );
        Row::with("p0 / k", &text, [("p0/k", ratio, "")])
    }));
    rows
}

/// Both ends of a passage, mm.
fn between(name: &'static str, from: f64, to: f64) -> Row {
    Row::with(name, "x = {from:} to {to}", [("from", from, "mm"), ("to", to, "mm")])
}

/// Bending of the rail under the axles.
fn track(case: &Case, wheel: &TrafficWheel) -> Vec<Row> {
    let (Some(track), Some(bending)) = (&wheel.wheel.track, wheel.wheel.bending(&case.steel)) else {
        return Vec::new();
    };
    let axles: Vec<String> = track
        .axles
        .iter()
        .map(|axle| format!("{} kN at {} mm", short(1e-3 * axle.wheel_load), short(axle.at)))
        .collect();
    let positions = case.positions(wheel);
    let (first, last) = (positions.first().copied().unwrap_or(0.0), positions.last().copied().unwrap_or(0.0));
    vec![
        Row::text("axles", axles.join(", ")),
        Row::with(
            "section",
            "I = {I}, neutral axis {depth} deep",
            [("I", track.section.second_moment, "mm^4"), ("depth", track.section.neutral_axis_depth, "mm")],
        ),
        Row::number("foundation", track.foundation, "MPa"),
        Row::number("length 1 / beta", bending.length(), "mm"),
        Row::with(
            "under this wheel",
            "M = {M}, sigma_xx = {sigma_xx} at the surface",
            [("M", 1e-6 * bending.moment(0.0), "kN m"), ("sigma_xx", bending.stress(0.0, 0.0), "MPa")],
        ),
        Row::with(
            "passage of the beam",
            "x = {from:} to {to}, {positions} output positions in all",
            [
                ("from", 1e-3 * first, "m"),
                ("to", 1e-3 * last, "m"),
                ("positions", positions.len() as f64, ""),
            ],
        ),
    ]
}

fn temperature(case: &Case, wheel: &GivenWheel) -> Vec<Row> {
    let Some(temperature) = wheel.temperature else { return Vec::new() };
    vec![
        Row::with(
            "rail, neutral",
            "{rail:} and {neutral}",
            [("rail", temperature.rail, "degrees C"), ("neutral", temperature.neutral, "degrees C")],
        ),
        Row::number("sigma_xx", temperature.stress(&case.steel), "MPa"),
    ]
}

/// The passage, of a mix in what its wheels share.
pub(super) fn passage(case: &Case) -> Vec<Row> {
    let settings = &case.first_wheel().passages;
    let passage = &settings.passage;
    let first_mouth = case.cracks.cracks().first().map_or(0.0, |c| c.points()[0].x);
    let over_a = |x: f64| (x - first_mouth) / case.half_width();
    let mut rows = Vec::new();
    if !case.is_mix() {
        rows.extend([
            Row::text("wheel runs towards", passage.travel().word()),
            between("from, to", passage.from, passage.to),
            Row::with(
                "over a",
                "{from} to {to} from the first crack",
                [("from", over_a(passage.from), ""), ("to", over_a(passage.to), "")],
            ),
        ]);
    }
    rows.extend([
        Row::number("output positions", passage.positions as f64, ""),
        Row::with(
            "passages",
            "until K repeats to {tolerance}, at most {most}",
            [("tolerance", settings.passage_tolerance, ""), ("most", settings.max_passages as f64, "")],
        ),
        match settings.step_control {
            StepControl::Adaptive => Row::with(
                "load steps",
                "substeps until K changes by less than {tolerance} of its peak",
                [("tolerance", settings.step_tolerance, "")],
            ),
            StepControl::Fixed => Row::text("load steps", "one per output position"),
        },
    ]);
    rows
}

/// The fluid in the cracks.
pub(super) fn fluid(fluid: &CrackFluid) -> Row {
    let cracks = fluid.cracks.as_ref().map_or_else(String::new, |cracks| {
        let numbers: Vec<String> = cracks.iter().map(|crack| (crack + 1).to_string()).collect();
        format!(", in cracks {}", numbers.join(", "))
    });
    let text = match fluid.model {
        FluidModel::Mouth { cap } => {
            let most = match cap.is_finite() {
                true => format!(", at most {} MPa", short(cap)),
                false => "; without a cap this overestimates K by far".to_owned(),
            };
            format!("contact pressure at the mouth, {} along the crack{cracks}{most}", fluid.profile.word())
        }
        FluidModel::Trapped { bulk_modulus, .. } => {
            let modulus = match bulk_modulus.is_finite() {
                true => format!("bulk modulus {} MPa", short(bulk_modulus)),
                false => "incompressible".to_owned(),
            };
            format!(
                "trapped while the contact covers the mouth, {modulus}{cracks}; none is lost sideways; buried cracks are filled from the start"
            )
        }
    };
    Row::text("fluid", text)
}

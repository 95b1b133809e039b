//! Assumptions behind a result: model, load, criteria, solution.

use super::stored::RunFolder;
use crate::numbers::{fixed, formula, given, grouped, rounded, significant};
use railcrack::bulk::Boundary;
use railcrack::contact::{FluidModel, StepControl};
use railcrack::fatigue::DirectionCriterion;
use railcrack::growth::Turning;
use railcrack::load::Contact;
use railcrack::math::RailBox;
use railcrack::profiles::ProfileContact;
use railcrack::words::Choice;
use railcrack_case::{Case, ContactOrigin, ContactSolver, GivenContact, GivenWheel, TrafficWheel};

/// The assumptions, one paragraph each.
pub(super) fn assumptions(run: &RunFolder) -> Vec<String> {
    let case = &run.case;
    let mut all = vec![rail(case)];
    all.extend(wheels(case));
    all.extend([
        passage(run),
        faces(case),
        residual(run),
        rate(case),
        direction(case),
        solution(run),
        limits(case),
    ]);
    all
}

/// The wheel, or every wheel of a mix.
fn wheels(case: &Case) -> Vec<String> {
    if !case.is_mix() {
        let text = wheel("Wheel", case.first_wheel());
        return vec![format!(
            "{text} It is the same in every load cycle.{}",
            long_rail(case) + &fluid(case.first_wheel())
        )];
    }
    let of = |mixed: &TrafficWheel| {
        let load = mixed.axle_load.map_or_else(String::new, |load| format!(", {} t", given(load)));
        let name = format!(
            "Wheel \u{201c}{}\u{201d} ({} % of the axles{load})",
            mixed.name,
            given(rounded(100.0 * mixed.share, 3))
        );
        wheel(&name, mixed) + &long_rail_under(&mixed.wheel, case) + &fluid(mixed)
    };
    let mut all: Vec<String> = case.wheels.iter().map(of).collect();
    if let Some(last) = all.last_mut() {
        last.push_str(&format!(
            " The rate of a tip is the mean of those under the {} wheels, weighted with their shares.",
            case.wheels.len()
        ));
    }
    all
}

fn limits(case: &Case) -> String {
    let wear = if case.maintenance.is_some() {
        "wear and grinding shorten the crack but leave the rail profile and the contact unchanged"
    } else {
        "no wear"
    };
    format!(
        "Limits: two dimensions, small-scale yielding, no fluid in the crack except as given in the case; {wear}. Load cycles are uncertain by \
         a factor of several, the scatter of the growth law."
    )
}

fn rail(case: &Case) -> String {
    let (young, poisson) = (case.steel.young(), given(case.steel.poisson()));
    let boundary = match case.rail.boundary {
        Boundary::HalfPlane if let Some(section) = case.rail.section => {
            format!("half-plane with the compliance of head, web and foot of a {}", section.name)
        }
        Boundary::HalfPlane => "half-plane, bounded by the running surface only".to_owned(),
        Boundary::Block { bottom, sides } => {
            let RailBox { width, depth, .. } = case.rail.extent;
            format!(
                "block of {} × {} mm, bottom {}, sides {}",
                given(width),
                given(depth),
                bottom.word(),
                sides.word()
            )
        }
    };
    format!("Rail: linear elastic, plane strain, E = {} MPa, ν = {poisson}; {boundary}.", grouped(young))
}

/// A wheel called `name`.
fn wheel(name: &str, wheel: &TrafficWheel) -> String {
    let passage = wheel.passages.passage;
    let Some(GivenContact { contact, origin, coupling }) = wheel.wheel.given() else {
        return format!("{name}: its contact misses the cracks.");
    };
    let drags = match contact.adhesion() {
        0.0 => "no friction",
        f if f > 0.0 => "drags the rail along +x",
        _ => "drags the rail along −x",
    };
    let travel = if passage.from > passage.to { "−x" } else { "+x" };
    let shear = match contact {
        Contact::Hertz(contact) => format!("wheel–rail friction {} ({drags})", given(contact.friction)),
        Contact::Carter(carter) => format!(
            "wheel–rail friction {} in the slip zone, traction Q/(μP) = {} ({drags})",
            given(carter.friction),
            given(carter.traction)
        ),
        Contact::Table(_) => format!("Q/P = {} ({drags})", given(contact.adhesion())),
    };
    let pressure = contact.kind().described();
    let strip = match origin {
        ContactOrigin::Ellipse { wheel, ellipse, lateral, .. } => format!(
            " The plane of the model is {} mm off the centre of the Hertz ellipse of a wheel load of {} kN, with semi-axes {} mm along and {} mm \
             across the rail.",
            given(*lateral),
            fixed(1e-3 * wheel.wheel_load, 1),
            fixed(ellipse.along, 2),
            fixed(ellipse.across, 2)
        ),
        ContactOrigin::GivenEllipse { ellipse, lateral, .. } => format!(
            " The plane of the model is {} mm off the centre of a Hertz ellipse with semi-axes {} mm along and {} mm across the rail.",
            given(*lateral),
            fixed(ellipse.along, 2),
            fixed(ellipse.across, 2)
        ),
        ContactOrigin::Rolling { patch, lateral, .. } => format!(
            " The plane of the model is {} mm off the centre of a patch with semi-axes {} mm along and {} mm across the rail under {} kN; its \
             shear follows from creepages of {} along and {} across the rail and a spin of {} per mm (theory: {}).",
            given(*lateral),
            fixed(patch.ellipse.along, 2),
            fixed(patch.ellipse.across, 2),
            fixed(1e-3 * patch.normal_force(), 1),
            given(patch.creepage.longitudinal),
            given(patch.creepage.lateral),
            given(patch.creepage.spin),
            patch.theory.word()
        ),
        ContactOrigin::Profiles(own) => {
            let of = |contact: &ProfileContact| {
                format!(
                    "y = {} mm on the rail ({} kN, p_{{0}} = {} MPa, tilted by {}°)",
                    fixed(contact.y, 2),
                    fixed(1e-3 * contact.normal_force, 1),
                    fixed(contact.ellipse.peak_pressure, 0),
                    fixed(contact.angle.to_degrees(), 1)
                )
            };
            let all: Vec<String> = own.contacts.iter().map(of).collect();
            format!(
                " The plane of the model is at y = {} mm on the profile of the rail. The profiles touch at {}; the pressure is that of \
                 interpenetrating surfaces with the ellipse correction of CONTACT (KPEC), the shear follows from creepages and spin.",
                given(own.lateral),
                all.join(" and at ")
            )
        }
        _ => String::new(),
    };
    let felt = match coupling {
        Some(coupling) => format!(
            "Within {} a of a mouth the contact is that of a smooth elastic wheel on the rail with its cracks.",
            given(coupling.within)
        ),
        None => "The contact is not affected by the cracks.".to_owned(),
    };
    format!(
        "{name}: {pressure}, p_{{0}} = {} MPa, half-width a = {} mm, {shear}, rolling towards {travel}.{strip} {felt}",
        fixed(contact.peak_pressure(), 0),
        fixed(contact.half_width(), 2)
    )
}

/// Fluid in the cracks under `wheel`.
fn fluid(wheel: &TrafficWheel) -> String {
    match wheel.fluid.as_ref().map(|fluid| fluid.model) {
        None => String::new(),
        Some(FluidModel::Mouth { cap }) => {
            if wheel.wheel.coupling().is_some() {
                let text = " The fluid pressure in a crack equals the mean contact pressure within 0.1 a of its mouth.";
                return text.to_owned();
            }
            let most = if cap.is_finite() { format!(", at most {} MPa", given(cap)) } else { String::new() };
            format!(
                " The fluid pressure in a crack equals the contact pressure at its mouth{most}. Without a cap this overestimates K by far."
            )
        }
        Some(FluidModel::Trapped { bulk_modulus, .. }) => {
            let kept = if bulk_modulus.is_finite() {
                format!(", B = {} MPa", given(bulk_modulus))
            } else {
                String::new()
            };
            format!(
                " Fluid in a crack is trapped while the contact covers the mouth{kept}; none is lost sideways."
            )
        }
    }
}

/// Bending and temperature of the rail under the first wheel.
pub(super) fn long_rail(case: &Case) -> String {
    long_rail_under(&case.first_wheel().wheel, case)
}

/// Bending and temperature of the rail under `wheel`.
fn long_rail_under(wheel: &GivenWheel, case: &Case) -> String {
    let mut text = String::new();
    if let (Some(track), Some(bending)) = (&wheel.track, wheel.bending(&case.steel)) {
        let axles = match track.axles.len() {
            1 => "the axle".to_owned(),
            count => format!("{count} axles"),
        };
        text.push_str(&format!(
            " The rail bends under {axles} as a beam on a foundation of {} MPa, σ_{{xx}} = {} MPa at the surface under the wheel; \
             1/β = {} mm.",
            given(track.foundation),
            given(rounded(bending.stress(0.0, 0.0), 3)),
            fixed(bending.length(), 0)
        ));
    }
    if let Some(temperature) = wheel.temperature {
        text.push_str(&format!(
            " The rail is at {} °C, neutral at {} °C: σ_{{xx}} = {} MPa at all times.",
            given(temperature.rail),
            given(temperature.neutral),
            given(temperature.stress(&case.steel))
        ));
    }
    text
}

fn passage(run: &RunFolder) -> String {
    let settings = &run.case.first_wheel().passages;
    let steps = match settings.step_control {
        StepControl::Adaptive => {
            let percent = given(100.0 * settings.step_tolerance);
            format!("load steps in between refined until K changes by less than {percent} % of its peak")
        }
        StepControl::Fixed => "one load step per position".to_owned(),
    };
    format!(
        "Passage: {} output positions, {steps}. The passage is repeated on fixed cracks until K repeats, after \
         {} of at most {} passages.",
        run.case.positions(run.case.first_wheel()).len(),
        run.summary.passages,
        settings.max_passages
    )
}

fn faces(case: &Case) -> String {
    let mut frictions = case.crack_friction.clone();
    frictions.dedup();
    let list: Vec<String> = frictions.iter().copied().map(given).collect();
    let order = if list.len() > 1 { " in the order of the cracks" } else { "" };
    format!(
        "Crack faces: no initial gap, unilateral contact, Coulomb friction with coefficient {}{order}; the friction state is reset at \
         the start of each growth step.",
        list.join(", ")
    )
}

/// The residual stress and its origin.
fn residual(run: &RunFolder) -> String {
    if run.residual.is_empty() {
        return "Residual stress: none.".to_owned();
    }
    let (least, most) =
        run.residual.iter().fold((0.0f64, 0.0f64), |(l, m), row| (l.min(row[1]), m.max(row[1])));
    let mut text = format!(
        "Residual stress: σ_{{xx}} from {} to {} MPa on the vertical centre line; it does not relax as the cracks grow.",
        fixed(least, 0),
        fixed(most, 0)
    );
    let Some(summary) = &run.summary.residual_stress else { return text };
    if let Some(file) = &summary.balanced_profile {
        text.push_str(&format!(" A balanced profile by depth is given ({file})."));
    }
    match (&summary.plastic_source, &summary.rolled) {
        (_, Some(rolled)) => text.push_str(&format!(
            " Its plastic part was computed from repeated passages of the {} over this rail ({}, {} passages, in {}) \
             and balanced on the mesh of the cracks.",
            if run.case.is_mix() { "heaviest wheel" } else { "same wheel" },
            rolled.state.word(),
            rolled.passes,
            rolled.folder
        )),
        (Some(source), None) => text.push_str(&format!(
            " Its plastic part is given ({}) and was balanced on the mesh of the cracks.",
            source.word()
        )),
        (None, None) => {}
    }
    if let Some(projection) = &summary.projection {
        text.push_str(&format!(
            " The projection onto that mesh changed the plastic stress by {} % in norm.",
            significant(100.0 * projection.mesh_difference)
        ));
    }
    text
}

fn rate(case: &Case) -> String {
    let law = &case.growth.law;
    let shown = |text: &str| {
        // The rest of ΔKI and ΔKII is set first, so that what is left is ΔK_eq.
        let text = formula(text).replace("ΔKII", "Δ\u{0}_{II}").replace("ΔKI", "Δ\u{0}_{I}");
        raised(&text.replace("ΔK", "ΔK_{eq}").replace('\u{0}', "K").replace("Kmax", "K_{max}"))
    };
    let held = law.shear_threshold().map_or(String::new(), |text| format!("; {}", shown(&text)));
    format!(
        "Growth rate: {}, in mm per load cycle and MPa√m, with {}{held}.",
        shown(&law.rate.formula()),
        shown(&law.equivalent.formula())
    )
}

/// `text` with the numbers after `^` as powers.
fn raised(text: &str) -> String {
    let mut parts = text.split('^');
    let mut raised = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(part.len());
        // A full stop after the number is punctuation.
        let power = part[..end].trim_end_matches('.');
        if power.is_empty() {
            raised.push('^');
        } else {
            raised.push_str(&format!("^{{{power}}}"));
        }
        raised.push_str(&part[power.len()..]);
    }
    raised
}

fn direction(case: &Case) -> String {
    let criterion = match case.growth.criterion {
        DirectionCriterion::MaxRate => "the growth rate of the virtual kink",
        DirectionCriterion::MaxRateUnclipped => {
            "the growth rate of the virtual kink, with negative k_{1} counted in its range,"
        }
        DirectionCriterion::MaxDeltaK1 => "the range of k_{1}",
        DirectionCriterion::MaxK1 => "k_{1}",
        DirectionCriterion::MaxTangentialStress => "the tangential stress ahead of the tip",
        DirectionCriterion::MaxDeltaCtd => "the range of the displacement vector at its tip",
        DirectionCriterion::Coplanar => "",
    };
    let direction = match case.growth.criterion {
        DirectionCriterion::Coplanar => "straight ahead".to_owned(),
        _ => format!("the kink that maximises {criterion} over the passage"),
    };
    let path = match case.growth.turning {
        _ if case.engine.is_in_space() => "The front stays in its plane. ".to_owned(),
        _ if case.growth.criterion == DirectionCriterion::Coplanar => String::new(),
        Turning::Kink => "In each increment the crack kinks by the whole of it. ".to_owned(),
        Turning::Over(0.0) => "The path turns until this kink is zero at each tip (limit path). ".to_owned(),
        Turning::Over(f64::INFINITY) => "The path stays straight ahead. ".to_owned(),
        Turning::Over(length) => format!(
            "The path turns towards it over {} mm; kinks of {}° and more are made at once. ",
            given(length),
            given(case.growth.kink_angle.to_degrees())
        ),
    };
    let increments = case.growth.tolerance.map_or_else(
        || {
            let share = given(100.0 * case.growth.increment);
            format!("The increment of the fastest tip is {share} % of the length of its crack")
        },
        |tolerance| {
            let share = given(100.0 * tolerance);
            format!("The increments are chosen such that their error of the life stays within {share} %")
        },
    );
    format!(
        "Direction: {direction}. {path}{increments}; load cycles follow from the mean of the inverse growth rates at the start \
         and the end of each.",
    )
}

fn solution(run: &RunFolder) -> String {
    let summary = &run.summary;
    let engine = run.case.engine.method();
    let solver = match run.case.contact_solver {
        ContactSolver::Latin => "the LATIN method",
        ContactSolver::Newton => "Newton's method",
    };
    format!(
        "Solution: {engine} with at most {} unknowns and {} face points; contact of the crack faces by {solver}, solved {} \
         times, with a relative violation of the contact conditions of at most {:.0e}.",
        grouped(summary.dofs as f64),
        summary.face_points,
        grouped(summary.contact_solves as f64),
        summary.complementarity_max
    )
}

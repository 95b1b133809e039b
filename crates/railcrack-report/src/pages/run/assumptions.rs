//! What the result rests on.

use super::stored::RunFolder;
use crate::numbers::{fixed, grouped, significant};
use railcrack_case::{ContactSolver, Engine};
use railcrack_run::Word;

/// A sentence each; of what the case does not say, nothing.
pub(super) fn assumptions(run: &RunFolder) -> Vec<String> {
    let mut texts = vec![rail(run)];
    texts.extend(wheel(run));
    texts.extend(passage(run));
    texts.push(faces(run));
    texts.extend(residual(run));
    texts.extend(growth(run));
    texts.push(engine(run));
    texts.push(
        "Two dimensions, small-scale yielding, no fluid in the crack, no wear; cycles carry the scatter of the growth law, a \
         factor of several."
            .to_owned(),
    );
    texts
}

fn rail(run: &RunFolder) -> String {
    let elastic = match (run.number("rail.young_modulus_mpa"), run.number("rail.poisson_ratio")) {
        (Some(young), Some(poisson)) => format!(", E = {} MPa, ν = {poisson}", grouped(young)),
        _ => String::new(),
    };
    let boundary = match (run.summary.boundary.word(), run.word("rail.bottom"), run.word("rail.sides")) {
        ("half-plane", ..) => "half-plane: no boundary but the running surface".to_owned(),
        ("block", Some(bottom), Some(sides)) => format!(
            "block of {} × {} mm, bottom {bottom}, sides {sides}",
            run.number("rail.width_mm").unwrap_or_default(),
            run.number("rail.depth_mm").unwrap_or_default()
        ),
        (other, ..) => other.to_owned(),
    };
    format!("Rail: linear elastic, plane strain{elastic}; {boundary}.")
}

fn wheel(run: &RunFolder) -> Option<String> {
    let (pressure, friction) = (run.peak_pressure()?, run.number("contact.friction")?);
    let drags = match friction {
        0.0 => "no friction",
        f if f > 0.0 => "it drags the rail along +x",
        _ => "it drags the rail along −x",
    };
    let ways = (run.number("passage.from_over_a"), run.number("passage.to_over_a"));
    let travel = match ways {
        (Some(from), Some(to)) if from > to => ", running towards −x",
        (Some(_), Some(_)) => ", running towards +x",
        _ => "",
    };
    Some(format!(
        "Wheel: Hertzian line contact in full sliding, p_{{0}} = {} MPa, half-width a = {} mm, friction {} ({drags}){travel}; the \
         crack does not change it, and it is the same in every cycle.",
        fixed(pressure, 0),
        fixed(run.summary.half_width_mm, 2),
        signed(friction)
    ))
}

fn signed(value: f64) -> String {
    value.to_string().replace('-', "\u{2212}")
}

fn passage(run: &RunFolder) -> Option<String> {
    let positions = run.number("passage.positions")?;
    let tolerance = run.number("passage.step_tolerance")?;
    let most = run.number("passage.max_passages")?;
    Some(format!(
        "Passage: {positions:.0} wheel positions, load steps between them to {} % of the peak of K; repeated on the fixed crack until K \
         does, which took {} of at most {most:.0} passages.",
        signed(100.0 * tolerance),
        run.summary.passages
    ))
}

fn faces(run: &RunFolder) -> String {
    let mut frictions = run.of_cracks("friction");
    frictions.dedup();
    let friction = match &frictions[..] {
        [] => String::new(),
        [one] => format!(" with coefficient {one}"),
        several => {
            let list: Vec<String> = several.iter().map(f64::to_string).collect();
            format!(" with coefficients {} in the order of the case", list.join(", "))
        }
    };
    format!(
        "Crack faces: no gap, unilateral contact, Coulomb friction{friction}; virgin in each growth step."
    )
}

/// What residual stress there is, and where it comes from.
fn residual(run: &RunFolder) -> Vec<String> {
    if run.residual.is_empty() {
        return vec!["No residual stress.".to_owned()];
    }
    let (least, most) =
        run.residual.iter().fold((0.0f64, 0.0f64), |(l, m), row| (l.min(row[1]), m.max(row[1])));
    let mut text = format!(
        "Residual stress: σ_{{xx}} from {} to {} MPa on the middle line; it neither relaxes nor moves with the crack.",
        fixed(least, 0),
        fixed(most, 0)
    );
    let Some(summary) = &run.summary.residual_stress else { return vec![text] };
    if let Some(file) = &summary.balanced_profile {
        text.push_str(&format!(" Given as balanced by depth ({file})."));
    }
    match (&summary.plastic_source, &summary.rolled) {
        (_, Some(rolled)) => text.push_str(&format!(
            " Its plastic part is that of the same wheel rolling over this rail ({}, {} passages, in {}), balanced on the mesh of the cracks.",
            rolled.state.name(), rolled.passes, rolled.folder
        )),
        (Some(source), None) => text.push_str(&format!(
            " Its plastic part is given ({}) and balanced on the mesh of the cracks.",
            source.word()
        )),
        (None, None) => {}
    }
    if let Some(projection) = &summary.projection {
        text.push_str(&format!(
            " On the way to that mesh the plastic stress changed by {} % in norm.",
            significant(100.0 * projection.mesh_difference)
        ));
    }
    vec![text]
}

fn growth(run: &RunFolder) -> Vec<String> {
    let mut texts = Vec::new();
    if let (Some(c), Some(m), Some(weight)) =
        (run.number("growth.paris_c"), run.number("growth.paris_m"), run.number("growth.mode_2_weight"))
    {
        let threshold = run.number("growth.threshold_mpa_sqrt_m").unwrap_or(0.0);
        texts.push(format!(
            "Rate: da/dN = {c:e} ΔK_{{eq}}^{{{m}}} mm per cycle in MPa√m, weight of mode II {weight}, {}.",
            if threshold > 0.0 {
                format!("no growth up to {threshold} MPa√m")
            } else {
                "no threshold".to_owned()
            }
        ));
    }
    if let (Some(direction), Some(increment)) = (run.word("growth.direction"), run.number("growth.increment"))
    {
        let rule = match direction {
            "max-rate" => "largest growth rate",
            "max-delta-k1" => "largest range of k_{1}",
            "max-k1" => "largest k_{1}",
            other => other,
        };
        texts.push(format!(
            "Direction: virtual kink with the {rule} over the passage. Increments of {} % of the length for the fastest tip; cycles \
             by explicit Euler: the rate at the start of a step holds through it.",
            signed(crate::numbers::rounded(100.0 * increment, 6))
        ));
    }
    texts
}

fn engine(run: &RunFolder) -> String {
    let summary = &run.summary;
    let engine = match summary.engine {
        Engine::Xfem => "extended finite elements",
        Engine::Dislocation => "distributed dislocations",
    };
    format!(
        "Solved with {engine} ({} unknowns, {} face points at most), contact by {}: {} solutions, law of the faces met to {:.0e}.",
        grouped(summary.dofs as f64),
        summary.face_points,
        if summary.contact == ContactSolver::Latin { "LATIN" } else { "Newton's method" },
        grouped(summary.contact_solves as f64),
        summary.complementarity_max
    )
}

//! Assumptions behind a result: the description of its case, with what the run found of it.

use super::stored::RunFolder;
use crate::numbers::{fixed, grouped, significant};
use crate::pages::described::{OF_GROWTH, described};
use railcrack::words::Choice;

/// The assumptions, one paragraph each.
pub(super) fn assumptions(run: &RunFolder) -> Vec<String> {
    let mut all = described(&run.case, &OF_GROWTH);
    all.extend([residual(run), solution(run)]);
    all
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

/// The size of the solution and how well the contact conditions hold.
fn solution(run: &RunFolder) -> String {
    let summary = &run.summary;
    let unknowns = match summary.dofs {
        0 => String::new(),
        dofs => format!("at most {} unknowns and ", grouped(dofs as f64)),
    };
    format!(
        "Solution: {} with {unknowns}{} face points; contact of the crack faces by {}, solved {} times, with a relative \
         violation of its conditions of at most {:.0e}. K repeated after {} of at most {} passages.",
        run.case.engine().method(),
        summary.face_points,
        run.case.contact_solver().method(),
        grouped(summary.contact_solves as f64),
        summary.complementarity_max,
        summary.passages,
        run.case.first_wheel().passages.max_passages
    )
}

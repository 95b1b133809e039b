//! A case in words and numbers, once for the terminal, for pages and for JSON.

mod cracks;
mod growth;
mod model;
mod row;
mod stress;
mod wheel;

use crate::machine::{Budget, Needs, long_step, mb, step_seconds};
use crate::setup::RunSize;
use crate::summary::validity::{of_case, uncoupled_wheel};
use railcrack::words::Choice;
use railcrack_case::Case;
use std::path::Path;

pub use row::{Number, Part, Row, parts_json};

/// The case by its parts: what is given, and what follows from it without a run. A table of wheels
/// is described by its representatives, if they are [found](crate::setup::represented).
#[must_use]
pub fn describe(case: &Case) -> Vec<Part> {
    let mut parts = vec![Part::new("rail", model::rail(case))];
    parts.extend(wheel::wheels(case));
    parts.extend([
        Part::new("passage", wheel::passage(case)),
        Part::new("cracks", cracks::cracks(case)),
        Part::new("crack in space", cracks::in_space(case)),
        Part::new("residual stress", stress::residual(case)),
        Part::new("plastic stress", stress::plastic(case)),
        Part::new("solution", solution(case)),
        Part::new("growth", growth::growth(case)),
        Part::new("maintenance", growth::maintenance(case)),
        Part::new("model", model::limits(case)),
        Part::new("plastic state", stress::plastic_state(case)),
        Part::new("bounds", stress::bounds(case)),
    ]);
    parts
}

/// Demands of a run of the case on the machine, with results below `folder`.
#[must_use]
pub fn describe_needs(case: &Case, folder: &Path) -> Part {
    let (size, budget) = (RunSize::estimate(case), Budget::of(folder));
    let needs = Needs::with(case, &size);
    let of = |has: Option<u64>| has.map_or_else(String::new, |has| format!(" of {} MB", mb(has)));
    let mut rows = vec![
        Row::text("memory", format!("about {} MB{}", mb(needs.memory), of(budget.memory))),
        Row::text("disk", format!("about {} MB of tables{}", mb(needs.disk), of(budget.disk))),
    ];
    if let Err(over) = budget.allows(needs, 1, 1) {
        rows.push(Row::text("too large", over.to_string()));
    }
    rows.extend(long_step(step_seconds(case, &size), &size).map(|says| Row::text("slow", says)));
    Part::new("machine", rows)
}

/// The warnings that a run of the case would begin with.
#[must_use]
pub fn describe_warnings(case: &Case) -> Part {
    let texts = of_case(case).into_iter().map(|warning| warning.text).chain(uncoupled_wheel(case));
    Part::new("warnings", texts.map(Row::line).collect())
}

fn solution(case: &Case) -> Vec<Row> {
    let size = RunSize::estimate(case);
    let mut rows =
        vec![Row::text("engine", case.engine().word()), Row::text("contact", case.contact_solver().word())];
    if size.displacements > 0 {
        rows.push(Row::text("displacements", format!("{} unknowns, factored once", size.displacements)));
    }
    rows.extend([
        Row::text("face points", size.face_points.to_string()),
        Row::text("face unknowns", size.unknowns.to_string()),
        Row::text("tips", size.tips.to_string()),
        Row::text("memory", format!("about {} MB", size.memory_bytes.div_ceil(1 << 20))),
    ]);
    rows
}

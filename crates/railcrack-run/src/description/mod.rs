//! A case in words and numbers, once for the terminal, for pages and for JSON.

mod cracks;
mod duration;
mod growth;
mod model;
mod row;
mod stress;
mod wheel;

use crate::machine::{Budget, Needs, mb};
use crate::setup::RunSize;
use crate::summary::validity::{before_a_run, warning_pages};
use railcrack::words::Choice;
use railcrack_case::Case;
use std::cell::OnceCell;
use std::path::Path;

pub use duration::{RunTime, duration, long_step};
pub use row::{Number, Part, Row, parts_json};

/// A subject of a description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// Elasticity and boundary of the rail.
    Rail,
    /// Contact, track and temperature of each wheel.
    Wheels,
    /// Positions of the wheel, and how load steps and passages are controlled.
    Passage,
    /// The cracks in the plane.
    Cracks,
    /// The cracks in space.
    Fronts,
    /// The given residual stress.
    ResidualStress,
    /// The plastic stress, or why there is none.
    PlasticStress,
    /// Engine, contact solver and size of the first step.
    Solution,
    /// Growth law, path, and what ends the growth.
    Growth,
    /// Wear and grinding.
    Maintenance,
    /// Limits of the model.
    Model,
    /// The stabilised plastic state that `railcrack shakedown` would compute.
    PlasticState,
    /// Peak pressure against first yield and the shakedown limit.
    Bounds,
}

impl Subject {
    /// All of them, in the order in which they are read.
    pub const ALL: [Self; 13] = [
        Self::Rail,
        Self::Wheels,
        Self::Passage,
        Self::Cracks,
        Self::Fronts,
        Self::ResidualStress,
        Self::PlasticStress,
        Self::Solution,
        Self::Growth,
        Self::Maintenance,
        Self::Model,
        Self::PlasticState,
        Self::Bounds,
    ];
}

/// A case in words and numbers: what is given, and what follows from it without a run. A table of
/// wheels is described by its representatives, if they are [found](crate::setup::represented).
pub struct Description<'a> {
    case: &'a Case,
    /// The estimate makes a mesh, for those who ask.
    size: OnceCell<RunSize>,
}

impl<'a> Description<'a> {
    /// The description of `case`.
    pub fn of(case: &'a Case) -> Self {
        Self { case, size: OnceCell::new() }
    }

    /// Size of the first step.
    pub fn size(&self) -> &RunSize {
        self.size.get_or_init(|| RunSize::estimate(self.case))
    }

    /// Memory and disk of a run.
    pub fn needs(&self) -> Needs {
        Needs::with(self.case, self.size())
    }

    /// Processor time of a run.
    pub fn time(&self) -> RunTime {
        RunTime::of(self.case, self.size())
    }

    /// The parts about `subjects`, in their order; parts that the case does not have are without
    /// rows.
    pub fn parts(&self, subjects: &[Subject]) -> Vec<Part> {
        subjects.iter().flat_map(|subject| self.about(*subject)).collect()
    }

    fn about(&self, subject: Subject) -> Vec<Part> {
        let case = self.case;
        let (heading, rows) = match subject {
            Subject::Wheels => return wheel::wheels(case),
            Subject::Rail => ("rail", model::rail(case)),
            Subject::Passage => ("passage", wheel::passage(case)),
            Subject::Cracks => ("cracks", cracks::cracks(case)),
            Subject::Fronts => ("crack in space", cracks::in_space(case)),
            Subject::ResidualStress => ("residual stress", stress::residual(case)),
            Subject::PlasticStress => ("plastic stress", stress::plastic(case)),
            Subject::Solution => ("solution", self.solution()),
            Subject::Growth => ("growth", growth::growth(case)),
            Subject::Maintenance => ("maintenance", growth::maintenance(case)),
            Subject::Model => ("model", model::limits(case)),
            Subject::PlasticState => ("plastic state", stress::plastic_state(case)),
            Subject::Bounds => ("bounds", stress::bounds(case)),
        };
        vec![Part::new(heading, rows)]
    }

    /// Demands of a run on the machine, with results below `folder`.
    pub fn machine(&self, folder: &Path) -> Part {
        let (needs, budget) = (self.needs(), Budget::of(folder));
        let of = |has: Option<u64>| has.map_or_else(String::new, |has| format!(" of {} MB", mb(has)));
        let mut rows = vec![
            Row::text("memory", format!("about {} MB{}", mb(needs.memory), of(budget.memory))),
            Row::text("disk", format!("about {} MB of tables{}", mb(needs.disk), of(budget.disk))),
        ];
        let time = self.time();
        rows.push(Row::text("time", time.in_words()));
        if let Err(over) = budget.allows(needs, 1, 1) {
            rows.push(Row::text("too large", over.to_string()));
        }
        rows.extend(long_step(time.step, self.size()).map(|text| Row::text("slow", text)));
        Part::new("machine", rows)
    }

    /// The warnings that a run would begin with, and whether its wheel should feel the cracks, each
    /// a line without a name; and where the user's book says what to do.
    pub fn warnings(&self) -> Part {
        let warnings = before_a_run(self.case);
        let pages = warning_pages(warnings.iter().map(|warning| warning.kind));
        let pages = pages.map(|pages| Row::text("what to do", pages));
        let lines = warnings.into_iter().map(|warning| Row::line(warning.text));
        Part::new("warnings", lines.chain(pages).collect())
    }

    fn solution(&self) -> Vec<Row> {
        let size = self.size();
        let mut rows = vec![
            Row::text("engine", self.case.engine().word()),
            Row::text("contact", self.case.contact_solver().word()),
        ];
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
}

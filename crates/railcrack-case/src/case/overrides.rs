//! Values of the command line that take the place of the file's.

use crate::schema::{Override, Raw, Row, Section};
use crate::tables::{ENGINE, GROWTH, SOLVER, SOLVER_CONTACT, STEPS};

/// Values that take the place of those in the case file, checked as those are.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Overrides {
    /// `[growth] steps`.
    pub steps: Option<u64>,
    /// `[solver] engine`.
    pub engine: Option<String>,
    /// `[solver] contact`.
    pub contact: Option<String>,
}

impl Overrides {
    /// Those that are given.
    pub(crate) fn list(&self) -> Vec<Override> {
        let count = |n: u64| i64::try_from(n).map_or(Raw::TooLarge, Raw::Integer);
        let given = [
            self.steps.map(|steps| of(&GROWTH, STEPS, "--steps", count(steps))),
            self.engine.clone().map(|engine| of(&SOLVER, ENGINE, "--engine", Raw::Text(engine))),
            self.contact.clone().map(|contact| of(&SOLVER, SOLVER_CONTACT, "--contact", Raw::Text(contact))),
        ];
        given.into_iter().flatten().collect()
    }
}

fn of<T>(section: &Section, row: Row<T>, option: &'static str, value: Raw) -> Override {
    Override { section: section.name, key: row.key.name, option, value }
}

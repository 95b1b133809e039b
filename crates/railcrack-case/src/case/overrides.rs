//! Values of the command line that replace those of the file.

use super::setting::{leaving_out, setting};
use crate::schema::{KeyRow, Override, Raw, Report, Section};
use crate::tables::{ENGINE, GROWTH, SOLVER, SOLVER_CONTACT, STEPS};

/// Values that replace those in the case file and are checked in the same manner.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Overrides {
    /// `[growth] steps`.
    pub steps: Option<u64>,
    /// `[solver] engine`.
    pub engine: Option<String>,
    /// `[solver] contact`.
    pub contact: Option<String>,
    /// Any keys, each `section.key=value`, the value as in the file: `contact.friction=0.2`,
    /// `crack[2].angle_deg=30.0`. If a key is given several times, the last one counts. Text may be
    /// given without quotes.
    pub settings: Vec<String>,
    /// Keys that are left out of the file, each `section.key`.
    pub left_out: Vec<String>,
}

impl Overrides {
    /// Those that are given; errors of the settings are added to `report`.
    pub(crate) fn list(&self, report: &mut Report) -> Vec<Override> {
        let count = |n: u64| i64::try_from(n).map_or(Raw::TooLarge, Raw::Integer);
        let given = [
            self.steps.map(|steps| {
                let shown = format!(
                    "--steps {}",
                    i64::try_from(steps).map_or("(too large)".into(), |n| n.to_string())
                );
                of(&GROWTH, STEPS, shown, count(steps))
            }),
            self.engine.clone().map(|name| of(&SOLVER, ENGINE, format!("--engine {name}"), Raw::Text(name))),
            self.contact
                .clone()
                .map(|name| of(&SOLVER, SOLVER_CONTACT, format!("--contact {name}"), Raw::Text(name))),
        ];
        let left_out: Vec<Override> = self.left_out.iter().filter_map(|key| leaving_out(key)).collect();
        let settings: Vec<Override> =
            self.settings.iter().filter_map(|given| setting(given, report)).collect();
        left_out.into_iter().chain(settings).chain(given.into_iter().flatten()).collect()
    }
}

fn of<T>(section: &Section, row: KeyRow<T>, shown: String, value: Raw) -> Override {
    Override { section: section.name, key: row.key.name, number: None, shown, value: Some(value) }
}

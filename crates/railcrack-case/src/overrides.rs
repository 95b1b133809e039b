//! Values of the command line that take the place of the file's.

use super::accept::Raw;

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
    /// The option and the value given with it, where `section` and `key` are overridden.
    pub(super) fn of(&self, section: &str, key: &str) -> Option<(&'static str, Raw)> {
        let text = |value: &Option<String>| value.clone().map(Raw::Text);
        match (section, key) {
            ("growth", "steps") => {
                let steps = self.steps?;
                Some(("--steps", i64::try_from(steps).map_or(Raw::TooLarge, Raw::Integer)))
            }
            ("solver", "engine") => Some(("--engine", text(&self.engine)?)),
            ("solver", "contact") => Some(("--contact", text(&self.contact)?)),
            _ => None,
        }
    }

    /// The value as given, for messages.
    pub(super) fn shown(raw: &Raw) -> String {
        match raw {
            Raw::Integer(n) => n.to_string(),
            Raw::Text(text) => text.clone(),
            _ => "(too large)".into(),
        }
    }
}

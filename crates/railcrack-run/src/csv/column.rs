//! Columns of tables.

/// A column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Its name, with the unit of its numbers.
    pub name: &'static str,
    /// Its meaning, line by line.
    pub meaning: &'static [&'static str],
    /// The section of the case without which a run has no such column; none where every run has it.
    pub section: Option<&'static str>,
}

/// Prefix of columns of which there is one for each wheel of a mix.
const OF_WHEEL: &str = "share_wheel_";

impl Column {
    /// Whether a run whose case has `sections` has it. A mix of n wheels has n sections `wheel`.
    pub fn is_there(&self, sections: &[&str]) -> bool {
        let Some(section) = self.section else { return true };
        let count = sections.iter().filter(|there| **there == section).count();
        let number = self.name.strip_prefix(OF_WHEEL).and_then(|number| number.parse().ok());
        count >= number.unwrap_or(1)
    }
}

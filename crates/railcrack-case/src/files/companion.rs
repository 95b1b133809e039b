//! Files beside a stored case.

use crate::schema::{Kind, Row};

/// A file that belongs beside the text of [`Case::to_toml`](crate::Case::to_toml), under the name
/// by which that text calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Companion<'a> {
    /// Its name, relative to the folder of the case file, with `/`.
    pub name: &'static str,
    /// Its content.
    pub text: &'a str,
}

/// Help where a file cannot be found.
pub(super) const RELATIVE: &str = "file names are relative to the folder of the case file";

/// The name of the file of a key beside a stored case.
pub(super) fn kept_as(row: Row<String>) -> &'static str {
    match row.key.kind {
        Kind::Path { kept_as } => kept_as,
        _ => row.key.name,
    }
}

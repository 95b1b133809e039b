//! Names that files of results hold: they never point outside the folder of these files.

use super::files::{CASE_FILE, INPUTS_FOLDER};
use crate::error::OutputError;
use railcrack_case::{FileKey, file_keys};
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Checks a name that `file` holds: one plain name, of a file or folder directly in its place.
///
/// Errors: any other.
pub(crate) fn check_stored_name(file: &Path, name: &str) -> Result<(), OutputError> {
    if is_plain(name) { Ok(()) } else { Err(leaves(file, name)) }
}

/// Checks the files that the `case.toml` of a run folder names: each is `inputs/` and a plain name.
///
/// Errors: any other. A text that is not TOML has no names; its reader says so.
pub(crate) fn check_inputs(folder: &Path, case: &str) -> Result<(), OutputError> {
    let Ok(case) = DeTable::parse(case) else { return Ok(()) };
    StoredCase { folder, keys: file_keys() }.check_table("", case.get_ref())
}

/// A stored case whose names are checked.
struct StoredCase<'a> {
    folder: &'a Path,
    /// The keys that name a file.
    keys: Vec<FileKey>,
}

impl StoredCase<'_> {
    fn check_table(&self, section: &str, table: &DeTable) -> Result<(), OutputError> {
        table.iter().try_for_each(|(key, value)| self.check_value([section, key.get_ref()], value.get_ref()))
    }

    /// Checks the value of a key in a section; in lists of tables, such as those of wheels, there
    /// are sections too.
    fn check_value(&self, [section, key]: [&str; 2], value: &DeValue) -> Result<(), OutputError> {
        match value {
            DeValue::Table(table) => self.check_table(key, table),
            DeValue::Array(values) => {
                values.iter().try_for_each(|value| self.check_value([section, key], value.get_ref()))
            }
            DeValue::String(name) if self.names_a_file(section, key) => {
                let within = name.strip_prefix(INPUTS_FOLDER).and_then(|name| name.strip_prefix('/'));
                let is_within = within.is_some_and(is_plain);
                if is_within { Ok(()) } else { Err(leaves(&self.folder.join(CASE_FILE), name)) }
            }
            _ => Ok(()),
        }
    }

    fn names_a_file(&self, section: &str, key: &str) -> bool {
        self.keys.iter().any(|of| of.section == section && of.key == key)
    }
}

/// Whether `name` is a single component on every system, and neither this folder nor the one above.
pub(super) fn is_plain(name: &str) -> bool {
    let separates = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    !matches!(name, "" | "." | "..") && !name.contains(separates)
}

fn leaves(file: &Path, name: &str) -> OutputError {
    OutputError::NameLeaves { file: file.to_path_buf(), name: name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stored_name_stays_in_its_folder() {
        let file = Path::new("study/study.json");
        for good in ["001-friction-0.1-angle_deg-20", "a", "..a", "inputs"] {
            check_stored_name(file, good).unwrap();
        }
        for bad in ["", ".", "..", "../../victim", "/etc", "a/b", "a\\b", "C:", "a\0", "a/", "\u{1b}[2J"] {
            let error = check_stored_name(file, bad).unwrap_err().to_string();
            assert!(error.starts_with("study/study.json names"), "{error}");
            assert!(error.contains(&format!("{bad:?}")), "{error}");
        }
    }

    #[test]
    fn a_stored_case_names_inputs_only() {
        let of =
            |name: &str| check_inputs(Path::new("run"), &format!("[residual_stress]\nprofile = {name:?}\n"));
        of("inputs/residual-stress.csv").unwrap();
        for bad in ["../x.csv", "x.csv", "inputs/../../x.csv", "/x.csv", "inputs/", "inputs"] {
            assert!(of(bad).is_err(), "{bad}");
        }
        let of = |text: &str| check_inputs(Path::new("run"), text);
        for good in
            ["[fluid]\nprofile = \"linear\"", "[[wheel]]\ncontact = { profile = \"inputs/contact-table\" }"]
        {
            of(good).unwrap();
        }
        for bad in [
            "[contact]\nprofile = \"../x.csv\"",
            "[fracture]\nprofile = \"../x.csv\"",
            "[growth]\ntable_profile = \"../x.csv\"",
            "[[wheel]]\n[[wheel]]\ncontact = { profile = \"../x.csv\" }",
            "[[wheel]]\n[wheel.contact]\nprofile = \"/x.csv\"",
            "[inspection]\npod = \"../x.csv\"",
        ] {
            assert!(of(bad).is_err(), "{bad}");
        }
    }
}

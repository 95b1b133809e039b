//! Names that files of results hold: they never point outside the folder of these files.

use super::files::{CASE_FILE, INPUTS_FOLDER};
use crate::error::OutputError;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The keys of `case.toml` that name a file.
const FILE_KEYS: [(&str, &str); 4] = [
    ("residual_stress", "profile"),
    ("plastic_stress", "field"),
    ("plastic_stress", "profile"),
    ("shakedown", "initial_residual"),
];

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
    for (section, key) in FILE_KEYS {
        let Some(DeValue::Table(section)) = case.get_ref().get(section).map(Spanned::get_ref) else {
            continue;
        };
        let Some(DeValue::String(name)) = section.get(key).map(Spanned::get_ref) else { continue };
        let within = name.strip_prefix(INPUTS_FOLDER).and_then(|name| name.strip_prefix('/'));
        if !within.is_some_and(is_plain) {
            return Err(leaves(&folder.join(CASE_FILE), name));
        }
    }
    Ok(())
}

/// Whether `name` is a single component on every system, and neither this folder nor the one above.
fn is_plain(name: &str) -> bool {
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
    }
}

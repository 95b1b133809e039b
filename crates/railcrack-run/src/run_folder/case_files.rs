//! The case of a run as files, and whether two runs have the same.

use crate::disk::files::{CASE_FILE, FIELDS_FILE, WHEEL_GROUPS_FILE, input_files};
use crate::disk::{Checksum, checksums, read_if_there};
use crate::error::OutputError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// The text of `case.toml` and the files that it names.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct CaseFiles {
    /// The case, defaults filled in.
    pub toml: String,
    /// Name in the run folder (`inputs/residual-stress.csv`) and text of each file that the case
    /// names.
    pub companions: Vec<(String, String)>,
    /// The groups of the wheels of its table, as the run made them: no part of the case, and the
    /// same for everything that reads the run.
    pub wheel_groups: Option<String>,
}

impl CaseFiles {
    /// The case of the run in `folder`; none where no `case.toml` stands there.
    ///
    /// Errors: a file is not text; the system refuses.
    pub(crate) fn stored(folder: &Path) -> Result<Option<Self>, OutputError> {
        let text = |file: &str| {
            let path = folder.join(file);
            let text = read_if_there(&path)?.map(String::from_utf8).transpose();
            text.map_err(|_| OutputError::damaged(&path, "is not UTF-8 text"))
        };
        let Some(toml) = text(CASE_FILE)? else { return Ok(None) };
        let mut companions = Vec::new();
        for name in input_files() {
            companions.extend(text(name)?.map(|text| (name.to_owned(), text)));
        }
        Ok(Some(Self { toml, companions, wheel_groups: text(WHEEL_GROUPS_FILE)? }))
    }

    /// The case among the `files` of a packed run.
    pub(crate) fn packed(files: &BTreeMap<String, String>) -> Self {
        let text = |name: &str| files.get(name).cloned();
        Self {
            toml: text(CASE_FILE).unwrap_or_default(),
            companions: input_files().filter_map(|name| Some((name.to_owned(), text(name)?))).collect(),
            wheel_groups: text(WHEEL_GROUPS_FILE),
        }
    }

    /// The checksum of the case and of the files that it names, in any order, without the groups of
    /// wheels.
    pub(crate) fn checksum(&self) -> Checksum {
        let mut companions: Vec<_> = self.companions.iter().collect();
        companions.sort();
        let texts = companions.into_iter().flat_map(|(name, text)| [name, text]);
        // Between texts, a byte that none of them has.
        let parts = texts.flat_map(|text| [&[0], text.as_bytes()]);
        Checksum::of_parts(std::iter::once(self.toml.as_bytes()).chain(parts))
    }
}

/// Checksums of the case in `folder`, of the files that it names, and of the list of fields.
///
/// Errors: the system refuses.
pub(crate) fn case_checksums(folder: &Path) -> Result<BTreeMap<String, String>, OutputError> {
    let all = [CASE_FILE, FIELDS_FILE, WHEEL_GROUPS_FILE].into_iter().chain(input_files());
    checksums(folder, all.filter(|file| folder.join(file).is_file()))
}

/// Whether the case `stored` of the run in `folder` is `given`.
///
/// Errors: it differs.
pub(crate) fn same_case(folder: &Path, stored: &CaseFiles, given: &CaseFiles) -> Result<(), OutputError> {
    same_text(folder, CASE_FILE, &stored.toml, &given.toml)?;
    for (name, text) in &given.companions {
        let before = stored.companions.iter().find(|companion| companion.0 == *name);
        same_text(folder, name, before.map_or("", |companion| companion.1.as_str()), text)?;
    }
    match (&stored.wheel_groups, &given.wheel_groups) {
        (Some(stored), Some(given)) => same_text(folder, WHEEL_GROUPS_FILE, stored, given),
        _ => Ok(()),
    }
}

/// Whether the case `given` has more growth steps than the one `stored` of the run in `folder`, and
/// is the same otherwise.
///
/// Errors: it differs in something else, or has fewer steps.
pub(crate) fn has_more_steps(
    folder: &Path,
    stored: &CaseFiles,
    given: &CaseFiles,
) -> Result<bool, OutputError> {
    let steps = steps_of(&stored.toml).zip(steps_of(&given.toml));
    let longer = steps.filter(|((_, before), (_, after))| after > before);
    match longer {
        Some(((stored_rest, _), (given_rest, _))) if stored_rest == given_rest => {
            let same = CaseFiles { toml: given.toml.clone(), ..stored.clone() };
            same_case(folder, &same, given).map(|()| true)
        }
        _ => same_case(folder, stored, given).map(|()| false),
    }
}

/// The text of a stored case without its number of growth steps, and that number.
fn steps_of(toml: &str) -> Option<(String, u64)> {
    let (before, growth) = toml.split_once("\n[growth]\nsteps = ")?;
    let (steps, after) = growth.split_once('\n')?;
    Some((format!("{before}\n{after}"), steps.parse().ok()?))
}

/// The same for one file.
pub(crate) fn same_text(folder: &Path, file: &str, stored: &str, given: &str) -> Result<(), OutputError> {
    if stored == given {
        return Ok(());
    }
    let line_of = |text: &str, line: usize| text.lines().nth(line).unwrap_or("").trim().to_owned();
    let lines = stored.lines().count().max(given.lines().count());
    let line = (0..lines).find(|&line| line_of(stored, line) != line_of(given, line)).unwrap_or(0);
    Err(OutputError::CaseChanged {
        folder: folder.to_path_buf(),
        file: file.to_owned(),
        line: line + 1,
        stored: line_of(stored, line),
        given: line_of(given, line),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_may_have_more_steps() {
        let case = |steps: usize, friction: f64| CaseFiles {
            toml: format!(
                "title = \"a\"\n\n[growth]\nsteps = {steps}\nlaw = \"paris\"\n\n[x]\nfriction = {friction}\n"
            ),
            ..CaseFiles::default()
        };
        let more = |given: &CaseFiles| has_more_steps(Path::new("run"), &case(5, 0.3), given);
        assert!(more(&case(9, 0.3)).unwrap() && !more(&case(5, 0.3)).unwrap());
        assert!(more(&case(4, 0.3)).is_err() && more(&case(9, 0.2)).is_err());
        let other = CaseFiles { companions: vec![("inputs/a.csv".into(), "1".into())], ..case(9, 0.3) };
        assert!(more(&other).is_err());
    }
}

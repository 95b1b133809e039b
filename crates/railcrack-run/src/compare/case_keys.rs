//! Differences of two cases, key by key.

use crate::disk::files::CASE_FILE;
use crate::error::OutputError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key of the case file with different values, each as it is written; none where the key is
/// missing.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CaseDifference {
    /// The key with its sections: `contact.friction`, `crack[1].mouth_mm` (cracks from 1).
    pub key: String,
    /// Value in the case of each run.
    pub values: [Option<String>; 2],
}

/// The keys that differ between the cases of two runs: text of `case.toml`, and folder.
pub(super) fn case_differences(cases: [(&str, &Path); 2]) -> Result<Vec<CaseDifference>, OutputError> {
    let [first, second] = cases.map(|(text, folder)| keys(text, folder));
    let (first, second) = (first?, second?);
    let mut names: Vec<&String> = first.keys().chain(second.keys()).collect();
    names.sort();
    names.dedup();
    let differs = names.into_iter().filter(|name| first.get(*name) != second.get(*name));
    let difference = |key: &String| CaseDifference {
        key: key.clone(),
        values: [first.get(key).cloned(), second.get(key).cloned()],
    };
    Ok(differs.map(difference).collect())
}

/// The keys of a case with their values as written: `contact.friction`, `crack[1].mouth_mm` (cracks
/// from 1).
pub fn keys(text: &str, folder: &Path) -> Result<BTreeMap<String, String>, OutputError> {
    let table = DeTable::parse(text)
        .map_err(|reason| OutputError::damaged(&folder.join(CASE_FILE), reason.message().to_owned()))?;
    let mut keys = BTreeMap::new();
    add_table(text, "", table.get_ref(), &mut keys);
    Ok(keys)
}

fn add_table(text: &str, path: &str, table: &DeTable, keys: &mut BTreeMap<String, String>) {
    for (name, value) in table {
        let name = name.get_ref();
        let path = if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
        add_value(text, path, value, keys);
    }
}

fn add_value(text: &str, path: String, value: &Spanned<DeValue>, keys: &mut BTreeMap<String, String>) {
    match value.get_ref() {
        DeValue::Table(table) => add_table(text, &path, table, keys),
        DeValue::Array(items) if items.iter().any(|item| matches!(item.get_ref(), DeValue::Table(_))) => {
            for (i, item) in items.iter().enumerate() {
                add_value(text, format!("{path}[{}]", i + 1), item, keys);
            }
        }
        _ => {
            let written = text.get(value.span()).unwrap_or_default();
            keys.insert(path, written.to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_with_their_sections() {
        let first = "title = \"a\"\n[contact]\nfriction = 0.3\n[[crack]]\nx = [1, 2]\n[[crack]]\nx = 2\n";
        let second =
            "title = \"a\"\n[contact]\nfriction = 0.30\n[[crack]]\nx = [1, 3]\ny = 0\n[[crack]]\nx = 2\n";
        let folder = Path::new("run");
        let found = case_differences([(first, folder), (second, folder)]).unwrap();
        let found: Vec<_> =
            found.iter().map(|d| (d.key.as_str(), d.values[0].as_deref(), d.values[1].as_deref())).collect();
        assert_eq!(
            found,
            [
                ("contact.friction", Some("0.3"), Some("0.30")),
                ("crack[1].x", Some("[1, 2]"), Some("[1, 3]")),
                ("crack[1].y", None, Some("0")),
            ]
        );
        let broken = case_differences([("a = ", folder), (second, folder)]).unwrap_err().to_string();
        assert!(broken.contains("run/case.toml"), "{broken}");
    }
}

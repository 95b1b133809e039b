//! Names in the glossary against the sources: every one is declared somewhere.

use super::{CRATE, rust_files, workspace};
use std::collections::BTreeSet;
use std::path::Path;

/// The names in the column *in code* of a glossary page: each part of a path for itself.
fn names(page: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut column = None;
    for line in page.lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        column = match cells.iter().position(|cell| *cell == "in code") {
            Some(found) => Some(found),
            None if !line.starts_with('|') => None,
            None => column,
        };
        let code = column.and_then(|column| cells.get(column)).copied().unwrap_or("");
        // Every second piece stands between backquotes.
        for name in code.split('`').skip(1).step_by(2) {
            names.extend(name.split("::").map(str::to_owned));
        }
    }
    names
}

/// The words that some sources declare, as items, fields, variants or parameters.
fn declared(sources: &[String]) -> BTreeSet<&str> {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut declared = BTreeSet::new();
    for text in sources {
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            let words: Vec<&str> = line.split(|c| !is_part(c)).filter(|word| !word.is_empty()).collect();
            for pair in words.windows(2) {
                if ["struct", "enum", "trait", "fn", "mod", "const", "type", "let"].contains(&pair[0]) {
                    declared.insert(pair[1]);
                }
            }
            // A field, a parameter or a variant stands first, alone or before a mark.
            let first = words.iter().find(|word| !["pub", "crate", "super", "in"].contains(word));
            declared.extend(first.filter(|word| {
                let behind = line.split_once(**word).map_or("", |(_, rest)| rest);
                behind.starts_with([':', ',', '(', ' '])
            }));
        }
    }
    declared
}

#[test]
fn every_name_in_the_glossary_is_declared() {
    let page = std::fs::read_to_string(workspace().join("docs/glossary.md")).unwrap();
    let crates = Path::new(CRATE).join("..");
    let files = rust_files(&crates).into_iter().filter(|path| path.iter().any(|part| part == "src"));
    let sources: Vec<String> = files.map(|path| std::fs::read_to_string(path).unwrap()).collect();
    let declared = declared(&sources);
    let names = names(&page);
    assert!(names.len() > 50, "{names:?}");
    let missing: Vec<&String> = names.iter().filter(|name| !declared.contains(name.as_str())).collect();
    assert!(missing.is_empty(), "names in docs/glossary.md that no source declares: {missing:?}");
}

#[test]
fn undeclared_names_are_found() {
    let sources =
        ["pub struct Kink {\n    /// mislaid: 1\n    pub angle: f64,\n}\nfn f(x: u8) {}".to_owned()];
    let found = declared(&sources);
    assert!(["Kink", "angle", "f"].iter().all(|name| found.contains(name)), "{found:?}");
    assert!(!found.contains("mislaid") && !found.contains("f64"), "{found:?}");
    let page =
        "| term | in code | in files |\n|---|---|---|\n| kink | `Kink::angle`, module `fatigue` | `k` |\n";
    assert_eq!(names(page).into_iter().collect::<Vec<_>>(), ["Kink", "angle", "fatigue"]);
}

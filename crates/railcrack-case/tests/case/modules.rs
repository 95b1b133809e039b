//! Imports between the parts of the crate.

use railcrack_case::{SECTIONS, STUDY};
use std::path::{Path, PathBuf};

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// Lines of a part of the crate, with their places.
fn lines_of(part: &str) -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(part);
    let mut lines = Vec::new();
    for path in files(&folder) {
        let text = std::fs::read_to_string(&path).unwrap();
        let place = |i: usize| format!("{}:{}", path.display(), i + 1);
        lines.extend(text.lines().enumerate().map(|(i, line)| (place(i), line.to_owned())));
    }
    assert!(lines.len() > 20, "{part}");
    lines
}

#[test]
fn each_part_imports_only_those_before_it() {
    let parts = ["schema", "files", "tables", "case", "study"];
    for (place, part) in parts.iter().enumerate() {
        for (at, line) in lines_of(part) {
            for later in &parts[place + 1..] {
                assert!(!line.contains(&format!("crate::{later}")), "{at}: {part} imports {later}: {line}");
            }
            let leaves_schema =
                line.contains("super::super") || line.replace("railcrack::words", "").contains("railcrack");
            assert!(
                *part != "schema" || !leaves_schema,
                "{at}: schema imports or names something else: {line}"
            );
        }
    }
}

#[test]
fn the_schema_knows_no_rails() {
    let sections = SECTIONS.iter().chain([&STUDY]);
    let keys = sections.clone().flat_map(|section| section.keys.iter().map(|key| key.name));
    let names: Vec<&str> = keys.filter(|name| name.contains('_')).collect();
    let words = ["rail", "wheel", "crack", "half-plane", "block", "passage", "stress", "growth", "support"];
    let tests = ["tests.rs", "suggest.rs"];
    for (at, line) in lines_of("schema").iter().filter(|(at, _)| !tests.iter().any(|file| at.contains(file)))
    {
        let line = line.to_lowercase().replace("railcrack::words", "");
        for name in names.iter().chain(&words) {
            assert!(!line.contains(name), "{at}: names `{name}`: {line}");
        }
    }
}

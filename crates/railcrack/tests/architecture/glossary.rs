//! The glossary against the sources, in both directions: every name in it is declared somewhere,
//! and the types, columns and sections that a reader meets are in it.

use super::source::SourceFile;
use super::{CRATE, library, rust_files, workspace};
use std::collections::BTreeSet;
use std::path::Path;

/// Modules whose public types are terms of the field.
const MODULES_OF_TERMS: [&str; 5] = ["contact", "fatigue", "growth", "plane", "space"];

/// Public types of these modules that are not terms, and why.
const NOT_TERMS: [(&str, &str); 17] = [
    ("CloseCracks", "content of an error"),
    ("NotConverged", "an error"),
    ("BodyReport", "size and cost of a body, columns of a summary"),
    ("CheckValue", "part of the declaration of a law"),
    ("Constant", "part of the declaration of a law"),
    ("CracksInSpace", "the cracks of a step with their body"),
    ("PlaneSite", "part of the loop of growth"),
    ("SpaceSite", "part of the loop of growth"),
    ("FaceRecord", "rows of faces.csv, whose columns are in the glossary"),
    ("KnownEnds", "what a rail keeps from step to step"),
    ("LawConstants", "part of the declaration of a law"),
    ("LawInput", "part of the declaration of a law"),
    ("OwnRange", "part of the declaration of a law"),
    ("PlaneBody", "the cracks of a step with their body"),
    ("StepReport", "counts of a solver"),
    ("StepStart", "step number and load cycles"),
    ("StepSolver", "state of a contact solver on one body"),
];

/// Tables of a run whose columns are in the glossary: headings of docs/file-formats.md.
const TABLES_OF_TERMS: [&str; 4] = ["sif.csv", "growth.csv", "faces.csv", "residual.csv"];

/// The names in the column *in code* of a glossary page, the parts of a path separately.
fn names(page: &str) -> BTreeSet<String> {
    let quoted = quoted(page, "in code");
    quoted.iter().flat_map(|name| name.split("::")).map(str::to_owned).collect()
}

/// The quoted texts in one column of the tables of a page.
fn quoted(page: &str, heading: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut column = None;
    for line in page.lines() {
        // A bar in a formula, `\|`, does not end a cell.
        let line = line.replace("\\|", "");
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        column = match cells.iter().position(|cell| *cell == heading) {
            Some(found) => Some(found),
            None if !line.starts_with('|') => None,
            None => column,
        };
        let cell = column.and_then(|column| cells.get(column)).copied().unwrap_or("");
        found.extend(quoted_in(cell).map(str::to_owned));
    }
    found
}

/// The texts between backquotes.
fn quoted_in(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
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
    let page = std::fs::read_to_string(workspace().join("docs/dev/glossary.md")).unwrap();
    let crates = Path::new(CRATE).join("..");
    let files = rust_files(&crates).into_iter().filter(|path| path.iter().any(|part| part == "src"));
    let sources: Vec<String> = files.map(|path| std::fs::read_to_string(path).unwrap()).collect();
    let declared = declared(&sources);
    let names = names(&page);
    assert!(names.len() > 50, "{names:?}");
    let missing: Vec<&String> = names.iter().filter(|name| !declared.contains(name.as_str())).collect();
    assert!(missing.is_empty(), "names in docs/dev/glossary.md that no source declares: {missing:?}");
}

/// The public structs, enums and traits of a source.
fn public_types(source: &SourceFile) -> Vec<String> {
    let kinds = ["struct", "enum", "trait"];
    let is_type = |words: &&[super::source::Token]| {
        words[0].text == "pub" && kinds.contains(&words[1].text.as_str()) && words[0].inside.is_empty()
    };
    source.tokens().windows(3).filter(is_type).map(|words| words[2].text.clone()).collect()
}

/// The public types of some sources that a glossary page lacks. Errors explain themselves by their
/// messages.
fn missing_types(page: &str, sources: &[SourceFile]) -> Vec<String> {
    let names = names(page);
    let types = sources.iter().filter(|file| MODULES_OF_TERMS.contains(&file.module()));
    let is_missing = |name: &String| {
        !name.ends_with("Error")
            && !names.contains(name)
            && !NOT_TERMS.iter().any(|(excepted, _)| excepted == name)
    };
    types.flat_map(public_types).filter(is_missing).collect()
}

#[test]
fn public_types_of_the_mechanics_are_in_the_glossary() {
    let page = std::fs::read_to_string(workspace().join("docs/dev/glossary.md")).unwrap();
    let missing = missing_types(&page, &library());
    assert!(missing.is_empty(), "not in docs/dev/glossary.md, nor among the exceptions: {missing:?}");
}

#[test]
fn exceptions_of_the_glossary_are_needed() {
    let page = std::fs::read_to_string(workspace().join("docs/dev/glossary.md")).unwrap();
    let names = names(&page);
    let types: BTreeSet<String> = library().iter().flat_map(public_types).collect();
    for (excepted, reason) in NOT_TERMS {
        assert!(types.contains(excepted), "{excepted} ({reason}) is not a public type");
        assert!(!names.contains(excepted), "{excepted} ({reason}) is in the glossary");
    }
}

/// The columns of the tables of a run, by the page on its files, which a test of the command holds
/// to their declaration.
fn columns(page: &str) -> BTreeSet<String> {
    let mut columns = BTreeSet::new();
    for table in TABLES_OF_TERMS {
        let (_, section) = page.split_once(&format!("\n## `{table}`\n")).expect(table);
        let section = section.split("\n## ").next().unwrap();
        columns.extend(quoted(section, "column"));
    }
    columns
}

/// The sections of a case, by the page on its keys, which a test of the case holds to their
/// declaration.
fn sections(page: &str) -> BTreeSet<String> {
    page.lines()
        .filter_map(|line| line.strip_prefix("## `["))
        .map(|rest| format!("[{}", &rest[..rest.len() - 1]))
        .collect()
}

#[test]
fn columns_and_sections_are_in_the_glossary() {
    let docs = workspace().join("docs");
    let page = |name: &str| std::fs::read_to_string(docs.join(name)).unwrap();
    let (columns, sections) = (columns(&page("file-formats.md")), sections(&page("case-file.md")));
    assert!(columns.len() > 40 && sections.len() > 15, "{columns:?} {sections:?}");
    let quoted = quoted(&page("glossary.md"), "in files");
    // A section stands alone, or before one of its keys.
    let has = |name: &String| quoted.iter().any(|text| text.split(' ').next() == Some(name));
    let missing: Vec<String> = columns.into_iter().chain(sections).filter(|name| !has(name)).collect();
    assert!(missing.is_empty(), "not in the column *in files* of docs/glossary.md: {missing:?}");
}

#[test]
fn missing_terms_are_found() {
    let source = |path: &str| {
        SourceFile::read(Path::new(path), "pub struct Kink;\npub(crate) enum Step {}\npub enum KinkError {}")
    };
    let page = "| term | in code |\n|---|---|\n| a | `Other` |\n";
    assert_eq!(missing_types(page, &[source("fatigue/kink.rs"), source("mesh/kink.rs")]), ["Kink"]);
    assert!(missing_types(&page.replace("Other", "Kink::angle"), &[source("fatigue/kink.rs")]).is_empty());
    let page = "\n## `sif.csv`\n\n| column | meaning |\n|---|---|\n| `a`, `b` | `c` |\n";
    let others = "\n## `growth.csv`\n\n## `faces.csv`\n\n## `residual.csv`\n\n## `fields/`\n";
    let columns = columns(&format!("{page}{others}"));
    assert_eq!(columns.into_iter().collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(
        sections("## At the top\n## `[rail]`\n## `[[crack]]`\n").into_iter().collect::<Vec<_>>(),
        ["[[crack]]", "[rail]"]
    );
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

//! Who imports whom: the sources against the tables of ARCHITECTURE.md.

mod circles;
mod rules;
mod source;

use rules::{Rules, Stage};
use source::SourceFile;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const CRATE: &str = env!("CARGO_MANIFEST_DIR");

fn workspace() -> PathBuf {
    Path::new(CRATE).join("../..")
}

fn rules() -> Rules {
    let text = std::fs::read_to_string(workspace().join("ARCHITECTURE.md")).unwrap();
    Rules::parse(&text)
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The sources of the library, without its root.
fn library() -> Vec<SourceFile> {
    sources(&Path::new(CRATE).join("src"))
}

/// The sources below `root`, without the root of the crate.
fn sources(root: &Path) -> Vec<SourceFile> {
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        SourceFile::read(path.strip_prefix(root).unwrap(), &text)
    };
    rust_files(root).into_iter().filter(|path| *path != root.join("lib.rs")).map(read).collect()
}

fn assert_none(violations: &[String]) {
    assert!(violations.is_empty(), "{} violations:\n{}", violations.len(), violations.join("\n"));
}

#[test]
fn modules_import_only_what_the_table_allows() {
    let rules = rules();
    let mut violations = Vec::new();
    for file in library() {
        let module = file.module();
        for import in file.imports.iter().filter(|import| import.module != module) {
            if !rules.allows(module, &import.module) {
                let (path, line) = (file.path.display(), import.line);
                violations.push(format!("{path}:{line}: {module} imports {}", import.module));
            }
        }
    }
    assert_none(&violations);
}

/// Crates without circles between their files.
const WITHOUT_CIRCLES: [&str; 1] = ["crates/railcrack"];
/// Modules of which this is not asked.
const OUTSIDE_THE_MECHANICS: [&str; 3] = ["case", "output", "paper"];

#[test]
fn no_files_import_one_another() {
    let mut violations = Vec::new();
    for folder in WITHOUT_CIRCLES {
        let mut files = sources(&workspace().join(folder).join("src"));
        files.retain(|file| !OUTSIDE_THE_MECHANICS.contains(&file.module()));
        for group in circles::circles(&files) {
            violations.push(format!("{folder}: {group:?}"));
        }
    }
    assert_none(&violations);
}

#[test]
fn the_table_lists_every_module_once() {
    let rules = rules();
    let there: BTreeSet<String> = library().iter().map(|file| file.module().to_owned()).collect();
    assert_eq!(
        rules.modules(Stage::Present),
        there,
        "rows of the table without `planned`, and folders of src"
    );
    let planned = rules.modules(Stage::Planned);
    assert!(planned.is_disjoint(&there), "planned and there: {planned:?}");
}

#[test]
fn the_table_keeps_its_own_promises() {
    let rules = rules();
    assert_none(&rules.circles());
    assert_none(&rules.broken_promises());
}

#[test]
fn only_linear_names_the_linear_algebra_crate() {
    let mut violations: Vec<String> = library()
        .iter()
        .filter(|file| file.module() != "linear")
        .flat_map(|file| file.lines_naming("faer"))
        .collect();
    for folder in ["crates/railcrack/tests", "crates/railcrack/benches", "crates/railcrack-cli"] {
        for path in rust_files(&workspace().join(folder)) {
            let file = SourceFile::read(&path, &std::fs::read_to_string(&path).unwrap());
            violations.extend(file.lines_naming("faer"));
        }
    }
    let command = std::fs::read_to_string(workspace().join("crates/railcrack-cli/Cargo.toml")).unwrap();
    assert!(!command.contains("faer"), "the command depends on the linear-algebra crate");
    assert_none(&violations);
}

#[test]
fn the_library_prints_nothing() {
    let violations: Vec<String> = library().iter().flat_map(SourceFile::printing_lines).collect();
    assert_none(&violations);
}

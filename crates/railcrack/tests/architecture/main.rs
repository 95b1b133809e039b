//! Who imports whom: the sources against the tables of ARCHITECTURE.md.

mod circles;
mod glossary;
mod layers;
mod prose;
mod python;
mod rules;
mod source;

use layers::{Arrow, Layers};
use python::PythonFile;
use rules::{Rules, Stage};
use source::SourceFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

const CRATE: &str = env!("CARGO_MANIFEST_DIR");

/// The sources of the Python package, with a row in the table of layers.
const PYTHON_PACKAGE: &str = "python/railcrack";

fn workspace() -> PathBuf {
    Path::new(CRATE).join("../..")
}

fn rules() -> Rules {
    let text = std::fs::read_to_string(workspace().join("ARCHITECTURE.md")).unwrap();
    Rules::parse(&text)
}

fn layers() -> BTreeMap<String, Layers> {
    Layers::of_crates(&std::fs::read_to_string(workspace().join("ARCHITECTURE.md")).unwrap())
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
    let is_root = |path: &PathBuf| *path == root.join("lib.rs") || *path == root.join("main.rs");
    rust_files(root).into_iter().filter(|path| !is_root(path)).map(read).collect()
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

#[test]
fn modules_import_only_those_in_lower_layers() {
    let layers = layers();
    let mut violations = Vec::new();
    for (name, path) in crates().into_iter().filter(|(name, _)| name != "railcrack") {
        let Some(layers) = layers.get(&name) else {
            violations.push(format!("{name} has no row"));
            continue;
        };
        let files = sources(&path.join("src"));
        let there = files.iter().map(|file| file.module().to_owned()).collect();
        let faults = layers.differences(&there).into_iter().chain(layers.faults(layers::arrows(&files)));
        violations.extend(faults.map(|fault| format!("{name}: {fault}")));
    }
    assert_none(&violations);
}

#[test]
fn the_python_package_has_layers_too() {
    let layers = &layers()[PYTHON_PACKAGE];
    let mut files = Vec::new();
    for entry in std::fs::read_dir(workspace().join(PYTHON_PACKAGE)).unwrap() {
        let path = entry.unwrap().path();
        let is_face = path.file_stem().is_some_and(|stem| stem == "__init__");
        if path.extension().is_some_and(|ending| ending == "py") && !is_face {
            files.push(PythonFile::read(&path, &std::fs::read_to_string(&path).unwrap()));
        }
    }
    let arrows = files.iter().flat_map(|PythonFile { module, imports }| {
        imports.iter().map(move |(imported, line)| Arrow {
            place: format!("{module}.py:{line}"),
            module,
            imported,
        })
    });
    let mut violations = layers.differences(&files.iter().map(|file| file.module.clone()).collect());
    violations.extend(layers.faults(arrows));
    assert_none(&violations);
}

#[test]
fn neither_files_nor_folders_import_one_another() {
    let mut violations = Vec::new();
    for (name, path) in crates() {
        let groups = circles::circles(&sources(&path.join("src")));
        violations.extend(groups.iter().map(|group| format!("{name}: {group:?}")));
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

/// The crates of the workspace, by name.
fn crates() -> Vec<(String, PathBuf)> {
    let mut crates: Vec<(String, PathBuf)> = std::fs::read_dir(workspace().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.join("Cargo.toml").is_file())
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), path))
        .collect();
    crates.sort();
    crates
}

fn sources_of(path: &Path) -> Vec<SourceFile> {
    let read = |file: PathBuf| {
        let text = std::fs::read_to_string(&file).unwrap();
        SourceFile::read(file.strip_prefix(workspace().join("crates")).unwrap(), &text)
    };
    rust_files(path).into_iter().map(read).collect()
}

#[test]
fn crates_depend_only_on_what_the_table_allows() {
    let text = std::fs::read_to_string(workspace().join("ARCHITECTURE.md")).unwrap();
    let allowed = rules::crates(&text);
    let mut violations = Vec::new();
    for (name, path) in crates() {
        let Some(may) = allowed.get(&name) else {
            violations.push(format!("{name} has no row"));
            continue;
        };
        let manifest = std::fs::read_to_string(path.join("Cargo.toml")).unwrap();
        let dependencies = rules::dependencies(&manifest);
        let ours = dependencies.iter().filter(|name| name.starts_with("railcrack"));
        violations.extend(ours.filter(|on| !may.contains(*on)).map(|on| format!("{name} depends on {on}")));
    }
    assert_none(&violations);
}

#[test]
fn only_linear_names_the_linear_algebra_crate() {
    let mut violations: Vec<String> = Vec::new();
    for (name, path) in crates() {
        let is_linear = |file: &SourceFile| file.path.starts_with("railcrack/src/linear");
        let files = sources_of(&path).into_iter().filter(|file| !is_linear(file));
        violations.extend(files.flat_map(|file| file.lines_naming("faer")));
        let manifest = std::fs::read_to_string(path.join("Cargo.toml")).unwrap();
        if name != "railcrack" && rules::dependencies(&manifest).contains("faer") {
            violations.push(format!("{name} depends on the linear-algebra crate"));
        }
    }
    assert_none(&violations);
}

#[test]
fn the_mechanics_has_no_files() {
    let names = ["fs", "File", "Path", "PathBuf", "include_str", "include_bytes"];
    let naming =
        |file: &SourceFile| names.iter().flat_map(|name| file.lines_naming(name)).collect::<Vec<_>>();
    assert_none(&library().iter().flat_map(naming).collect::<Vec<_>>());
}

/// A crate that is packed by itself has no other files. Links within its folder lead to data that
/// are shared with the book.
#[test]
fn what_a_crate_includes_is_in_its_folder() {
    let mut violations: Vec<String> = Vec::new();
    for (name, path) in crates() {
        for file in rust_files(&path.join("src")) {
            let inner = file.strip_prefix(&path).unwrap();
            if inner.file_stem().is_some_and(|stem| stem.to_string_lossy().ends_with("tests")) {
                continue;
            }
            let text = std::fs::read_to_string(&file).unwrap();
            let own = text.split("#[cfg(test)]").next().unwrap();
            let folders = inner.components().count() - 1;
            let included = own.split("include_").skip(1).filter_map(|rest| rest.split('"').nth(1));
            let outside = included.filter(|included| included.matches("../").count() > folders);
            violations
                .extend(outside.map(|included| format!("{name}/{} includes {included}", inner.display())));
        }
    }
    assert_none(&violations);
}

#[test]
fn only_the_command_prints() {
    let of_crate = |(name, path): (String, PathBuf)| {
        let sources = if name == "railcrack-cli" { Vec::new() } else { sources_of(&path.join("src")) };
        sources.iter().flat_map(SourceFile::printing_lines).collect::<Vec<_>>()
    };
    assert_none(&crates().into_iter().flat_map(of_crate).collect::<Vec<_>>());
}

/// The pages and sources below a path, or the one that it is.
fn texts(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path.to_path_buf()];
    }
    let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    let is_text = |path: &PathBuf| {
        path.is_dir() || path.extension().is_some_and(|ending| ending == "md" || ending == "rs")
    };
    let mut found: Vec<PathBuf> = entries.filter(is_text).flat_map(|path| texts(&path)).collect();
    found.sort();
    found
}

#[test]
fn prose_is_free_of_crutches() {
    let mut faults = Vec::new();
    for path in prose::PLAIN.iter().flat_map(|path| texts(&workspace().join(path))) {
        faults.extend(prose::crutches(&path, &std::fs::read_to_string(&path).unwrap()));
    }
    assert_none(&faults);
}

#[test]
fn prose_is_narrow_and_doc_comments_name_their_subject() {
    let mut faults = Vec::new();
    for path in rust_files(&workspace().join("crates")) {
        faults.extend(prose::faults_of_source(&path, &std::fs::read_to_string(&path).unwrap()));
    }
    let docs = workspace().join("docs");
    let inner = ["how-to", "python", "dev", "dev/decisions"].map(|folder| docs.join(folder));
    let folders = [vec![workspace(), docs], inner.to_vec()].concat();
    for entry in folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "md") {
            faults.extend(prose::faults_of_page(&path, &std::fs::read_to_string(&path).unwrap()));
        }
    }
    assert_none(&faults);
}

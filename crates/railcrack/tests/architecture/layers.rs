//! Layers: the modules of a crate in an order in which each imports only those before it.

use super::rules;
use super::source::SourceFile;
use std::collections::{BTreeMap, BTreeSet};

const TABLE: &str = "| crate | its modules, each importing only those before it |";

/// The modules of a crate, or of a Python package, in order.
#[derive(Debug, PartialEq, Eq)]
pub struct Layers(Vec<String>);

/// An import of the module `imported`, in a line of a file of `module`.
pub struct Arrow<'a> {
    pub place: String,
    pub module: &'a str,
    pub imported: &'a str,
}

impl Layers {
    /// Of every crate that has a row in the table of layers.
    pub fn of_crates(text: &str) -> BTreeMap<String, Self> {
        let row = |cells: Vec<String>| {
            let name = rules::names(&cells[0]).next().expect("a crate in the first column");
            (name, Self(rules::names(&cells[1]).collect()))
        };
        rules::table(text, TABLE).into_iter().map(row).collect()
    }

    fn place(&self, module: &str) -> Option<usize> {
        self.0.iter().position(|name| name == module)
    }

    /// Arrows that run up, and imports of what is no module.
    pub fn faults<'a>(&self, arrows: impl IntoIterator<Item = Arrow<'a>>) -> Vec<String> {
        let others = arrows.into_iter().filter(|arrow| arrow.module != arrow.imported);
        let fault = |arrow: Arrow| {
            let Arrow { place, module, imported } = arrow;
            match (self.place(imported), self.place(module)) {
                (None, _) => Some(format!("{place}: `{imported}` is no module: import by the module's path")),
                (Some(below), Some(own)) if below > own => {
                    Some(format!("{place}: {module} imports {imported}, which stands above it"))
                }
                _ => None,
            }
        };
        others.filter_map(fault).collect()
    }

    /// Modules that are `there` and have no layer, or two, and layers without a module.
    pub fn differences(&self, there: &BTreeSet<String>) -> Vec<String> {
        let mut layers = BTreeSet::new();
        let twice = self.0.iter().filter(|name| !layers.insert((*name).clone()));
        let mut faults: Vec<String> = twice.map(|name| format!("{name} stands twice")).collect();
        faults.extend(there.difference(&layers).map(|name| format!("{name} has no layer")));
        faults.extend(layers.difference(there).map(|name| format!("{name} is not there")));
        faults
    }
}

/// The imports of `files` from other modules of their crate.
pub fn arrows(files: &[SourceFile]) -> impl Iterator<Item = Arrow<'_>> {
    files.iter().flat_map(|file| {
        file.imports.iter().map(|import| Arrow {
            place: format!("{}:{}", file.path.display(), import.line),
            module: file.module(),
            imported: &import.module,
        })
    })
}

#[cfg(test)]
fn faults(path: &str, text: &str) -> Vec<String> {
    let layers = Layers(["error", "disk", "summary"].map(str::to_owned).to_vec());
    let files = [SourceFile::read(std::path::Path::new(path), text)];
    layers.faults(arrows(&files))
}

#[test]
fn an_import_of_a_higher_module_is_found() {
    let text = "use crate::error::OutputError;\nuse crate::summary::Summary;\nuse crate::disk::Seal;";
    assert_eq!(faults("disk/lock.rs", text), ["disk/lock.rs:2: disk imports summary, which stands above it"]);
    assert!(faults("summary/parts.rs", text).is_empty());
}

#[test]
fn an_import_from_the_root_of_the_crate_is_found() {
    let none = "`Seal` is no module: import by the module's path";
    assert_eq!(
        faults("summary/parts.rs", "use crate::{Seal, error};"),
        [format!("summary/parts.rs:1: {none}")]
    );
    assert_eq!(faults("summary.rs", "use super::Seal;"), [format!("summary.rs:1: {none}")]);
    assert!(faults("disk/lock.rs", "use super::Seal;").is_empty());
}

#[test]
fn layers_are_the_modules_that_are_there() {
    let table = format!("{TABLE}\n|---|---|\n| `one` | `a`, `b`, `a`, `d` |\n");
    let layers = &Layers::of_crates(&table)["one"];
    let there = ["a", "b", "c"].map(str::to_owned).into();
    assert_eq!(layers.differences(&there), ["a stands twice", "c has no layer", "d is not there"]);
}

//! Modules of the Python package, and which of them import one another.

use std::path::Path;

/// The extension module, which the crate of the package builds.
pub const EXTENSION: &str = "_railcrack";

/// A module of the package.
pub struct PythonFile {
    pub module: String,
    /// The other modules that it imports, with the lines. Those that only annotations need count.
    pub imports: Vec<(String, usize)>,
}

impl PythonFile {
    /// `path` gives the name of the module.
    pub fn read(path: &Path, text: &str) -> Self {
        let module = path.file_stem().unwrap().to_string_lossy().into_owned();
        let mut imports = Vec::new();
        for (i, line) in text.lines().enumerate() {
            let Some(rest) = line.trim_start().strip_prefix("from .") else { continue };
            let Some((from, what)) = rest.split_once(" import ") else { continue };
            // `from . import errors` names modules, `from ._table import Table` comes from one.
            let names: Vec<&str> = if from.is_empty() { what.split(',').collect() } else { vec![from] };
            let ours = names.into_iter().map(str::trim).filter(|name| *name != EXTENSION);
            imports.extend(ours.map(|name| (name.to_owned(), i + 1)));
        }
        Self { module, imports }
    }
}

#[test]
fn imports_are_found_wherever_they_are_written() {
    let text = "import os\nfrom . import _railcrack, errors\nfrom ._table import Table\nfrom pathlib import Path\n\
        def f():\n    from ._html import facts\n";
    let file = PythonFile::read(Path::new("railcrack/_run.py"), text);
    let imports: Vec<_> = file.imports.iter().map(|(name, line)| (name.as_str(), *line)).collect();
    assert_eq!(file.module, "_run");
    assert_eq!(imports, [("errors", 2), ("_table", 3), ("_html", 6)]);
}

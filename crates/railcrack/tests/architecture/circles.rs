//! Circles between files, and between folders: those that import one another, directly or through
//! others.

use super::source::{SourceFile, Token};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A path of modules from the root of the crate, with an item at its end.
type Names = Vec<String>;

/// The groups of `files`, and of folders, of one crate that reach one another. An import counts for
/// the file that defines what is imported: re-exports of `mod.rs` lead there, and are no imports of
/// their own. Tests do not count.
pub fn circles(files: &[SourceFile]) -> Vec<BTreeSet<PathBuf>> {
    let sources: Vec<&SourceFile> = files.iter().filter(|file| !is_for_tests(&file.path)).collect();
    let modules: BTreeMap<Names, usize> =
        sources.iter().enumerate().map(|(i, file)| (module(&file.path), i)).collect();
    let mut exports = BTreeMap::new();
    let mut imports = Vec::new();
    for file in &sources {
        let own = module(&file.path);
        let is_root = file.path.ends_with("mod.rs");
        let mut found = Vec::new();
        for (path, exported) in paths(file, &own, &modules) {
            if exported && is_root {
                let name = path[path.len() - 1].clone();
                exports.insert([own.clone(), vec![name]].concat(), path);
            } else {
                found.push(path);
            }
        }
        imports.push(found);
    }
    let resolve = |path: &Names| file_of(path, &modules, &exports);
    let edges: Vec<BTreeSet<usize>> =
        imports.iter().map(|paths| paths.iter().filter_map(resolve).collect()).collect();
    let mut circles: Vec<BTreeSet<PathBuf>> = Vec::new();
    // Of each folder what lies in it: its files, and the folders in it as wholes.
    let folders: BTreeSet<&Path> = sources.iter().flat_map(|file| file.path.ancestors().skip(1)).collect();
    for folder in folders {
        let entry = |i: usize| -> Option<&Path> {
            let within = sources[i].path.strip_prefix(folder).ok()?;
            Some(Path::new(within.iter().next()?))
        };
        let mut arrows: BTreeMap<&Path, BTreeSet<&Path>> = BTreeMap::new();
        for (from, imported) in edges.iter().enumerate() {
            let Some(from) = entry(from) else { continue };
            arrows.entry(from).or_default().extend(imported.iter().filter_map(|&to| entry(to)));
        }
        let reached: BTreeMap<&Path, BTreeSet<&Path>> =
            arrows.keys().map(|&from| (from, reach(from, &arrows))).collect();
        for (entry, own) in &reached {
            let back = own.iter().filter(|other| reached[*other].contains(entry));
            let group: BTreeSet<PathBuf> = back.map(|other| folder.join(other)).collect();
            if group.len() > 1 && !circles.contains(&group) {
                circles.push(group);
            }
        }
    }
    circles
}

fn is_for_tests(path: &Path) -> bool {
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    stem.ends_with("_tests") || stem == "fixtures"
}

fn module(path: &Path) -> Names {
    let mut names: Names =
        path.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    names.pop_if(|last| matches!(last.as_str(), "mod" | "lib" | "main"));
    names
}

/// All paths of a file that lead to a module of the crate, absolute, and whether each is
/// re-exported.
fn paths(file: &SourceFile, own: &Names, modules: &BTreeMap<Names, usize>) -> Vec<(Names, bool)> {
    let tokens = file.tokens();
    let mut found = Vec::new();
    for (i, token) in tokens.iter().enumerate() {
        let text = |k: usize| tokens.get(k).map_or("", |token| token.text.as_str());
        let before = |k: usize| i.checked_sub(k).map_or("", text);
        if before(1) == "::" || token.inside.iter().any(|module| module == "tests") {
            continue;
        }
        let in_use = before(1) == "use";
        let here = [own.clone(), token.inside.clone()].concat();
        let is_child = in_use && modules.contains_key(&[here.clone(), vec![token.text.clone()]].concat());
        if is_child || (matches!(token.text.as_str(), "crate" | "super" | "self") && text(i + 1) == "::") {
            let exported = in_use && matches!(before(2), "pub" | ")");
            let mut leaves = Vec::new();
            leaves_of(tokens, i, here, &mut leaves);
            found.extend(leaves.into_iter().map(|path| (path, exported)));
        }
    }
    found
}

/// The paths of a path, or of a group of paths, from token `i` on, below `at`.
fn leaves_of(tokens: &[Token], i: usize, mut at: Names, leaves: &mut Vec<Names>) {
    let text = |k: usize| tokens.get(k).map_or("", |token| token.text.as_str());
    match text(i) {
        "{" => {
            let mut level = 0;
            for k in i..tokens.len() {
                match text(k) {
                    "{" => level += 1,
                    "}" if level == 1 => return,
                    "}" => level -= 1,
                    _ => {}
                }
                if level == 1 && matches!(text(k), "{" | ",") && !matches!(text(k + 1), "}" | ",") {
                    leaves_of(tokens, k + 1, at.clone(), leaves);
                }
            }
            return;
        }
        "crate" => at.clear(),
        "super" => drop(at.pop()),
        "self" | "*" => {}
        name => at.push(name.to_owned()),
    }
    if text(i + 1) == "::" {
        leaves_of(tokens, i + 2, at, leaves);
    } else if !at.is_empty() {
        leaves.push(at);
    }
}

/// The file that defines what is at the end of `path`.
fn file_of(
    path: &Names,
    modules: &BTreeMap<Names, usize>,
    exports: &BTreeMap<Names, Names>,
) -> Option<usize> {
    let depth = (0..=path.len()).rev().find(|&n| modules.contains_key(&path[..n]))?;
    let item = path.get(..=depth);
    match item.and_then(|item| exports.get(item)) {
        Some(target) if target != path => file_of(target, modules, exports),
        _ => modules.get(&path[..depth]).copied(),
    }
}

/// Everything that `from` imports, directly or through others.
fn reach<'a>(from: &'a Path, arrows: &BTreeMap<&'a Path, BTreeSet<&'a Path>>) -> BTreeSet<&'a Path> {
    let mut reached = BTreeSet::new();
    let mut pending = vec![from];
    while let Some(next) = pending.pop() {
        for &other in arrows[next].iter().filter(|&&other| other != next) {
            if reached.insert(other) {
                pending.push(other);
            }
        }
    }
    reached
}

#[cfg(test)]
fn groups(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let files: Vec<SourceFile> =
        files.iter().map(|(path, text)| SourceFile::read(Path::new(path), text)).collect();
    let names = |group: BTreeSet<PathBuf>| group.iter().map(|path| path.display().to_string()).collect();
    circles(&files).into_iter().map(names).collect()
}

#[test]
fn a_circle_is_found_through_the_re_exports_of_a_folder() {
    let folder = ("a/mod.rs", "mod one; mod two; mod three; pub use one::{One, Uno}; pub use two::Two;");
    let three = ("a/three.rs", "use super::{One, Two};");
    let circle = [folder, ("a/one.rs", "use super::Two;"), ("a/two.rs", "fn f(x: &super::Uno) {}"), three];
    assert_eq!(groups(&circle), [["a/one.rs", "a/two.rs"]]);
    let chain =
        [folder, ("a/one.rs", "use super::two::{self, Two};"), ("a/two.rs", "use crate::b::B;"), three];
    assert!(groups(&chain).is_empty());
}

#[test]
fn what_a_folder_defines_itself_counts_and_tests_do_not() {
    let folder =
        ("a/mod.rs", "mod one; pub use one::One; pub trait Field {} struct S(one::One); use one::Two;");
    assert_eq!(groups(&[folder, ("a/one.rs", "use super::Field;")]), [["a/mod.rs", "a/one.rs"]]);
    let leaf = ("a/one.rs", "mod tests { use super::super::Field; }");
    assert!(groups(&[folder, leaf, ("a/one_tests.rs", "use crate::a::Field;")]).is_empty());
}

#[test]
fn folders_that_import_one_another_are_found() {
    let down = ("a/one.rs", "use crate::b::one::B;");
    let (lower, other) = (("b/one.rs", "pub struct B;"), ("a/two.rs", "pub struct A;"));
    let up = ("b/two.rs", "use crate::a::two::A;");
    assert!(groups(&[down, lower, other]).is_empty());
    assert_eq!(groups(&[down, lower, other, up]), [["a", "b"]]);
}

//! The book: every command, case and script in `docs` and the README is run, and prints what the
//! page shows.
//!
//! In a page, a block of
//!
//! * any language whose first line is a comment with a file name (`# head-check.toml`) is that
//!   file, beside which the commands of the page run; a case or a study is checked;
//! * `sh` are commands that must succeed;
//! * `console` are commands behind `$ ` with what they print, `…` for anything; of one that fails,
//!   its message;
//! * `console png` is run where the command has the feature `png`;
//! * `python` is run with a Python that has meshio;
//! * `text`, or of no language, is not run.
//!
//! Commands of cargo must be those of `.ci/run`.

use super::common;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The pages, with Python in them or not.
fn pages(with_python: bool) -> Vec<PathBuf> {
    let root = workspace();
    let mut pages = vec![root.join("README.md")];
    let mut pending = vec![root.join("docs")];
    while let Some(folder) = pending.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                pending.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages.retain(|page| fs::read_to_string(page).unwrap().contains("```python") == with_python);
    pages
}

struct Block {
    /// Line of its fence in the page, from 1.
    line: usize,
    language: String,
    text: String,
}

fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for (i, line) in page.lines().enumerate() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(language)) => {
                let (language, feature) = language.trim().split_once(' ').unwrap_or((language.trim(), ""));
                let is_run = feature != "png" || cfg!(feature = "png");
                let language = if is_run { language } else { "text" }.to_owned();
                open = Some(Block { line: i + 1, language, text: String::new() });
            }
            (None, None) => {}
            (Some(block), None) => block.text += &format!("{line}\n"),
            (Some(_), Some(_)) => blocks.extend(open.take()),
        }
    }
    blocks
}

/// The name of the file that a block is.
fn file_name(block: &Block) -> Option<&str> {
    let mut lines = block.text.lines().filter(|line| !line.starts_with("#!"));
    let name = lines.next()?.strip_prefix("# ")?;
    let is_name = !name.contains([' ', '/']) && Path::new(name).extension().is_some();
    is_name.then_some(name)
}

/// Whether `printed` is what a page shows.
fn is_shown(printed: &str, shown: &str) -> bool {
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    let shown: Vec<&str> = shown.lines().map(str::trim_end).collect();
    lines_match(&printed, &shown)
}

fn lines_match(printed: &[&str], shown: &[&str]) -> bool {
    match (shown.split_first(), printed.split_first()) {
        (None, None) => true,
        (None, Some(_)) => false,
        (Some((&"…", rest)), _) => (0..=printed.len()).any(|skip| lines_match(&printed[skip..], rest)),
        (Some(_), None) => false,
        (Some((line, rest)), Some((first, others))) => line_matches(first, line) && lines_match(others, rest),
    }
}

fn line_matches(printed: &str, shown: &str) -> bool {
    let Some((start, rest)) = shown.split_once('…') else { return printed == shown };
    let Some(after) = printed.strip_prefix(start) else { return false };
    let ends = after.char_indices().map(|(i, _)| i).chain([after.len()]);
    ends.into_iter().any(|i| line_matches(&after[i..], rest))
}

/// A folder with the shipped cases, in which the commands of a page are run, and the program by its
/// name.
struct Place {
    folder: PathBuf,
    programs: PathBuf,
}

impl Place {
    fn of(page: &Path) -> Self {
        let folder = common::folder("book", &page.file_stem().unwrap().to_string_lossy());
        let programs = folder.join(".programs");
        fs::create_dir_all(&programs).unwrap();
        // Not a copy: a program that was just written is busy while another test starts its own.
        std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_railcrack"), programs.join("railcrack")).unwrap();
        copy_files(&workspace().join("cases"), &folder.join("cases"));
        Self { folder, programs }
    }

    fn bash(&self, script: &str) -> Output {
        let others = std::env::var("PATH").unwrap();
        let mut command = Command::new("bash");
        command.args(["-euo", "pipefail", "-c", script]).current_dir(&self.folder);
        command.env("PATH", format!("{}:{others}", self.programs.display())).output().unwrap()
    }
}

/// The case files and their tables, without results of runs beside them.
fn copy_files(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_file() {
            fs::copy(&path, target).unwrap();
        } else if path.ends_with("profiles") {
            copy_files(&path, &target);
        }
    }
}

/// `command` as it is run here; what cargo does, `.ci/run` does.
fn as_run(command: &str) -> Result<String, String> {
    if let Some(arguments) = command.strip_prefix("cargo run --release -- ") {
        return Ok(format!("railcrack {arguments}"));
    }
    if !command.starts_with("cargo ") {
        return Ok(command.to_owned());
    }
    let stated = command.split(" #").next().unwrap_or(command).trim();
    let checks = fs::read_to_string(workspace().join(".ci/run")).unwrap();
    if checks.contains(stated) { Ok(":".to_owned()) } else { Err(format!("`{stated}` is not in .ci/run")) }
}

fn run_block(place: &Place, block: &Block) -> Result<(), String> {
    if let Some(name) = file_name(block) {
        let path = place.folder.join(name);
        fs::write(&path, &block.text).unwrap();
        // An entry of `railcrack validate` is read with its folder.
        let is_entry = block.text.lines().any(|line| line.starts_with("grade = "));
        return if block.language == "toml" && !is_entry {
            succeed(place, &format!("railcrack check {name}"))
        } else {
            Ok(())
        };
    }
    match block.language.as_str() {
        // The reader's own test has fragments of cases, another one the program of the README.
        "text" | "" | "toml" | "rust" => Ok(()),
        "sh" => {
            let commands: Result<Vec<String>, String> = block.text.lines().map(as_run).collect();
            succeed(place, &commands?.join("\n"))
        }
        "console" => console(place, &block.text),
        "python" => {
            let python = std::env::var("RAILCRACK_PYTHON").map_err(|_| "RAILCRACK_PYTHON is not set")?;
            fs::write(place.folder.join(".block.py"), &block.text).unwrap();
            succeed(place, &format!("{python} .block.py"))
        }
        other => Err(format!("nothing runs a block of `{other}`")),
    }
}

fn succeed(place: &Place, script: &str) -> Result<(), String> {
    let output = place.bash(script);
    if output.status.success() {
        return Ok(());
    }
    Err(format!("ended with {:?}:\n{}", output.status.code(), common::stderr(&output)))
}

/// Commands with what they print.
fn console(place: &Place, text: &str) -> Result<(), String> {
    let mut commands: Vec<(String, String)> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("$ "), commands.last_mut()) {
            (Some(command), _) => commands.push((command.to_owned(), String::new())),
            (None, Some((_, shown))) => *shown += &format!("{line}\n"),
            (None, None) => return Err("a block of `console` begins with `$ `".to_owned()),
        }
    }
    for (command, shown) in commands {
        let output = place.bash(&as_run(&command)?);
        // Standard error is for progress where all goes well.
        let failed = !output.status.success();
        let printed = if failed { common::stderr(&output) } else { common::stdout(&output) };
        if failed && shown.is_empty() || !is_shown(&printed, &shown) {
            return Err(format!("`{command}` prints\n{printed}\nand the page shows\n{shown}"));
        }
    }
    Ok(())
}

fn run_pages(with_python: bool) {
    let mut failures = Vec::new();
    let mut count = 0;
    for page in pages(with_python) {
        let blocks = blocks(&fs::read_to_string(&page).unwrap());
        if blocks.is_empty() {
            continue;
        }
        let place = Place::of(&page);
        for block in &blocks {
            count += 1;
            if let Err(reason) = run_block(&place, block) {
                failures.push(format!("{}:{}: {reason}", page.display(), block.line));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    assert!(count > 0, "no block in the book");
}

#[test]
fn every_page_does_what_it_says() {
    run_pages(false);
}

#[test]
#[ignore = "extra: needs a Python with meshio, by RAILCRACK_PYTHON"]
fn every_page_with_python_does_what_it_says() {
    run_pages(true);
}

#[test]
fn what_is_printed_must_be_what_is_shown() {
    assert!(is_shown("a 1.2 s\nb\n", "a … s\nb\n"));
    assert!(is_shown("a\nb\nc\n", "a\n…\nc\n") && is_shown("a\nc\n", "a\n…\nc\n"));
    assert!(!is_shown("a\nb\nc\n", "a\nc\n") && !is_shown("a\n", "a\nb\n") && !is_shown("ab\n", "a\n"));
    let named = |text: &str| Block { line: 1, language: String::new(), text: text.to_owned() };
    assert_eq!(file_name(&named("# case.toml\nx = 1\n")), Some("case.toml"));
    assert_eq!(file_name(&named("#!/bin/sh\n# part.sh\n")), Some("part.sh"));
    assert_eq!(file_name(&named("# A case.\nx = 1\n")), None);
    assert!(as_run("cargo test --release --workspace").is_ok() && as_run("cargo publish").is_err());
}

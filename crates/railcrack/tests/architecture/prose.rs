//! Prose of the sources and documents: its width, how doc comments begin, and phrases that are not
//! idiomatic English.

use std::path::Path;

/// Maximum number of columns of a line of prose.
const WIDTH: usize = 100;

/// Pages that a program writes, held to their generators by tests of their own.
const GENERATED: [&str; 2] = ["case-file.md", "verification.md"];
fn is_generated(path: &Path) -> bool {
    GENERATED.contains(&path.file_name().unwrap_or_default().to_string_lossy().as_ref())
}

/// Folders and pages, relative to the workspace, whose prose must be free of [`CRUTCHES`]: pages,
/// and comments of sources.
pub const PLAIN: [&str; 11] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "docs",
    "python/README.md",
    "crates/railcrack/src",
    "crates/railcrack/tests",
    "crates/railcrack-case",
    "crates/railcrack-run",
];

/// Phrases that are not what an engineer would write.
const CRUTCHES: [&str; 33] = [
    "are handed over",
    "are told",
    "as good as that",
    "come to its number",
    "come to their number",
    "comes to its number",
    "functions of one's own",
    "functions of the user",
    "hand over",
    "handed over",
    "handed-over",
    "handing over",
    "hands over",
    "hang on it",
    "hang on the",
    "hangs on",
    "hung on",
    "in place of",
    "is a law from above",
    "is told",
    "much else to do",
    "of one's own",
    "on its way",
    "on the way",
    "on their way",
    "stand beside",
    "stands beside",
    "tells apart",
    "that is none",
    "told apart",
    "was told",
    "were told",
    "what is told",
];

/// Lines of comments that are too wide, and doc comments that begin with "What": `path:line: text`.
pub fn faults_of_source(path: &Path, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let (mut in_code, mut before) = (false, "");
    for (i, line) in text.lines().enumerate() {
        let comment = line.trim_start();
        if !comment.starts_with("//") {
            (in_code, before) = (false, comment);
            continue;
        }
        let words = comment.trim_start_matches(['/', '!']).trim_start();
        in_code ^= words.starts_with("```");
        let begins = !before.starts_with("//");
        if begins && (comment.starts_with("///") || comment.starts_with("//!")) && words.starts_with("What ")
        {
            faults.push(format!("{}:{}: begins with \"What\": {comment}", path.display(), i + 1));
        }
        if is_too_wide(line, words) && !in_code {
            faults.push(format!("{}:{}: over {WIDTH} columns: {comment}", path.display(), i + 1));
        }
        before = comment;
    }
    faults
}

/// Lines of prose in a Markdown page that are too wide.
pub fn faults_of_page(path: &Path, text: &str) -> Vec<String> {
    if is_generated(path) {
        return Vec::new();
    }
    let mut in_code = false;
    let mut faults = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let words = line.trim_start();
        in_code ^= words.starts_with("```");
        let is_prose = !in_code && !words.starts_with(['|', '#', '<', '!']) && !line.starts_with("    ");
        if is_prose && is_too_wide(line, words) {
            faults.push(format!("{}:{}: over {WIDTH} columns", path.display(), i + 1));
        }
    }
    faults
}

/// The prose of a page or source line by line: code and signs of comments are empty.
fn prose(path: &Path, text: &str) -> Vec<String> {
    let is_source = path.extension().is_some_and(|ending| ending == "rs");
    let mut in_code = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        let words = line.trim();
        let words = match words.strip_prefix("//") {
            Some(comment) if is_source => comment.trim_start_matches(['/', '!']).trim_start(),
            None if is_source => "",
            _ => words,
        };
        let fence = words.starts_with("```");
        in_code ^= fence;
        lines.push(if fence || in_code { String::new() } else { words.to_lowercase() });
    }
    lines
}

/// Phrases among the [`CRUTCHES`], within a line or across its end.
pub fn crutches(path: &Path, text: &str) -> Vec<String> {
    if is_generated(path) {
        return Vec::new();
    }
    let lines = prose(path, text);
    let mut faults = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let both = lines.get(i + 1).map_or_else(|| line.clone(), |next| format!("{line} {next}"));
        for phrase in CRUTCHES {
            let begins_here = both.match_indices(phrase).any(|(at, _)| {
                let is_end = |sign: Option<char>| sign.is_none_or(|sign| !sign.is_alphanumeric());
                at < line.len()
                    && is_end(both[..at].chars().next_back())
                    && is_end(both[at + phrase.len()..].chars().next())
            });
            if begins_here {
                faults.push(format!("{}:{}: \"{phrase}\"", path.display(), i + 1));
            }
        }
    }
    faults
}

#[test]
fn crutches_are_found() {
    let page = "A table that is\nnone.\n\nIn Place of it,\n```\nin place of\n```\nmagnetism is toldless\n";
    let found = crutches(Path::new("a.md"), page);
    assert_eq!(found, ["a.md:1: \"that is none\"", "a.md:4: \"in place of\""]);
    assert_eq!(crutches(Path::new("verification.md"), page), [""; 0]);
    let source = "//! The path hangs\n//! on it.\nlet text = \"in place of\"; // in place of\n";
    assert_eq!(crutches(Path::new("a.rs"), source), ["a.rs:1: \"hangs on\""]);
}

/// A single word, such as an address, cannot be broken.
fn is_too_wide(line: &str, words: &str) -> bool {
    line.chars().count() > WIDTH && words.contains(' ')
}

#[test]
fn faults_are_found() {
    let wide = "word ".repeat(21);
    let source =
        format!("//! Crack.\n//! {wide}\n\n/// What it is.\nfn a() {{}}\n/// A\n/// What.\nfn b() {{}}\n");
    let found = faults_of_source(Path::new("a.rs"), &source);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("a.rs:2: over") && found[1].starts_with("a.rs:4: begins"), "{found:?}");
    assert_eq!(faults_of_source(Path::new("a.rs"), &format!("/// ```\n/// {wide}\n/// ```\n")), [""; 0]);
    assert_eq!(
        faults_of_page(Path::new("a.md"), &format!("{wide}\n| {wide} |\n```\n{wide}\n```\n")).len(),
        1
    );
    assert_eq!(faults_of_page(Path::new("verification.md"), &wide), [""; 0]);
}

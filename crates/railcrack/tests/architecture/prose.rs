//! Prose of the sources and documents: its width, and how doc comments begin.

use std::path::Path;

/// The most columns of a line of prose.
const WIDTH: usize = 100;

/// Pages that a program writes, held to their generators by tests of their own.
const GENERATED: [&str; 3] = ["case-file.md", "verification.md", "paper.md"];

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
    if path.file_name().is_some_and(|name| GENERATED.iter().any(|page| name == *page)) {
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
    assert_eq!(faults_of_page(Path::new("paper.md"), &wide), [""; 0]);
}

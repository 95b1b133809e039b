//! The pages in the repository against what was computed.

use crate::error::PaperError;
use crate::pages::{Contents, STATEMENTS};
use crate::tables::home;
use railcrack_run::OutputError;
use std::path::{Path, PathBuf};

/// A number of a page counts as the same within this part of itself: it has three digits, and the
/// last of them may differ on another machine.
const SAME: f64 = 0.01;

/// The chapter of the book.
pub fn chapter_path() -> PathBuf {
    home().join("../../docs/paper.md")
}

/// Compares the pages in the repository with `contents`: the rows of the statements that were
/// decided, the pages of groups whose figures were all recomputed, and, if every figure was, the
/// page of all statements and the result in the chapter.
///
/// Errors: the lines that differ; the system refuses.
pub fn check(contents: &Contents) -> Result<(), PaperError> {
    let read = |path: &Path| std::fs::read_to_string(path).map_err(OutputError::io("read", path));
    let results = home().join("results");
    let statements = read(&results.join(STATEMENTS))?;
    let mut faults = Vec::new();
    for row in contents.verdicts.iter().map(|verdict| contents.row(verdict)) {
        if !statements.lines().any(|line| line == row) {
            faults.push(format!("{STATEMENTS} has no line\n  {row}"));
        }
    }
    if contents.figures.len() == contents.paper.figures.len() {
        faults.extend(differences(STATEMENTS, &statements, &contents.statements()?));
        let chapter = read(&chapter_path())?.split_whitespace().collect::<Vec<_>>().join(" ");
        if !chapter.contains(&contents.result()) {
            faults.push(format!("docs/paper.md lacks\n  {}", contents.result()));
        }
    }
    for group in &contents.paper.groups {
        if group.figures.iter().all(|figure| contents.figures.contains(figure)) {
            let file = group.file();
            faults.extend(differences(&file, &read(&results.join(&file))?, &contents.group_page(group)));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(PaperError::Differs(faults)) }
}

/// Lines of the page `kept` that say something else than those of `computed`.
fn differences(name: &str, kept: &str, computed: &str) -> Vec<String> {
    let (kept, computed): (Vec<&str>, Vec<&str>) = (kept.lines().collect(), computed.lines().collect());
    let line = |lines: &[&str], i: usize| lines.get(i).copied().unwrap_or("(end)").to_owned();
    (0..kept.len().max(computed.len()))
        .map(|i| (i, line(&kept, i), line(&computed, i)))
        .filter(|(_, kept, computed)| !says_the_same(kept, computed))
        .map(|(i, kept, computed)| format!("{name}:{}\n  {kept}\nnow\n  {computed}", i + 1))
        .collect()
}

/// Whether two lines have the same words, and numbers that are the same within [`SAME`].
fn says_the_same(kept: &str, computed: &str) -> bool {
    let words = |line: &str| line.split([' ', ',', ';', ':']).map(str::to_owned).collect::<Vec<_>>();
    let (kept, computed) = (words(kept), words(computed));
    let is_same = |(kept, computed): (&String, &String)| match (kept.parse::<f64>(), computed.parse::<f64>())
    {
        (Ok(kept), Ok(computed)) => (kept - computed).abs() <= SAME * computed.abs() + 1e-9,
        _ => kept == computed,
    };
    kept.len() == computed.len() && kept.iter().zip(&computed).all(is_same)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_says_something_else_is_seen() {
        let line = "* block, along: no; ΔK_II at 0.025 9.66, ΔK_II at 0.1 7.2 (warnings: Table 1)";
        assert!(says_the_same(line, line));
        assert!(says_the_same(line, &line.replace("9.66", "9.67")), "the last digit on another machine");
        assert!(!says_the_same(line, &line.replace("9.66", "9.86")));
        assert!(!says_the_same(line, &line.replace("no;", "yes;")));
        assert!(!says_the_same(line, &line.replace(", ΔK_II at 0.1 7.2", "")));
        assert!(!says_the_same(line, &line.replace(" (warnings: Table 1)", "")));
        assert_eq!(differences("page", "a\nb\nc", "a\nx\nc\nd").len(), 2);
    }
}

//! The documents: what they link to is there, and the case files and studies that they show are
//! accepted.

use railcrack_case::{Input, Overrides};
use std::path::{Path, PathBuf};

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The documents of the workspace: its Markdown files and those under `docs`.
fn documents() -> Vec<PathBuf> {
    let root = workspace();
    let mut pending = vec![root.join("docs")];
    let mut documents = markdown_in(&root, &mut Vec::new());
    while let Some(folder) = pending.pop() {
        documents.extend(markdown_in(&folder, &mut pending));
    }
    documents.sort();
    assert!(documents.len() >= 8, "{documents:?}");
    documents
}

fn markdown_in(folder: &Path, folders: &mut Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            folders.push(path);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            files.push(path);
        }
    }
    files
}

/// The code blocks of a document in `language`, with the line on which each begins.
fn blocks(text: &str, language: &str) -> Vec<(usize, String)> {
    let mut blocks = Vec::new();
    let mut open: Option<(usize, String, String)> = None;
    for (i, line) in text.lines().enumerate() {
        match (&mut open, line.trim_start().strip_prefix("```")) {
            (None, Some(language)) => open = Some((i + 1, language.trim().to_owned(), String::new())),
            (None, None) => {}
            (Some((_, _, block)), None) => *block += &format!("{line}\n"),
            (Some(_), Some(_)) => {
                let (line, of, block) = open.take().unwrap();
                if of == language {
                    blocks.push((line, block));
                }
            }
        }
    }
    assert!(open.is_none(), "a code block does not end");
    blocks
}

const CONTACT: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.025\n";
const CRACK: &str = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n";

/// A case with the keys of `fragment` and the rest of the reference case.
fn completed(fragment: &str) -> String {
    let mut text = fragment.to_owned();
    for (section, rest) in [("[contact]", CONTACT), ("[[crack]]", CRACK)] {
        if !fragment.lines().any(|line| line.trim_start().starts_with(section)) {
            text.push_str(rest);
        }
    }
    text
}

#[test]
fn every_case_in_the_documents_is_accepted() {
    let mut count = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).unwrap();
        for (line, block) in blocks(&text, "toml") {
            count += 1;
            // A block that is a file stands beside others of its page: the command's tests run
            // them.
            if block.lines().next().is_some_and(|first| first.starts_with("# ") && first.ends_with(".toml")) {
                continue;
            }
            // Files that a block names are looked for among the shipped cases.
            let parsed = Input::parse_with(
                &completed(&block),
                "block",
                &workspace().join("cases"),
                &Overrides::default(),
            );
            if let Err(errors) = parsed {
                let errors: Vec<String> = errors.errors().iter().map(|error| error.one_line()).collect();
                panic!("{}:{line}: {}", document.display(), errors.join("\n"));
            }
        }
    }
    assert!(count > 0, "no case in the documents");
}

#[test]
fn every_link_leads_to_a_file() {
    for document in documents() {
        let text = std::fs::read_to_string(&document).unwrap();
        for (i, line) in text.lines().enumerate() {
            for after in line.split("](").skip(1) {
                let target = after.split(')').next().unwrap();
                if target.contains("://") {
                    continue;
                }
                let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
                let path =
                    if file.is_empty() { document.clone() } else { document.parent().unwrap().join(file) };
                let place = format!("{}:{}: {target}", document.display(), i + 1);
                assert!(path.exists(), "{place} is not there");
                if !anchor.is_empty() && path.extension().is_some_and(|extension| extension == "md") {
                    let headings = headings(&std::fs::read_to_string(&path).unwrap());
                    assert!(headings.contains(&anchor.to_owned()), "{place}: the page has {headings:?}");
                }
            }
        }
    }
}

/// The anchors of the headings of a page: small letters, hyphens for spaces, no other marks.
fn headings(text: &str) -> Vec<String> {
    let lines =
        text.lines().filter_map(|line| line.strip_prefix('#')?.trim_start_matches('#').strip_prefix(' '));
    let anchor = |heading: &str| {
        let kept = heading.to_lowercase();
        let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    lines.map(anchor).collect()
}

/// The program of the README is the tested one of the library's pages.
#[test]
fn the_readme_shows_the_tested_program() {
    let library = std::fs::read_to_string(workspace().join("crates/railcrack/src/lib.rs")).unwrap();
    let tested: Vec<&str> = library.lines().map(|line| line.trim_start_matches("//!").trim()).collect();
    let readme = std::fs::read_to_string(workspace().join("README.md")).unwrap();
    let shown = blocks(&readme, "rust");
    assert_eq!(shown.len(), 1);
    for line in shown[0].1.lines().filter(|line| !line.is_empty()) {
        assert!(tested.contains(&line.trim()), "README.md: not in the tested program: {line}");
    }
}

#[test]
fn every_table_is_described_as_it_is_declared() {
    let page = std::fs::read_to_string(workspace().join("docs/file-formats.md")).unwrap();
    for (file, columns) in railcrack_run::table_descriptions() {
        assert!(page.contains(&columns), "docs/file-formats.md is out of date; {file} has\n\n{columns}");
    }
}

#[test]
fn reads_blocks_by_language() {
    let text = "a\n```toml\nx = 1\n```\n```sh\nls\n```\n```toml\n```\n";
    assert_eq!(blocks(text, "toml"), [(2, "x = 1\n".to_owned()), (8, String::new())]);
}

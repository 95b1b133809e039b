//! One source file as its tokens: what it imports and what it names.

use std::path::{Path, PathBuf};

/// A file of the library.
pub struct SourceFile {
    /// Relative to the sources.
    pub path: PathBuf,
    /// Top-level modules that it names by `crate::` or `super::`, in `use` lines and elsewhere.
    pub imports: Vec<Import>,
    tokens: Vec<Token>,
}

/// A path that leads to a top-level module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    pub module: String,
    pub line: usize,
}

/// A word or sign.
#[derive(Debug, Clone)]
pub struct Token {
    pub text: String,
    line: usize,
    /// Inline modules around it.
    pub inside: Vec<String>,
}

/// Macros and functions that write to the streams of the process.
const PRINTING: [&str; 7] = ["print", "println", "eprint", "eprintln", "dbg", "stdout", "stderr"];

impl SourceFile {
    /// `path` is relative to the sources: it determines the module.
    pub fn read(path: &Path, text: &str) -> Self {
        let tokens = tokens(&without_comments_and_texts(text));
        let depth = depth(path);
        let mut imports = Vec::new();
        for (i, token) in tokens.iter().enumerate() {
            let starts_path = matches!(token.text.as_str(), "crate" | "super")
                && followed_by_path(&tokens, i)
                && (i == 0 || tokens[i - 1].text != "::");
            if starts_path {
                let depth = if token.text == "crate" { 0 } else { depth + token.inside.len() - 1 };
                modules_of(&tokens, i + 2, depth, &mut imports);
            }
        }
        Self { path: path.to_path_buf(), imports, tokens }
    }

    /// The top-level module that the file belongs to.
    pub fn module(&self) -> &str {
        let first = self.path.components().next().unwrap().as_os_str().to_str().unwrap();
        first.strip_suffix(".rs").unwrap_or(first)
    }

    /// Its words and signs.
    pub fn tokens(&self) -> &[Token] {
        &self.tokens
    }

    /// The lines that name `word`.
    pub fn lines_naming(&self, word: &str) -> Vec<String> {
        self.tokens.iter().filter(|token| token.text == word).map(|token| self.place(token)).collect()
    }

    /// The lines outside of tests that write to standard output or standard error.
    pub fn printing_lines(&self) -> Vec<String> {
        if self.is_test_file() {
            return Vec::new();
        }
        let prints = |token: &&Token| {
            PRINTING.contains(&token.text.as_str()) && !token.inside.iter().any(|module| module == "tests")
        };
        self.tokens.iter().filter(prints).map(|token| self.place(token)).collect()
    }

    fn is_test_file(&self) -> bool {
        is_test_file(&self.path)
    }

    fn place(&self, token: &Token) -> String {
        format!("{}:{}: {}", self.path.display(), token.line, token.text)
    }
}

/// Tests in a file of their own, `name_tests.rs`, are a module inside that of `name.rs`.
fn is_test_file(path: &Path) -> bool {
    path.file_stem().and_then(|stem| stem.to_str()).is_some_and(|stem| stem.ends_with("_tests"))
}

/// Number of modules from the root of the crate to the module of a file.
fn depth(path: &Path) -> usize {
    let is_folder_root = path.file_name().is_some_and(|name| name == "mod.rs");
    path.components().count() - usize::from(is_folder_root) + usize::from(is_test_file(path))
}

fn followed_by_path(tokens: &[Token], i: usize) -> bool {
    tokens.get(i + 1).is_some_and(|next| next.text == "::")
}

/// Adds the top-level modules of the path (or group of paths) from token `i` on, `depth` modules
/// below the root.
fn modules_of(tokens: &[Token], i: usize, depth: usize, imports: &mut Vec<Import>) {
    let Some(token) = tokens.get(i) else { return };
    match token.text.as_str() {
        "{" => {
            let mut level = 0;
            for (k, inner) in tokens.iter().enumerate().skip(i) {
                match inner.text.as_str() {
                    "{" => level += 1,
                    "}" if level == 1 => return,
                    "}" => level -= 1,
                    _ => {}
                }
                if level == 1 && matches!(inner.text.as_str(), "{" | ",") {
                    modules_of(tokens, k + 1, depth, imports);
                }
            }
        }
        "}" => {}
        "super" if followed_by_path(tokens, i) => modules_of(tokens, i + 2, depth - 1, imports),
        name if depth == 0 => imports.push(Import { module: name.to_owned(), line: token.line }),
        _ => {}
    }
}

/// Words, `::` and braces, commas and other signs one by one, each with the inline modules around
/// it.
fn tokens(text: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    // Names of the open braces: that of an inline module, or none.
    let mut open: Vec<Option<String>> = Vec::new();
    let mut rest = text;
    let mut line = 1;
    while let Some(sign) = rest.chars().next() {
        let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let length = match sign {
            _ if word > 0 => word,
            ':' if rest.starts_with("::") => 2,
            _ => sign.len_utf8(),
        };
        let (here, after) = rest.split_at(length);
        rest = after;
        line += usize::from(sign == '\n');
        if sign.is_whitespace() {
            continue;
        }
        if sign == '}' {
            open.pop();
        }
        let inside = open.iter().flatten().cloned().collect();
        if sign == '{' {
            let named = match tokens.as_slice() {
                [.., before, name] if before.text == "mod" => Some(name.text.clone()),
                _ => None,
            };
            open.push(named);
        }
        tokens.push(Token { text: here.to_owned(), line, inside });
    }
    tokens
}

/// The text with comments and the contents of texts and characters left out; lines stay where they
/// are.
fn without_comments_and_texts(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(sign) = rest.chars().next() {
        let after_word = code.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let skipped = match sign {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '/' if rest.starts_with("/*") => block_comment(rest),
            '"' => plain_text(rest),
            'r' if !after_word => raw_text(rest),
            '\'' => character(rest),
            _ => 0,
        };
        if skipped == 0 {
            code.push(sign);
            rest = &rest[sign.len_utf8()..];
        } else {
            code.extend(rest[..skipped].chars().filter(|&c| c == '\n'));
            code.push(' ');
            rest = &rest[skipped..];
        }
    }
    code
}

fn block_comment(text: &str) -> usize {
    let mut level = 0;
    let mut at = 0;
    while at < text.len() {
        if text[at..].starts_with("/*") {
            (level, at) = (level + 1, at + 2);
        } else if text[at..].starts_with("*/") {
            (level, at) = (level - 1, at + 2);
            if level == 0 {
                return at;
            }
        } else {
            at += text[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

fn plain_text(text: &str) -> usize {
    let mut escaped = false;
    for (at, sign) in text.char_indices().skip(1) {
        match sign {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// Length of a raw text `r#"…"#` at the start of `text`; 0 where there is none.
fn raw_text(text: &str) -> usize {
    let hashes = text[1..].len() - text[1..].trim_start_matches('#').len();
    if !text[1 + hashes..].starts_with('"') {
        return 0;
    }
    let end = format!("\"{}", "#".repeat(hashes));
    let begun = hashes + 2;
    text[begun..].find(&end).map_or(text.len(), |at| begun + at + end.len())
}

/// Length of a character `'x'` at the start of `text`; 0 for a lifetime.
fn character(text: &str) -> usize {
    let mut signs = text.char_indices().skip(1);
    match (signs.next(), signs.next()) {
        (Some((_, '\\')), Some(_)) => {
            signs.find(|(_, sign)| *sign == '\'').map_or(text.len(), |(at, _)| at + 1)
        }
        (Some(_), Some((at, '\''))) => at + 1,
        _ => 0,
    }
}

#[cfg(test)]
fn imports(path: &str, text: &str) -> Vec<String> {
    SourceFile::read(Path::new(path), text).imports.into_iter().map(|import| import.module).collect()
}

#[test]
fn finds_imports_wherever_they_are_written() {
    assert_eq!(imports("contact/law.rs", "use crate::xfem::XfemBody;"), ["xfem"]);
    assert_eq!(
        imports("contact/law.rs", "use crate::{math::Vec2, mesh::{Grid, Cell}, body};"),
        ["math", "mesh", "body"]
    );
    assert_eq!(
        imports("contact/law.rs", "fn f(x: &crate::mesh::Grid) -> super::super::crack::Crack {}"),
        ["mesh", "crack"]
    );
    assert_eq!(imports("contact/mod.rs", "use super::mesh::Grid;"), ["mesh"]);
    assert_eq!(imports("contact/law.rs", "use super::{super::mesh::Grid, problem::FaceProblem};"), ["mesh"]);
    assert_eq!(
        imports("contact/law.rs", "mod tests { use super::super::super::mesh; use super::super::law; }"),
        ["mesh"]
    );
    assert_eq!(
        imports("contact/law_tests.rs", "use super::super::super::mesh; use super::super::law;"),
        ["mesh"]
    );
}

#[test]
fn comments_texts_and_visibilities_are_no_imports() {
    let text = r##"
        // crate::mesh
        /* crate::mesh /* crate::mesh */ crate::mesh */
        pub(crate) fn f<'a>(x: &'a str) -> char { g("crate::mesh \" crate::mesh", r#"crate::mesh""#); '"' }
        pub(super) use super::law; // "
        use crate::math;
    "##;
    assert_eq!(imports("contact/problem.rs", text), ["math"]);
    assert_eq!(SourceFile::read(Path::new("a/b.rs"), text).imports[0].line, 6);
}

#[test]
fn printing_is_found_outside_of_tests_only() {
    let lines = |path: &str, text: &str| SourceFile::read(Path::new(path), text).printing_lines();
    assert_eq!(lines("math/ball.rs", "fn f() {\n println!(\"\"); }"), ["math/ball.rs:2: println"]);
    assert_eq!(lines("math/ball.rs", "mod tests { fn f() { println!(\"\"); } } fn g() { dbg!(1) }").len(), 1);
    assert_eq!(lines("math/ball_tests.rs", "println!(\"\")").len(), 0);
}

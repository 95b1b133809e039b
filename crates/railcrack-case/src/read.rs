//! From a file to a case, or to everything that is wrong with it.

use super::build::build;
use super::chosen::{Chosen, Reading};
use super::error::{CaseErrors, Fault, Report, Source};
use super::overrides::Overrides;
use super::section::{SectionValues, read_section};
use super::sections::SECTIONS;
use super::study::STUDY;
use super::table::{Section, SectionPresence};
use super::validated::Case;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

impl Case {
    /// The case in the file `path`. Relative file names in it are relative to its folder.
    ///
    /// Errors: everything that is wrong, a file that cannot be read included.
    pub fn read(path: &Path) -> Result<Self, CaseErrors> {
        Self::read_with(path, &Overrides::default())
    }

    /// As [`Case::read`], with `overrides` in place of what the file says.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        let name = path.display().to_string();
        let source = source_of(path, &name)?;
        Self::parse_with(&source.text, &name, path.parent().unwrap_or(Path::new("")), overrides)
    }

    /// The case written in `text`; errors call it `name`, relative file names are relative to `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, CaseErrors> {
        Self::parse_with(text, name, folder, &Overrides::default())
    }

    /// As [`Case::parse`], with `overrides` in place of what the text says.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        let mut report = Report::new(Source { name: name.into(), text: Arc::from(text) });
        let case = parse_document(text, &mut report)
            .filter(|root| is_no_study(root.get_ref(), &mut report))
            .and_then(|root| {
                let reading = Reading { overrides, chosen: &Chosen::default() };
                let sections = read_sections(root.get_ref(), reading, &mut report);
                build(&sections, folder, &mut report)
            });
        match case {
            Some(case) if report.is_clean() => Ok(case),
            _ => Err(report.into_errors()),
        }
    }
}

/// The case or study in the file `path`, which errors call `name`.
pub(super) fn source_of(path: &Path, name: &str) -> Result<Source, CaseErrors> {
    read_text(path, name).map_err(|unreadable| {
        let (source, fault) = *unreadable;
        let mut report = Report::new(source);
        report.add(fault);
        report.into_errors()
    })
}

/// The text of a file, or why it cannot be had, with whatever of it can be shown.
pub(super) fn read_text(path: &Path, name: &str) -> Result<Source, Box<(Source, Fault)>> {
    let source = |text: &str| Source { name: name.into(), text: Arc::from(text) };
    let unreadable = |why: String| {
        let fault = Fault { message: format!("cannot read `{name}`: {why}"), ..Fault::default() };
        Box::new((source(""), fault))
    };
    if path.is_dir() {
        return Err(unreadable("it is a folder, not a file".into()));
    }
    let bytes = std::fs::read(path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => unreadable("there is no such file".into()),
        _ => unreadable(e.to_string()),
    })?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok(source(&text)),
        Err(error) => {
            let start = error.utf8_error().valid_up_to();
            let shown = String::from_utf8_lossy(error.as_bytes());
            let fault = Fault {
                message: format!("`{name}` is not UTF-8 text: byte {} is not part of a character", start + 1),
                span: Some(start..start),
                help: Some("store the file as UTF-8".into()),
                ..Fault::default()
            };
            Err(Box::new((source(&shown), fault)))
        }
    }
}

/// The document, or what TOML itself refuses.
pub(super) fn parse_document<'i>(text: &'i str, report: &mut Report) -> Option<Spanned<DeTable<'i>>> {
    let (document, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        let span = error.span().map(|s| s.start.min(text.len())..s.end.min(text.len()));
        report.add(syntax_fault(text, error.message(), span));
    }
    errors.is_empty().then_some(document)
}

/// A study is no case: an error that says how it is computed.
fn is_no_study(root: &DeTable, report: &mut Report) -> bool {
    let Some((name, _)) = root.get_key_value(STUDY.name) else { return true };
    let file = report.source.name.clone();
    report.add(Fault {
        message: format!(
            "`{}`: this file is a study, which is many cases, where one is wanted",
            STUDY.header()
        ),
        key: Some(STUDY.name.into()),
        span: Some(name.span()),
        help: Some(format!(
            "`railcrack sweep {file}` computes it, `railcrack check {file}` says what it holds"
        )),
        also: None,
    });
    false
}

/// The sections of one case in a document.
pub(super) fn read_sections(root: &DeTable, reading: Reading, report: &mut Report) -> Vec<SectionValues> {
    let end = report.source.text.len();
    let mut sections = Vec::new();
    for section in SECTIONS {
        if section.name.is_empty() {
            sections.push(read_section(section, 1, Some((root, 0..0)), reading, report));
            continue;
        }
        let tables = match root.get_key_value(section.name) {
            None => Vec::new(),
            Some((name, value)) => {
                let Some(tables) = tables(section, name.span(), value, report) else { continue };
                tables
            }
        };
        match (section.presence, tables.as_slice()) {
            (SectionPresence::Required | SectionPresence::Repeated, []) => {
                report.add(Fault {
                    message: format!("`{}` is missing: it has no default", section.header()),
                    key: Some(section.name.into()),
                    span: Some(end..end),
                    help: Some(format!("{} `railcrack init` writes a file to start from", section.doc)),
                    also: None,
                });
            }
            (SectionPresence::Defaulted, []) => {
                sections.push(read_section(section, 1, None, reading, report));
            }
            _ => {
                for (i, (table, span)) in tables.into_iter().enumerate() {
                    sections.push(read_section(section, i + 1, Some((table, span)), reading, report));
                }
            }
        }
    }
    sections
}

/// What TOML itself refuses. A key given twice is named.
fn syntax_fault(text: &str, message: &str, span: Option<Range<usize>>) -> Fault {
    let at = span.clone().and_then(|s| text.get(s)).unwrap_or_default().trim();
    if message.contains("duplicate") {
        return Fault {
            message: format!("`{at}` is given twice"),
            key: Some(at.into()),
            span,
            help: Some("a key or section is written once; only [[crack]] repeats".into()),
            also: None,
        };
    }
    let help = "see https://toml.io for how values, lists and sections are written";
    Fault { message: format!("not TOML: {message}"), span, help: Some(help.into()), ..Fault::default() }
}

/// The tables of a section with their places; an error where it is written as something else.
pub(super) fn tables<'d, 'i>(
    section: &Section,
    name: Range<usize>,
    value: &'d Spanned<DeValue<'i>>,
    report: &mut Report,
) -> Option<Vec<(&'d DeTable<'i>, Range<usize>)>> {
    let repeated = section.presence == SectionPresence::Repeated;
    let found = match value.get_ref() {
        DeValue::Table(table) if !repeated => Some(vec![(table, name.clone())]),
        DeValue::Array(items) if repeated => items
            .iter()
            .map(|item| match item.get_ref() {
                DeValue::Table(table) => Some((table, item.span())),
                _ => None,
            })
            .collect(),
        _ => None,
    };
    if found.is_none() {
        let header = section.header();
        let message = match value.get_ref() {
            DeValue::Table(_) => format!("`[{}]` must be written `{header}`", section.name),
            DeValue::Array(_) if !repeated => {
                format!("`[[{}]]` must be written `{header}`, once", section.name)
            }
            _ => format!("`{}` must be a section `{header}`", section.name),
        };
        report.add(Fault {
            message,
            key: Some(section.name.into()),
            span: Some(name),
            help: Some(section.doc.into()),
            also: None,
        });
    }
    found
}

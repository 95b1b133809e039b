//! From a file to its sections.

use super::accept::point_for_comma;
use super::declaration::{FileSchema, Section, SectionPresence};
use super::error::{CaseErrors, Fault, Quoting, Report, Source};
use super::reading::Reading;
use super::section::read_section;
use super::sections::{SectionValues, Sections};
use crate::regular_file::open_regular;
use std::io::{ErrorKind, Read};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text of the file `path`.
///
/// Errors: it cannot be read, or is not text.
pub(crate) fn read_file(path: &Path) -> Result<Source, CaseErrors> {
    read_text(path, &path.display().to_string()).map_err(|unreadable| {
        let (source, fault) = *unreadable;
        let mut report = Report::new(source);
        report.add(fault);
        report.into_errors()
    })
}

/// The text of the file `path`.
///
/// Errors: it cannot be read, or is not text.
pub fn read_text_file(path: &Path) -> Result<String, CaseErrors> {
    Ok(read_file(path)?.text.to_string())
}

/// Reads the file `path` with `parse(text, name, folder)`: errors name it by its path, and relative
/// file names in it are relative to its folder.
///
/// Errors: the file cannot be read, or is not text; those of `parse`.
pub(crate) fn from_file<T>(
    path: &Path,
    parse: impl FnOnce(&str, &str, &Path) -> Result<T, CaseErrors>,
) -> Result<T, CaseErrors> {
    let source = read_file(path)?;
    parse(&source.text, &source.name, path.parent().unwrap_or(Path::new("")))
}

/// Maximum size (bytes) of a case, a study or a profile: enough for a hundred thousand rows of a
/// profile.
pub(crate) const MOST_TEXT: u64 = 4 << 20;

/// Help where a file is larger.
pub(crate) const SMALLER: &str = "leave out columns, digits and rows that are not read";

/// The bytes of a regular file of at most `most` bytes.
///
/// Errors: those of [`open_regular`]; a file that is larger.
pub(crate) fn read_bytes(path: &Path, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let says = format!("it is larger than {} MB, the limit for such a file", most >> 20);
        return Err(std::io::Error::new(ErrorKind::FileTooLarge, says));
    }
    Ok(bytes)
}

/// The text of a file, which errors call `name`; or why it cannot be had, with the part that can be
/// shown.
pub(crate) fn read_text(path: &Path, name: &str) -> Result<Source, Box<(Source, Fault)>> {
    let source = |text: &str| Source::new(name, text);
    let unreadable = |why: String| Box::new((source(""), Fault::new(format!("cannot read `{name}`: {why}"))));
    let bytes = read_bytes(path, MOST_TEXT).map_err(|e| match e.kind() {
        ErrorKind::FileTooLarge => {
            let mut large = unreadable(e.to_string());
            large.1.help = Some(SMALLER.into());
            large
        }
        ErrorKind::NotFound => {
            let mut missing = unreadable("there is no such file".into());
            missing.1.help = similar_file(path).map(|name| format!("nearest: `{name}`"));
            missing
        }
        _ => unreadable(e.to_string()),
    })?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok(source(&text)),
        Err(error) => {
            let start = error.utf8_error().valid_up_to();
            let shown = String::from_utf8_lossy(error.as_bytes());
            let fault = Fault {
                message: format!(
                    "`{name}` is not UTF-8 text: byte {} is not part of a valid character",
                    start + 1
                ),
                span: Some(start..start),
                help: Some("save the file as UTF-8".into()),
                ..Fault::default()
            };
            // Whatever it is, it is not a file of this program.
            Err(Box::new((source(&shown).hidden(), fault)))
        }
    }
}

/// Likeness (Jaro and Winkler) of two file names from which one is suggested for the other.
const ALIKE: f64 = 0.9;
/// Maximum number of files of a folder that are looked at.
const MOST_FILES: usize = 1000;

/// The file in the folder of `path` whose name is most similar, as `path` would name it.
fn similar_file(path: &Path) -> Option<String> {
    let given = path.file_name()?.to_str()?.to_lowercase();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let names = std::fs::read_dir(folder).ok()?.take(MOST_FILES);
    let names = names.filter_map(|entry| {
        let entry = entry.ok()?;
        entry.file_type().ok()?.is_file().then(|| entry.file_name().into_string().ok())?
    });
    let likeness = |name: &String| strsim::jaro_winkler(&given, &name.to_lowercase());
    let all = names.map(|name| (likeness(&name), name)).filter(|(likeness, _)| *likeness >= ALIKE);
    // The order of a folder is that of the system: of equals the first by name.
    let best = all.reduce(|best, next| {
        let is_better = next.0 > best.0 || (next.0 == best.0 && next.1 < best.1);
        if is_better { next } else { best }
    });
    Some(path.with_file_name(best?.1).display().to_string())
}

impl Source {
    /// The text of a file described by `file`; errors show its lines only if one of them has a
    /// section of that kind of file.
    pub fn of_file(name: &str, text: &str, file: &FileSchema) -> Self {
        let source = Self::new(name, text);
        if text.lines().any(|line| has_section(line, file)) { source } else { source.hidden() }
    }
}

/// Whether `line` is the header of a section of `file`, or has a value of one of its keys outside
/// of sections.
fn has_section(line: &str, file: &FileSchema) -> bool {
    let line = line.trim_start_matches('\u{feff}').trim_start();
    let in_header = line.trim_start_matches('[').trim_start();
    let end = in_header.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    let (name, rest) = in_header.split_at(end.unwrap_or(in_header.len()));
    let follows = rest.trim_start().chars().next();
    let is_section = file.sections.iter().chain(file.beside).any(|section| section.name == name);
    let at_top =
        || file.sections.iter().any(|section| section.name.is_empty() && section.key(name).is_some());
    match line.starts_with('[') {
        true => is_section && !name.is_empty(),
        false => matches!(follows, Some('=' | '.')) && !name.is_empty() && (is_section || at_top()),
    }
}

/// Maximum number of reported places in a file that is not TOML: the first few show the cause.
const MOST_SYNTAX_ERRORS: usize = 1000;

/// The document; none if it is not TOML; errors are added to `report`.
pub(crate) fn parse_document<'i>(text: &'i str, report: &mut Report) -> Option<Spanned<DeTable<'i>>> {
    let says_something = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    if report.source.quoting == Quoting::Hidden && text.lines().any(says_something) {
        // Messages about its keys would show what it holds.
        let name = &report.source.name;
        let says = format!("`{name}` is a file of another kind: none of its lines begins a known section");
        return report
            .refuse(Fault::new(says).help("a known section begins a line, as in [section] or [[section]]"));
    }
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut places = Vec::new();
    for error in errors.iter().take(MOST_SYNTAX_ERRORS) {
        // All unclosed brackets are reported at the same place.
        if places.contains(&error.span()) {
            continue;
        }
        places.push(error.span());
        let span = error.span().map(|s| s.start.min(text.len())..s.end.min(text.len()));
        report.add(syntax_fault(text, error.message(), span));
    }
    errors.is_empty().then_some(document)
}

/// The sections of a document.
pub(crate) fn read_sections(root: &DeTable, reading: Reading, report: &mut Report) -> Sections {
    let end = report.source.text.len();
    let mut sections = Vec::new();
    for section in reading.file.sections {
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
        let replaced = section.instead.is_some_and(|other| root.get_key_value(other).is_some());
        if tables.is_empty() && section.must_be_written() && !replaced {
            let message = format!("`{}` is missing: it has no default", section.header());
            let help = format!("{} {}", section.doc, reading.file.start);
            report.add(Fault::of(section.name, end..end, message).help(help));
        }
        let repeats = matches!(section.presence, SectionPresence::Repeated | SectionPresence::Several);
        let is_given = reading.overrides_in(section.name) && !repeats;
        if repeats {
            reading.overrides_beyond(section.name, tables.len()).for_each(|given| {
                let says = format!("`{}`: the file has no such `{}`", given.shown, section.header());
                report.add_to_command_line(Fault::new(says).help(format!("it has {}", tables.len())));
            });
        }
        if tables.is_empty() && (section.presence == SectionPresence::Defaulted || is_given) {
            sections.push(read_section(section, 1, None, reading, report));
        }
        for (i, table) in tables.into_iter().enumerate() {
            let parts = table.0;
            sections.push(read_section(section, i + 1, Some(table), reading, report));
            for part in section.parts {
                sections.extend(read_part(part, i + 1, parts, reading, report));
            }
        }
    }
    Sections(sections)
}

/// The section `part` within a table, `number` from 1.
fn read_part(
    part: &'static Section,
    number: usize,
    table: &DeTable,
    reading: Reading,
    report: &mut Report,
) -> Option<SectionValues> {
    let own = part.own_name();
    let outer = part.name.strip_suffix(own).unwrap_or_default().trim_end_matches('.');
    let path = format!("{outer}[{number}].{own}");
    match table.get_key_value(own).map(|(name, value)| (name.span(), value.get_ref())) {
        Some((span, DeValue::Table(given))) => {
            Some(read_section(part, number, Some((given, span)), reading, report))
        }
        Some((span, DeValue::Boolean(false))) if part.off.is_some() => SectionValues::off(part, path, span),
        Some((span, _)) => {
            let or = if part.off.is_some() { " or `false`" } else { "" };
            let message = format!("`{path}` must be a section `[{}]`{or}", part.name);
            report.refuse(Fault::of(path, span, message).help(part.doc))
        }
        None if part.must_be_written() && !part.instead.is_some_and(|key| table.contains_key(key)) => {
            let end = report.source.text.len();
            let message = format!("`{path}` is missing: it has no default");
            report.refuse(Fault::of(path, end..end, message).help(part.doc))
        }
        None => None,
    }
}

/// A refusal of TOML itself; a key given twice is named.
fn syntax_fault(text: &str, message: &str, span: Option<Range<usize>>) -> Fault {
    let at = span.clone().and_then(|s| text.get(s)).unwrap_or_default().trim();
    if message.contains("duplicate") {
        let help = "a key or a section [name] is written once; only a section [[name]] repeats";
        return Fault {
            key: Some(at.into()),
            span,
            ..Fault::new(format!("`{at}` is given twice")).help(help)
        };
    }
    let help = slip_of(text, span.as_ref().map_or(0, |span| span.start))
        .unwrap_or_else(|| "see https://toml.io for how values, lists and sections are written".into());
    Fault { span, ..Fault::new(format!("invalid TOML: {message}")).help(help) }
}

/// A slip in the line of the byte `at` that TOML does not name: a decimal comma, a semicolon at the
/// end.
fn slip_of(text: &str, at: usize) -> Option<String> {
    let start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text.get(start..)?.lines().next()?;
    let value = line.split_once('=')?.1.split('#').next()?.trim();
    let without = value.trim_end_matches(';').trim();
    if without.len() < value.len() {
        let value = point_for_comma(without).unwrap_or_else(|| without.to_owned());
        return Some(format!("no semicolon ends a line, and each key has a line of its own: {value}"));
    }
    point_for_comma(value).map(|number| format!("numbers have a decimal point, not a comma: {number}"))
}

/// The tables of a section with their places; an error where it is written as something else.
pub(crate) fn tables<'d, 'i>(
    section: &Section,
    name: Range<usize>,
    value: &'d Spanned<DeValue<'i>>,
    report: &mut Report,
) -> Option<Vec<(&'d DeTable<'i>, Range<usize>)>> {
    let repeated = section.repeats();
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
        report.add(Fault::of(section.name, name, message).help(section.doc));
    }
    found
}

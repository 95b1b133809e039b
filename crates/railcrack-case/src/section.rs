//! One section of a file against its declaration.

use super::accept::{Raw, Value};
use super::chosen::Reading;
use super::error::{Fault, Report};
use super::overrides::Overrides;
use super::sections::SECTIONS;
use super::study::STUDY;
use super::suggest::nearest;
use super::table::{Form, Key, Presence, Section, SectionPresence};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The accepted values of one section.
#[derive(Debug, Clone)]
pub(super) struct SectionValues {
    pub section: &'static Section,
    /// Its dotted name in messages: `rail`, `crack[2]`.
    pub path: String,
    /// Where it stands in the file.
    pub span: Range<usize>,
    entries: Vec<Entry>,
    /// Keys whose value was given but not accepted.
    refused: Vec<&'static str>,
}

/// One accepted value.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub key: &'static Key,
    pub value: Value,
    /// Where it stands; none for defaults and for the command line.
    pub span: Option<Range<usize>>,
    /// Where its points stand.
    pub parts: Vec<Range<usize>>,
}

impl SectionValues {
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|e| e.key.name == key)
    }

    /// Whether `key` was given a value that was not accepted: nothing more can be said about it.
    pub fn is_refused(&self, key: &str) -> bool {
        self.refused.contains(&key)
    }

    /// Where `key` stands, or the section where it does not.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entry(key).and_then(|e| e.span.clone()).unwrap_or(self.span.clone())
    }

    pub fn number(&self, key: &str) -> Option<f64> {
        match self.entry(key)?.value {
            Value::Number(x) => Some(x),
            _ => None,
        }
    }

    pub fn integer(&self, key: &str) -> Option<u64> {
        match self.entry(key)?.value {
            Value::Integer(n) => Some(n),
            _ => None,
        }
    }

    pub fn numbers(&self, key: &str) -> Option<&[f64]> {
        match &self.entry(key)?.value {
            Value::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }

    pub fn text(&self, key: &str) -> Option<&str> {
        match &self.entry(key)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Key and value in the order of the declaration.
    pub fn values(&self) -> Vec<(&'static str, Value)> {
        let order = |e: &&Entry| self.section.keys.iter().position(|k| k.name == e.key.name);
        let mut entries: Vec<&Entry> = self.entries.iter().collect();
        entries.sort_by_key(order);
        entries.iter().map(|e| (e.key.name, e.value.clone())).collect()
    }

    pub fn dotted(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }
}

/// Reads one table as `section`, `number` counting repeated sections from 1.
pub(super) fn read_section(
    section: &'static Section,
    number: usize,
    table: Option<(&DeTable, Range<usize>)>,
    reading: Reading,
    report: &mut Report,
) -> SectionValues {
    let overrides = reading.overrides;
    let path = match section.presence {
        SectionPresence::Repeated => format!("{}[{number}]", section.name),
        _ => section.name.to_string(),
    };
    let span = table.as_ref().map_or(0..0, |(_, span)| span.clone());
    let mut read = SectionValues { section, path, span, entries: Vec::new(), refused: Vec::new() };
    let mut given: Vec<(&'static Key, Range<usize>)> = Vec::new();
    for (name, value) in table.iter().flat_map(|(table, _)| table.iter()) {
        let is_section =
            |s: &&Section| section.name.is_empty() && !s.name.is_empty() && s.name == name.get_ref();
        if SECTIONS.iter().chain([&STUDY]).any(|s| is_section(&s)) {
            continue;
        }
        match section.key(name.get_ref()) {
            Some(key) if overrides.of(section.name, key.name).is_none() => {
                given.push((key, name.span()));
                read_value(&mut read, key, reading.chosen.of(value), report);
            }
            Some(_) => (),
            None => {
                let shown = shown(report, &value.span());
                report.add(unknown_key(&read, name, value, &shown));
            }
        }
    }
    given.sort_by_key(|(_, span)| span.start);
    for key in section.keys {
        if let Some((option, raw)) = overrides.of(section.name, key.name) {
            given.push((key, 0..0));
            match key.kind.accept(&raw) {
                Ok(value) => read.entries.push(Entry { key, value, span: None, parts: Vec::new() }),
                Err(refusal) => report.add(Fault {
                    message: format!("`{option} {}`: {}", Overrides::shown(&raw), refusal.message),
                    key: Some(read.dotted(key.name)),
                    help: refusal.help,
                    ..Fault::default()
                }),
            }
        }
    }
    fill(&mut read, &given, report);
    read
}

fn read_value(read: &mut SectionValues, key: &'static Key, value: &Spanned<DeValue>, report: &mut Report) {
    let raw = Raw::read(value.get_ref());
    match key.kind.accept(&raw) {
        Ok(value_read) => {
            let parts = match raw {
                Raw::List(items) => items.into_iter().map(|(_, span)| span).collect(),
                _ => Vec::new(),
            };
            read.entries.push(Entry { key, value: value_read, span: Some(value.span()), parts });
        }
        Err(refusal) => {
            read.refused.push(key.name);
            let dotted = read.dotted(key.name);
            let shown = shown(report, &value.span());
            report.add(Fault {
                message: format!("`{dotted} = {shown}`: {}", refusal.message),
                key: Some(dotted),
                span: Some(refusal.part.unwrap_or(value.span())),
                help: refusal.help,
                ..Fault::default()
            });
        }
    }
}

/// The value as written, shortened to a line.
pub(super) fn shown(report: &Report, span: &Range<usize>) -> String {
    let text = report.source.text.get(span.clone()).unwrap_or_default();
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() > 60 { format!("{}…", line.chars().take(59).collect::<String>()) } else { line }
}

fn unknown_key(
    read: &SectionValues,
    name: &Spanned<std::borrow::Cow<str>>,
    value: &Spanned<DeValue>,
    shown: &str,
) -> Fault {
    let given = name.get_ref();
    let section = read.section;
    let sections = SECTIONS.iter().map(|s| s.name).filter(|s| !s.is_empty());
    let keys = section.keys.iter().map(|k| k.name);
    let is_table = match value.get_ref() {
        DeValue::Table(_) => true,
        DeValue::Array(items) => items.iter().any(|i| matches!(i.get_ref(), DeValue::Table(_))),
        _ => false,
    };
    if section.name.is_empty() && is_table {
        let known: Vec<String> = SECTIONS.iter().map(Section::header).filter(|h| !h.is_empty()).collect();
        let near = nearest(given, sections).unwrap_or_default();
        return Fault {
            message: format!("unknown section `{given}`"),
            key: Some(given.to_string()),
            span: Some(name.span()),
            help: Some(format!("nearest known section: `{near}`; known: {}", known.join(", "))),
            also: None,
        };
    }
    let elsewhere: Vec<String> =
        SECTIONS.iter().filter(|s| s.key(given).is_some()).map(Section::header).collect();
    let help = if !elsewhere.is_empty() {
        format!("`{given}` is a key of {}", elsewhere.join(" and "))
    } else if section.name.is_empty() {
        let all = SECTIONS.iter().flat_map(|s| s.keys.iter().map(move |k| (s, k)));
        let near = nearest(given, all.clone().map(|(_, k)| k.name)).unwrap_or_default();
        let owner = all.clone().find(|(_, k)| k.name == near).map(|(s, _)| s.header()).unwrap_or_default();
        format!(
            "nearest known key: `{near}`, of {}",
            if owner.is_empty() { "the top of the file" } else { &owner }
        )
    } else {
        let known: Vec<&str> = keys.clone().collect();
        let near = nearest(given, keys).unwrap_or_default();
        format!("nearest known key: `{near}`; {} knows {}", section.header(), known.join(", "))
    };
    Fault {
        message: format!("`{} = {shown}`: unknown key", read.dotted(given)),
        key: Some(read.dotted(given)),
        span: Some(name.span()),
        help: Some(help),
        also: None,
    }
}

/// Chooses the form, refuses what does not go together, fills in the defaults, names what is missing.
fn fill(read: &mut SectionValues, given: &[(&'static Key, Range<usize>)], report: &mut Report) {
    let section = read.section;
    let form = choose_form(read, given, report);
    let in_a_form = |key: &Key| section.forms.iter().any(|f| f.keys.contains(&key.name));
    for key in section.keys {
        if let Some((_, span)) = given.iter().find(|(k, _)| k.name == key.name) {
            if let Some(with) = key.only_with
                && read.text(with.key).is_some_and(|chosen| chosen != with.choice)
            {
                report.add(Fault {
                    message: format!("`{}` needs {} = \"{}\"", read.dotted(key.name), with.key, with.choice),
                    key: Some(read.dotted(key.name)),
                    span: Some(span.clone()),
                    help: Some(format!("a half-plane has no supports: leave `{}` out", key.name)),
                    also: None,
                });
            }
            continue;
        }
        if in_a_form(key) && !form.is_some_and(|f| f.keys.contains(&key.name)) {
            continue;
        }
        let wanted = key.only_with.is_none_or(|with| read.text(with.key) == Some(with.choice));
        match key.presence {
            Presence::Default(preset) if wanted => {
                read.entries.push(Entry { key, value: preset.into(), span: None, parts: Vec::new() });
            }
            Presence::Required(_) => report.add(Fault {
                message: format!(
                    "`{}` is missing: it must be {}",
                    read.dotted(key.name),
                    key.kind.accepted()
                ),
                key: Some(read.dotted(key.name)),
                span: Some(read.span.clone()),
                help: Some(key.doc.into()),
                also: None,
            }),
            _ => (),
        }
    }
}

/// The one form that the given keys belong to; an error where they belong to two or none.
fn choose_form(
    read: &SectionValues,
    given: &[(&'static Key, Range<usize>)],
    report: &mut Report,
) -> Option<&'static Form> {
    let section = read.section;
    if section.forms.is_empty() {
        return None;
    }
    let of_form = |form: &Form| given.iter().find(|(k, _)| form.keys.contains(&k.name));
    let used: Vec<&'static Form> = section.forms.iter().filter(|f| of_form(f).is_some()).collect();
    let needs_one = section.forms.iter().any(|form| !required_keys(section, form).is_empty());
    match used.as_slice() {
        [form] => Some(form),
        [] if !needs_one => None,
        [] => {
            let ways: Vec<String> = section.forms.iter().map(|f| required_keys(section, f)).collect();
            report.add(Fault {
                message: format!("`{}` needs {}", read.path, ways.join(", or ")),
                key: Some(read.path.clone()),
                span: Some(read.span.clone()),
                help: None,
                also: None,
            });
            None
        }
        [first, second, ..] => {
            if let (Some((a, a_span)), Some((b, b_span))) = (of_form(first), of_form(second)) {
                let (early, late) = if a_span.start < b_span.start {
                    ((a, a_span), (b, b_span))
                } else {
                    ((b, b_span), (a, a_span))
                };
                let value = read.entry(late.0.name).and_then(|e| e.span.as_ref());
                let value = value.map_or(String::new(), |span| format!(" = {}", shown(report, span)));
                report.add(Fault {
                    message: format!(
                        "`{}{value}` says the same thing as `{}`: give one or the other",
                        read.dotted(late.0.name),
                        early.0.name
                    ),
                    key: Some(read.dotted(late.0.name)),
                    span: Some(late.1.clone()),
                    help: needs_one.then(|| {
                        format!(
                            "either {} or {}",
                            required_keys(section, first),
                            required_keys(section, second)
                        )
                    }),
                    also: Some((early.1.clone(), "given here")),
                });
            }
            None
        }
    }
}

fn required_keys(section: &Section, form: &Form) -> String {
    let names: Vec<String> = form
        .keys
        .iter()
        .filter(|n| section.key(n).is_some_and(|k| matches!(k.presence, Presence::Required(_))))
        .map(|n| format!("`{n}`"))
        .collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

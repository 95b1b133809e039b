//! Reading of one section against its declaration.

use super::accept::Raw;
use super::declaration::{Key, OnlyWith, Presence, Section};
use super::error::{Fault, Report};
use super::forms::{check_pairs, choose_form};
use super::reading::Reading;
use super::sections::{Entry, SectionValues};
use super::suggest::nearest;
use super::units::guess;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads one table as `section`, `number` counting repeated sections from 1.
pub(crate) fn read_section(
    section: &'static Section,
    number: usize,
    table: Option<(&DeTable, Range<usize>)>,
    reading: Reading,
    report: &mut Report,
) -> SectionValues {
    let (file, before) = (reading.file, report.count());
    let path = section.path(number);
    let span = table.as_ref().map_or(0..0, |(_, span)| span.clone());
    let mut read = SectionValues { section, path, span, entries: Vec::new(), refused: Vec::new() };
    let mut given: Vec<(&'static Key, Range<usize>)> = Vec::new();
    let mut varied: Vec<(&'static str, Vec<&str>)> = Vec::new();
    for (name, value) in table.iter().flat_map(|(table, _)| table.iter()) {
        let is_section =
            |s: &&Section| section.name.is_empty() && !s.name.is_empty() && s.name == name.get_ref();
        let is_part = section.parts.iter().any(|part| part.own_name() == name.get_ref());
        if is_part || file.sections.iter().chain(file.beside).any(|s| is_section(&s)) {
            continue;
        }
        match section.key(name.get_ref()) {
            Some(key) if reading.override_of(section.name, number, key.name).is_none() => {
                given.push((key, name.span()));
                let chosen = reading.chosen.of(value);
                if chosen.span() != value.span() {
                    varied.push((key.name, words(value)));
                }
                read_value(&mut read, key, chosen, file.list, report);
            }
            Some(key) => {
                // An option replaces this value, but it is checked like any other.
                let mut replaced = SectionValues { entries: Vec::new(), refused: Vec::new(), ..read.clone() };
                read_value(&mut replaced, key, reading.chosen.of(value), file.list, report);
            }
            None => {
                let shown = report.shown(&value.span());
                report.add(unknown_key(&read, name, value, &shown, file.sections));
            }
        }
    }
    given.sort_by_key(|(_, span)| span.start);
    read_overrides(&mut read, &mut given, number, reading, report);
    leave_out_of_runs(&mut read, &mut given, &varied);
    fill(&mut read, &given, reading, report);
    // A section of the command line alone has no place in the file.
    let only = reading.overrides.iter().find(|given| given.section == section.name && given.value.is_some());
    if let (None, Some(only)) = (table, only) {
        report.move_to_command_line(before, &only.shown);
    }
    read
}

/// Reads the values that the command line gives instead of those of the table.
fn read_overrides(
    read: &mut SectionValues,
    given: &mut Vec<(&'static Key, Range<usize>)>,
    number: usize,
    reading: Reading,
    report: &mut Report,
) {
    let section = read.section;
    for key in section.keys {
        let Some(given_instead) = reading.override_of(section.name, number, key.name) else { continue };
        let Some(instead) = &given_instead.value else { continue };
        given.push((key, 0..0));
        match key.kind.accept(instead, reading.file.list) {
            Ok(value) => {
                read.entries.push(Entry { key, value, span: None, parts: Vec::new(), is_given: true })
            }
            Err(refusal) => {
                let fault = Fault {
                    key: Some(read.dotted(key.name)),
                    help: refusal.help.or_else(|| guess(key, instead.number()?)),
                    ..Fault::new(format!("`{}`: {}", given_instead.shown, refusal.message))
                };
                report.add_to_command_line(fault);
            }
        }
    }
}

/// The words of a list.
fn words<'d>(value: &'d Spanned<DeValue>) -> Vec<&'d str> {
    let items = value.get_ref().as_array();
    items.into_iter().flat_map(|items| items.iter()).filter_map(|item| item.get_ref().as_str()).collect()
}

/// Removes keys that belong to a word of a list other than the chosen one: in a study that varies
/// this word they apply to other runs. `varied` are the keys with lists of words.
fn leave_out_of_runs(
    read: &mut SectionValues,
    given: &mut Vec<(&'static Key, Range<usize>)>,
    varied: &[(&'static str, Vec<&str>)],
) {
    let is_for_others = |key: &Key| {
        key.only_with.is_some_and(|with| {
            let words = varied.iter().find(|(name, _)| *name == with.key).map(|(_, words)| words);
            let in_others = words.is_some_and(|words| words.iter().any(|word| with.admits(word)));
            in_others && read.named(with.key).is_some_and(|other| !other.is_admitted(&with))
        })
    };
    let names: Vec<&str> =
        given.iter().map(|(key, _)| *key).filter(|key| is_for_others(key)).map(|key| key.name).collect();
    given.retain(|(key, _)| !names.contains(&key.name));
    read.entries.retain(|entry| !names.contains(&entry.key.name));
}

fn read_value(
    read: &mut SectionValues,
    key: &'static Key,
    value: &Spanned<DeValue>,
    list: &'static str,
    report: &mut Report,
) {
    let raw = Raw::read(value.get_ref());
    match key.kind.accept(&raw, list) {
        Ok(value_read) => {
            let parts = match raw {
                Raw::List(items) => items.into_iter().map(|(_, span)| span).collect(),
                _ => Vec::new(),
            };
            let span = Some(value.span());
            read.entries.push(Entry { key, value: value_read, span, parts, is_given: true });
        }
        Err(refusal) => {
            read.refused.push(key.name);
            let dotted = read.dotted(key.name);
            let shown = report.shown(&value.span());
            let span = refusal.part.unwrap_or(value.span());
            let message = format!("`{dotted} = {shown}`: {}", refusal.message);
            let help = refusal.help.or_else(|| guess(key, raw.number()?));
            report.add(Fault { help, ..Fault::of(dotted, span, message) });
        }
    }
}

fn unknown_key(
    read: &SectionValues,
    name: &Spanned<std::borrow::Cow<str>>,
    value: &Spanned<DeValue>,
    shown: &str,
    sections: &[Section],
) -> Fault {
    let given: &str = name.get_ref();
    let section = read.section;
    let is_table = match value.get_ref() {
        DeValue::Table(_) => true,
        DeValue::Array(items) => items.iter().any(|i| matches!(i.get_ref(), DeValue::Table(_))),
        _ => false,
    };
    if section.name.is_empty() && is_table {
        let named = sections.iter().filter(|s| !s.name.is_empty());
        let known: Vec<String> = named.clone().map(Section::header).collect();
        let near = nearest(given, named.map(|s| s.name)).unwrap_or_default();
        return Fault::of(given, name.span(), format!("unknown section `{given}`"))
            .help(format!("nearest known section: `{near}`; known: {}", known.join(", ")));
    }
    let headers_with = |key: &str| -> Vec<String> {
        sections.iter().filter(|s| s.key(key).is_some()).map(Section::header).collect()
    };
    let elsewhere = headers_with(given);
    let help = if !elsewhere.is_empty() {
        format!("`{given}` is a key of {}", elsewhere.join(" and "))
    } else if section.name.is_empty() {
        let near = nearest(given, sections.iter().flat_map(|s| s.keys).map(|k| k.name)).unwrap_or_default();
        let owner = headers_with(near).into_iter().next().filter(|header| !header.is_empty());
        format!("nearest known key: `{near}`, of {}", owner.as_deref().unwrap_or("the top of the file"))
    } else {
        let known: Vec<&str> = section.keys.iter().map(|k| k.name).collect();
        let near = nearest(given, known.iter().copied()).unwrap_or_default();
        format!("nearest known key: `{near}`; {} has {}", section.header(), known.join(", "))
    };
    let dotted = read.dotted(given);
    let message = format!("`{dotted} = {shown}`: unknown key");
    Fault::of(dotted, name.span(), message).help(help)
}

/// Chooses the form, refuses conflicting keys, fills in the defaults and reports missing keys.
fn fill(
    read: &mut SectionValues,
    given: &[(&'static Key, Range<usize>)],
    reading: Reading,
    report: &mut Report,
) {
    let section = read.section;
    let form = choose_form(read, given, report);
    for key in section.keys {
        let dotted = read.dotted(key.name);
        if let Some((_, span)) = given.iter().find(|(k, _)| k.name == key.name) {
            if let Some(with) = key.only_with
                && read.named(with.key).is_some_and(|other| !other.is_admitted(&with))
            {
                let message = format!("`{dotted}` needs {}", with.shown());
                let help = format!("{}: leave `{}` out", with.otherwise, key.name);
                report.add(Fault::of(dotted, span.clone(), message).help(help));
            }
            continue;
        }
        if section.is_in_a_form(key) && !form.is_some_and(|f| f.keys.contains(&key.name)) {
            continue;
        }
        let has = |with: &OnlyWith| read.named(with.key).is_some_and(|other| other.is_admitted(with));
        let wanted = key.only_with.is_none_or(|with| has(&with));
        let excused = key.excused.is_some_and(|with| has(&with));
        match key.presence {
            Presence::Default(preset) if wanted => {
                let preset = reading.default_of(section.name, key.name).unwrap_or(preset);
                let value = preset.into();
                read.entries.push(Entry { key, value, span: None, parts: Vec::new(), is_given: false });
            }
            Presence::Required(_) if wanted && !excused => {
                let message = format!("`{dotted}` is missing: it must be {}", key.kind.accepted());
                report.add(Fault::of(dotted, read.span.clone(), message).help(key.doc));
            }
            _ => (),
        }
    }
    check_pairs(read, |name| given.iter().any(|(key, _)| key.name == name), report);
}

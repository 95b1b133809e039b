//! Keys that belong together, and keys that exclude each other.

use super::declaration::{Form, Key, Presence, Preset, Section};
use super::error::{Fault, Report};
use super::sections::SectionValues;
use super::value::Value;
use std::ops::Range;

/// A key as given, and its place.
type Given = (&'static Key, Range<usize>);

/// The one form that the given keys belong to; an error where they belong to two or none. Forms
/// with keys that another key's choice rules out are not counted.
pub(super) fn choose_form(
    read: &SectionValues,
    given: &[Given],
    report: &mut Report,
) -> Option<&'static Form> {
    let section = read.section;
    let open: Vec<&'static Form> = section.forms.iter().filter(|form| is_open(read, form)).collect();
    let forms_of = |name: &str| open.iter().filter(|form| form.admits(name)).count();
    // A key of several forms chooses none of them.
    let own = |form: &Form| given.iter().find(|(k, _)| form.admits(k.name) && forms_of(k.name) == 1);
    let used: Vec<(&'static Form, &Given)> =
        open.iter().filter_map(|form| Some((*form, own(form)?))).collect();
    let needs_one = open.iter().any(|form| !required_keys(section, form).is_empty());
    match used.as_slice() {
        [(form, one)] => {
            let stray = given.iter().find(|(k, _)| forms_of(k.name) > 0 && !form.admits(k.name));
            let Some(stray) = stray else { return Some(form) };
            let other = open.iter().find(|form| form.admits(stray.0.name))?;
            let fault = said_twice(read, [(form, one), (other, stray)], report);
            report.refuse(fault)
        }
        [] if !needs_one => None,
        [] => {
            let ways: Vec<String> = open.iter().map(|f| required_keys(section, f)).collect();
            let message = format!("`{}` needs {}", read.path, ways.join(", or "));
            report.refuse(Fault::of(read.path.clone(), read.span.clone(), message))
        }
        [(first, one), (second, other), ..] => {
            let fault = said_twice(read, [(first, one), (second, other)], report);
            report.refuse(fault)
        }
    }
}

/// Whether no key of `form` is ruled out by the choice of another key.
fn is_open(read: &SectionValues, form: &Form) -> bool {
    let chosen = |name: &str| match read.named(name).map(|entry| &entry.value) {
        Some(Value::Text(word)) => Some(word.clone()),
        _ => match read.section.key(name).filter(|key| !read.has_refused(key))?.presence {
            Presence::Default(Preset::Text(word)) => Some(word.into()),
            _ => None,
        },
    };
    let keys = form.keys.iter().filter_map(|name| read.section.key(name)?.only_with);
    keys.into_iter().all(|with| chosen(with.key).is_none_or(|word| with.admits(&word)))
}

/// Two keys of two forms.
fn said_twice(read: &SectionValues, [first, second]: [(&Form, &Given); 2], report: &Report) -> Fault {
    let section = read.section;
    let (early, late) =
        if first.1.1.start < second.1.1.start { (first.1, second.1) } else { (second.1, first.1) };
    let value = read.named(late.0.name).and_then(|e| e.span.as_ref());
    let value = value.map_or(String::new(), |span| format!(" = {}", report.shown(span)));
    let dotted = read.dotted(late.0.name);
    let early_name = early.0.name;
    let message = format!("`{dotted}{value}` says the same thing as `{early_name}`: give one or the other");
    let ways = [first.0, second.0].map(|form| required_keys(section, form));
    let help = ways.iter().all(|way| !way.is_empty()).then(|| format!("either {}", ways.join(" or ")));
    let fault = Fault::of(dotted, late.1.clone(), message).also(early.1.clone(), "given here");
    Fault { help, ..fault }
}

fn required_keys(section: &Section, form: &Form) -> String {
    let is_required = |name: &&&str| section.key(name).is_some_and(Key::is_required);
    let names: Vec<String> = form.keys.iter().filter(is_required).map(|n| format!("`{n}`")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// Reports a key without its counterpart ([`Pair`](super::Pair)); `is_given` tests whether a key is
/// given.
pub(super) fn check_pairs(read: &SectionValues, is_given: impl Fn(&str) -> bool, report: &mut Report) {
    for (key, pair) in read.section.keys.iter().filter_map(|key| Some((key, key.pair?))) {
        let default = read.section.key(pair.key).map(|other| other.presence.preset());
        let (Some(other), Some(Preset::Integer(default))) = (read.named(pair.key), default) else { continue };
        let (missing, there) = match read.named(key.name) {
            Some(this) if !is_given(pair.key) => (pair.key, this),
            None if !read.has_refused(key) && other.value != Value::Integer(default) => (key.name, other),
            _ => continue,
        };
        let (missing, needing) = (read.dotted(missing), read.dotted(there.key.name));
        let message = format!("`{missing}` is missing: `{needing} = {}` needs it", there.value);
        let span = there.span.clone().unwrap_or(read.span.clone());
        report.add(Fault::of(missing, span, message).help(pair.help));
    }
}

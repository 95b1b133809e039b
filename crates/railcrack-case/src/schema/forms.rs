//! Keys that go together, and keys that say the same thing.

use super::declaration::{Form, Key, Preset, Section};
use super::error::{Fault, Report};
use super::sections::SectionValues;
use super::value::Value;
use std::ops::Range;

/// A key as given, and where.
type Given = (&'static Key, Range<usize>);

/// The one form that the given keys belong to; an error where they belong to two or none.
pub(super) fn choose_form(
    read: &SectionValues,
    given: &[Given],
    report: &mut Report,
) -> Option<&'static Form> {
    let section = read.section;
    if section.forms.is_empty() {
        return None;
    }
    let of_form = |form: &Form| given.iter().find(|(k, _)| form.keys.contains(&k.name));
    let used: Vec<(&'static Form, &Given)> =
        section.forms.iter().filter_map(|form| Some((form, of_form(form)?))).collect();
    let needs_one = section.forms.iter().any(|form| !required_keys(section, form).is_empty());
    match used.as_slice() {
        [(form, _)] => Some(form),
        [] if !needs_one => None,
        [] => {
            let ways: Vec<String> = section.forms.iter().map(|f| required_keys(section, f)).collect();
            let message = format!("`{}` needs {}", read.path, ways.join(", or "));
            report.add(Fault::of(read.path.clone(), read.span.clone(), message));
            None
        }
        [(first, one), (second, other), ..] => {
            let (early, late) = if one.1.start < other.1.start { (one, other) } else { (other, one) };
            let value = read.named(late.0.name).and_then(|e| e.span.as_ref());
            let value = value.map_or(String::new(), |span| format!(" = {}", report.shown(span)));
            let dotted = read.dotted(late.0.name);
            let early_name = early.0.name;
            let message =
                format!("`{dotted}{value}` says the same thing as `{early_name}`: give one or the other");
            let ways =
                || format!("either {} or {}", required_keys(section, first), required_keys(section, second));
            let help = needs_one.then(ways);
            let fault = Fault::of(dotted, late.1.clone(), message).also(early.1.clone(), "given here");
            report.add(Fault { help, ..fault });
            None
        }
    }
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

/// Reports a key without the one that goes with it ([`Pair`](super::Pair)).
pub(super) fn check_pairs(read: &SectionValues, report: &mut Report) {
    for (key, pair) in read.section.keys.iter().filter_map(|key| Some((key, key.pair?))) {
        let default = read.section.key(pair.key).map(|other| other.presence.preset());
        let (Some(other), Some(Preset::Integer(default))) = (read.named(pair.key), default) else { continue };
        let (missing, there) = match (read.named(key.name), &other.span) {
            (Some(this), None) => (pair.key, this),
            (None, _) if !read.has_refused(key) && other.value != Value::Integer(default) => {
                (key.name, other)
            }
            _ => continue,
        };
        let (missing, needing) = (read.dotted(missing), read.dotted(there.key.name));
        let message = format!("`{missing}` is missing: `{needing} = {}` needs it", there.value);
        let span = there.span.clone().unwrap_or(read.span.clone());
        report.add(Fault::of(missing, span, message).help(pair.help));
    }
}

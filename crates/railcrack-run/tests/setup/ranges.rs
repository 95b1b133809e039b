//! Every key at, just inside and just outside both ends of its range.

use railcrack_case::{
    Case, CaseError, Key, Kind, NumberRange, OnlyWith, Presence, Preset, RangeEnd, SECTIONS, Section,
    SectionPresence,
};
use railcrack_run::setup::RunSize;
use std::path::Path;

/// Values at an end and next to it, and whether the declaration accepts them.
fn values(range: NumberRange) -> Vec<(f64, bool)> {
    let ends = [range.min, range.max].map(|end| match end {
        RangeEnd::Closed(at) | RangeEnd::Open(at) => at,
    });
    let around = |at: f64| [at, at.next_up(), at.next_down()];
    ends.into_iter().flat_map(around).map(|value| (value, range.contains(value))).collect()
}

fn shown(preset: Preset) -> String {
    match preset {
        Preset::Number(value) => format!("{value:e}"),
        Preset::Integer(value) => value.to_string(),
        Preset::Text(text) => format!("{text:?}"),
        Preset::Numbers(values) => format!("{values:?}"),
        Preset::Points(points) => format!("{points:?}"),
        Preset::Groups(groups) => format!("{groups:?}"),
        Preset::Switch(value) => value.to_string(),
    }
}

/// A case with `key = value` in `section`, with the keys that it requires, and an otherwise small
/// problem.
fn case_with(section: &Section, key: &Key, value: &str) -> String {
    let mut text = String::new();
    for written in SECTIONS {
        let is_own = written.name == section.name;
        let needed = is_own || written.must_be_written() || written.name == "mesh";
        if !needed || written.presence == SectionPresence::Optional && !is_own {
            continue;
        }
        text += &format!("{}\n", written.header());
        let own_form = written.forms.iter().find(|form| is_own && form.keys.contains(&key.name));
        let form = own_form.or(written.forms.first()).map_or(&[][..], |form| form.keys);
        for other in written.keys {
            if is_own && other.name == key.name {
                text += &format!("{} = {value}\n", key.name);
                continue;
            }
            let in_form = !written.is_in_a_form(other) || form.contains(&other.name);
            let with = key.only_with.filter(|OnlyWith { key, .. }| is_own && *key == other.name);
            // A key of another choice than that of the key in question means nothing.
            let chosen = |wanted: &OnlyWith| match (key.only_with, written.key(wanted.key)?.presence) {
                (Some(own), _) if is_own && own.key == wanted.key => Some(own.choice),
                (_, Presence::Default(Preset::Text(word))) => Some(word),
                _ => None,
            };
            if other.only_with.is_some_and(|wanted| chosen(&wanted).is_some_and(|word| !wanted.admits(word)))
            {
                continue;
            }
            let paired = is_own
                && (key.pair.is_some_and(|pair| pair.key == other.name)
                    || other.pair.is_some_and(|pair| pair.key == key.name));
            let line = match (other.name, other.presence) {
                ("element_size_mm", _) => "0.5".into(),
                _ if with.is_some() => with.map(|with| format!("{:?}", with.choice)).unwrap_or_default(),
                ("count", _) if paired => "2".into(),
                (_, Presence::Optional(preset)) if paired => shown(preset),
                (_, Presence::Required(preset)) if in_form => shown(preset),
                _ => continue,
            };
            text += &format!("{} = {line}\n", other.name);
        }
    }
    text
}

#[test]
fn ends_of_ranges_are_what_they_are_declared_to_be() {
    let mut tried = 0;
    for section in SECTIONS {
        for key in section.keys {
            let values: Vec<(String, bool)> = match key.kind {
                Kind::Number { range, .. } => values(range)
                    .into_iter()
                    .filter(|(value, _)| value.is_finite())
                    .map(|(value, accepted)| (format!("{value:e}"), accepted))
                    .collect(),
                Kind::Integer { min, max } => [min, min + 1, max - 1, max, max + 1]
                    .into_iter()
                    .chain(min.checked_sub(1))
                    .map(|value| (value.to_string(), (min..=max).contains(&value)))
                    .collect(),
                _ => continue,
            };
            for (value, accepted) in values {
                tried += 1;
                ends_as_declared(section, key, &value, accepted);
            }
        }
    }
    assert!(tried > 150, "{tried}");
}

fn ends_as_declared(section: &Section, key: &Key, value: &str, accepted: bool) {
    let text = case_with(section, key, value);
    let read = Case::parse(&text, "case.toml", Path::new(""));
    let size = read.as_ref().map(RunSize::estimate);
    let about = format!("{} = {value} gives {size:?} for\n{text}", key.name);
    let Err(errors) = &read else {
        assert!(accepted, "{about}");
        return;
    };
    let names = |error: &CaseError| error.key().is_some_and(|name| name.ends_with(key.name));
    let is_out_of_range = errors
        .errors()
        .iter()
        .any(|error| names(error) && error.message().contains(&format!("must be {}", key.kind.accepted())));
    // A value of the range may not go with the others; the error then names one of them.
    assert_eq!(is_out_of_range, !accepted, "{about}");
    assert!(errors.errors().iter().all(|error| error.key().is_some()), "{about}");
}

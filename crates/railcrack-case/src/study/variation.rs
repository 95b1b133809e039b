//! Lists given instead of values.

use super::sampling::{Distribution, is_sampled};
use super::tables::{TableOf, all_tables};
use crate::schema::{Fault, Key, Kind, Override, Raw, Report, Section, Value};
use crate::tables::{CASE_FILE, RUN_FOLDERS, STUDY};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key that varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// Its name with its section: `contact.friction`, `crack[1].angle_deg`.
    pub key: String,
    /// The shortest name that distinguishes it from the other keys that vary: `friction`.
    pub name: String,
    /// Its values in the order of the list; as text where a value is refused.
    pub values: Vec<Value>,
    /// The distribution that they are drawn from; none of a list.
    pub distribution: Option<Distribution>,
    /// Where the list stands.
    pub(super) span: Range<usize>,
    /// Where its elements stand.
    pub(super) elements: Vec<Range<usize>>,
}

/// The lists given instead of values in the document `root`, in the order of the file, names not
/// yet given; and the places of those that are refused; errors are added to `report`.
pub(super) fn find_variations(
    root: &DeTable,
    overrides: &[Override],
    report: &mut Report,
) -> (Vec<Variation>, Vec<Range<usize>>) {
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for TableOf { section, path, table, .. } in all_tables(root) {
        for (name, value) in table {
            let Some(key) = section.key(name.get_ref()) else { continue };
            let dotted = if path.is_empty() { key.name.into() } else { format!("{path}.{}", key.name) };
            let Some(items) = list_in_place(key.kind, value.get_ref()) else { continue };
            if let Some(fault) = fault(section, key, &dotted, value, items, overrides, report) {
                report.add(fault);
                refused.push(value.span());
                continue;
            }
            let values = items.iter().map(|item| value_of(key, item, report)).collect();
            let elements = items.iter().map(Spanned::span).collect();
            let name = String::new();
            let distribution = None;
            found.push(Variation { key: dotted, name, values, distribution, span: value.span(), elements });
        }
    }
    found.sort_by_key(|variation| variation.span.start);
    (found, refused)
}

/// Whether the document `root` is a study: it has `[study]`, or a list is given instead of a value.
pub(super) fn is_study(root: &DeTable) -> bool {
    root.contains_key(STUDY.name)
        || is_sampled(root)
        || all_tables(root).iter().any(|TableOf { section, table, .. }| {
            table.iter().any(|(name, value)| {
                let key = section.key(name.get_ref());
                key.is_some_and(|key| list_in_place(key.kind, value.get_ref()).is_some())
            })
        })
}

/// The elements of a list given instead of a value of `kind`. A value that is itself a list varies
/// as a list of lists.
fn list_in_place<'d, 'i>(kind: Kind, value: &'d DeValue<'i>) -> Option<&'d [Spanned<DeValue<'i>>]> {
    let DeValue::Array(items) = value else { return None };
    let is_list = |value: &Spanned<DeValue>| matches!(value.get_ref(), DeValue::Array(_));
    let first_of = |value: &'d Spanned<DeValue<'i>>| match value.get_ref() {
        DeValue::Array(items) => items.first(),
        _ => None,
    };
    let stands_in_place = match kind {
        Kind::Numbers { .. } => items.first().is_some_and(is_list),
        Kind::Points { .. } | Kind::Groups { .. } => items.first().and_then(first_of).is_some_and(is_list),
        Kind::Number { .. }
        | Kind::NumberOr { .. }
        | Kind::Integer { .. }
        | Kind::Text
        | Kind::LongText
        | Kind::Choice(_)
        | Kind::Switch
        | Kind::Path { .. } => true,
    };
    stands_in_place.then_some(items)
}

/// Reason why this list is not accepted in a study.
fn fault(
    section: &Section,
    key: &Key,
    dotted: &str,
    value: &Spanned<DeValue>,
    items: &[Spanned<DeValue>],
    overrides: &[Override],
    report: &Report,
) -> Option<Fault> {
    let given = format!("`{dotted} = {}`", report.shown(&value.span()));
    let (message, help) = if section.name.is_empty() {
        (format!("{given}: cannot vary"), "each run has this title followed by its own values".to_owned())
    } else if key.name == RUN_FOLDERS.key.name {
        (format!("{given}: cannot vary"), "all runs of a study are stored in the same form".to_owned())
    } else if items.is_empty() {
        let help = format!("each element must be {}", key.kind.accepted());
        (format!("{given}: a list of a study must have at least one element"), help)
    } else if let Some(given) = overrides.iter().find(|given| {
        (given.section, given.key) == (section.name, key.name)
            && given.number.is_none_or(|n| dotted.contains(&format!("[{n}]")))
    }) {
        let help = "leave the option out, or replace the list by a single value";
        (format!("`{}` would override `{dotted}`, which the study varies", given.shown), help.to_owned())
    } else {
        return None;
    };
    Some(Fault::of(dotted, value.span(), message).help(help))
}

/// The accepted value of an element. A refused one stays text: every run that takes it reports it.
fn value_of(key: &Key, item: &Spanned<DeValue>, report: &Report) -> Value {
    key.kind
        .accept(&Raw::read(item.get_ref()), CASE_FILE.list)
        .unwrap_or_else(|_| Value::Text(report.shown(&item.span())))
}

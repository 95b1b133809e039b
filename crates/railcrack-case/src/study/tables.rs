//! The tables of a section in a document.

use crate::schema::{Section, SectionPresence};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The tables of a section with their dotted names; nothing where it is written as something else,
/// which the reader reports.
pub(super) fn tables_of<'d, 'i>(section: &Section, root: &'d DeTable<'i>) -> Vec<(String, &'d DeTable<'i>)> {
    if section.name.is_empty() {
        return vec![(String::new(), root)];
    }
    match (section.presence, root.get(section.name).map(Spanned::get_ref)) {
        (SectionPresence::Repeated | SectionPresence::Several, Some(DeValue::Array(items))) => {
            let table = |(i, item): (usize, &'d Spanned<DeValue<'i>>)| match item.get_ref() {
                DeValue::Table(table) => Some((format!("{}[{}]", section.name, i + 1), table)),
                _ => None,
            };
            items.iter().enumerate().filter_map(table).collect()
        }
        (_, Some(DeValue::Table(table))) => vec![(section.name.to_owned(), table)],
        _ => Vec::new(),
    }
}

//! The tables of a section in a document.

use crate::schema::{Section, SectionPresence};
use crate::tables::SECTIONS;
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

/// A table of a document.
pub(super) struct TableOf<'d, 'i> {
    pub section: &'static Section,
    /// Number of the table in its section, from 1; for a part, that of the enclosing section.
    pub number: usize,
    /// Its dotted name.
    pub path: String,
    pub table: &'d DeTable<'i>,
}

/// All tables of a document, sections within sections included.
pub(super) fn all_tables<'d, 'i>(root: &'d DeTable<'i>) -> Vec<TableOf<'d, 'i>> {
    let mut all = Vec::new();
    for section in SECTIONS {
        for (i, (path, table)) in tables_of(section, root).into_iter().enumerate() {
            let number = i + 1;
            for part in section.parts {
                if let Some(DeValue::Table(within)) = table.get(part.own_name()).map(Spanned::get_ref) {
                    let path = format!("{path}.{}", part.own_name());
                    all.push(TableOf { section: part, number, path, table: within });
                }
            }
            all.push(TableOf { section, number, path, table });
        }
    }
    all
}

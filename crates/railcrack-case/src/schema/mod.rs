//! Declared text files: sections, keys, ranges and words as data, from which the reader (all errors
//! at once), defaults, JSON Schema, documentation and writer are derived. The module does not
//! depend on what is declared: it imports nothing else of this crate.

mod accept;
mod declaration;
mod document;
mod error;
mod forms;
mod json_schema;
mod markdown;
mod reading;
mod row;
mod section;
mod sections;
mod suggest;
#[cfg(test)]
mod tests;
mod units;
mod value;
mod write;

pub use declaration::{
    FileSchema, Form, Key, Kind, NumberRange, Off, OnlyWith, Pair, Presence, Preset, RangeEnd, Section,
    SectionPresence,
};
pub use document::read_text_file;
pub use error::{CaseError, CaseErrors, commands_terminal};
pub use railcrack::words::{Choice, Word};
pub use value::Value;
pub(crate) use value::{FromValue, NumberOr, read_by_word};

pub(crate) use accept::Raw;
pub(crate) use declaration::short;
pub(crate) use document::{
    SMALLER, from_file, parse_document, read_bytes, read_file, read_sections, read_text, tables,
};
pub(crate) use error::{Fault, Report, Source, escaped};
pub(crate) use json_schema::{file_schema, section_schema};
pub(crate) use markdown::page;
pub(crate) use reading::{Chosen, Defaults, Override, Reading};
pub(crate) use row::{
    KeyRow, choice, closed, count, file, given, groups, integer, joined, long_text, number, number_or,
    numbers, points, positive, section, switch, text, within,
};
pub(crate) use section::read_section;
pub(crate) use sections::{SectionValues, Sections};
pub(crate) use suggest::nearest;
pub(crate) use units::in_other_unit;
pub(crate) use write::{Written, first_file};

//! Declared files as text: the first file of a user, and a file as it was read.

use super::declaration::{FileSchema, Form, Key, Kind, Presence, Preset, Section, SectionPresence};
use super::row::KeyRow;
use super::sections::{SectionValues, Sections};
use super::value::{Value, toml_value};

/// The sections of a file with their values, every default filled in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Written(Vec<WrittenSection>);

#[derive(Debug, Clone, PartialEq)]
struct WrittenSection {
    header: String,
    /// Its name with the number of its table.
    path: String,
    values: Vec<(&'static str, Value)>,
}

impl Written {
    /// The values of `sections`, in the order of the declaration, and files under the names by
    /// which a complete copy keeps them.
    pub fn of(sections: &Sections) -> Self {
        let written = |section: &SectionValues| WrittenSection {
            header: section.section.header(),
            path: section.path.clone(),
            values: section.values(),
        };
        Self(sections.iter().map(written).collect())
    }

    /// The value of `key` in the section with this `path`.
    pub fn value(&self, path: &str, key: &str) -> Option<&Value> {
        let section = self.0.iter().find(|section| section.path == path)?;
        section.values.iter().find(|(name, _)| *name == key).map(|(_, value)| value)
    }

    /// The path of the section, the key and the value of every key.
    pub fn values(&self) -> impl Iterator<Item = (&str, &'static str, &Value)> {
        self.0.iter().flat_map(|section| {
            section.values.iter().map(|(key, value)| (section.path.as_str(), *key, value))
        })
    }

    /// Replaces the value of a key by `value`.
    pub fn replace<T>(&mut self, section: &Section, row: KeyRow<T>, value: &Value) {
        for written in self.0.iter_mut().filter(|written| written.header == section.header()) {
            for (_, old) in written.values.iter_mut().filter(|(key, _)| *key == row.key.name) {
                *old = value.clone();
            }
        }
    }

    /// The text of the file.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        for WrittenSection { header, values, .. } in &self.0 {
            if !header.is_empty() {
                text.push_str(&format!("\n{header}\n"));
            }
            for (key, value) in values {
                text.push_str(&format!("{key} = {}\n", toml_value(value)));
            }
        }
        text
    }
}

/// The first file of a user: every key with its meaning, optional keys being commented out.
pub(crate) fn first_file(file: &FileSchema) -> String {
    let mut text = String::from(file.preamble);
    for section in file.sections {
        if !section.name.is_empty() {
            let comment = if left_out(section) { "# " } else { "" };
            text.push_str(&format!("\n# {}\n{comment}{}\n", section.doc, section.header()));
        }
        for key in section.keys {
            text.push_str(&init_line(section, key));
        }
    }
    text
}

/// Whether it is commented out in the first file of a user.
fn left_out(section: &Section) -> bool {
    matches!(section.presence, SectionPresence::Optional | SectionPresence::Several)
}

/// Column at which comments begin.
const COMMENT_COLUMN: usize = 33;

/// In longer lines the comment goes above the key.
const LINE_WIDTH: usize = 120;

fn init_line(section: &Section, key: &Key) -> String {
    let preset = key.reference.unwrap_or(key.presence.preset());
    let replaced = replaced_by(section, key);
    let inactive = replaced.is_some()
        || left_out(section)
        || matches!(key.presence, Presence::Optional(_))
        || means_nothing_alone(section, key)
        || !goes_with_the_defaults(section, key);
    let assignment = format!("{}{} = {}", if inactive { "# " } else { "" }, key.name, preset_text(preset));
    let mut comment = key.doc.to_string();
    match key.kind {
        Kind::Choice(words) => {
            let names: Vec<String> =
                words().into_iter().map(|word| format!("\"{}\": {}", word.name, word.doc)).collect();
            comment.push_str(&format!(" {}.", names.join("; ")));
        }
        Kind::Number { unit: "", range } => comment.push_str(&format!(" In {range}.")),
        Kind::Number { unit, range } => comment.push_str(&format!(" In {range} {unit}.")),
        Kind::NumberOr { range, word, .. } => comment.push_str(&format!(" In {range}, or \"{word}\".")),
        Kind::Integer { min, max } => comment.push_str(&format!(" From {min} to {max}.")),
        Kind::Numbers { unit: "", range } => comment.push_str(&format!(" Each in {range}.")),
        Kind::Numbers { unit, range } => comment.push_str(&format!(" Each in {range} {unit}.")),
        Kind::Switch
        | Kind::Text
        | Kind::LongText
        | Kind::Path { .. }
        | Kind::Points { .. }
        | Kind::Groups { .. } => (),
    }
    if let Some(replaced) = replaced {
        comment.push_str(&format!(" Instead of {}.", replaced.join(", ")));
    }
    let beside = format!("{assignment:<COMMENT_COLUMN$} # {comment}\n");
    if beside.chars().count() <= LINE_WIDTH { beside } else { format!("# {comment}\n{assignment}\n") }
}

/// The keys of the first form that are left out where `key` is given; none of a key of that form,
/// or of no form.
fn replaced_by(section: &Section, key: &Key) -> Option<Vec<&'static str>> {
    let (first, others) = section.forms.split_first()?;
    let own: Vec<&Form> = others.iter().filter(|form| form.keys.contains(&key.name)).collect();
    if own.is_empty() || first.keys.contains(&key.name) {
        return None;
    }
    let is_shared = |name: &&str| own.iter().all(|form| form.admits(name));
    Some(first.keys.iter().copied().filter(|name| !is_shared(name)).collect())
}

/// Whether this key belongs to another one that is not given.
fn means_nothing_alone(section: &Section, key: &Key) -> bool {
    section.keys.iter().any(|other| other.pair.is_some_and(|pair| pair.key == key.name))
}

/// Whether a key that requires a choice of another key has it by default.
fn goes_with_the_defaults(section: &Section, key: &Key) -> bool {
    let Some(with) = key.only_with else { return true };
    let default = section.key(with.key).map(|other| other.presence.preset());
    matches!(default, Some(Preset::Text(chosen)) if with.admits(chosen))
}

/// A value of a declaration as TOML.
pub(super) fn preset_text(preset: Preset) -> String {
    toml_value(&preset.into())
}

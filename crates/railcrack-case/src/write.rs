//! The case file as text: the first file of a user, and a case as it was read.

use super::accept::Value;
use super::sections::SECTIONS;
use super::table::Kind;
use super::table::{Key, Presence, Preset, Section, SectionPresence, available};
use super::validated::Case;

impl Case {
    /// The case as read, every default filled in, as a case file. Files that it names are those of
    /// [`Case::companions`].
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        for (name, values) in &self.written {
            let Some(section) = SECTIONS.iter().find(|s| s.name == *name) else { continue };
            if !section.name.is_empty() {
                text.push_str(&format!("\n{}\n", section.header()));
            }
            for (key, value) in values {
                text.push_str(&format!("{key} = {}\n", toml_value(value)));
            }
        }
        text
    }
}

/// The first file of a user: the reference case of Table 1 of the paper, every key with what it means.
pub fn init_text() -> String {
    let mut text = String::from(
        "# A case of railcrack. `railcrack check FILE` validates it, `railcrack run FILE` computes it.\n\
         # y points up and the rail is y <= 0; lengths in mm, stresses in MPa, angles in degrees.\n\
         # Every key has a default except those of [contact] and [[crack]]: the reference case of Trolle et al.\n\
         # (2014), Table 1.\n\n",
    );
    for section in SECTIONS {
        if !section.name.is_empty() {
            // A section that may be left out is not part of the reference case.
            let comment = if section.presence == SectionPresence::Optional { "# " } else { "" };
            text.push_str(&format!("\n# {}\n{comment}{}\n", section.doc, section.header()));
        }
        for key in section.keys.iter().filter(|k| section.offers(k)) {
            text.push_str(&init_line(section, key));
        }
    }
    text
}

/// Column at which comments begin.
const COMMENT_COLUMN: usize = 33;

/// Longer lines put the comment above the key.
const LINE_WIDTH: usize = 120;

fn init_line(section: &Section, key: &Key) -> String {
    let preset = key.reference.unwrap_or(key.presence.preset());
    let other_form = section.forms.iter().skip(1).any(|f| f.keys.contains(&key.name));
    let inactive = other_form
        || section.presence == SectionPresence::Optional
        || matches!(key.presence, Presence::Optional(_))
        || default_needs_another(section, key)
        || !goes_with_the_defaults(section, key);
    let assignment = format!("{}{} = {}", if inactive { "# " } else { "" }, key.name, preset_text(preset));
    let mut comment = key.doc.to_string();
    match key.kind {
        Kind::Choice(choices) => {
            let names: Vec<String> =
                available(choices).map(|c| format!("\"{}\": {}", c.name, c.doc)).collect();
            comment.push_str(&format!(" {}.", names.join("; ")));
        }
        Kind::Number { unit: "", range } => comment.push_str(&format!(" In {range}.")),
        Kind::Number { unit, range } => comment.push_str(&format!(" In {range} {unit}.")),
        Kind::Integer { min, max } => comment.push_str(&format!(" From {min} to {max}.")),
        Kind::Numbers { unit, range } => comment.push_str(&format!(" Each in {range} {unit}.")),
        Kind::Text | Kind::Path | Kind::Points | Kind::Groups => (),
    }
    if other_form && let Some(first) = section.forms.first() {
        comment.push_str(&format!(" Instead of {}.", first.keys.join(", ")));
    }
    let beside = format!("{assignment:<COMMENT_COLUMN$} # {comment}\n");
    if beside.chars().count() <= LINE_WIDTH { beside } else { format!("# {comment}\n{assignment}\n") }
}

/// A key with a default that means nothing without an optional one: `count` without `spacing_mm`.
fn default_needs_another(section: &Section, key: &Key) -> bool {
    section.presence == SectionPresence::Repeated && matches!(key.presence, Presence::Default(_))
}

/// Whether a key that needs another one's choice has it by default.
fn goes_with_the_defaults(section: &Section, key: &Key) -> bool {
    let Some(with) = key.only_with else { return true };
    let default = section.key(with.key).map(|other| other.presence.preset());
    matches!(default, Some(Preset::Text(chosen)) if chosen == with.choice)
}

/// A value as TOML.
pub(super) fn toml_value(value: &Value) -> String {
    match value {
        Value::Number(x) => number(*x),
        Value::Integer(n) => n.to_string(),
        Value::Text(text) => quoted(text),
        Value::Numbers(numbers) => {
            format!("[{}]", numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", "))
        }
        Value::Points(points) => list(points),
        Value::Groups(groups) => {
            let group = |keys: &Vec<String>| {
                format!("[{}]", keys.iter().map(|key| quoted(key)).collect::<Vec<_>>().join(", "))
            };
            format!("[{}]", groups.iter().map(group).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A value of the table as TOML.
pub(super) fn preset_text(preset: Preset) -> String {
    toml_value(&preset.into())
}

/// A float as TOML writes it, of the shortest text that reads back to the same bits.
fn number(x: f64) -> String {
    format!("{x:?}")
}

fn list(points: &[[f64; 2]]) -> String {
    let points: Vec<String> =
        points.iter().map(|[x, y]| format!("[{}, {}]", number(*x), number(*y))).collect();
    format!("[{}]", points.join(", "))
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

//! The page of documentation of the case file.

use super::sections::SECTIONS;
use super::study::STUDY;
use super::table::{Availability, Choice, Key, Kind, Presence, Section, SectionPresence};
use super::write::preset_text;

const INTRODUCTION: &str = "\
# The case file

A case is one TOML file. `railcrack init` writes the reference case with a comment on every key, `railcrack check`
validates a case and says what would be computed, `railcrack schema` prints its JSON Schema for editors.

* Lengths are in mm, stresses in MPa, angles in degrees. y points up, the rail is y <= 0.
* File names are relative to the folder of the case file.
* An unknown key, a wrong type, a number out of range, two keys that say the same thing or a missing file is an
  error that names the file, the line, the key, the value and what is accepted. All errors of a file are reported
  at once, the exit code is 2, and nothing is written.
* An integer is written without a decimal point (`241`); a number may be written either way (`6` or `6.0`).
* Not-a-number is never accepted, infinity only where the range below includes it.
* A list in place of a value makes the file a study, many cases in one: see [studies](studies.md).

This page is generated from the table of keys in the library; a test keeps it up to date.
";

/// The page `docs/case-file.md`.
pub fn markdown() -> String {
    let mut page = String::from(INTRODUCTION);
    for section in SECTIONS.iter().chain([&STUDY]) {
        let title =
            if section.name.is_empty() { "At the top".into() } else { format!("`{}`", section.header()) };
        page.push_str(&format!("\n## {title}\n\n{}", section.doc));
        page.push_str(match section.presence {
            SectionPresence::Defaulted => " May be left out.\n",
            SectionPresence::Optional => " Optional.\n",
            SectionPresence::Required => " Required.\n",
            SectionPresence::Repeated => " At least one is required.\n",
        });
        page.push_str(&forms(section));
        page.push_str("\n| key | accepted | default | meaning |\n|---|---|---|---|\n");
        for key in section.keys {
            page.push_str(&row(section, key));
        }
    }
    page
}

fn forms(section: &Section) -> String {
    let ways: Vec<String> = section
        .forms
        .iter()
        .map(|f| f.keys.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", "))
        .collect();
    if ways.is_empty() { String::new() } else { format!("\nEither {}.\n", ways.join("; or ")) }
}

fn row(section: &Section, key: &Key) -> String {
    let accepted = match key.kind {
        Kind::Choice(choices) => choices.iter().map(choice).collect::<Vec<_>>().join("; "),
        _ => key.kind.accepted(),
    };
    let default = match key.presence {
        Presence::Default(preset) => format!("`{}`", preset_text(preset)),
        Presence::Optional(_) => "none".into(),
        Presence::Required(_) => "required".into(),
    };
    let mut meaning = key.doc.to_string();
    if let Some(with) = key.only_with {
        meaning.push_str(&format!(" Only with `{} = \"{}\"`.", with.key, with.choice));
    }
    if !section.offers(key) {
        meaning.push_str(" Refused for now.");
    }
    format!("| `{}` | {accepted} | {default} | {meaning} |\n", key.name)
}

fn choice(choice: &Choice) -> String {
    match choice.availability {
        Availability::Now => format!("`\"{}\"`: {}", choice.name, choice.doc),
        Availability::Later { .. } => format!("`\"{}\"`: {}, refused for now", choice.name, choice.doc),
    }
}

//! Page of documentation of a declared file.

use super::declaration::{FileSchema, Key, Kind, Presence, Section, SectionPresence};
use super::write::preset_text;
use railcrack::words::Word;

/// The page, in Markdown: the introduction, then a table of the keys of each section.
pub(crate) fn page(file: &FileSchema) -> String {
    let mut page = String::from(file.introduction);
    for section in file.sections.iter().chain(file.beside) {
        let title =
            if section.name.is_empty() { "At the top".into() } else { format!("`{}`", section.header()) };
        page.push_str(&format!("\n## {title}\n\n{}", section.doc));
        page.push_str(match section.presence {
            SectionPresence::Defaulted => " May be left out.\n",
            SectionPresence::Optional => " Optional.\n",
            SectionPresence::Required => " Required.\n",
            SectionPresence::Repeated => " At least one is required.\n",
            SectionPresence::Several => " Optional, may be repeated.\n",
        });
        page.push_str(&forms(section));
        page.push_str("\n| key | accepted | default | meaning |\n|---|---|---|---|\n");
        for key in section.keys {
            page.push_str(&row(key));
        }
        page.push_str(&parts(section));
    }
    page
}

/// The sections within `section`.
fn parts(section: &Section) -> String {
    let names: Vec<String> = section.parts.iter().map(|part| format!("`[{}]`", part.name)).collect();
    if names.is_empty() {
        return String::new();
    }
    let mut text =
        format!("\nWithin each: {}, with the keys of the section of that name.\n", names.join(", "));
    for (part, off) in section.parts.iter().filter_map(|part| Some((part, part.off?))) {
        text.push_str(&format!(
            "`{} = false` stands for `{} = \"{}\"`.\n",
            part.own_name(),
            off.key,
            off.choice
        ));
    }
    text
}

fn forms(section: &Section) -> String {
    let ways: Vec<String> = section
        .forms
        .iter()
        .map(|form| match form.also {
            [] => in_words(form.keys),
            also => format!("{}, perhaps with {}", in_words(form.keys), in_words(also)),
        })
        .collect();
    if ways.is_empty() { String::new() } else { format!("\nEither {}.\n", ways.join("; or ")) }
}

fn in_words(keys: &[&str]) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
}

fn row(key: &Key) -> String {
    let accepted = match key.kind {
        Kind::Choice(words) => words().iter().map(choice).collect::<Vec<_>>().join("; "),
        _ => key.kind.accepted().trim_start_matches("a number in ").to_owned(),
    };
    let default = match key.presence {
        Presence::Default(preset) => format!("`{}`", preset_text(preset)),
        Presence::Optional(_) => "none".into(),
        Presence::Required(_) => "required".into(),
    };
    let default = match key.excused {
        Some(with) => format!("{default}, except with `{}`", with.shown()),
        None => default,
    };
    let mut meaning = key.doc.to_string();
    if let Some(with) = key.only_with {
        meaning.push_str(&format!(" Only with `{}`.", with.shown()));
    }
    format!("| `{}` | {accepted} | {default} | {meaning} |\n", key.name)
}

fn choice(choice: &Word) -> String {
    let also = choice.switch.map_or_else(String::new, |value| format!(" or `{value}`"));
    format!("`\"{}\"`{also}: {}", choice.name, choice.doc)
}

//! One key of the case file, set from elsewhere: the command line, a column of a table.

use crate::schema::{Fault, Key, Override, Raw, Report, Section, SectionPresence, nearest};
use crate::tables::SECTIONS;
use toml::de::DeTable;

const EXAMPLE: &str = "such as contact.friction=0.2 or crack[1].angle_deg=30.0";

/// The value that `given`, `section.key=value`, sets instead of the value in the file; none if it
/// is wrong; errors are added to `report`.
pub(super) fn setting(given: &str, report: &mut Report) -> Option<Override> {
    let shown = format!("--set {given}");
    let mut refuse = |says: String, help: String| {
        report.add_to_command_line(Fault::new(format!("`{shown}`: {says}")).help(help));
        None
    };
    let Some((path, written)) = given.split_once('=') else {
        return refuse("must be section.key=value".into(), EXAMPLE.into());
    };
    let (section, number, key) = match place_of(path.trim()) {
        Ok(place) => place,
        Err((says, help)) => return refuse(says, help),
    };
    match raw(written.trim(), key) {
        Some(value) => {
            Some(Override { section: section.name, key: key.name, number, shown, value: Some(value) })
        }
        None => refuse(
            "the value is not valid TOML".into(),
            "write numbers without quotes and text with quotes".into(),
        ),
    }
}

/// The absence of the key `path`, `section.key`; none where there is no such key.
pub(super) fn leaving_out(path: &str) -> Option<Override> {
    let (section, number, key) = place_of(path).ok()?;
    Some(Override { section: section.name, key: key.name, number, shown: path.to_owned(), value: None })
}

/// Section, number of its table where it is given, and key of `path`, `section.key`.
///
/// Errors: what is wrong, and a remedy.
pub(crate) fn place_of(path: &str) -> Result<Place, (String, String)> {
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    let Some((section_name, number)) = numbered(table) else {
        return Err(("crack[N] counts cracks from 1".into(), EXAMPLE.into()));
    };
    let parts = || SECTIONS.iter().flat_map(|section| section.parts);
    let Some(section) = SECTIONS.iter().chain(parts()).find(|section| section.name == section_name) else {
        let near = nearest(&section_name, SECTIONS.iter().map(|section| section.name)).unwrap_or_default();
        let says = format!("unknown section `{section_name}`");
        return Err((says, format!("nearest known section: `{near}`")));
    };
    let Some(key) = section.key(name) else {
        return Err((format!("unknown key `{name}`"), known(section, name)));
    };
    let outer = section.name.split('.').next().unwrap_or_default();
    let outer = SECTIONS.iter().find(|section| section.name == outer).unwrap_or(section);
    if number.is_some() && !matches!(outer.presence, SectionPresence::Repeated | SectionPresence::Several) {
        return Err((format!("there is one `{}`", section.header()), EXAMPLE.into()));
    }
    Ok((section, number, key))
}

type Place = (&'static Section, Option<usize>, &'static Key);

/// `crack[2]` as name and number, `wheel[1].contact` as `wheel.contact` and the number of the
/// wheel.
fn numbered(table: &str) -> Option<(String, Option<usize>)> {
    match table.split_once('[') {
        None => Some((table.to_owned(), None)),
        Some((name, rest)) => {
            let (number, inner) = rest.split_once(']')?;
            let number = number.parse().ok().filter(|number| *number > 0)?;
            Some((format!("{name}{inner}"), Some(number)))
        }
    }
}

fn known(section: &Section, name: &str) -> String {
    let known: Vec<&str> = section.keys.iter().map(|key| key.name).collect();
    let near = nearest(name, known.iter().copied()).unwrap_or_default();
    format!("nearest known key: `{near}`; {} has {}", section.header(), known.join(", "))
}

/// The value as read by TOML; where the key takes words, a bare word that is not TOML is taken
/// literally.
fn raw(written: &str, key: &Key) -> Option<Raw> {
    let text = format!("value = {written}");
    if let Ok(table) = DeTable::parse(&text) {
        return table.get_ref().get("value").map(|value| Raw::read(value.get_ref()));
    }
    (key.kind.is_text() && !written.is_empty()).then(|| Raw::Text(written.to_owned()))
}

//! A case in words on a page: the description that the terminal and JSON have too.

use crate::page::{Block, Section};
use railcrack_case::Case;
use railcrack_run::description::{Description, Part, Subject};
use railcrack_run::files::CASE_FILE;

/// The subjects of the case from which growth is computed. Residual stress and solution follow from
/// the run, the plastic state from another command.
pub(super) const OF_GROWTH: [Subject; 8] = [
    Subject::Rail,
    Subject::Wheels,
    Subject::Passage,
    Subject::Cracks,
    Subject::Fronts,
    Subject::Growth,
    Subject::Maintenance,
    Subject::Model,
];

/// `subjects` of `case`, one paragraph for each part.
pub(super) fn described(case: &Case, subjects: &[Subject]) -> Vec<String> {
    Description::of(case).parts(subjects).iter().filter_map(paragraph).collect()
}

/// The text of `case.toml`.
pub(super) fn case_section(text: &str) -> Section {
    file_section("case", "Case", format!("{CASE_FILE}, defaults filled in"), text)
}

/// The section `heading` with the text of a file behind its `name`.
pub(super) fn file_section(id: &str, heading: &str, name: String, text: &str) -> Section {
    let blocks = vec![Block::Verbatim(text.to_owned())];
    Section::new(id, heading, vec![Block::Folded { heading: name, blocks }])
}

/// A part of a description as a paragraph; none without rows. Lines of its tables are left out.
fn paragraph(part: &Part) -> Option<String> {
    let named = part.rows.iter().filter(|row| !row.name.is_empty());
    let rows: Vec<String> = named.map(|row| format!("{} {}", row.name, row.text)).collect();
    let mut letters = part.heading.chars();
    let first = letters.next()?.to_uppercase();
    (!rows.is_empty()).then(|| typeset(&format!("{first}{}: {}.", letters.as_str(), rows.join("; "))))
}

/// Symbols as the terminal writes them in ASCII, each with the form that a page has instead.
const TYPESET: [(&str, &str); 12] = [
    ("p0 / k", "p_{0}/k"),
    ("p0", "p_{0}"),
    ("k1", "k_{1}"),
    ("sigma_xx", "σ_{xx}"),
    ("Tgamma", "Tγ"),
    ("(mu P)", "(μP)"),
    ("nu = ", "ν = "),
    ("1 / beta", "1/β"),
    (" sqrt(m)", "√m"),
    (" degrees C", " °C"),
    (" degrees", "°"),
    ("+-", "±"),
];

/// `text` with the symbols, powers and minus signs of a page.
fn typeset(text: &str) -> String {
    let mut text = raised(text);
    for (ascii, symbol) in TYPESET {
        text = text.replace(ascii, symbol);
    }
    // ΔK stands for ΔK_eq wherever it has no mode.
    let modes = text.replace("ΔKII", "Δ\u{0}_{II}").replace("ΔKI", "Δ\u{0}_{I}");
    let text = modes.replace("ΔK", "ΔK_{eq}").replace('\u{0}', "K").replace("Kmax", "K_{max}");
    let mut minus = String::with_capacity(text.len());
    let mut before = ' ';
    let mut rest = text.chars().peekable();
    while let Some(letter) = rest.next() {
        let is_sign = letter == '-'
            && !before.is_alphanumeric()
            && rest.peek().is_some_and(|next| next.is_ascii_digit() || *next == 'x')
            || letter == '-' && before == 'e' && rest.peek().is_some_and(char::is_ascii_digit);
        minus.push(if is_sign { '\u{2212}' } else { letter });
        before = letter;
    }
    minus
}

/// `text` with the numbers after `^` as powers.
fn raised(text: &str) -> String {
    let mut parts = text.split('^');
    let mut raised = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(part.len());
        // A full stop after the number is punctuation.
        let power = part[..end].trim_end_matches('.');
        if power.is_empty() {
            raised.push('^');
        } else {
            raised.push_str(&format!("^{{{power}}}"));
        }
        raised.push_str(&part[power.len()..]);
    }
    raised
}

//! Assumptions behind a result: the description of its case, with what the run found of it.

use super::stored::RunFolder;
use crate::numbers::{fixed, grouped, significant};
use railcrack::words::Choice;
use railcrack_run::description::{Part, describe};

/// Parts of a description that the page tells by results of the run, or that do not concern it.
const ELSEWHERE: [&str; 5] = ["residual stress", "plastic stress", "solution", "plastic state", "bounds"];

/// The assumptions, one paragraph each.
pub(super) fn assumptions(run: &RunFolder) -> Vec<String> {
    let parts = describe(&run.case);
    let described = parts.iter().filter(|part| !ELSEWHERE.contains(&part.heading.as_str()));
    let mut all: Vec<String> = described.filter_map(paragraph).collect();
    all.extend([residual(run), solution(run)]);
    all.push("Load cycles are uncertain by a factor of several, the scatter of the growth law.".to_owned());
    all
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
pub(super) fn typeset(text: &str) -> String {
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

/// The residual stress and its origin.
fn residual(run: &RunFolder) -> String {
    if run.residual.is_empty() {
        return "Residual stress: none.".to_owned();
    }
    let (least, most) =
        run.residual.iter().fold((0.0f64, 0.0f64), |(l, m), row| (l.min(row[1]), m.max(row[1])));
    let mut text = format!(
        "Residual stress: σ_{{xx}} from {} to {} MPa on the vertical centre line; it does not relax as the cracks grow.",
        fixed(least, 0),
        fixed(most, 0)
    );
    let Some(summary) = &run.summary.residual_stress else { return text };
    if let Some(file) = &summary.balanced_profile {
        text.push_str(&format!(" A balanced profile by depth is given ({file})."));
    }
    match (&summary.plastic_source, &summary.rolled) {
        (_, Some(rolled)) => text.push_str(&format!(
            " Its plastic part was computed from repeated passages of the {} over this rail ({}, {} passages, in {}) \
             and balanced on the mesh of the cracks.",
            if run.case.is_mix() { "heaviest wheel" } else { "same wheel" },
            rolled.state.word(),
            rolled.passes,
            rolled.folder
        )),
        (Some(source), None) => text.push_str(&format!(
            " Its plastic part is given ({}) and was balanced on the mesh of the cracks.",
            source.word()
        )),
        (None, None) => {}
    }
    if let Some(projection) = &summary.projection {
        text.push_str(&format!(
            " The projection onto that mesh changed the plastic stress by {} % in norm.",
            significant(100.0 * projection.mesh_difference)
        ));
    }
    text
}

/// The size of the solution and how well the contact conditions hold.
fn solution(run: &RunFolder) -> String {
    let summary = &run.summary;
    let unknowns = match summary.dofs {
        0 => String::new(),
        dofs => format!("at most {} unknowns and ", grouped(dofs as f64)),
    };
    format!(
        "Solution: {} with {unknowns}{} face points; contact of the crack faces by {}, solved {} times, with a relative \
         violation of its conditions of at most {:.0e}. K repeated after {} of at most {} passages.",
        run.case.engine().method(),
        summary.face_points,
        run.case.contact_solver().method(),
        grouped(summary.contact_solves as f64),
        summary.complementarity_max,
        summary.passages,
        run.case.first_wheel().passages.max_passages
    )
}

//! Page of documentation of the usual ranges.

use super::ranges::USUAL;
use crate::schema::short;

const INTRODUCTION: &str = "\
# Usual ranges

`railcrack check` and `run` warn of a number outside of its usual range and guess the unit that was
meant; the number is used as it is. Zero and infinity are always usual. Ranges hold for the size of
a number, whatever its sign, and are wide: a number within them may still be wrong. Standards are
quoted from memory; where the source is no document, the range is practice without a source that
could be read. Further words compare numbers with each other:

* the rates of the growth law at ranges of 10 and 20 MPa√m with those of rail steel, beyond a factor
  of 30 either way; the verdict of such a run is *outside*;
* the load of a wheel (contact, track, table of wheels) with half of its axle load, beyond a factor
  of 1.7;
* spin with one over the radius of the wheel;
* the force of a residual stress with zero, beyond 10 MPa over the height of a rail.

[What each warning means](warnings.md) has the consequences and what to do.

| quantity | keys and columns | usual | source |
|---|---|---|---|
";

/// The page `docs/usual-ranges.md`: every quantity with its keys, range and source.
#[must_use]
pub fn usual_ranges() -> String {
    let mut page = String::from(INTRODUCTION);
    for usual in USUAL {
        let names: Vec<String> =
            usual.keys.iter().chain(usual.columns).map(|name| format!("`{name}`")).collect();
        let unit = if usual.unit.is_empty() { String::new() } else { format!(" {}", usual.unit) };
        let (low, high) = usual.range;
        let quantity = usual.quantity.trim_start_matches("the ").trim_start_matches("a ");
        page.push_str(&format!(
            "| {quantity} | {} | {} to {}{unit} | {} |\n",
            names.join(", "),
            short(low),
            short(rounded(high)),
            usual.source
        ));
    }
    page
}

fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

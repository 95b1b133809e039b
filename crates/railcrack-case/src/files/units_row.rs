//! A row of units below the header of a table.

/// Ends of the names of columns with the units that they stand for, the longer ones first; the
/// first unit is the usual one.
const UNITS: &[(&str, &[&str])] = &[
    ("_mpa_sqrt_m", &["MPa sqrt(m)", "MPa\u{221a}m", "MPa*sqrt(m)", "MPa.m^0.5", "MPa m^0.5"]),
    ("_mm_per_cycle", &["mm/cycle", "mm/cycles"]),
    ("_per_mm", &["1/mm", "rad/mm", "mm^-1"]),
    ("_mm", &["mm"]),
    ("_mpa", &["MPa", "N/mm2", "N/mm\u{b2}", "N/mm^2"]),
    ("_kn", &["kN"]),
    ("_deg", &["degrees", "deg", "\u{b0}"]),
    ("_c", &["degrees C", "C", "\u{b0}C"]),
    ("_m", &["m"]),
    ("_t", &["t", "tonnes"]),
    ("mgt", &["MGT", "Mt", "10^6 t", "million t"]),
];

/// Units that stand below columns which are not in them.
const OTHERS: &[&str] = &[
    "\u{b5}m", "um", "cm", "in", "inch", "km", "Pa", "kPa", "GPa", "ksi", "psi", "N", "lbf", "kips", "rad",
    "mrad", "1/m", "rad/m", "m^-1", "kg", "m/cycle", "nm/cycle", "s", "h", "d", "K", "F", "m/s", "km/h", "%",
];

/// Signs of a column without a unit.
const NONE: [&str; 4] = ["", "-", "1", "\u{2013}"];

/// A unit without the brackets around it.
fn bare(given: &str) -> &str {
    given.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim()
}

fn is_one_of(given: &str, units: &[&str]) -> bool {
    // Of milli and mega only the letter's size tells.
    units.iter().any(|unit| *unit == given || unit.eq_ignore_ascii_case(given) && given.len() > 1)
}

/// Whether the `fields` of a row are units, at least one of them, and nothing else.
pub(super) fn is_units_row<'a>(fields: impl Iterator<Item = &'a str>) -> bool {
    let known =
        |given: &str| is_one_of(given, OTHERS) || UNITS.iter().any(|(_, units)| is_one_of(given, units));
    let (mut named, mut all) = (false, true);
    for given in fields.map(bare) {
        named |= known(given);
        all &= known(given) || NONE.contains(&given) && given != "1" || given.is_empty();
    }
    named && all
}

/// The unit of the column `name`, where `given` is another one.
pub(super) fn other_unit(name: &str, given: &str) -> Option<&'static str> {
    let given = bare(given);
    let (_, own) = UNITS.iter().find(|(end, _)| name.ends_with(end))?;
    (!NONE.contains(&given) && !is_one_of(given, own)).then_some(own[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_told_from_numbers_and_names() {
        let is = |row: &str| is_units_row(row.split(';'));
        assert!(is("[MGT];[mm]") && is("-;mm;kN") && is("mgt;;mm"));
        assert!(!is("6;1.2") && !is(";") && !is("x;mm") && !is("1;mm"));
        assert_eq!(other_unit("depth_mm", "[mm]"), None);
        assert_eq!(other_unit("depth_mm", "m"), Some("mm"));
        assert_eq!(other_unit("spin_per_mm", "1/m"), Some("1/mm"));
        assert_eq!(other_unit("normal_kn", "N"), Some("kN"));
        assert_eq!((other_unit("mu", "-"), other_unit("y_rail_mm", "-")), (None, None));
    }
}

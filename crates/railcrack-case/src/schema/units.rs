//! Guesses at the unit of a number that is out of range: Pa for MPa, metres for mm, radians for
//! degrees.

use super::declaration::{Key, Kind, Preset, short};

/// Another unit that people write, what multiplies a number in it, and its usual name.
struct Slip {
    unit: &'static str,
    times: f64,
}

/// Other units for the unit of a key.
fn slips(unit: &str) -> &'static [Slip] {
    match unit {
        "" => &[Slip { unit: "%", times: 1e-2 }],
        "MPa" => &[Slip { unit: "Pa", times: 1e-6 }, Slip { unit: "GPa", times: 1e3 }],
        "mm" => &[
            Slip { unit: "m", times: 1e3 },
            Slip { unit: "\u{b5}m", times: 1e-3 },
            Slip { unit: "inches", times: 25.4 },
        ],
        "degrees" => &[Slip { unit: "rad", times: 180.0 / std::f64::consts::PI }],
        "t" => &[Slip { unit: "kg", times: 1e-3 }, Slip { unit: "kN", times: 1.0 / 9.80665 }],
        "kN" => &[Slip { unit: "N", times: 1e-3 }],
        "N/mm" => &[Slip { unit: "N/m", times: 1e-3 }],
        "1/mm" => &[Slip { unit: "1/m", times: 1e-3 }],
        "mm/MGT" => &[Slip { unit: "\u{b5}m/MGT", times: 1e-3 }],
        "MGT" => &[Slip { unit: "t", times: 1e-6 }],
        "MPa sqrt(m)" => {
            &[Slip { unit: "Pa sqrt(m)", times: 1e-6 }, Slip { unit: "N/mm^1.5", times: 0.031_622_776_6 }]
        }
        "mm^4" => &[Slip { unit: "cm^4", times: 1e4 }, Slip { unit: "m^4", times: 1e12 }],
        _ => &[],
    }
}

/// Factor by which a value may differ from the default or the example of its key for a guess.
const NEAR: f64 = 100.0;

/// The number in the unit of `key` that was probably meant by `value`, out of its range and in
/// another unit; none where no unit makes it an ordinary value.
pub(super) fn guess(key: &Key, value: f64) -> Option<String> {
    let Kind::Number { unit, range } = key.kind else { return None };
    let Preset::Number(usual) = key.presence.preset() else { return None };
    let distance = |slip: &Slip| (slip.times * value / usual).abs().ln().abs();
    let fits = |slip: &&Slip| range.contains(slip.times * value) && distance(slip) <= NEAR.ln();
    let slip = slips(unit).iter().filter(fits).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    // Conversions are round numbers; radians have four digits.
    let meant = slip.times * value;
    let digits = format!("{meant:.3e}").parse().unwrap_or(meant);
    Some(format!("{} {} = {} {unit}?", short(value), slip.unit, short(digits)))
}

/// The number in `unit` that was probably meant by `value`, as `0.007 m = 7 mm?`: the first other
/// unit that makes it one that `fits`.
pub(crate) fn in_other_unit(unit: &str, value: f64, fits: impl Fn(f64) -> bool) -> Option<String> {
    let slip = slips(unit).iter().find(|slip| fits(slip.times * value))?;
    let digits = |value: f64| short(format!("{value:.3e}").parse().unwrap_or(value));
    let space = if slip.unit == "%" { "" } else { " " };
    let own = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    Some(format!("{}{space}{} = {}{own}?", digits(value), slip.unit, digits(slip.times * value)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::{Presence, Preset};

    #[test]
    fn other_units_are_guessed_where_they_make_an_ordinary_value() {
        let key = |unit, (min, max), usual| Key {
            name: "key",
            kind: Kind::Number { unit, range: crate::schema::NumberRange::closed(min, max) },
            presence: Presence::Default(Preset::Number(usual)),
            doc: "",
            only_with: None,
            excused: None,
            pair: None,
            reference: None,
        };
        let pressure = key("MPa", (1e-3, 1e4), 845.0);
        assert_eq!(guess(&pressure, 1e9).as_deref(), Some("1e9 Pa = 1000 MPa?"));
        assert_eq!(guess(&pressure, 3e13), None);
        let angle = key("degrees", (0.5, 179.5), 15.0);
        assert_eq!(guess(&angle, 0.35).as_deref(), Some("0.35 rad = 20.05 degrees?"));
        let width = key("mm", (0.01, 100.0), 6.75);
        assert_eq!(guess(&width, 0.00675).as_deref(), Some("0.00675 m = 6.75 mm?"));
        let load = key("t", (1e-3, 1e3), 17.0);
        assert_eq!(guess(&load, 22500.0).as_deref(), Some("22500 kg = 22.5 t?"));
        assert_eq!(guess(&load, -3.0), None);
    }
}

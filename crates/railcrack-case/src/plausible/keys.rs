//! Values of keys outside of their usual ranges.

use super::ranges::of_key;
use super::spin::too_much_spin;
use super::topic::{Implausible, Topic};
use crate::case::Case;
use crate::schema::Value;

/// Thresholds: far beyond the usual ones, no crack grows.
const THRESHOLDS: &str = "threshold";
/// The key that the radius of the wheel limits.
const SPIN: &str = "spin_per_mm";

/// The keys of `case` with unusual values.
pub(super) fn of_keys(case: &Case) -> Vec<Implausible> {
    let mut found = Vec::new();
    for (path, key, value) in case.values() {
        let Some(usual) = of_key(&format!("{}.{key}", section_of(path))) else { continue };
        let name = format!("{path}.{key}");
        let remark = numbers(value).iter().find_map(|value| match key {
            SPIN => too_much_spin(*value, radius_of(case, path)),
            _ => usual.remark(&name, *value),
        });
        let topic = if key.contains(THRESHOLDS) { Topic::GrowthLaw } else { Topic::Quantity };
        found.extend(remark.map(|text| Implausible { topic, text }));
    }
    found.extend(of_points(case));
    found
}

/// Radius (mm) of the wheel whose contact has this `path`.
fn radius_of(case: &Case, path: &str) -> Option<f64> {
    let radius = case.values().find(|(other, key, _)| *other == path && *key == "wheel_radius_mm");
    numbers(radius?.2).first().copied()
}

/// The section of `path`: `contact` of `wheel[2].contact`.
fn section_of(path: &str) -> String {
    let name: String =
        path.split('.').map(|part| part.split('[').next().unwrap_or_default()).collect::<Vec<_>>().join(".");
    name.strip_prefix("wheel.").map(str::to_owned).unwrap_or(name)
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(number) => vec![*number],
        Value::Numbers(numbers) => numbers.clone(),
        _ => Vec::new(),
    }
}

/// Cracks that points give, whose lengths are unusual.
fn of_points(case: &Case) -> Option<Implausible> {
    let usual = of_key("crack.length_mm")?;
    let given = case.values().find(|(_, key, _)| *key == "points_mm");
    let (path, ..) = given?;
    let lengths =
        case.cracks.cracks().iter().filter(|crack| crack.points().len() > 1).map(|crack| crack.length());
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    let text = usual.remark(&format!("the length of a crack by {path}.points_mm"), shortest)?;
    Some(Implausible { topic: Topic::Quantity, text })
}

#[cfg(test)]
mod tests {
    use super::section_of;

    #[test]
    fn sections_of_wheels_are_those_of_a_case() {
        assert_eq!(section_of("wheel[2].contact"), "contact");
        assert_eq!(section_of("crack[1]"), "crack");
        assert_eq!((section_of("wheel[1]"), section_of("growth")), ("wheel".to_owned(), "growth".to_owned()));
    }
}

//! Cases that differ from another one in something that is seldom known.

use crate::log::Variation;
use crate::setup::represented;
use railcrack_case::{Case, Engine, Overrides, PlaneEngine};
use std::path::Path;

/// Change of the neutral temperature, K.
const NEUTRAL: f64 = 10.0;
/// Error of a measured depth, mm.
const DEEPER: f64 = 0.3;
/// Cracks from which on the runs would take too long.
const MANY_CRACKS: usize = 12;
/// Tolerance of the life of these runs: differences between them are larger.
const TOLERANCE: f64 = 0.05;

/// The variations of `case`, which `engine` computes: nothing where each run would take long.
pub(super) fn variations(case: &Case, engine: Engine) -> Vec<Variation> {
    let is_quick = engine == Engine::Plane(PlaneEngine::Dislocation);
    if !is_quick || case.cracks.cracks().len() > MANY_CRACKS {
        return Vec::new();
    }
    let mut all = vec![Variation::Neutral(-NEUTRAL), Variation::Neutral(NEUTRAL)];
    all.extend((!other_sign(case).is_empty()).then_some(Variation::OtherSign));
    if !deeper(case, DEEPER).is_empty() {
        all.extend([Variation::Deeper(-DEEPER), Variation::Deeper(DEEPER)]);
    }
    all
}

/// `case` as `variation` changes it; the files that it names lie in `folder`. None where it does
/// not apply.
pub(super) fn varied(case: &Case, variation: Variation, folder: &Path) -> Option<Case> {
    let settings = match variation {
        Variation::OtherSign => other_sign(case),
        Variation::Neutral(by) => warmer(case, by),
        Variation::Deeper(by) => deeper(case, by),
    };
    if settings.is_empty() {
        return None;
    }
    let overrides = Overrides { settings, ..Overrides::default() };
    let varied = Case::parse_with(&case.to_toml(), "case.toml", folder, &overrides).ok()?;
    let mut varied = represented(&varied).into_owned();
    varied.growth.tolerance = varied.growth.tolerance.map(|tolerance| tolerance.max(TOLERANCE));
    Some(varied)
}

/// Settings that turn the tangential force of each wheel round.
fn other_sign(case: &Case) -> Vec<String> {
    let of_contact = |section: String| {
        let torque = format!("{section}.torque");
        match case.word(&torque) {
            Some("driven") => return Some(format!("{torque}=\"braked\"")),
            Some(_) => return Some(format!("{torque}=\"driven\"")),
            None => {}
        }
        ["creepage_x", "traction", "friction"].iter().find_map(|key| {
            let path = format!("{section}.{key}");
            let value = case.number(&path).ok().filter(|value| *value != 0.0)?;
            Some(format!("{path}={:?}", -value))
        })
    };
    case.contact_sections().into_iter().filter_map(of_contact).collect()
}

/// Settings of a neutral temperature that is higher by `by` (K).
fn warmer(case: &Case, by: f64) -> Vec<String> {
    match case.number("temperature.neutral_c") {
        Ok(neutral) => vec![format!("temperature.neutral_c={:?}", neutral + by)],
        Err(_) => vec!["temperature.rail_c=0.0".to_owned(), format!("temperature.neutral_c={by:?}")],
    }
}

/// Settings of straight cracks that are deeper by `by` (mm); none where a file has their depths.
fn deeper(case: &Case, by: f64) -> Vec<String> {
    if case.crack_table.is_some() {
        return Vec::new();
    }
    let of_section = |index: usize| {
        let number = |key: &str| case.number(&format!("crack[{index}].{key}")).ok();
        let sine = number("angle_deg")?.to_radians().sin();
        let (key, value) = match number("length_mm") {
            Some(length) => ("length_mm", length + by / sine),
            None => ("depth_mm", number("depth_mm")? + by),
        };
        (value > 0.0).then(|| format!("crack[{index}].{key}={value:?}"))
    };
    (1..=case.cracks.cracks().len()).filter_map(of_section).collect()
}

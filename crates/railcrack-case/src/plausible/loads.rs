//! Loads of wheels against those of axles.

use super::topic::{Implausible, Topic};
use super::usual::rounded;
use crate::case::{Case, TabledWheel, TrafficWheel};
use crate::tables::{ContactOrigin, GivenWheel};
use std::f64::consts::PI;

/// Largest ratio of the load of a wheel and half of that of its axle: the dynamic factor and the
/// shift of load in curves.
const LARGEST_RATIO: f64 = 1.7;
/// How close to the expected load a guess must come.
const GUESSED: f64 = 1.3;
/// Weight of a tonne, kN.
const TONNE: f64 = 9.80665;

/// A load of a wheel by the case, kN, and what gives it.
struct Load {
    by: &'static str,
    kn: f64,
}

/// The wheels of `case` whose load is not that of their axle.
pub(super) fn of_loads(case: &Case) -> Vec<Implausible> {
    let of_table = case.wheel_table.as_ref().map_or(case.wheels.len(), |table| table.first);
    let given = case.wheels.get(..of_table).unwrap_or_default();
    let named = |wheel: &TrafficWheel, text: String| match case.is_mix() {
        true => format!("{}: {text}", wheel.name),
        false => text,
    };
    let mut found = Vec::new();
    for wheel in given {
        let loads = loads(&wheel.wheel);
        let unequal = wheel.axle_load.and_then(|tonnes| {
            let load = loads.iter().find(|load| ratio(load.kn, tonnes).is_some())?;
            Some(named(wheel, mismatch(load, tonnes, exchanged(wheel, load.kn, given))))
        });
        found.extend(unequal.map(|text| Implausible { topic: Topic::Load, text }));
    }
    if let Some(table) = &case.wheel_table {
        let common = case.wheels.iter().skip(table.first).find_map(|wheel| wheel.axle_load);
        found.extend(of_table_loads(&table.wheels, common));
    }
    found
}

/// The loads of a wheel: that of its contact, and that of its axle on the track.
fn loads(wheel: &GivenWheel) -> Vec<Load> {
    let of_contact = wheel.given().and_then(|given| match &given.origin {
        ContactOrigin::Ellipse { wheel, .. } => {
            Some(Load { by: "wheel_load_kn", kn: 1e-3 * wheel.wheel_load })
        }
        ContactOrigin::GivenEllipse { ellipse, .. } => {
            let force = 2.0 / 3.0 * PI * ellipse.along * ellipse.across * ellipse.peak_pressure;
            Some(Load { by: "the load of the contact ellipse", kn: 1e-3 * force })
        }
        ContactOrigin::Rolling { patch, .. } => {
            Some(Load { by: "normal_kn", kn: 1e-3 * patch.normal_force() })
        }
        ContactOrigin::Profiles(own) => {
            let force: f64 = own.contacts.iter().map(|contact| contact.normal_force).sum();
            Some(Load { by: "normal_kn", kn: 1e-3 * force })
        }
        ContactOrigin::Given | ContactOrigin::LineLoad { .. } | ContactOrigin::Table(_) => None,
    });
    let own_axle = wheel.track.as_ref().and_then(|track| track.axles.iter().find(|axle| axle.at == 0.0));
    let of_track =
        own_axle.map(|axle| Load { by: "the load of its axle in [track]", kn: 1e-3 * axle.wheel_load });
    of_contact.into_iter().chain(of_track).collect()
}

/// The load of a wheel (kN) over half of `tonnes`, where they differ too much.
fn ratio(kn: f64, tonnes: f64) -> Option<f64> {
    let ratio = kn / expected(tonnes);
    (!(LARGEST_RATIO.recip()..=LARGEST_RATIO).contains(&ratio)).then_some(ratio)
}

/// Load (kN) of a wheel on an axle of `tonnes`.
fn expected(tonnes: f64) -> f64 {
    0.5 * tonnes * TONNE
}

fn is_near(kn: f64, tonnes: f64) -> bool {
    (GUESSED.recip()..=GUESSED).contains(&(kn / expected(tonnes)))
}

/// The wheel of the mix whose axle load the load of `wheel` would suit.
fn exchanged(wheel: &TrafficWheel, kn: f64, all: &[TrafficWheel]) -> Option<String> {
    let other = all.iter().find(|other| other.axle_load.is_some_and(|tonnes| is_near(kn, tonnes)))?;
    (other.name != wheel.name).then(|| other.name.clone())
}

/// The remark on `load` on an axle of `tonnes`.
fn mismatch(load: &Load, tonnes: f64, exchanged: Option<String>) -> String {
    let Load { by, kn } = *load;
    let guess = if is_near(TONNE * kn, tonnes) {
        format!("; {} t = {} kN?", rounded(kn), three_digits(TONNE * kn))
    } else if is_near(1e-3 * kn, tonnes) {
        format!("; {} N = {} kN?", rounded(kn), three_digits(1e-3 * kn))
    } else if is_near(0.5 * kn, tonnes) {
        "; is it the load of the axle, or axle_load_t that of a wheel?".to_owned()
    } else if let Some(other) = exchanged {
        format!("; it suits the axle load of {other}: are they exchanged?")
    } else {
        String::new()
    };
    format!(
        "{by} = {} kN is a wheel of an axle of {} t, but axle_load_t = {}, whose wheels have {} kN: cracks grow by the one, and tonnes are counted by the other{guess}",
        three_digits(kn),
        three_digits(2.0 * kn / TONNE),
        rounded(tonnes),
        three_digits(expected(tonnes))
    )
}

pub(super) fn three_digits(value: f64) -> String {
    rounded(format!("{value:.3e}").parse().unwrap_or(value))
}

/// Vertical load of a wheel of a table, kN.
fn vertical(wheel: &TabledWheel) -> f64 {
    let patches = wheel.wheel.patches.iter();
    1e-3 * patches.map(|own| own.patch.normal_force() * own.angle.unwrap_or(0.0).cos()).sum::<f64>()
}

/// Wheels of a table whose patches carry another load than their axles; axles have `common` tonnes
/// where the table gives none.
fn of_table_loads(wheels: &[TabledWheel], common: Option<f64>) -> Option<Implausible> {
    let tonnes = |wheel: &TabledWheel| wheel.wheel.axle_load.or(common);
    let unequal: Vec<(&TabledWheel, f64, f64)> = wheels
        .iter()
        .filter_map(|wheel| {
            let tonnes = tonnes(wheel)?;
            Some((wheel, tonnes, ratio(vertical(wheel), tonnes)?))
        })
        .collect();
    let size = |of: &(&TabledWheel, f64, f64)| of.2.ln().abs();
    let (worst, tonnes, _) = *unequal.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let suits = wheels.iter().find(|other| tonnes_suit(vertical(worst), other, common));
    let other = suits.map(|other| format!("wheel {}", other.wheel.number));
    let text = mismatch(&Load { by: "the sum of normal_kn", kn: vertical(worst) }, tonnes, other);
    let text = counted(unequal.len(), wheels.len(), &format!("wheel {}: {text}", worst.wheel.number));
    Some(Implausible { topic: Topic::Load, text })
}

fn tonnes_suit(kn: f64, other: &TabledWheel, common: Option<f64>) -> bool {
    other.wheel.axle_load.or(common).is_some_and(|tonnes| is_near(kn, tonnes))
}

/// `text` about one of `count` wheels of `all`.
pub(super) fn counted(count: usize, all: usize, text: &str) -> String {
    if count > 1 { format!("{count} of {all} wheels of the table, such as {text}") } else { text.to_owned() }
}

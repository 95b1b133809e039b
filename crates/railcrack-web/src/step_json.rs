//! A growth step as its page shows it.

use railcrack::growth::{Axles, PassageRecord, StepRecord, TipRecord};
use railcrack::math::MPA_SQRT_MM;
use railcrack::words::Choice;
use railcrack_case::Case;
use serde_json::{Value, json};

/// Lengths in mm, angles in degrees, K in MPa √m; cracks and tips count from 1.
pub(crate) fn step(record: &StepRecord, case: &Case) -> Value {
    let cracks: Vec<Value> = record
        .cracks()
        .iter()
        .map(|crack| crack.points().iter().map(|point| json!([point.x, point.y])).collect())
        .collect();
    let tips: Vec<Value> = record.tips.iter().map(tip).collect();
    json!({
        "step": record.step,
        "load_cycles": record.load_cycles,
        "mgt": case.axle_load.map(|tonnes| Axles(record.load_cycles).mgt(tonnes).0),
        "removed_mm": record.removed,
        "stop": record.stop.map(Choice::word),
        "tips": tips,
        "cracks": cracks,
        "passage": record.passages.last().map(|passage| history(passage, record)),
    })
}

fn tip(tip: &TipRecord) -> Value {
    json!({
        "crack": tip.tip.crack + 1,
        "tip": tip.tip.tip + 1,
        "x_mm": tip.x,
        "y_mm": tip.y,
        "length_mm": tip.length,
        "depth_mm": tip.depth(),
        "delta_ki_mpa_sqrt_m": tip.delta_ki / MPA_SQRT_MM,
        "delta_kii_mpa_sqrt_m": tip.delta_kii / MPA_SQRT_MM,
        "delta_keq_mpa_sqrt_m": tip.delta_keq / MPA_SQRT_MM,
        "rate_mm_per_cycle": tip.rate,
        "increment_mm": tip.increment,
        "kink_deg": tip.kink.map(f64::to_degrees),
        "stop": tip.stop.map(Choice::word),
    })
}

/// The stabilised passage of the first wheel.
fn history(passage: &PassageRecord, record: &StepRecord) -> Value {
    let tips = passage.sifs.iter().zip(&record.tips).map(|(sifs, tip)| {
        let of = |k: fn(&railcrack::fracture::Sif) -> f64| -> Vec<f64> {
            sifs.iter().map(|sif| k(sif) / MPA_SQRT_MM).collect()
        };
        json!({
            "crack": tip.tip.crack + 1,
            "tip": tip.tip.tip + 1,
            "ki_mpa_sqrt_m": of(|sif| sif.ki),
            "kii_mpa_sqrt_m": of(|sif| sif.kii),
        })
    });
    json!({ "xc_mm": passage.xc, "tips": tips.collect::<Vec<Value>>() })
}

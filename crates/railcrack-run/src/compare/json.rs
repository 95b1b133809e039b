//! `compare.json`: the comparison in numbers.

use super::comparison::Comparison;
use super::tables::TipComparison;
use super::tip::{SifDifference, TipSifs};
use crate::disk::{VERSION, sign};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The text of `compare.json`; `tolerance` in per cent of the largest |K| of the case.
/// `checksums` are those of its tables.
pub(super) fn json_text(
    comparison: &Comparison,
    tolerance: Option<f64>,
    checksums: &BTreeMap<String, String>,
) -> String {
    let largest = comparison.largest_percent();
    let mut value = json!({
        "version": VERSION,
        "runs": comparison.runs,
        "case_differences": comparison.case_differences,
        "notes": comparison.notes,
        "life": comparison.life().map(|life| json!({
            "crack": life.crack,
            "length_mm": life.length,
            "load_cycles": life.load_cycles,
            "million_gross_tonnes": life.million_gross_tonnes,
        })),
        "common_steps": comparison.common_steps,
        "peak_mpa_sqrt_m": comparison.peak,
        "dki_largest": largest_of(comparison, |sifs| sifs.ki),
        "dkii_largest": largest_of(comparison, |sifs| sifs.kii),
        "largest_percent": largest,
        "tolerance_percent": tolerance,
        "within_tolerance": tolerance.zip(largest).map(|(tolerance, largest)| largest <= tolerance),
        "tip_distance_largest": comparison.farthest().map(|tip| json!({
            "mm": tip.distance,
            "step": tip.step,
            "crack": tip.crack,
            "tip": tip.tip,
        })),
        "parting": comparison.parting,
        "paths": comparison.cracks,
        "checksums": checksums,
    });
    sign(&mut value);
    format!("{value:#}\n")
}

fn largest_of(comparison: &Comparison, mode: fn(TipSifs) -> SifDifference) -> Option<Value> {
    let (tip, difference) = comparison.largest(mode)?;
    Some(json!({
        "mpa_sqrt_m": difference.largest,
        "percent_of_case": comparison.percent(difference.largest),
        "percent_of_step": tip.percent(difference.largest),
        "step": tip.step,
        "crack": tip.crack,
        "tip": tip.tip,
        "xc_over_a": difference.xc_over_a,
    }))
}

impl Comparison {
    /// The tip and step with the largest difference of a mode; the first of several.
    pub fn largest(&self, mode: fn(TipSifs) -> SifDifference) -> Option<(&TipComparison, SifDifference)> {
        let all = self.tips.iter().filter_map(|tip| Some((tip, mode(tip.sifs()?))));
        all.reduce(|most, next| if next.1.largest > most.1.largest { next } else { most })
    }

    /// The tip and step where the tips of the two runs are farthest apart; the first of several.
    pub fn farthest(&self) -> Option<&TipComparison> {
        self.tips.iter().reduce(|most, next| if next.distance > most.distance { next } else { most })
    }
}

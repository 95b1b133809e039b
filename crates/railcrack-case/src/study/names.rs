//! Names of the keys, values and runs of a study.

use super::axes::Axis;
use super::variation::Variation;
use crate::schema::{Value, short};

/// Digits of a folder's name, at least.
const DIGITS: usize = 3;
/// Maximum length of a title: that accepted in the case file.
const MOST_OF_TITLE: usize = 200;

/// Gives every variation the shortest name that no other one has: `angle_deg`, or
/// `contact.friction` as opposed to `crack[1].friction`.
pub(super) fn name_variations(variations: &mut [Variation]) {
    let keys: Vec<String> = variations.iter().map(|v| v.key.clone()).collect();
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    for variation in variations {
        let short = last(&variation.key);
        let is_alone = keys.iter().filter(|key| last(key) == short).count() == 1;
        variation.name = if is_alone { short } else { variation.key.clone() };
    }
}

impl Variation {
    /// The value at `index` as displayed: `0.025`, `xfem`.
    #[must_use]
    pub fn shown(&self, index: usize) -> String {
        match self.values.get(index) {
            Some(Value::Number(x)) => short(*x),
            Some(Value::Text(text)) => text.clone(),
            Some(other) => other.to_string(),
            None => String::new(),
        }
    }
}

impl Axis {
    /// The values at `index`: `peak_pressure_mpa = 845, half_width_mm = 6.75`.
    #[must_use]
    pub fn label(&self, index: usize) -> String {
        let said: Vec<String> =
            self.variations.iter().map(|v| format!("{} = {}", v.name, v.shown(index))).collect();
        said.join(", ")
    }
}

/// The values of a run: `friction = 0.025, angle_deg = 15`.
pub(super) fn run_label(axes: &[Axis], choice: &[usize]) -> String {
    let said: Vec<String> = axes.iter().zip(choice).map(|(axis, &index)| axis.label(index)).collect();
    said.join(", ")
}

/// The folder of run `number` of `count`: `003`. Its values are listed in `summary.csv`.
pub(super) fn run_folder(number: usize, count: usize) -> String {
    let digits = count.to_string().len().max(DIGITS);
    format!("{number:0digits$}")
}

/// The title of a run: that of the study followed by the values of the run.
pub(super) fn run_title(title: &str, label: &str) -> String {
    format!("{title}: {label}").chars().take(MOST_OF_TITLE).collect()
}

//! Names of the keys, values and runs of a study.

use super::axes::Axis;
use super::variation::Variation;
use crate::schema::{Value, short};

/// Letters of a folder's name after its number, at most: some file systems and many terminals have
/// no room for more.
const MOST_LETTERS: usize = 60;
/// Letters of a title, at most: as many as the case file accepts.
const MOST_OF_TITLE: usize = 200;

/// Gives every variation the shortest name that no other one has: `angle_deg`, or
/// `contact.friction` beside `crack.friction`.
pub(super) fn name_variations(variations: &mut [Variation]) {
    let keys: Vec<String> = variations.iter().map(|v| v.key.clone()).collect();
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    let unnumbered = |key: &str| key.replacen("crack[1].", "crack.", 1);
    let alone = |name: &str, of: &dyn Fn(&str) -> String| keys.iter().filter(|k| of(k) == name).count() == 1;
    let several_cracks = keys.iter().any(|key| key.starts_with("crack[") && !key.starts_with("crack[1]"));
    for variation in variations {
        let (short, middle) = (last(&variation.key), unnumbered(&variation.key));
        variation.name = if alone(&short, &last) {
            short
        } else if several_cracks {
            variation.key.clone()
        } else {
            middle
        };
    }
}

impl Variation {
    /// The value at `index` as people read it: `0.025`, `xfem`.
    #[must_use]
    pub fn shown(&self, index: usize) -> String {
        match self.values.get(index) {
            Some(Value::Number(x)) => short(*x),
            Some(Value::Text(text)) => text.clone(),
            Some(other) => other.to_string(),
            None => String::new(),
        }
    }

    /// The value at `index` for the name of a folder: a list by its number.
    fn in_folder_name(&self, index: usize) -> String {
        match self.values.get(index) {
            Some(Value::Numbers(_) | Value::Points(_) | Value::Groups(_)) => (index + 1).to_string(),
            _ => self.shown(index),
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

/// The folder of run `number` of `count`: `003-friction-0.025-angle_deg-15`.
pub(super) fn run_folder(number: usize, count: usize, axes: &[Axis], choice: &[usize]) -> String {
    let digits = count.to_string().len().max(3);
    let mut name = format!("{number:0digits$}");
    let values = axes.iter().zip(choice).flat_map(|(axis, &index)| {
        axis.variations.iter().map(move |v| format!("{}-{}", v.name, v.in_folder_name(index)))
    });
    for value in values {
        let safe: String = value
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() || "._+-".contains(c) { c } else { '-' })
            .collect();
        name.push('-');
        name.push_str(&safe);
    }
    // Plain letters, so that bytes are letters.
    name.truncate(digits + 1 + MOST_LETTERS);
    name.trim_end_matches(['-', '.']).to_owned()
}

/// The title of a run: that of the study with the values behind it.
pub(super) fn run_title(title: &str, label: &str) -> String {
    format!("{title}: {label}").chars().take(MOST_OF_TITLE).collect()
}

//! Plan of a study: the runs that it computes.

use super::population_plan::PopulationPlan;
use crate::disk::Checksum;
use serde::{Deserialize, Serialize};

/// Keys that vary in a study, how, and the runs that this makes. `study.json` holds it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyPlan {
    /// Version of the program that began the study.
    pub version: String,
    /// Heading of the plots.
    pub title: String,
    /// `product` or `zip`.
    pub combine: String,
    /// The varied keys; at least one.
    pub axes: Vec<StudyAxis>,
    /// The axis whose values have the colours of the plots, from 0.
    pub colour_axis: usize,
    /// Whether each run has a folder of its own; if not, those that are done are packed.
    #[serde(default = "with_folders")]
    pub run_folders: bool,
    /// Checksum of the text of the study; none in studies of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// Options of the command that replace values of the file: `--steps 2`.
    pub options: Vec<String>,
    /// Facts of the cases that samples between the runs take; none where none are made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub population: Option<PopulationPlan>,
    /// Every run.
    pub runs: Vec<PlannedRun>,
}

/// The value of studies without the entry.
fn with_folders() -> bool {
    true
}

/// Keys that vary together.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StudyAxis {
    /// The keys; at least one, all with the same number of values.
    pub keys: Vec<StudyKey>,
}

/// A key that varies.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StudyKey {
    /// Its name with its section, `crack[1].angle_deg`: a column of `summary.csv`.
    pub key: String,
    /// The shortest name that distinguishes it from the others: `angle_deg`.
    pub name: String,
    /// Its values as text; numbers read back to the same bits.
    pub values: Vec<String>,
    /// The distribution that they are drawn from, as TOML; none of a list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distribution: Option<String>,
}

/// A run of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlannedRun {
    /// Its number, from 1.
    pub number: usize,
    /// The name of its run folder in `runs/`.
    pub folder: String,
    /// The value that it takes of each axis, from 0.
    pub choice: Vec<usize>,
    /// Checksum of its case and of the files that it names; none in studies of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub case: Option<String>,
}

impl StudyAxis {
    /// Number of its values.
    pub fn len(&self) -> usize {
        self.keys.first().map_or(0, |key| key.values.len())
    }

    /// Whether its values are drawn from distributions.
    pub fn is_drawn(&self) -> bool {
        self.keys.iter().any(|key| key.distribution.is_some())
    }

    /// Whether it has no value, which does not occur in a study.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The varied keys: `peak_pressure_mpa, half_width_mm`.
    pub fn name(&self) -> String {
        self.keys.iter().map(|key| key.name.as_str()).collect::<Vec<_>>().join(", ")
    }

    /// The values at `index`: `845, 6.75`.
    pub fn value(&self, index: usize) -> String {
        let values = self.keys.iter().filter_map(|key| key.values.get(index).map(String::as_str));
        values.collect::<Vec<_>>().join(", ")
    }

    /// The values of its first key where they are numbers.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.keys.first()?.values.iter().map(|value| value.parse().ok()).collect()
    }
}

impl StudyPlan {
    /// The checksum of the cases of all runs, which distinguishes the study from others.
    pub(crate) fn checksum(&self) -> String {
        let of_run = |run: &PlannedRun| {
            [&run.number.to_le_bytes()[..], run.case.as_deref().unwrap_or_default().as_bytes()].concat()
        };
        Checksum::of(&self.runs.iter().flat_map(of_run).collect::<Vec<u8>>()).to_string()
    }

    /// The keys that vary, axis by axis, with the value that `run` has of each.
    pub fn values_of<'a>(&'a self, run: &'a PlannedRun) -> impl Iterator<Item = (&'a StudyKey, &'a str)> {
        self.axes.iter().zip(&run.choice).flat_map(|(axis, &index)| {
            axis.keys.iter().map(move |key| (key, key.values.get(index).map_or("", String::as_str)))
        })
    }
}

//! The runs of a study that differ in the keys that are drawn, and samples of these keys.

use super::interpolation::Interpolation;
use crate::decision::{Draws, Gathered, ScatterSummary};
use crate::study::{PopulationPlan, RunState, StudyAxis, StudyRow};
use railcrack::math::Matrix;
use railcrack_case::{Distribution, Scatter};

/// Maximum number of runs used for interpolation.
pub(super) const MOST_RUNS: usize = 200;

/// Runs with the index of their values of the drawn keys.
pub(super) type IndexedRuns<'a> = Vec<(usize, &'a StudyRow)>;

/// Runs of a study with the same values of the keys that are not drawn.
pub(super) struct DrawnRuns<'a> {
    pub plan: &'a PopulationPlan,
    /// The keys that are drawn, and their distributions.
    pub axis: &'a StudyAxis,
    pub distributions: &'a [Distribution],
    pub runs: IndexedRuns<'a>,
}

impl<'a> DrawnRuns<'a> {
    /// The finished runs.
    pub fn done(&self) -> impl Iterator<Item = (usize, &'a StudyRow)> {
        self.runs.iter().copied().filter(|(_, row)| row.state == RunState::Done)
    }

    /// The values at `index` in standard deviations.
    pub fn inputs(&self, index: usize) -> Option<Vec<f64>> {
        let values = self.axis.keys.iter().zip(self.distributions);
        values.map(|(key, distribution)| distribution.standardised(key.values.get(index)?)).collect()
    }

    /// `values` interpolated over the `inputs` of runs, a row for each.
    ///
    /// Errors: these are too few.
    pub fn interpolated(&self, inputs: &[Vec<f64>], values: &Matrix) -> Result<Interpolation, String> {
        let few = || format!("{} runs are too few for {} keys", inputs.len(), self.distributions.len());
        Interpolation::of(inputs, values).ok_or_else(few)
    }

    /// The inputs of a sample.
    pub fn draw(&self, draws: &mut Draws) -> Vec<f64> {
        let drawn = |of: &Distribution| of.standardised(&of.value(draws.share())).unwrap_or(0.0);
        self.distributions.iter().map(drawn).collect()
    }

    /// The results of the `gathered` samples, which have these `inputs`, at an inspection
    /// `interval` in million gross tonnes.
    pub fn summary(
        &self,
        gathered: Gathered,
        scatter: &Scatter,
        interval: Option<f64>,
        inputs: &[Vec<f64>],
    ) -> ScatterSummary {
        let names = self.axis.keys.iter().map(|key| key.name.as_str());
        let sensitivities = gathered.sensitivities(scatter, names, inputs);
        gathered.summary(scatter, interval, false, sensitivities)
    }
}

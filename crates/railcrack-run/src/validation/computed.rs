//! The distribution of a quantity under conditions with their uncertainty.

use crate::calibration::{Measure, SizeCurve};
use crate::csv::TipRow;
use crate::simulation::{RunObserver, Simulation};
use railcrack_case::{Case, CaseErrors, Overrides, Quantity, Study};
use rayon::prelude::*;
use std::path::Path;

/// Conditions with their uncertainty: a study, of whose samples the growth in depth is computed
/// once for all entries that name it.
#[derive(Debug, Clone)]
pub struct Conditions {
    cases: Vec<Case>,
    /// Depth over traffic of each sample; empty before they are computed.
    curves: Vec<SizeCurve>,
}

/// The exponent of a law is its slope between these ranges of K (MPa√m), the middle of tests with
/// rail steels, at this R.
const SLOPE: [f64; 2] = [10.0, 20.0];
const SLOPE_RATIO: f64 = 0.1;

/// The values that the samples give.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// Ascending.
    pub values: Vec<f64>,
    /// Samples without a value: their crack does not reach the depth.
    pub without: usize,
}

impl Conditions {
    /// The samples of the study in `text`, which errors call `name`; its files are relative to
    /// `folder`.
    ///
    /// Errors: all of the study.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self, CaseErrors> {
        let study = Study::parse_with(text, name, folder, &Overrides::default())?;
        Ok(Self { cases: study.runs.into_iter().map(|run| run.case).collect(), curves: Vec::new() })
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.cases.len()
    }

    /// Computes the growth of every sample, one on each core; `observer` is asked whether to stop,
    /// and hears of each step. A sample that cannot be computed reaches no depth.
    pub fn compute(&mut self, observer: &dyn RunObserver) {
        let curve = |case: &Case| {
            let Some(tonnes) = case.axle_load else { return SizeCurve::through(Vec::new()) };
            let simulation = Simulation::new(case).observed_by(observer).sampled_by_its_study().of_a_study();
            let (run, _) = simulation.run_in_memory(Path::new("."), None);
            let rows: Vec<TipRow> = run.growth_rows().filter(|row| (row.crack, row.tip) == (1, 1)).collect();
            SizeCurve::of(&rows, tonnes, Measure::Depth)
        };
        self.curves = self.cases.par_iter().map(curve).collect();
    }

    /// The distribution of `quantity`.
    #[must_use]
    pub fn predict(&self, quantity: Quantity) -> Predicted {
        let rate = |curve: &SizeCurve, (from, to): (f64, f64)| {
            let passed = curve.reaches(to)?.0 - curve.reaches(from)?.0;
            (passed > 0.0).then(|| (to - from) / passed)
        };
        let of_curves = |of: &dyn Fn(&SizeCurve) -> Option<f64>| -> Vec<f64> {
            self.curves.iter().filter_map(of).collect()
        };
        let law = |of: &dyn Fn(&Case) -> f64| -> Vec<f64> { self.cases.iter().map(of).collect() };
        let mut values = match quantity {
            Quantity::DepthRate { from, to } => of_curves(&|curve| rate(curve, (from, to))),
            Quantity::DepthRateRatio { depths, over } => {
                of_curves(&|curve| Some(rate(curve, depths)? / rate(curve, over)?))
            }
            Quantity::LawRate { delta_k, ratio } => law(&|case| case.growth.law.rate.rate(delta_k, ratio)),
            Quantity::LawExponent => {
                let [low, high] = SLOPE;
                let rate = |case: &Case, delta: f64| case.growth.law.rate.rate(delta, SLOPE_RATIO);
                law(&|case| (rate(case, high) / rate(case, low)).ln() / (high / low).ln())
            }
        };
        values.retain(|value| *value > 0.0 && value.is_finite());
        values.sort_by(f64::total_cmp);
        let without = self.samples().saturating_sub(values.len());
        Predicted { values, without }
    }
}

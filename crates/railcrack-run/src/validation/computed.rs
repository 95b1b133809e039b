//! The distribution of a quantity under conditions with their uncertainty.

use super::straight::straight_curve;
use crate::calibration::{Measure, SizeCurve};
use crate::csv::TipRow;
use crate::simulation::{RunObserver, Simulation};
use railcrack_case::{Case, CaseErrors, Overrides, Quantity, Study};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// Conditions with their uncertainty: a study, of whose samples the growth in depth is computed
/// once for all entries that name it.
///
/// A study whose runs have increments grows the crack of each sample. One without, and with a list
/// of lengths, computes the rate of straight cracks of these lengths: a sample then has a run for
/// each length, and depth over load cycles follows by integration of the rate.
#[derive(Debug, Clone)]
pub struct Conditions {
    cases: Vec<Case>,
    /// The runs of each sample, by their places in `cases`.
    samples: Vec<Vec<usize>>,
    /// Depth of each sample over load cycles (millions) and tonnes per axle; empty before they are
    /// computed.
    curves: Vec<(SizeCurve, Option<f64>)>,
}

/// The exponent of a law is its slope between these ranges of K (MPa√m), the middle of tests with
/// rail steels, at this R.
const SLOPE: [f64; 2] = [10.0, 20.0];
const SLOPE_RATIO: f64 = 0.1;
/// The key by which the lengths of straight cracks vary.
const LENGTH: &str = "crack[1].length_mm";

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
        let is_straight = study.runs.iter().all(|run| run.case.growth.steps == 0);
        let of_lengths = study
            .axes
            .iter()
            .position(|axis| axis.variations.iter().any(|of| of.key == LENGTH && of.distribution.is_none()));
        let mut samples: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for (place, run) in study.runs.iter().enumerate() {
            let mut choice = run.choice.clone();
            if let (true, Some(axis)) = (is_straight, of_lengths) {
                choice[axis] = 0;
            }
            samples.entry(choice).or_default().push(place);
        }
        Ok(Self {
            cases: study.runs.into_iter().map(|run| run.case).collect(),
            samples: samples.into_values().collect(),
            curves: Vec::new(),
        })
    }

    /// The files that its cases name, relative to its folder.
    pub(super) fn named_files(&self) -> impl Iterator<Item = &str> {
        self.cases.iter().flat_map(|case| case.companions().into_iter().map(|file| file.given))
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// Number of runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.cases.len()
    }

    /// Computes the growth of every sample, one run on each core; `observer` is asked whether to
    /// stop, and hears of each step. A sample that cannot be computed reaches no depth.
    pub fn compute(&mut self, observer: &dyn RunObserver) {
        let rows = |case: &Case| -> Vec<TipRow> {
            let simulation = Simulation::new(case).observed_by(observer).sampled_by_its_study().of_a_study();
            let (run, _) = simulation.run_in_memory(Path::new("."), None);
            run.growth_rows().filter(|row| row.crack == 1).collect()
        };
        let rows: Vec<Vec<TipRow>> = self.cases.par_iter().map(rows).collect();
        let curve = |runs: &Vec<usize>| {
            let curve = match runs.as_slice() {
                [grown] => {
                    let of_tip: Vec<TipRow> =
                        rows[*grown].iter().filter(|row| row.tip == 1).cloned().collect();
                    SizeCurve::of(&of_tip, 1.0, Measure::Depth)
                }
                all => straight_curve(all.iter().map(|&run| rows[run].as_slice())),
            };
            (curve, runs.first().and_then(|&run| self.cases[run].axle_load))
        };
        self.curves = self.samples.iter().map(curve).collect();
    }

    /// Load cycles (millions) of each sample from one depth (mm) to another; none where its crack
    /// does not reach them.
    fn lives(&self, (from, to): (f64, f64)) -> Vec<Option<f64>> {
        let life = |(curve, _): &(SizeCurve, Option<f64>)| {
            let passed = curve.reaches(to)?.0 - curve.reaches(from)?.0;
            (passed > 0.0).then_some(passed)
        };
        self.curves.iter().map(life).collect()
    }

    /// The distribution of `quantity`; `over` are the conditions of the denominator of a ratio of
    /// lives.
    #[must_use]
    pub fn predict(&self, quantity: Quantity, over: Option<&Self>) -> Predicted {
        let per_cycle = |depths: (f64, f64)| {
            let rate = move |life: Option<f64>| life.map(|life| 1e-6 * (depths.1 - depths.0) / life);
            self.lives(depths).into_iter().map(rate)
        };
        let law = |of: &dyn Fn(&Case) -> f64| -> Vec<f64> {
            self.samples.iter().filter_map(|runs| Some(of(&self.cases[*runs.first()?]))).collect()
        };
        let mut values: Vec<f64> = match quantity {
            Quantity::DepthRate { from, to } => {
                let tonnes = self.curves.iter().map(|(_, tonnes)| *tonnes);
                per_cycle((from, to))
                    .zip(tonnes)
                    .filter_map(|(rate, tonnes)| Some(1e6 * rate? / tonnes?))
                    .collect()
            }
            Quantity::DepthPerCycle { from, to } => per_cycle((from, to)).flatten().collect(),
            Quantity::DepthRateRatio { depths, over } => {
                per_cycle(depths).zip(per_cycle(over)).filter_map(|(rate, of)| Some(rate? / of?)).collect()
            }
            Quantity::LifeRatio { from, to } => {
                let of = over.map_or_else(Vec::new, |over| over.lives((from, to)));
                self.lives((from, to))
                    .into_iter()
                    .zip(of)
                    .filter_map(|(life, of)| Some(life? / of?))
                    .collect()
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

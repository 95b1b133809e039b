//! The runs of all set-ups, by set-up and curve.

use crate::case_run::CaseRun;
use crate::curve::{CURVES, PaperCurve};
use crate::setup::{SETUPS, Setup};
use std::collections::BTreeMap;
use std::sync::Arc;

/// All runs that were computed.
#[derive(Default)]
pub struct Results {
    /// By set-up and curve, in the order of [`SETUPS`] and [`CURVES`].
    pub(super) runs: BTreeMap<(usize, usize), Arc<CaseRun>>,
}

/// The runs of one set-up.
#[derive(Clone, Copy)]
pub struct SetupResults<'a> {
    results: &'a Results,
    /// Its place in [`SETUPS`].
    pub index: usize,
}

impl Results {
    /// The runs of the set-up `name`.
    pub fn setup(&self, name: &str) -> Option<SetupResults<'_>> {
        let index = SETUPS.iter().position(|setup| setup.name == name)?;
        Some(SetupResults { results: self, index })
    }

    /// All set-ups that have runs, in the order of [`SETUPS`].
    pub fn setups(&self) -> impl Iterator<Item = SetupResults<'_>> {
        (0..SETUPS.len())
            .filter(|&index| self.runs.range((index, 0)..(index + 1, 0)).next().is_some())
            .map(|index| SetupResults { results: self, index })
    }
}

impl<'a> SetupResults<'a> {
    /// The set-up.
    pub fn setup(self) -> &'static Setup {
        &SETUPS[self.index]
    }

    /// The run of the curve `name`; none where this set-up has none.
    pub fn run(self, name: &str) -> Option<&'a CaseRun> {
        let curve = CURVES.iter().position(|curve| curve.name == name)?;
        self.results.runs.get(&(self.index, curve)).map(Arc::as_ref)
    }

    /// The same, if its cracks have grown.
    pub fn grown(self, name: &str) -> Option<&'a CaseRun> {
        self.run(name).filter(|run| run.steps_wanted > 0)
    }

    /// The same curve in another set-up.
    pub fn elsewhere(self, setup: &str, name: &str) -> Option<&'a CaseRun> {
        self.results.setup(setup)?.run(name)
    }

    /// Warnings of the runs behind `figures`, a sentence for each run that has any.
    pub fn warnings(self, figures: &[u8]) -> Vec<String> {
        let behind = |curve: &&PaperCurve| figures.iter().any(|figure| curve.figures.contains(figure));
        let runs = CURVES.iter().filter(behind).filter_map(|curve| Some((curve, self.run(curve.name)?)));
        let sentence = |(curve, run): (&PaperCurve, &CaseRun)| {
            let first = run.warnings.first()?;
            Some(match run.warnings.len() {
                1 => format!("{}, {first}", curve.legend),
                many => format!("{}, {many} warnings, the first in {first}", curve.legend),
            })
        };
        runs.filter_map(sentence).collect()
    }

    /// The curves of `figure` with their runs.
    pub fn of_figure(self, figure: u8) -> impl Iterator<Item = (&'static PaperCurve, &'a CaseRun)> {
        let curves = CURVES.iter().filter(move |curve| curve.figures.contains(&figure));
        curves.filter_map(move |curve| Some((curve, self.run(curve.name)?)))
    }
}

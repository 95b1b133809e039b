//! The runs of all set-ups, by set-up and curve.

use crate::case_run::{CaseRun, CrackGrowth};
use crate::tables::{Paper, Setup};
use std::collections::BTreeMap;
use std::sync::Arc;

/// All runs that were computed.
#[derive(Default)]
pub struct Results {
    /// By set-up and curve, in the order of [`Paper`].
    pub runs: BTreeMap<(usize, usize), Arc<CaseRun>>,
    /// Runs that a step ended early, with the reason.
    pub failures: Vec<(String, String)>,
    /// Number of runs.
    pub count: usize,
}

/// The runs of one set-up.
#[derive(Clone, Copy)]
pub struct SetupResults<'a> {
    /// The tables of the paper.
    pub paper: &'a Paper,
    results: &'a Results,
    /// Its place among the set-ups.
    pub index: usize,
}

impl Results {
    /// The runs of the set-up `name`.
    pub fn setup<'a>(&'a self, paper: &'a Paper, name: &str) -> Option<SetupResults<'a>> {
        let index = paper.setups.iter().position(|setup| setup.name == name)?;
        Some(SetupResults { paper, results: self, index })
    }

    /// All set-ups that have runs, in their order.
    pub fn setups<'a>(&'a self, paper: &'a Paper) -> impl Iterator<Item = SetupResults<'a>> {
        (0..paper.setups.len())
            .filter(|&index| self.runs.range((index, 0)..(index + 1, 0)).next().is_some())
            .map(move |index| SetupResults { paper, results: self, index })
    }
}

impl<'a> SetupResults<'a> {
    /// The set-up.
    pub fn setup(self) -> &'a Setup {
        &self.paper.setups[self.index]
    }

    /// The run of the curve `name`; none where this set-up has none.
    pub fn run(self, name: &str) -> Option<&'a CaseRun> {
        let curve = self.paper.curves.iter().position(|curve| curve.name == name)?;
        self.results.runs.get(&(self.index, curve)).map(Arc::as_ref)
    }

    /// The run of the curve `name` if its cracks have grown.
    pub fn grown(self, name: &str) -> Option<&'a CaseRun> {
        self.run(name).filter(|run| run.grows)
    }

    /// The only crack of the curve `name`, or its first.
    pub fn crack(self, name: &str) -> Option<&'a CrackGrowth> {
        self.run(name)?.cracks.first()
    }

    /// The runs of another set-up.
    pub fn elsewhere(self, setup: &str) -> Option<Self> {
        self.results.setup(self.paper, setup)
    }

    /// The legends of the curves of `figures` whose runs have warnings.
    pub fn curves_with_warnings(self, figures: &[u8]) -> Vec<&'a str> {
        let concerned = self.paper.curves.iter().filter(|curve| {
            curve.figures.iter().any(|figure| figures.contains(figure))
                && self.run(&curve.name).is_some_and(|run| !run.warnings.is_empty())
        });
        concerned.map(|curve| curve.legend.as_str()).collect()
    }
}

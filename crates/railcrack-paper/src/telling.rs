//! Observer of the runs, and treatment of existing results.

use railcrack::growth::Observer;

/// An observer of all runs, who may interrupt them.
pub trait Telling: Observer {
    /// Number of runs to compute.
    fn planned(&self, runs: usize);
    /// The run `name` has finished after `wall_s` seconds.
    fn finished(&self, name: &str, wall_s: f64);
}

/// Treatment of existing results in the folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Earlier {
    /// Existing results are an error.
    Refuse,
    /// They are replaced.
    Replace,
    /// Runs of the same cases by the same version are reused, the others are computed.
    TakeOver,
}

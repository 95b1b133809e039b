//! The observer of all runs, and the treatment of earlier results.

use railcrack::growth::Observer;

/// An observer of all runs, who may interrupt them.
pub trait Telling: Observer {
    /// So many runs are to be done.
    fn planned(&self, runs: usize);
    /// The run `name` is done, after `wall_s` seconds.
    fn finished(&self, name: &str, wall_s: f64);
}

/// Treatment of results that are in the folder already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Earlier {
    /// They stay: an error.
    Refuse,
    /// They are replaced.
    Replace,
    /// Runs of the same cases by the same version are taken over, the rest is computed.
    TakeOver,
}

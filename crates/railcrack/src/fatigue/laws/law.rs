//! Traits that all laws of the growth rate share.

use super::RateLaw;

/// A rate (mm per cycle) that stands for a crack that runs away: a metre per cycle.
pub const RUNAWAY: f64 = 1e3;

/// A law of the growth rate under ranges of K in MPa√m.
pub(super) trait Law {
    /// da/dN, mm per cycle, under the equivalent range `delta` (MPa√m) with the ratio `ratio` of
    /// the smallest to the largest K; zero where nothing grows, infinite where the crack runs away.
    fn rate(&self, delta: f64, ratio: f64) -> f64;

    /// A quantity that grows with the rate and is not flattened by a threshold, so that a direction
    /// can be found below it; none where it is `delta` itself, in whatever unit.
    fn drive(&self, _delta: f64, _ratio: f64) -> Option<f64> {
        None
    }

    /// The threshold of the range, MPa√m; none where the law has no constant for it.
    fn threshold(&self) -> Option<f64> {
        None
    }

    /// The same law with another threshold, where it has a constant for it.
    fn with_threshold(&self, _threshold: f64) -> Option<RateLaw> {
        None
    }

    /// The exponent of the rate in [`Law::drive`], far from a threshold.
    fn exponent(&self) -> f64;

    /// The values of the constants in the order of the declaration; none of a table.
    fn constants(&self) -> Vec<f64>;

    /// The same law with all its rates times `factor`.
    fn times(&self, factor: f64) -> RateLaw;

    /// The law with its constants, `dK` for the equivalent range: `da/dN = …`, mm per cycle and
    /// MPa√m.
    fn formula(&self) -> String;
}

/// A threshold as a condition.
pub(super) fn above(threshold: f64) -> String {
    if threshold > 0.0 { format!(" above dK = {threshold}") } else { String::new() }
}

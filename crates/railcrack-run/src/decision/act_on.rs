//! The interval to act on: the one of several that keeps every limit, and what it rests on.

use super::risk::{IntervalForTarget, Risk, Stored};
use serde::{Deserialize, Serialize};

/// The probability of failure before detection with inspections at an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RiskAtInterval {
    /// The interval, million gross tonnes.
    pub interval_mgt: f64,
    /// The probability.
    pub probability: f64,
}

/// The probability of missing a crack that is accepted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accepted {
    /// That of the case, where it gives one.
    pub target: Option<f64>,
    /// That which the safety factor stands for.
    pub most_missed: f64,
}

/// The inspection interval to act on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct IntervalToActOn {
    /// The interval, million gross tonnes.
    pub interval_mgt: f64,
    /// The same in months, where the case gives the traffic of a year.
    pub interval_months: Option<f64>,
    /// The probability that a crack fails before inspections at this interval find it.
    pub probability: f64,
    /// Its basis.
    pub basis: IntervalBasis,
}

/// The basis of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalBasis {
    /// The window of the run, divided by the safety factor.
    SafetyFactor,
    /// The largest interval that keeps the target risk of the case.
    TargetRisk,
    /// The largest interval at which no more cracks are missed than the safety factor stands for.
    MissedCracks,
}

impl IntervalToActOn {
    /// That of the run, whose interval by the safety factor is `by_safety`, if its `risk` is no
    /// larger than is accepted, and otherwise the largest that keeps it, for the target of the case
    /// the one `for_target`; none where no interval does.
    pub(super) fn of(
        risk: &Risk<'_, impl Stored>,
        Accepted { target, most_missed }: Accepted,
        by_safety: Option<RiskAtInterval>,
        for_target: Option<IntervalForTarget>,
    ) -> Option<Self> {
        let most = target.unwrap_or(most_missed);
        let new = |at: RiskAtInterval, basis: IntervalBasis| Self {
            interval_mgt: at.interval_mgt,
            interval_months: None,
            probability: at.probability,
            basis,
        };
        if target.is_some() && for_target.is_none() {
            return None;
        }
        if let Some(at) = by_safety.filter(|at| at.probability <= most) {
            return Some(new(at, IntervalBasis::SafetyFactor));
        }
        let (largest, basis) = match target {
            Some(_) => (for_target?, IntervalBasis::TargetRisk),
            None => {
                by_safety?;
                (risk.interval_for(most), IntervalBasis::MissedCracks)
            }
        };
        let IntervalForTarget::Mgt(interval_mgt) = largest else { return None };
        let at = RiskAtInterval { interval_mgt, probability: risk.probability(interval_mgt) };
        Some(new(at, basis))
    }

    /// The same in months of `mgt_per_year`, where it is known.
    pub(super) fn in_months(self, mgt_per_year: Option<f64>) -> Self {
        Self { interval_months: mgt_per_year.map(|year| 12.0 * self.interval_mgt / year), ..self }
    }
}

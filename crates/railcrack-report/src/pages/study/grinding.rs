//! The least grinding of a maintenance study.

use crate::figures::StudyRun;
use crate::numbers::given;
use railcrack_run::decision::VerdictLevel;
use railcrack_run::study::RunState;

/// A grinding plan with the runs that have it.
struct GroundRuns {
    /// Depth of each grinding, mm.
    depth: f64,
    /// Million gross tonnes between two of them.
    interval: f64,
    /// Whether each of the runs is finished and ends without a failure.
    holds: bool,
}

impl GroundRuns {
    /// Removal, mm per million gross tonnes.
    fn removal(&self) -> f64 {
        self.depth / self.interval
    }
}

/// The least grinding of a study that varies it with which no run fails, in a sentence; none where
/// all runs have the same grinding.
pub(super) fn least(all: &[StudyRun]) -> Option<String> {
    let mut plans: Vec<GroundRuns> = Vec::new();
    for run in all {
        let Some(decision) = run.row.summary.as_ref().and_then(|summary| summary.decision.as_ref()) else {
            continue;
        };
        let Some(plan) = decision.maintenance.as_ref() else { continue };
        let Some((depth, interval)) = plan.grinding_mm.zip(plan.grinding_interval_mgt) else { continue };
        let holds = run.row.state == RunState::Done
            && decision.failure.mgt.is_none()
            && decision.verdict.level == VerdictLevel::Ok;
        match plans.iter_mut().find(|plan| (plan.depth, plan.interval) == (depth, interval)) {
            Some(plan) => plan.holds &= holds,
            None => plans.push(GroundRuns { depth, interval, holds }),
        }
    }
    (plans.len() > 1).then(|| sentence(&plans))
}

fn sentence(plans: &[GroundRuns]) -> String {
    let least = plans.iter().filter(|plan| plan.holds).min_by(|one, other| {
        one.removal().total_cmp(&other.removal()).then(one.depth.total_cmp(&other.depth))
    });
    match least {
        Some(plan) => format!(
            "The least of the {} grinding plans with which no run fails within its steps is {} mm every {} MGT, {} mm per MGT.",
            plans.len(),
            given(plan.depth),
            given(plan.interval),
            given(plan.removal())
        ),
        None => format!("With each of the {} grinding plans some run fails.", plans.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_is_that_of_the_smallest_removal() {
        let plan = |depth, interval, holds| GroundRuns { depth, interval, holds };
        let plans = [plan(0.2, 10.0, true), plan(0.1, 10.0, true), plan(0.05, 10.0, false)];
        let text = sentence(&plans);
        assert!(text.contains("0.1 mm every 10 MGT, 0.01 mm per MGT"), "{text}");
        assert!(sentence(&plans[2..]).starts_with("With each of the 1"), "{}", sentence(&plans[2..]));
    }
}

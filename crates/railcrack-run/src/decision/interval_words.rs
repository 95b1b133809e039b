//! The interval to act on as a sentence.

use super::act_on::IntervalBasis;
use super::inspection::InspectionSummary;
use super::risk_summary::{RiskSummary, TargetKept};
use super::tonnage::{TonnageWords, three_digits};

/// The interval to act on in words, and what it rests on: one sentence for terminal and pages. None
/// where no inspection is asked for, or the run says nothing about it.
#[must_use]
pub fn interval_in_words(
    inspection: Option<&InspectionSummary>,
    risk: &RiskSummary,
    words: TonnageWords,
) -> Option<String> {
    let inspection = inspection?;
    let target = risk.target_risk.map(three_digits);
    let Some(of) = risk.act_on else {
        return match (target, risk.target_kept?) {
            (Some(target), TargetKept::AtAnyInterval) => Some(format!(
                "a probability of {target} that the crack fails before it is found is kept without inspections"
            )),
            (Some(target), TargetKept::NotKnown) => Some(format!(
                "no inspection interval: too many samples outlive what is computed to keep a probability of {target}"
            )),
            (Some(target), _) => Some(format!("no interval keeps {target}, the probability accepted")),
            (None, _) => None,
        };
    };
    let missed = format!("a crack is missed with a probability of {}", three_digits(of.probability));
    let why = match of.basis {
        IntervalBasis::SafetyFactor => format!(
            "the {} in which inspections can find the crack before the failure, divided by {}; {missed}",
            inspection.mgt_detectable_to_critical.map_or_else(String::new, three_digits),
            inspection.safety_factor
        ),
        IntervalBasis::TargetRisk => format!("the longest at which {missed}"),
        IntervalBasis::MissedCracks => format!(
            "the longest at which {missed}; at the window divided by {} it would be {}",
            inspection.safety_factor,
            risk.risk_at_interval.map_or_else(String::new, |at| three_digits(at.probability))
        ),
    };
    let hidden =
        inspection.longest_hidden_mgt.filter(|hidden| *hidden > 0.0).map_or_else(String::new, |mgt| {
            format!(
                "; after it was first detectable the crack hides for up to {} million gross tonnes",
                three_digits(mgt)
            )
        });
    Some(format!("inspection interval {}: {why}{hidden}", words.of(of.interval_mgt)))
}

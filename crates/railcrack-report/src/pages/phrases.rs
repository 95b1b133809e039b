//! Phrases of results as sentences.

use crate::numbers::{given, grouped, tonnage};
use railcrack_run::decision::{Quantiles, ScatterSummary};

/// The quantiles of the depth, by what they are of the growth: the deep cracks are the fast ones.
pub(super) const SLOW_GROWTH: &str = "slow growth: 5 % of the samples are less deep";
pub(super) const FAST_GROWTH: &str = "fast growth: 5 % of the samples are deeper";

/// Traffic from detectable to critical in the samples; none if fewer than half become critical.
pub(super) fn detectable_to_critical(scatter: &ScatterSummary) -> Option<String> {
    let Quantiles { p05, p50, p95 } = scatter.mgt_detectable_to_critical;
    let shown = |mgt: Option<f64>| mgt.map_or_else(|| "more than computed".to_owned(), tonnage);
    let mut text = format!(
        "Traffic from the detectable to the critical crack: median {} MGT of {} samples, 5 % quantile {} (fast growth), 95 % quantile {} (slow growth).",
        shown(Some(p50?)),
        grouped(scatter.samples as f64),
        shown(p05),
        shown(p95)
    );
    if let Some(probability) = scatter.probability_critical_before_inspection {
        text.push_str(&format!(
            " Probability that a crack just missed by an inspection becomes critical before the next one: {}.",
            given(probability)
        ));
    }
    Some(text)
}

/// `text` as a complete sentence.
pub(super) fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map_or_else(String::new, |letter| letter.to_uppercase().collect());
    let end = if text.ends_with('.') { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// How well absolute rates are known; none of a folder that does not say it.
pub(super) fn calibration(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| sentence(text))
}

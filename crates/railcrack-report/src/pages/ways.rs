//! Traffic from the detectable to the critical crack.

use crate::numbers::{given, grouped, tonnage};
use railcrack_run::decision::{Quantiles, ScatterSummary};

/// Traffic from detectable to critical in the samples; none if fewer than half become critical.
pub(super) fn ways(scatter: &ScatterSummary) -> Option<String> {
    let Quantiles { p05, p50, p95 } = scatter.mgt_detectable_to_critical;
    let shown = |mgt: Option<f64>| mgt.map_or_else(|| "more than computed".to_owned(), tonnage);
    let mut text = format!(
        "Traffic from the detectable to the critical crack: median {} MGT of {} samples, 5 % quantile {}, 95 % quantile {}.",
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

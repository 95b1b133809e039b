//! The way from detectable to critical in words.

use crate::numbers::{grouped, significant, tonnage};
use railcrack_run::decision::{Quantiles, ScatterSummary};

/// The way from detectable to critical in the samples; none where half of them do not get there.
pub(super) fn ways(scatter: &ScatterSummary) -> Option<String> {
    let Quantiles { p05, p50, p95 } = scatter.mgt_detectable_to_critical;
    let shown = |mgt: Option<f64>| mgt.map_or_else(|| "more than the run".to_owned(), tonnage);
    let mut text = format!(
        "From detectable to critical it takes {} MGT in the median of {} samples, {} at 5 % and {} at 95 %.",
        shown(Some(p50?)),
        grouped(scatter.samples as f64),
        shown(p05),
        shown(p95)
    );
    if let Some(probability) = scatter.probability_critical_before_inspection {
        text.push_str(&format!(
            " A crack that was just missed is critical before the next inspection with a probability of {}.",
            significant(probability)
        ));
    }
    Some(text)
}

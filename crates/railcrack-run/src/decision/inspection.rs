//! Inspection interval: the traffic from a detectable crack to the failure of the rail, divided by
//! a safety factor.

use super::course::FailureMode;
use super::failure::Nominal;
use super::rows::{DecisionRow, depth_at};
use railcrack_case::Inspection;
use serde::{Deserialize, Serialize};

/// Growth from a detectable crack to the failure of the rail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InspectionSummary {
    /// Depth (mm) from which the crack is detected; null where its length is what is detected.
    pub detectable_depth_mm: Option<f64>,
    /// Million gross tonnes until then; null if the run does not reach it.
    pub mgt_to_detectable: Option<f64>,
    /// The first critical condition; null if the run reaches none.
    pub critical_by: Option<FailureMode>,
    /// Million gross tonnes until then.
    pub mgt_to_critical: Option<f64>,
    /// Million gross tonnes from detectable to critical.
    pub mgt_detectable_to_critical: Option<f64>,
    /// Safety factor.
    pub safety_factor: f64,
    /// The interval, million gross tonnes: that from detectable to critical divided by the safety
    /// factor.
    pub interval_mgt: Option<f64>,
}

impl InspectionSummary {
    /// The `inspection` of a run; a crack that is detected by its length has the depth in `rows`
    /// then.
    pub(crate) fn of(nominal: &Nominal, inspection: &Inspection, rows: &[DecisionRow]) -> Self {
        let found = || nominal.detected.and_then(|mgt| depth_at(rows, mgt));
        let (to_detectable, to_critical) = (nominal.detected, nominal.failure.mgt);
        let way = to_detectable.zip(to_critical).map(|(from, to)| (to - from).max(0.0));
        Self {
            detectable_depth_mm: inspection.detectable_depth.or_else(found),
            mgt_to_detectable: to_detectable,
            critical_by: nominal.failure.mode,
            mgt_to_critical: to_critical,
            mgt_detectable_to_critical: way,
            safety_factor: inspection.safety_factor,
            interval_mgt: way.map(|way| way / inspection.safety_factor),
        }
    }
}

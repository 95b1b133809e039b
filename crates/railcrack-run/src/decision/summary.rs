//! The decision block of `summary.json`.

use super::inspection::InspectionSummary;
use super::maintenance::MaintenanceSummary;
use super::path::{GrowthPath, PathPoint};
use super::row::DecisionRow;
use super::sampler::Sampling;
use super::scatter::{ScatterSummary, sampled};
use super::wheels::WheelSummary;
use crate::log::{RunInfo, RunLog};
use serde::{Deserialize, Serialize};

/// From growth to a decision: key `decision` of `summary.json`, and the first block of the page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// Crack of the tip that is deepest in the last step, from 1.
    pub crack: usize,
    /// The tip within its crack, from 1.
    pub tip: usize,
    /// Mean load of an axle, t.
    pub axle_load_t: f64,
    /// The crack from step to step.
    pub rows: Vec<DecisionRow>,
    /// Growth against wear and grinding, where the case has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maintenance: Option<MaintenanceSummary>,
    /// The inspection interval, where the case asks for one.
    pub inspection: Option<InspectionSummary>,
    /// The wheels of a mix.
    #[serde(default)]
    pub wheels: Vec<WheelSummary>,
    /// Scatter, where the case gives it and the run has ended.
    pub scatter: Option<ScatterSummary>,
}

impl Decision {
    /// The decision block of a run so far; none without axle loads or finished steps.
    pub(crate) fn of(info: &RunInfo, log: &RunLog) -> Option<Self> {
        let tonnes = info.axle_load?;
        let path = GrowthPath::of(&log.steps)?;
        let per_mgt = 1e6 / tonnes;
        let mgt = |axles: f64| axles / per_mgt;
        let row = |(i, point): (usize, &PathPoint)| {
            let next = path.points.get(i + 1);
            let until = |next: &PathPoint| {
                let passed = mgt(next.axles - point.axles);
                (passed > 0.0).then(|| (next.depth - point.depth) / passed)
            };
            DecisionRow {
                length_mm: point.length,
                depth_mm: point.depth,
                axles: point.axles,
                mgt: mgt(point.axles),
                length_mm_per_mgt: point.rate * per_mgt,
                depth_mm_per_mgt: next.and_then(until),
                balance_mm_per_mgt: point.mouth_sine.map(|sine| point.rate * per_mgt * sine),
            }
        };
        let rows: Vec<DecisionRow> = path.points.iter().enumerate().map(row).collect();
        let removed = log.steps.last().map_or(0.0, |step| step.removed);
        let maintenance = info.maintenance.as_ref();
        let maintenance =
            maintenance.map(|plan| MaintenanceSummary::of(plan, &rows, path.is_worn_away, removed));
        let inspection = info.inspection.as_ref();
        let has_ended = log.steps.last().is_some_and(|step| step.stop.is_some());
        let scatter = info.scatter.as_ref().filter(|_| has_ended && path.points.len() > 1);
        Some(Self {
            crack: path.tip.0,
            tip: path.tip.1,
            axle_load_t: tonnes,
            rows,
            maintenance,
            inspection: inspection
                .map(|inspection| InspectionSummary::of(&path, inspection, info.critical_length, tonnes)),
            wheels: WheelSummary::of(&info.mix, &path, &log.steps),
            scatter: scatter.map(|scatter| {
                sampled(Sampling {
                    path: &path,
                    scatter,
                    inspection,
                    critical_length: info.critical_length,
                    tonnes,
                    maintenance: info.maintenance.as_ref(),
                    mix: &info.mix,
                })
            }),
        })
    }
}

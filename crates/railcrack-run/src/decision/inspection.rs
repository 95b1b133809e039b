//! Inspection interval: the traffic from a detectable to a critical crack, divided by a safety
//! factor.

use super::path::GrowthPath;
use railcrack_case::Inspection;
use serde::{Deserialize, Serialize};

/// Growth from a detectable to a critical crack.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InspectionSummary {
    /// Depth (mm) from which the crack is detected.
    pub detectable_depth_mm: Option<f64>,
    /// Million gross tonnes until then; null if the run does not reach it.
    pub mgt_to_detectable: Option<f64>,
    /// The first critical condition: `depth`, `length` or `fracture`; null if the run reaches none.
    pub critical_by: Option<CriticalBy>,
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

/// Critical conditions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CriticalBy {
    /// Its depth.
    Depth,
    /// Its length.
    Length,
    /// Fracture of the rail.
    Fracture,
}

/// A position on a path: index of a point, and fraction of the distance to the next.
pub(super) type Place = (usize, f64);

impl CriticalBy {
    /// Where the crack on `path` becomes critical first.
    pub(super) fn first(
        path: &GrowthPath,
        inspection: &Inspection,
        critical_length: Option<f64>,
    ) -> Option<(Self, Place)> {
        let depth = inspection.critical_depth.and_then(|depth| path.reaches(|point| point.depth, depth));
        let length = critical_length.and_then(|length| path.reaches(|point| point.length, length));
        let fracture = path.breaks.then(|| (path.points.len() - 1, 0.0));
        let all = [(Self::Depth, depth), (Self::Length, length), (Self::Fracture, fracture)];
        let there = all.into_iter().filter_map(|(by, place)| Some((by, place?)));
        there.reduce(|a, b| if b.1 < a.1 { b } else { a })
    }
}

impl InspectionSummary {
    /// The inspection of `path` under axles of `tonnes`.
    pub fn of(path: &GrowthPath, inspection: &Inspection, critical_length: Option<f64>, tonnes: f64) -> Self {
        let axles = path.axles();
        let mgt = |place: Place| 1e-6 * tonnes * GrowthPath::at(place, &axles);
        let detectable = detectable(path, inspection, inspection.detectable_depth);
        let critical = CriticalBy::first(path, inspection, critical_length);
        let depths: Vec<f64> = path.points.iter().map(|point| point.depth).collect();
        let (to_detectable, to_critical) = (detectable.map(mgt), critical.map(|(_, place)| mgt(place)));
        let way = to_detectable.zip(to_critical).map(|(from, to)| (to - from).max(0.0));
        Self {
            detectable_depth_mm: inspection
                .detectable_depth
                .or_else(|| detectable.map(|place| GrowthPath::at(place, &depths))),
            mgt_to_detectable: to_detectable,
            critical_by: critical.map(|(by, _)| by),
            mgt_to_critical: to_critical,
            mgt_detectable_to_critical: way,
            safety_factor: inspection.safety_factor,
            interval_mgt: way.map(|way| way / inspection.safety_factor),
        }
    }
}

/// Where the crack becomes detectable, at `depth` (mm) or at the length of the inspection.
pub(super) fn detectable(path: &GrowthPath, inspection: &Inspection, depth: Option<f64>) -> Option<Place> {
    match (depth, inspection.detectable_length) {
        (Some(depth), _) => path.reaches(|point| point.depth, depth),
        (None, Some(length)) => path.reaches(|point| point.length, length),
        (None, None) => Some((0, 0.0)),
    }
}

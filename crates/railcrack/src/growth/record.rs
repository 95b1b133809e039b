//! Records of a growth step.

use super::{
    DeferredGrowth, FaceRecord, FieldRecord, FrontTip, Geometry, PassageRecord, Piece, RunStop, SolverCounts,
    TipStop, Warning, WheelShares,
};
use crate::body::BodyTimes;
use crate::crack::{Crack, CrackTip, Junction};
use crate::fatigue::LargestK1;
use serde::{Deserialize, Serialize};

/// One tip at one step: the state at its start, and what was decided.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TipRecord {
    /// Which tip.
    pub tip: CrackTip,
    /// Abscissa of the tip, mm.
    pub x: f64,
    /// Ordinate of the tip, mm.
    pub y: f64,
    /// Length of its crack, mm: in the plane with the deferred growth of its tips, in space the half
    /// axis down the dip.
    pub length: f64,
    /// Largest K_I of the stabilised passage, MPa √mm; in a mix, of all wheels. The ranges of a
    /// mix are those of the wheel that does most of the growth.
    pub ki_max: f64,
    /// Range of K_I (clipped at zero), MPa √mm.
    pub delta_ki: f64,
    /// Range of K_II, MPa √mm.
    pub delta_kii: f64,
    /// ΔK_eq of the actual tip, MPa √mm.
    pub delta_keq: f64,
    /// The largest k1 of a virtual kink through the stabilised passage; none where none opens.
    pub largest_k1: Option<LargestK1>,
    /// Chosen kink, radians, counter-clockwise positive; none for a tip that does not load at all.
    pub kink: Option<f64>,
    /// Increment to the next step, mm, in the crack or deferred; 0 in the last step and for a
    /// stopped tip. Negative for a tip that joins a crack which lies across its deferred growth.
    pub increment: f64,
    /// da/dN, mm per cycle.
    pub rate: f64,
    /// Why this tip does not grow, if it does not.
    pub stop: Option<TipStop>,
    /// Shares of the wheels of a mix in its rate.
    pub shares: WheelShares,
    /// The wheel (from 0) of its largest k1.
    pub opened_by: usize,
    /// Sine of the angle of its crack at the mouth; none for a buried crack.
    pub mouth_sine: Option<f64>,
    /// What only tips in the plane, or only front points in space have.
    pub geometry: TipGeometry,
}

/// A tip in the plane, or a point of a front in space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum TipGeometry {
    /// A tip in the plane.
    Plane(PlaneTip),
    /// A front point.
    Space(FrontTip),
}

/// What only a tip in the plane has.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PlaneTip {
    /// Its growth that is not in the crack yet.
    pub deferred: DeferredGrowth,
    /// The best other local maximum at least 15° away, radians.
    pub secondary: Option<f64>,
    /// Its rate over the best rate.
    pub secondary_ratio: Option<f64>,
    /// The wheel of a mix (from 0) without which it would grow in the most different direction.
    pub turned_by: Option<usize>,
}

impl TipRecord {
    /// What only a tip in the plane has.
    #[must_use]
    pub fn plane(&self) -> Option<&PlaneTip> {
        match &self.geometry {
            TipGeometry::Plane(plane) => Some(plane),
            TipGeometry::Space(_) => None,
        }
    }

    /// What only a front point in space has.
    #[must_use]
    pub fn front(&self) -> Option<&FrontTip> {
        match &self.geometry {
            TipGeometry::Plane(_) => None,
            TipGeometry::Space(front) => Some(front),
        }
    }

    /// Depth below the running surface with the deferred growth, mm.
    #[must_use]
    pub fn depth(&self) -> f64 {
        let deferred = self.plane().map_or(DeferredGrowth::default(), |plane| plane.deferred);
        -(self.y + deferred.direction.y * deferred.length)
    }
}

/// Wall time of the phases of one step, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseTimes {
    /// The cracked body: C and S, and its fields where they are wanted.
    pub body_s: f64,
    /// Parts of it, as far as the engine tells.
    pub parts: BodyTimes,
    /// Loads on the faces and contact through all passages.
    pub contact_s: f64,
    /// Direction, rate, increments.
    pub growth_s: f64,
}

/// One growth step: the cracks at its start, their stabilised passage, and the increments to the
/// next step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepRecord {
    /// Step number; 0 is the initial geometry.
    pub step: usize,
    /// The cracks at the start of the step.
    pub geometry: Geometry,
    /// All tips, in order of crack and tip; ends that have joined a crack are none.
    pub tips: Vec<TipRecord>,
    /// All passages, in a mix of the first wheel; the last one is the stabilised one.
    pub passages: Vec<PassageRecord>,
    /// All passages of each other wheel of a mix, the stabilised one last.
    pub beside: Vec<Vec<PassageRecord>>,
    /// The faces during the stabilised passage.
    pub faces: FaceRecord,
    /// The fields around the cracks, where they are wanted and the engine has them.
    pub fields: Option<FieldRecord>,
    /// Load cycles at the start of the step.
    pub load_cycles: f64,
    /// Removed of the running surface since the beginning, by wear and grinding, mm.
    /// Coordinates count from the surface that is left.
    pub removed: f64,
    /// Number of displacement unknowns of the body.
    pub dofs: usize,
    /// Solver effort.
    pub counts: SolverCounts,
    /// Wall times.
    pub times: PhaseTimes,
    /// Pieces of the rail that were enclosed in this step.
    pub pieces: Vec<Piece>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Set in the last step of a run.
    pub stop: Option<RunStop>,
}

impl StepRecord {
    /// The cracks at the start of the step, of cracks in space their sections.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        self.geometry.cracks()
    }

    /// Where they have joined each other.
    #[must_use]
    pub fn junctions(&self) -> &[Junction] {
        self.geometry.junctions()
    }
}

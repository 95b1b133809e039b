//! Records of a growth step.

use super::{
    DeferredGrowth, FaceRecord, FieldRecord, FrontTip, Geometry, Jump, PassageRecord, Piece, PopInTest,
    RunStop, SolverCounts, TipStop, Warning, WheelShares,
};
use crate::body::BodyTimes;
use crate::crack::{Crack, CrackTip, Junction};
use crate::fatigue::LargestK1;
use serde::{Deserialize, Serialize};

/// One tip in one step: its state at the start, and the decisions taken.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TipRecord {
    /// The tip.
    pub tip: CrackTip,
    /// Abscissa of the tip, mm.
    pub x: f64,
    /// Ordinate of the tip, mm.
    pub y: f64,
    /// Length of its crack, mm: in the plane including the deferred growth of its tips, in space
    /// the semi-axis down the dip.
    pub length: f64,
    /// Largest K_I of the stabilised passage, MPa √mm; in a mix, the largest under any wheel. The
    /// ranges of a mix are those under the wheel that contributes most to the growth.
    pub ki_max: f64,
    /// Range of K_I (clipped at zero), MPa √mm.
    pub delta_ki: f64,
    /// Range of K_II, MPa √mm.
    pub delta_kii: f64,
    /// ΔK_eq of the actual tip, MPa √mm.
    pub delta_keq: f64,
    /// The largest k1 of a virtual kink during the stabilised passage; `None` where none opens.
    pub largest_k1: Option<LargestK1>,
    /// Chosen kink, radians, counter-clockwise positive; `None` for a tip without any loading.
    pub kink: Option<f64>,
    /// Increment to the next step, mm, added to the crack or deferred; 0 in the last step and for a
    /// stopped tip. Negative for a tip that joins a crack lying across its deferred growth.
    pub increment: f64,
    /// da/dN, mm per cycle.
    pub rate: f64,
    /// Why this tip does not grow, if it does not.
    pub stop: Option<TipStop>,
    /// Shares of the wheels of a mix in its growth rate.
    pub shares: WheelShares,
    /// The wheel (from 0) that causes its largest k1.
    pub opened_by: usize,
    /// K_Ic under that wheel over K_Ic under the first one; 1 where fracture is not considered.
    pub toughness_ratio: f64,
    /// Sine of the angle of its crack at the mouth; `None` for a buried crack.
    pub mouth_sine: Option<f64>,
    /// Quantities specific to tips in the plane or to front points in space.
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

/// Quantities that only tips in the plane have.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PlaneTip {
    /// Its growth that has not been added to the crack yet.
    pub deferred: DeferredGrowth,
    /// The best other local maximum, at least 15° away, radians.
    pub secondary: Option<f64>,
    /// Ratio of its rate to the best rate.
    pub secondary_ratio: Option<f64>,
    /// The wheel of a mix (from 0) whose removal would change the growth direction most.
    pub turned_by: Option<usize>,
    /// The turn of the path from this tip to the next, radians, counter-clockwise.
    pub turn: f64,
    /// The part of it that follows from this step and the previous one, without what was owed.
    pub predicted_turn: f64,
    /// Why the path kinks here, if it does.
    pub jump: Option<Jump>,
    /// Whether the crack of the next step includes the increment.
    pub is_drawn: bool,
    /// Relative change of the rate per radian of direction.
    pub sensitivity: f64,
    /// Decrease of the best kink per radian of turn; 1 where the best direction is fixed in space.
    pub kink_slope: f64,
}

impl TipRecord {
    /// The largest k1 for comparison with K_Ic under the first wheel, MPa √mm; 0 where the tip
    /// never opens.
    #[must_use]
    pub fn compared_k1(&self) -> f64 {
        self.largest_k1.map_or(0.0, |largest| largest.k1 / self.toughness_ratio)
    }

    /// The quantities specific to a tip in the plane; `None` for a front point.
    #[must_use]
    pub fn plane(&self) -> Option<&PlaneTip> {
        match &self.geometry {
            TipGeometry::Plane(plane) => Some(plane),
            TipGeometry::Space(_) => None,
        }
    }

    /// The quantities specific to a front point in space; `None` for a tip in the plane.
    #[must_use]
    pub fn front(&self) -> Option<&FrontTip> {
        match &self.geometry {
            TipGeometry::Plane(_) => None,
            TipGeometry::Space(front) => Some(front),
        }
    }

    /// Depth below the running surface, including deferred growth, mm.
    #[must_use]
    pub fn depth(&self) -> f64 {
        let deferred = self.plane().map_or(DeferredGrowth::default(), |plane| plane.deferred);
        -(self.y + deferred.direction.y * deferred.length)
    }
}

/// Wall time of the phases of one step, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PhaseTimes {
    /// The cracked body: C and S, and its fields where they are requested.
    pub body_s: f64,
    /// Parts of that time, where the engine reports them.
    pub parts: BodyTimes,
    /// Loads on the faces and contact during all passages.
    pub contact_s: f64,
    /// Directions, rates and increments.
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
    /// All tips, in order of crack and tip; ends that have joined a crack are not listed.
    pub tips: Vec<TipRecord>,
    /// All passages (in a mix, of the first wheel), the stabilised one last.
    pub passages: Vec<PassageRecord>,
    /// All passages of each other wheel of a mix, the stabilised one last.
    pub other_wheels: Vec<Vec<PassageRecord>>,
    /// The faces during the stabilised passage; in a mix, of the first wheel.
    pub faces: FaceRecord,
    /// The faces under each other wheel of a mix, in the first and the last step of a run; empty in
    /// between, where those of all wheels would multiply the memory and the files of a run.
    pub other_faces: Vec<FaceRecord>,
    /// Largest opening of the faces (mm) during the stabilised passages of the wheels that do not
    /// feel the cracks and under which there is fluid in them; zero without such a wheel.
    pub unfelt_opening: f64,
    /// The fields around the cracks, where they are requested and the engine provides them.
    pub fields: Option<FieldRecord>,
    /// Load cycles at the start of the step.
    pub load_cycles: f64,
    /// Their estimated error by the increments.
    pub cycles_error: f64,
    /// Depth removed from the running surface since the beginning, by wear and grinding, mm.
    /// Coordinates refer to the current surface.
    pub removed: f64,
    /// Number of displacement unknowns of the body.
    pub dofs: usize,
    /// Solver effort.
    pub counts: SolverCounts,
    /// Wall times.
    pub times: PhaseTimes,
    /// The test of a kink in a rail whose toughness is not given, where k1 reaches the usual one.
    pub pop_in_test: Option<PopInTest>,
    /// Pieces of the rail that were enclosed in this step.
    pub pieces: Vec<Piece>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Set in the last step of a run.
    pub stop: Option<RunStop>,
}

impl StepRecord {
    /// The cracks at the start of the step; cracks in space are given by their sections.
    #[must_use]
    pub fn cracks(&self) -> &[Crack] {
        self.geometry.cracks()
    }

    /// All passages and the faces under each wheel whose faces the record has, the first wheel
    /// first.
    pub fn faces_by_wheel(&self) -> impl Iterator<Item = (&[PassageRecord], &FaceRecord)> {
        let others = self.other_wheels.iter().map(Vec::as_slice).zip(&self.other_faces);
        std::iter::once((self.passages.as_slice(), &self.faces)).chain(others)
    }

    /// Junctions between the cracks.
    #[must_use]
    pub fn junctions(&self) -> &[Junction] {
        self.geometry.junctions()
    }
}

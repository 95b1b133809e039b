//! Records of a growth step: tips, passages, faces, fields and enclosed pieces.

use super::{
    DeferredGrowth, FaceAcross, FrontTip, Geometry, Jump, PopInTest, RunStop, TipStop, Warning, WheelShares,
};
use crate::body::{BodyTimes, FacePoint, FieldGrid};
use crate::contact::{CoupledState, FaceState, FluidState, SurfaceState};
use crate::crack::{Crack, CrackTip, Junction};
use crate::fatigue::LargestK1;
use crate::fracture::Sif;
use crate::math::{Stress, Vec2};
use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;

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
    /// ΔK_eq of the actual tip, MPa √mm: ΔK_I alone where its shear adds nothing to the rate.
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

    /// The turn (radians) of the path from here to the next step; none for a crack in space that
    /// stays in its plane.
    #[must_use]
    pub fn turn(&self) -> Option<f64> {
        match &self.geometry {
            TipGeometry::Plane(plane) => Some(plane.turn),
            TipGeometry::Space(front) => front.turn,
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

/// One passage on fixed cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct PassageRecord {
    /// Output positions x_c in the order of travel, mm.
    pub xc: Vec<f64>,
    /// `sifs[tip][position]`, MPa √mm.
    pub sifs: Vec<Vec<Sif>>,
    /// `fluid[tip][position]`: the fluid in the crack of each tip; empty without fluid.
    pub fluid: Vec<Vec<FluidState>>,
    /// `kiii[tip][position]`: K_III, MPa √mm; empty in the plane.
    pub kiii: Vec<Vec<f64>>,
    /// `wheel[position]`: the contact of a wheel that feels the cracks, where it does; empty for
    /// other wheels.
    pub wheel: Vec<Option<CoupledState>>,
}

/// The faces during the stabilised passage.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceRecord {
    /// The face points, crack by crack, in the order of each crack's polyline.
    pub points: Vec<FacePoint>,
    /// `states[position][point]`.
    pub states: Vec<Vec<FaceState>>,
    /// The third direction, for cracks in space.
    pub across: Option<FaceAcross>,
    /// `surface[position]`: the nodes of the running surface under a wheel that feels the cracks,
    /// where it does; empty for other wheels.
    pub surface: Vec<Vec<SurfaceState>>,
}

/// Effort of the contact solver in one growth step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SolverCounts {
    /// Passages until the history repeated.
    pub passages: usize,
    /// Load steps between output positions, in addition to the one that each position requires.
    pub substeps: usize,
    /// Contact solutions.
    pub solves: usize,
    /// Contact iterations, all solutions together.
    pub iterations: usize,
    /// The most iterations of one solution.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions, relative to the largest traction and jump.
    pub complementarity_max: f64,
}

impl SolverCounts {
    /// The sum of this effort and that for another wheel on the same body.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            passages: self.passages.max(other.passages),
            substeps: self.substeps + other.substeps,
            solves: self.solves + other.solves,
            iterations: self.iterations + other.iterations,
            iterations_max: self.iterations_max.max(other.iterations_max),
            complementarity_max: self.complementarity_max.max(other.complementarity_max),
        }
    }
}

/// Wheel positions and steps for which fields are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSettings {
    /// Wheel positions x_c, mm; each is replaced by the nearest output position of the stabilised
    /// passage.
    pub positions: Vec<f64>,
    /// Interval between recorded steps, beginning with step 0.
    pub every: NonZeroUsize,
}

impl FieldSettings {
    /// Whether fields of `step` are recorded.
    pub(crate) fn are_due(&self, step: usize) -> bool {
        step.is_multiple_of(self.every.get())
    }

    /// Indices of the output positions `xc` (mm) nearest to those wanted, in increasing order
    /// without repetition.
    pub(crate) fn nearest(&self, xc: &[f64]) -> Vec<usize> {
        let distance = |i: usize, x: f64| (xc[i] - x).abs();
        let of = |&x: &f64| (0..xc.len()).min_by(|&i, &j| distance(i, x).total_cmp(&distance(j, x)));
        let mut chosen: Vec<usize> = self.positions.iter().filter_map(of).collect();
        chosen.sort_unstable();
        chosen.dedup();
        chosen
    }
}

/// The fields of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRecord {
    /// The points at which they are known.
    pub grid: FieldGrid,
    /// One per wheel position, in the order of travel.
    pub snapshots: Vec<FieldSnapshot>,
}

/// The field with the wheel at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSnapshot {
    /// Output position of the stabilised passage, from 0.
    pub position: usize,
    /// x_c, mm.
    pub xc: f64,
    /// Displacement at each point of the grid, mm; residual stress contributes nothing to it.
    pub displacement: Vec<Vec2>,
    /// Stress at each point of the grid, MPa.
    pub stress: Vec<Stress>,
    /// At points of the crack faces, the traction exerted by the opposite face, MPa; zero
    /// elsewhere.
    pub traction: Vec<Vec2>,
}

/// Kinds of pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum PieceKind {
    /// The metal above a crack whose tip broke out at the running surface. The ligament still holds
    /// it, and the run continues.
    Spall,
    /// A piece fully separated when a tip coalesced with a crack.
    Detached,
}

impl Choice for PieceKind {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Spall, Word::now("spall", "above a crack that broke out at the running surface")),
        (Self::Detached, Word::now("detached", "wholly cut off")),
    ];
}

/// Cause that encloses a piece.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PieceCause {
    /// The growth of a tip.
    #[default]
    Growth,
    /// Wear, which brings the surface down to a tip that had turned up.
    Wear,
    /// A grinding that cuts such a tip off.
    Grinding,
}

/// An enclosed piece of the rail.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Its kind.
    pub kind: PieceKind,
    /// The step in which it was enclosed.
    pub step: usize,
    /// Index of the crack whose tip closed the outline, from 0.
    pub crack: usize,
    /// Its corners in order, mm; the last is joined to the first.
    pub outline: Vec<Vec2>,
    /// Its area, mm².
    pub area: f64,
    /// Its greatest depth below the running surface, mm.
    #[serde(default)]
    pub thickness: f64,
    /// Its cause.
    #[serde(default)]
    pub cause: PieceCause,
}

impl Piece {
    /// The piece within `outline`.
    pub(crate) fn new(kind: PieceKind, step: usize, crack: usize, outline: Vec<Vec2>) -> Self {
        let next = outline.iter().cycle().skip(1);
        let twice: f64 = outline.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
        let thickness = outline.iter().map(|point| -point.y).fold(0.0, f64::max);
        let cause = PieceCause::Growth;
        Self { kind, step, crack, area: 0.5 * twice.abs(), outline, thickness, cause }
    }

    /// The piece that the removal of the surface leaves above `crack` (number `index`) in `step`,
    /// whose tip it has reached; coordinates are those after the removal.
    pub(crate) fn cut_off(cause: PieceCause, step: usize, index: usize, crack: &Crack) -> Self {
        let mut outline = crack.points().to_vec();
        outline.extend(outline.last().map(|tip| Vec2::new(tip.x, 0.0)));
        Self { cause, ..Self::new(PieceKind::Spall, step, index, outline) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_positions_once_and_in_order() {
        let nearest = |xc: &[f64], wanted: &[f64]| {
            FieldSettings { positions: wanted.to_vec(), every: NonZeroUsize::MIN }.nearest(xc)
        };
        let there = [-6.0, -3.0, 0.0, 3.0, 6.0];
        assert_eq!(nearest(&there, &[0.2, -1.0, -100.0, 5.0]), [0, 2, 4]);
        let back = [6.0, 3.0, 0.0, -3.0];
        assert_eq!(nearest(&back, &[-2.0, 2.9]), [1, 3]);
        assert!(nearest(&there, &[]).is_empty());
    }
}

//! Fronts of cracks in space: what their records have beside those of tips in the plane.

use super::TipStop;
use serde::{Deserialize, Serialize};

/// Shape of a planar crack in space: half of an ellipse that breaks the surface, or a whole one
/// below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontShape {
    /// Angle between the plane and +x on the way down, radians.
    pub dip: f64,
    /// Turn of the plane about the vertical, from +x to the positive lateral direction, radians.
    pub strike: f64,
    /// Half axis l along the dip, mm.
    pub depth: f64,
    /// Half axis c along the surface, mm.
    pub half_length: f64,
    /// x and lateral position (mm) of the middle of the trace of the plane in the surface.
    pub middle: [f64; 2],
    /// Distance (mm) of the middle of a buried ellipse from that trace, along the dip; none for a
    /// crack that breaks the surface.
    pub buried: Option<f64>,
}

/// A point of a front beside its [`TipRecord`](super::TipRecord).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontTip {
    /// Parametric angle of the ellipse, radians: 0 at the end towards which the trace points, which
    /// without strike is that of larger lateral position, π/2 at the deepest point.
    pub phi: f64,
    /// Lateral position, mm.
    pub lateral: f64,
    /// Half axis of the crack along the surface, mm.
    pub half_length: f64,
    /// Range of K_III, MPa √mm.
    pub delta_kiii: f64,
    /// Kink that the direction criterion would choose by K_I and K_II, radians; none where nothing
    /// drives one. Growth stays in the plane.
    pub wanted_kink: Option<f64>,
    /// Growth rate of that kink over that straight ahead, both without mode III.
    pub wanted_ratio: Option<f64>,
    /// Whether the point counts in the growth of the front; the layer where the front meets the
    /// surface does not.
    pub counts: bool,
    /// Its increment over what its own rate alone would make of it; none without growth, and where
    /// it does not count.
    pub followed: Option<f64>,
}

/// Increment of a front whose cycles are known once the speed at its end is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontInterval {
    /// The crack (from 0) that set the pace.
    pub crack: usize,
    /// Which of the motions of its front did.
    pub motion: FrontMotion,
    /// Its speed at the start, mm per cycle.
    pub speed: f64,
    /// Cycles by that speed alone.
    pub cycles: f64,
    /// Whether it has that number of cycles, whatever the speed at its end.
    pub is_settled: bool,
}

/// Motions of an elliptical front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FrontMotion {
    /// Down the dip; of a buried crack, the end further down.
    Down,
    /// Up the dip, of a buried crack.
    Up,
    /// Along the trace of the plane: without strike, towards larger lateral positions.
    Plus,
    /// The other way.
    Minus,
}

/// Cracks in space between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrontState {
    /// Their shapes at the start of the step to compute next.
    pub shapes: Vec<FrontShape>,
    /// Why each no longer grows.
    pub stopped: Vec<Option<TipStop>>,
    /// The increment that led to the shapes.
    pub interval: Option<FrontInterval>,
}

/// Faces of cracks in space beside their [`FaceRecord`](super::FaceRecord).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaceAcross {
    /// Lateral position of each face point, mm.
    pub lateral: Vec<f64>,
    /// `states[position][point]`: slip along the trace (mm), and the shear stress transmitted
    /// along it (MPa).
    pub states: Vec<Vec<[f64; 2]>>,
}

/// Cracks in space at one step.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontRecord {
    /// Their shapes.
    pub shapes: Vec<FrontShape>,
    /// Corners of their cells: face points, then the points of the fronts.
    pub cells: Vec<[usize; 4]>,
    /// Output positions (from 0) whose jumps are written.
    pub written: Vec<usize>,
}

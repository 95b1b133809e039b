//! Cracks in space with their fronts.

use serde::{Deserialize, Serialize};

/// Shape of a planar crack in space: half of an ellipse that breaks the surface, or a whole one
/// below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontShape {
    /// Angle between the plane and +x on the way down, radians.
    pub dip: f64,
    /// Turn of the plane about the vertical, from +x to the positive lateral direction, radians.
    pub strike: f64,
    /// Length l: half axis down the dip, mm.
    pub length: f64,
    /// Half axis c along the surface, mm.
    pub half_length: f64,
    /// x and lateral position (mm) of the middle of the trace of the plane in the surface.
    pub middle: [f64; 2],
    /// Distance (mm) of the middle of a buried ellipse from that trace, along the dip; none for a
    /// crack that breaks the surface.
    pub buried: Option<f64>,
}

/// What only a front point in space has.
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

/// Motions of an elliptical front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrontMotion {
    /// Down the dip; of a buried crack, the end further down.
    Down,
    /// Up the dip, of a buried crack.
    Up,
    /// Along the trace of the plane: without strike, towards larger lateral positions.
    Plus,
    /// Along the trace, in the opposite direction.
    Minus,
}

/// The third direction of the faces of cracks in space, and their cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaceAcross {
    /// Lateral position of each face point, mm.
    pub lateral: Vec<f64>,
    /// `states[position][point]`: slip along the trace (mm), and the shear stress transmitted
    /// along it (MPa).
    pub states: Vec<Vec<[f64; 2]>>,
    /// Corners of the cells: face points, then the points of the fronts.
    pub cells: Vec<[usize; 4]>,
    /// Output positions (from 0) whose jumps are written.
    pub written: Vec<usize>,
}

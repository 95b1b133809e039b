//! Cracks in space with their fronts.

use serde::{Deserialize, Serialize};

/// Shape of a planar crack in space: a half-ellipse that breaks the surface, or a full ellipse
/// below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontShape {
    /// Angle between the plane, followed downwards, and +x, radians.
    pub dip: f64,
    /// Turn of the plane about the vertical, from +x to the positive lateral direction, radians.
    pub strike: f64,
    /// Length l: semi-axis down the dip, mm.
    pub length: f64,
    /// Semi-axis c along the surface, mm.
    pub half_length: f64,
    /// x and lateral position (mm) of the middle of the trace of the plane in the surface.
    pub middle: [f64; 2],
    /// Distance (mm) of the middle of a buried ellipse from that trace, along the dip; none for a
    /// crack that breaks the surface.
    pub buried: Option<f64>,
}

/// Quantities that only front points in space have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontTip {
    /// Parametric angle of the ellipse, radians: 0 at the end towards which the trace points
    /// (without strike, the end with the larger lateral position), π/2 at the deepest point.
    pub phi: f64,
    /// Lateral position, mm.
    pub lateral: f64,
    /// Semi-axis of the crack along the surface, mm.
    pub half_length: f64,
    /// Range of K_III, MPa √mm.
    pub delta_kiii: f64,
    /// Kink that the direction criterion would choose from K_I and K_II, radians; `None` where
    /// there is no driving force. Growth stays in the plane.
    pub wanted_kink: Option<f64>,
    /// Ratio of the growth rate of that kink to the rate straight ahead, both without mode III.
    pub wanted_ratio: Option<f64>,
    /// Whether the point counts in the growth of the front; points in the layer where the front
    /// meets the surface do not.
    pub counts: bool,
    /// Ratio of its increment to that given by its own rate alone; `None` without growth, and for
    /// points that do not count.
    pub followed: Option<f64>,
}

/// Motions of an elliptical front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrontMotion {
    /// Down the dip; for a buried crack, the motion of its lower end.
    Down,
    /// Up the dip, for a buried crack only.
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
    /// `states[position][point]`: slip along the trace (mm) and the shear stress transmitted in
    /// that direction (MPa).
    pub states: Vec<Vec<[f64; 2]>>,
    /// Corners of the cells: face points, then the points of the fronts.
    pub cells: Vec<[usize; 4]>,
    /// Output positions (from 0) whose jumps are written.
    pub written: Vec<usize>,
}

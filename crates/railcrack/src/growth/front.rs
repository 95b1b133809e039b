//! Cracks in space with their fronts, which may leave their ellipses.

use super::front_way::{FrontTurns, FrontWay};
use crate::math::periodic;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Shape of a crack in space: a half-ellipse that breaks the surface, or a full ellipse below it,
/// or a front that has left one of these. A crack that turns out of its plane has this shape where
/// it is unrolled; a strip may lie above the half-ellipse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontShape {
    /// Angle between its plane, at the mouth that of the crack, followed downwards, and +x,
    /// radians.
    pub dip: f64,
    /// Turn of the plane about the vertical, from +x to the positive lateral direction, radians.
    pub strike: f64,
    /// Semi-axis l of the ellipse down the dip, mm.
    pub length: f64,
    /// Semi-axis c of the ellipse along the surface, mm.
    pub half_length: f64,
    /// x and lateral position (mm) of the middle of the trace of the plane in the surface.
    pub middle: [f64; 2],
    /// Distance (mm) of the middle of a buried ellipse from that trace, along the dip; none for a
    /// crack that breaks the surface.
    pub buried: Option<f64>,
    /// Length (mm) of a rectangular strip, as wide as the ellipse, between mouth and half-ellipse.
    pub strip: Option<f64>,
    /// How the crack turns from the mouth down; none for a planar one.
    pub turns: Option<FrontTurns>,
    /// Deviation of a free front from its ellipse; none for a front that stays an ellipse.
    pub deviation: Option<FrontDeviation>,
}

impl FrontShape {
    /// The length (mm) from the mouth down the middle of the crack to the deepest point of the
    /// front; of a buried crack its semi-axis down the dip.
    #[must_use]
    pub fn path_length(&self) -> f64 {
        self.length + self.strip.unwrap_or(0.0)
    }

    /// Sine of the angle to the surface at which the crack reaches it; none for a buried crack.
    #[must_use]
    pub fn mouth_sine(&self) -> Option<f64> {
        self.buried.is_none().then(|| self.dip.sin())
    }

    /// The way down the middle of the crack, from the mouth on.
    #[must_use]
    pub fn way(&self) -> FrontWay {
        FrontWay::new(self.dip, self.turns.as_ref())
    }

    /// Angle between the crack and +x at the deepest point of its front, radians.
    #[must_use]
    pub fn front_dip(&self) -> f64 {
        self.dip + self.turns.as_ref().map_or(0.0, FrontTurns::turn)
    }

    /// Whether the front point at φ lies on a side of a strip.
    #[must_use]
    pub fn is_on_strip(&self, phi: f64) -> bool {
        self.strip.is_some() && !(0.0..=PI).contains(&phi)
    }
}

/// Quantities that only front points in space have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontTip {
    /// Parametric angle of the ellipse, radians: 0 at the end towards which the trace points
    /// (without strike, the end with the larger lateral position), π/2 at the deepest point. The
    /// sides of a strip continue it, in proportion to the distance from its lower end: to −π/2 at
    /// one end of the mouth, and from π to 3π/2 at the other.
    pub phi: f64,
    /// Lateral position, mm.
    pub lateral: f64,
    /// Semi-axis of the crack along the surface, mm.
    pub half_length: f64,
    /// Length of the strip between mouth and half-ellipse, mm.
    pub strip: Option<f64>,
    /// Of a free front, by how much it lies outside its ellipse there, relative to the distance of
    /// the ellipse from the middle; none for an ellipse.
    pub deviation: Option<f64>,
    /// Range of K_III, MPa √mm.
    pub delta_kiii: f64,
    /// Kink that the direction criterion would choose from K_I and K_II, radians; `None` where
    /// there is no driving force.
    pub wanted_kink: Option<f64>,
    /// Ratio of the growth rate of that kink to the rate straight ahead, both without mode III.
    pub wanted_ratio: Option<f64>,
    /// Whether the point counts in the growth of the front; points in the layer where the front
    /// meets the surface, or at the ends of a strip, do not.
    pub counts: bool,
    /// Turn of the way down the middle of its crack from this step to the next, radians, positive
    /// as a kink; none for a crack that stays in its plane.
    pub turn: Option<f64>,
    /// Distance from the mouth down the crack, mm.
    pub down: f64,
    /// Ratio of its increment to that given by its own rate alone; `None` without growth, and for
    /// points that do not count.
    pub followed: Option<f64>,
}

/// Motions of a front.
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
    /// Of a free front, at this node of its [`FrontDeviation`] along the normal of the ellipse.
    Node(usize),
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

/// Greatest number of harmonics of a free front.
const MOST: usize = 8;

/// How a front that is free to leave its ellipse differs from it: its distance from the middle is
/// g(φ) times that of the ellipse at the same parametric angle φ, and g − 1 is given at the nodes
/// φ_j = jπ/M, j from 0 to 2M − 1, and by trigonometric interpolation between them. At the ends of
/// the semi-axes g is one. A front that ends at the surface is continued by its mirror image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrontDeviation {
    /// M: 2, 4, 6 or 8; with 2 every motion leads from an ellipse to an ellipse.
    harmonics: u8,
    nodes: [f64; 2 * MOST],
}

impl FrontDeviation {
    /// The numbers of harmonics that a front may have.
    pub const HARMONICS: [usize; 4] = [2, 4, 6, MOST];

    /// A front with up to `harmonics` that still is its ellipse; none for a number that is not one
    /// of [`Self::HARMONICS`].
    #[must_use]
    pub fn none(harmonics: usize) -> Option<Self> {
        let admissible = Self::HARMONICS.contains(&harmonics);
        admissible.then_some(Self { harmonics: harmonics as u8, nodes: [0.0; 2 * MOST] })
    }

    /// The number M of harmonics.
    #[must_use]
    pub fn harmonics(&self) -> usize {
        usize::from(self.harmonics)
    }

    /// g − 1 at the nodes.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes[..2 * self.harmonics()]
    }

    /// The same with other values at the nodes, from node 0 on.
    #[must_use]
    pub(crate) fn with_nodes(mut self, values: impl IntoIterator<Item = f64>) -> Self {
        let count = 2 * self.harmonics();
        self.nodes[..count].iter_mut().zip(values).for_each(|(node, value)| *node = value);
        self
    }

    /// The parametric angle of node `j`, radians.
    #[must_use]
    pub fn angle(&self, j: usize) -> f64 {
        PI * j as f64 / self.harmonics() as f64
    }

    /// g(φ).
    #[must_use]
    pub fn radius_factor(&self, phi: f64) -> f64 {
        let nodes = self.nodes();
        let of = |(j, value): (usize, &f64)| value * periodic::weight(nodes.len(), j, phi);
        1.0 + nodes.iter().enumerate().map(of).sum::<f64>()
    }

    /// dg/dφ.
    pub(crate) fn slope(&self, phi: f64) -> f64 {
        let nodes = self.nodes();
        let of = |(j, value): (usize, &f64)| value * periodic::slope_weight(nodes.len(), j, phi);
        nodes.iter().enumerate().map(of).sum()
    }

    /// Coefficients of cos kφ and sin kφ, k from 0 on, of g − 1. A front that ends at the surface
    /// has no sines.
    pub(crate) fn coefficients(&self, is_closed: bool) -> Vec<[f64; 2]> {
        let all = periodic::harmonics(self.nodes()).into_iter();
        all.map(|[cos, sin]| [cos, if is_closed { sin } else { 0.0 }]).collect()
    }

    /// The largest |g − 1| at the nodes.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.nodes().iter().fold(0.0, |most, value| most.max(value.abs()))
    }
}

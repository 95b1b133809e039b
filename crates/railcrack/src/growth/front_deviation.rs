//! Fronts that have left their ellipse.

use crate::math::periodic;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

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

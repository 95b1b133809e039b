//! Several cracks in one rail.

use super::Crack;
use crate::math::segments_touch;
use thiserror::Error;

/// Cracks that cannot stand side by side.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NetworkError {
    /// No crack at all.
    #[error("a network needs at least one crack")]
    Empty,
    /// Two cracks that cross, touch or overlap.
    #[error("cracks {first} and {second} cross, touch or overlap")]
    Meeting {
        /// Number of a crack, from 1.
        first: usize,
        /// Number of another, from 1.
        second: usize,
    },
}

/// Cracks that do not meet, in the order in which they were given.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackNetwork {
    cracks: Vec<Crack>,
}

impl CrackNetwork {
    /// A network of `cracks`, at least one, none meeting another.
    pub fn new(cracks: Vec<Crack>) -> Result<Self, NetworkError> {
        if cracks.is_empty() {
            return Err(NetworkError::Empty);
        }
        for (i, one) in cracks.iter().enumerate() {
            for (j, other) in cracks.iter().enumerate().skip(i + 1) {
                let meet = one
                    .points()
                    .windows(2)
                    .any(|p| other.points().windows(2).any(|q| segments_touch(p[0], p[1], q[0], q[1])));
                if meet {
                    return Err(NetworkError::Meeting { first: i + 1, second: j + 1 });
                }
            }
        }
        Ok(Self { cracks })
    }

    /// The cracks, in order.
    pub fn cracks(&self) -> &[Crack] {
        &self.cracks
    }

    /// Abscissa of the leftmost mouth, mm; of the leftmost point where no crack breaks the surface.
    pub fn leftmost_mouth(&self) -> f64 {
        self.mouths().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Abscissa of the rightmost mouth, mm; of the rightmost point where no crack breaks the surface.
    pub fn rightmost_mouth(&self) -> f64 {
        self.mouths().into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    fn mouths(&self) -> Vec<f64> {
        let mouths: Vec<f64> =
            self.cracks.iter().filter(|c| c.is_surface_breaking()).map(|c| c.points()[0].x).collect();
        if mouths.is_empty() {
            return self.cracks.iter().flat_map(|c| c.points()).map(|p| p.x).collect();
        }
        mouths
    }
}

impl From<Crack> for CrackNetwork {
    fn from(crack: Crack) -> Self {
        Self { cracks: vec![crack] }
    }
}

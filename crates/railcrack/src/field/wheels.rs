//! Superposed fields that move together.

use super::Wheel;
use crate::load::Bending;
use crate::math::{Stress, Vec2};
use thiserror::Error;

/// A wheel in a train, or a part of the load of one.
pub struct PlacedWheel {
    /// The field.
    pub wheel: Box<dyn Wheel>,
    /// Its own x_c relative to that of the sum, mm.
    pub at: f64,
}

/// Wheels that cannot be added.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum WheelsError {
    /// More than one beam.
    #[error(
        "bending is in {count} of the wheels: one beam carries all axles, with their distances in its track"
    )]
    Bending {
        /// Number of wheels that bend the rail.
        count: usize,
    },
    /// Bending that is not at x_c.
    #[error("bending is placed {at} mm from x_c: must be at 0, with the distances of its axles in its track")]
    BendingBeside {
        /// Its position, mm.
        at: f64,
    },
}

/// The sum of the fields of several wheels that move together, bending included.
pub struct Wheels {
    parts: Vec<PlacedWheel>,
    edges: Vec<f64>,
}

impl Wheels {
    /// The sum of `parts`.
    ///
    /// Errors: bending in more than one of them, or at a distance from x_c.
    pub fn new(parts: Vec<PlacedWheel>) -> Result<Self, WheelsError> {
        let bending = || parts.iter().filter(|part| part.wheel.bending().is_some());
        let count = bending().count();
        if count > 1 {
            return Err(WheelsError::Bending { count });
        }
        if let Some(beside) = bending().find(|part| part.at != 0.0) {
            return Err(WheelsError::BendingBeside { at: beside.at });
        }
        Ok(Self::of_one_beam(parts))
    }

    /// The sum of `parts`, of which at most one, at x_c, bends the rail.
    pub(super) fn of_one_beam(parts: Vec<PlacedWheel>) -> Self {
        let of =
            |part: &PlacedWheel| part.wheel.edges().iter().map(|edge| edge + part.at).collect::<Vec<_>>();
        let mut edges: Vec<f64> = parts.iter().flat_map(of).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        Self { parts, edges }
    }

    /// A contact and the bending of the rail under its train.
    ///
    /// Errors: bending in both.
    pub fn on_track(
        contact: impl Wheel + 'static,
        bending: impl Wheel + 'static,
    ) -> Result<Self, WheelsError> {
        let placed = |wheel: Box<dyn Wheel>| PlacedWheel { wheel, at: 0.0 };
        Self::new(vec![placed(Box::new(contact)), placed(Box::new(bending))])
    }
}

impl Wheel for Wheels {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        self.parts.iter().fold(Stress::ZERO, |sum, part| sum + part.wheel.stress(point, xc + part.at))
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        let mut sum = vec![Stress::ZERO; points.len()];
        for part in &self.parts {
            let stresses = part.wheel.stresses(points, xc + part.at);
            sum.iter_mut().zip(stresses).for_each(|(sum, stress)| *sum = *sum + stress);
        }
        sum
    }

    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let of = |part: &PlacedWheel| part.wheel.displacement(point, xc + part.at);
        self.parts.iter().fold(Vec2::default(), |sum, part| sum + of(part))
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }

    fn bending(&self) -> Option<&Bending> {
        self.parts.iter().find_map(|part| part.wheel.bending())
    }

    /// The largest value of the parts, because the stress changes over the contact of one wheel and
    /// not over the distance between wheels.
    fn half_width(&self) -> f64 {
        self.parts.iter().map(|part| part.wheel.half_width()).fold(0.0, f64::max)
    }
}

//! Wheels: fields of the half-plane that move along the rail.

use super::{HertzDisplacement, HertzField};
use crate::load::{Bending, HertzianContact};
use crate::material::IsotropicElastic;
use crate::math::{OutOfRange, Stress, Vec2};
use std::error::Error;
use std::fmt::Debug;
use std::ops::RangeInclusive;
use std::sync::Arc;
use thiserror::Error;

/// A wheel on the half-plane y ≤ 0: the field of stress and displacement for every wheel position
/// x_c. The field is in equilibrium without body forces, and fields of several wheels add.
pub trait Wheel: Send + Sync {
    /// The stress (MPa) at `point` (mm) with the wheel at `xc` (mm).
    fn stress(&self, point: Vec2, xc: f64) -> Stress;

    /// [`Wheel::stress`] at many `points` (mm).
    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        points.iter().map(|&point| self.stress(point, xc)).collect()
    }

    /// The displacement (mm) of `point` (mm) with the wheel at `xc` (mm), up to a rigid motion.
    fn displacement(&self, point: Vec2, xc: f64) -> Vec2;

    /// Points of the running surface at which the field is not analytic, such as the edges of the
    /// contact: abscissae relative to x_c (mm), increasing.
    fn edges(&self) -> &[f64];

    /// The pressure (MPa) of the contact at the abscissa `x` (mm) of the running surface with the
    /// wheel at `xc` (mm): −σ_yy there, zero beyond the outermost edges.
    fn pressure(&self, x: f64, xc: f64) -> f64 {
        match self.edges() {
            [first, .., last] if (*first..=*last).contains(&(x - xc)) => {
                (-self.stress(Vec2::new(x, 0.0), xc).yy).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// The part of the field that bends the rail as a beam; none for a contact alone. It extends
    /// over some metres and is not a field of the half-plane, so that the ends of a block cannot
    /// cancel it.
    fn bending(&self) -> Option<&Bending> {
        None
    }

    /// Half the distance between the outermost edges, mm: the length over which the stress changes
    /// under the wheel; zero where there are none.
    fn half_width(&self) -> f64 {
        match self.edges() {
            [first, .., last] => 0.5 * (last - first),
            _ => 0.0,
        }
    }

    /// Distance (mm) from `point` (mm) to the nearest edge with the wheel at `xc` (mm).
    fn smooth_within(&self, point: Vec2, xc: f64) -> f64 {
        let to = |edge: &f64| (point.x - xc - edge).hypot(point.y);
        self.edges().iter().map(to).fold(f64::INFINITY, f64::min)
    }
}

/// A wheel in Hertzian line contact, in full sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzWheel {
    stress: HertzField,
    displacement: HertzDisplacement,
    edges: [f64; 2],
}

impl HertzWheel {
    /// The wheel with `contact` on a rail of `steel`. Errors: [`HertzianContact::check`].
    pub fn new(contact: &HertzianContact, steel: &IsotropicElastic) -> Result<Self, OutOfRange> {
        contact.check()?;
        Ok(Self {
            stress: HertzField::new(contact, steel.poisson()),
            displacement: HertzDisplacement::new(contact, steel),
            edges: [-contact.half_width, contact.half_width],
        })
    }
}

impl Wheel for HertzWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        self.stress.stress(point, xc)
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        self.stress.stresses(points, xc)
    }

    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        self.displacement.displacement(point, xc)
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }
}

/// The ends of an uncracked rail. They add a field that cancels the tractions and displacements of
/// a wheel's half-plane field on the free and held boundaries; this field is smooth at the cracks.
pub trait RailEnds: Debug + Send + Sync {
    /// The field added to that of `wheel` for any wheel position in the range `positions` (mm).
    ///
    /// Errors: the wheel leaves the rail, or comes too close to an end.
    fn under(
        self: Arc<Self>,
        wheel: &dyn Wheel,
        positions: RangeInclusive<f64>,
    ) -> Result<Arc<dyn EndField>, EndsError>;
}

/// The field that the ends of a rail add to that of one wheel.
pub trait EndField: Send + Sync {
    /// The stresses (MPa) at fixed `points` (mm), in order, as a function of the wheel position x_c
    /// (mm). Outside the range of positions of the field, they are those of the nearest position.
    ///
    /// Errors: a point outside the rail.
    fn at(&self, points: &[Vec2]) -> Result<StressesUnderWheel, EndsError>;
}

/// Stresses (MPa) at fixed points as a function of the wheel position x_c (mm).
pub type StressesUnderWheel = Box<dyn Fn(f64) -> Vec<Stress> + Send + Sync>;

/// A wheel whose field the ends of a rail cannot cancel.
#[derive(Debug, Error)]
#[error("the rail cannot be computed: {reason}")]
pub struct EndsError {
    /// The error of the rail.
    #[source]
    pub reason: Box<dyn Error + Send + Sync>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edges_of_a_hertzian_wheel_are_those_of_its_contact() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
        let wheel = HertzWheel::new(&contact, &steel).unwrap();
        assert_eq!((wheel.half_width(), wheel.edges()), (6.75, [-6.75, 6.75].as_slice()));
        assert_eq!(wheel.smooth_within(Vec2::new(12.75, -8.0), 0.0), 10.0);
        assert!(HertzWheel::new(&HertzianContact { half_width: 0.0, ..contact }, &steel).is_err());
    }
}

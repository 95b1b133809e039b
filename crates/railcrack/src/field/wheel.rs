//! Wheels: fields of the half-plane that move along the rail, alone or with its bending.

use super::{CrackLine, HertzDisplacement, HertzField, PlaceOnCrack, StressesByPosition, StressesOnCracks};
use crate::load::{Bending, HertzianContact, Track};
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

    /// The load of `cracks` where it differs from the stress at their faces: one that varies along
    /// their fronts. None for a load that is the same at every lateral place.
    fn on_cracks<'a>(&'a self, _: &[CrackLine]) -> Option<Arc<dyn StressesOnCracks + 'a>> {
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

    fn on_cracks<'a>(&'a self, cracks: &[CrackLine]) -> Option<Arc<dyn StressesOnCracks + 'a>> {
        let parts: Vec<_> = self.parts.iter().map(|part| (part, part.wheel.on_cracks(cracks))).collect();
        if parts.iter().all(|(_, on_cracks)| on_cracks.is_none()) {
            return None;
        }
        let mouth = |line: &CrackLine| line.points.first().map_or(0.0, |point| point.x);
        Some(Arc::new(WheelsOnCracks { parts, mouths: cracks.iter().map(mouth).collect() }))
    }

    /// The largest value of the parts, because the stress changes over the contact of one wheel and
    /// not over the distance between wheels.
    fn half_width(&self) -> f64 {
        self.parts.iter().map(|part| part.wheel.half_width()).fold(0.0, f64::max)
    }
}

/// The load of cracks by several wheels, of which some vary along the fronts.
struct WheelsOnCracks<'a> {
    parts: Vec<(&'a PlacedWheel, Option<Arc<dyn StressesOnCracks + 'a>>)>,
    /// x of the first point of each crack, mm.
    mouths: Vec<f64>,
}

impl<'w> StressesOnCracks for WheelsOnCracks<'w> {
    fn at<'a>(self: Arc<Self>, places: &[PlaceOnCrack]) -> StressesByPosition<'a>
    where
        Self: 'a,
    {
        let points: Vec<Vec2> = places.iter().map(|place| place.point).collect();
        let of = |part: &(&'w PlacedWheel, Option<Arc<dyn StressesOnCracks + 'w>>)| {
            part.1.as_ref().map(|own| Arc::clone(own).at(places))
        };
        let averaged: Vec<Option<StressesByPosition<'w>>> = self.parts.iter().map(of).collect();
        Box::new(move |xc| {
            let mut sum = vec![Stress::ZERO; points.len()];
            for ((part, _), averaged) in self.parts.iter().zip(&averaged) {
                let stresses = match averaged {
                    Some(averaged) => averaged(xc + part.at),
                    None => part.wheel.stresses(&points, xc + part.at),
                };
                sum.iter_mut().zip(stresses).for_each(|(sum, stress)| *sum = *sum + stress);
            }
            sum
        })
    }

    fn over_mouth(&self, crack: usize, xc: f64) -> f64 {
        let over =
            |(part, on_cracks): &(&PlacedWheel, Option<Arc<dyn StressesOnCracks + '_>>)| match on_cracks {
                Some(on_cracks) => on_cracks.over_mouth(crack, xc + part.at),
                None => part.wheel.pressure(self.mouths[crack], xc + part.at),
            };
        self.parts.iter().map(over).sum()
    }
}

/// The beam's σ_xx under the axles of a train. It adds to the field of a contact
/// ([`super::Wheels`]).
///
/// σ_yy = σ_xy = 0, and σ_zz = 0, as the rail is free to contract sideways. The beam's shear stress
/// is left out, so that the field is in equilibrium only where M is constant: the missing shear
/// stress at the depth d is V d (h − d/2)/I, with the shear force V; under a wheel, V = Q/2, 1.4
/// MPa at 10 mm in a 60E1 under 100 kN.
#[derive(Debug, Clone, PartialEq)]
pub struct BendingWheel {
    bending: Bending,
}

impl BendingWheel {
    /// The bending of a rail of `steel` on `track`. Errors: [`Track::check`].
    pub fn new(track: &Track, steel: &IsotropicElastic) -> Result<Self, OutOfRange> {
        Ok(Self { bending: track.bending(steel)? })
    }
}

impl Wheel for BendingWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        Stress { xx: self.bending.stress(point.x - xc, -point.y), ..Stress::ZERO }
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        let x: Vec<f64> = points.iter().map(|point| point.x - xc).collect();
        let moments = self.bending.moments(&x).into_iter();
        let at = |(moment, point): (f64, &Vec2)| Stress {
            xx: self.bending.stress_by(moment, -point.y),
            ..Stress::ZERO
        };
        moments.zip(points).map(at).collect()
    }

    /// The displacement of Euler's beam: the deflection w, and u_x = (h − d) w′.
    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let (deflection, slope) = self.bending.deflection(point.x - xc);
        let above = self.bending.track().section.neutral_axis_depth + point.y;
        Vec2::new(above * slope, -deflection)
    }

    fn edges(&self) -> &[f64] {
        &[]
    }

    fn bending(&self) -> Option<&Bending> {
        Some(&self.bending)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::{Axle, NamedSection};

    #[test]
    fn the_edges_of_a_hertzian_wheel_are_those_of_its_contact() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
        let wheel = HertzWheel::new(&contact, &steel).unwrap();
        assert_eq!((wheel.half_width(), wheel.edges()), (6.75, [-6.75, 6.75].as_slice()));
        assert_eq!(wheel.smooth_within(Vec2::new(12.75, -8.0), 0.0), 10.0);
        assert!(HertzWheel::new(&HertzianContact { half_width: 0.0, ..contact }, &steel).is_err());
    }

    #[test]
    fn the_fibres_stretch_as_they_are_stressed() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let section = NamedSection::of("60E1").unwrap().section();
        let axles = vec![Axle { at: 0.0, wheel_load: 100e3 }, Axle { at: 1800.0, wheel_load: 80e3 }];
        let wheel = BendingWheel::new(&Track { section, foundation: 50.0, axles }, &steel).unwrap();
        for (x, y) in [(-1300.0, -5.0), (400.0, 0.0), (1700.0, -120.0)] {
            let at = |dx: f64| wheel.displacement(Vec2::new(x + dx, y), 30.0).x;
            let stress = wheel.stress(Vec2::new(x, y), 30.0);
            assert!((210e3 * (at(0.5) - at(-0.5)) - stress.xx).abs() < 1e-4, "{x} {y}");
            assert_eq!((stress.yy, stress.zz, stress.xy), (0.0, 0.0, 0.0));
        }
        // Beside both axles, under one of them, and far apart.
        for along in [[400.0, 430.0, 380.0], [1815.0, 1860.0, 1825.0], [-900.0, 200.0, 1700.0]] {
            let points = along.map(|x| Vec2::new(x, -12.0));
            for (point, together) in points.iter().zip(wheel.stresses(&points, 30.0)) {
                let alone = wheel.stress(*point, 30.0);
                assert!((together.xx - alone.xx).abs() < 1e-9, "{point:?}: {together:?} {alone:?}");
            }
        }
    }
}

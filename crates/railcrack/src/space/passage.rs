//! Passages of a wheel over a crack in space, until the history of K repeats.

use super::contact::{SpaceContact, SpaceContactError};
use super::fluid::{FluidUnderWheel, SpacePocket};
use super::followed::{FollowedFaces, HalfWithFluid};
use super::load::{ForcesByPosition, SpaceLoad, WheelOverFaces};
use super::mirror::{MirroredHalf, MirroredPoints};
use super::states::{SpaceFaces, SpaceHistory, SpacePassageSettings};
use crate::growth::{Observer, output_positions};
use crate::interruption::{Interrupted, Interruption};
use crate::load::Passage;
use rayon::prelude::*;

/// Passages of one wheel over one body. Nodal forces are never interpolated between positions: they
/// are not differentiable where the edge of the contact passes the mouth, and an overshoot of the
/// interpolation would leave permanent slip.
pub struct SpacePassages<'a> {
    contact: &'a SpaceContact<'a>,
    over: WheelOverFaces<'a>,
    observer: &'a dyn Observer,
    constant: Vec<f64>,
    /// The friction coefficient of each point.
    friction: Vec<f64>,
    /// One half of the faces with its fluid, where body and load are symmetric.
    half: Option<HalfWithFluid>,
    positions: Vec<f64>,
    /// Nodal forces, kept for the next passage.
    forces: ForcesByPosition,
}

impl<'a> SpacePassages<'a> {
    /// Passages of the wheel of `load` over the body of `contact`, with results at the positions of
    /// `passage` and, where the rail bends, at distant positions.
    ///
    /// Errors: an interruption.
    pub fn new(
        contact: &'a SpaceContact<'a>,
        load: &'a SpaceLoad<'a>,
        passage: Passage,
        observer: &'a dyn Observer,
    ) -> Result<Self, Interrupted> {
        let body = contact.body;
        let constant = load.constant_forces(body);
        let asked = || observer.interrupted();
        let interruption = Interruption::when(&asked);
        let mut positions = output_positions(&passage, load.bending, &body.places());
        let fluid =
            load.fluid.map(|load| FluidUnderWheel { faces: load.fluid.in_space(body), over: load.over });
        if let Some(FluidUnderWheel { faces, over }) = &fluid {
            let runs_back = positions.last() < positions.first();
            positions.extend(faces.stations(&positions, *over));
            positions.sort_by(f64::total_cmp);
            positions.dedup();
            if runs_back {
                positions.reverse();
            }
        }
        let friction = contact.friction_of_points();
        let pockets = fluid.as_ref().map_or(&[][..], |fluid| &fluid.faces.pockets);
        let is_symmetric = |points: &MirroredPoints| {
            points.is_symmetric(&constant)
                && pockets.iter().all(|pocket| points.is_symmetric(&pocket.unit))
                && load.is_mirrored(body, points, &positions)
        };
        let points = MirroredPoints::of(body).filter(is_symmetric);
        let half = points.and_then(|points| MirroredHalf::of(body, points, &friction));
        let half: Option<HalfWithFluid> = half.map(|half| {
            let of_half = |pocket: &SpacePocket| pocket.with_unit(half.forces(&pocket.unit));
            let pockets = pockets.iter().map(of_half).collect();
            (half, pockets)
        });
        let mirrored = half.as_ref().map(|(half, _)| half.points.clone());
        let over = load.over((body, mirrored), fluid, &positions, interruption)?;
        // Forces do not depend on the contact: those needed in every passage are computed at once.
        let forces = positions
            .par_iter()
            .map(|&position| {
                interruption.check()?;
                Ok((position, with_constant(over.forces(position), &constant)))
            })
            .collect::<Result<Vec<_>, Interrupted>>()?;
        let forces = forces.into_iter().collect();
        Ok(Self { contact, over, observer, constant, friction, half, positions, forces })
    }

    /// The faces, closed and without slip.
    pub(super) fn virgin(&self) -> SpaceFaces {
        self.contact.virgin()
    }

    /// A passage over the faces `faces`, which are updated to their state after it, without the
    /// wheel. Virgin faces are loaded by the constant stress first.
    ///
    /// Errors: contact that does not converge; an interruption.
    pub fn pass(
        &self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        let followed = FollowedFaces {
            body: self.contact.body,
            friction: &self.friction,
            fluid: self.over.fluid.as_ref(),
            half: self.half.as_ref(),
            positions: &self.positions,
            unloaded: [&self.constant; 2],
            forces: &|position| {
                self.forces.at(position, |at| with_constant(self.over.forces(at), &self.constant))
            },
            observer: self.observer,
        };
        followed.pass(settings, faces, &mut |_| {})
    }
}

fn with_constant(mut forces: Vec<f64>, constant: &[f64]) -> Vec<f64> {
    forces.iter_mut().zip(constant).for_each(|(force, constant)| *force += constant);
    forces
}

/// The passage of the wheel over the faces `faces`, which are updated to their state after it.
/// Results are given at the positions of `passage` and, where the rail bends, at distant positions.
///
/// Errors: contact that does not converge.
pub fn space_passage(
    contact: &SpaceContact,
    load: &SpaceLoad,
    passage: Passage,
    settings: &SpacePassageSettings,
    faces: &mut SpaceFaces,
) -> Result<SpaceHistory, SpaceContactError> {
    SpacePassages::new(contact, load, passage, &crate::growth::Unobserved)?.pass(settings, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{CrackFluid, FluidModel, PressureProfile};
    use crate::growth::Unobserved;
    use crate::material::IsotropicElastic;
    use crate::space::{EllipticWheel, SpaceBody, SpaceCrack, SpaceFluidLoad, SpaceResolution, Surroundings};

    const WHEEL: EllipticWheel = EllipticWheel {
        peak_pressure: 900.0,
        half_width: 5.0,
        lateral_half_width: 6.0,
        lateral: 2.0,
        friction: 0.1,
        lateral_friction: 0.0,
    };
    /// Largest difference of K from that of the whole faces, relative to the peak: divisions of the
    /// quadrature of the stiffness are not mirrored.
    const MIRRORED: f64 = 1e-6;

    #[test]
    fn one_half_of_symmetric_faces_is_enough() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let first = SpaceCrack { middle: [0.0, 2.0], ..SpaceCrack::surface_breaking(0.5, 4.0, 3.0).unwrap() };
        let second =
            SpaceCrack { middle: [5.0, 2.0], ..SpaceCrack::surface_breaking(0.6, 3.0, 2.0).unwrap() };
        let resolution = SpaceResolution::new(2, 2);
        let cracks = [first.checked().unwrap(), second.checked().unwrap()];
        let body = SpaceBody::new(&cracks, &steel, Surroundings::HalfSpace, resolution).unwrap();
        let contact = SpaceContact { body: &body, friction: &[0.3, 0.2] };
        let trapped = CrackFluid {
            model: FluidModel::Trapped { bulk_modulus: f64::INFINITY, leak: true },
            profile: PressureProfile::Constant,
            cracks: None,
        };
        let over = |position: f64, at: [f64; 2]| WHEEL.pressure(position, at);
        let wheel = |position: f64, point: [f64; 3]| WHEEL.stress(position, point, 0.3);
        let settings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
        let passage = Passage { from: -15.0, to: 20.0, positions: 36 };
        for fluid in [None, Some(SpaceFluidLoad { fluid: &trapped, over: &over })] {
            let load = SpaceLoad { wheel: &wheel, bending: None, constant: None, fluid };
            let mut passages = SpacePassages::new(&contact, &load, passage, &Unobserved).unwrap();
            assert!(passages.half.is_some());
            let halves = passages.pass(&settings, &mut contact.virgin()).unwrap();
            passages.half = None;
            let whole = passages.pass(&settings, &mut contact.virgin()).unwrap();
            let (peak, difference) = (whole.peak(), whole.difference(&halves));
            assert!(peak > 20.0 && difference < MIRRORED * peak, "{peak} {difference:e}");
            let gap = whole.fluid.iter().flatten().zip(halves.fluid.iter().flatten());
            let gap = gap.fold(0.0f64, |most, (a, b)| most.max((a.pressure - b.pressure).abs()));
            assert!(gap < MIRRORED * 900.0, "{gap:e}");
        }
        let aside =
            |position: f64, [x, lateral, depth]: [f64; 3]| wheel(position, [x, lateral + 1e-5, depth]);
        let load = SpaceLoad { wheel: &aside, bending: None, constant: None, fluid: None };
        assert!(SpacePassages::new(&contact, &load, passage, &Unobserved).unwrap().half.is_none());
    }
}

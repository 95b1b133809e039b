//! The load on the faces through residual stress, approach, passage and departure.

use super::mouth_pressures::MouthPressures;
use crate::body::FaceSample;
use crate::contact::{FaceProblem, FluidModel, FluidState, LoadPath, Pocket};
use crate::field::{
    EndField, EndsError, FlatPunch, PlaceOnCrack, RailEnds, StressField, StressesByPosition,
    StressesOnCracks, StressesUnderWheel, Wheel,
};
use crate::growth::PassageSettings;
use crate::load::Passage;
use crate::math::{Track, Vec2, axpy};
use std::sync::Arc;

/// Nodal forces due to the stress of the uncracked rail.
pub(super) struct FaceLoad<'a> {
    pub(super) problem: &'a FaceProblem<'a>,
    wheel: &'a dyn Wheel,
    /// Stress added by the ends of the rail at these points; `None` for a half-plane.
    ends: Option<StressesUnderWheel>,
    /// The quadrature points of the faces, mm.
    points: Vec<Vec2>,
    /// The load of the cracks by a wheel that varies along the fronts; none for others.
    on_cracks: Option<Arc<dyn StressesOnCracks + 'a>>,
    /// The same at the quadrature points.
    averaged: Option<StressesByPosition<'a>>,
    /// The residual stress, and the nodal forces due to it.
    stress_between: Option<&'a dyn StressField>,
    residual: Vec<f64>,
    /// The largest pressure (MPa) of fluid that takes the pressure over the mouth; `None` without
    /// such fluid.
    cap: Option<f64>,
    /// The forces exerted by cracks outside the problem.
    others: Vec<(LoadPhase, Track)>,
}

/// One phase of the load history, which defines the meaning of the path coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LoadPhase {
    /// Share of the residual stress, 0 to 1, without the wheel.
    Ramp,
    /// Reciprocal of the distance (mm) of the wheel from `origin` towards `side`; 0 is infinitely
    /// far away.
    Far {
        /// Origin of the distance, mm.
        origin: f64,
        /// Sign of x on that side, ±1.
        side: f64,
    },
    /// Share of the load of a wheel at a fixed position, 0 to 1: for a rail with ends, where the
    /// wheel cannot arrive from infinity.
    Load {
        /// x_c, mm.
        xc: f64,
    },
    /// x_c, mm.
    Over,
    /// x_c (mm) of a wheel that feels the cracks.
    Coupled,
}

impl LoadPhase {
    /// The approach from infinity to `first` (mm), up to `near` (mm) from the faces.
    pub fn approach(first: f64, travel: f64, near: f64) -> Self {
        Self::Far { origin: first + travel * near, side: -travel }
    }

    /// The departure from `last` to infinity.
    pub fn departure(last: f64, travel: f64, near: f64) -> Self {
        Self::Far { origin: last - travel * near, side: travel }
    }
}

impl<'a> FaceLoad<'a> {
    /// The load on the faces of `problem`; `ends` is the field that the ends of the rail add under
    /// the wheel.
    ///
    /// Errors: a face outside the rail.
    pub(super) fn new(
        problem: &'a FaceProblem<'a>,
        load: RailLoad<'a>,
        ends: Option<&dyn EndField>,
    ) -> Result<Self, EndsError> {
        let on_cracks = load.wheel.on_cracks(&problem.body().faces.lines);
        Self::with_cracks(problem, load, ends, on_cracks)
    }

    /// The same `load` on the faces of `problem`, which are some of the cracks of this one.
    ///
    /// Errors: a face outside the rail.
    pub(super) fn of_part<'b>(&self, problem: &'b FaceProblem<'b>) -> Result<FaceLoad<'b>, EndsError>
    where
        'a: 'b,
    {
        let load = RailLoad { wheel: self.wheel, residual: self.stress_between };
        let on_cracks = self.on_cracks.clone().map(|own| own as Arc<dyn StressesOnCracks + 'b>);
        FaceLoad::with_cracks(problem, load, None, on_cracks)
    }

    fn with_cracks(
        problem: &'a FaceProblem<'a>,
        load: RailLoad<'a>,
        ends: Option<&dyn EndField>,
        on_cracks: Option<Arc<dyn StressesOnCracks + 'a>>,
    ) -> Result<Self, EndsError> {
        let residual = match load.residual {
            Some(field) => problem.body().faces.nodal_forces(|point| field.stress(point)),
            None => vec![0.0; 2 * problem.points()],
        };
        let places: Vec<PlaceOnCrack> = problem.body().faces.samples.iter().map(FaceSample::place).collect();
        let points: Vec<Vec2> = places.iter().map(|place| place.point).collect();
        let ends = ends.map(|ends| ends.at(&points)).transpose()?;
        let cap = problem.fluid().and_then(|fluid| match fluid.model {
            FluidModel::Mouth { cap } => Some(cap),
            FluidModel::Trapped { .. } => None,
        });
        let averaged = on_cracks.as_ref().map(|own| Arc::clone(own).at(&places));
        let RailLoad { wheel, residual: stress_between } = load;
        Ok(Self {
            problem,
            wheel,
            ends,
            points,
            on_cracks,
            averaged,
            stress_between,
            residual,
            cap,
            others: Vec::new(),
        })
    }

    /// The pressure (MPa) that the contact at `xc` (mm), with a share of its load, exerts over the
    /// mouth of each pocket; zero over a buried crack.
    pub(super) fn over_mouths(&self, xc: f64, share: f64) -> Vec<f64> {
        let pockets = self.problem.fluid().map_or(&[][..], |fluid| &fluid.pockets);
        let felt = self.problem.wheel().filter(|_| self.cap.is_some());
        let over = |pocket: &Pocket| {
            pocket.mouth.map_or(0.0, |mouth| match felt {
                Some(wheel) => wheel.surface.hertz_mean(mouth.x, xc),
                None => self.over_mouth(mouth.x, xc),
            })
        };
        pockets.iter().map(|pocket| share * over(pocket)).collect()
    }

    /// The pressure (MPa) of the contact at `xc` (mm) over a mouth at `x` (mm), as it counts for
    /// the front of its crack.
    fn over_mouth(&self, x: f64, xc: f64) -> f64 {
        let lines = &self.problem.body().faces.lines;
        let crack = lines.iter().position(|line| line.points.first().is_some_and(|mouth| mouth.x == x));
        match (&self.on_cracks, crack) {
            (Some(on_cracks), Some(crack)) => on_cracks.over_mouth(crack, xc),
            _ => self.wheel.pressure(x, xc),
        }
    }

    /// Adds the nodal forces of trapped fluid to `forces` (N/mm, 2p); `state` is the fluid in the
    /// crack of a tip.
    pub(super) fn press_trapped(&self, forces: &mut [f64], state: impl Fn(usize) -> Option<FluidState>) {
        if self.cap.is_none() {
            self.press(forces, state, |pocket| &pocket.unit);
        }
    }

    /// [`FaceLoad::press_trapped`] of fluid at the pressure over the mouth.
    pub(super) fn press_from_mouth(&self, forces: &mut [f64], state: impl Fn(usize) -> Option<FluidState>) {
        if self.cap.is_some() {
            self.press(forces, state, |pocket| &pocket.profile);
        }
    }

    fn press(
        &self,
        forces: &mut [f64],
        state: impl Fn(usize) -> Option<FluidState>,
        of_unit: impl Fn(&Pocket) -> &Vec<f64>,
    ) {
        for pocket in self.problem.fluid().map_or(&[][..], |fluid| &fluid.pockets) {
            let tips = &self.problem.body().tips;
            let tip = tips.iter().position(|tip| pocket.cracks.contains(&tip.crack));
            if let Some(state) = tip.and_then(&state) {
                axpy(state.pressure, of_unit(pocket), forces);
            }
        }
    }

    /// Whether the fluid has the pressure over the mouth.
    pub(super) fn is_from_mouth(&self) -> bool {
        self.cap.is_some()
    }

    /// The pressure (MPa) in each pocket that takes the pressure over its mouth; empty for other
    /// fluid models.
    pub(super) fn in_pockets(&self, xc: f64, share: f64) -> Option<Vec<f64>> {
        let cap = self.cap?;
        Some(self.over_mouths(xc, share).into_iter().map(|pressure| pressure.min(cap)).collect())
    }

    /// The same load with the forces (N/mm, 2p) of `others`, cracks that are not part of the
    /// problem.
    pub(super) fn with_others(self, others: Vec<(LoadPhase, Track)>) -> Self {
        Self { others, ..self }
    }

    /// The nodal forces (1, 2p) per increment of the line load of a wheel at `xc` (mm) without
    /// friction on the uncracked rail.
    pub(super) fn punch(&self, xc: f64) -> Vec<f64> {
        let punch = FlatPunch { half_width: self.wheel.half_width() };
        self.problem.body().faces.nodal_forces(|point| punch.stress(point, xc))
    }

    /// Nodal forces (N/mm, 2p) of the residual stress.
    pub(super) fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// The load path of the phase `part`.
    pub(super) fn along(&self, part: LoadPhase) -> PartLoad<'_> {
        let others = self.others.iter().find(|(own, _)| *own == part).map(|(_, track)| track);
        PartLoad { load: self, part, others, over_mouths: None }
    }

    /// The largest slip (mm) of each point over a sample of the wheel positions `xc`, with free
    /// faces.
    pub(super) fn expected_slip(&self, xc: &[f64]) -> Vec<f64> {
        let mut slips = vec![0.0f64; self.problem.points()];
        for &x in xc.iter().step_by((xc.len() / EXPECTED_FROM).max(1)) {
            let forces = self.along(LoadPhase::Over).nodal_forces(x);
            let jump = self.problem.body().compliance.times(&forces[..2 * self.problem.points()]);
            for (slip, jump) in slips.iter_mut().zip(jump.chunks_exact(2)) {
                *slip = slip.max(jump[0].abs());
            }
        }
        slips
    }
}

/// Number of positions sampled for the expected slip, which serves only as a scale.
const EXPECTED_FROM: usize = 30;

/// [`FaceLoad`] as a path.
pub(super) struct PartLoad<'a> {
    load: &'a FaceLoad<'a>,
    part: LoadPhase,
    others: Option<&'a Track>,
    /// The pressures over the mouths under a wheel that feels the cracks, if they are given.
    over_mouths: Option<&'a MouthPressures>,
}

impl<'a> PartLoad<'a> {
    /// This part with given pressures over the mouths.
    pub(super) fn with_pressures(self, over_mouths: Option<&'a MouthPressures>) -> Self {
        Self { over_mouths, ..self }
    }
}

impl LoadPath for PartLoad<'_> {
    fn is_of_coupled_wheel(&self) -> bool {
        self.part == LoadPhase::Coupled
    }

    fn over_mouths(&self, at: f64) -> Vec<f64> {
        if self.load.cap.is_some() {
            // The forces of other cracks are loads like any other.
            return Vec::new();
        }
        match self.part {
            LoadPhase::Ramp => self.load.over_mouths(0.0, 0.0),
            LoadPhase::Far { .. } if at == 0.0 => self.load.over_mouths(0.0, 0.0),
            LoadPhase::Far { origin, side } => self.load.over_mouths(origin + side / at, 1.0),
            LoadPhase::Load { xc } => self.load.over_mouths(xc, at),
            LoadPhase::Over | LoadPhase::Coupled => match self.over_mouths {
                Some(given) => given.assumed(at),
                None => self.load.over_mouths(at, 1.0),
            },
        }
    }

    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let mut forces = self.of_wheel(at);
        if let Some(others) = self.others {
            others.add(at, &mut forces);
        }
        match (self.load.problem.wheel(), self.part) {
            (Some(wheel), LoadPhase::Coupled) => wheel.load(forces, at),
            _ => {
                forces.resize(self.load.problem.components(), 0.0);
                forces
            }
        }
    }
}

impl PartLoad<'_> {
    fn of_wheel(&self, at: f64) -> Vec<f64> {
        let FaceLoad { problem, wheel, ends, points, averaged, residual, .. } = self.load;
        let (xc, share) = match self.part {
            LoadPhase::Ramp => return residual.iter().map(|f| f * at).collect(),
            LoadPhase::Far { .. } if at == 0.0 => return residual.clone(),
            LoadPhase::Far { origin, side } => (origin + side / at, 1.0),
            LoadPhase::Load { xc } => (xc, at),
            LoadPhase::Over | LoadPhase::Coupled => (at, 1.0),
        };
        let mut stresses = match averaged {
            Some(averaged) => averaged(xc),
            None => wheel.stresses(points, xc),
        };
        if let Some(ends) = ends {
            stresses.iter_mut().zip(ends(xc)).for_each(|(stress, end)| *stress = *stress + end);
        }
        let mut forces = problem.body().faces.nodal_forces_of_samples(|k, _| stresses[k]);
        if share != 1.0 {
            forces.iter_mut().for_each(|f| *f *= share);
        }
        forces.iter_mut().zip(residual).for_each(|(f, r)| *f += r);
        let pressures = match self.over_mouths {
            Some(given) => self.load.is_from_mouth().then(|| given.assumed(xc)),
            None => self.load.in_pockets(xc, share),
        };
        if let Some((pressures, fluid)) = pressures.zip(problem.fluid()) {
            for (pressure, pocket) in pressures.into_iter().zip(&fluid.pockets) {
                axpy(pressure, &pocket.profile, &mut forces);
            }
        }
        forces
    }
}

/// Load of the uncracked rail: a passing wheel and residual stress.
#[derive(Clone, Copy)]
pub struct RailLoad<'a> {
    /// The wheel.
    pub wheel: &'a dyn Wheel,
    /// Balanced residual stress.
    pub residual: Option<&'a dyn StressField>,
}

impl RailLoad<'_> {
    /// The field that the ends of a `rail` add to that of the wheel during its passage.
    ///
    /// Errors: a wheel that leaves the rail or comes too close to an end.
    pub(super) fn at_ends(
        &self,
        rail: &Arc<dyn RailEnds>,
        settings: &PassageSettings,
    ) -> Result<Arc<dyn EndField>, EndsError> {
        let Passage { from, to, .. } = settings.passage;
        Arc::clone(rail).under(self.wheel, from.min(to)..=from.max(to))
    }
}

//! A half-space with cracks, as the growth loop sees it.

use super::bilinear::{PatchOnRail, WheelPatch};
use super::body::{FrontPoint, SpaceBody};
use super::contact::{SpaceContact, SpaceContactError};
use super::division::{CellDivision, SpaceResolution};
use super::front_advance::{FrontAdvance, Start};
use super::front_motion::{FrontSpeeds, common_turn};
use super::groups::{CrackGroup, groups};
use super::load::{SpaceFluidLoad, SpaceLoad, StressAt};
use super::passage::SpacePassages;
use super::plane::{PlaneFrame, Symmetric};
use super::shape::{CloseCracks, Extent, ShapeError, SpaceCrack, SpaceError};
use super::shapes::{ShapesError, body_in_parts, body_of};
use super::stabilised::{StabilisedSpace, stabilised_record, stabilised_space_passage};
use super::stiffness::SpaceKernel;
use super::sweeps::GroupedPassages;
use super::tips::FrontLaw;
use crate::body::BodyError;
use crate::contact::CrackFluid;
use crate::crack::{Crack, CrackError};
use crate::fatigue::RUNAWAY;
use crate::field::StressField;
use crate::growth::{
    Advance, BodyReport, CrackedRail, FieldRecord, FieldSettings, FrontShape, FrontWay, Geometry,
    GrowthError, GrowthSettings, GrowthState, Memory, Mover, NetworkContact, Observer, PassageSettings,
    SpaceGeometry, StabilisedPassage, StepProgress, StepStart, TipDemand, TipGeometry, TipRecord, TipStop,
    Uncovered, Warning, WarningKind, WheelOfRail, under_each_wheel,
};
use crate::interruption::Interruption;
use crate::load::Bending;
use crate::material::IsotropicElastic;
use crate::math::{RailBox, Vec2};
use std::ops::Range;
use std::sync::Arc;

/// A warning is issued where rates differ from those of the ellipse by more than this share of the
/// largest rate.
const MISFIT: f64 = 0.25;

/// A stress of the uncracked rail that is there with and without the wheels, and varies across it.
pub trait StandingStress: Send + Sync {
    /// The stress (MPa) at x, lateral and depth (mm).
    fn stress(&self, point: [f64; 3]) -> Symmetric;
}

/// Everything that does not change in a run with cracks in space.
pub struct SpaceRail {
    /// The steel.
    pub steel: IsotropicElastic,
    /// The wheels, at least one; recorded faces and jumps are those under the first one.
    pub wheels: Vec<SpaceWheel>,
    /// Stress that adds to the residual stress of the wheels; `None` where nothing varies across
    /// the rail.
    pub standing: Option<Arc<dyn StandingStress>>,
    /// Crack-face friction coefficient of each crack.
    pub friction: Vec<f64>,
    /// Treatment of the contact of many cracks; in groups, trapped fluid is not sealed.
    pub network: NetworkContact,
    /// Cells of each crack.
    pub resolution: SpaceResolution,
    /// Growth law, limits and the direction criterion, which is only reported; the toughness is
    /// that under the first wheel.
    pub growth: GrowthSettings,
    /// Weight of mode III in the range of Hourlier and Pineau; `None` weights it by its energy
    /// release rate.
    pub mode_3_weight: Option<f64>,
    /// Positions and steps for which jumps are written.
    pub fields: Option<FieldSettings>,
    /// The rail.
    pub rail: RailBox,
    /// Kernel kept from step to step; `None` at the beginning.
    pub kernel: Option<SpaceKernel>,
}

/// A wheel over cracks in space.
pub struct SpaceWheel {
    /// Its contact.
    pub wheel: WheelPatch,
    /// Share of the axles.
    pub share: f64,
    /// Bending of the rail under the axles of its train; `None` without a track.
    pub bending: Option<Bending>,
    /// Stress of the rail that is present with and without the wheel, including thermal stress: a
    /// function of depth alone, the same at all lateral positions.
    pub residual: Option<Box<dyn StressField>>,
    /// Fluid in the cracks while it passes; `None` for dry ones.
    pub fluid: Option<CrackFluid>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; `None` for that of the growth settings.
    pub toughness: Option<f64>,
}

/// The cracks of a step with their body.
pub struct CracksInSpace {
    geometry: SpaceGeometry,
    body: SpaceBody,
    /// Its cracks in groups, where they are not solved for together.
    groups: Option<Vec<CrackGroup>>,
}

/// Cracks in space, as far as their increments depend on them.
#[derive(Debug, Clone)]
pub struct SpaceSite {
    geometry: SpaceGeometry,
    /// The points of all fronts.
    front: Vec<FrontPoint>,
    /// For each crack, the indices of its points.
    of_crack: Vec<Range<usize>>,
}

impl From<&FrontShape> for SpaceCrack {
    /// The crack of this shape, which may not be admissible.
    fn from(shape: &FrontShape) -> Self {
        Self {
            dip: shape.dip,
            strike: shape.strike,
            half_length: shape.half_length,
            length: shape.length,
            middle: shape.middle,
            extent: shape.buried.map_or(Extent::SurfaceBreaking, |centre| Extent::Buried { centre }),
            strip: shape.strip,
            turns: shape.turns,
            deviation: shape.deviation.map_or_else(Vec::new, |own| own.coefficients(shape.buried.is_some())),
        }
    }
}

impl FrontShape {
    /// The crack of this shape.
    ///
    /// Errors: an inadmissible shape.
    pub fn crack(&self) -> Result<SpaceCrack, ShapeError> {
        SpaceCrack::from(self).checked()
    }

    /// The cells of a crack of this shape.
    #[must_use]
    pub fn division(&self, resolution: SpaceResolution) -> CellDivision {
        CellDivision::of(&self.into(), resolution)
    }

    /// The line down the middle of the crack, seen from the side of the rail; without strike, the
    /// section of the crack along the rail. Arcs are divided every 3°.
    ///
    /// Errors: an inadmissible shape.
    pub fn section(&self) -> Result<Crack, CrackError> {
        let end = self.buried.unwrap_or(0.0) + self.path_length();
        match self.buried {
            None if self.strike == 0.0 && self.turns.is_none() => {
                Crack::surface_breaking(self.middle[0], end, self.dip)
            }
            None => {
                let way = self.way();
                Crack::polyline(way.stops(end).into_iter().map(|s| self.point_of(&way, s)).collect())
            }
            Some(centre) => Crack::polyline(vec![self.at(centre - self.length), self.at(end)]),
        }
    }

    /// The point at the distance s (mm) from the trace, or from the mouth, down the middle of the
    /// crack, seen from the side of the rail.
    fn at(&self, s: f64) -> Vec2 {
        self.point_of(&self.way(), s)
    }

    fn point_of(&self, way: &FrontWay, s: f64) -> Vec2 {
        let [out, depth] = way.at(s).place;
        Vec2::new(self.middle[0] + out * self.strike.cos(), -depth)
    }

    /// The deepest point of the front, seen from the side of the rail.
    pub(super) fn deepest(&self) -> Vec2 {
        self.at(self.buried.unwrap_or(0.0) + self.path_length())
    }

    /// The directions of its plane, at the mouth if it turns.
    #[must_use]
    pub fn frame(&self) -> PlaneFrame {
        PlaneFrame::turned(self.dip, self.strike)
    }

    /// The directions at the distance s (mm) from the mouth.
    #[must_use]
    pub fn frame_at(&self, s: f64) -> PlaneFrame {
        PlaneFrame::turned(self.way().at(s).dip, self.strike)
    }
}

impl GrowthState {
    /// The beginning of a run with cracks in space, at least one.
    ///
    /// Errors: an inadmissible shape.
    pub fn initial_in_space(shapes: Vec<FrontShape>) -> Result<Self, CrackError> {
        let stopped = vec![None; shapes.len()];
        Ok(Self::beginning(Geometry::Space(geometry(shapes, stopped)?)))
    }
}

/// Cracks of `shapes` with their sections.
fn geometry(shapes: Vec<FrontShape>, stopped: Vec<Option<TipStop>>) -> Result<SpaceGeometry, CrackError> {
    let sections = shapes.iter().map(FrontShape::section).collect::<Result<_, _>>()?;
    Ok(SpaceGeometry { shapes, sections, stopped })
}

fn body_error(step: usize, reason: impl std::error::Error + Send + Sync + 'static) -> GrowthError {
    GrowthError::Body { step, source: BodyError { reason: Box::new(reason) } }
}

fn of_contact(step: usize, error: SpaceContactError) -> GrowthError {
    match error {
        SpaceContactError::Interrupted(_) => GrowthError::Interrupted { step },
        other => body_error(step, other),
    }
}

impl SpaceRail {
    /// The output positions whose jumps are written in this step.
    fn written(&self, passage: &StabilisedSpace, step: usize) -> Vec<usize> {
        let due = self.fields.as_ref().filter(|fields| fields.are_due(step));
        let Some((fields, history)) = due.zip(passage.passages.last()) else { return Vec::new() };
        fields.nearest(&history.positions)
    }

    fn demand(&self, geometry: &SpaceGeometry, tip: &TipRecord) -> TipDemand {
        TipDemand { rate: tip.rate, largest_k1: tip.compared_k1(), stopped: geometry.stopped[tip.tip.crack] }
    }

    /// The best kink (radians) of each crack down its middle, and the root mean square of what it
    /// leaves out along the front; none for a crack that stays in its plane.
    fn common_turns(&self, site: &SpaceSite, tips: &[TipRecord]) -> Vec<Option<(f64, f64)>> {
        let of = |(shape, points): (&FrontShape, &Range<usize>)| {
            let is_straight = -shape.deepest().y < self.growth.straight_depth;
            if !self.growth.turns_in_space || is_straight || shape.buried.is_some() {
                return None;
            }
            let tips = &tips[points.clone()];
            let kink =
                |tip: &TipRecord| (self.moving_rate(tip), tip.front().and_then(|front| front.wanted_kink));
            common_turn(shape, &site.front[points.clone()], &tips.iter().map(kink).collect::<Vec<_>>())
        };
        site.geometry.shapes.iter().zip(&site.of_crack).map(of).collect()
    }

    /// The rate (mm per cycle) at which a front point drives its front: zero below the arrest rate.
    fn moving_rate(&self, tip: &TipRecord) -> f64 {
        if tip.rate >= self.growth.arrest_rate { tip.rate.min(RUNAWAY) } else { 0.0 }
    }
}

impl CrackedRail for SpaceRail {
    type Body = CracksInSpace;
    type Site = SpaceSite;

    fn settings(&self) -> &GrowthSettings {
        &self.growth
    }

    fn wheels(&self) -> Vec<WheelOfRail<'_>> {
        let mut wheels = Vec::with_capacity(self.wheels.len());
        for SpaceWheel { share, toughness, passages, .. } in &self.wheels {
            let toughness = toughness.or(self.growth.toughness);
            wheels.push(WheelOfRail { share: *share, toughness, passages });
        }
        wheels
    }

    fn refinement(&self) -> &'static str {
        "more cells (space_cells, space_rings)"
    }

    fn body(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<CracksInSpace, GrowthError> {
        let step = state.step;
        let Geometry::Space(geometry) = &state.geometry else {
            return Err(GrowthError::Geometry { step, found: "in the plane", wanted: "in space" });
        };
        let steel = self.steel;
        let dips: Vec<f64> = geometry.shapes.iter().map(|shape| shape.dip).collect();
        let kernel = self.kernel.get_or_insert_with(|| SpaceKernel::new(&[], steel.poisson()));
        // The mouth of a crack that turns gets another dip where wear has taken what was above it.
        kernel.prepare(&dips);
        let failed = |error| match error {
            ShapesError::Body(SpaceError::Interrupted(_)) => GrowthError::Interrupted { step },
            ShapesError::Body(SpaceError::Linear(_)) if interruption.check().is_err() => {
                GrowthError::Interrupted { step }
            }
            other => body_error(step, other),
        };
        let in_groups = self.network == NetworkContact::Groups && geometry.shapes.len() > 1;
        let body = if in_groups { body_in_parts } else { body_of };
        let body = body(&geometry.shapes, &steel, kernel, self.resolution, interruption).map_err(failed)?;
        let groups = in_groups.then(|| groups(&body, interruption));
        let groups = groups.transpose().map_err(|error| failed(error.into()))?;
        Ok(CracksInSpace { geometry: geometry.clone(), body, groups })
    }

    fn report(&self, CracksInSpace { geometry, body, .. }: &CracksInSpace) -> BodyReport {
        let remarks = geometry.shapes.iter().enumerate().filter_map(|(k, shape)| flat_crack(k, shape));
        BodyReport { dofs: 3 * body.points().len(), remarks: remarks.collect(), ..BodyReport::default() }
    }

    fn passages(
        &mut self,
        CracksInSpace { body, groups, .. }: &CracksInSpace,
        at: &StepStart<'_>,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError> {
        let contact = SpaceContact { body, friction: &self.friction };
        let poisson = self.steel.poisson();
        let removed = self.growth.uncovered(at.worn);
        under_each_wheel(self.wheels.len(), observer, warnings, |number, observer, _| {
            let SpaceWheel { wheel, bending, residual, fluid, passages, .. } = &self.wheels[number];
            let over = |position: f64, at: [f64; 2]| wheel.pressure(position, at);
            let wheel = PatchOnRail { patch: wheel, poisson };
            let uncovered = residual.as_deref().map(|field| Uncovered { field, removed });
            let standing = self.standing.as_deref();
            let stays = |point: [f64; 3]| {
                let residual = residual_stress(uncovered.as_ref(), point);
                let [x, lateral, depth] = point;
                let across = standing.map_or([0.0; 6], |field| field.stress([x, lateral, depth + removed]));
                std::array::from_fn(|c| residual[c] + across[c])
            };
            let load = SpaceLoad {
                wheel: &wheel,
                bending: bending.as_ref(),
                constant: (uncovered.is_some() || standing.is_some()).then_some(&stays as &StressAt),
                fluid: fluid.as_ref().map(|fluid| SpaceFluidLoad { fluid, over: &over }),
            };
            let passage = stabilised_over(&contact, groups.as_deref(), &load, passages, observer)
                .map_err(|error| of_contact(at.step, error))?;
            let written = self.written(&passage, at.step);
            Ok(stabilised_record(body, &passage, written))
        })
    }

    /// No fields: in space, jumps are recorded with the faces.
    fn fields(
        &mut self,
        _: &CracksInSpace,
        _: &StepStart<'_>,
        _: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        Ok(None)
    }

    fn demands(
        &self,
        CracksInSpace { geometry, body, .. }: &CracksInSpace,
        passages: &[StabilisedPassage],
    ) -> Vec<TipRecord> {
        let law = FrontLaw {
            growth: &self.growth,
            poisson: self.steel.poisson(),
            mode_3_weight: self.mode_3_weight,
        };
        law.tips(&geometry.shapes, body, &self.wheels(), passages)
    }

    fn movers(&self, CracksInSpace { geometry, body, .. }: &CracksInSpace, tips: &[TipRecord]) -> Vec<Mover> {
        let rates: Vec<f64> = tips.iter().map(|tip| self.moving_rate(tip)).collect();
        let of = |(crack, (shape, part)): (usize, (&FrontShape, &super::body::CrackPart))| {
            let points = part.front.clone();
            let speeds = FrontSpeeds::nearest(shape, &body.front()[points.clone()], &rates[points]);
            speeds.movers(crack, shape.length).collect::<Vec<_>>()
        };
        geometry.shapes.iter().zip(body.cracks()).enumerate().flat_map(of).collect()
    }

    fn site(&self, CracksInSpace { geometry, body, .. }: &CracksInSpace) -> SpaceSite {
        SpaceSite {
            geometry: geometry.clone(),
            front: body.front().to_vec(),
            of_crack: body.cracks().iter().map(|part| part.front.clone()).collect(),
        }
    }

    /// As in the plane; points that do not count in growth break nothing.
    fn hazard(&self, SpaceSite { geometry, .. }: &SpaceSite, tip: &TipRecord) -> f64 {
        let counts = tip.front().is_some_and(|front| front.counts);
        if counts { self.demand(geometry, tip).hazard(&self.growth) } else { 0.0 }
    }

    /// Cracks in space keep their planes.
    fn popped_in(&self, _: &SpaceSite, _: &[&TipRecord], _: f64) -> Option<Geometry> {
        None
    }

    fn advance(
        &self,
        site: &SpaceSite,
        at: &StepStart<'_>,
        tips: &mut [TipRecord],
        movers: &[Mover],
    ) -> Advance {
        let SpaceSite { geometry: before, front, .. } = site;
        let breaks = |tip: &TipRecord| {
            let demand = self.demand(before, tip);
            tip.front().is_some_and(|front| front.counts) && demand.breaks(&self.growth)
        };
        let broken: Vec<bool> = tips.iter().map(breaks).collect();
        let turns = self.common_turns(site, tips);
        let kink = |(shape, turn): (&FrontShape, &Option<(f64, f64)>)| {
            let least = shape.division(self.resolution).resolved_turn(shape.length);
            turn.map_or([0.0; 2], |(kink, _)| [kink, least])
        };
        let kinks: Vec<[f64; 2]> = before.shapes.iter().zip(&turns).map(kink).collect();
        let start = Start {
            shapes: &before.shapes,
            stopped: &before.stopped,
            movers,
            kinks: &kinks,
            breaks: broken.contains(&true),
            at: *at,
        };
        let next = FrontAdvance::new(&start, &self.growth, self.rail);
        let cycles = next.pace.as_ref().map_or(0.0, |pace| pace.cycles);
        for ((tip, point), broken) in tips.iter_mut().zip(front).zip(broken) {
            let (crack, rate) = (point.crack, self.moving_rate(tip));
            tip.increment = next.increments[crack].at(&before.shapes[crack], point);
            let grows = next.stopped[crack].is_none() && rate > 0.0 && cycles > 0.0;
            if let TipGeometry::Space(front) = &mut tip.geometry
                && front.counts
                && grows
            {
                front.followed = Some(tip.increment / (cycles * rate));
            }
            if let TipGeometry::Space(front) = &mut tip.geometry
                && self.growth.turns_in_space
            {
                front.turn = Some(before.shapes[crack].front_dip() - next.shapes[crack].front_dip());
            }
            let own = if rate > 0.0 { next.stopped[crack] } else { Some(TipStop::Arrest) };
            tip.stop = if broken { Some(TipStop::Fracture) } else { own };
        }
        let mut warnings = misfits(tips, &start, site);
        warnings.extend(turns.iter().enumerate().filter_map(|(k, turn)| twisted(k, (*turn)?.1, at.step)));
        warnings.extend(next.meetings.iter().map(|close| meeting_warning(close, at.step)));
        let FrontAdvance { shapes, stopped, stop, pace, .. } = next;
        let progress = pace.map_or_else(StepProgress::default, |pace| pace.progress(movers, |_| false));
        // Shapes advanced from admissible ones are admissible.
        let unchanged = || SpaceGeometry { stopped: stopped.clone(), ..before.clone() };
        let geometry = geometry(shapes, stopped.clone()).unwrap_or_else(|_| unchanged());
        Advance { geometry: Geometry::Space(geometry), pieces: Vec::new(), progress, stop, warnings }
    }
}

/// The stabilised passage over the faces of `contact`, in `groups` if there are any.
fn stabilised_over(
    contact: &SpaceContact<'_>,
    groups: Option<&[CrackGroup]>,
    load: &SpaceLoad<'_>,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedSpace, SpaceContactError> {
    let SpaceContact { body, friction } = *contact;
    let memory = if friction.iter().any(|&mu| mu > 0.0) { Memory::Friction } else { Memory::None };
    match groups {
        None => {
            let mut passages = SpacePassages::new(contact, load, settings.passage, observer)?;
            stabilised_space_passage(body, memory, &mut passages, settings)
        }
        Some(groups) => {
            let mut passages = GroupedPassages::new((body, groups), friction, load, settings, observer)?;
            stabilised_space_passage(body, memory, &mut passages, settings)
        }
    }
}

/// The constant stress at x, lateral and depth, from the plane fields of the rail.
fn residual_stress(field: Option<&impl StressField>, [x, _, depth]: [f64; 3]) -> Symmetric {
    let Some(field) = field else { return [0.0; 6] };
    let stress = field.stress(Vec2::new(x, -depth));
    // In the plane fields y points upwards and z is lateral; here the depth points downwards.
    [stress.xx, stress.zz, stress.yy, 0.0, -stress.xy, 0.0]
}

/// Warnings of local rates that no ellipse, or no free front, can follow, one per crack.
fn misfits(tips: &[TipRecord], start: &Start, site: &SpaceSite) -> Vec<Warning> {
    let of = |(k, shape): (usize, &FrontShape)| {
        let points = site.of_crack[k].clone();
        let counted = tips[points.clone()]
            .iter()
            .zip(&site.front[points])
            .filter(|(_, point)| start.stopped[k].is_none() && point.counts);
        let speeds = FrontSpeeds::of_movers(shape, k, start.movers);
        let (mut most, mut largest) = (0.0f64, 0.0f64);
        for (tip, point) in counted {
            let rate = if tip.stop == Some(TipStop::Arrest) { 0.0 } else { tip.rate };
            most = most.max((rate - speeds.at(shape, point)).abs());
            largest = largest.max(rate);
        }
        let whose = if start.shapes.len() > 1 { format!(" of crack {}", k + 1) } else { String::new() };
        let (cannot, nearest) = match shape.deviation {
            None => ("would leave its ellipse", "the nearest growing ellipse".to_owned()),
            Some(own) => {
                ("cannot follow its rates", format!("the nearest motion of {} harmonics", own.harmonics()))
            }
        };
        (largest > 0.0 && most > MISFIT * largest).then(|| Warning {
            step: start.at.step,
            kind: WarningKind::Engine,
            text: format!(
                "the front{whose} {cannot}: its rates differ from those of {nearest} by up to {:.0} % of the largest",
                100.0 * most / largest
            ),
            severity: Some(most / largest),
        })
    };
    start.shapes.iter().enumerate().filter_map(of).collect()
}

/// Root mean square (degrees) of the kinks that the turn of a crack leaves out, from which a
/// warning is issued.
const TWISTED: f64 = 10.0;

/// A warning that the front of crack `k` (from 0) would kink otherwise along it than its turn, by
/// `left_out` (radians).
fn twisted(k: usize, left_out: f64, step: usize) -> Option<Warning> {
    let degrees = left_out.to_degrees();
    (degrees > TWISTED).then(|| Warning {
        step,
        kind: WarningKind::Engine,
        text: format!(
            "crack {} turns about the direction of its mouth alone: along its front, kinks differ from that turn by {degrees:.0} \
             degrees in the mean, and the twist is not followed",
            k + 1
        ),
        severity: Some(degrees / TWISTED),
    })
}

/// Angle to the surface (degrees) below which the integrals over a crack are not verified.
const FLAT: f64 = 15.0;

/// A remark on crack `k` (from 0) where its flap is flatter than the verified cases.
fn flat_crack(k: usize, shape: &FrontShape) -> Option<String> {
    let angle = shape.mouth_sine()?.asin().to_degrees();
    (angle < FLAT * (1.0 - 1e-9)).then(|| {
        format!(
            "crack {}: it dips at {angle:.1} degrees, below the {FLAT:.0} degrees down to which this engine is verified: the flap \
             above it bends, and at 10 degrees the integrals alone leave K uncertain by 3 %; more cells (space_cells, space_rings) \
             resolve the flap, not the integrals",
            k + 1
        )
    })
}

/// Warnings of cracks that stop before they meet.
fn meeting_warning(close: &CloseCracks, step: usize) -> Warning {
    let CloseCracks { first, second, distance, least } = close;
    Warning {
        step,
        kind: WarningKind::Engine,
        text: format!(
            "cracks {} and {} stop: with the next increment they would be {distance:.3} mm apart, less than {least:.3} mm, and how \
             cracks join in space is not modelled",
            first + 1,
            second + 1
        ),
        severity: None,
    }
}

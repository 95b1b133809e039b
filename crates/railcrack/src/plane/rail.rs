//! A rail with cracks in the plane, as the growth loop sees it.

use super::face_load::{FaceLoad, RailLoad};
use super::fields::record_fields;
use super::increments::{advance, kinked};
use super::solvers::{PlaneWheel, Solvers};
use super::step_state::{StepState, TipDrive, mouth_sine};
use super::tip_under_wheel::TipUnderWheel;
use super::turned::{TurnResponse, histories_of, jump, turned_by};
use crate::body::{BodyEngine, BodyError, CrackedBody};
use crate::contact::{ContactSolver, FaceProblem, Latin, Newton, NotConverged, SteppingError};
use crate::crack::{Crack, CrackNetwork, CrackTip, End};
use crate::fatigue::{HourlierPineau, Kink};
use crate::field::{EndField, EndsError, RailEnds, Wheel};
use crate::fracture::SifHistory;
use crate::growth::{
    Advance, BodyReport, CrackedRail, DeferredGrowth, FieldRecord, FieldSettings, Geometry, GrowthError,
    GrowthSettings, GrowthState, Jump, MixedTip, Mover, NetworkContact, Observer, PassageError,
    PassageSettings, PlaneGeometry, PlaneTip, StabilisedPassage, StepStart, TipCourse, TipGeometry,
    TipRecord, Uncovered, Warning, WarningKind, WheelDemand, WheelOfRail, WornSurface, under_each_wheel,
};
use crate::interruption::Interruption;
use crate::math::RailBox;
use std::sync::Arc;

/// Everything that does not change in a run with cracks in the plane.
pub struct PlaneRail {
    /// Engine that computes the body with the cracks.
    pub engine: Box<dyn BodyEngine>,
    /// Contact solver for the faces.
    pub solver: Box<dyn ContactSolver>,
    /// Contact solver that takes over where `solver` fails.
    pub fallback: Box<dyn ContactSolver>,
    /// Treatment of the contact of many cracks.
    pub network: NetworkContact,
    /// Half the extent along the surface over the length of each crack, which keeps its shape as it
    /// grows; long cracks where none is given.
    pub widths: Vec<f64>,
    /// Crack-face friction coefficient μ_c of each crack.
    pub crack_friction: Vec<f64>,
    /// The wheels, at least one; recorded faces and fields are those under the first one.
    pub wheels: Vec<PlaneWheel>,
    /// Fields to record, if any.
    pub fields: Option<FieldSettings>,
    /// Growth law, increments and stops, with the toughness under the first wheel.
    pub growth: GrowthSettings,
    /// The rail.
    pub rail: RailBox,
    /// Fields kept from step to step; initially the default.
    pub ends: KnownEnds,
}

/// The ends of the rail in the last step, and the fields that they add under each wheel.
#[derive(Default)]
pub struct KnownEnds(Option<EndsUnderWheels>);

type EndsUnderWheels = (Arc<dyn RailEnds>, Vec<Arc<dyn EndField>>);

/// The cracks of a step with their body.
pub struct PlaneBody {
    geometry: PlaneGeometry,
    network: CrackNetwork,
    body: CrackedBody,
}

/// The cracks of a step, as far as their increments depend on them.
#[derive(Debug, Clone)]
pub struct PlaneSite {
    geometry: PlaneGeometry,
    /// The length that the engine resolves, mm.
    resolution: f64,
}

impl PlaneRail {
    /// Cracks with `crack_friction` under `wheel`, computed by `engine`; everything else has the
    /// defaults of a case file.
    pub fn new(
        engine: impl BodyEngine + 'static,
        wheel: impl Wheel + 'static,
        crack_friction: Vec<f64>,
    ) -> Self {
        Self::under(Box::new(engine), vec![PlaneWheel::new(Box::new(wheel))], crack_friction)
    }

    /// [`PlaneRail::new`] under `wheels`, at least one, with an engine whose type is chosen at run
    /// time.
    #[must_use]
    pub fn under(engine: Box<dyn BodyEngine>, wheels: Vec<PlaneWheel>, crack_friction: Vec<f64>) -> Self {
        Self {
            engine,
            solver: Box::new(Newton::default()),
            fallback: Box::new(Latin::default()),
            network: NetworkContact::Whole,
            widths: Vec::new(),
            crack_friction,
            wheels,
            fields: None,
            growth: GrowthSettings::default(),
            rail: RailBox::default(),
            ends: KnownEnds::default(),
        }
    }

    /// The fields that the ends of the rail add under each wheel, empty for a half-plane. They are
    /// kept as long as the engine keeps the rail.
    fn ends_under_wheels(
        &mut self,
        body: &CrackedBody,
        step: usize,
    ) -> Result<Vec<Arc<dyn EndField>>, GrowthError> {
        let Some(rail) = &body.ends else { return Ok(Vec::new()) };
        if let Some((known, fields)) = &self.ends.0
            && std::ptr::addr_eq(Arc::as_ptr(known), Arc::as_ptr(rail))
        {
            return Ok(fields.clone());
        }
        let fields: Result<Vec<_>, EndsError> =
            self.loads(&[]).into_iter().map(|(load, settings)| load.at_ends(rail, settings)).collect();
        let fields = fields.map_err(|source| off_the_rail(source, step))?;
        self.ends.0 = Some((Arc::clone(rail), fields.clone()));
        Ok(fields)
    }

    /// The residual stress under each wheel, relative to a worn surface; empty where it has come no
    /// closer to that surface.
    fn uncovered(&self, worn: &WornSurface) -> Vec<Option<Uncovered<'_>>> {
        let removed = self.growth.uncovered(worn);
        let wheels = self.wheels.iter().filter(|_| removed != 0.0);
        wheels.map(|wheel| Some(Uncovered { field: wheel.residual.as_deref()?, removed })).collect()
    }

    /// The load and the passages of every wheel; where the stress relative to a worn surface is
    /// given in `uncovered`, it applies.
    fn loads<'a>(
        &'a self,
        uncovered: &'a [Option<Uncovered<'a>>],
    ) -> Vec<(RailLoad<'a>, &'a PassageSettings)> {
        let all = self.wheels.iter().enumerate();
        all.map(|(number, PlaneWheel { wheel, residual, passages, .. })| {
            let load = RailLoad { wheel: wheel.as_ref(), residual: residual.as_deref() };
            match uncovered.get(number) {
                Some(Some(field)) => (RailLoad { residual: Some(field), ..load }, passages),
                _ => (load, passages),
            }
        })
        .collect()
    }

    /// The faces of `body` with the fluid that is in the cracks under `wheel`.
    fn faces<'a>(&self, body: &'a PlaneBody, wheel: &PlaneWheel) -> Result<FaceProblem<'a>, GrowthError> {
        let PlaneBody { network, body, .. } = body;
        let fluid = wheel.fluid.as_ref().map(|fluid| fluid.on(network, &body.faces));
        Ok(FaceProblem::new(body, &self.crack_friction)?.with_fluid(fluid))
    }

    /// [`PlaneRail::faces`] with the running surface where `wheel` feels the cracks.
    fn faces_and_surface<'a>(
        &self,
        body: &'a PlaneBody,
        wheel: &PlaneWheel,
        step: usize,
    ) -> Result<FaceProblem<'a>, GrowthError> {
        let surface = wheel.coupling.as_ref().and_then(|coupling| coupling.on(&body.body.faces));
        self.faces(body, wheel)?.with_wheel(surface).map_err(|_| {
            let failure = NotConverged { iterations: 0, indicator: f64::INFINITY, tolerance: 0.0 };
            let source = SteppingError::NotConverged { at: 0.0, failure };
            let phase = "contact of the wheel on the uncracked rail";
            GrowthError::Passage { step, source: PassageError::NotConverged { passage: 0, phase, source } }
        })
    }

    /// The site of `network`, whose cracks are those of `geometry`.
    pub(super) fn site_of(&self, geometry: &PlaneGeometry, network: &CrackNetwork) -> PlaneSite {
        PlaneSite { geometry: geometry.clone(), resolution: self.engine.resolution(network) }
    }

    /// The record of `tip` in `geometry`, which is loaded as `under_wheels` and whose best kink is
    /// `kink` (radians), without an increment.
    pub(super) fn tip_record(
        &self,
        geometry: &PlaneGeometry,
        tip: CrackTip,
        under_wheels: &[TipUnderWheel],
        kink: Option<f64>,
        plane: PlaneTip,
    ) -> TipRecord {
        let crack = &geometry.cracks[tip.crack];
        let demands: Vec<WheelDemand> =
            under_wheels.iter().map(|wheel| wheel.demand(&self.growth.law)).collect();
        let length = crack.length() + geometry.deferred_at(tip.crack);
        let under = MixedTip::of(&demands, &self.wheels());
        let record = under.record(tip, crack.tip(tip.end), length, TipGeometry::Plane(plane));
        TipRecord { kink, mouth_sine: mouth_sine(crack), ..record }
    }

    fn drive(&self, geometry: &PlaneGeometry, tip: &TipRecord) -> TipDrive {
        let CrackTip { crack, tip: index, .. } = tip.tip;
        let plane = tip.plane().copied().unwrap_or_default();
        let goes_straight = self.growth.goes_straight(tip);
        let course = if goes_straight { TipCourse::default() } else { geometry.courses[crack][index] };
        TipDrive {
            tip: tip.tip,
            kink: tip.kink.map(|kink| if goes_straight { 0.0 } else { kink }),
            rate: tip.rate,
            largest_k1: tip.compared_k1(),
            jump: plane.jump,
            kink_slope: plane.kink_slope,
            lean: lean(&geometry.cracks[crack], tip.tip.end),
            course,
            deferred: geometry.deferred[crack][index],
            stopped: geometry.stopped[crack][index],
        }
    }

    fn step_state<'a>(
        &self,
        site: &'a PlaneSite,
        at: &StepStart<'a>,
        drives: &'a [TipDrive],
    ) -> StepState<'a> {
        let PlaneSite { geometry, resolution } = site;
        StepState {
            at: *at,
            cracks: &geometry.cracks,
            junctions: &geometry.junctions,
            break_outs: &geometry.break_outs,
            tips: drives,
            rail: self.rail,
            resolution: *resolution,
        }
    }
}

/// Direction of the path at the tip at `end` of `crack` relative to the chord from the other end,
/// radians in [−π, π].
fn lean(crack: &Crack, end: End) -> f64 {
    let other = match end {
        End::First => End::Last,
        End::Last => End::First,
    };
    let (chord, ahead) = (crack.tip(end) - crack.tip(other), crack.ahead(end));
    (chord.x * ahead.y - chord.y * ahead.x).atan2(chord.x * ahead.x + chord.y * ahead.y)
}

fn off_the_rail(source: EndsError, step: usize) -> GrowthError {
    GrowthError::Body { step, source: BodyError { reason: Box::new(source) } }
}

impl CrackedRail for PlaneRail {
    type Body = PlaneBody;
    type Site = PlaneSite;

    fn settings(&self) -> &GrowthSettings {
        &self.growth
    }

    fn wheels(&self) -> Vec<WheelOfRail<'_>> {
        let mut wheels = Vec::with_capacity(self.wheels.len());
        for PlaneWheel { share, toughness, passages, .. } in &self.wheels {
            let toughness = toughness.or(self.growth.toughness);
            wheels.push(WheelOfRail { share: *share, toughness, passages });
        }
        wheels
    }

    fn refinement(&self) -> &'static str {
        "smaller elements (element_size_mm, interface_elements)"
    }

    /// The body with all cracks, built crack by crack where contact is followed in groups.
    fn body(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<PlaneBody, GrowthError> {
        let step = state.step;
        let Geometry::Plane(geometry) = &state.geometry else {
            return Err(GrowthError::Geometry { step, found: "in space", wanted: "in the plane" });
        };
        let geometry = geometry.clone();
        let network = CrackNetwork::joined(geometry.cracks.clone(), geometry.junctions.clone())
            .map_err(|source| GrowthError::Network { step, source })?;
        let failed = |source: BodyError| match source.is_interruption() {
            true => GrowthError::Interrupted { step },
            false => GrowthError::Body { step, source },
        };
        let by_groups = self.network == NetworkContact::Groups;
        let grouped = if by_groups { self.engine.body_by_groups(interruption, &network) } else { Ok(None) };
        let body = match grouped.map_err(failed)? {
            Some(body) => body,
            None => self.engine.body_unless(interruption, &network).map_err(failed)?,
        };
        Ok(PlaneBody { geometry, network, body: body.with_widths(&self.widths) })
    }

    fn report(&self, PlaneBody { body, .. }: &PlaneBody) -> BodyReport {
        BodyReport { dofs: body.dofs, times: body.times, remarks: body.remarks.clone() }
    }

    fn passages(
        &mut self,
        body: &PlaneBody,
        at: &StepStart<'_>,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError> {
        let ends = self.ends_under_wheels(&body.body, at.step)?;
        let faces: Vec<FaceProblem> = self
            .wheels
            .iter()
            .map(|wheel| self.faces_and_surface(body, wheel, at.step))
            .collect::<Result<_, _>>()?;
        let uncovered = self.uncovered(at.worn);
        let loads = self.loads(&uncovered);
        let mut face_loads = Vec::with_capacity(loads.len());
        for (wheel, ((load, _), faces)) in loads.iter().zip(&faces).enumerate() {
            let end = ends.get(wheel).map(Arc::as_ref);
            let face_load =
                FaceLoad::new(faces, *load, end).map_err(|source| off_the_rail(source, at.step))?;
            face_loads.push(face_load);
        }
        let solvers = Solvers { first: self.solver.as_ref(), second: self.fallback.as_ref(), step: at.step };
        under_each_wheel(loads.len(), observer, warnings, |wheel, observer, warnings| {
            solvers.stabilise(&face_loads[wheel], loads[wheel], observer, warnings)
        })
    }

    fn fields(
        &mut self,
        body: &PlaneBody,
        at: &StepStart<'_>,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        let Some(settings) = self.fields.clone().filter(|fields| fields.are_due(at.step)) else {
            return Ok(None);
        };
        let ends = self.ends_under_wheels(&body.body, at.step)?;
        let first = &self.wheels[0];
        let faces = self.faces(body, first)?;
        let uncovered = self.uncovered(at.worn);
        let (load, _) = self.loads(&uncovered)[0];
        let face_load = FaceLoad::new(&faces, load, ends.first().map(Arc::as_ref))
            .map_err(|source| off_the_rail(source, at.step))?;
        let felt = first.coupling.as_ref().map(|coupling| &coupling.contact);
        record_fields(&face_load, (load, felt), passage, &settings)
            .map_err(|source| GrowthError::Body { step: at.step, source })
    }

    fn demands(&self, body: &PlaneBody, passages: &[StabilisedPassage]) -> Vec<TipRecord> {
        let PlaneBody { geometry, network, .. } = body;
        let growth = &self.growth;
        let direction = HourlierPineau {
            law: growth.law.clone(),
            criterion: growth.criterion,
            kink_friction: growth.kink_friction,
        };
        let histories: Vec<&[SifHistory]> = passages.iter().map(|passage| &passage.histories[..]).collect();
        let shares: Vec<f64> = self.wheels.iter().map(|wheel| wheel.share).collect();
        let tip_record = |(i, tip): (usize, CrackTip)| {
            let under_wheels = histories_of(i, &shares, &histories);
            let tips: Vec<TipUnderWheel> =
                under_wheels.iter().map(|wheel| TipUnderWheel::of(wheel.history)).collect();
            let kink = direction.kink_of_mix(&under_wheels);
            let secondary = kink.as_ref().and_then(|kink: &Kink| kink.secondary);
            let turned = kink.filter(|_| under_wheels.len() > 1);
            let response = TurnResponse::of(&direction, &under_wheels, kink.map(|kink| kink.angle), growth);
            let course = geometry.courses[tip.crack][tip.tip];
            let plane = PlaneTip {
                deferred: geometry.deferred[tip.crack][tip.tip],
                secondary: secondary.map(|secondary| secondary.angle),
                secondary_ratio: secondary.map(|secondary| secondary.ratio),
                turned_by: turned.and_then(|kink| turned_by(&direction, &under_wheels, kink.angle)),
                jump: kink.and_then(|kink| jump(&kink, &course, growth)),
                sensitivity: response.sensitivity,
                kink_slope: response.kink_slope,
                ..PlaneTip::default()
            };
            let mut record = self.tip_record(geometry, tip, &tips, kink.map(|kink| kink.angle), plane);
            if growth.goes_straight(&record)
                && let TipGeometry::Plane(plane) = &mut record.geometry
            {
                plane.jump = None;
            }
            record
        };
        network.tips().into_iter().enumerate().map(tip_record).collect()
    }

    fn movers(&self, _: &PlaneBody, tips: &[TipRecord]) -> Vec<Mover> {
        movers(tips)
    }

    fn site(&self, PlaneBody { geometry, network, .. }: &PlaneBody) -> PlaneSite {
        self.site_of(geometry, network)
    }

    fn advance(&self, site: &PlaneSite, at: &StepStart<'_>, tips: &mut [TipRecord], _: &[Mover]) -> Advance {
        let PlaneSite { geometry, .. } = site;
        let drives: Vec<TipDrive> = tips.iter().map(|tip| self.drive(geometry, tip)).collect();
        let next = advance(&self.step_state(site, at, &drives), &self.growth);
        let PlaneGeometry { mut stopped, mut deferred, mut courses, .. } = geometry.clone();
        for (record, ahead) in tips.iter_mut().zip(&next.tips) {
            let CrackTip { crack, tip, .. } = record.tip;
            (record.increment, record.stop) = (ahead.increment, ahead.stop);
            if let TipGeometry::Plane(plane) = &mut record.geometry {
                (plane.turn, plane.predicted_turn) = (ahead.turn, ahead.predicted_turn);
                (plane.jump, plane.is_drawn) = (ahead.jump, ahead.is_drawn);
            }
            stopped[crack][tip] = ahead.stop;
            deferred[crack][tip] = ahead.deferred;
            courses[crack][tip] = ahead.course;
        }
        let warnings = tips.iter().filter_map(|tip| kink_of_limit_path(tip, at.step, &self.growth)).collect();
        Advance {
            geometry: Geometry::Plane(PlaneGeometry {
                cracks: next.cracks,
                junctions: next.junctions,
                break_outs: next.break_outs,
                stopped,
                deferred,
                courses,
            }),
            pieces: next.pieces,
            progress: next.progress,
            stop: next.stop,
            warnings,
        }
    }

    fn hazard(&self, site: &PlaneSite, tip: &TipRecord) -> f64 {
        let PlaneSite { geometry, .. } = site;
        self.drive(geometry, tip).demand().hazard(&self.growth)
    }

    fn popped_in(&self, site: &PlaneSite, tips: &[&TipRecord], length: f64) -> Option<Geometry> {
        let drives: Vec<TipDrive> = tips.iter().map(|tip| self.drive(&site.geometry, tip)).collect();
        let worn = WornSurface::default();
        let at = StepStart::standing(&worn);
        let kinks: Vec<f64> =
            tips.iter().map(|tip| tip.largest_k1.map_or(0.0, |largest| largest.angle)).collect();
        let (cracks, junctions) = kinked(&self.step_state(site, &at, &drives), &kinks, length)?;
        let mut geometry = PlaneGeometry { cracks, junctions, ..site.geometry.clone() };
        for tip in tips {
            let CrackTip { crack, tip, .. } = tip.tip;
            geometry.deferred[crack][tip] = DeferredGrowth::default();
            geometry.courses[crack][tip] = TipCourse::default();
        }
        Some(Geometry::Plane(geometry))
    }

    fn forget(&mut self) {
        self.engine.forget();
    }
}

/// Everything that moves the cracks: each of `tips` by itself.
pub(super) fn movers(tips: &[TipRecord]) -> Vec<Mover> {
    let mover = |TipRecord { tip, rate, length, .. }: &TipRecord| Mover {
        crack: tip.crack,
        index: tip.tip,
        rate: *rate,
        length: *length,
    };
    tips.iter().map(mover).collect()
}

/// The warning of a kink of the limit path at `tip`: the directions behind it in which the best
/// kink is zero can be several, and the life that follows depends on the one taken.
fn kink_of_limit_path(tip: &TipRecord, step: usize, growth: &GrowthSettings) -> Option<Warning> {
    let plane = tip.plane().filter(|_| growth.turning.is_limit())?;
    plane.jump.filter(|jump| *jump == Jump::Kink)?;
    let text = format!(
        "crack {} tip {}: the limit path kinks by {:.0} degrees; behind such a kink it may have several continuations, so that the life is not unique; a turning_length_mm above 0 gives one path",
        tip.tip.crack + 1,
        tip.tip.tip + 1,
        plane.turn.to_degrees()
    );
    Some(Warning { step, kind: WarningKind::NearTie, text, severity: Some(plane.turn.abs()) })
}

//! Growth of planar cracks in space, step by step: passages, rates along the fronts, the
//! next ellipses.

use super::body::{CloseCracks, SpaceBody, SpaceError, SpaceKernel};
use super::contact::{SpaceContact, SpaceContactError};
use super::front_motion::{FrontSpeeds, counts};
use super::grid::SpaceResolution;
use super::nuclei::Symmetric;
use super::passage::SpaceLoad;
use super::plane::PlaneFrame;
use super::records::{StepOf, face_record, passage_record};
use super::shape::{Extent, ShapeError, SpaceCrack};
use super::stabilised::{StabilisedSpace, stabilised_space_passage};
use super::tips::{FrontDrive, FrontLaw};
use super::way::{Start, Way};
use super::wheel::EllipticWheel;
use crate::body::BodyError;
use crate::crack::{Crack, CrackError, CrackNetwork};
use crate::field::StressField;
use crate::growth::{
    FieldSettings, FrontInterval, FrontRecord, FrontShape, FrontState, GrowthError, GrowthSettings,
    GrowthState, Observer, PassageSettings, PhaseTimes, StepRecord, TipJudge, TipRecord, TipStop, Warning,
    WarningKind,
};
use crate::interruption::Interruption;
use crate::load::Bending;
use crate::material::IsotropicElastic;
use crate::math::{RailBox, Vec2};
use std::sync::Arc;
use std::time::Instant;

/// A K_I that falls below zero by this share of the largest K is worth a warning.
const OVERLAP: f64 = 0.02;
/// Rates that differ from those of the ellipse by this share of the largest are worth a warning.
const MISFIT: f64 = 0.25;

/// Everything that decides how cracks in space grow.
pub struct SpaceProblem {
    /// The steel.
    pub steel: IsotropicElastic,
    /// The wheel.
    pub wheel: EllipticWheel,
    /// Bending of the rail under the axles of the train; none without a track.
    pub bending: Option<Bending>,
    /// Stress of the rail that stays between passages: of depth alone, the same at all lateral
    /// positions.
    pub residual: Option<Box<dyn StressField>>,
    /// Crack-face friction coefficient of each crack.
    pub friction: Vec<f64>,
    /// Cells of each crack.
    pub resolution: SpaceResolution,
    /// Passages of the wheel.
    pub passages: PassageSettings,
    /// Rate, limits, and the criterion of direction that is reported.
    pub growth: GrowthSettings,
    /// Weight of mode III in the range of Hourlier and Pineau; none: by its energy release rate.
    pub mode_3_weight: Option<f64>,
    /// Positions and steps of which jumps are written.
    pub fields: Option<FieldSettings>,
    /// The rail.
    pub rail: RailBox,
}

/// The growth of cracks in space; each step is computed on virgin faces.
pub struct SpaceGrowth {
    problem: SpaceProblem,
    judge: Option<Arc<dyn TipJudge>>,
    state: GrowthState,
    kernel: Option<SpaceKernel>,
}

impl FrontShape {
    /// The crack of this shape.
    ///
    /// Errors: an inadmissible shape.
    pub fn crack(&self) -> Result<SpaceCrack, ShapeError> {
        let extent = self.buried.map_or(Extent::SurfaceBreaking, |centre| Extent::Buried { centre });
        let crack = SpaceCrack {
            dip: self.dip,
            strike: self.strike,
            half_length: self.half_length,
            depth: self.depth,
            middle: self.middle,
            extent,
            deviation: Vec::new(),
        };
        crack.checked()
    }

    /// The line down the dip through the middle of the crack, as seen from the side of the rail:
    /// without strike the cut of the crack along the rail.
    ///
    /// Errors: an inadmissible shape.
    pub fn section(&self) -> Result<Crack, CrackError> {
        let at = |s: f64| {
            let [x, _, depth] = self.frame().position(s, 0.0);
            Vec2::new(self.middle[0] + x, -depth)
        };
        match self.buried {
            None if self.strike == 0.0 => Crack::surface_breaking(self.middle[0], self.depth, self.dip),
            None => Crack::polyline(vec![at(0.0), at(self.depth)]),
            Some(centre) => Crack::polyline(vec![at(centre - self.depth), at(centre + self.depth)]),
        }
    }

    /// The directions of its plane.
    #[must_use]
    pub fn frame(&self) -> PlaneFrame {
        PlaneFrame::turned(self.dip, self.strike)
    }
}

impl GrowthState {
    /// The beginning of a run with cracks in space, at least one.
    ///
    /// Errors: an inadmissible shape.
    pub fn initial_in_space(shapes: Vec<FrontShape>) -> Result<Self, CrackError> {
        let sections = shapes.iter().map(FrontShape::section).collect::<Result<Vec<_>, _>>()?;
        let network = CrackNetwork::sections(sections).map_err(|_| CrackError::TooFewPoints { count: 0 })?;
        let stopped = vec![None; shapes.len()];
        let front = FrontState { shapes, stopped, interval: None };
        Ok(Self { front: Some(front), ..Self::initial(&network) })
    }
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

impl SpaceGrowth {
    /// The growth under `problem` from `state` on, which has cracks in space.
    #[must_use]
    pub fn new(problem: SpaceProblem, state: GrowthState) -> Self {
        Self { problem, judge: None, state, kernel: None }
    }

    /// Has `judge` give the rate of every front point, by its K_I and K_II.
    #[must_use]
    pub fn judged_by(self, judge: Arc<dyn TipJudge>) -> Self {
        Self { judge: Some(judge), ..self }
    }

    /// The state after the last computed step.
    pub fn state(&self) -> &GrowthState {
        &self.state
    }

    /// Computes the next step; `None` when the run has ended. On an error the state is that before
    /// the step.
    ///
    /// Errors: settings, a crack that cannot be computed, a contact that does not converge, an
    /// interruption.
    pub fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        let Some(front) = self.state.front.clone().filter(|_| self.state.ended.is_none()) else {
            return Ok(None);
        };
        self.problem.passages.check()?;
        self.problem.growth.check()?;
        let step = self.state.step;
        let FrontState { shapes, stopped, interval } = front;
        let started = Instant::now();
        let cracks = shapes.iter().map(FrontShape::crack).collect::<Result<Vec<_>, _>>();
        let cracks = cracks.map_err(|error| body_error(step, error))?;
        let body = self.body(&cracks, step, observer)?;
        let body_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let contact = SpaceContact { body: &body, friction: &self.problem.friction };
        let poisson = self.problem.steel.poisson();
        let wheel = |position: f64, point: [f64; 3]| self.problem.wheel.stress(position, point, poisson);
        let stays = |point: [f64; 3]| residual_stress(self.problem.residual.as_deref(), point);
        let load = SpaceLoad {
            wheel: &wheel,
            bending: self.problem.bending.as_ref(),
            constant: self.problem.residual.is_some().then_some(&stays as &super::passage::StressAt),
        };
        let passage = stabilised_space_passage(&contact, &load, &self.problem.passages, observer)
            .map_err(|error| of_contact(step, error))?;
        let contact_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let law = FrontLaw {
            growth: &self.problem.growth,
            poisson,
            mode_3_weight: self.problem.mode_3_weight,
            judge: self.judge.as_deref(),
        };
        let drive = FrontDrive::new(&law, &shapes, &stopped, &body, &passage);
        let speeds: Vec<FrontSpeeds> = shapes
            .iter()
            .zip(body.cracks())
            .map(|(shape, crack)| {
                let points = crack.front.clone();
                FrontSpeeds::nearest(shape, &body.front()[points.clone()], &drive.growing[points])
            })
            .collect();
        let load_cycles = self.state.load_cycles + self.passed(interval, &speeds);
        let start = Start {
            shapes: &shapes,
            stopped: &stopped,
            speeds: &speeds,
            breaks: drive.breaks,
            step,
            load_cycles,
        };
        let way = Way::new(&start, &self.problem.growth, self.problem.rail);
        let tips = StepOf { shapes: &shapes, body: &body }.tips(drive, &speeds, &way);
        let mut warnings = self.warnings(&passage, step);
        warnings.extend(misfits(&tips, &start, &body));
        warnings.extend(way.meetings.iter().map(|close| meeting_warning(close, step)));
        let sections =
            |shapes: &[FrontShape]| shapes.iter().map(FrontShape::section).collect::<Result<_, _>>();
        let record = StepRecord {
            step,
            cracks: sections(&shapes).map_err(|error| body_error(step, error))?,
            junctions: Vec::new(),
            passages: passage.passages.iter().map(passage_record).collect(),
            beside: Vec::new(),
            faces: face_record(&body, &passage),
            fields: None,
            front: Some(FrontRecord {
                shapes: shapes.clone(),
                cells: body.cells().to_vec(),
                written: self.written(&passage, step),
            }),
            load_cycles,
            removed: 0.0,
            dofs: 3 * body.points().len(),
            counts: passage.counts,
            times: PhaseTimes {
                body_s,
                contact_s,
                growth_s: started.elapsed().as_secs_f64(),
                ..PhaseTimes::default()
            },
            pieces: Vec::new(),
            warnings,
            stop: way.stop,
            tips,
        };
        self.state.step += 1;
        self.state.load_cycles = load_cycles;
        self.state.ended = way.stop;
        if let Ok(sections) = sections(&way.shapes) {
            self.state.cracks = sections;
        }
        self.state.front =
            Some(FrontState { shapes: way.shapes, stopped: way.stopped, interval: way.interval });
        Ok(Some(record))
    }

    fn body(
        &mut self,
        cracks: &[SpaceCrack],
        step: usize,
        observer: &dyn Observer,
    ) -> Result<SpaceBody, GrowthError> {
        let asked = || observer.interrupted();
        let steel = self.problem.steel;
        let dips: Vec<f64> = cracks.iter().map(|crack| crack.dip).collect();
        let kernel = self.kernel.get_or_insert_with(|| SpaceKernel::new(&dips, steel.poisson()));
        let interruption = Interruption::when(&asked);
        let body =
            SpaceBody::with_kernel(cracks, &steel, Some(kernel), self.problem.resolution, interruption);
        body.map_err(|error| match error {
            SpaceError::Interrupted(_) => GrowthError::Interrupted { step },
            SpaceError::Linear(_) if observer.interrupted() => GrowthError::Interrupted { step },
            other => body_error(step, other),
        })
    }

    /// Cycles of the increment that led here: the trapezoidal rule in the inverse of the speed.
    fn passed(&self, interval: Option<FrontInterval>, speeds: &[FrontSpeeds]) -> f64 {
        let Some(interval) = interval else { return 0.0 };
        let end = speeds[interval.crack].of(interval.motion);
        let slowest = self.problem.growth.arrest_rate;
        if interval.is_settled || end <= 0.0 || end < slowest {
            return interval.cycles;
        }
        0.5 * interval.cycles * (1.0 + interval.speed / end)
    }

    /// The output positions whose jumps are written in this step.
    fn written(&self, passage: &StabilisedSpace, step: usize) -> Vec<usize> {
        let wanted = self.problem.fields.as_ref().filter(|fields| step.is_multiple_of(fields.every.get()));
        let Some((fields, history)) = wanted.zip(passage.passages.last()) else { return Vec::new() };
        let nearest = |at: &f64| {
            let distance = |x: &f64| (x - at).abs();
            let all = history.positions.iter().enumerate();
            all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map(|(i, _)| i)
        };
        let mut positions: Vec<usize> = fields.positions.iter().filter_map(nearest).collect();
        positions.sort_unstable();
        positions.dedup();
        positions
    }

    fn warnings(&self, passage: &StabilisedSpace, step: usize) -> Vec<Warning> {
        let mut warnings = Vec::new();
        let tolerance = self.problem.passages.passage_tolerance;
        if let Some(change) = passage.last_change.filter(|change| *change > tolerance) {
            let text = format!(
                "K still changes by {change:.2e} of its peak after {} passages, tolerance {tolerance:.1e}",
                passage.counts.passages
            );
            warnings.push(Warning { step, kind: WarningKind::Passages, text });
        }
        if let Some(last) = passage.passages.last() {
            let lowest = last.sifs.iter().flatten().map(|k| k.ki).fold(0.0, f64::min);
            let share = lowest / last.peak().max(f64::MIN_POSITIVE);
            if share < -OVERLAP {
                let text = format!(
                    "K_I goes down to {:.1} % of the largest K of the step, as if the faces overlapped ahead of the front; K is \
                     known to that amount, and more cells ([mesh] space_cells, space_rings) resolve it",
                    100.0 * share
                );
                warnings.push(Warning { step, kind: WarningKind::Engine, text });
            }
        }
        warnings
    }
}

/// The stress that stays, of the plane fields of the rail: x, lateral and depth.
fn residual_stress(field: Option<&dyn StressField>, [x, _, depth]: [f64; 3]) -> Symmetric {
    let Some(field) = field else { return [0.0; 6] };
    let stress = field.stress(Vec2::new(x, -depth));
    // y points up there, the depth down here; its z is lateral.
    [stress.xx, stress.zz, stress.yy, 0.0, -stress.xy, 0.0]
}

/// Local rates that no ellipse follows, of each crack.
fn misfits(tips: &[TipRecord], start: &Start, body: &SpaceBody) -> Vec<Warning> {
    let of = |(k, shape): (usize, &FrontShape)| {
        let points = body.cracks()[k].front.clone();
        let counted = tips[points.clone()]
            .iter()
            .zip(&body.front()[points])
            .filter(|(_, point)| start.stopped[k].is_none() && counts(shape, point.phi));
        let (mut most, mut largest) = (0.0f64, 0.0f64);
        for (tip, point) in counted {
            let rate = if tip.stop == Some(TipStop::Arrest) { 0.0 } else { tip.rate };
            most = most.max((rate - start.speeds[k].at(shape, point)).abs());
            largest = largest.max(rate);
        }
        let whose = if start.shapes.len() > 1 { format!(" of crack {}", k + 1) } else { String::new() };
        (largest > 0.0 && most > MISFIT * largest).then(|| Warning {
            step: start.step,
            kind: WarningKind::Engine,
            text: format!(
                "the front{whose} would leave its ellipse: its rates differ from those of the nearest growing ellipse by up to \
                 {:.0} % of the largest",
                100.0 * most / largest
            ),
        })
    };
    start.shapes.iter().enumerate().filter_map(of).collect()
}

/// Cracks that stop before they meet.
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
    }
}

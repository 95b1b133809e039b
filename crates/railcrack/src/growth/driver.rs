//! Growth as an iterator of steps that can be stored and resumed.

use super::face_load::FaceLoad;
use super::maintenance::Uncovered;
use super::mix::{MixedTip, MixedWheel, histories_of, turned_by as turned_by_wheel};
use super::solvers::Solvers;
use super::worn::mouth_sine;
use super::{
    CrackFluid, FieldRecord, FieldSettings, GrowthError, GrowthSettings, GrowthState, NetworkContact,
    Observer, PassageSettings, PhaseTimes, RailLoad, StabilisedPassage, StepRecord, StepState, StressMoves,
    TipDrive, TipJudge, TipRecord, Warning, WarningKind, advance, fields,
};
use crate::body::{BodyEngine, BodyError, CrackedBody};
use crate::contact::{ContactSolver, FaceProblem, Latin, Newton};
use crate::crack::{CrackNetwork, CrackTip};
use crate::fatigue::{HourlierPineau, Kink};
use crate::field::{EndField, EndsError, RailEnds, StressField, Wheel};
use crate::fracture::SifHistory;
use crate::interruption::Interruption;
use crate::math::RailBox;
use std::sync::Arc;
use std::time::Instant;

/// Everything that does not change in a run.
pub struct GrowthProblem {
    /// Turns cracks into a body.
    pub engine: Box<dyn BodyEngine>,
    /// Solves contact on the faces.
    pub solver: Box<dyn ContactSolver>,
    /// Takes over for a step that `solver` cannot do.
    pub fallback: Box<dyn ContactSolver>,
    /// How the contact of many cracks is followed.
    pub network: NetworkContact,
    /// μ_c of each crack.
    pub crack_friction: Vec<f64>,
    /// The wheel; the first one of a mix.
    pub wheel: Box<dyn Wheel>,
    /// Its share of the axles: 1 without a mix.
    pub share: f64,
    /// Fluid in the cracks; none for dry ones.
    pub fluid: Option<CrackFluid>,
    /// The other wheels of a mix. Shares of all wheels add up to 1; faces and fields that are
    /// recorded are those of the first wheel.
    pub others: Vec<MixedWheel>,
    /// Balanced residual stress, under the first wheel.
    pub residual: Option<Box<dyn StressField>>,
    /// The passages of the first wheel.
    pub passages: PassageSettings,
    /// Fields to record; none where there are none to.
    pub fields: Option<FieldSettings>,
    /// Growth law, increments, stops.
    pub growth: GrowthSettings,
    /// The rail.
    pub rail: RailBox,
}

/// Estimated error of K in groups, over its peak, that is told at every step.
const GROUPS_NEWS: f64 = 0.01;

impl GrowthProblem {
    /// Cracks with `crack_friction` under `wheel`, by `engine`: everything else as in a case file
    /// that says nothing.
    pub fn new(
        engine: impl BodyEngine + 'static,
        wheel: impl Wheel + 'static,
        crack_friction: Vec<f64>,
    ) -> Self {
        Self {
            engine: Box::new(engine),
            solver: Box::new(Newton::default()),
            fallback: Box::new(Latin::default()),
            network: NetworkContact::Whole,
            crack_friction,
            wheel: Box::new(wheel),
            share: 1.0,
            fluid: None,
            others: Vec::new(),
            residual: None,
            passages: PassageSettings::default(),
            fields: None,
            growth: GrowthSettings::default(),
            rail: RailBox::default(),
        }
    }
}

/// The ends of a rail, and what they add under each wheel.
type KnownEnds = (Arc<dyn RailEnds>, Vec<Arc<dyn EndField>>);

/// A run over growth steps. [`Growth::next_step`] computes one step; [`Growth::state`] is what to
/// store after it.
pub struct Growth {
    problem: GrowthProblem,
    judge: Option<Arc<dyn TipJudge>>,
    state: GrowthState,
    /// The ends of the rail of the last step, and what they add under each wheel.
    ends: Option<KnownEnds>,
}

/// K_I at a closed tip, below zero by this share of the largest |K|, that is worth a warning. At
/// default settings it is at most 0.4 % where K is right to 1 %; a tip for which the engines were
/// 3.9 % apart had −3.9 %.
const OVERLAP: f64 = 0.01;

/// A rival kink whose rate comes this close to the best is a near tie.
pub const NEAR_TIE: f64 = 0.98;

impl Growth {
    /// A run of `problem` from `state` on.
    pub fn new(problem: GrowthProblem, state: GrowthState) -> Self {
        Self { problem, judge: None, state, ends: None }
    }

    /// Has `judge` give direction and rate of every tip.
    #[must_use]
    pub fn judged_by(self, judge: Arc<dyn TipJudge>) -> Self {
        Self { judge: Some(judge), ..self }
    }

    /// The state after the last computed step: give it to a new run to go on from there.
    pub fn state(&self) -> &GrowthState {
        &self.state
    }

    /// Computes the next step; `None` when the run has ended. On an error the state is that before
    /// the step.
    ///
    /// Each step starts on virgin faces: slip of the step before is not carried over to the longer
    /// cracks.
    pub fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        if self.state.ended.is_some() {
            return Ok(None);
        }
        self.loads(&[]).iter().try_for_each(|(_, settings)| settings.check())?;
        self.problem.growth.check()?;
        let step = self.state.step;
        let started = Instant::now();
        let network = CrackNetwork::joined(self.state.cracks.clone(), self.state.junctions.clone())
            .map_err(|source| GrowthError::Network { step, source })?;
        let asked = || observer.interrupted();
        let body = self.body(Interruption::when(&asked), &network);
        let body = body.map_err(|source| match source.is_interruption() {
            true => GrowthError::Interrupted { step },
            false => GrowthError::Body { step, source },
        })?;
        if step >= self.problem.growth.steps {
            self.problem.engine.forget();
        }
        let body_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let remark = |text: &String| Warning { step, kind: WarningKind::Engine, text: text.clone() };
        let mut warnings: Vec<Warning> = body.remarks.iter().map(remark).collect();
        let ends = self.ends_under_wheels(&body)?;
        let fluid = self.problem.fluid.as_ref().map(|fluid| fluid.on(&network, &body.faces));
        let faces = FaceProblem::new(&body, &self.problem.crack_friction)?.with_fluid(fluid);
        let uncovered = self.uncovered();
        let loads = self.loads(&uncovered);
        let load_on = |wheel: usize| {
            let end = ends.get(wheel).map(Arc::as_ref);
            FaceLoad::new(&faces, loads[wheel].0, end).map_err(|source| self.off_the_rail(source))
        };
        let face_load = load_on(0)?;
        let others: Vec<FaceLoad> = (1..loads.len()).map(load_on).collect::<Result<_, _>>()?;
        let solvers =
            Solvers { first: self.problem.solver.as_ref(), second: self.problem.fallback.as_ref(), step };
        let (passage, beside) = if others.is_empty() {
            (solvers.stabilise(&face_load, loads[0], observer, &mut warnings)?, Vec::new())
        } else {
            let all: Vec<&FaceLoad> = std::iter::once(&face_load).chain(&others).collect();
            let mut passages = solvers.side_by_side(&all, &loads, observer, &mut warnings)?.into_iter();
            let first = passages.next().ok_or(GrowthError::Interrupted { step })?;
            (first, passages.collect())
        };
        let contact_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let fields = self.fields(&face_load, loads[0].0, &passage)?;
        let body_s = body_s + started.elapsed().as_secs_f64();

        let started = Instant::now();
        let all: Vec<&StabilisedPassage> = std::iter::once(&passage).chain(&beside).collect();
        let mut tips = self.tip_records(&network, &all);
        if let Some(judge) = &self.judge {
            tips.iter_mut().zip(&passage.histories).for_each(|(tip, history)| judge.judge(history, tip));
        }
        for tip in &tips {
            warnings.extend(self.near_tie(tip));
        }
        for (wheel, passage) in all.iter().enumerate() {
            let of_wheel = |warning: Warning| self.of_wheel(wheel, warning);
            warnings.extend(self.unrepeated(passage).map(of_wheel));
            warnings.extend(self.coupled(passage).map(of_wheel));
            warnings.extend(self.overlap(&tips, passage).map(of_wheel));
        }
        let counts = beside.iter().fold(passage.counts, |sum, other| sum.and(other.counts));
        let drives: Vec<TipDrive> = tips.iter().map(|tip| self.drive(tip)).collect();
        let slowest = self.problem.growth.arrest_rate;
        let passed = self.state.interval.map_or(0.0, |interval| interval.cycles_until(&drives, slowest));
        let load_cycles = self.state.load_cycles + passed;
        let way = advance(
            &StepState {
                step,
                cracks: &self.state.cracks,
                junctions: &self.state.junctions,
                break_outs: &self.state.break_outs,
                tips: &drives,
                load_cycles,
                worn: &self.state.worn,
                rail: self.problem.rail,
                resolution: self.problem.engine.resolution(&network),
            },
            &self.problem.growth,
        );
        for (tip, ahead) in tips.iter_mut().zip(&way.tips) {
            tip.increment = ahead.increment;
            tip.stop = ahead.stop;
        }
        let record = StepRecord {
            step,
            cracks: self.state.cracks.clone(),
            junctions: self.state.junctions.clone(),
            passages: passage.passages,
            beside: beside.into_iter().map(|passage| passage.passages).collect(),
            faces: passage.faces,
            fields,
            front: None,
            load_cycles,
            removed: self.state.worn.removed,
            dofs: body.dofs,
            counts,
            times: PhaseTimes {
                body_s,
                parts: body.times,
                contact_s,
                growth_s: started.elapsed().as_secs_f64(),
            },
            pieces: way.pieces.clone(),
            warnings,
            stop: way.stop,
            tips,
        };
        for (TipRecord { tip, .. }, ahead) in record.tips.iter().zip(&way.tips) {
            self.state.stopped[tip.crack][tip.tip] = ahead.stop;
            self.state.deferred[tip.crack][tip.tip] = ahead.deferred;
        }
        if self.problem.growth.maintained().is_some() {
            self.state.wear(&way, &drives);
        }
        self.state.step += 1;
        self.state.cracks = way.cracks;
        self.state.junctions = way.junctions;
        self.state.break_outs = way.break_outs;
        self.state.load_cycles = load_cycles;
        self.state.interval = way.interval;
        self.state.ended = way.stop;
        Ok(Some(record))
    }

    /// The body of `network`, crack by crack where contact is followed in groups.
    fn body(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError> {
        let engine = &mut self.problem.engine;
        if self.problem.network == NetworkContact::Groups
            && self.problem.fluid.is_none()
            && let Some(body) = engine.body_by_groups(interruption, network)?
        {
            return Ok(body);
        }
        engine.body_unless(interruption, network)
    }

    /// The fields that the ends of the rail add under each wheel, none for a half-plane: kept for
    /// as long as the engine keeps the rail.
    fn ends_under_wheels(&mut self, body: &CrackedBody) -> Result<Vec<Arc<dyn EndField>>, GrowthError> {
        let Some(rail) = &body.ends else { return Ok(Vec::new()) };
        if let Some((known, fields)) = &self.ends
            && std::ptr::addr_eq(Arc::as_ptr(known), Arc::as_ptr(rail))
        {
            return Ok(fields.clone());
        }
        let fields: Result<Vec<_>, EndsError> =
            self.loads(&[]).into_iter().map(|(load, settings)| load.at_ends(rail, settings)).collect();
        let fields = fields.map_err(|source| self.off_the_rail(source))?;
        self.ends = Some((Arc::clone(rail), fields.clone()));
        Ok(fields)
    }

    fn off_the_rail(&self, source: EndsError) -> GrowthError {
        GrowthError::Body { step: self.state.step, source: BodyError { reason: Box::new(source) } }
    }

    /// The residual stress under each wheel, below a surface that has come down; none where it has
    /// not, or where the stress has come down with it.
    fn uncovered(&self) -> Vec<Option<Uncovered<'_>>> {
        let removed = self.state.worn.removed;
        let moves = self.problem.growth.maintenance.as_ref().map(|maintenance| maintenance.stress);
        if removed == 0.0 || moves != Some(StressMoves::WithMetal) {
            return Vec::new();
        }
        let others = self.problem.others.iter().map(|other| other.residual.as_deref());
        std::iter::once(self.problem.residual.as_deref())
            .chain(others)
            .map(|field| field.map(|field| Uncovered { field, removed }))
            .collect()
    }

    /// The load and the passages of every wheel, with the residual stress below a surface that has
    /// come down where it is `uncovered`.
    fn loads<'a>(
        &'a self,
        uncovered: &'a [Option<Uncovered<'a>>],
    ) -> Vec<(RailLoad<'a>, &'a PassageSettings)> {
        let problem = &self.problem;
        let first = RailLoad { wheel: problem.wheel.as_ref(), residual: problem.residual.as_deref() };
        let others = problem.others.iter().map(|other| (other.load(), &other.passages));
        let all = std::iter::once((first, &problem.passages)).chain(others).enumerate();
        all.map(|(wheel, (load, passages))| match uncovered.get(wheel) {
            Some(Some(field)) => (RailLoad { residual: Some(field), ..load }, passages),
            _ => (load, passages),
        })
        .collect()
    }

    /// The estimated error of K where contact is followed in groups: of the first step, and of
    /// others where it is large.
    fn coupled(&self, passage: &StabilisedPassage) -> Option<Warning> {
        let (error, allowed) = (passage.coupling?, self.problem.passages.network_tolerance);
        let mut text = format!(
            "contact in groups: K is estimated as off by up to {:.3} % of its peak at the tip: {:.3} % for sweeps that end, {:.3} % for the \
             places at which jumps are handed over, {:.3} % for far forces",
            100.0 * error.total(),
            100.0 * error.sweeps,
            100.0 * error.hand_over,
            100.0 * error.far
        );
        if error.sweeps > allowed {
            text += &format!(
                "; that of sweeps is more than network_tolerance = {allowed}: they have come to their number"
            );
        } else if self.state.step > 0 && error.total() <= GROUPS_NEWS {
            return None;
        }
        Some(Warning { step: self.state.step, kind: WarningKind::Passages, text })
    }

    /// A warning that says which wheel of a mix it is about.
    fn of_wheel(&self, wheel: usize, warning: Warning) -> Warning {
        if self.problem.others.is_empty() {
            return warning;
        }
        Warning { text: format!("wheel {}, {}", wheel + 1, warning.text), ..warning }
    }

    /// The fields of this step, where they are wanted.
    fn fields(
        &self,
        face_load: &FaceLoad,
        load: RailLoad,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        let step = self.state.step;
        let wanted = self.problem.fields.as_ref().filter(|fields| step.is_multiple_of(fields.every.get()));
        let Some(settings) = wanted else { return Ok(None) };
        fields::record_fields(face_load, load, passage, settings)
            .map_err(|source| GrowthError::Body { step, source })
    }

    /// The state and the demand of every tip under all wheels, without increments.
    fn tip_records(&self, network: &CrackNetwork, passages: &[&StabilisedPassage]) -> Vec<TipRecord> {
        let growth = &self.problem.growth;
        let direction = HourlierPineau { law: growth.law.clone(), criterion: growth.criterion };
        let histories: Vec<&[SifHistory]> = passages.iter().map(|passage| &passage.histories[..]).collect();
        let others = || self.problem.others.iter();
        let shares: Vec<f64> = std::iter::once(self.problem.share).chain(others().map(|w| w.share)).collect();
        let toughness: Vec<Option<f64>> =
            std::iter::once(growth.toughness).chain(others().map(|wheel| wheel.toughness)).collect();
        let tips = network.tips().into_iter().enumerate();
        tips.map(|(i, tip)| {
            let crack = &network.cracks()[tip.crack];
            let wheels = histories_of(i, &shares, &histories);
            let under = MixedTip::of(&direction, &wheels, &toughness);
            let kink = direction.kink_of_mix(&wheels);
            let secondary = kink.as_ref().and_then(|kink: &Kink| kink.secondary);
            let turned_by = kink.filter(|_| wheels.len() > 1);
            let at = crack.tip(tip.end);
            let ranges = under.ranges;
            TipRecord {
                tip,
                x: at.x,
                y: at.y,
                length: crack.length() + self.state.deferred_at(tip.crack),
                deferred: self.state.deferred[tip.crack][tip.tip],
                ki_max: ranges.ki_max,
                delta_ki: ranges.delta_ki,
                delta_kii: ranges.delta_kii,
                delta_keq: growth.law.equivalent_range(ranges.delta_ki, ranges.delta_kii),
                largest_k1: under.largest_k1,
                kink: kink.map(|kink| kink.angle),
                secondary: secondary.map(|secondary| secondary.angle),
                secondary_ratio: secondary.map(|secondary| secondary.ratio),
                increment: 0.0,
                rate: under.rate,
                stop: None,
                shares: under.shares,
                turned_by: turned_by.and_then(|kink| turned_by_wheel(&direction, &wheels, kink.angle)),
                opened_by: under.opened_by,
                mouth_sine: mouth_sine(crack),
                front: None,
            }
        })
        .collect()
    }

    fn drive(&self, tip: &TipRecord) -> TipDrive {
        let CrackTip { crack, tip: index, .. } = tip.tip;
        let (deferred, stopped) = (self.state.deferred[crack][index], self.state.stopped[crack][index]);
        // In the measure of the first wheel's toughness, with which it is compared.
        let own = tip.opened_by.checked_sub(1).and_then(|i| self.problem.others.get(i)?.toughness);
        let scale = self.problem.growth.toughness.zip(own).map_or(1.0, |(first, own)| first / own);
        let largest_k1 = tip.largest_k1.map_or(0.0, |largest| scale * largest.k1);
        TipDrive { tip: tip.tip, kink: tip.kink, rate: tip.rate, largest_k1, deferred, stopped }
    }

    fn near_tie(&self, tip: &TipRecord) -> Option<Warning> {
        let (kink, secondary, ratio) = (tip.kink?, tip.secondary?, tip.secondary_ratio?);
        if ratio <= NEAR_TIE || self.state.stopped[tip.tip.crack][tip.tip.tip].is_some() {
            return None;
        }
        let text = format!(
            "crack {} tip {}: kinks of {:.1} and {:.1} degrees are nearly as good, ratio {ratio:.4}; the path hangs on it",
            tip.tip.crack + 1,
            tip.tip.tip + 1,
            kink.to_degrees(),
            secondary.to_degrees()
        );
        Some(Warning { step: self.state.step, kind: WarningKind::NearTie, text })
    }

    fn overlap(&self, tips: &[TipRecord], passage: &StabilisedPassage) -> Option<Warning> {
        let (tip, share) = passage.lowest_opening().filter(|(_, share)| *share < -OVERLAP)?;
        let tip = tips.get(tip)?;
        let text = format!(
            "crack {} tip {}: K_I goes down to {:.1} % of the largest K of the step, as if the faces overlapped ahead of the tip; K is known to that \
             amount, and smaller elements (element_size_mm, interface_elements) resolve it",
            tip.tip.crack + 1,
            tip.tip.tip + 1,
            100.0 * share,
        );
        Some(Warning { step: self.state.step, kind: WarningKind::Engine, text })
    }

    fn unrepeated(&self, passage: &StabilisedPassage) -> Option<Warning> {
        let change = passage.last_change?;
        let tolerance = self.problem.passages.passage_tolerance;
        (change > tolerance).then(|| Warning {
            step: self.state.step,
            kind: WarningKind::Passages,
            text: format!(
                "K still changes by {change:.2e} of its peak after {} passages, tolerance {tolerance:.1e}",
                passage.counts.passages
            ),
        })
    }
}

//! Growth as an iterator of steps that can be stored and resumed.

use super::face_load::FaceLoad;
use super::passage::passages_under;
use super::{
    FieldRecord, FieldSettings, GrowthSettings, GrowthState, Observer, PassageError, PassageSettings,
    PhaseTimes, RailLoad, StabilisedPassage, StepRecord, StepState, TipDrive, TipRecord, Warning,
    WarningKind, advance, fields,
};
use crate::body::{BodyEngine, BodyError, CrackedBody};
use crate::contact::{ContactSolver, CrackFrictionError, FaceProblem, Latin, Newton};
use crate::crack::{CrackNetwork, CrackTip, NetworkError};
use crate::fatigue::{HourlierPineau, Kink, LargestK1, RUNAWAY, SifRanges};
use crate::field::{EndField, EndsError, RailEnds, StressField, Wheel};
use crate::math::{OutOfRange, RailBox};
use std::sync::Arc;
use std::time::Instant;

/// Why a step could not be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GrowthError {
    /// Settings under which nothing can be computed.
    #[error(transparent)]
    Settings(#[from] OutOfRange),
    /// Crack-face friction that does not fit the cracks.
    #[error(transparent)]
    Friction(#[from] CrackFrictionError),
    /// The observer interrupted the step; the state before it is intact.
    #[error("interrupted at step {step}")]
    Interrupted {
        /// The step that was given up.
        step: usize,
    },
    /// The engine cannot represent the cracks.
    #[error("step {step}: {source}")]
    Body {
        /// The step.
        step: usize,
        /// The error of the engine.
        source: BodyError,
    },
    /// Contact did not converge.
    #[error("step {step}: {source}")]
    Passage {
        /// The step.
        step: usize,
        /// Where and how.
        source: PassageError,
    },
    /// The cracks have run into each other.
    #[error("step {step}: {source}")]
    Network {
        /// The step.
        step: usize,
        /// Which of them.
        source: NetworkError,
    },
}

/// Everything that does not change in a run.
pub struct GrowthProblem {
    /// Turns cracks into a body.
    pub engine: Box<dyn BodyEngine>,
    /// Solves contact on the faces.
    pub solver: Box<dyn ContactSolver>,
    /// Takes over for a step that `solver` cannot do.
    pub fallback: Box<dyn ContactSolver>,
    /// μ_c of each crack.
    pub crack_friction: Vec<f64>,
    /// The wheel.
    pub wheel: Box<dyn Wheel>,
    /// Balanced residual stress.
    pub residual: Option<Box<dyn StressField>>,
    /// The passages.
    pub passages: PassageSettings,
    /// Fields to record; none where there are none to.
    pub fields: Option<FieldSettings>,
    /// Growth law, increments, stops.
    pub growth: GrowthSettings,
    /// The rail.
    pub rail: RailBox,
}

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
            crack_friction,
            wheel: Box::new(wheel),
            residual: None,
            passages: PassageSettings::default(),
            fields: None,
            growth: GrowthSettings::default(),
            rail: RailBox::default(),
        }
    }
}

/// A run over growth steps. [`Growth::next_step`] computes one step; [`Growth::state`] is what to
/// store after it.
pub struct Growth {
    problem: GrowthProblem,
    state: GrowthState,
    /// The ends of the rail of the last step, and what they add under the wheel.
    ends: Option<(Arc<dyn RailEnds>, Arc<dyn EndField>)>,
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
        Self { problem, state, ends: None }
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
        self.problem.passages.check()?;
        self.problem.growth.check()?;
        let step = self.state.step;
        let started = Instant::now();
        let network = CrackNetwork::joined(self.state.cracks.clone(), self.state.junctions.clone())
            .map_err(|source| GrowthError::Network { step, source })?;
        let body = self.problem.engine.body(&network).map_err(|source| GrowthError::Body { step, source })?;
        if step >= self.problem.growth.steps {
            self.problem.engine.forget();
        }
        let body_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let remark = |text: &String| Warning { step, kind: WarningKind::Engine, text: text.clone() };
        let mut warnings: Vec<Warning> = body.remarks.iter().map(remark).collect();
        let ends = self.ends_under_wheel(&body)?;
        let faces = FaceProblem::new(&body, &self.problem.crack_friction)?;
        let face_load = FaceLoad::new(&faces, self.load(), ends.as_deref())
            .map_err(|source| self.off_the_rail(source))?;
        let passage = self.stabilise(&face_load, observer, &mut warnings)?;
        let contact_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let fields = self.fields(&face_load, &passage)?;
        let body_s = body_s + started.elapsed().as_secs_f64();

        let started = Instant::now();
        let mut tips = self.tip_records(&network, &passage);
        for tip in &tips {
            warnings.extend(self.near_tie(tip));
        }
        warnings.extend(self.unrepeated(&passage));
        warnings.extend(self.overlap(&tips, &passage));
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
            faces: passage.faces,
            fields,
            load_cycles,
            dofs: body.dofs,
            counts: passage.counts,
            times: PhaseTimes {
                body_s,
                parts: body.times,
                contact_s,
                growth_s: started.elapsed().as_secs_f64(),
            },
            pieces: way.pieces,
            warnings,
            stop: way.stop,
            tips,
        };
        for (TipRecord { tip, .. }, ahead) in record.tips.iter().zip(&way.tips) {
            self.state.stopped[tip.crack][tip.tip] = ahead.stop;
            self.state.deferred[tip.crack][tip.tip] = ahead.deferred;
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

    /// The field that the ends of the rail add under the wheel: kept for as long as the engine
    /// keeps the rail.
    fn ends_under_wheel(&mut self, body: &CrackedBody) -> Result<Option<Arc<dyn EndField>>, GrowthError> {
        let Some(rail) = &body.ends else { return Ok(None) };
        if let Some((known, field)) = &self.ends
            && std::ptr::addr_eq(Arc::as_ptr(known), Arc::as_ptr(rail))
        {
            return Ok(Some(Arc::clone(field)));
        }
        let field = self.load().at_ends(rail, &self.problem.passages);
        let field = field.map_err(|source| self.off_the_rail(source))?;
        self.ends = Some((Arc::clone(rail), Arc::clone(&field)));
        Ok(Some(field))
    }

    fn off_the_rail(&self, source: EndsError) -> GrowthError {
        GrowthError::Body { step: self.state.step, source: BodyError { reason: Box::new(source) } }
    }

    fn load(&self) -> RailLoad<'_> {
        RailLoad { wheel: self.problem.wheel.as_ref(), residual: self.problem.residual.as_deref() }
    }

    /// The fields of this step, where they are wanted.
    fn fields(
        &self,
        face_load: &FaceLoad,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        let step = self.state.step;
        let wanted = self.problem.fields.as_ref().filter(|fields| step.is_multiple_of(fields.every.get()));
        let Some(settings) = wanted else { return Ok(None) };
        fields::record_fields(face_load, self.load(), passage, settings)
            .map_err(|source| GrowthError::Body { step, source })
    }

    /// The passages, by the solver or, where it fails, by the other one.
    fn stabilise(
        &self,
        face_load: &FaceLoad,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<StabilisedPassage, GrowthError> {
        let step = self.state.step;
        let (load, settings) = (self.load(), &self.problem.passages);
        let by = |solver: &dyn ContactSolver| passages_under(face_load, load, solver, settings, observer);
        let first = by(self.problem.solver.as_ref());
        let result = match first {
            Err(PassageError::NotConverged { .. }) => {
                let second = by(self.problem.fallback.as_ref());
                if let (Err(failure), Ok(_)) = (&first, &second) {
                    let text = format!("the other contact solver did this step, since: {failure}");
                    warnings.push(Warning { step, kind: WarningKind::ContactFallback, text });
                }
                if matches!(second, Err(PassageError::NotConverged { .. })) { first } else { second }
            }
            other => other,
        };
        result.map_err(|source| match source {
            PassageError::Interrupted => GrowthError::Interrupted { step },
            source => GrowthError::Passage { step, source },
        })
    }

    /// The state and the demand of every tip, without increments.
    fn tip_records(&self, network: &CrackNetwork, passage: &StabilisedPassage) -> Vec<TipRecord> {
        let law = &self.problem.growth.law;
        let direction = HourlierPineau { law: law.clone(), criterion: self.problem.growth.criterion };
        let tips = network.tips().into_iter().zip(&passage.histories);
        tips.map(|(tip, history)| {
            let crack = &network.cracks()[tip.crack];
            let ranges = SifRanges::of(history);
            let kink = direction.kink(history);
            let secondary = kink.as_ref().and_then(|kink: &Kink| kink.secondary);
            let at = crack.tip(tip.end);
            TipRecord {
                tip,
                x: at.x,
                y: at.y,
                length: crack.length() + self.state.deferred_at(tip.crack),
                deferred: self.state.deferred[tip.crack][tip.tip],
                ki_max: ranges.ki_max,
                delta_ki: ranges.delta_ki,
                delta_kii: ranges.delta_kii,
                delta_keq: law.equivalent_range(ranges.delta_ki, ranges.delta_kii),
                largest_k1: LargestK1::of(history),
                kink: kink.map(|kink| kink.angle),
                secondary: secondary.map(|secondary| secondary.angle),
                secondary_ratio: secondary.map(|secondary| secondary.ratio),
                increment: 0.0,
                rate: law.rate(ranges.load()).min(RUNAWAY),
                stop: None,
            }
        })
        .collect()
    }

    fn drive(&self, tip: &TipRecord) -> TipDrive {
        let CrackTip { crack, tip: index, .. } = tip.tip;
        let (deferred, stopped) = (self.state.deferred[crack][index], self.state.stopped[crack][index]);
        let largest_k1 = tip.largest_k1.map_or(0.0, |largest| largest.k1);
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

//! Growth as an iterator of steps that can be stored and resumed.

use super::rail::check;
use super::warnings::Warnings;
use super::{
    CrackedRail, GrowthError, GrowthState, Observer, PhaseTimes, StabilisedPassage, StepRecord, StepStart,
    TipJudge, Warning, WarningKind,
};
use crate::interruption::Interruption;
use std::sync::Arc;
use std::time::Instant;

/// A run over growth steps, in the plane or in space. [`Growth::next_step`] computes one step;
/// [`Growth::state`] is what to store after it.
pub struct Growth<R> {
    rail: R,
    judge: Option<Arc<dyn TipJudge>>,
    state: GrowthState,
}

impl<R: CrackedRail> Growth<R> {
    /// A run with the cracks of `rail` from `state` on.
    pub fn new(rail: R, state: GrowthState) -> Self {
        Self { rail, judge: None, state }
    }

    /// Has `judge` give direction and rate of every tip; of a front point in space, its rate.
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
    ///
    /// Errors: settings under which nothing can be computed; cracks that the engine cannot
    /// represent; a contact that does not converge; an interruption.
    pub fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        if self.state.ended.is_some() {
            return Ok(None);
        }
        let (rail, state) = (&mut self.rail, &self.state);
        check(rail)?;
        let step = state.step;
        let started = Instant::now();
        let asked = || observer.interrupted();
        let body = rail.body(state, Interruption::when(&asked))?;
        if step >= rail.settings().steps {
            rail.forget();
        }
        let report = rail.report(&body);
        let body_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let before = StepStart { step, load_cycles: state.load_cycles, worn: &state.worn };
        let remark = |text: &String| Warning { step, kind: WarningKind::Engine, text: text.clone() };
        let mut warnings: Vec<Warning> = report.remarks.iter().map(remark).collect();
        let mut passages = rail.passages(&body, &before, observer, &mut warnings)?;
        let contact_s = started.elapsed().as_secs_f64();

        let started = Instant::now();
        let first = passages.first().ok_or(GrowthError::Interrupted { step })?;
        let fields = rail.fields(&body, &before, first)?;
        let body_s = body_s + started.elapsed().as_secs_f64();

        let started = Instant::now();
        let mut tips = rail.demands(&body, &passages);
        if let Some(judge) = &self.judge {
            tips.iter_mut().zip(&first.histories).for_each(|(tip, history)| judge.judge(history, tip));
        }
        let wheels = rail.wheels();
        warnings.extend(
            Warnings { step, refinement: rail.refinement(), wheels: &wheels }.of(state, &tips, &passages),
        );
        let counts = passages.iter().skip(1).fold(first.counts, |sum, other| sum.and(other.counts));
        let movers = rail.movers(&body, &tips);
        let slowest = rail.settings().arrest_rate;
        let passed = state.interval.map_or(0.0, |interval| interval.cycles_until(&movers, slowest));
        let load_cycles = state.load_cycles + passed;
        let at = StepStart { load_cycles, ..before };
        let mut advance = rail.advance(&body, &at, &mut tips, &movers);
        warnings.append(&mut advance.warnings);
        let beside: Vec<StabilisedPassage> = passages.split_off(1);
        let first = passages.swap_remove(0);
        let record = StepRecord {
            step,
            geometry: state.geometry.clone(),
            tips,
            passages: first.passages,
            beside: beside.into_iter().map(|passage| passage.passages).collect(),
            faces: first.faces,
            fields,
            load_cycles,
            removed: state.worn.removed,
            dofs: report.dofs,
            counts,
            times: PhaseTimes {
                body_s,
                parts: report.times,
                contact_s,
                growth_s: started.elapsed().as_secs_f64(),
            },
            pieces: std::mem::take(&mut advance.pieces),
            warnings,
            stop: advance.stop,
        };
        if self.rail.settings().maintained().is_some() {
            self.state.wear(&advance, &movers);
        }
        self.state.step += 1;
        self.state.geometry = advance.geometry;
        self.state.load_cycles = load_cycles;
        self.state.interval = advance.interval;
        self.state.ended = advance.stop;
        Ok(Some(record))
    }
}

//! Growth as an iterator of steps that can be stored and resumed.

use super::control::{Control, End, Trial, Verdict};
use super::rail::check;
use super::warnings::Warnings;
use super::{
    Advance, BodyReport, CrackedRail, FieldRecord, GrowthError, GrowthState, Jump, Mover, Observer,
    PhaseTimes, PopInTest, RunStop, StabilisedPassage, StepProgress, StepRecord, StepStart, TipGeometry,
    TipJudge, TipRecord, Warning, WarningKind,
};
use crate::crack::CrackTip;
use crate::fatigue::RUNAWAY;
use crate::interruption::Interruption;
use crate::stopwatch::Stopwatch;
use std::sync::Arc;

/// A run over growth steps, in the plane or in space. [`Growth::next_step`] computes one step;
/// [`Growth::state`] is the state to store after it.
pub struct Growth<R: CrackedRail> {
    rail: R,
    judge: Option<Arc<dyn TipJudge>>,
    state: GrowthState,
    /// The cracks of the state under their passages, where they are known already.
    ahead: Option<Loaded<R::Site>>,
}

/// Ratio of the largest k1 to that of the last test from which a kink is tested again.
const TESTED_AGAIN: f64 = 1.05;

/// The cracks of a step under their stabilised passages.
struct Loaded<S> {
    site: S,
    report: BodyReport,
    passages: Vec<StabilisedPassage>,
    fields: Option<FieldRecord>,
    tips: Vec<TipRecord>,
    movers: Vec<Mover>,
    /// For each tip, the largest k1 over the toughness.
    hazards: Vec<f64>,
    warnings: Vec<Warning>,
    /// The test of a kink in this step; `None` before it is known whether there is one.
    tested: Option<Option<PopInTest>>,
    /// Load cycles at the start of the step.
    load_cycles: f64,
    /// Load cycles of the previous step.
    passed: f64,
    body_s: f64,
    contact_s: f64,
    growth_s: f64,
}

/// The tips of a step, its advance, and the state that follows, with its passages where they are
/// known.
type Advanced<S> = (Vec<TipRecord>, Advance, Option<(GrowthState, Option<Loaded<S>>)>);

impl<R: CrackedRail> Growth<R> {
    /// A run with the cracks of `rail` that continues from `state`.
    pub fn new(rail: R, state: GrowthState) -> Self {
        Self { rail, judge: None, state, ahead: None }
    }

    /// Lets `judge` determine the direction and rate of every tip, and the rate of every front
    /// point in space.
    #[must_use]
    pub fn judged_by(self, judge: Arc<dyn TipJudge>) -> Self {
        Self { judge: Some(judge), ..self }
    }

    /// The state after the last computed step, from which a new run can continue.
    pub fn state(&self) -> &GrowthState {
        &self.state
    }

    /// The rail.
    #[cfg(test)]
    pub(super) fn rail(&self) -> &R {
        &self.rail
    }

    /// Computes the next step; `None` when the run has ended. An error leaves the state as it was
    /// before the step.
    ///
    /// The increment of a step is made, and the cracks of the next step are computed, before the
    /// step is complete: where the increment was too long, or passed an event, it is cut and made
    /// again.
    ///
    /// Each step starts from virgin faces: slip from the previous step is not carried over to the
    /// longer cracks.
    ///
    /// Errors: inadmissible settings; cracks that the engine cannot represent; contact that does
    /// not converge; an interruption.
    pub fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        if self.state.ended.is_some() {
            return Ok(None);
        }
        check(&self.rail)?;
        let mut now = match self.ahead.take() {
            Some(now) => now,
            None => {
                let state = self.state.clone();
                self.loaded(&state, observer, |_| true)?
            }
        };
        let (tips, advance, next) = match self.advanced(&mut now, observer) {
            Ok(advanced) => advanced,
            Err(error) => {
                self.ahead = Some(now);
                return Err(error);
            }
        };
        let after = self.state.after(&advance, now.load_cycles);
        let tested_k1 = now.tested.flatten().map_or(self.state.tested_k1, |test| test.k1);
        let record = self.record(now, tips, &advance);
        (self.state, self.ahead) = next.unwrap_or((after, None));
        self.state.tested_k1 = tested_k1;
        Ok(Some(record))
    }

    /// The tips of the step `now`, its advance, and the state that follows, with its passages where
    /// they are known: trials of increments until one is accepted.
    ///
    /// Errors: an interruption.
    fn advanced(
        &mut self,
        now: &mut Loaded<R::Site>,
        observer: &dyn Observer,
    ) -> Result<Advanced<R::Site>, GrowthError> {
        if now.tested.is_none() {
            now.tested = Some(self.tested(now, observer)?);
        }
        let mut trial = Trial::default();
        loop {
            let started = Stopwatch::start();
            let mut tips = now.tips.clone();
            let at = start_of(&self.state, now, &trial, self.rail.settings().increment);
            let mut advance = self.rail.advance(&now.site, &at, &mut tips, &now.movers);
            now.growth_s += started.seconds();
            if advance.stop == Some(RunStop::Fracture)
                && let Some(popped) = self.pop_in(now, &mut tips, observer)?
            {
                advance = popped;
            }
            if advance.stop.is_some() {
                return Ok((tips, advance, None));
            }
            advance.progress.is_cut |= trial.ends_at_event();
            let state = self.state.after(&advance, now.load_cycles);
            let control = Control {
                settings: self.rail.settings().clone(),
                course: self.state.course,
                earlier: self.state.earlier.clone(),
                advance: &advance,
                before: End {
                    tips: &tips,
                    movers: &now.movers,
                    hazard: now.hazard(),
                    load_cycles: now.load_cycles,
                },
            };
            if let Some(shorter) = control.shortened(&trial) {
                trial = shorter;
                continue;
            }
            let mut verdict = Verdict::Accepted(self.state.course);
            let judged = self.loaded(&state, observer, |next| {
                verdict = control.judge(&next.end(), &trial);
                matches!(verdict, Verdict::Accepted(_))
            });
            let next = match judged {
                Err(error) if error.is_interruption() => return Err(error),
                // The next step reports the error.
                Err(_) => return Ok((tips, advance, Some((state, None)))),
                Ok(next) => next,
            };
            match verdict {
                Verdict::Again(again) => {
                    now.take_effort(&next);
                    trial = again;
                }
                Verdict::Accepted(course) => {
                    return Ok((tips, advance, Some((GrowthState { course, ..state }, Some(next)))));
                }
            }
        }
    }

    /// The test of a real kink at the tip with the largest k1, where that reaches the usual
    /// toughness and clearly exceeds that of the last test.
    ///
    /// Errors: an interruption.
    fn tested(
        &mut self,
        now: &mut Loaded<R::Site>,
        observer: &dyn Observer,
    ) -> Result<Option<PopInTest>, GrowthError> {
        let settings = self.rail.settings();
        let Some(usual) = settings.usual_toughness.filter(|_| settings.toughness.is_none()) else {
            return Ok(None);
        };
        let least = usual.max(TESTED_AGAIN * self.state.tested_k1);
        let opened = now.tips.iter().filter(|tip| !self.state.geometry.has_stopped(tip.tip));
        let opened = opened.filter_map(|tip| Some((tip, tip.largest_k1?)));
        let most = opened.reduce(|most, next| if next.1.k1 > most.1.k1 { next } else { most });
        let Some((tip, largest)) = most.filter(|(_, largest)| largest.k1 >= least) else { return Ok(None) };
        let CrackTip { crack, tip: index, .. } = tip.tip;
        let mut test = PopInTest {
            crack,
            tip: index,
            k1: largest.k1,
            angle: largest.angle,
            length: PopInTest::LENGTH,
            k1_after: None,
        };
        let Some(geometry) = self.rail.popped_in(&now.site, &[tip], test.length) else {
            return Ok(Some(test));
        };
        let state = GrowthState { geometry, ..self.state.clone() };
        let kinked = match self.loaded(&state, observer, |_| false) {
            Err(error) if error.is_interruption() => return Err(error),
            // Cracks that cannot be computed give no evidence of an arrest.
            Err(_) => return Ok(Some(test)),
            Ok(kinked) => kinked,
        };
        let own = kinked.tips.iter().find(|tip| (tip.tip.crack, tip.tip.tip) == (crack, index));
        // A kink that ends on another crack has no tip.
        test.k1_after = Some(own.and_then(|tip| tip.largest_k1).map_or(0.0, |largest| largest.k1));
        now.take_effort(&kinked);
        Ok(Some(test))
    }

    /// The transition to the cracks with real kinks at the tips whose virtual kinks reach the
    /// toughness, if those kinks arrest; `None` where the rail fractures.
    ///
    /// Errors: an interruption.
    fn pop_in(
        &mut self,
        now: &mut Loaded<R::Site>,
        tips: &mut [TipRecord],
        observer: &dyn Observer,
    ) -> Result<Option<Advance>, GrowthError> {
        let Some(length) = self.rail.settings().pop_in else { return Ok(None) };
        let critical: Vec<usize> = (0..tips.len()).filter(|&i| now.hazards[i] >= 1.0).collect();
        if critical.is_empty() || critical.iter().any(|&i| tips[i].rate >= RUNAWAY) {
            return Ok(None);
        }
        let mut popped = None;
        let mut texts = Vec::new();
        for part in [1.0, 0.5, 2.0] {
            let at: Vec<&TipRecord> = critical.iter().map(|&i| &now.tips[i]).collect();
            let Some(geometry) = self.rail.popped_in(&now.site, &at, part * length) else { return Ok(None) };
            let state = GrowthState { geometry: geometry.clone(), ..self.state.clone() };
            let next = match self.loaded(&state, observer, |_| false) {
                Err(error) if error.is_interruption() => return Err(error),
                // Cracks that cannot be computed give no evidence of an arrest.
                Err(_) => return Ok(None),
                Ok(next) => next,
            };
            let hazard = critical
                .iter()
                .filter_map(|&i| next.tips.iter().position(|tip| tip.tip == tips[i].tip))
                .map(|i| next.hazards[i])
                .fold(0.0, f64::max);
            now.take_effort(&next);
            if part == 1.0 && hazard >= 1.0 {
                return Ok(None);
            }
            if part == 1.0 {
                popped = Some(geometry);
            } else if hazard >= 1.0 {
                texts.push(format!("with {} mm, k1 is still {hazard:.3} of the toughness", part * length));
            }
        }
        let Some(geometry) = popped else { return Ok(None) };
        let lengths = geometry.lengths().into_iter().zip(self.state.geometry.lengths());
        let grown: Vec<f64> = lengths.map(|(after, before)| after - before).collect();
        critical.iter().for_each(|&i| pop(&mut tips[i], &grown));
        let (first, hazard) = (&tips[critical[0]], now.hazards[critical[0]]);
        let text = pop_in_text(first, hazard, &texts);
        let warning =
            Warning { step: self.state.step, kind: WarningKind::PopIn, text, severity: Some(hazard) };
        Ok(Some(Advance {
            geometry,
            pieces: Vec::new(),
            progress: StepProgress::default(),
            stop: None,
            warnings: vec![warning],
        }))
    }

    /// The cracks of `state` under their stabilised passages. Fields are computed where `accept`
    /// takes the result.
    fn loaded(
        &mut self,
        state: &GrowthState,
        observer: &dyn Observer,
        accept: impl FnOnce(&Loaded<R::Site>) -> bool,
    ) -> Result<Loaded<R::Site>, GrowthError> {
        let rail = &mut self.rail;
        let step = state.step;
        let started = Stopwatch::start();
        let asked = || observer.interrupted();
        let body = rail.body(state, Interruption::when(&asked))?;
        let report = rail.report(&body);
        let body_s = started.seconds();

        let started = Stopwatch::start();
        let before = state.start();
        let remark =
            |text: &String| Warning { step, kind: WarningKind::Engine, text: text.clone(), severity: None };
        let mut warnings: Vec<Warning> = report.remarks.iter().map(remark).collect();
        let passages = rail.passages(&body, &before, observer, &mut warnings)?;
        let contact_s = started.seconds();

        let started = Stopwatch::start();
        let first = passages.first().ok_or(GrowthError::Interrupted { step })?;
        let mut tips = rail.demands(&body, &passages);
        if let Some(judge) = &self.judge {
            tips.iter_mut().zip(&first.histories).for_each(|(tip, history)| judge.judge(history, tip));
        }
        let wheels = rail.wheels();
        warnings.extend(
            Warnings { step, refinement: rail.refinement(), wheels: &wheels, growth: rail.settings() }
                .of(state, &tips, &passages),
        );
        let movers = rail.movers(&body, &tips);
        let slowest = rail.settings().arrest_rate;
        let passed = state.interval.map_or(0.0, |interval| interval.cycles_until(&movers, slowest));
        let growth_s = started.seconds();
        let site = rail.site(&body);
        let mut loaded = Loaded {
            hazards: tips.iter().map(|tip| rail.hazard(&site, tip)).collect(),
            site,
            report,
            passages,
            fields: None,
            tips,
            movers,
            warnings,
            tested: None,
            load_cycles: state.load_cycles + passed,
            passed,
            body_s,
            contact_s,
            growth_s,
        };
        if accept(&loaded) {
            self.record_fields(&body, &before, &mut loaded)?;
        }
        Ok(loaded)
    }

    /// Computes the fields of an accepted step, and drops in the last one what is only needed for
    /// further ones.
    fn record_fields(
        &mut self,
        body: &R::Body,
        at: &StepStart<'_>,
        loaded: &mut Loaded<R::Site>,
    ) -> Result<(), GrowthError> {
        let started = Stopwatch::start();
        if let Some(first) = loaded.passages.first() {
            loaded.fields = self.rail.fields(body, at, first)?;
        }
        loaded.body_s += started.seconds();
        if at.counted >= self.rail.settings().steps {
            self.rail.forget();
        }
        Ok(())
    }

    fn record(&self, now: Loaded<R::Site>, tips: Vec<TipRecord>, advance: &Advance) -> StepRecord {
        let Loaded { report, mut passages, fields, mut warnings, load_cycles, .. } = now;
        let counts = passages.iter().skip(1).fold(passages[0].counts, |sum, other| sum.and(other.counts));
        warnings.extend(advance.warnings.iter().cloned());
        let lifts = |passage: &&StabilisedPassage| passage.is_wet() && !passage.is_coupled();
        let unfelt_opening =
            passages.iter().filter(lifts).map(StabilisedPassage::largest_opening).fold(0.0, f64::max);
        let others = passages.split_off(1).into_iter();
        let (other_wheels, other_faces): (Vec<_>, Vec<_>) =
            others.map(|passage| (passage.passages, passage.faces)).unzip();
        let is_end = self.state.step == 0 || advance.stop.is_some();
        let first = passages.swap_remove(0);
        StepRecord {
            step: self.state.step,
            geometry: self.state.geometry.clone(),
            tips,
            passages: first.passages,
            other_wheels,
            faces: first.faces,
            other_faces: if is_end { other_faces } else { Vec::new() },
            unfelt_opening,
            fields,
            load_cycles,
            cycles_error: self.state.course.error(),
            removed: self.state.worn.removed,
            dofs: report.dofs,
            counts,
            times: PhaseTimes {
                body_s: now.body_s,
                parts: report.times,
                contact_s: now.contact_s,
                growth_s: now.growth_s,
            },
            pop_in_test: now.tested.flatten(),
            pieces: advance.pieces.clone(),
            warnings,
            stop: advance.stop,
        }
    }
}

impl<S> Loaded<S> {
    /// The largest k1 of all tips over the toughness.
    fn hazard(&self) -> f64 {
        self.hazards.iter().copied().fold(0.0, f64::max)
    }

    /// The state as the control of the increments sees it.
    fn end(&self) -> End<'_> {
        End { tips: &self.tips, movers: &self.movers, hazard: self.hazard(), load_cycles: self.load_cycles }
    }

    /// Adds the effort of an attempt that does not stand.
    fn take_effort(&mut self, attempt: &Self) {
        self.body_s += attempt.body_s;
        self.contact_s += attempt.contact_s;
        self.growth_s += attempt.growth_s;
    }
}

/// Records a pop-in at `tip`, with the growth of each crack (mm).
fn pop(tip: &mut TipRecord, grown: &[f64]) {
    tip.increment = grown[tip.tip.crack];
    tip.stop = None;
    if let TipGeometry::Plane(plane) = &mut tip.geometry {
        plane.jump = Some(Jump::PopIn);
        plane.turn = tip.largest_k1.map_or(0.0, |largest| largest.angle);
        plane.is_drawn = true;
    }
}

/// The text of a pop-in at `tip`, where k1 of a virtual kink is `hazard` times the toughness, with
/// what kinks of other lengths do.
fn pop_in_text(tip: &TipRecord, hazard: f64, others: &[String]) -> String {
    let mut text = format!(
        "crack {} tip {}: pop-in of {:.2} mm at {:.0} degrees: k1 of a virtual kink is {hazard:.3} of the toughness, and the kink arrests",
        tip.tip.crack + 1,
        tip.tip.tip + 1,
        tip.increment,
        tip.largest_k1.map_or(0.0, |largest| largest.angle.to_degrees()),
    );
    for other in others {
        text += &format!("; {other}");
    }
    text
}

/// The start of the `trial` of a step from `state`.
fn start_of<'a, S>(
    state: &'a GrowthState,
    now: &Loaded<S>,
    trial: &'a Trial,
    increment: f64,
) -> StepStart<'a> {
    StepStart {
        load_cycles: now.load_cycles,
        passed: now.passed,
        share: state.course.share.unwrap_or(increment),
        cycles_at_most: trial.cycles_at_most,
        turns: &trial.turns,
        ..state.start()
    }
}

//! Pressures of trapped fluid along a load step: rates and events.

use super::condition::Degenerate;
use super::parabola::Parabola;
use super::pressure::{PocketRows, content, has_open_path, is_empty, may_press, round_off};
use super::problem::ROUND_OFF;
use super::tableau::FaceRate;
use super::{FaceProblem, FaceResponse, FaceScale, FaceSolution, PocketState, PocketStatus};

/// The pressure (MPa) over the mouth of each pocket within a step, at share τ of it: c0 + τ c1 +
/// τ² c2.
#[derive(Debug, Clone, Default)]
pub(super) struct OutsidePressure(Vec<[f64; 3]>);

impl OutsidePressure {
    /// The parabolas through the values at the start, in the middle and at the end.
    pub(super) fn through(start: &[f64], middle: &[f64], end: &[f64]) -> Self {
        let one = |((&s, &m), &e): ((&f64, &f64), &f64)| [s, 4.0 * m - 3.0 * s - e, 2.0 * (s + e) - 4.0 * m];
        Self(start.iter().zip(middle).zip(end).map(one).collect())
    }

    /// The pressures at share `share` of the step.
    pub(super) fn at(&self, share: f64) -> Vec<f64> {
        self.0.iter().map(|[c0, c1, c2]| c0 + share * (c1 + share * c2)).collect()
    }

    /// Whether the pressure over the mouth of pocket `k` differs from zero or changes.
    fn drives(&self, k: usize) -> bool {
        self.0[k] != [0.0; 3]
    }

    fn of(&self, k: usize, share: f64) -> Parabola {
        let [c0, c1, c2] = self.0[k];
        Parabola::of(c0 + share * (c1 + share * c2), c1, c2, share)
    }
}

/// The pockets during a load step.
pub(super) struct PocketTrace {
    /// The pressure over the mouths.
    outside: OutsidePressure,
    /// Responses to a unit pressure of each pocket that may be or come under pressure.
    units: Vec<FaceRate>,
    /// Coefficients of τ and τ² of the pressure and of the volume of each pocket.
    pressures: Vec<[f64; 2]>,
    volumes: Vec<[f64; 2]>,
    /// Excess (MPa) of the pressure on open faces over that at the mouth at which fluid is
    /// released.
    pub release_excess: f64,
}

/// An event of a pocket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PocketEvent {
    /// Its status becomes this one.
    Becomes(PocketStatus),
    /// Fluid above the pressure over the mouth has an open path to the mouth.
    Releases,
}

/// Multiple of round-off within which two pressures are equal.
const ALIKE: f64 = 100.0;

impl PocketTrace {
    pub(super) fn new(problem: &FaceProblem, outside: OutsidePressure, release_excess: f64) -> Self {
        let m = problem.pockets().len();
        Self {
            outside,
            units: vec![FaceRate::default(); m],
            pressures: vec![[0.0; 2]; m],
            volumes: vec![[0.0; 2]; m],
            release_excess,
        }
    }

    fn rows<'e>(&'e self, problem: &'e FaceProblem) -> PocketRows<'e> {
        PocketRows {
            pockets: problem.pockets(),
            free: &problem.free_volumes,
            bulk: problem.bulk_modulus(),
            units: &self.units,
        }
    }

    /// Adds the contribution of the changing pressures to `rates` of jumps and contact forces,
    /// which contain that of the load. `faces` have the statuses of `now`.
    pub(super) fn press(
        &mut self,
        problem: &FaceProblem,
        faces: &mut FaceResponse<'_>,
        now: &FaceSolution,
        rates: &mut [FaceRate; 2],
        share: f64,
    ) -> Result<(), Degenerate> {
        let outside = &self.outside;
        faces.unit_rates(|k| may_press(&now.fluid[k], outside.drives(k)), &mut self.units)?;
        let rows = self.rows(problem);
        let states = &now.fluid;
        let bulk = problem.bulk_modulus();
        let [first, second] = &*rates;
        // Rate and second derivative of the volume under the load alone.
        let of_load = |k: usize| {
            let pocket = &problem.pockets()[k];
            let (one, two) = (pocket.volume(&first.jump), pocket.volume(&second.jump));
            (one + 2.0 * share * two, 2.0 * two)
        };
        let given = |k: usize| self.outside.of(k, share);
        let speeds = (0..states.len()).map(|k| match states[k].status {
            PocketStatus::Vented | PocketStatus::Leaking => given(k).rate(),
            PocketStatus::Cavity => 0.0,
            PocketStatus::Sealed => -of_load(k).0,
        });
        let speeds = rows.solve(states, speeds.collect())?;
        let bends = (0..states.len()).map(|k| match states[k].status {
            PocketStatus::Vented | PocketStatus::Leaking => given(k).bend(),
            PocketStatus::Cavity => 0.0,
            PocketStatus::Sealed => {
                let PocketState { pressure, content, .. } = states[k];
                let squeezed = content * super::pressure::compressed(pressure, bulk);
                squeezed * (speeds[k] / bulk).powi(2) - of_load(k).1
            }
        });
        let bends = rows.solve(states, bends.collect())?;
        let coefficients = speeds.iter().zip(&bends).map(|(speed, bend)| [speed - share * bend, 0.5 * bend]);
        let coefficients: Vec<[f64; 2]> = coefficients.collect();
        for (i, rate) in rates.iter_mut().enumerate() {
            let by: Vec<f64> = coefficients.iter().map(|pair| pair[i]).collect();
            rows.add(&by, &mut rate.jump, &mut rate.contact);
        }
        let volumes = problem.pockets().iter();
        self.volumes =
            volumes.map(|pocket| [pocket.volume(&rates[0].jump), pocket.volume(&rates[1].jump)]).collect();
        self.pressures = coefficients;
        Ok(())
    }

    /// Advances the pressures by `one` of τ and `two` of τ², as the jumps and contact forces in
    /// `now` have been already. The state of a compressible fluid is projected back onto its
    /// pressure–volume curve.
    pub(super) fn advance(
        &mut self,
        problem: &FaceProblem,
        now: &mut FaceSolution,
        share: f64,
        one: f64,
        two: f64,
    ) {
        for (state, [first, second]) in now.fluid.iter_mut().zip(&self.pressures) {
            state.pressure += one * first + two * second;
        }
        let sealed = |state: &PocketState| state.status == PocketStatus::Sealed;
        if problem.bulk_modulus().is_finite() && now.fluid.iter().any(sealed) {
            let outside = self.outside.at(share);
            let rows = self.rows(problem);
            if let Ok(change) = rows.solve(&now.fluid, rows.defects(&now.fluid, &outside, &now.jump)) {
                rows.add(&change, &mut now.jump, &mut now.contact);
                now.fluid.iter_mut().zip(&change).for_each(|(state, change)| state.pressure += change);
            }
        }
    }

    /// The first event of a pocket within `span` of the step from `share` on: share of the step
    /// until the event, pocket, and event.
    pub(super) fn next_event(
        &self,
        problem: &FaceProblem,
        now: &FaceSolution,
        scale: FaceScale,
        share: f64,
        mut span: f64,
    ) -> Option<(f64, usize, PocketEvent)> {
        let mut next = None;
        for k in 0..now.fluid.len() {
            if let Some((after, event)) = self.event_of(problem, now, scale, k, share, span) {
                span = after;
                next = Some((after, k, event));
            }
        }
        next
    }

    fn event_of(
        &self,
        problem: &FaceProblem,
        now: &FaceSolution,
        scale: FaceScale,
        k: usize,
        share: f64,
        span: f64,
    ) -> Option<(f64, PocketEvent)> {
        use PocketEvent::{Becomes, Releases};
        use PocketStatus::{Cavity, Leaking, Sealed, Vented};
        let pocket = &problem.pockets()[k];
        let PocketState { status, pressure, content } = now.fluid[k];
        if status == Vented || (status == Cavity && content == 0.0) {
            return None;
        }
        let (small_pressure, small_volume) = round_off(pocket, scale);
        let [first, second] = self.pressures[k];
        let inside = Parabola::of(pressure, first, second, share);
        let short_of = self.outside.of(k, share).plus(inside.times(-1.0));
        let volume = Parabola::of(pocket.volume(&now.jump), self.volumes[k][0], self.volumes[k][1], share);
        match status {
            Vented => None,
            Sealed => {
                let empties = inside.first_fall(small_pressure, span).map(|after| (after, Becomes(Cavity)));
                let span = empties.map_or(span, |(after, _)| after);
                if !problem.leaks() || !has_open_path(problem, now, k) {
                    return empties;
                }
                let leaks = if short_of.value() >= -ALIKE * small_pressure {
                    short_of.first_fall(small_pressure, span).map(|after| (after, Becomes(Leaking)))
                } else {
                    let quiet = short_of.plus(Parabola::constant(self.release_excess));
                    let exceeds = (quiet.value() < 0.0).then_some(0.0);
                    exceeds.or_else(|| quiet.first_fall(small_pressure, span)).map(|after| (after, Releases))
                };
                leaks.or(empties)
            }
            Cavity => {
                let missing = volume.plus(Parabola::constant(-content));
                missing.first_fall(small_volume, span).map(|after| (after, Becomes(Sealed)))
            }
            Leaking => {
                let bulk = problem.bulk_modulus();
                // Content over e^(p/B) now, to second order.
                let (rate, bend) = (inside.rate() / bulk, inside.bend() / bulk);
                let value = volume.value();
                let speed = volume.rate() + value * rate;
                let bend = volume.bend() + 2.0 * volume.rate() * rate + value * (bend + rate * rate);
                let less = Parabola::along(value, speed, bend).times(-1.0);
                less.rate_falls(small_volume, span).map(|after| (after, Becomes(Sealed)))
            }
        }
    }

    /// The state of pocket `k` after its change to `status`.
    pub(super) fn changed(
        problem: &FaceProblem,
        now: &FaceSolution,
        k: usize,
        status: PocketStatus,
    ) -> PocketState {
        let before = now.fluid[k];
        let leaves = before.status == PocketStatus::Leaking;
        let filled = if leaves { content(problem, now, k) } else { before.content };
        PocketState { status, content: filled, ..before }
    }

    /// The pockets that the change of face point `point` in `now` closes, and their events; a
    /// pocket without fluid loses its pressure.
    pub(super) fn closed_by(
        problem: &FaceProblem,
        now: &FaceSolution,
        scale: FaceScale,
        point: usize,
    ) -> Vec<(usize, PocketEvent)> {
        let closes = |&k: &usize| {
            now.fluid[k].status == PocketStatus::Leaking
                && problem.pockets()[k].points.binary_search(&point).is_ok()
                && !has_open_path(problem, now, k)
        };
        let what = |k: usize| match is_empty(problem, now, scale, k) {
            true => (k, PocketEvent::Releases),
            false => (k, PocketEvent::Becomes(PocketStatus::Sealed)),
        };
        (0..now.fluid.len()).filter(closes).map(what).collect()
    }

    /// Adds to the jumps `error`, due to an error of the load, the effect of the pressures.
    pub(super) fn add_error(&self, problem: &FaceProblem, now: &FaceSolution, error: &mut FaceRate) {
        let of = |(k, state): (usize, &PocketState)| match state.status {
            PocketStatus::Sealed => -problem.pockets()[k].volume(&error.jump),
            _ => 0.0,
        };
        let right: Vec<f64> = now.fluid.iter().enumerate().map(of).collect();
        let rows = self.rows(problem);
        if let Ok(pressures) = rows.solve(&now.fluid, right) {
            rows.add(&pressures, &mut error.jump, &mut error.contact);
        }
    }

    /// The scale of forces and jumps whose round-off is `round_off`.
    pub(super) fn scale_of(round_off: FaceScale) -> FaceScale {
        FaceScale { jump: round_off.jump / ROUND_OFF, force: round_off.force / ROUND_OFF }
    }
}

//! Passages of a wheel over a crack in space, until the history of K repeats.

use super::body::{FrontSif, SpaceBody};
use super::contact::{SpaceContact, SpaceContactError, SpaceFaces, StepReport};
use super::linearised::LaggedFactor;
use super::nuclei::Symmetric;
use crate::growth::{Observer, output_positions};
use crate::interruption::{Interrupted, Interruption};
use crate::load::{Bending, Passage};
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Stress (MPa) of the uncracked rail at x, lateral and depth (mm).
pub type StressAt<'a> = dyn Fn([f64; 3]) -> Symmetric + Sync + 'a;

/// Load of the rail with a crack: a wheel that passes and bends the rail, and a stress that stays.
pub struct SpaceLoad<'a> {
    /// Stress (MPa) of the uncracked rail with the wheel at an abscissa (mm), at x, lateral and
    /// depth (mm).
    pub wheel: &'a (dyn Fn(f64, [f64; 3]) -> Symmetric + Sync),
    /// Bending of the rail under the axles of the train, which moves with the wheel.
    pub bending: Option<&'a Bending>,
    /// The same without the wheel: residual, thermal.
    pub constant: Option<&'a StressAt<'a>>,
}

impl SpaceLoad<'_> {
    /// Nodal forces (N) of the constant stress.
    fn constant_forces(&self, body: &SpaceBody) -> Vec<f64> {
        self.constant.map_or_else(|| vec![0.0; 3 * body.points().len()], |stress| body.nodal_forces(stress))
    }

    /// Nodal forces (N) with the wheel at `position` (mm).
    fn forces(&self, body: &SpaceBody, constant: &[f64], position: f64) -> Vec<f64> {
        let stress = |point: [f64; 3]| {
            let mut stress = (self.wheel)(position, point);
            stress[0] += self.bending.map_or(0.0, |beam| beam.stress(point[0] - position, point[2]));
            stress
        };
        body.nodal_forces(stress).iter().zip(constant).map(|(f, c)| f + c).collect()
    }
}

/// How passages are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePassageSettings {
    /// Largest difference of K between one step and its two halves, MPa √mm.
    pub tolerance: f64,
    /// How often an interval between two positions may be halved; with none, each is one step.
    pub halvings: usize,
}

/// K along the front and the faces at all wheel positions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceHistory {
    /// Abscissae of the centre of the contact, mm.
    pub positions: Vec<f64>,
    /// K (MPa √mm): by position, then by front point.
    pub sifs: Vec<Vec<FrontSif>>,
    /// K under the constant stress alone, before the wheel comes.
    pub before: Vec<FrontSif>,
    /// The faces, by position.
    pub faces: Vec<SpaceFaces>,
    /// Load steps made, those of the step control included.
    pub steps: usize,
    /// Newton iterations of all steps.
    pub iterations: usize,
    /// The most iterations of a step.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions.
    pub violation: f64,
    /// Largest difference of K (MPa √mm) that was accepted between a step and its halves.
    pub step_error: f64,
}

impl SpaceHistory {
    /// The largest |K|, MPa √mm.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let sizes = |k: &FrontSif| k.ki.abs().max(k.kii.abs()).max(k.kiii.abs());
        self.sifs.iter().flatten().map(sizes).fold(0.0, f64::max)
    }

    /// The largest difference of K from another history at the same positions, MPa √mm.
    #[must_use]
    pub fn difference(&self, other: &Self) -> f64 {
        let pairs = self.sifs.iter().flatten().zip(other.sifs.iter().flatten());
        pairs.map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
    }
}

/// Passages of one wheel over one body. Nodal forces are never interpolated between positions: the
/// edge of the contact leaves them no derivative where it passes the mouth, and slip forgets
/// nothing that an interpolation overshoots.
pub struct SpacePassages<'a> {
    contact: &'a SpaceContact<'a>,
    load: &'a SpaceLoad<'a>,
    observer: &'a dyn Observer,
    constant: Vec<f64>,
    positions: Vec<f64>,
    /// Nodal forces by the bits of their position: the next passage needs them again.
    forces: RefCell<HashMap<u64, Rc<[f64]>>>,
}

/// An interval in which no point changes its state is one step, if the last one that was halved was
/// wrong by less than this share of what is allowed.
const CALM: f64 = 0.1;

impl<'a> SpacePassages<'a> {
    /// Of the wheel of `load` over the body of `contact`, with results at the positions of
    /// `passage`, and far away where the rail bends.
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
        let positions = output_positions(&passage, load.bending, &body.places());
        // Forces do not depend on the contact: those that every passage needs, all at once.
        let forces = positions
            .par_iter()
            .map(|&position| {
                interruption.check()?;
                Ok((position.to_bits(), load.forces(body, &constant, position)))
            })
            .collect::<Result<Vec<_>, Interrupted>>()?;
        let forces = forces.into_iter().map(|(at, forces)| (at, Rc::from(forces))).collect();
        Ok(Self { contact, load, observer, constant, positions, forces: RefCell::new(forces) })
    }

    /// A passage over the faces `faces`, which are left as after it: with the wheel away. Virgin
    /// faces take the constant stress first.
    ///
    /// Errors: a contact that does not converge; an interruption.
    pub fn pass(
        &self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        let body = self.contact.body;
        let positions = self.positions.clone();
        let history = SpaceHistory {
            sifs: Vec::with_capacity(positions.len()),
            before: Vec::new(),
            faces: Vec::with_capacity(positions.len()),
            positions,
            steps: 0,
            iterations: 0,
            iterations_max: 0,
            violation: 0.0,
            step_error: 0.0,
        };
        let factor = LaggedFactor::default();
        let mut walk = Walk { passages: self, settings, history, factor, is_calm: false };
        *faces = walk.step(&faces.jumps, faces, &self.constant)?;
        walk.history.before = body.sifs_of_jumps(&faces.jumps);
        let last = walk.history.positions.len() - 1;
        for k in 0..=last {
            let to = walk.history.positions[k];
            *faces = match k.checked_sub(1).map(|before| walk.history.positions[before]) {
                None => walk.step(&faces.jumps, faces, &self.forces_at(to))?,
                Some(from) => {
                    // Jumps go on as in the last interval.
                    let last = walk.history.faces.iter().rev().nth(1).unwrap_or(&*faces);
                    let guess: Vec<f64> =
                        faces.jumps.iter().zip(&last.jumps).map(|(new, old)| 2.0 * new - old).collect();
                    walk.interval(None, &guess, faces, [from, to], 0)?
                }
            };
            walk.history.sifs.push(body.sifs_of_jumps(&faces.jumps));
            walk.history.faces.push(faces.clone());
            self.observer.progress(k as f64 / last.max(1) as f64);
        }
        *faces = walk.step(&faces.jumps, faces, &self.constant)?;
        Ok(walk.history)
    }

    /// Nodal forces (N) with the wheel at `position` (mm).
    fn forces_at(&self, position: f64) -> Rc<[f64]> {
        let at = position.to_bits();
        if let Some(forces) = self.forces.borrow().get(&at) {
            return Rc::clone(forces);
        }
        let forces: Rc<[f64]> = self.load.forces(self.contact.body, &self.constant, position).into();
        self.forces.borrow_mut().insert(at, Rc::clone(&forces));
        forces
    }
}

/// A passage on its way.
struct Walk<'a> {
    passages: &'a SpacePassages<'a>,
    settings: &'a SpacePassageSettings,
    history: SpaceHistory,
    factor: LaggedFactor,
    /// Whether the last halved interval was wrong by little.
    is_calm: bool,
}

impl Walk<'_> {
    /// The faces under `forces` after `before`, whose jumps are near `guess`.
    fn step(
        &mut self,
        guess: &[f64],
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<SpaceFaces, SpaceContactError> {
        let SpacePassages { contact, observer, .. } = self.passages;
        if observer.interrupted() {
            return Err(Interrupted.into());
        }
        let (faces, report) = contact.step_from(guess, &mut self.factor, before, forces)?;
        let StepReport { iterations, violation } = report;
        let history = &mut self.history;
        history.steps += 1;
        history.iterations += iterations;
        history.iterations_max = history.iterations_max.max(iterations);
        history.violation = history.violation.max(violation);
        Ok(faces)
    }

    /// The faces at the end of an interval, near the jumps `guess`, by its halves; each is divided
    /// again until K at its end no longer depends on that. One step is enough where no point
    /// changes its state and the last halves were calm. `whole`: the faces at its end by one
    /// step, if they are known.
    fn interval(
        &mut self,
        whole: Option<SpaceFaces>,
        guess: &[f64],
        before: &SpaceFaces,
        [from, to]: [f64; 2],
        level: usize,
    ) -> Result<SpaceFaces, SpaceContactError> {
        let end = self.passages.forces_at(to);
        if self.settings.halvings == 0 {
            return self.step(guess, before, &end);
        }
        let body = self.passages.contact.body;
        let middle = 0.5 * (from + to);
        let is_last = level + 1 >= self.settings.halvings;
        let whole = match whole.map_or_else(|| self.step(guess, before, &end), Ok) {
            Err(SpaceContactError::NotConverged { .. }) => None,
            whole => Some(whole?),
        };
        let keeps_states = whole.as_ref().filter(|whole| whole.keeps_states_of(before));
        if let Some(whole) = keeps_states.filter(|_| self.is_calm && level == 0) {
            return Ok(whole.clone());
        }
        let between = self.passages.forces_at(middle);
        let jumps_at_end = whole.as_ref().map_or(&before.jumps, |whole| &whole.jumps);
        let jumps_between: Vec<f64> =
            before.jumps.iter().zip(jumps_at_end).map(|(start, end)| 0.5 * (start + end)).collect();
        let half = self.step(&jumps_between, before, &between);
        let halves = match &half {
            Ok(half) => self.step(jumps_at_end, half, &end),
            Err(error) => Err(error.clone()),
        };
        match (&whole, halves) {
            (_, Err(error @ SpaceContactError::NotConverged { .. })) if is_last => return Err(error),
            (_, Err(SpaceContactError::NotConverged { .. })) => self.is_calm = false,
            (_, Err(error)) => return Err(error),
            (whole, Ok(halves)) => {
                let error = whole.as_ref().map_or(f64::INFINITY, |whole| {
                    let (one, two) = (body.sifs_of_jumps(&whole.jumps), body.sifs_of_jumps(&halves.jumps));
                    one.iter().zip(&two).map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
                });
                if level == 0 {
                    self.is_calm = error <= CALM * self.settings.tolerance;
                }
                if error <= self.settings.tolerance || is_last {
                    if error.is_finite() {
                        self.history.step_error = self.history.step_error.max(error);
                    }
                    return Ok(halves);
                }
            }
        }
        let jumps_at_end = jumps_at_end.clone();
        let half = self.interval(half.ok(), &jumps_between, before, [from, middle], level + 1)?;
        self.interval(None, &jumps_at_end, &half, [middle, to], level + 1)
    }
}

/// The passage of the wheel over the faces `faces`, which are left as after it, with results at the
/// positions of `passage`, and far away where the rail bends.
///
/// Errors: a contact that does not converge.
pub fn space_passage(
    contact: &SpaceContact,
    load: &SpaceLoad,
    passage: Passage,
    settings: &SpacePassageSettings,
    faces: &mut SpaceFaces,
) -> Result<SpaceHistory, SpaceContactError> {
    SpacePassages::new(contact, load, passage, &crate::growth::Unobserved)?.pass(settings, faces)
}

//! Passages of a wheel over a crack in space, until the history of K repeats.

use super::body::{FrontSif, SpaceBody};
use super::contact::{SpaceContact, SpaceContactError, SpaceFaces, StepReport};
use super::nuclei::Symmetric;
use crate::growth::Observer;
use crate::interruption::{Interrupted, Interruption};
use crate::load::Passage;
use rayon::prelude::*;

/// Stress (MPa) of the uncracked rail at x, lateral and depth (mm).
pub type StressAt<'a> = dyn Fn([f64; 3]) -> Symmetric + Sync + 'a;

/// Load of the rail with a crack: a wheel that passes, and a stress that stays.
pub struct SpaceLoad<'a> {
    /// Stress (MPa) of the uncracked rail with the wheel at an abscissa (mm), at x, lateral and
    /// depth (mm).
    pub wheel: &'a (dyn Fn(f64, [f64; 3]) -> Symmetric + Sync),
    /// The same without the wheel: residual, thermal.
    pub constant: Option<&'a StressAt<'a>>,
    /// Largest distance (mm) of the wheel positions between which nodal forces are interpolated; a
    /// tenth of the half-width keeps K to 1e-3 of its peak.
    pub station: f64,
}

impl SpaceLoad<'_> {
    /// Nodal forces (N) of the constant stress.
    fn constant_forces(&self, body: &SpaceBody) -> Vec<f64> {
        self.constant.map_or_else(|| vec![0.0; 3 * body.points().len()], |stress| body.nodal_forces(stress))
    }

    /// Nodal forces (N) with the wheel at `position` (mm).
    fn forces(&self, body: &SpaceBody, constant: &[f64], position: f64) -> Vec<f64> {
        let stress = |point: [f64; 3]| (self.wheel)(position, point);
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

/// Passages of one wheel over one body: nodal forces are computed at stations along the way and
/// interpolated between them.
pub struct SpacePassages<'a> {
    contact: &'a SpaceContact<'a>,
    observer: &'a dyn Observer,
    constant: Vec<f64>,
    passage: Passage,
    /// Intervals between stations, a multiple of those between output positions.
    intervals: usize,
    /// Nodal forces at the stations.
    stations: Vec<Vec<f64>>,
}

/// Stations of one interpolation.
const STENCIL: usize = 6;
/// A position this close to a station, in their distance, lies on it.
const ON_STATION: f64 = 1e-9;

impl<'a> SpacePassages<'a> {
    /// Of the wheel of `load` over the body of `contact`, with results at the positions of
    /// `passage`.
    ///
    /// Errors: an interruption.
    pub fn new(
        contact: &'a SpaceContact<'a>,
        load: &SpaceLoad,
        passage: Passage,
        observer: &'a dyn Observer,
    ) -> Result<Self, Interrupted> {
        let body = contact.body;
        let constant = load.constant_forces(body);
        let outputs = passage.positions.saturating_sub(1).max(1);
        let spacing = (passage.to - passage.from).abs() / outputs as f64;
        let each = (spacing / load.station).ceil().max(1.0) as usize;
        let intervals = (outputs * each).max(STENCIL);
        let asked = || observer.interrupted();
        let interruption = Interruption::when(&asked);
        // Forces do not depend on the contact: all at once.
        let stations = (0..=intervals)
            .into_par_iter()
            .map(|k| {
                interruption.check()?;
                let share = k as f64 / intervals as f64;
                Ok(load.forces(body, &constant, passage.from + share * (passage.to - passage.from)))
            })
            .collect::<Result<_, Interrupted>>()?;
        Ok(Self { contact, observer, constant, passage, intervals, stations })
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
        let positions = self.passage.abscissae();
        let mut history = SpaceHistory {
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
        let constant = self.constant.clone();
        *faces = self.step(&mut history, faces, &constant)?;
        history.before = body.sifs_of_jumps(&faces.jumps);
        let last = history.positions.len() - 1;
        for k in 0..=last {
            let to = history.positions[k];
            *faces = match k.checked_sub(1).map(|before| history.positions[before]) {
                None => {
                    let forces = self.forces_at(to);
                    self.step(&mut history, faces, &forces)?
                }
                Some(from) => self.interval(&mut history, settings, faces, [from, to], 0)?,
            };
            history.sifs.push(body.sifs_of_jumps(&faces.jumps));
            history.faces.push(faces.clone());
            self.observer.progress(k as f64 / last.max(1) as f64);
        }
        *faces = self.step(&mut history, faces, &constant)?;
        Ok(history)
    }

    /// Nodal forces (N) with the wheel at `position` (mm).
    fn forces_at(&self, position: f64) -> Vec<f64> {
        let Passage { from, to, .. } = self.passage;
        let place = (position - from) / (to - from) * self.intervals as f64;
        let nearest = place.round().clamp(0.0, self.intervals as f64) as usize;
        if (place - nearest as f64).abs() < ON_STATION {
            return self.stations[nearest].clone();
        }
        // Lagrange's polynomial through the stations around it.
        let first =
            (place.floor() as usize).saturating_sub(STENCIL / 2 - 1).min(self.intervals + 1 - STENCIL);
        let weight = |k: usize| {
            let others = (first..first + STENCIL).filter(|&other| other != k);
            others.map(|other| (place - other as f64) / (k as f64 - other as f64)).product::<f64>()
        };
        let mut forces = vec![0.0; self.constant.len()];
        for k in first..first + STENCIL {
            crate::math::axpy(weight(k), &self.stations[k], &mut forces);
        }
        forces
    }

    fn step(
        &self,
        history: &mut SpaceHistory,
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<SpaceFaces, SpaceContactError> {
        if self.observer.interrupted() {
            return Err(Interrupted.into());
        }
        let (faces, StepReport { iterations, violation }) = self.contact.step(before, forces)?;
        history.steps += 1;
        history.iterations += iterations;
        history.iterations_max = history.iterations_max.max(iterations);
        history.violation = history.violation.max(violation);
        Ok(faces)
    }

    /// The faces at the end of an interval, by its halves; each is divided again until K at its end
    /// no longer depends on that.
    fn interval(
        &self,
        history: &mut SpaceHistory,
        settings: &SpacePassageSettings,
        before: &SpaceFaces,
        [from, to]: [f64; 2],
        level: usize,
    ) -> Result<SpaceFaces, SpaceContactError> {
        let end = self.forces_at(to);
        if settings.halvings == 0 {
            return self.step(history, before, &end);
        }
        let body = self.contact.body;
        let middle = 0.5 * (from + to);
        let between = self.forces_at(middle);
        let is_last = level + 1 >= settings.halvings;
        let whole = match self.step(history, before, &end) {
            Err(SpaceContactError::NotConverged { .. }) => None,
            whole => Some(whole?),
        };
        let halves = match self.step(history, before, &between) {
            Ok(half) => self.step(history, &half, &end),
            Err(error) => Err(error),
        };
        match (whole, halves) {
            (_, Err(error @ SpaceContactError::NotConverged { .. })) if is_last => return Err(error),
            (_, Err(SpaceContactError::NotConverged { .. })) => {}
            (_, Err(error)) => return Err(error),
            (whole, Ok(halves)) => {
                let error = whole.map_or(f64::INFINITY, |whole| {
                    let (one, two) = (body.sifs_of_jumps(&whole.jumps), body.sifs_of_jumps(&halves.jumps));
                    one.iter().zip(&two).map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
                });
                if error <= settings.tolerance || is_last {
                    if error.is_finite() {
                        history.step_error = history.step_error.max(error);
                    }
                    return Ok(halves);
                }
            }
        }
        let half = self.interval(history, settings, before, [from, middle], level + 1)?;
        self.interval(history, settings, &half, [middle, to], level + 1)
    }
}

/// The passage of the wheel over the faces `faces`, which are left as after it, with results at the
/// positions of `passage`.
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

//! Passage of a wheel over a crack in space.

use super::body::{FrontSif, SpaceBody};
use super::contact::{SpaceContact, SpaceContactError, SpaceFaces, StepReport};
use super::nuclei::Symmetric;
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

/// How a passage is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePassageSettings {
    /// Wheel positions with results.
    pub passage: Passage,
    /// Largest difference of K between one step and its two halves, MPa √mm.
    pub tolerance: f64,
    /// How often an interval between two positions may be halved.
    pub halvings: usize,
}

/// K along the front at all wheel positions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceHistory {
    /// Abscissae of the centre of the contact, mm.
    pub positions: Vec<f64>,
    /// K (MPa √mm): by position, then by front point.
    pub sifs: Vec<Vec<FrontSif>>,
    /// Load steps made, those of the step control included.
    pub steps: usize,
    /// Newton iterations of all steps.
    pub iterations: usize,
    /// Largest violation of the contact conditions.
    pub violation: f64,
    /// Largest difference of K (MPa √mm) that was accepted between a step and its halves.
    pub step_error: f64,
}

/// The passage of the wheel over the faces `faces`, which are left as after it. Virgin faces take
/// the constant stress first.
///
/// Errors: a contact that does not converge.
pub fn space_passage(
    contact: &SpaceContact,
    load: &SpaceLoad,
    settings: &SpacePassageSettings,
    faces: &mut SpaceFaces,
) -> Result<SpaceHistory, SpaceContactError> {
    let body = contact.body;
    let constant = load.constant_forces(body);
    let positions = settings.passage.abscissae();
    // Forces do not depend on the contact: all at once.
    let forces: Vec<Vec<f64>> = positions.par_iter().map(|&x| load.forces(body, &constant, x)).collect();
    let mut run = Run {
        contact,
        load,
        constant: &constant,
        settings,
        history: SpaceHistory {
            sifs: Vec::with_capacity(positions.len()),
            positions,
            steps: 0,
            iterations: 0,
            violation: 0.0,
            step_error: 0.0,
        },
    };
    *faces = run.step(faces, &constant)?;
    *faces = run.step(faces, &forces[0])?;
    run.history.sifs.push(body.sifs_of_jumps(&faces.jumps));
    for k in 1..forces.len() {
        let ends = [run.history.positions[k - 1], run.history.positions[k]];
        *faces = run.interval(faces, ends, &forces[k], 0)?;
        run.history.sifs.push(body.sifs_of_jumps(&faces.jumps));
    }
    Ok(run.history)
}

struct Run<'a> {
    contact: &'a SpaceContact<'a>,
    load: &'a SpaceLoad<'a>,
    constant: &'a [f64],
    settings: &'a SpacePassageSettings,
    history: SpaceHistory,
}

impl Run<'_> {
    fn step(&mut self, before: &SpaceFaces, forces: &[f64]) -> Result<SpaceFaces, SpaceContactError> {
        let (faces, StepReport { iterations, violation }) = self.contact.step(before, forces)?;
        self.history.steps += 1;
        self.history.iterations += iterations;
        self.history.violation = self.history.violation.max(violation);
        Ok(faces)
    }

    /// The faces at the end of an interval, by its halves; each is divided again until K at its end
    /// no longer depends on that.
    fn interval(
        &mut self,
        before: &SpaceFaces,
        [from, to]: [f64; 2],
        forces: &[f64],
        level: usize,
    ) -> Result<SpaceFaces, SpaceContactError> {
        let body = self.contact.body;
        let middle = 0.5 * (from + to);
        let between = self.load.forces(body, self.constant, middle);
        let whole = self.step(before, forces);
        let half = self.step(before, &between)?;
        let halves = self.step(&half, forces)?;
        let error = whole.map_or(f64::INFINITY, |whole| {
            let (one, two) = (body.sifs_of_jumps(&whole.jumps), body.sifs_of_jumps(&halves.jumps));
            let gap = |(a, b): (&FrontSif, &FrontSif)| {
                (a.ki - b.ki).abs().max((a.kii - b.kii).abs()).max((a.kiii - b.kiii).abs())
            };
            one.iter().zip(&two).map(gap).fold(0.0, f64::max)
        });
        if error <= self.settings.tolerance || level >= self.settings.halvings {
            self.history.step_error = self.history.step_error.max(error);
            return Ok(halves);
        }
        let half = self.interval(before, [from, middle], &between, level + 1)?;
        self.interval(&half, [middle, to], forces, level + 1)
    }
}

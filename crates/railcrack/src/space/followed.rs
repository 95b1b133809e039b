//! Faces followed from position to position of a passing wheel.

use super::body::SpaceBody;
use super::contact::{ContactStep, Guess, SpaceContactError, StepReport};
use super::fluid::{FluidOnFaces, FluidUnderWheel, SpacePocket};
use super::linearised::{FaceProblem, LaggedFactor};
use super::mirror::MirroredHalf;
use super::slip_origin::{LONGEST, WheelInstant, slip_origin};
use super::states::{SpaceFaces, SpaceHistory, SpacePassageSettings};
use super::trapped::PocketsOfStep;
use crate::contact::PocketState;
use crate::growth::Observer;
use crate::interruption::Interrupted;
use std::rc::Rc;

/// One half of symmetric faces, with its fluid.
pub(super) type HalfWithFluid = (MirroredHalf, Vec<SpacePocket>);

/// Faces with the loads of a passage.
#[derive(Clone, Copy)]
pub(super) struct FollowedFaces<'a> {
    pub body: &'a SpaceBody,
    /// The friction coefficient of each point.
    pub friction: &'a [f64],
    pub fluid: Option<&'a FluidUnderWheel<'a>>,
    /// One half of the faces, where body and load are symmetric.
    pub half: Option<&'a HalfWithFluid>,
    /// Positions (mm) of the results.
    pub positions: &'a [f64],
    /// Nodal forces (N) without the wheel, before and after the passage.
    pub unloaded: [&'a [f64]; 2],
    /// Nodal forces (N) with the wheel at a position (mm).
    pub forces: &'a dyn Fn(f64) -> Rc<[f64]>,
    pub observer: &'a dyn Observer,
}

/// Two steps in which no point changes its state are not compared with one step of twice the length
/// if the last comparison differed by less than this share of the tolerance.
const CALM: f64 = 0.1;
/// Steps of twice the length are tried after a comparison that differed by less than this share of
/// the tolerance, since the local error grows as the cube of the step.
const COARSER: f64 = 0.125;

impl FollowedFaces<'_> {
    /// A passage over the faces `faces`, which are updated to their state after it, without the
    /// wheel. Virgin faces are loaded by the constant forces first. `visit` receives the faces
    /// without the wheel before the passage, then those at each accepted position.
    ///
    /// Errors: contact that does not converge; an interruption.
    pub fn pass(
        &self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
        visit: &mut dyn FnMut(&WheelInstant),
    ) -> Result<SpaceHistory, SpaceContactError> {
        let body = self.body;
        let positions = self.positions.len();
        let history = SpaceHistory {
            sifs: Vec::with_capacity(positions),
            before: Vec::new(),
            faces: Vec::with_capacity(positions),
            fluid: Vec::new(),
            positions: self.positions.to_vec(),
            steps: 0,
            iterations: 0,
            iterations_max: 0,
            violation: 0.0,
            step_error: 0.0,
        };
        let mut passage = PassageInProgress {
            of: *self,
            visit,
            settings,
            history,
            half: self.half.filter(|(half, _)| half.points.is_symmetric(&faces.jumps)),
            factor: LaggedFactor::default(),
            earlier: None,
            last: Rc::new(WheelInstant { position: f64::NAN, faces: faces.clone(), resisted: None }),
            is_calm: false,
            level: 0,
        };
        let [before, after] = self.unloaded;
        let last = Rc::clone(&passage.last);
        let before = passage.step(&last.guess(), &faces.jumps, (before, &last, f64::NAN))?;
        passage.history.before = body.sifs_of_jumps(&before.faces.jumps);
        let (first, last) = (passage.history.positions[0], passage.history.positions[positions - 1]);
        (passage.visit)(&before);
        let load = (&*(self.forces)(first), &before, first);
        let instant = passage.step(&before.guess(), &before.faces.jumps, load)?;
        passage.accept(Rc::new(instant));
        while passage.history.sifs.len() < positions {
            let done = passage.history.sifs.len();
            match passage.history.positions.get(done + 1) {
                _ if settings.halvings == 0 => passage.one_step(passage.history.positions[done])?,
                // Two intervals at a time; a remaining last one alone.
                Some(&to) => passage.interval(None, to, 0)?,
                None => passage.interval(None, last, 1)?,
            }
            self.observer.progress(passage.history.sifs.len() as f64 / positions as f64);
        }
        let last = Rc::clone(&passage.last);
        *faces = passage.step(&last.guess(), &last.faces.jumps, (after, &last, f64::NAN))?.faces;
        Ok(passage.history)
    }
}

/// A passage that is being computed.
struct PassageInProgress<'a> {
    of: FollowedFaces<'a>,
    visit: &'a mut dyn FnMut(&WheelInstant),
    settings: &'a SpacePassageSettings,
    history: SpaceHistory,
    /// The half of the faces that is solved for; none where they are solved for as a whole.
    half: Option<&'a HalfWithFluid>,
    factor: LaggedFactor,
    /// The instant before the last one, if the wheel was already present.
    earlier: Option<Rc<WheelInstant>>,
    last: Rc<WheelInstant>,
    /// Whether the last comparison of two steps with one of twice the length differed only
    /// slightly.
    is_calm: bool,
    /// The level of division with which intervals begin.
    level: usize,
}

impl PassageInProgress<'_> {
    /// The instant under `forces` with the wheel at the position `to` (not a number without it),
    /// after the instant `last`, with slip measured from the jumps `origin`.
    fn step(
        &mut self,
        guess: &Guess,
        origin: &[f64],
        (forces, last, to): (&[f64], &WheelInstant, f64),
    ) -> Result<WheelInstant, SpaceContactError> {
        let FollowedFaces { observer, fluid, .. } = self.of;
        if observer.interrupted() {
            return Err(Interrupted.into());
        }
        let begin = |fluid: &FluidUnderWheel<'_>| {
            let over = |position: f64, at: [f64; 2]| {
                if position.is_nan() { 0.0 } else { (fluid.over)(position, at) }
            };
            fluid.faces.begin((last.position, &last.faces), to, &over)
        };
        let mut states = fluid.map_or_else(Vec::new, begin);
        let mut solved = self.solved(guess, origin, forces, &states)?;
        if let Some(FluidUnderWheel { faces: fluid, over }) = fluid {
            if let Some(released) = fluid.released(to, over, &solved.faces, &states) {
                states = released;
                solved = self.solved(guess, origin, forces, &states)?;
            }
            if let Some(sealed) = fluid.refused(&states, &solved.faces) {
                states = sealed;
                solved = self.solved(guess, origin, forces, &states)?;
            }
            fluid.follow(&mut solved.faces);
        }
        let ContactStep { faces, report: StepReport { iterations, violation }, resisted } = solved;
        let history = &mut self.history;
        history.steps += 1;
        history.iterations += iterations;
        history.iterations_max = history.iterations_max.max(iterations);
        history.violation = history.violation.max(violation);
        Ok(WheelInstant { position: to, faces, resisted: Some(resisted) })
    }

    /// The step with the fluid of `states` at its beginning.
    fn solved(
        &mut self,
        guess: &Guess,
        origin: &[f64],
        forces: &[f64],
        states: &[PocketState],
    ) -> Result<ContactStep, SpaceContactError> {
        let FollowedFaces { body, friction, fluid, .. } = self.of;
        let fluid = fluid.map(|fluid| &fluid.faces);
        let trapped = fluid.filter(|fluid| fluid.is_trapped());
        let bulk_modulus = fluid.map_or(f64::INFINITY, FluidOnFaces::bulk_modulus);
        if let Some((half, pockets)) = self.half {
            let pockets = trapped.map_or(&[][..], |_| pockets);
            let pockets = PocketsOfStep { pockets, states, bulk_modulus };
            let guess = Guess { jumps: half.jumps(&guess.jumps), resisted: guess.resisted.clone() };
            let load = (&half.forces(forces)[..], pockets);
            let step = half.problem().step_from(&guess, &mut self.factor, &half.jumps(origin), load)?;
            return Ok(ContactStep { faces: half.whole(step.faces), ..step });
        }
        let pockets = trapped.map_or(&[][..], |fluid| &fluid.pockets);
        let pockets = PocketsOfStep { pockets, states, bulk_modulus };
        let problem = FaceProblem { stiffness: body.stiffness(), compliance: body.compliance(), friction };
        problem.step_from(guess, &mut self.factor, origin, (forces, pockets))
    }

    /// The instant with the wheel at the position `to`, after the instants `earlier` and `last`.
    fn instant(
        &mut self,
        guess: Option<Guess>,
        earlier: Option<&WheelInstant>,
        last: &WheelInstant,
        to: f64,
    ) -> Result<Rc<WheelInstant>, SpaceContactError> {
        let forces = (self.of.forces)(to);
        let origin = slip_origin(earlier, last, to);
        let guess = guess.unwrap_or_else(|| extrapolated(earlier, last, to));
        Ok(Rc::new(self.step(&guess, &origin, (&forces, last, to))?))
    }

    /// Advances to the position `to` in one step.
    fn one_step(&mut self, to: f64) -> Result<(), SpaceContactError> {
        let instant = self.instant(None, self.earlier.clone().as_deref(), &Rc::clone(&self.last), to)?;
        self.accept(instant);
        Ok(())
    }

    /// Accepts an instant, from which the next step begins.
    fn accept(&mut self, instant: Rc<WheelInstant>) {
        let history = &mut self.history;
        if history.positions.get(history.sifs.len()) == Some(&instant.position) {
            history.sifs.push(self.of.body.sifs_of_jumps(&instant.faces.jumps));
            history.faces.push(instant.faces.clone());
            if let Some(FluidUnderWheel { faces, over }) = self.of.fluid {
                let cracks = 0..self.of.body.cracks().len();
                let of = |crack| faces.state_of(crack, instant.position, *over, &instant.faces);
                history.fluid.push(cracks.map(of).collect());
            }
        }
        (self.visit)(&instant);
        let before = std::mem::replace(&mut self.last, instant);
        self.earlier = (!before.position.is_nan()).then_some(before);
    }

    /// Advances to the position `to` in two steps. Each is divided again until K at the end agrees
    /// with that of one step of twice the length, which is `whole` if it is known. At level 0 the
    /// steps are two intervals between positions; they are not compared if no point changes its
    /// state and the last comparison was calm.
    fn interval(
        &mut self,
        whole: Option<Rc<WheelInstant>>,
        to: f64,
        level: usize,
    ) -> Result<(), SpaceContactError> {
        let (earlier, last) = (self.earlier.clone(), Rc::clone(&self.last));
        let between = match level {
            0 => self.history.positions[self.history.sifs.len()],
            _ => 0.5 * (last.position + to),
        };
        let is_last = level + 1 >= self.settings.halvings;
        if whole.is_none() && level < self.level && !is_last {
            self.interval(None, between, level + 1)?;
            return self.interval(None, to, level + 1);
        }
        // Midway between the two.
        let guess = whole.as_ref().map(|whole| last.towards(whole, 0.5));
        let one = self.instant(guess, earlier.as_deref(), &last, between);
        let guess = whole.as_ref().map(|whole| whole.guess());
        let two = match &one {
            Ok(one) => self.instant(guess, Some(&last), one, to),
            Err(error) => Err(error.clone()),
        };
        match (one, two) {
            (Ok(one), Ok(two)) => {
                let keeps = one.faces.keeps_states_of(&last.faces) && two.faces.keeps_states_of(&one.faces);
                let error = if level == 0 && self.is_calm && keeps {
                    0.0
                } else {
                    let whole = match whole {
                        Some(whole) => Ok(whole),
                        None => self.instant(Some(two.guess()), earlier.as_deref(), &last, to),
                    };
                    self.compared(whole, &two, level)?
                };
                if error <= self.settings.tolerance || is_last {
                    if error.is_finite() {
                        self.history.step_error = self.history.step_error.max(error);
                    }
                    self.accept(one);
                    self.accept(two);
                    return Ok(());
                }
                self.level = level + 1;
                self.interval(Some(one), between, level + 1)?;
            }
            (Err(error @ SpaceContactError::NotConverged { .. }), _)
            | (_, Err(error @ SpaceContactError::NotConverged { .. }))
                if is_last =>
            {
                return Err(error);
            }
            (Ok(one), Err(SpaceContactError::NotConverged { .. })) => {
                self.interval(Some(one), between, level + 1)?
            }
            (Err(SpaceContactError::NotConverged { .. }), _) => self.interval(None, between, level + 1)?,
            (_, Err(error)) | (Err(error), _) => return Err(error),
        }
        self.interval(None, to, level + 1)
    }

    /// The difference of K (MPa √mm) at the end of one step, `whole`, from that of two, and what
    /// follows for the next steps; infinite where the one step does not converge.
    fn compared(
        &mut self,
        whole: Result<Rc<WheelInstant>, SpaceContactError>,
        two: &WheelInstant,
        level: usize,
    ) -> Result<f64, SpaceContactError> {
        let error = match whole {
            Ok(whole) => self.difference(&whole, two),
            Err(SpaceContactError::NotConverged { .. }) => f64::INFINITY,
            Err(error) => return Err(error),
        };
        self.is_calm = error <= CALM * self.settings.tolerance;
        if error <= COARSER * self.settings.tolerance {
            self.level = level.saturating_sub(1);
        }
        Ok(error)
    }

    /// The largest difference of K at two instants, MPa √mm.
    fn difference(&self, one: &WheelInstant, other: &WheelInstant) -> f64 {
        let body = self.of.body;
        let sifs = |instant: &WheelInstant| body.sifs_of_jumps(&instant.faces.jumps);
        sifs(one).iter().zip(&sifs(other)).map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
    }
}

/// The state of the faces extrapolated to the position `to`.
fn extrapolated(earlier: Option<&WheelInstant>, last: &WheelInstant, to: f64) -> Guess {
    let Some(earlier) = earlier else { return last.guess() };
    let ratio = ((to - last.position) / (last.position - earlier.position)).min(LONGEST);
    last.towards(earlier, -ratio)
}

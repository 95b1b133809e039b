//! Passages of a wheel over a crack in space, until the history of K repeats.

use super::body::{FrontSif, SpaceBody};
use super::contact::{SpaceContact, SpaceContactError, StepReport};
use super::fluid::{ContactPressure, FluidOnFaces, SpaceFluid, SpacePocket};
use super::linearised::LaggedFactor;
use super::mirror::{MirroredHalf, agree, mirrored_stresses};
use super::nuclei::Symmetric;
use super::slip_origin::{LONGEST, WheelInstant, slip_origin};
use super::states::SpaceFaces;
use super::trapped::PocketsOfStep;
use crate::contact::{FluidState, PocketState};
use crate::growth::{Observer, output_positions};
use crate::interruption::{Interrupted, Interruption};
use crate::load::{Bending, Passage};
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Stress (MPa) of the uncracked rail at x, lateral and depth (mm).
pub(super) type StressAt<'a> = dyn Fn([f64; 3]) -> Symmetric + Sync + 'a;

/// Load of the rail with cracks: a passing wheel that may bend the rail, and a constant stress.
pub struct SpaceLoad<'a> {
    /// Stress (MPa) of the uncracked rail with the wheel at an abscissa (mm), at x, lateral and
    /// depth (mm).
    pub wheel: &'a (dyn Fn(f64, [f64; 3]) -> Symmetric + Sync),
    /// Bending of the rail under the axles of the train, which moves with the wheel.
    pub bending: Option<&'a Bending>,
    /// Constant stress without the wheel, residual and thermal.
    pub constant: Option<&'a StressAt<'a>>,
    /// Fluid in the cracks.
    pub fluid: Option<SpaceFluidLoad<'a>>,
}

/// Fluid in cracks under a wheel.
#[derive(Clone, Copy)]
pub struct SpaceFluidLoad<'a> {
    /// The fluid.
    pub fluid: &'a SpaceFluid,
    /// Pressure of the contact (MPa) with the wheel at an abscissa (mm), at x and lateral position
    /// (mm); zero outside of the contact.
    pub over: &'a (dyn Fn(f64, [f64; 2]) -> f64 + Sync),
}

impl SpaceLoad<'_> {
    /// Nodal forces (N) due to the constant stress.
    fn constant_forces(&self, body: &SpaceBody) -> Vec<f64> {
        self.constant.map_or_else(|| vec![0.0; 3 * body.points().len()], |stress| body.nodal_forces(stress))
    }

    /// Whether the load is symmetric about the plane of symmetry of `half` with the wheel at each
    /// of `positions` (mm), by the stress at some points. The constant stress is not considered.
    fn is_mirrored(&self, body: &SpaceBody, half: &MirroredHalf, positions: &[f64]) -> bool {
        let probes = half.probes(body);
        let values = |&position: &f64| {
            let of = |&point: &[f64; 3]| {
                let image = half.image(point);
                let [one, other] = [point, image].map(|at| (self.wheel)(position, at));
                let pressures =
                    self.fluid.map(|fluid| [point, image].map(|at| (fluid.over)(position, [at[0], at[1]])));
                mirrored_stresses(&one, &other).into_iter().chain(pressures)
            };
            probes.iter().flat_map(of).collect::<Vec<_>>()
        };
        let all: Vec<Vec<[f64; 2]>> = positions.par_iter().map(values).collect();
        agree(&all.concat())
    }

    /// Nodal forces (N) with the wheel at `position` (mm), those of `fluid` from the mouth
    /// included; where body and load are symmetric, from the stress on one half of the faces.
    fn forces(
        &self,
        body: &SpaceBody,
        (fluid, half): (Option<&FluidUnderWheel<'_>>, Option<&MirroredHalf>),
        constant: &[f64],
        position: f64,
    ) -> Vec<f64> {
        let stress = |crack: usize, point: [f64; 3]| {
            let mut stress = (self.wheel)(position, point);
            stress[0] += self.bending.map_or(0.0, |beam| beam.stress(point[0] - position, point[2]));
            // Tension across the faces opens them like a pressure in the crack.
            if let Some(FluidUnderWheel { faces, over }) = fluid {
                let pressure = faces.mouth_pressure(body, crack, (position, *over), point);
                stress[..3].iter_mut().for_each(|normal| *normal += pressure);
            }
            stress
        };
        let forces = match half {
            Some(half) => half.with_mirrored_forces(
                body.nodal_forces_where(|[_, lateral, _]| lateral > half.middle, stress),
            ),
            None => body.nodal_forces_by_crack(stress),
        };
        forces.iter().zip(constant).map(|(f, c)| f + c).collect()
    }
}

/// Settings of the load steps of passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePassageSettings {
    /// Largest difference of K between two steps and one of twice the length, MPa √mm.
    pub tolerance: f64,
    /// How often two intervals between positions may be halved, the first time into one step each;
    /// with 0, each interval is one step and nothing is compared.
    pub halvings: usize,
}

/// K along the front and the faces at all wheel positions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceHistory {
    /// Abscissae of the centre of the contact, mm.
    pub positions: Vec<f64>,
    /// K (MPa √mm): by position, then by front point.
    pub sifs: Vec<Vec<FrontSif>>,
    /// K under the constant stress alone, before the wheel arrives.
    pub before: Vec<FrontSif>,
    /// The faces, by position.
    pub faces: Vec<SpaceFaces>,
    /// The fluid in each crack, by position; empty without fluid.
    pub fluid: Vec<Vec<FluidState>>,
    /// Number of load steps, including those of the step control.
    pub steps: usize,
    /// Newton iterations of all steps.
    pub iterations: usize,
    /// Largest number of iterations of a step.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions.
    pub violation: f64,
    /// Largest difference of K (MPa √mm) that was accepted between two steps and one of twice the
    /// length.
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

/// The fluid on the faces of a body, and the pressure of the wheel over their mouths.
struct FluidUnderWheel<'a> {
    faces: FluidOnFaces,
    over: &'a ContactPressure<'a>,
}

/// Passages of one wheel over one body. Nodal forces are never interpolated between positions: they
/// are not differentiable where the edge of the contact passes the mouth, and an overshoot of the
/// interpolation would leave permanent slip.
pub struct SpacePassages<'a> {
    contact: &'a SpaceContact<'a>,
    load: &'a SpaceLoad<'a>,
    observer: &'a dyn Observer,
    constant: Vec<f64>,
    fluid: Option<FluidUnderWheel<'a>>,
    /// The friction coefficient of each point.
    friction: Vec<f64>,
    /// One half of the faces with its fluid, where body and load are symmetric.
    half: Option<(MirroredHalf, Vec<SpacePocket>)>,
    positions: Vec<f64>,
    /// Nodal forces by the bits of their position, kept for the next passage.
    forces: RefCell<HashMap<u64, Rc<[f64]>>>,
}

/// Two steps in which no point changes its state are not compared with one step of twice the length
/// if the last comparison differed by less than this share of the tolerance.
const CALM: f64 = 0.1;
/// Steps of twice the length are tried after a comparison that differed by less than this share of
/// the tolerance, since the local error grows as the cube of the step.
const COARSER: f64 = 0.125;

impl<'a> SpacePassages<'a> {
    /// Passages of the wheel of `load` over the body of `contact`, with results at the positions of
    /// `passage` and, where the rail bends, at distant positions.
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
        let mut positions = output_positions(&passage, load.bending, &body.places());
        let fluid = load.fluid.map(|load| FluidUnderWheel { faces: load.fluid.on(body), over: load.over });
        if let Some(FluidUnderWheel { faces, over }) = &fluid {
            let runs_back = positions.last() < positions.first();
            positions.extend(faces.stations(&positions, *over));
            positions.sort_by(f64::total_cmp);
            positions.dedup();
            if runs_back {
                positions.reverse();
            }
        }
        let friction = contact.friction_of_points();
        let pockets = fluid.as_ref().map_or(&[][..], |fluid| &fluid.faces.pockets);
        let is_symmetric = |half: &MirroredHalf| {
            half.is_symmetric(&constant)
                && pockets.iter().all(|pocket| half.is_symmetric(&pocket.unit))
                && load.is_mirrored(body, half, &positions)
        };
        let half = MirroredHalf::of(body, &friction).filter(is_symmetric);
        // Forces do not depend on the contact: those needed in every passage are computed at once.
        let forces = positions
            .par_iter()
            .map(|&position| {
                interruption.check()?;
                let parts = (fluid.as_ref(), half.as_ref());
                Ok((position.to_bits(), load.forces(body, parts, &constant, position)))
            })
            .collect::<Result<Vec<_>, Interrupted>>()?;
        let forces = forces.into_iter().map(|(at, forces)| (at, Rc::from(forces))).collect();
        let half = half.map(|half| {
            let of_half = |pocket: &SpacePocket| pocket.with_unit(half.forces(&pocket.unit));
            let pockets = pockets.iter().map(of_half).collect();
            (half, pockets)
        });
        let forces = RefCell::new(forces);
        Ok(Self { contact, load, observer, constant, fluid, friction, half, positions, forces })
    }

    /// A passage over the faces `faces`, which are updated to their state after it, without the
    /// wheel. Virgin faces are loaded by the constant stress first.
    ///
    /// Errors: contact that does not converge; an interruption.
    pub fn pass(
        &self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        let body = self.contact.body;
        let positions = self.positions.len();
        let history = SpaceHistory {
            sifs: Vec::with_capacity(positions),
            before: Vec::new(),
            faces: Vec::with_capacity(positions),
            fluid: Vec::new(),
            positions: self.positions.clone(),
            steps: 0,
            iterations: 0,
            iterations_max: 0,
            violation: 0.0,
            step_error: 0.0,
        };
        let mut passage = PassageInProgress {
            passages: self,
            settings,
            history,
            half: self.half.as_ref().filter(|(half, _)| half.is_symmetric(&faces.jumps)),
            factor: LaggedFactor::default(),
            earlier: None,
            last: Rc::new(WheelInstant { position: f64::NAN, faces: faces.clone() }),
            is_calm: false,
            level: 0,
        };
        let last = Rc::clone(&passage.last);
        let constant = passage.step(&faces.jumps, &faces.jumps, (&self.constant, &last, f64::NAN))?;
        passage.history.before = body.sifs_of_jumps(&constant.jumps);
        let (first, last) = (passage.history.positions[0], passage.history.positions[positions - 1]);
        let before = WheelInstant { position: f64::NAN, faces: constant };
        let jumps = &before.faces.jumps;
        let faces_then = passage.step(jumps, jumps, (&self.forces_at(first), &before, first))?;
        passage.accept(Rc::new(WheelInstant { position: first, faces: faces_then }));
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
        let jumps = &last.faces.jumps;
        *faces = passage.step(jumps, jumps, (&self.constant, &last, f64::NAN))?;
        Ok(passage.history)
    }

    /// Nodal forces (N) with the wheel at `position` (mm).
    fn forces_at(&self, position: f64) -> Rc<[f64]> {
        let at = position.to_bits();
        if let Some(forces) = self.forces.borrow().get(&at) {
            return Rc::clone(forces);
        }
        let parts = (self.fluid.as_ref(), self.half.as_ref().map(|(half, _)| half));
        let forces: Rc<[f64]> = self.load.forces(self.contact.body, parts, &self.constant, position).into();
        self.forces.borrow_mut().insert(at, Rc::clone(&forces));
        forces
    }
}

/// A passage that is being computed.
struct PassageInProgress<'a> {
    passages: &'a SpacePassages<'a>,
    settings: &'a SpacePassageSettings,
    history: SpaceHistory,
    /// The half of the faces that is solved for; none where they are solved for as a whole.
    half: Option<&'a (MirroredHalf, Vec<SpacePocket>)>,
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
    /// The faces under `forces` with the wheel at the position `to` (not a number without it) after
    /// the instant `last`, with slip measured from the jumps `origin` and jumps close to `guess`.
    fn step(
        &mut self,
        guess: &[f64],
        origin: &[f64],
        (forces, last, to): (&[f64], &WheelInstant, f64),
    ) -> Result<SpaceFaces, SpaceContactError> {
        let SpacePassages { observer, fluid, .. } = self.passages;
        if observer.interrupted() {
            return Err(Interrupted.into());
        }
        let begin = |fluid: &FluidUnderWheel<'_>| {
            let over = |position: f64, at: [f64; 2]| {
                if position.is_nan() { 0.0 } else { (fluid.over)(position, at) }
            };
            fluid.faces.begin((last.position, &last.faces), to, &over)
        };
        let mut states = fluid.as_ref().map_or_else(Vec::new, begin);
        let (mut faces, mut report) = self.solved(guess, origin, forces, &states)?;
        if let Some(FluidUnderWheel { faces: fluid, over }) = fluid {
            if let Some(released) = fluid.released(to, over, &faces, &states) {
                states = released;
                (faces, report) = self.solved(guess, origin, forces, &states)?;
            }
            if let Some(sealed) = fluid.refused(&states, &faces) {
                states = sealed;
                (faces, report) = self.solved(guess, origin, forces, &states)?;
            }
            fluid.follow(&mut faces);
        }
        let StepReport { iterations, violation } = report;
        let history = &mut self.history;
        history.steps += 1;
        history.iterations += iterations;
        history.iterations_max = history.iterations_max.max(iterations);
        history.violation = history.violation.max(violation);
        Ok(faces)
    }

    /// The faces with the fluid of `states` at the beginning of the step.
    fn solved(
        &mut self,
        guess: &[f64],
        origin: &[f64],
        forces: &[f64],
        states: &[PocketState],
    ) -> Result<(SpaceFaces, StepReport), SpaceContactError> {
        let SpacePassages { contact, friction, .. } = self.passages;
        let fluid = self.passages.fluid.as_ref().map(|fluid| &fluid.faces);
        let trapped = fluid.filter(|fluid| fluid.is_trapped());
        let bulk_modulus = fluid.map_or(f64::INFINITY, FluidOnFaces::bulk_modulus);
        if let Some((half, pockets)) = self.half {
            let pockets = trapped.map_or(&[][..], |_| pockets);
            let pockets = PocketsOfStep { pockets, states, bulk_modulus };
            let [guess, origin] = [guess, origin].map(|jumps| half.jumps(jumps));
            let load = (&half.forces(forces)[..], pockets);
            let (faces, report) = half.problem().step_from(&guess, &mut self.factor, &origin, load)?;
            return Ok((half.whole(faces), report));
        }
        let pockets = trapped.map_or(&[][..], |fluid| &fluid.pockets);
        let pockets = PocketsOfStep { pockets, states, bulk_modulus };
        contact.problem(friction).step_from(guess, &mut self.factor, origin, (forces, pockets))
    }

    /// The instant with the wheel at the position `to`, after the instants `earlier` and `last`.
    fn instant(
        &mut self,
        guess: Option<&[f64]>,
        earlier: Option<&WheelInstant>,
        last: &WheelInstant,
        to: f64,
    ) -> Result<Rc<WheelInstant>, SpaceContactError> {
        let forces = self.passages.forces_at(to);
        let origin = slip_origin(earlier, last, to);
        let load = (&*forces, last, to);
        let faces = match guess {
            Some(guess) => self.step(guess, &origin, load)?,
            None => self.step(&extrapolated_jumps(earlier, last, to), &origin, load)?,
        };
        Ok(Rc::new(WheelInstant { position: to, faces }))
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
            history.sifs.push(self.passages.contact.body.sifs_of_jumps(&instant.faces.jumps));
            history.faces.push(instant.faces.clone());
            if let Some(FluidUnderWheel { faces, over }) = &self.passages.fluid {
                let cracks = 0..self.passages.contact.body.cracks().len();
                let of = |crack| faces.state_of(crack, instant.position, *over, &instant.faces);
                history.fluid.push(cracks.map(of).collect());
            }
        }
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
        let one = match &whole {
            // Midway between the two.
            Some(whole) => self.instant(
                Some(&mean(&last.faces.jumps, &whole.faces.jumps)),
                earlier.as_deref(),
                &last,
                between,
            ),
            None => self.instant(None, earlier.as_deref(), &last, between),
        };
        let guess = whole.as_ref().map(|whole| &whole.faces.jumps[..]);
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
                        None => self.instant(Some(&two.faces.jumps), earlier.as_deref(), &last, to),
                    };
                    let error = match whole {
                        Ok(whole) => self.difference(&whole, &two),
                        Err(SpaceContactError::NotConverged { .. }) => f64::INFINITY,
                        Err(error) => return Err(error),
                    };
                    self.is_calm = error <= CALM * self.settings.tolerance;
                    if error <= COARSER * self.settings.tolerance {
                        self.level = level.saturating_sub(1);
                    }
                    error
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

    /// The largest difference of K at two instants, MPa √mm.
    fn difference(&self, one: &WheelInstant, other: &WheelInstant) -> f64 {
        let body = self.passages.contact.body;
        let sifs = |instant: &WheelInstant| body.sifs_of_jumps(&instant.faces.jumps);
        sifs(one).iter().zip(&sifs(other)).map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
    }
}

fn mean(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
}

/// Jumps extrapolated to the position `to`.
fn extrapolated_jumps(earlier: Option<&WheelInstant>, last: &WheelInstant, to: f64) -> Vec<f64> {
    let jumps = last.faces.jumps.clone();
    let Some(earlier) = earlier else { return jumps };
    let ratio = ((to - last.position) / (last.position - earlier.position)).min(LONGEST);
    jumps.iter().zip(&earlier.faces.jumps).map(|(new, old)| new + ratio * (new - old)).collect()
}

/// The passage of the wheel over the faces `faces`, which are updated to their state after it.
/// Results are given at the positions of `passage` and, where the rail bends, at distant positions.
///
/// Errors: contact that does not converge.
pub fn space_passage(
    contact: &SpaceContact,
    load: &SpaceLoad,
    passage: Passage,
    settings: &SpacePassageSettings,
    faces: &mut SpaceFaces,
) -> Result<SpaceHistory, SpaceContactError> {
    SpacePassages::new(contact, load, passage, &crate::growth::Unobserved)?.pass(settings, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{FluidModel, PressureProfile};
    use crate::growth::Unobserved;
    use crate::material::IsotropicElastic;
    use crate::space::{EllipticWheel, SpaceCrack, SpaceResolution, Surroundings};

    const WHEEL: EllipticWheel = EllipticWheel {
        peak_pressure: 900.0,
        half_width: 5.0,
        lateral_half_width: 6.0,
        lateral: 2.0,
        friction: 0.1,
        lateral_friction: 0.0,
    };
    /// Largest difference of K from that of the whole faces, relative to the peak: divisions of the
    /// quadrature of the stiffness are not mirrored.
    const MIRRORED: f64 = 1e-6;

    #[test]
    fn one_half_of_symmetric_faces_is_enough() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let first = SpaceCrack { middle: [0.0, 2.0], ..SpaceCrack::surface_breaking(0.5, 4.0, 3.0).unwrap() };
        let second =
            SpaceCrack { middle: [5.0, 2.0], ..SpaceCrack::surface_breaking(0.6, 3.0, 2.0).unwrap() };
        let resolution = SpaceResolution { block: 2, ring: 2 };
        let cracks = [first.checked().unwrap(), second.checked().unwrap()];
        let body = SpaceBody::new(&cracks, &steel, Surroundings::HalfSpace, resolution).unwrap();
        let contact = SpaceContact { body: &body, friction: &[0.3, 0.2] };
        let trapped = SpaceFluid {
            model: FluidModel::Trapped { bulk_modulus: f64::INFINITY, leak: true },
            profile: PressureProfile::Constant,
            cracks: None,
        };
        let over = |position: f64, at: [f64; 2]| WHEEL.pressure(position, at);
        let wheel = |position: f64, point: [f64; 3]| WHEEL.stress(position, point, 0.3);
        let settings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
        let passage = Passage { from: -15.0, to: 20.0, positions: 36 };
        for fluid in [None, Some(SpaceFluidLoad { fluid: &trapped, over: &over })] {
            let load = SpaceLoad { wheel: &wheel, bending: None, constant: None, fluid };
            let mut passages = SpacePassages::new(&contact, &load, passage, &Unobserved).unwrap();
            assert!(passages.half.is_some());
            let halves = passages.pass(&settings, &mut contact.virgin()).unwrap();
            passages.half = None;
            let whole = passages.pass(&settings, &mut contact.virgin()).unwrap();
            let (peak, difference) = (whole.peak(), whole.difference(&halves));
            assert!(peak > 20.0 && difference < MIRRORED * peak, "{peak} {difference:e}");
            let gap = whole.fluid.iter().flatten().zip(halves.fluid.iter().flatten());
            let gap = gap.fold(0.0f64, |most, (a, b)| most.max((a.pressure - b.pressure).abs()));
            assert!(gap < MIRRORED * 900.0, "{gap:e}");
        }
        let aside =
            |position: f64, [x, lateral, depth]: [f64; 3]| wheel(position, [x, lateral + 1e-5, depth]);
        let load = SpaceLoad { wheel: &aside, bending: None, constant: None, fluid: None };
        assert!(SpacePassages::new(&contact, &load, passage, &Unobserved).unwrap().half.is_none());
    }
}

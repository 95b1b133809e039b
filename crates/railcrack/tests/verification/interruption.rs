//! The end of a passage: on request of the observer, between two load steps, and with an error when
//! the contact solver finds no solution.

use crate::common::{body, steel, surface_crack};
use crate::shakedown::rail;
use railcrack::body::{BodyEngine, BodyError, CrackedBody};
use railcrack::contact::{
    ContactSolver, FaceProblem, FaceResponse, LoadStep, Newton, NotConverged, StepSolver, SteppingError,
};
use railcrack::crack::CrackNetwork;
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::field::HertzWheel;
use railcrack::growth::{Observer, PassageError, PassageSettings, StabilisedPassage, Unobserved};
use railcrack::interruption::Interruption;
use railcrack::load::{HertzianContact, Passage};
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack::shakedown::{Resolution, ShakedownError, Stabilisation, stabilise_unless};
use railcrack::xfem::{MeshSettings, RailEnd, XfemEngine, XfemSettings};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Output positions: few, so that most requests fall between them.
const POSITIONS: usize = 5;

fn passage(solver: &dyn ContactSolver, watch: &dyn Observer) -> Result<StabilisedPassage, PassageError> {
    let body = body(&[surface_crack(0.0, 6.0, 15.0)], 24);
    let problem = FaceProblem::new(&body, &[0.5]).unwrap();
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
    let settings = PassageSettings {
        passage: Passage { from: -40.0, to: 40.0, positions: POSITIONS },
        max_passages: 2,
        passage_tolerance: 1e-3,
        step_tolerance: 2e-3,
        ..PassageSettings::default()
    };
    let load = RailLoad { wheel: &HertzWheel::new(&contact, &steel()).unwrap(), residual: None };
    stabilised_passage(&problem, solver, load, &settings, watch)
}

/// Requests a stop when it has been asked `after` times.
struct Impatient {
    after: usize,
    asked: AtomicUsize,
}

impl Observer for Impatient {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.after
    }
}

#[test]
fn stops_between_load_steps() {
    let patient = Impatient { after: usize::MAX, asked: AtomicUsize::new(0) };
    passage(&Newton::default(), &patient).unwrap();
    let asked = patient.asked.load(Ordering::Relaxed);
    assert!(asked > 10 * POSITIONS, "asked {asked} times only");
    for after in [0, 1, asked / 2, asked - 1] {
        let impatient = Impatient { after, asked: AtomicUsize::new(0) };
        let result = passage(&Newton::default(), &impatient);
        assert!(matches!(result, Err(PassageError::Interrupted)), "after {after} of {asked}: {result:?}");
        assert_eq!(impatient.asked.load(Ordering::Relaxed), after + 1);
    }
}

/// A Newton solver that gives up in every other step, so that no step ever becomes the smallest
/// one.
struct Moody(AtomicUsize);

struct MoodySteps<'a> {
    newton: Box<dyn StepSolver<'a> + 'a>,
    mood: usize,
}

impl ContactSolver for Moody {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a> {
        Box::new(MoodySteps {
            newton: Newton::default().prepare(problem),
            mood: self.0.load(Ordering::Relaxed),
        })
    }
}

impl<'a> StepSolver<'a> for MoodySteps<'a> {
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        self.mood += 1;
        if !self.mood.is_multiple_of(8) {
            return Err(NotConverged { iterations: 200, indicator: 1.0, tolerance: 1e-11 });
        }
        self.newton.solve(step, faces)
    }

    fn keep(&mut self) {}

    fn restore(&mut self) {}
}

#[test]
fn fails_where_contact_has_no_solution() {
    let error = passage(&Moody(AtomicUsize::new(0)), &Unobserved).unwrap_err();
    let PassageError::NotConverged { source: SteppingError::NotConverged { failure, .. }, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(failure.iterations, 200);
    assert!(error.to_string().contains("not converged after 200 iterations"), "{error}");
}

#[test]
fn a_passage_without_positions_is_refused() {
    let body = body(&[surface_crack(0.0, 6.0, 15.0)], 12);
    let problem = FaceProblem::new(&body, &[0.5]).unwrap();
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
    let load = RailLoad { wheel: &HertzWheel::new(&contact, &steel()).unwrap(), residual: None };
    let passage = Passage { positions: 0, ..Passage::default() };
    let settings = PassageSettings { passage, ..PassageSettings::default() };
    let result = stabilised_passage(&problem, &Newton::default(), load, &settings, &Unobserved);
    assert!(matches!(result, Err(PassageError::Settings(refused)) if refused.value == 0.0));
}

/// How often a computation asked whether to go on in all, how often after the answer was no, and
/// how long it then took to end.
struct Farewell {
    asked: usize,
    asked_again: usize,
    took: Duration,
}

/// Computes, and wants the computation stopped from its question number `after` (from 0) on.
fn interrupted_at<T>(after: usize, compute: impl FnOnce(Interruption<'_>) -> T) -> (T, Farewell) {
    let asked = AtomicUsize::new(0);
    let wanted = OnceLock::new();
    let stop = || {
        let stop = asked.fetch_add(1, Ordering::Relaxed) >= after;
        if stop {
            wanted.get_or_init(Instant::now);
        }
        stop
    };
    let result = compute(Interruption::when(&stop));
    let took = wanted.get().map_or(Duration::ZERO, Instant::elapsed);
    let asked = asked.load(Ordering::Relaxed);
    (result, Farewell { asked, asked_again: asked.saturating_sub(after + 1), took })
}

/// Far more than the second that an idle machine needs at most, less than any of the computations
/// would go on for.
const SOON: Duration = Duration::from_secs(15);

/// Gives up at each of the questions `after`, and asks no further but from the threads that had not
/// heard of it.
fn gives_up<const N: usize>(
    after: [usize; N],
    mut body: impl FnMut(Interruption<'_>) -> Result<CrackedBody, BodyError>,
) {
    for after in after {
        let (result, farewell) = interrupted_at(after, &mut body);
        let Farewell { asked, asked_again, took } = farewell;
        assert!(result.is_err_and(|error| error.is_interruption()), "question {after} of {asked}");
        assert!(asked_again < 1000, "question {after}: asked {asked_again} times more");
        assert!(took < SOON, "question {after}: ended {took:?} later");
    }
}

#[test]
fn dislocations_give_up_soon() {
    let cracks = (0..100).map(|i| surface_crack(7.0 * f64::from(i), 6.0, 30.0)).collect();
    let network = CrackNetwork::new(cracks).unwrap();
    let resolution = FaceResolution { elements: 400 };
    let mut engine = DislocationEngine { steel: steel(), resolution };
    gives_up([0, 10, 1000], |interruption| engine.body_unless(interruption, &network));
}

#[test]
fn finite_elements_give_up_soon() {
    let network = CrackNetwork::from(surface_crack(0.0, 6.0, 15.0));
    let mesh = MeshSettings { element_size: 0.008, expected_growth: 1.0 };
    let end = RailEnd::HalfPlane { centre: 0.0 };
    let engine = XfemEngine::new(&network, steel(), mesh, end, XfemSettings::default());
    assert!(engine.mesh_unknowns() > 1e6, "{}", engine.mesh_unknowns());
    gives_up([0, 100, 10_000, 200_000], |interruption| engine.clone().body_unless(interruption, &network));
}

#[test]
fn the_plastic_state_is_given_up_soon() {
    let resolution = Resolution { per_half_width: 128, ..Resolution::default() };
    let settings = Stabilisation { resolution, pass_tolerance: 1e-12, ..Stabilisation::default() };
    for after in [0, 3, 30] {
        let (result, farewell) = interrupted_at(after, |interruption| {
            stabilise_unless(interruption, &rail(1500.0, 0.3, 20e3), &settings, |_| ())
        });
        assert!(
            matches!(result, Err(ShakedownError::Interrupted(_))),
            "question {after}: {:?}",
            result.map(|rail| rail.passes.len())
        );
        assert!(farewell.took < SOON, "question {after}: {:?}", farewell.took);
    }
}

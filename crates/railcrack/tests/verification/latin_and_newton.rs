//! LATIN and Newton in the same load steps: the same tractions and stress intensity factors.

use crate::common::{
    Meshed, Of, Rolling, body, close, default_elements, joined_body, junction, largest, polyline,
    surface_crack,
};
use railcrack::body::CrackedBody;
use railcrack::contact::{
    ContactSolver, FaceProblem, FaceResponse, FaceSolution, Latin, LoadStep, Newton, NotConverged, StepSolver,
};
use railcrack::crack::{Crack, CrackNetwork, End};
use std::sync::{Arc, Mutex};

/// Largest differences and largest values over all steps.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    steps: usize,
    traction: f64,
    largest_traction: f64,
    sif: f64,
    largest_sif: f64,
}

/// Newton, beside which LATIN solves each of its steps, from the same forces and reference slips.
#[derive(Default, Clone)]
struct Both(Arc<Mutex<Seen>>);

struct BothSteps<'a> {
    problem: &'a FaceProblem<'a>,
    newton: Box<dyn StepSolver<'a> + 'a>,
    latin: Box<dyn StepSolver<'a> + 'a>,
    seen: Arc<Mutex<Seen>>,
}

impl ContactSolver for Both {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a> {
        let newton = Newton::default().prepare(problem);
        let latin = Latin::default().prepare(problem);
        Box::new(BothSteps { problem, newton, latin, seen: self.0.clone() })
    }
}

impl BothSteps<'_> {
    fn tractions(&self, solution: &FaceSolution) -> Vec<f64> {
        solution.face_states(self.problem).iter().flat_map(|state| [state.s12, state.s22]).collect()
    }

    fn compare(&self, newton: &FaceSolution, latin: &FaceSolution, load: &[f64]) {
        let difference = |a: Vec<f64>, b: Vec<f64>| largest(a.iter().zip(&b).map(|(a, b)| a - b));
        let mut seen = self.seen.lock().unwrap();
        let tractions = self.tractions(newton);
        seen.largest_traction = seen.largest_traction.max(largest(tractions.iter().copied()));
        seen.traction = seen.traction.max(difference(tractions, self.tractions(latin)));
        let sifs = |faces: &FaceSolution| -> Vec<f64> {
            faces.sifs(self.problem.body(), load).iter().flat_map(|k| [k.ki, k.kii]).collect()
        };
        let (newton, latin) = (sifs(newton), sifs(latin));
        seen.largest_sif = seen.largest_sif.max(largest(newton.iter().copied()));
        seen.sif = seen.sif.max(difference(newton, latin));
        seen.steps += 1;
    }
}

impl<'a> StepSolver<'a> for BothSteps<'a> {
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        self.newton.solve(step, faces)?;
        let newton = faces.solution().clone();
        self.latin.solve(step, faces).unwrap_or_else(|failure| panic!("LATIN: {failure}"));
        self.compare(&newton, faces.solution(), step.forces);
        // The passage continues from Newton's solution.
        self.newton.solve(step, faces)
    }

    fn keep(&mut self) {
        self.newton.keep();
        self.latin.keep();
    }

    fn restore(&mut self) {
        self.newton.restore();
        self.latin.restore();
    }
}

fn agree(cracks: Vec<Crack>, friction: f64, wheel: f64) {
    let rolling = Rolling::over(cracks, friction, wheel);
    agree_on(&body(&rolling.cracks, rolling.elements), &rolling);
}

fn agree_on(body: &CrackedBody, rolling: &Rolling) {
    let cracks = 1 + body.faces.points.iter().map(|point| point.crack).max().unwrap();
    let problem = FaceProblem::new(body, &vec![rolling.crack_friction; cracks]).unwrap();
    let both = Both::default();
    rolling.on(&problem, &both);
    let seen = *both.0.lock().unwrap();
    assert!(seen.steps > 200, "{seen:?}");
    // LATIN stops at an indicator of 1e-9 on forces and K; tractions on the short elements of the
    // mouth are the forces over their length. Measured 3e-7 and 1e-9.
    close(seen.traction, 0.0, Of(1e-6, seen.largest_traction), "indicator of LATIN, tractions");
    close(seen.sif, 0.0, Of(1e-8, seen.largest_sif), "indicator of LATIN, K");
}

#[test]
fn straight_cracks() {
    agree(vec![surface_crack(0.0, 6.0, 15.0)], 0.5, 0.025);
    agree(vec![surface_crack(0.0, 6.0, 15.0)], 0.1, 0.4);
    agree(vec![surface_crack(0.0, 6.0, 45.0)], 0.8, -0.4);
    agree(vec![surface_crack(0.0, 6.0, 15.0)], 0.0, 0.025);
}

#[test]
fn kinked_crack() {
    agree(vec![surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, -1.0).unwrap()], 0.5, 0.1);
}

/// A surface crack that ends on a kinked one below, in both engines.
#[test]
fn junction_of_cracks() {
    let at = (0.7, -3.0);
    let cracks = vec![polyline(&[(1.0, 0.0), (0.4, -1.5), at]), polyline(&[(-2.3, -3.3), at, (3.0, -2.0)])];
    let junctions = vec![junction(0, End::Last, 1)];
    let rolling = Rolling::over(vec![cracks[0].clone()], 0.3, 0.1);
    agree_on(&joined_body(&cracks, &junctions, default_elements()), &rolling);
    let network = CrackNetwork::joined(cracks, junctions).unwrap();
    agree_on(&Meshed::of_size(0.2).body_of(&network), &rolling);
}

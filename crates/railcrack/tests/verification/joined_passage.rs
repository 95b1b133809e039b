//! A passage whose faces reach the state of the previous passage at the same position is not
//! computed any further; here its remainder is computed all the same.

use crate::common::{Rolling, body, polyline, surface_crack};
use railcrack::contact::{FaceProblem, FaceSolution, FaceState, LoadPath, Newton, Stepper};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::field::{DepthProfile, HertzField, StressField};
use railcrack::math::Stress;

/// A stage of the travel of the wheel.
#[derive(Clone, Copy)]
enum Part {
    /// No wheel; the fraction of the residual stress.
    Ramp,
    /// From or to infinity on this side, x_c = side / s.
    Far(f64),
    /// Over the faces, x_c = s (mm).
    Over,
}

struct Way<'a> {
    problem: &'a FaceProblem<'a>,
    wheel: HertzField,
    residual: Option<&'a dyn StressField>,
    part: Part,
}

impl LoadPath for Way<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let faces = &self.problem.body().faces;
        let wheel_at = match self.part {
            Part::Ramp => None,
            Part::Far(side) => (at != 0.0).then(|| side / at),
            Part::Over => Some(at),
        };
        let share = if matches!(self.part, Part::Ramp) { at } else { 1.0 };
        let of_wheel = faces.nodal_forces(|point| match wheel_at {
            Some(xc) => self.wheel.stress(point, xc),
            None => Stress::ZERO,
        });
        let of_residual = faces.nodal_forces(|point| match self.residual {
            Some(residual) => residual.stress(point),
            None => Stress::ZERO,
        });
        of_wheel.iter().zip(of_residual).map(|(wheel, residual)| wheel + share * residual).collect()
    }
}

/// The faces at the output positions of the second passage, with every load step computed.
fn second_passage(rolling: &Rolling, tolerance: f64) -> Vec<Vec<FaceState>> {
    let body = body(&rolling.cracks, rolling.elements);
    let problem = FaceProblem::new(&body, &vec![rolling.crack_friction; rolling.cracks.len()]).unwrap();
    let network = CrackNetwork::new(rolling.cracks.clone()).unwrap();
    let reach = 6.0 * Rolling::HALF_WIDTH;
    let (first, last) = (network.leftmost_mouth() - reach, network.rightmost_mouth() + reach);
    let positions: Vec<f64> = (0..=240).map(|i| first + f64::from(i) / 240.0 * (last - first)).collect();
    let way = |part| Way {
        problem: &problem,
        wheel: HertzField::new(&rolling.contact(), 0.3),
        residual: rolling.residual,
        part,
    };
    let [ramp, approach, over, departure] =
        [Part::Ramp, Part::Far(-1.0), Part::Over, Part::Far(1.0)].map(way);
    let mut expected = vec![0.0f64; problem.points()];
    for x in positions.iter().step_by(8) {
        let jump = body.compliance.times(&over.nodal_forces(*x));
        expected
            .iter_mut()
            .zip(jump.chunks_exact(2))
            .for_each(|(slip, jump)| *slip = slip.max(jump[0].abs()));
    }
    let mut stepper = Stepper::new(&problem, &Newton::default(), tolerance, &expected);
    let mut states = Vec::new();
    let ignore = &mut |_: &FaceSolution, _: &[f64]| {};
    stepper.begin(0.0);
    (1..=8).for_each(|k| stepper.advance(&ramp, f64::from(k) / 8.0, ignore).unwrap());
    for _ in 0..2 {
        states.clear();
        stepper.begin(0.0);
        (1..=16).for_each(|k| stepper.advance(&approach, f64::from(k) / -16.0 / first, ignore).unwrap());
        stepper.begin(first);
        for &x in &positions {
            stepper.advance(&over, x, ignore).unwrap();
            states.push(stepper.solution().face_states(&problem));
        }
        stepper.begin(1.0 / last);
        (0..16).rev().for_each(|k| stepper.advance(&departure, f64::from(k) / 16.0 / last, ignore).unwrap());
    }
    states
}

/// A shallow crack, one that leans the other way and retains locked slip, a kinked one, one that
/// goes straight down and joins late, and a pair.
#[test]
fn a_joined_passage_equals_the_computed_one() {
    let pair: Vec<Crack> = vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)];
    let kinked = vec![polyline(&[(0.0, 0.0), (3.9, -1.0), (4.9, -2.7)])];
    // Compression that closes the faces until the wheel comes for the first time: the second
    // passage is a different one.
    let layer = DepthProfile::new(vec![(0.0, -200.0, 0.0), (2.0, -200.0, 0.0), (4.0, 0.0, 0.0)]).unwrap();
    let none: Option<&dyn StressField> = None;
    for (cracks, friction, wheel, residual) in [
        (vec![surface_crack(0.0, 6.0, 15.0)], 0.5, 0.025, none),
        (vec![surface_crack(0.0, 6.0, 30.0)], 0.5, 0.1, Some(&layer)),
        (vec![surface_crack(0.0, 6.0, 165.0)], 0.8, -0.2, none),
        (kinked, 0.5, 0.1, none),
        (vec![surface_crack(0.0, 6.0, 90.0)], 0.5, 0.025, none),
        (pair, 0.5, 0.025, none),
    ] {
        let mut rolling = Rolling::over(cracks, friction, wheel);
        rolling.elements = 30;
        rolling.residual = residual;
        rolling.steps.tolerance = 1e-4;
        let result = rolling.solve();
        assert!(result.passages.len() > 1, "{rolling:?}");
        let computed = second_passage(&rolling, 1e-4);
        let values = |states: &[Vec<FaceState>]| -> Vec<f64> {
            states.iter().flatten().flat_map(|state| [state.slip, state.opening]).collect()
        };
        let (got, want) = (values(&result.faces.states), values(&computed));
        assert_eq!(got.len(), want.len());
        let largest = want.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let worst = got.iter().zip(&want).fold(0.0f64, |m, (got, want)| m.max((got - want).abs()));
        assert!(worst < 1e-3 * largest, "{rolling:?}: {:.2e}", worst / largest);
    }
}

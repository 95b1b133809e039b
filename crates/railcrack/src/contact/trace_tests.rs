use super::*;
use crate::contact::fixtures::one_point;
use PointStatus::{Open, SlipBackward, SlipForward, Stick};
use proptest::prelude::*;

/// Compliance of the point, mm per N/mm: without coupling between shear and pressure.
const C: f64 = 1e-5;
const MU: f64 = 0.5;
const SCALE: FaceScale = FaceScale { jump: 1e-3, force: 100.0 };

/// Follows the point through a step from `current` with `status`, the load start + τ first + τ²
/// second which the parabola misses by `missed`; returns the result and the faces at the end.
fn followed(
    current: &FaceSolution,
    [start, first, second]: [[f64; 2]; 3],
    missed: [f64; 2],
    allowed: f64,
) -> (Result<Trace, Stop>, FaceSolution) {
    let body = one_point(C, 0.0);
    let problem = FaceProblem::new(&body, &[MU]).unwrap();
    let mut faces = FaceResponse::virgin(&problem);
    faces.set_status(0, current.status[0], current.jump[0]);
    let end: Vec<f64> = (0..2).map(|i| start[i] + first[i] + second[i]).collect();
    faces.load_on(&start, &end, [&first, &second]);
    let outside = OutsidePressure::default();
    let accuracy = Accuracy {
        missed: &|| missed.to_vec(),
        allowed: &|_| allowed,
        outside,
        release_excess: 0.0,
        at_release: AtRelease::EndStep,
    };
    let mut trace = Trace::default();
    let followed = follow(&problem, &mut faces, current, SCALE, accuracy, &mut trace);
    faces.equilibrate().unwrap();
    (followed.map(|()| trace), faces.solution().clone())
}

fn point(jump: [f64; 2], contact: [f64; 2], status: PointStatus) -> FaceSolution {
    FaceSolution {
        jump: jump.to_vec(),
        contact: contact.to_vec(),
        status: vec![status],
        loaded: Vec::new(),
        fluid: Vec::new(),
    }
}

fn assert_near(got: f64, want: f64, scale: f64) {
    assert!((got - want).abs() < 1e-9 * scale, "{got} instead of {want}");
}

/// Pressed with P, a shear force that rises to L and goes back to zero: the point sticks until μ P,
/// slips until L, sticks at c (L − μ P) until the force has gone down by 2 μ P, and slips back.
#[test]
fn a_point_that_is_pushed_to_and_fro() {
    const P: f64 = 40.0;
    const L: f64 = 90.0;
    let current = point([0.0, 0.0], [0.0, P], Stick);
    let load = [[0.0, -P], [4.0 * L, 0.0], [-4.0 * L, 0.0]];
    let (traced, end) = followed(&current, load, [0.0; 2], 1e-9);
    let trace = traced.ok().unwrap();
    let (reference_slip, changes) = (&trace.reference_slip, trace.changes());
    // The point begins to slip, is held, and slips back.
    assert_eq!(changes.len(), 3);
    let hold = &changes[1];
    let farthest = C * (L - MU * P);
    assert_near(hold.share, 0.5, 1.0);
    assert_eq!(hold.solution.status, [SlipForward]);
    assert_near(hold.solution.jump[0], farthest, farthest);
    assert_near(hold.solution.contact[0], -MU * P, P);
    assert_near(reference_slip[0], farthest, farthest);
    assert_eq!(end.status, [SlipBackward]);
    assert_near(end.jump[0], C * MU * P, farthest);
    assert_near(end.contact[0], MU * P, P);
}

/// A gap closes at half the step: faster than it slips, so that it is held where it touches, or
/// slower, so that it slips on.
#[test]
fn a_point_that_touches_sticks_or_slips_on() {
    const P: f64 = 40.0;
    for (along, status) in [(0.4 * P, Stick), (1.2 * P, SlipForward), (-1.2 * P, SlipBackward)] {
        let current = point([0.0, C * P], [0.0, 0.0], Open);
        let (traced, end) = followed(&current, [[0.0, P], [along, -2.0 * P], [0.0; 2]], [0.0; 2], 1e-9);
        let trace = traced.ok().unwrap();
        let (reference_slip, changes) = (&trace.reference_slip, trace.changes());
        assert_eq!((changes.len(), end.status[0]), (1, status), "{along}");
        assert_near(changes[0].share, 0.5, 1.0);
        assert_near(reference_slip[0], 0.5 * C * along, C * P);
        let slip = match status {
            Stick => 0.5 * C * along,
            // The end of the load is P of pressure: μ P of friction.
            _ => C * (along - (MU * P).copysign(along)),
        };
        assert_near(end.jump[0], slip, C * P);
    }
}

#[test]
fn a_point_opens() {
    let current = point([2e-4, 0.0], [-20.0, 40.0], SlipForward);
    // Slip 2e-4 = c (load − 20).
    let (traced, end) = followed(&current, [[40.0, -40.0], [10.0, 80.0], [0.0; 2]], [0.0; 2], 1e-9);
    let changes = traced.ok().unwrap().changes;
    // The pressure 40 − 80 τ vanishes.
    assert_eq!(changes.len(), 1);
    assert_near(changes[0].share, 0.5, 1.0);
    assert_eq!(changes[0].solution.status, [SlipForward]);
    assert_eq!(end.status, [Open]);
    assert_near(end.jump[0], C * 50.0, 1e-3);
    assert_near(end.jump[1], C * 40.0, 1e-3);
}

/// The part of the load that the parabola misses counts by the error of slip that it causes,
/// directly and through the moment at which the point touches.
#[test]
fn a_hold_is_as_accurate_as_its_load() {
    const P: f64 = 40.0;
    let (along, closing) = (0.4 * P, 2.0 * P);
    let current = point([0.0, C * P], [0.0, 0.0], Open);
    let load = [[0.0, P], [along, -closing], [0.0; 2]];
    let missed = [3e-3, -5e-3];
    let error = C * (3e-3 + 5e-3 * along / closing);
    for (allowed, fine) in [(1.01 * error, true), (0.99 * error, false)] {
        match followed(&current, load, missed, allowed).0 {
            Ok(_) => assert!(fine),
            Err(Stop::Inaccurate { excess }) => {
                assert!(!fine && (excess - 1.0 / 0.99).abs() < 1e-6, "{excess}")
            }
            Err(lost) => panic!("{lost:?}"),
        }
    }
}

/// Friction 2 with slip that opens the point by more than its pressure: it can neither slip nor
/// open.
#[test]
fn a_way_without_next_change_is_lost_where_it_ends() {
    let body = one_point(1.0, 0.9);
    let problem = FaceProblem::new(&body, &[2.0]).unwrap();
    let mut faces = FaceResponse::virgin(&problem);
    let current = point([0.0, 0.5], [0.0, 0.0], Open);
    faces.set_status(0, Open, 0.0);
    // The free jumps go from (0, 1/2) to (3, −1/2): too fast along for a point that touches to
    // stick.
    let forces = |jump: [f64; 2]| body.stiffness.times(&jump);
    let (start, end) = (forces([0.0, 0.5]), forces([3.0, -0.5]));
    faces.load_on(&start, &end, [&forces([3.0, -1.0]), &[0.0; 2]]);
    let outside = OutsidePressure::default();
    let accuracy = Accuracy {
        missed: &|| vec![0.0; 2],
        allowed: &|_| 1.0,
        outside,
        release_excess: 0.0,
        at_release: AtRelease::EndStep,
    };
    let scale = FaceScale { jump: 1.0, force: 1.0 };
    let lost = follow(&problem, &mut faces, &current, scale, accuracy, &mut Trace::default()).err().unwrap();
    assert!(matches!(lost, Stop::Lost { share } if (share - 0.5).abs() < 1e-6), "{lost:?}");
}

proptest! {
    #[test]
    fn parabolas_fall_where_they_are_seen_to(c0 in 0.0..1.0f64, c1 in -4.0..4.0f64, c2 in -4.0..4.0f64, span in 0.1..1.0f64) {
        const SMALL: f64 = 1e-9;
        let parabola = Parabola { c0, c1, c2 };
        let value = |at: f64| c0 + at * (c1 + at * c2);
        const POINTS: usize = 2000;
        let seen = (1..=POINTS).map(|k| span * k as f64 / POINTS as f64).find(|&at| value(at) < -SMALL);
        match (parabola.first_fall(SMALL, span), seen) {
            (Some(after), Some(seen)) => {
                prop_assert!(after <= seen && seen - after <= span / POINTS as f64 + 1e-12, "{after}, {seen}");
            }
            // Shorter than the distance of the points.
            (Some(after), None) => prop_assert!(value(after + 1e-6) < 1e-5),
            (None, seen) => prop_assert!(seen.is_none(), "{seen:?}"),
        }
        let rate = |at: f64| c1 + 2.0 * c2 * at;
        let seen = (0..=POINTS).map(|k| span * k as f64 / POINTS as f64).find(|&at| rate(at) < -2.0 * SMALL);
        match (parabola.rate_falls(SMALL, span), seen) {
            (Some(after), Some(seen)) => prop_assert!(after <= seen && seen - after <= span / POINTS as f64),
            (Some(after), None) => prop_assert!(span - after <= span / POINTS as f64),
            (None, seen) => prop_assert!(seen.is_none() || seen == Some(span), "{seen:?}"),
        }
    }
}

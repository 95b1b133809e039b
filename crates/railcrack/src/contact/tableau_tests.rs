use super::*;
use Condition::{Free, Held};
use proptest::prelude::*;

const N: usize = 8;

fn stiffness() -> Matrix {
    let entry = |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 2.0 * f64::from(i == j);
    Matrix::from_fn(N, N, |i, j| 1e5 * entry(i, j))
}

const LOAD: [f64; N] = [10.0, -20.0, 5.0, 30.0, 3.0, -10.0, 20.0, 7.0];

/// Largest residual of A w = load + q and of the conditions, over the load.
fn defect(tableau: &mut Tableau, conditions: &[Condition; N], again: bool) -> f64 {
    let (mut jump, mut contact) = ([0.0; N], [0.0; N]);
    tableau.loads().set([LOAD]);
    let solved = if again {
        tableau.solve_again(&mut jump, &mut contact)
    } else {
        tableau.solve(&mut jump, &mut contact)
    };
    solved.unwrap();
    let forces = tableau.columns.transposed().times(&jump);
    let worst = (0..N).fold(0.0f64, |worst, i| {
        let missed = match conditions[i] {
            Held(at) => 1e5 * (jump[i] - at).abs(),
            Free(coupling) => (contact[i] + times(coupling, || contact[i + 1])).abs(),
        };
        worst.max(missed).max((forces[i] - LOAD[i] - contact[i]).abs())
    });
    worst / 30.0
}

/// Any condition that a face point may have: (shear, normal).
fn condition() -> impl Strategy<Value = (Condition, Condition)> {
    prop_oneof![
        Just((Free(0.0), Free(0.0))),
        (-1e-4..1e-4).prop_map(|at| (Held(at), Held(0.0))),
        (-0.8..0.8).prop_map(|coupling| (Free(coupling), Held(0.0))),
        Just((Held(0.0), Free(0.0))),
    ]
}

proptest! {
    #[test]
    fn equations_hold_after_any_changes(changes in prop::collection::vec((0..N / 2, condition(), 0..5u8), 1..60)) {
        const ROUND_OFF: f64 = 1e-12;
        let stiffness = stiffness();
        let mut tableau = Tableau::new(&stiffness);
        let (mut conditions, mut kept) = ([Held(0.0); N], [Held(0.0); N]);
        prop_assert!(defect(&mut tableau, &conditions, false) < ROUND_OFF);
        for (point, (shear, normal), action) in changes {
            for (i, condition) in [(2 * point, shear), (2 * point + 1, normal)] {
                tableau.set(i, condition);
                conditions[i] = condition;
            }
            match action {
                0 => {
                    tableau.change_basis().unwrap();
                    prop_assert!(tableau.differences.components.is_empty());
                    prop_assert!(defect(&mut tableau, &conditions, false) < ROUND_OFF);
                }
                1 => {
                    tableau.keep();
                    kept = conditions;
                }
                2 => {
                    tableau.restore();
                    conditions = kept;
                }
                3 => tableau.refresh().unwrap(),
                _ => prop_assert!(defect(&mut tableau, &conditions, true) < ROUND_OFF),
            }
            prop_assert!(defect(&mut tableau, &conditions, false) < ROUND_OFF);
        }
    }
}

#[test]
fn a_base_with_wrong_numbers_is_found_out() {
    let stiffness = stiffness();
    let mut tableau = Tableau::new(&stiffness);
    let mut conditions = [Held(0.0); N];
    for i in [2, 3, 6] {
        conditions[i] = Free(0.0);
        tableau.set(i, Free(0.0));
    }
    tableau.change_basis().unwrap();
    tableau.responses[(3, 2)] *= 1.0 + 1e-6;
    assert!(defect(&mut tableau, &conditions, false) < 1e-14);
}

#[test]
fn conditions_without_a_solution_are_refused_and_others_are_met_afterwards() {
    // A_0 + A_1 vanishes on component 0, but not on 0 and 2 together.
    let rows = [[2.0, -2.0, 1.0], [-2.0, 3.0, 0.5], [1.0, 0.5, 4.0]];
    let stiffness = Matrix::from_fn(3, 3, |i, j| rows[i][j]);
    let mut tableau = Tableau::new(&stiffness);
    let (mut w, mut q) = ([0.0; 3], [0.0; 3]);
    // A basis with forces as inputs, which must not be read as jumps after a rejected condition.
    tableau.set(1, Free(0.0));
    tableau.change_basis().unwrap();
    tableau.loads().set([[1.0, 2.0, 1.0]]);
    tableau.solve(&mut w, &mut q).unwrap();
    tableau.set(1, Held(0.0));
    tableau.set(0, Free(1.0));
    assert_eq!(tableau.solve(&mut w, &mut q), Err(Degenerate));
    tableau.set(2, Free(0.0));
    tableau.solve(&mut w, &mut q).unwrap();
    // (A_0 + A_1)·w = 1.5 w_2 = 3 and A_2·w = w_0 + 4 w_2 = 1.
    assert!((w[0] + 7.0).abs() < 1e-14 && (w[2] - 2.0).abs() < 1e-14, "{w:?}");
}

#[test]
fn rates_are_what_a_load_adds_before_and_after_a_new_base() {
    let stiffness = stiffness();
    let mut tableau = Tableau::new(&stiffness);
    for (i, condition) in [(0, Free(0.3)), (2, Held(1e-4)), (4, Free(0.0)), (5, Free(0.0)), (6, Free(-0.5))] {
        tableau.set(i, condition);
    }
    let added: Vec<f64> = (0..N).map(|i| LOAD[(i + 3) % N] - 5.0).collect();
    let more: Vec<f64> = LOAD.iter().zip(&added).map(|(load, added)| load + added).collect();
    for step in 0..4 {
        let solution = |tableau: &mut Tableau, load: &[f64]| {
            let (mut jump, mut contact) = ([0.0; N], [0.0; N]);
            tableau.loads().set([load.to_vec(), added.clone()]);
            tableau.solve(&mut jump, &mut contact).unwrap();
            (jump, contact)
        };
        let with = solution(&mut tableau, &more);
        let without = solution(&mut tableau, &LOAD);
        let mut rate = [FaceRate { jump: vec![1.0; N], contact: vec![1.0; N] }];
        tableau.rates(&mut [(1, &mut rate[0])]).unwrap();
        let [FaceRate { jump, contact }] = &rate;
        for i in 0..N {
            assert!((with.0[i] - without.0[i] - jump[i]).abs() < 1e-16, "{step}, {i}");
            assert!((with.1[i] - without.1[i] - contact[i]).abs() < 1e-11, "{step}, {i}");
        }
        // The responses to the loads are known and carried over to the new basis.
        tableau.set(0, Free(0.3));
        tableau.set(3, if step == 0 { Held(0.0) } else { Free(0.0) });
        tableau.set(2, Held(1e-4 * f64::from(step)));
        if step > 0 {
            tableau.change_basis().unwrap();
            assert!(tableau.loads.are_answered());
            // The former input of a coupled component is missing under another condition.
            tableau.set(0, Free(-0.2));
            tableau.rates(&mut [(1, &mut rate[0])]).unwrap();
            let [FaceRate { jump, contact }] = rate.clone();
            tableau.loads.begin_basis();
            tableau.rates(&mut [(1, &mut rate[0])]).unwrap();
            let [FaceRate { jump: again, contact: forces }] = &rate;
            for i in 0..N {
                assert!(
                    (jump[i] - again[i]).abs() < 1e-16 && (contact[i] - forces[i]).abs() < 1e-11,
                    "{step}, {i}"
                );
            }
        }
    }
}

/// Load steps whose end responses are sums, with a new basis in between, a repeated step from the
/// same start, and a step from a different start.
#[test]
fn a_load_at_the_end_of_a_step_is_a_sum() {
    let stiffness = stiffness();
    let mut tableau = Tableau::new(&stiffness);
    for (i, condition) in [(0, Free(0.3)), (4, Free(0.0)), (5, Free(0.0)), (6, Free(-0.5))] {
        tableau.set(i, condition);
    }
    tableau.change_basis().unwrap();
    let at = |share: f64| -> Vec<f64> { LOAD.iter().map(|load| load * (1.0 + share * share)).collect() };
    let difference =
        |to: &[f64], from: &[f64]| -> Vec<f64> { to.iter().zip(from).map(|(a, b)| a - b).collect() };
    for (step, (from, to)) in
        [(0.0, 0.1), (0.1, 0.2), (0.2, 0.5), (0.2, 0.3), (0.3, 0.4), (0.9, 1.0)].into_iter().enumerate()
    {
        if step == 4 {
            tableau.set(2, Free(0.1));
            tableau.change_basis().unwrap();
        }
        let (start, end, half) = (at(from), at(to), at(0.5 * (from + to)));
        let (first, second) = (difference(&half, &start), difference(&end, &half));
        tableau.loads().set_on(&start, &end, [&first[..], &second[..]].into_iter());
        assert_eq!(tableau.loads.is_sum(), ![0, 3, 5].contains(&step), "{step}");
        let (mut jump, mut contact) = ([0.0; N], [0.0; N]);
        // Without the check that would correct it.
        tableau.equilibrium(&mut jump, &mut contact).unwrap();
        let mut fresh = Tableau::new(&stiffness);
        (0..N).for_each(|i| fresh.set(i, tableau.now[i]));
        fresh.loads().set([&end]);
        let (mut exact, mut forces) = ([0.0; N], [0.0; N]);
        fresh.solve(&mut exact, &mut forces).unwrap();
        for i in 0..N {
            assert!(
                (jump[i] - exact[i]).abs() < 1e-17 && (contact[i] - forces[i]).abs() < 1e-12,
                "{step}, {i}"
            );
        }
    }
}

/// Loads that stay in their places keep their responses in a basis; with a new basis they are
/// computed again, to the same bits as those of loads that are given for the first time.
#[test]
fn loads_that_stay_keep_their_responses() {
    let stiffness = stiffness();
    let mut tableau = Tableau::new(&stiffness);
    for (i, condition) in [(0, Free(0.3)), (4, Free(0.0)), (5, Free(0.0)), (6, Free(-0.5))] {
        tableau.set(i, condition);
    }
    tableau.change_basis().unwrap();
    let unit = |at: usize| -> Vec<f64> { (0..N).map(|i| f64::from(i == at) - 0.1).collect() };
    let rates = |tableau: &mut Tableau| {
        let mut rates = [1, 2].map(|_| FaceRate::zero(N));
        let [one, other] = &mut rates;
        tableau.rates(&mut [(1, one), (2, other)]).unwrap();
        rates
    };
    for step in 0..3 {
        let acting: Vec<f64> = LOAD.iter().map(|load| load * f64::from(step + 1)).collect();
        tableau.loads().set([acting.clone(), unit(3), unit(5)]);
        assert_eq!(
            tableau.loads.missing(),
            [[0, 1, 2].as_slice(), &[0], &[0, 1, 2]][step as usize],
            "{step}"
        );
        tableau.set(2, if step == 1 { Free(0.0) } else { Held(0.0) });
        let kept = rates(&mut tableau);
        tableau.loads.begin_basis();
        let again = rates(&mut tableau);
        for (kept, again) in kept.iter().zip(&again) {
            assert_eq!((&kept.jump, &kept.contact), (&again.jump, &again.contact), "{step}");
        }
        if step == 1 {
            // Carried over to the new basis with round-off, and computed again at the next step.
            tableau.change_basis().unwrap();
            assert!(tableau.loads.are_answered());
        }
        let mut alone = [FaceRate::zero(N)];
        tableau.rates(&mut [(2, &mut alone[0])]).unwrap();
        assert!(alone[0].jump.iter().zip(&again[1].jump).all(|(a, b)| (a - b).abs() < 1e-16), "{step}");
    }
}

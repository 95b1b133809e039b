use super::*;
use Condition::{Free, Held};
use proptest::prelude::*;

const N: usize = 8;

fn stiffness() -> Matrix {
    let entry = |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 2.0 * f64::from(i == j);
    Matrix::from_fn(N, N, |i, j| 1e5 * entry(i, j))
}

const LOAD: [f64; N] = [10.0, -20.0, 5.0, 30.0, 3.0, -10.0, 20.0, 7.0];

/// By how much A w = load + q and the conditions are missed, over the load.
fn defect(tableau: &mut Tableau, conditions: &[Condition; N], again: bool) -> f64 {
    let (mut jump, mut contact) = ([0.0; N], [0.0; N]);
    let solved = if again {
        tableau.solve_again(&LOAD, &mut jump, &mut contact)
    } else {
        tableau.solve(&LOAD, None, &mut jump, &mut contact)
    };
    solved.unwrap();
    let forces = tableau.stiffness.times(&jump);
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
                    tableau.rebase().unwrap();
                    prop_assert!(tableau.different() == 0);
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
    tableau.rebase().unwrap();
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
    // A base with forces for inputs, which what comes after a refusal must not take for jumps.
    tableau.set(1, Free(0.0));
    tableau.rebase().unwrap();
    tableau.solve(&[1.0, 2.0, 1.0], None, &mut w, &mut q).unwrap();
    tableau.set(1, Held(0.0));
    tableau.set(0, Free(1.0));
    assert_eq!(tableau.solve(&[1.0, 2.0, 1.0], None, &mut w, &mut q), Err(Degenerate));
    tableau.set(2, Free(0.0));
    tableau.solve(&[1.0, 2.0, 1.0], None, &mut w, &mut q).unwrap();
    // (A_0 + A_1)·w = 1.5 w_2 = 3 and A_2·w = w_0 + 4 w_2 = 1.
    assert!((w[0] + 7.0).abs() < 1e-14 && (w[2] - 2.0).abs() < 1e-14, "{w:?}");
}

#[test]
fn a_combined_load_is_answered_like_a_plain_one() {
    let stiffness = stiffness();
    let mut tableau = Tableau::new(&stiffness);
    for (i, condition) in [(0, Free(0.3)), (2, Held(1e-4)), (4, Free(0.0)), (5, Free(0.0)), (6, Free(-0.5))] {
        tableau.set(i, condition);
    }
    let loads = Matrix::from_fn(2, N, |k, i| LOAD[(i + k) % N]);
    tableau.remember(loads.clone());
    let (weights, mut rest) = (vec![0.75, -2.0], vec![0.0; N]);
    (rest[4], rest[7]) = (3.0, -1.0);
    let load: Vec<f64> = (0..N).map(|i| 0.75 * loads[(0, i)] - 2.0 * loads[(1, i)] + rest[i]).collect();
    let combination = Combination { weights, rest };
    let solutions = |tableau: &mut Tableau| {
        [None, Some(&combination)].map(|combination| {
            let (mut jump, mut contact) = ([0.0; N], [0.0; N]);
            tableau.solve(&load, combination, &mut jump, &mut contact).unwrap();
            (jump, contact)
        })
    };
    // Before a new base, with it, and where the base is another than when the loads were remembered.
    for step in 0..3 {
        let [plain, combined] = solutions(&mut tableau);
        for i in 0..N {
            assert!((plain.0[i] - combined.0[i]).abs() < 1e-17, "{step}, {i}");
            assert!((plain.1[i] - combined.1[i]).abs() < 1e-12, "{step}, {i}");
        }
        tableau.set(3, if step == 0 { Held(0.0) } else { Free(0.0) });
        tableau.rebase().unwrap();
    }
}

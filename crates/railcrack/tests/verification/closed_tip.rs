//! A closed tip has K_I = 0, and an open one K_I > 0.

use crate::common::{Absolute, Rolling, close, largest, surface_crack};
use railcrack::contact::{ContactSolver, FaceStatus, Latin, Newton};
use railcrack::crack::End;

#[test]
fn closed_tips_have_no_opening_mode() {
    let kinked = surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, -1.0).unwrap();
    let cases = [
        (surface_crack(0.0, 6.0, 15.0), 0.5, 0.025),
        (surface_crack(0.0, 6.0, 15.0), 0.1, 0.4),
        (surface_crack(0.0, 6.0, 45.0), 0.8, -0.4),
        (surface_crack(0.0, 6.0, 165.0), 0.5, 0.1),
        (kinked, 0.5, 0.1),
    ];
    for (crack, friction, wheel) in cases {
        for (name, solver) in
            [("newton", &Newton::default() as &dyn ContactSolver), ("latin", &Latin::default())]
        {
            let rolling = Rolling::over(vec![crack.clone()], friction, wheel);
            let result = rolling.solve_by(solver);
            let peak = result.histories[0].samples.iter().fold(0.0f64, |m, k| m.max(k.kii.abs()));
            let passage = &result.passages[result.passages.len() - 1];
            let closed: Vec<f64> = (passage.sifs[0].iter().zip(&result.faces.states))
                .filter(|(_, states)| states[states.len() - 1].status != FaceStatus::Open)
                .map(|(k, _)| k.ki / peak)
                .collect();
            // An unstable multiplier space would show as some per cent; LATIN's indicator on K is
            // 1e-9 between two iterations.
            close(largest(closed.iter().copied()), 0.0, Absolute(3e-8), name);
            assert!(closed.len() > 100, "{name}: closed at {} positions only", closed.len());
            let negative = result.histories[0].samples.iter().fold(0.0f64, |m, k| m.max(-k.ki)) / peak;
            let violation = result.counts.complementarity_max;
            close(violation, 0.0, Absolute(1e-9), "largest violation of the contact conditions");
            close(negative, 0.0, Absolute(3e-8), "faces never overlap at the tip");
        }
    }
}

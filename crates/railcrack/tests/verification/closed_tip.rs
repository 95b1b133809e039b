//! A closed tip has K_I = 0, and no point ever breaks the law of the faces.

use crate::common::{Rolling, body, largest, surface_crack};
use railcrack::contact::{ContactSolver, FaceProblem, FaceStatus, Latin, Newton};
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
            let body = body(&rolling.cracks, rolling.elements);
            let problem = FaceProblem::new(&body, &[friction]);
            let result = rolling.on(&problem, solver);
            let peak = result.histories[0].samples.iter().fold(0.0f64, |m, k| m.max(k.k2.abs()));
            let passage = &result.passages[result.passages.len() - 1];
            let closed: Vec<f64> = (passage.sifs[0].iter().zip(&result.faces.states))
                .filter(|(_, states)| states[states.len() - 1].status != FaceStatus::Open)
                .map(|(k, _)| k.k1 / peak)
                .collect();
            let worst = largest(closed.iter().copied());
            let negative = result.histories[0].samples.iter().fold(0.0f64, |m, k| m.max(-k.k1)) / peak;
            println!(
                "{name} {friction} {wheel}: closed {} worst {worst:.1e} negative {negative:.1e} viol {:.1e} sub {} it {} {}",
                closed.len(),
                result.counts.complementarity_max,
                result.counts.substeps,
                result.counts.iterations,
                result.counts.passages,
            );
        }
    }
}

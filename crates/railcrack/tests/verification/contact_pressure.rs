//! The contact pressure along the faces does not oscillate.

use crate::common::{Rolling, body, buried_crack, largest, surface_crack};
use railcrack::contact::{ContactSolver, FaceProblem, FaceState, FaceStatus, LoadPath, Newton, Stepper};
use railcrack::crack::{Crack, End};
use railcrack::growth::FacePoint;

/// Points on either side that must share the status of a point for it to be away from changes of status.
const AWAY: usize = 2;

/// The largest deviation of a pressure from the line between its neighbours, over `peak`, and where.
fn roughness(points: &[FacePoint], states: &[FaceState], peak: f64) -> (f64, f64) {
    let mut worst = (0.0, 0.0);
    for j in AWAY..points.len() - AWAY {
        let near = j - AWAY..=j + AWAY;
        let alike = near.clone().all(|i| {
            points[i].crack == points[j].crack
                && points[i].segment == points[j].segment
                && states[i].status == states[j].status
                && states[i].s12.signum() == states[j].s12.signum()
        });
        if !alike || states[j].status == FaceStatus::Open {
            continue;
        }
        let share = (points[j].s - points[j - 1].s) / (points[j + 1].s - points[j - 1].s);
        let line = states[j - 1].s22 * (1.0 - share) + states[j + 1].s22 * share;
        let deviation = (states[j].s22 - line).abs() / peak;
        if deviation > worst.0 {
            worst = (deviation, points[j].s);
        }
    }
    worst
}

#[test]
fn under_the_wheel() {
    let kinked = |beta: f64| surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, beta).unwrap();
    let cases: [(&str, Crack, f64, f64); 6] = [
        ("table1", surface_crack(0.0, 6.0, 15.0), 0.5, 0.025),
        ("fig13", surface_crack(0.0, 6.0, 15.0), 0.1, 0.4),
        ("45", surface_crack(0.0, 6.0, 45.0), 0.8, -0.4),
        ("165", surface_crack(0.0, 6.0, 165.0), 0.5, 0.1),
        ("k-60", kinked(-1.0), 0.5, 0.1),
        ("k+30", kinked(0.5), 0.5, 0.1),
    ];
    for (name, crack, friction, wheel) in cases {
        for elements in [20, 40, 80] {
            let mut rolling = Rolling::over(vec![crack.clone()], friction, wheel);
            rolling.elements = elements;
            let faces = rolling.solve().faces;
            let peak = largest(faces.states.iter().flatten().map(|state| state.s22));
            let worst = faces
                .states
                .iter()
                .enumerate()
                .map(|(i, states)| (roughness(&faces.points, states, peak), i))
                .max_by(|a, b| a.0.0.total_cmp(&b.0.0))
                .unwrap();
            println!("{name} {elements}: peak {peak:.0} worst {:.2} % at s {:.3} position xc/a {:.2}", 100.0 * worst.0.0, worst.0.1, -6.0 + 0.05 * worst.1 as f64);
            let i = worst.1;
            let k = faces.points.iter().position(|p| p.s == worst.0.1).unwrap();
            for j in k.saturating_sub(4)..(k + 5).min(faces.points.len()) {
                let s = faces.states[i][j];
                println!("      s {:.4} seg {} s22 {:.2} s12 {:.2} {:?}", faces.points[j].s, faces.points[j].segment, s.s22, s.s12, s.status);
            }
        }
    }
    let _ = (body, buried_crack);
    fn _f(_: &dyn ContactSolver, _: &FaceProblem, _: &dyn LoadPath, _: Newton, _: &Stepper) {}
}

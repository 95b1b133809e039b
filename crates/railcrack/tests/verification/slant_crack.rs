//! Slant cracks far from the surface: the closed forms of the infinite plate.

use crate::common::{Of, body, buried_crack, close, default_elements, open_sifs, steel};
use railcrack::body::CrackedBody;
use railcrack::contact::{ContactSolver, FaceProblem, Latin, LoadPath, Newton, Stepper};
use railcrack::math::{Stress, Vec2};
use std::f64::consts::PI;

const HALF: f64 = 3.0;
/// Depth over half-length 1000: the free surface changes K by about its square, 1e-6.
const CENTRE: Vec2 = Vec2::new(0.0, -3000.0);

/// K = σ√(πa): the scale of all that follows, for 1 MPa.
fn unit() -> f64 {
    (PI * HALF).sqrt()
}

/// In tension σ_yy = σ: K_I = σ√(πa) cos²α, K_II = σ√(πa) cos α sin α at both tips: τ12 = σ cos α
/// sin α ahead of either.
#[test]
fn open_in_tension() {
    for degrees in [0.0, 20.0, 45.0, 70.0, -20.0, -60.0, 135.0, 200.0_f64] {
        let tension = Stress { yy: 1.0, ..Stress::ZERO };
        let k = open_sifs(&[buried_crack(CENTRE, HALF, degrees)], default_elements(), |_| tension);
        let (sin, cos) = degrees.to_radians().sin_cos();
        for tip in [0, 1] {
            let reason = "the jump sin g by linear elements that grow from the tips";
            close(k[2 * tip], unit() * cos * cos, Of(2e-4, unit()), reason);
            close(k[2 * tip + 1], unit() * cos * sin, Of(2e-4, unit()), reason);
        }
    }
}

/// σ_yy = −`at` MPa.
struct Compression<'a>(&'a CrackedBody);

impl LoadPath for Compression<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        self.0.faces.nodal_forces(|_| Stress { yy: -at, ..Stress::ZERO })
    }
}

/// In compression the faces close and slip: K_I = 0, K_II = (|τ| − μ|σ_n|)√(πa) with the sign of τ,
/// no slip where |τ| < μ|σ_n|.
#[test]
fn closed_in_compression() {
    let solvers: [&dyn ContactSolver; 2] = [&Newton::default(), &Latin::default()];
    for (degrees, friction) in
        [(45.0, 0.0), (45.0, 0.3), (60.0, 0.5), (-30.0, 0.2), (-60.0, 0.8), (20.0, 0.5_f64)]
    {
        let body = body(&[buried_crack(CENTRE, HALF, degrees)], default_elements());
        let problem = FaceProblem::new(&body, &[friction]).unwrap();
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let (normal, shear) = (-cos * cos, -sin * cos);
        let want = (shear.abs() - friction * normal.abs()).max(0.0) * shear.signum() * unit();
        for solver in solvers {
            let expected = vec![unit() / steel().young(); problem.points()];
            let mut stepper = Stepper::new(&problem, solver, 2e-3, &expected);
            for station in [0.25, 0.5, 0.75, 1.0] {
                stepper.advance(&Compression(&body), station, &mut |_, _| {}).unwrap();
            }
            let k = stepper.solution().sifs(&body, stepper.load());
            for tip in [0, 1] {
                close(k[tip].ki, 0.0, Of(1e-9, unit()), "closed tip: round-off, the indicator of LATIN");
                close(k[tip].kii, want, Of(5e-4, unit()), "as the open crack");
            }
        }
    }
}

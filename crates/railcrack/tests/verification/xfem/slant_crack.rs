//! Slant cracks far from the surface: the closed forms of the infinite plate.

use crate::common::{Meshed, Of, buried_crack, close, sifs_under, steel};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, LoadPath, Newton, Stepper};
use railcrack::math::{Stress, Vec2};
use std::f64::consts::PI;

const HALF: f64 = 3.0;
/// The surface changes K by about (half-length / depth)², 1e-4 at a hundred half-lengths.
const CENTRE: Vec2 = Vec2::new(0.0, -300.0);
/// Error of K at the defaults, over σ√(πa).
const ERROR: f64 = 3e-3;

fn unit() -> f64 {
    (PI * HALF).sqrt()
}

fn body(degrees: f64) -> CrackedBody {
    Meshed::still().body(&[buried_crack(CENTRE, HALF, degrees)])
}

/// In tension σ_yy = σ: K_I = σ√(πa) cos²α, K_II = σ√(πa) cos α sin α at both tips.
#[test]
fn open_in_tension() {
    for degrees in [0.0, 20.0, 45.0, 70.0, -60.0, 135.0_f64] {
        let k = sifs_under(&body(degrees), |_| Stress { yy: 1.0, ..Stress::ZERO });
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (k1, k2) = (unit() * cos * cos, unit() * cos * sin);
        println!("{degrees}°: {:?}", [k[0] - k1, k[1] - k2, k[2] - k1, k[3] - k2].map(|e| e / unit()));
        for tip in [0, 1] {
            close(k[2 * tip], k1, Of(ERROR, unit()), "default elements");
            close(k[2 * tip + 1], k2, Of(ERROR, unit()), "default elements");
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

/// K_I of a closed tip over σ√(πa).
const CLOSED: f64 = 5e-3;

/// In compression the faces close and slip: K_I = 0, K_II = (|τ| − μ|σ_n|)√(πa) with the sign of τ.
#[test]
fn closed_in_compression() {
    for (degrees, friction) in
        [(45.0, 0.0), (45.0, 0.3), (60.0, 0.5), (-30.0, 0.2), (-60.0, 0.8), (20.0, 0.5_f64)]
    {
        let body = body(degrees);
        let problem = FaceProblem::new(&body, &[friction]).unwrap();
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let (normal, shear) = (-cos * cos, -sin * cos);
        let want = (shear.abs() - friction * normal.abs()).max(0.0) * shear.signum() * unit();
        let expected = vec![unit() / steel().young(); problem.points()];
        let mut stepper = Stepper::new(&problem, &Newton::default(), 2e-3, &expected);
        for station in [0.25, 0.5, 0.75, 1.0] {
            stepper.advance(&Compression(&body), station, &mut |_, _| {}).unwrap();
        }
        let k = stepper.solution().sifs(&body, stepper.load());
        for k in k {
            println!(
                "{degrees}°, friction {friction}: K_I {:+.2e}, K_II {:+.2e}",
                k.ki / unit(),
                (k.kii - want) / unit()
            );
            close(k.ki, 0.0, Of(CLOSED, unit()), "closed tip");
            close(k.kii, want, Of(ERROR, unit()), "as the open crack");
        }
    }
}

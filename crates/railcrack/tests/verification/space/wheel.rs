//! Stress under an elliptical contact against the equations of elasticity.

use crate::common::{Of, close};
use railcrack::space::EllipticWheel;

const NU: f64 = 0.3;
/// Step of the second differences, mm.
const STEP: f64 = 0.1;

/// Beltrami's and Michell's equations, ∇²σ_ij + ∂_i ∂_j σ_kk / (1 + ν) = 0: with equilibrium, the
/// tractions of the surface and no stress far away they leave one field, for any pressure and
/// shear.
#[test]
fn compatible_under_pressure_and_shear() {
    let wheel = EllipticWheel {
        peak_pressure: 1000.0,
        half_width: 5.0,
        lateral_half_width: 8.0,
        lateral: 0.5,
        friction: 0.3,
        lateral_friction: -0.2,
    };
    let components = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
    for point in [[1.0, 2.0, 2.5], [6.0, 3.0, 3.0], [-9.0, 7.0, 4.0], [2.0, -9.0, 3.0]] {
        let at = |i: usize, j: usize, one: f64, other: f64| {
            let mut moved = point;
            moved[i] += one * STEP;
            moved[j] += other * STEP;
            wheel.stress(0.0, moved, NU)
        };
        // ∂_i ∂_j of all components.
        let second = |i: usize, j: usize| -> [f64; 6] {
            let (pp, pm, mp, mm) =
                (at(i, j, 1.0, 1.0), at(i, j, 1.0, -1.0), at(i, j, -1.0, 1.0), at(i, j, -1.0, -1.0));
            std::array::from_fn(|c| (pp[c] - pm[c] - mp[c] + mm[c]) / (4.0 * STEP * STEP))
        };
        let laplacian: [f64; 6] = std::array::from_fn(|c| (0..3).map(|i| second(i, i)[c]).sum());
        let of_trace: [f64; 6] = components.map(|(i, j)| second(i, j)[..3].iter().sum::<f64>() / (1.0 + NU));
        let scale = of_trace.iter().chain(&laplacian).fold(0.0f64, |m, v| m.max(v.abs()));
        for c in 0..6 {
            close(laplacian[c] + of_trace[c], 0.0, Of(0.02, scale), "second differences over 0.2 mm");
        }
    }
}

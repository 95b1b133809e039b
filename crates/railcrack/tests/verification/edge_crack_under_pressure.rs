//! An edge crack normal to the surface with pressure on its faces, and the same crack in a residual
//! stress.

use crate::common::{Of, Relative, Rolling, close, column, default_elements, open_sifs, rows, surface_crack};
use railcrack::field::DepthProfile;
use railcrack::math::Stress;
use std::f64::consts::PI;

const LENGTH: f64 = 6.0;

fn factors() -> Vec<f64> {
    column(&rows("edge-crack-pressure/factors.csv"), "f1")
}

#[test]
fn polynomial_pressure() {
    for (n, f) in factors().into_iter().enumerate() {
        let k = open_sifs(&[surface_crack(0.0, LENGTH, 90.0)], default_elements(), |point| Stress {
            xx: (-point.y / LENGTH).powi(n as i32),
            ..Stress::ZERO
        });
        let reason = "second order in the elements: 3e-5 for n = 0, growing with n to 6e-4";
        close(k[0], f * (PI * LENGTH).sqrt(), Relative(1e-3), reason);
        close(k[1], 0.0, Of(1e-12, k[0]), "symmetric up to round-off");
    }
}

/// A residual stress that by itself holds the crack open loads it like tractions on its faces:
/// 200 − 150 (d/l) MPa are two polynomial pressures. The state before the wheel arrives is the
/// first sample of the history.
#[test]
fn residual_stress_alone() {
    let profile = DepthProfile::new(vec![(0.0, 200.0, 0.0), (2.0 * LENGTH, -100.0, 0.0)]).unwrap();
    let mut rolling = Rolling::over(vec![surface_crack(0.0, LENGTH, 90.0)], 0.5, 0.0);
    rolling.residual = Some(&profile);
    let unloaded = rolling.solve().histories[0].samples[0];
    let factors = factors();
    let want = (200.0 * factors[0] - 150.0 * factors[1]) * (PI * LENGTH).sqrt();
    close(unloaded.ki, want, Relative(1e-3), "equal to the polynomial pressures");
    close(unloaded.kii, 0.0, Of(1e-12, want), "symmetric up to round-off");
}

//! Edge cracks in tension at all angles, and under polynomial pressure.

use crate::common::{
    Absolute, Meshed, Of, Relative, TENSION, close, column, largest, rows, sifs_under, surface_crack,
};
use railcrack::math::Stress;
use std::f64::consts::PI;

const LENGTH: f64 = 6.0;

/// Error of K at the defaults, over K_I.
const TENSION_ERROR: f64 = 3e-3;

#[test]
fn tension_by_angle() {
    let table = rows("edge-crack-tension/factors.csv");
    let reference = column(&table, "f1").into_iter().zip(column(&table, "f2"));
    let scale = (PI * LENGTH).sqrt();
    for (degrees, (f1, f2)) in column(&table, "angle_deg").into_iter().zip(reference) {
        // The mirrored crack on a mesh without room for growth.
        let meshes = [Meshed::default(), Meshed::still()];
        for ((angle, sign), meshed) in [(degrees, 1.0), (180.0 - degrees, -1.0)].into_iter().zip(meshes) {
            let k = sifs_under(&meshed.body(&[surface_crack(2.0, LENGTH, angle)]), |_| TENSION);
            let errors = [k[0] / scale - f1, k[1] / scale - sign * f2].map(|error| error / f1);
            println!("{angle}°: K_I {:+.3} %, K_II {:+.3} % of K_I", 100.0 * errors[0], 100.0 * errors[1]);
            let reason = "default elements; the reference has five decimals";
            close(largest(errors), 0.0, Absolute(TENSION_ERROR), reason);
        }
    }
}

/// Error of K at the defaults: pressures that grow towards the tip are represented by linear
/// tractions between face points.
const PRESSURE_ERROR: f64 = 3e-3;

#[test]
fn polynomial_pressure() {
    let body = Meshed::default().body(&[surface_crack(0.0, LENGTH, 90.0)]);
    for (n, f) in column(&rows("edge-crack-pressure/factors.csv"), "f1").into_iter().enumerate() {
        let k = sifs_under(&body, |point| Stress { xx: (-point.y / LENGTH).powi(n as i32), ..Stress::ZERO });
        let want = f * (PI * LENGTH).sqrt();
        println!("n = {n}: {:+.4} %", 100.0 * (k[0] / want - 1.0));
        close(k[0], want, Relative(PRESSURE_ERROR), "default elements");
        close(k[1], 0.0, Of(1e-3, k[0]), "the mesh is not symmetric about the crack");
    }
}

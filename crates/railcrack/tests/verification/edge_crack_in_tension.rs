//! Straight edge cracks in tension, at all angles.

use crate::common::{
    Absolute, Of, TENSION, close, column, default_elements, open_sifs, order, rows, surface_crack,
};
use std::f64::consts::PI;

/// Koiter (1965).
const NORMAL_CRACK: f64 = 1.121_522_255_2;

fn factors(degrees: f64, elements: usize) -> (f64, f64) {
    const LENGTH: f64 = 6.0;
    let k = open_sifs(&[surface_crack(2.0, LENGTH, degrees)], elements, |_| TENSION);
    let scale = (PI * LENGTH).sqrt();
    (k[0] / scale, k[1] / scale)
}

#[test]
fn factors_by_angle() {
    let table = rows("edge-crack-tension/factors.csv");
    let reference = column(&table, "f1").into_iter().zip(column(&table, "f2"));
    for (degrees, (f1, f2)) in column(&table, "angle_deg").into_iter().zip(reference) {
        let (k1, k2) = factors(degrees, default_elements());
        let reason = "default elements; the reference has five decimals";
        close(k1, f1, Of(3e-4, f1), reason);
        close(k2, f2, Of(3e-4, f1), reason);
    }
}

#[test]
fn mirrored() {
    for degrees in column(&rows("edge-crack-tension/factors.csv"), "angle_deg") {
        let (k1, k2) = factors(degrees, default_elements());
        let (mirrored_k1, mirrored_k2) = factors(180.0 - degrees, default_elements());
        close(mirrored_k1, k1, Absolute(1e-11), "round-off of the inverse");
        close(mirrored_k2, -k2, Absolute(1e-11), "K_II changes sign");
    }
}

#[test]
fn second_order_in_the_elements() {
    let errors: Vec<f64> =
        [20, 40, 80].into_iter().map(|elements| factors(90.0, elements).0 - NORMAL_CRACK).collect();
    for pair in errors.windows(2) {
        // Linear elements in √r, K from the first node, whose element shrinks with the others: at
        // least second order.
        assert!(order(pair[0], pair[1]) > 1.8, "order of convergence: {pair:?}");
    }
}

//! Two equal collinear cracks far below the surface, b < |x| < c: closed form with elliptic
//! integrals.

use crate::common::{Absolute, Relative, buried_crack, close, default_elements, open_sifs, order};
use railcrack::math::{Stress, Vec2};
use std::f64::consts::PI;

/// E(k)/K(k) by the arithmetic–geometric mean (Abramowitz & Stegun 17.6).
fn second_over_first(k: f64) -> f64 {
    let (mut a, mut b, mut c) = (1.0, (1.0 - k * k).sqrt(), k);
    let (mut sum, mut power) = (0.0, 0.5);
    while c.abs() > 1e-16 {
        sum += power * c * c;
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
    }
    1.0 - sum
}

/// K at the inner and outer tips over σ (Tada, Paris & Irwin, Stress Analysis of Cracks Handbook,
/// two equal collinear cracks).
fn closed_form(b: f64, c: f64) -> (f64, f64) {
    let k = (1.0 - (b / c).powi(2)).sqrt();
    let ratio = second_over_first(k);
    let inner = (PI * b).sqrt() * ((c / b).powi(2) * ratio - 1.0) / ((c / b).powi(2) - 1.0).sqrt();
    let outer = (PI * c).sqrt() * (1.0 - ratio) / k;
    (inner, outer)
}

fn sifs(b: f64, c: f64, elements: usize) -> Vec<f64> {
    let (middle, half) = (0.5 * (b + c), 0.5 * (c - b));
    let crack = |x: f64| buried_crack(Vec2::new(x, -4000.0), half, 0.0);
    let stress = Stress { yy: 1.0, xy: 0.5, ..Stress::ZERO };
    open_sifs(&[crack(-middle), crack(middle)], elements, |_| stress)
}

#[test]
fn inner_and_outer_tips_in_both_modes() {
    for (b, c, allowed) in [(1.0, 4.0, 1e-3), (0.2, 4.0, 2e-3)] {
        let k = sifs(b, c, default_elements());
        let (inner, outer) = closed_form(b, c);
        let reason = "as for one crack; more at tips a tenth of the length apart";
        for (tip, want) in [(0, outer), (1, inner), (2, inner), (3, outer)] {
            close(k[2 * tip], want, Relative(allowed), reason);
            close(k[2 * tip + 1], 0.5 * want, Relative(allowed), reason);
        }
    }
}

/// Tips a hundredth of the length apart.
#[test]
fn closely_spaced_tips() {
    let (inner, _) = closed_form(0.02, 4.0);
    let errors = [7, 14, 28].map(|elements| sifs(0.02, 4.0, elements)[2] / inner - 1.0);
    for pair in errors.windows(2) {
        assert!(order(pair[0], pair[1]) > 1.8, "order of convergence: {pair:?}");
    }
    close(errors[2], 0.0, Absolute(3e-4), "default elements");
}

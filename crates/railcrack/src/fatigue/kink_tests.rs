//! Comparison of the kink functions with an independent solution of the kinked crack.

use super::*;
use std::ops::{Add, Div, Mul, Sub};

#[derive(Debug, Clone, Copy)]
struct Complex {
    re: f64,
    im: f64,
}

fn c(re: f64, im: f64) -> Complex {
    Complex { re, im }
}

impl Complex {
    fn conj(self) -> Self {
        c(self.re, -self.im)
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        c(self.re + o.re, self.im + o.im)
    }
}
impl Sub for Complex {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        c(self.re - o.re, self.im - o.im)
    }
}
impl Mul for Complex {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        c(self.re * o.re - self.im * o.im, self.re * o.im + self.im * o.re)
    }
}
impl Div for Complex {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let n = o.re * o.re + o.im * o.im;
        self * c(o.re / n, -o.im / n)
    }
}

/// k1 − i k2 of an infinitesimal kink for K_I − i K_II = `far`, from its exact integral equation.
///
/// ω(ζ) = −(ζ+1)^(1−m) (ζ−1)^(1+m) maps the upper half-plane onto the plane cut along the negative
/// axis and a kink at β = mπ; its corner is at ζ = ±1, its tip at ζ = −m. On the real axis ω/conj
/// ω′ = κ R with R = (ζ²−1) / (2 (ζ+m)), κ = e^(2iβ) on the kink and 1 elsewhere. Traction-free
/// faces, φ + κ R conj φ′ + conj ψ = const, give for u = φ′(ζ)
///
/// u(ζ) = C − (κ−1)/(2πi) ∫ R(t) conj u(t̄) / (t−ζ)² dt,  C = −i (K_I − i K_II)/√(2π),
///
/// with t on any path from −1 to 1 below the tip: here the lower half of the unit circle, with ζ on
/// the upper half. Then k1 − i k2 = i √(2π) u(−m) e^(−iβ) / B, B² = (1−m)^(−m) (1+m)^m. `steps`
/// points in each direction, condensed exponentially at both ends, integrate by the trapezoidal
/// rule.
fn mapped_kink(beta: f64, far: Complex, steps: i32) -> Complex {
    let m = beta / PI;
    let jump = c((2.0 * beta).cos() - 1.0, (2.0 * beta).sin()) / c(0.0, 2.0 * PI);
    let constant = c(0.0, -1.0) * far * c(1.0 / (2.0 * PI).sqrt(), 0.0);
    // At |x| = 20 the ends are 4e-9 away, where R/(t−ζ)² contributes its square.
    let h = 20.0 / f64::from(steps);
    let nodes: Vec<(Complex, Complex)> = (-steps..=steps)
        .map(|i| {
            let x = h * f64::from(i);
            let theta = PI / (1.0 + (-x).exp());
            let speed = theta * (1.0 - theta / PI) * h;
            (c(-theta.cos(), -theta.sin()), c(theta.sin() * speed, -theta.cos() * speed))
        })
        .collect();
    let kernel = |t: Complex, dt: Complex, zeta: Complex| {
        let r = (t * t - c(1.0, 0.0)) / (c(2.0, 0.0) * (t + c(m, 0.0)));
        jump * r * dt / ((t - zeta) * (t - zeta))
    };
    // Real unknowns Re u, Im u at ζ = t̄ of every node.
    let n = nodes.len();
    let mut a = vec![vec![0.0; 2 * n + 1]; 2 * n];
    for i in 0..n {
        let zeta = nodes[i].0.conj();
        for (j, &(t, dt)) in nodes.iter().enumerate() {
            let k = kernel(t, dt, zeta);
            a[2 * i][2 * j] += k.re;
            a[2 * i][2 * j + 1] += k.im;
            a[2 * i + 1][2 * j] += k.im;
            a[2 * i + 1][2 * j + 1] -= k.re;
        }
        a[2 * i][2 * i] += 1.0;
        a[2 * i + 1][2 * i + 1] += 1.0;
        a[2 * i][2 * n] = constant.re;
        a[2 * i + 1][2 * n] = constant.im;
    }
    let u = solved(a);
    let tip = c(-m, 0.0);
    let at_tip = nodes
        .iter()
        .enumerate()
        .fold(constant, |sum, (j, &(t, dt))| sum - kernel(t, dt, tip) * c(u[2 * j], -u[2 * j + 1]));
    let b = ((1.0 - m).powf(-m) * (1.0 + m).powf(m)).sqrt();
    c(0.0, (2.0 * PI).sqrt() / b) * at_tip * c(beta.cos(), -beta.sin())
}

/// Gaussian elimination with row pivoting of n rows with n + 1 columns, the last the right-hand
/// side.
fn solved(mut a: Vec<Vec<f64>>) -> Vec<f64> {
    let n = a.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        let (top, below) = a.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / top[k][k];
            for (x, y) in row[k..].iter_mut().zip(&top[k][k..]) {
                *x -= factor * y;
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * x[j]).sum();
        x[k] = (a[k][n] - known) / a[k][k];
    }
    x
}

fn mapped_functions(angle: f64, steps: i32) -> KinkFunctions {
    let mode_1 = mapped_kink(angle, c(1.0, 0.0), steps);
    let mode_2 = mapped_kink(angle, c(0.0, -1.0), steps);
    KinkFunctions { f11: mode_1.re, f12: mode_2.re, f21: -mode_1.im, f22: -mode_2.im }
}

fn largest_difference(a: KinkFunctions, b: KinkFunctions) -> f64 {
    [a.f11 - b.f11, a.f12 - b.f12, a.f21 - b.f21, a.f22 - b.f22].iter().fold(0.0, |m, d| m.max(d.abs()))
}

#[test]
fn series_equals_the_mapped_kink() {
    // (degrees, tolerance): twice the measured error of the series, which is set by the last
    // printed digits.
    let cases = [
        (15.0, 1e-12),
        (-15.0, 1e-12),
        (45.0, 2e-10),
        (70.0, 6e-8),
        (-70.0, 6e-8),
        (90.0, 1e-5),
        (110.0, 6e-4),
    ];
    for (degrees, tolerance) in cases {
        let angle = f64::to_radians(degrees);
        let exact = mapped_functions(angle, 100);
        let error = largest_difference(KinkFunctions::at(angle), exact);
        assert!(error < tolerance, "{degrees} degrees: {error:e}");
        // The reference itself against a coarser rule: at most a hundredth of the tolerance.
        let reference = largest_difference(exact, mapped_functions(angle, 70));
        assert!(reference < 0.01 * tolerance, "{degrees} degrees: reference moves by {reference:e}");
    }
}

#[test]
fn largest_k1_of_mode_two_is_at_minus_76_6_degrees() {
    let k1 = |degrees: f64| KinkFunctions::at(degrees.to_radians()).kinked(Sif { ki: 0.0, kii: 1.0 }).k1;
    let best = (-1100..=1100).map(|i| 0.1 * f64::from(i)).max_by(|a, b| k1(*a).total_cmp(&k1(*b))).unwrap();
    assert!((best + 76.6).abs() < 0.06, "{best}"); // grid of 0.1°
    assert!((k1(best) - 1.2316).abs() < 1e-4, "{}", k1(best)); // digits quoted
}

#[test]
fn small_kinks_mirrored_kinks_and_no_kink() {
    assert_eq!(KinkFunctions::at(0.0), KinkFunctions { f11: 1.0, f12: 0.0, f21: 0.0, f22: 1.0 });
    let small = 1e-4;
    let f = KinkFunctions::at(small);
    // First order (Cotterell & Rice 1980): k1 = K_I − 3/2 β K_II, k2 = K_II + 1/2 β K_I; the
    // remainder is of order β².
    const SECOND_ORDER: f64 = 1e-7;
    assert!((f.f12 + 1.5 * small).abs() < SECOND_ORDER && (f.f21 - 0.5 * small).abs() < SECOND_ORDER);
    for degrees in [3.0, 40.0, 110.0_f64] {
        let (left, right) =
            (KinkFunctions::at(degrees.to_radians()), KinkFunctions::at(-degrees.to_radians()));
        assert_eq!((left.f11, left.f12, left.f21, left.f22), (right.f11, -right.f12, -right.f21, right.f22));
    }
}

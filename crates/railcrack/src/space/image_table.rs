//! Table of the twice integrated kernel of the image.
//!
//! On a plane that meets the surface, the stiffness A(s, s′, τ) of the image is homogeneous of
//! degree −3, and for a hat function that does not vanish at the mouth its double integral diverges
//! like that of the full space; only their sum is finite. Therefore the full space reflected
//! *within the plane*, s′ → −s′, is subtracted from the image: in the three diagonal components
//!
//!   Δ(s, s′, τ) = A_image(s, s′, τ) − A_full(s + s′, τ),
//!
//! The subtracted part belongs to the even continuation of the jump across the mouth, which has no
//! edge there. Then
//!
//!   Q(s, s′, τ) = ∫_s^∞ ∫_s′^∞ Δ
//!
//! is homogeneous of degree −1 and smooth but for s = s′ = τ = 0: a function of two variables,
//! tabulated by piecewise polynomials. A straight dislocation at the mouth is free of stress.
//! Therefore, in the components even in τ, Q(0, 0, τ) vanishes for τ ≠ 0 and is concentrated at τ =
//! 0; the odd components are c/τ.

use super::plane::PlaneFrame;
use crate::math::gauss_legendre;
use rayon::prelude::*;

/// Chebyshev points per panel and direction.
const POINTS: usize = 6;
/// Panels per direction.
const PANELS: usize = 10;
const NODES: usize = POINTS * PANELS;
/// Points of the quadrature on each panel.
const RULE: usize = 7;

type Kernel = [[f64; 3]; 3];
const ZERO: Kernel = [[0.0; 3]; 3];

/// Q for one dip angle and Poisson's ratio, in units of the shear modulus.
#[derive(Debug, Clone)]
pub struct ImageTable {
    /// Q(1, b, t): b and t from 0 to 1.
    depth: Vec<Kernel>,
    /// Q(a, b, 1): a and b from 0 to 1.
    trace: Vec<Kernel>,
}

impl ImageTable {
    /// The table for planes that descend at `dip` (radians).
    pub fn new(dip: f64, poisson: f64) -> Self {
        let frame = PlaneFrame::new(dip);
        let delta = |s: f64, other: f64, tau: f64| {
            let mut kernel = frame.image_stiffness(s, other, tau, poisson);
            let reflected = frame.kelvin_stiffness(s + other, tau, poisson);
            (0..3).for_each(|i| kernel[i][i] -= reflected[i][i]);
            kernel
        };
        let rule = gauss_legendre(RULE);
        let nodes = nodes();
        let columns: Vec<Vec<Kernel>> = nodes
            .par_iter()
            .map(|&t| {
                // Q(1, b, t): the quadrant a ≥ 1, then accumulated in b from 1 downwards.
                let corner = quadrant(&delta, t, &rule);
                cumulative(|b| tail(|a| delta(a, b, t), &rule), corner)
            })
            .collect();
        let depth = transposed(columns);
        // Q(a, b, 1), accumulated in a from 1 downwards, at the quadrature points in b.
        let corner = quadrant(&delta, 1.0, &rule);
        let row = |b: f64| {
            let at_one = tail(|a| delta(a, b, 1.0), &rule);
            cumulative(|a| delta(a, b, 1.0), at_one)
        };
        let beyond = cumulative(|a| tail(|b| delta(a, b, 1.0), &rule), corner);
        let samples: Vec<Vec<Kernel>> = panel_points().into_par_iter().map(row).collect();
        let trace = (0..NODES)
            .into_par_iter()
            .map(|i| {
                let along: Vec<Kernel> = samples.iter().map(|row| row[i]).collect();
                cumulated(&along, beyond[i])
            })
            .collect::<Vec<_>>();
        Self { depth, trace: trace.concat() }
    }

    /// ∫ Q(s, 0, τ) dτ over all τ, which does not depend on s: the part of Q(0, 0, τ) that is
    /// concentrated at τ = 0. Zero in the components that are odd in τ.
    pub fn concentrated(&self) -> Kernel {
        let mut sum = ZERO;
        let rule = gauss_legendre(RULE);
        for panel in 0..PANELS {
            for (x, w) in &rule {
                let t = (panel as f64 + x) / PANELS as f64;
                // τ = t up to 1, and beyond τ = 1/t.
                for (factor, q) in [(w, self.kernel(1.0, 0.0, t)), (&(w / t), self.kernel(t, 0.0, 1.0))] {
                    add(&mut sum, 2.0 * factor / PANELS as f64, &q);
                }
            }
        }
        for i in 0..2 {
            sum[i][2] = 0.0;
            sum[2][i] = 0.0;
        }
        sum
    }

    /// Q(s, s′, τ), in units of the shear modulus per mm; s, s′ ≥ 0, not all zero.
    pub fn kernel(&self, s: f64, other: f64, tau: f64) -> Kernel {
        let t = tau.abs();
        let mut q = if t >= s.max(other) {
            scaled(evaluate(&self.trace, s / t, other / t), 1.0 / t)
        } else if s >= other {
            scaled(evaluate(&self.depth, other / s, t / s), 1.0 / s)
        } else {
            // Reciprocity: Q_ij(s, s′, τ) = Q_ji(s′, s, −τ).
            let mut q = scaled(evaluate(&self.depth, s / other, t / other), 1.0 / other);
            q = std::array::from_fn(|i| std::array::from_fn(|j| q[j][i]));
            odd(&mut q);
            q
        };
        if tau < 0.0 {
            odd(&mut q);
        }
        q
    }
}

/// Changes the sign of the components odd in τ.
fn odd(q: &mut Kernel) {
    for i in 0..2 {
        q[i][2] = -q[i][2];
        q[2][i] = -q[2][i];
    }
}

fn scaled(q: Kernel, factor: f64) -> Kernel {
    q.map(|row| row.map(|v| v * factor))
}

fn add(sum: &mut Kernel, factor: f64, q: &Kernel) {
    for i in 0..3 {
        for j in 0..3 {
            sum[i][j] += factor * q[i][j];
        }
    }
}

/// Chebyshev points of one panel, on [0, 1].
fn chebyshev() -> [f64; POINTS] {
    std::array::from_fn(|k| 0.5 - 0.5 * (std::f64::consts::PI * (k as f64 + 0.5) / POINTS as f64).cos())
}

fn nodes() -> Vec<f64> {
    let points = chebyshev();
    (0..PANELS).flat_map(|p| points.map(|x| (p as f64 + x) / PANELS as f64)).collect()
}

/// Points of the quadrature of all panels.
fn panel_points() -> Vec<f64> {
    let rule = gauss_legendre(RULE);
    (0..PANELS)
        .flat_map(|p| rule.iter().map(move |(x, _)| (p as f64 + x) / PANELS as f64).collect::<Vec<_>>())
        .collect()
}

/// ∫_1^∞ f(a) da with a = 1/y, in three panels of y.
fn tail(f: impl Fn(f64) -> Kernel, rule: &[(f64, f64)]) -> Kernel {
    let mut sum = ZERO;
    for (from, to) in [(0.0, 0.4), (0.4, 0.75), (0.75, 1.0)] {
        for (x, w) in rule {
            let y = from + (to - from) * x;
            add(&mut sum, w * (to - from) / (y * y), &f(1.0 / y));
        }
    }
    sum
}

/// ∫_1^∞ ∫_1^∞ Δ(a, b, t) da db: by b = a β and a = b β, β from 1/a to 1.
fn quadrant(delta: &impl Fn(f64, f64, f64) -> Kernel, t: f64, rule: &[(f64, f64)]) -> Kernel {
    tail(
        |a| {
            let mut sum = ZERO;
            let from = 1.0 / a;
            for panel in 0..3 {
                let start = from + (1.0 - from) * f64::from(panel) / 3.0;
                let width = (1.0 - from) / 3.0;
                for (x, w) in rule {
                    let beta = start + width * x;
                    add(&mut sum, w * width * a, &delta(a, a * beta, t));
                    add(&mut sum, w * width * a, &delta(a * beta, a, t));
                }
            }
            sum
        },
        rule,
    )
}

/// at_one + ∫_b^1 f at all nodes b.
fn cumulative(f: impl Fn(f64) -> Kernel, at_one: Kernel) -> Vec<Kernel> {
    let samples: Vec<Kernel> = panel_points().into_iter().map(f).collect();
    cumulated(&samples, at_one)
}

/// The same from values at the quadrature points, by integrating the interpolating polynomial of
/// each panel.
fn cumulated(samples: &[Kernel], at_one: Kernel) -> Vec<Kernel> {
    let rule = gauss_legendre(RULE);
    let points = chebyshev();
    // weights[k][q]: ∫ from Chebyshev point k to 1 of the Lagrange polynomial q.
    let weights: Vec<Vec<f64>> = points
        .iter()
        .map(|&from| {
            (0..RULE)
                .map(|q| {
                    let lagrange = |x: f64| {
                        (0..RULE)
                            .filter(|&o| o != q)
                            .map(|o| (x - rule[o].0) / (rule[q].0 - rule[o].0))
                            .product::<f64>()
                    };
                    rule.iter().map(|(x, w)| w * (1.0 - from) * lagrange(from + (1.0 - from) * x)).sum()
                })
                .collect()
        })
        .collect();
    let width = 1.0 / PANELS as f64;
    let mut values = vec![ZERO; NODES];
    let mut above = at_one;
    for panel in (0..PANELS).rev() {
        let own = &samples[panel * RULE..(panel + 1) * RULE];
        for k in 0..POINTS {
            let mut value = above;
            own.iter().enumerate().for_each(|(q, f)| add(&mut value, width * weights[k][q], f));
            values[panel * POINTS + k] = value;
        }
        own.iter().zip(&rule).for_each(|(f, (_, w))| add(&mut above, width * w, f));
    }
    values
}

fn transposed(columns: Vec<Vec<Kernel>>) -> Vec<Kernel> {
    (0..NODES).flat_map(|i| columns.iter().map(move |column| column[i]).collect::<Vec<_>>()).collect()
}

/// The panel that contains `x` in [0, 1], and the interpolation weights of its points.
fn locate(x: f64) -> (usize, [f64; POINTS]) {
    let scaled = x * PANELS as f64;
    let panel = (scaled as usize).min(PANELS - 1);
    let local = scaled - panel as f64;
    // Lagrange polynomials as products, without division by a distance that may vanish.
    let points = CHEBYSHEV.get_or_init(Basis::new);
    let distance: [f64; POINTS] = std::array::from_fn(|k| local - points.points[k]);
    let mut before = [1.0; POINTS];
    let mut after = [1.0; POINTS];
    for k in 1..POINTS {
        before[k] = before[k - 1] * distance[k - 1];
        after[POINTS - 1 - k] = after[POINTS - k] * distance[POINTS - k];
    }
    (panel, std::array::from_fn(|k| before[k] * after[k] * points.scale[k]))
}

struct Basis {
    points: [f64; POINTS],
    scale: [f64; POINTS],
}

impl Basis {
    fn new() -> Self {
        let points = chebyshev();
        let scale = std::array::from_fn(|k| {
            1.0 / (0..POINTS).filter(|&o| o != k).map(|o| points[k] - points[o]).product::<f64>()
        });
        Self { points, scale }
    }
}

static CHEBYSHEV: std::sync::OnceLock<Basis> = std::sync::OnceLock::new();

fn evaluate(table: &[Kernel], x: f64, y: f64) -> Kernel {
    let ((px, wx), (py, wy)) = (locate(x), locate(y));
    let mut sum = [0.0; 9];
    for (k, w) in wx.iter().enumerate() {
        let row = &table[(px * POINTS + k) * NODES + py * POINTS..][..POINTS];
        let mut inner = [0.0; 9];
        for (value, v) in row.iter().zip(&wy) {
            let flat = value.as_flattened();
            (0..9).for_each(|c| inner[c] += v * flat[c]);
        }
        (0..9).for_each(|c| sum[c] += w * inner[c]);
    }
    std::array::from_fn(|i| std::array::from_fn(|j| sum[3 * i + j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 0.3;

    #[test]
    fn lines_at_the_mouth_have_no_energy() {
        for dip in [15f64, 30.0, 60.0, 90.0, 140.0] {
            let table = ImageTable::new(dip.to_radians(), NU);
            let q = table.kernel(0.0, 0.0, 1.0);
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)] {
                assert!(q[i][j].abs() < 1e-7, "{dip}: {q:?}");
            }
            for i in 0..2 {
                assert!((q[i][2] + q[2][i]).abs() < 1e-10, "{dip}: {q:?}");
            }
            let p = table.concentrated();
            assert!((p[0][1] - p[1][0]).abs() < 1e-6, "{dip}: {p:?}");
        }
    }

    #[test]
    fn values_by_another_quadrature() {
        let rule = gauss_legendre(60);
        // The reference rule is itself no more accurate than this where the image is close.
        for (dip, limit) in [(90f64, 1e-4), (30.0, 0.01)] {
            let table = ImageTable::new(dip.to_radians(), NU);
            let frame = PlaneFrame::new(dip.to_radians());
            for (s, other, tau) in [(1.0, 0.0, 0.3), (0.2, 0.0, 1.0), (0.5, 0.4, 1.0), (0.0, 0.7, 1.0)] {
                let mut want = ZERO;
                for (x, wx) in &rule {
                    for (y, wy) in &rule {
                        let (a, b) = (s + x / (1.0 - x), other + y / (1.0 - y));
                        let mut k = frame.image_stiffness(a, b, tau, NU);
                        let r = frame.kelvin_stiffness(a + b, tau, NU);
                        (0..3).for_each(|i| k[i][i] -= r[i][i]);
                        add(&mut want, wx * wy / ((1.0 - x) * (1.0 - y)).powi(2), &k);
                    }
                }
                let got = table.kernel(s, other, tau);
                for (got, want) in got.as_flattened().iter().zip(want.as_flattened()) {
                    assert!((got - want).abs() < limit, "{dip} {s} {other} {tau}: {got} {want}");
                }
            }
        }
    }

    #[test]
    fn its_mixed_derivative_is_the_kernel() {
        for dip in [15f64, 30.0, 90.0] {
            let table = ImageTable::new(dip.to_radians(), NU);
            let frame = PlaneFrame::new(dip.to_radians());
            for (s, other, tau) in
                [(1.3, 0.7, 0.4), (0.7, 1.3, 0.4), (0.7, 1.3, -0.4), (0.3, 0.2, 1.0), (1.0, 0.9, 0.11)]
            {
                // The second difference over a rectangle is compared with the integral over it.
                let h = 0.1;
                let q = |a: f64, b: f64| table.kernel(s + a * h, other + b * h, tau);
                let (pp, pm, mp, mm) = (q(1.0, 1.0), q(1.0, -1.0), q(-1.0, 1.0), q(-1.0, -1.0));
                let mut want = ZERO;
                let rule = gauss_legendre(8);
                for (x, wx) in &rule {
                    for (y, wy) in &rule {
                        let (a, b) = (s + h * (2.0 * x - 1.0), other + h * (2.0 * y - 1.0));
                        let mut k = frame.image_stiffness(a, b, tau, NU);
                        let r = frame.kelvin_stiffness(a + b, tau, NU);
                        (0..3).for_each(|i| k[i][i] -= r[i][i]);
                        add(&mut want, wx * wy * 4.0 * h * h, &k);
                    }
                }
                for i in 0..3 {
                    for j in 0..3 {
                        let got = pp[i][j] - pm[i][j] - mp[i][j] + mm[i][j];
                        assert!(
                            (got - want[i][j]).abs() < 1e-6,
                            "{dip} {s} {other} {i}{j}: {got} {}",
                            want[i][j]
                        );
                    }
                }
            }
        }
    }
}

//! Cauchy transforms of tractions that are linear between nodes, by a fast summation.

use num_complex::Complex64 as Complex;

/// The transforms P = ∫ p/(z − t) dt and Q = ∫ q/(z − t) dt at a point z, Im z ≤ 0, and their
/// derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Transforms {
    pub p: Complex,
    pub q: Complex,
    pub p_slope: Complex,
    pub q_slope: Complex,
}

/// A point at which the slopes of pressure and shear jump.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    t: f64,
    p_jump: f64,
    q_jump: f64,
}

/// Terms of the series of a cell. A cell expands what is at least 1/[`RATIO`] of its half-diagonal
/// away, so the first term that is left out is of the order of RATIO^TERMS/TERMS² = 4e-9.
const TERMS: usize = 12;
const RATIO: f64 = 0.3;
/// Number of nearby nodes above which a cell is divided.
const MOST_NEAR: usize = 2;
/// Largest number of divisions, after which a cell is 1e-9 of the table.
const DEEPEST: u32 = 32;
/// Distance in half-extents of the table beyond which the moments of the traction suffice;
/// successive terms decrease by this factor.
const FAR: f64 = 4.0;
/// Number of moments: FAR^−MOMENTS = 1e-8.
const MOMENTS: usize = 13;
/// Distance in half-extents beyond which the first [`FEW`] moments suffice: 8^−9 = 7e-9.
const FARTHER: f64 = 8.0;
const FEW: usize = 9;

/// Coefficients of w^k: Re P, Im P, Re Q, Im Q.
type Coefficients = [[f64; 4]; TERMS];

/// A square of the half-plane below the table.
#[derive(Debug, Clone, Copy)]
struct SeriesCell {
    x: f64,
    y: f64,
    half: f64,
    /// Index of the first of its four quarters; 0 for a cell that is not divided.
    parts: usize,
    /// Index of the series of an undivided cell.
    series: usize,
    /// Range of the nodes that are too close for the series.
    near: (usize, usize),
}

/// Tractions p and q on [−1, 1], linear between nodes and zero outside, as their transforms
///
/// P = Σ Δ_j (z − t_j) ln(z − t_j),  P′ = Σ Δ_j ln(z − t_j),
/// ∫ P dz = Σ Δ_j (z − t_j)² (ln(z − t_j)/2 − 1/4)
///
/// with Δ_j the jumps of slope at the nodes and −π ≤ arg ≤ 0: the sums over segments v
/// ln((z − t_j)/(z − t_(j+1))) − s L, by parts. Close to the table, nodes far from a cell of the
/// half-plane are summed once, as a series in the cell; far from it, moments take over.
#[derive(Debug, Clone)]
pub(super) struct TablePotential {
    nodes: Vec<Node>,
    cells: Vec<SeriesCell>,
    series: Vec<Coefficients>,
    /// ∫ p t^k dt, ∫ q t^k dt.
    moments: [[f64; 2]; MOMENTS],
}

impl TablePotential {
    /// The potential of rows (t, p, q) with t increasing in [−1, 1], without traction in the first
    /// and the last row.
    pub(super) fn new(rows: &[[f64; 3]]) -> Self {
        let slope = |i: usize, k: usize| (rows[i + 1][k] - rows[i][k]) / (rows[i + 1][0] - rows[i][0]);
        let last = rows.len() - 1;
        let jump = |i: usize, k: usize| {
            let after = if i < last { slope(i, k) } else { 0.0 };
            let before = if i > 0 { slope(i - 1, k) } else { 0.0 };
            after - before
        };
        let node = |i: usize| Node { t: rows[i][0], p_jump: jump(i, 1), q_jump: jump(i, 2) };
        let nodes: Vec<Node> =
            (0..rows.len()).map(node).filter(|node| node.p_jump != 0.0 || node.q_jump != 0.0).collect();
        let mut potential = Self { nodes, cells: Vec::new(), series: Vec::new(), moments: moments(rows) };
        let near = (0, potential.nodes.len());
        potential.cells.push(SeriesCell { x: 0.0, y: -FAR, half: FAR, parts: 0, series: 0, near });
        potential.divide(0, [[0.0; 4]; TERMS], near, 0);
        potential
    }

    /// Builds cell `i`; `near` are the nodes that were too close for the series of its parent.
    fn divide(&mut self, i: usize, mut series: Coefficients, near: (usize, usize), level: u32) {
        let SeriesCell { x, y, half, .. } = self.cells[i];
        let reach = std::f64::consts::SQRT_2 * half / RATIO;
        let beside = reach * reach - y * y;
        let within = if beside > 0.0 { beside.sqrt() } else { 0.0 };
        let close = &self.nodes[near.0..near.1];
        let own = if beside > 0.0 {
            let from = close.partition_point(|node| node.t <= x - within);
            let to = close.partition_point(|node| node.t < x + within);
            (near.0 + from, near.0 + to)
        } else {
            (near.0, near.0)
        };
        for j in (near.0..own.0).chain(own.1..near.1) {
            expand(&self.nodes[j], Complex::new(x, y), half, &mut series);
        }
        self.cells[i].near = own;
        if own.1 - own.0 <= MOST_NEAR || level == DEEPEST {
            self.cells[i].series = self.series.len();
            self.series.push(series);
            return;
        }
        let first = self.cells.len();
        self.cells[i].parts = first;
        let quarter = 0.5 * half;
        let sides = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        for (sx, sy) in sides {
            let (x, y) = (x + sx * quarter, y + sy * quarter);
            self.cells.push(SeriesCell { x, y, half: quarter, parts: 0, series: 0, near: own });
        }
        for (k, (sx, sy)) in sides.into_iter().enumerate() {
            self.divide(first + k, shifted(&series, 0.5 * sx, 0.5 * sy), own, level + 1);
        }
    }

    /// The transforms at x + i y, y ≤ 0.
    #[inline(always)]
    pub(super) fn at(&self, x: f64, y: f64) -> Transforms {
        let square = x * x + y * y;
        if square >= FARTHER * FARTHER {
            return far(&self.moments[..FEW], x, y);
        }
        if square >= FAR * FAR {
            return far(&self.moments, x, y);
        }
        let mut cell = &self.cells[0];
        while cell.parts != 0 {
            let part = usize::from(x > cell.x) + 2 * usize::from(y > cell.y);
            cell = &self.cells[cell.parts + part];
        }
        let mut sum = evaluate(&self.series[cell.series], x - cell.x, y - cell.y, 1.0 / cell.half);
        for node in &self.nodes[cell.near.0..cell.near.1] {
            node.add(x, y, &mut sum);
        }
        sum
    }

    /// The transforms at x + i y, y ≤ 0, node by node: the reference of the tests.
    #[cfg(test)]
    pub(super) fn directly(&self, x: f64, y: f64) -> Transforms {
        let mut sum = Transforms::default();
        self.nodes.iter().for_each(|node| node.add(x, y, &mut sum));
        sum
    }

    /// ∫ P dz and ∫ Q dz at z = x + i y, y ≤ 0; without a constant in their expansions about
    /// infinity.
    pub(super) fn integrals(&self, x: f64, y: f64) -> [Complex; 2] {
        let z = Complex::new(x, y);
        let [p0, q0] = self.moments[0];
        if z.norm_sqr() >= FAR * FAR {
            let per_z = z.inv();
            let mut power = per_z;
            let mut sum = [p0, q0].map(|load| lower_logarithm(x, y) * load);
            for (k, moment) in self.moments.iter().enumerate().skip(1) {
                for (sum, m) in sum.iter_mut().zip(moment) {
                    *sum -= power * (m / k as f64);
                }
                power *= per_z;
            }
            return sum;
        }
        // Far away the sum is p0 ln z + 3 p0/2 − …: (z − t)² ln(z − t)/2 has a term of t² (ln
        // z/2 + 3/4), and Σ Δ_j t_j² = 2 p0. The term −(z − t)²/4 takes p0/2 of it.
        let mut sum = [p0, q0].map(|load| Complex::new(-load, 0.0));
        for node in &self.nodes {
            let w = Complex::new(x - node.t, y);
            if w.norm_sqr() > 0.0 {
                let term = w * w * (lower_logarithm(w.re, w.im) * 0.5 - 0.25);
                sum[0] += term * node.p_jump;
                sum[1] += term * node.q_jump;
            }
        }
        sum
    }
}

/// The transforms from the moments: Σ m_k/z^(k+1).
#[inline(always)]
fn far(moments: &[[f64; 2]], x: f64, y: f64) -> Transforms {
    let per_square = 1.0 / (x * x + y * y);
    let (re, im) = (x * per_square, -y * per_square);
    let (mut value, mut slope) = ([0.0; 4], [0.0; 4]);
    for (k, [p, q]) in moments.iter().enumerate().rev() {
        let factor = (k + 1) as f64;
        value = times(value, re, im);
        slope = times(slope, re, im);
        (value[0], value[2]) = (value[0] + p, value[2] + q);
        (slope[0], slope[2]) = (slope[0] + factor * p, slope[2] + factor * q);
    }
    let value = times(value, re, im);
    let slope = times(times(slope, re, im), re, im);
    Transforms {
        p: Complex::new(value[0], value[1]),
        q: Complex::new(value[2], value[3]),
        p_slope: Complex::new(-slope[0], -slope[1]),
        q_slope: Complex::new(-slope[2], -slope[3]),
    }
}

impl Node {
    #[inline(always)]
    fn add(&self, x: f64, y: f64, sum: &mut Transforms) {
        let w = Complex::new(x - self.t, y);
        let logarithm = lower_logarithm(w.re, w.im);
        let value = w * logarithm;
        sum.p += value * self.p_jump;
        sum.q += value * self.q_jump;
        // The constant 1 cancels only in the sum over all nodes.
        sum.p_slope += (logarithm + 1.0) * self.p_jump;
        sum.q_slope += (logarithm + 1.0) * self.q_jump;
    }
}

/// ln(x + i y) with −π ≤ arg ≤ 0, its limit from below on the surface; finite at 0, where the
/// products with it vanish.
#[inline(always)]
fn lower_logarithm(x: f64, y: f64) -> Complex {
    Complex::new(0.5 * (x * x + y * y).max(f64::MIN_POSITIVE).ln(), (-y.abs()).atan2(x))
}

/// (Re P, Im P, Re Q, Im Q) times re + i im.
#[inline(always)]
fn times(v: [f64; 4], re: f64, im: f64) -> [f64; 4] {
    [v[0] * re - v[1] * im, v[1] * re + v[0] * im, v[2] * re - v[3] * im, v[3] * re + v[2] * im]
}

#[inline(always)]
fn evaluate(series: &Coefficients, dx: f64, dy: f64, per_half: f64) -> Transforms {
    let (re, im) = (dx * per_half, dy * per_half);
    let (mut value, mut slope) = ([0.0; 4], [0.0; 4]);
    for coefficient in series.iter().rev() {
        slope = times(slope, re, im);
        for lane in 0..4 {
            slope[lane] += value[lane];
        }
        value = times(value, re, im);
        for lane in 0..4 {
            value[lane] += coefficient[lane];
        }
    }
    Transforms {
        p: Complex::new(value[0], value[1]),
        q: Complex::new(value[2], value[3]),
        p_slope: Complex::new(slope[0] * per_half, slope[1] * per_half),
        q_slope: Complex::new(slope[2] * per_half, slope[3] * per_half),
    }
}

/// Adds Δ (z − t) ln(z − t) to the series in w = (z − c)/h: with g = c − t and r = h/g,
/// g ln g + h (ln g + 1) w + Σ g (−r w)^k/(k (k − 1)), k ≥ 2.
fn expand(node: &Node, centre: Complex, half: f64, series: &mut Coefficients) {
    let g = centre - node.t;
    let r = -half / g;
    let logarithm = lower_logarithm(g.re, g.im);
    let mut power = g * r;
    for (k, coefficient) in series.iter_mut().enumerate() {
        let term = match k {
            0 => g * logarithm,
            1 => (logarithm + 1.0) * half,
            _ => {
                power *= r;
                power / (k * (k - 1)) as f64
            }
        };
        for (lane, part) in
            [term.re * node.p_jump, term.im * node.p_jump, term.re * node.q_jump, term.im * node.q_jump]
                .into_iter()
                .enumerate()
        {
            coefficient[lane] += part;
        }
    }
}

/// The series in w′, w = (dx + i dy) + w′/2.
fn shifted(series: &Coefficients, dx: f64, dy: f64) -> Coefficients {
    let mut c = *series;
    for first in 0..TERMS - 1 {
        for k in (first..TERMS - 1).rev() {
            let carried = times(c[k + 1], dx, dy);
            for lane in 0..4 {
                c[k][lane] += carried[lane];
            }
        }
    }
    let mut scale = 1.0;
    for coefficient in &mut c {
        coefficient.iter_mut().for_each(|part| *part *= scale);
        scale *= 0.5;
    }
    c
}

/// ∫ p t^k dt and ∫ q t^k dt, segment by segment: Gauss points that are exact for t^MOMENTS.
fn moments(rows: &[[f64; 3]]) -> [[f64; 2]; MOMENTS] {
    let rule = crate::math::gauss_legendre(MOMENTS / 2 + 1);
    let mut moments = [[0.0; 2]; MOMENTS];
    for pair in rows.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        for &(s, weight) in &rule {
            let [t, p, q] = [0, 1, 2].map(|k| from[k] + s * (to[k] - from[k]));
            let mut power = weight * (to[0] - from[0]);
            for moment in &mut moments {
                moment[0] += p * power;
                moment[1] += q * power;
                power *= t;
            }
        }
    }
    moments
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(count: usize) -> Vec<[f64; 3]> {
        let last = (count - 1) as f64;
        let t = |i: usize| 2.0 * i as f64 / last - 1.0;
        (0..count).map(|i| [t(i), (1.0 - t(i).powi(2)).max(0.0).sqrt(), 0.3 * (1.0 - t(i).powi(4))]).collect()
    }

    #[test]
    fn series_and_moments_are_the_sum_over_nodes() {
        const TOLERANCE: f64 = 5e-7; // the series and its derivative
        for count in [3, 20, 200, 1000] {
            let potential = TablePotential::new(&rows(count));
            let mut worst = 0.0f64;
            for i in 0..4000 {
                let x = -6.0 + 0.003_013 * f64::from(i);
                let y = -6.0 * 10f64.powf(-0.0021 * f64::from((i * 617) % 4001));
                for y in [y, -0.0] {
                    let (fast, direct) = (potential.at(x, y), potential.directly(x, y));
                    let parts = [fast.p - direct.p, fast.q - direct.q];
                    let slopes = [fast.p_slope - direct.p_slope, fast.q_slope - direct.q_slope];
                    let here = parts.iter().fold(0.0f64, |worst, part| worst.max(part.norm()));
                    let here = slopes.iter().fold(here, |worst, part| worst.max(part.norm() * y.abs()));
                    worst = worst.max(here);
                }
            }
            println!("{count} rows: {worst:e}, {} cells", potential.cells.len());
            assert!(worst < TOLERANCE, "{count} rows: {worst:e}");
        }
    }

    #[test]
    fn integrals_have_the_transforms_as_derivatives_and_meet_where_the_moments_begin() {
        let potential = TablePotential::new(&rows(20));
        for (x, y) in [(0.3, -0.2), (-2.0, -1.0), (5.0, -0.5), (0.0, -40.0), (1.3, -0.05)] {
            let h = 1e-5;
            let [right, left] = [h, -h].map(|dx| potential.integrals(x + dx, y));
            let want = potential.at(x, y);
            for (k, transform) in [want.p, want.q].into_iter().enumerate() {
                assert!(((right[k] - left[k]) / (2.0 * h) - transform).norm() < 1e-8, "{x} {y}");
            }
        }
        let [inside, outside] =
            [FAR - 1e-9, FAR + 1e-9].map(|radius| potential.integrals(0.6 * radius, -0.8 * radius));
        for (one, other) in inside.into_iter().zip(outside) {
            assert!((one - other).norm() < 1e-7, "{one} {other}"); // FAR^−MOMENTS
        }
    }
}

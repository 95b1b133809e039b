//! Quadrature of products of two cells that touch.
//!
//! In the coordinates of Duffy (1982), a kernel that grows as 1/r where two points meet becomes
//! smooth. They are applied to pairs of cells as in Sauter & Schwab (2011, 5.2).
//!
//! Three logarithms and three angles of each corner are taken in [lanes](super::lanes): a third of
//! the time of one corner after the other.

use super::lanes::{LANES, Lanes, angles, logarithms};
use super::plane::Symmetric;
use pulp::{Arch, Simd, WithSimd};

/// Two points in their unit squares and the weight of the pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairPoint {
    pub first: [f64; 2],
    pub second: [f64; 2],
    pub weight: f64,
}

/// The rules of `order` points per direction for pairs of the same cell, of cells with a common
/// edge (q = 0 in both, p in the same sense) and of cells with a common corner (p = q = 0 in both),
/// and for a cell with its own edge q = 0 or an edge from its corner p = q = 0 (the second point
/// has q = 0).
#[derive(Debug, Clone)]
pub(super) struct DuffyRules {
    pub same: Vec<PairPoint>,
    pub edge: Vec<PairPoint>,
    pub corner: Vec<PairPoint>,
    pub own_line: Vec<PairPoint>,
    pub corner_line: Vec<PairPoint>,
}

/// Points and weights on the pyramids of the N-dimensional unit cube with apex at the origin.
fn pyramids<const N: usize>(rule: &[(f64, f64)]) -> Vec<([f64; N], f64)> {
    let mut points = Vec::new();
    for largest in 0..N {
        for index in 0..rule.len().pow(N as u32) {
            let mut rest = index;
            let digits: [usize; N] = std::array::from_fn(|_| {
                let digit = rest % rule.len();
                rest /= rule.len();
                digit
            });
            let scale = rule[digits[largest]].0;
            let point = std::array::from_fn(|c| if c == largest { scale } else { scale * rule[digits[c]].0 });
            let weight: f64 = digits.iter().map(|&d| rule[d].1).product();
            points.push((point, weight * scale.powi(N as i32 - 1)));
        }
    }
    points
}

impl DuffyRules {
    pub fn new(order: usize) -> Self {
        let rule = crate::math::gauss_legendre(order);
        // Two points on one line at the distance t, in either order.
        let pair = |t: f64, x: f64, after: bool| {
            let from = (1.0 - t) * x;
            if after { [from + t, from] } else { [from, from + t] }
        };
        let mut rules = Self {
            same: Vec::new(),
            edge: Vec::new(),
            corner: Vec::new(),
            own_line: Vec::new(),
            corner_line: Vec::new(),
        };
        for ([t, q], weight) in pyramids(&rule) {
            for (x, wx) in &rule {
                for after in [false, true] {
                    let p = pair(t, *x, after);
                    let weight = weight * wx * (1.0 - t);
                    rules.own_line.push(PairPoint { first: [p[0], q], second: [p[1], 0.0], weight });
                    for (y, wy) in &rule {
                        for up in [false, true] {
                            let r = pair(q, *y, up);
                            let weight = weight * wy * (1.0 - q);
                            rules.same.push(PairPoint { first: [p[0], r[0]], second: [p[1], r[1]], weight });
                        }
                    }
                }
            }
        }
        for ([t, q, other], weight) in pyramids(&rule) {
            rules.corner_line.push(PairPoint { first: [t, q], second: [other, 0.0], weight });
            for (x, wx) in &rule {
                for after in [false, true] {
                    let p = pair(t, *x, after);
                    let weight = weight * wx * (1.0 - t);
                    rules.edge.push(PairPoint { first: [p[0], q], second: [p[1], other], weight });
                }
            }
        }
        for ([a, b, c, d], weight) in pyramids(&rule) {
            rules.corner.push(PairPoint { first: [a, b], second: [c, d], weight });
        }
        rules
    }
}

/// Corners with their x and y (mm) and jumps of p, q_x and q_y, in groups of [`LANES`]; the last
/// one is filled up with corners without jumps.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Corners {
    groups: Vec<[[f64; LANES]; 5]>,
}

impl Corners {
    /// The corners at (x, y) (mm) with these jumps.
    pub fn new(corners: impl Iterator<Item = ([f64; 2], [f64; 3])>) -> Self {
        let all: Vec<([f64; 2], [f64; 3])> = corners.collect();
        let group = |own: &[([f64; 2], [f64; 3])]| {
            let mut group = [[0.0; LANES]; 5];
            for (lane, ([x, y], jumps)) in own.iter().enumerate() {
                let values = [*x, *y, jumps[0], jumps[1], jumps[2]];
                group.iter_mut().zip(values).for_each(|(row, value)| row[lane] = value);
            }
            group
        };
        Self { groups: all.chunks(LANES).map(group).collect() }
    }

    /// 2π times the stress (MPa) of all corners at x, y and depth (mm, positive).
    pub fn stress(&self, at: [f64; 3], poisson: f64) -> Symmetric {
        Arch::new().dispatch(Sum { groups: &self.groups, at, poisson })
    }
}

struct Sum<'a> {
    groups: &'a [[[f64; LANES]; 5]],
    at: [f64; 3],
    poisson: f64,
}

impl WithSimd for Sum<'_> {
    type Output = Symmetric;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Symmetric {
        let [x, y, depth] = self.at;
        let mut sums = [[0.0; LANES]; 6];
        for [xs, ys, ps, along, across] in self.groups {
            let places = [xs.map(|own| x - own), ys.map(|own| y - own)];
            let parts = Parts::of(&places, depth);
            for lane in 0..LANES {
                let jumps = [ps[lane], along[lane], across[lane]];
                let stress = parts.stress(&places, depth, lane, jumps, self.poisson);
                for k in 0..6 {
                    sums[k][lane] += stress[k];
                }
            }
        }
        sums.map(|lanes| lanes.iter().sum())
    }
}

/// R, the logarithms ln(R + x), ln(R + y), ln(R + z), and angles without jumps in the half-space:
/// arctan(y/x) − arctan(yz/xR), with x and y exchanged, and arctan(xy/zR).
struct Parts {
    r: Lanes,
    logarithms: [Lanes; 3],
    angles: [Lanes; 3],
}

impl Parts {
    #[inline(always)]
    fn of([xs, ys]: &[Lanes; 2], z: f64) -> Self {
        let mut r = [0.0; LANES];
        let mut sums = [[0.0; LANES]; 3];
        let (mut fan, mut below) = ([0.0; LANES], [[0.0; LANES]; 2]);
        let (mut product, mut level) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let (x, y) = (xs[i], ys[i]);
            let (xx, yy, zz) = (x * x, y * y, z * z);
            r[i] = (xx + yy + zz).sqrt();
            sums[0][i] = sum(r[i], x, yy + zz);
            sums[1][i] = sum(r[i], y, xx + zz);
            sums[2][i] = r[i] + z;
            fan[i] = x * y * (xx + yy) / (r[i] + z);
            below[0][i] = xx * r[i] + yy * z;
            below[1][i] = yy * r[i] + xx * z;
            product[i] = x * y;
            level[i] = z * r[i];
        }
        let logarithms = [logarithms(&sums[0]), logarithms(&sums[1]), logarithms(&sums[2])];
        let angles = [angles(&fan, &below[0]), angles(&fan, &below[1]), angles(&product, &level)];
        Self { r, logarithms, angles }
    }

    /// 2π times the stress at (x, y, z), z > 0, of the corner `lane` with these jumps of p, q_x and
    /// q_y.
    #[inline(always)]
    fn stress(
        &self,
        [xs, ys]: &[Lanes; 2],
        z: f64,
        lane: usize,
        [p, qx, qy]: [f64; 3],
        poisson: f64,
    ) -> Symmetric {
        let (x, y, r) = (xs[lane], ys[lane], self.r[lane]);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (lx, ly, lz) = (self.logarithms[0][lane], self.logarithms[1][lane], self.logarithms[2][lane]);
        let (tx, ty, tz) = (self.angles[0][lane], self.angles[1][lane], self.angles[2][lane]);
        let two_nu = 2.0 * poisson;

        // Derivatives of the potential that pressure and shear share.
        let common = z * r - x * y * tz - x * z * lx - y * z * ly;
        let (level_x, level_y) = (y * ly - r, x * lx - r);
        let twist = x * ly + y * lx - z * tz;
        let (rise_x, rise_y) = (-y * tz - z * lx, -x * tz - z * ly);

        let h_xx = x * y * tx + 0.5 * (yy - xx) * lz + y * z * ly - 0.5 * z * r;
        let h_yy = x * y * ty + 0.5 * (xx - yy) * lz + x * z * lx - 0.5 * z * r;
        let h_xy = x * y * lz + x * z * ly + y * z * lx + 0.5 * (xx * tx + yy * ty - zz * tz);
        let rest = two_nu - 1.0;

        let slope_x = x * y * ly - 0.5 * x * r + 0.5 * (yy - zz) * lx - y * z * tz;
        let slope_y = x * y * lx - 0.5 * y * r + 0.5 * (xx - zz) * ly - x * z * tz;
        let (mixed_x, mixed_y) = (x * lz + z * lx + y * ty, y * lz + z * ly + x * tx);
        let deep_x = x * z * lz - 0.5 * x * r + y * z * ty + 0.5 * (zz - yy) * lx;
        let deep_y = y * z * lz - 0.5 * y * r + x * z * tx + 0.5 * (zz - xx) * ly;
        let (far_x, far_y) = (y * tx - x * lz, x * ty - y * lz);
        let own_x = x * r - x * z * lz - x * y * ly + y * z * tx;
        let own_y = y * r - y * z * lz - x * y * lx + x * z * ty;

        [
            p * (two_nu * common + rest * h_xx - z * level_x)
                + qx * ((2.0 + two_nu) * slope_x + two_nu * own_x - z * far_x)
                + qy * (two_nu * (slope_y + deep_y) - z * mixed_y),
            p * (two_nu * common + rest * h_yy - z * level_y)
                + qx * (two_nu * (slope_x + deep_x) - z * mixed_x)
                + qy * ((2.0 + two_nu) * slope_y + two_nu * own_y - z * far_y),
            p * (common + z * (level_x + level_y)) + qx * z * (far_x + mixed_x) + qy * z * (far_y + mixed_y),
            qy * (common - z * level_y) - z * (p * rise_y + qx * twist),
            qx * (common - z * level_x) - z * (p * rise_x + qy * twist),
            p * (rest * h_xy - z * twist)
                + qx * (slope_y + two_nu * deep_y - z * mixed_y)
                + qy * (slope_x + two_nu * deep_x - z * mixed_x),
        ]
    }
}

/// R + t, where `others` = R² − t².
#[inline(always)]
fn sum(r: f64, t: f64, others: f64) -> f64 {
    let (above, below) = (r + t, others / (r + t.abs()));
    if t >= 0.0 { above } else { below }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_measure_their_cubes() {
        let rules = DuffyRules::new(4);
        for (rule, name) in [
            (&rules.same, "same"),
            (&rules.edge, "edge"),
            (&rules.corner, "corner"),
            (&rules.own_line, "own line"),
            (&rules.corner_line, "corner line"),
        ] {
            let volume: f64 = rule.iter().map(|p| p.weight).sum();
            let mean: f64 = rule.iter().map(|p| p.weight * (p.first[0] + p.second[0])).sum();
            assert!((volume - 1.0).abs() < 1e-13 && (mean - 1.0).abs() < 1e-13, "{name} {volume} {mean}");
        }
        // ∫∫ 1/r over the unit square with itself is 2.973209612 (4 (ln(1 + √2) + (1 − √2)/3) · 1).
        let rules = DuffyRules::new(8);
        let potential: f64 = rules
            .same
            .iter()
            .map(|p| p.weight / (p.first[0] - p.second[0]).hypot(p.first[1] - p.second[1]))
            .sum();
        let want = 4.0 * ((1.0 + 2f64.sqrt()).ln() + (1.0 - 2f64.sqrt()) / 3.0);
        assert!((potential - want).abs() < 1e-8, "{potential} {want}");
    }
}

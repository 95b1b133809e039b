//! Sums over the corners of bilinear tractions, several corners at a time.
//!
//! Three logarithms and three angles of each corner are taken in short loops that do not branch,
//! for which the compiler takes the widest vector unit: a third of the time of one corner after the
//! other. There are [`LANES`] partial sums on every machine.

use super::nuclei::Symmetric;
use pulp::{Arch, Simd, WithSimd};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2};

/// Corners side by side.
const LANES: usize = 8;

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

/// A value for each of the corners of a group.
type Lanes = [f64; LANES];

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

/// arctan(y/x) of x ≥ 0, which is −π/2 to π/2.
#[inline(always)]
fn angles(ys: &Lanes, xs: &Lanes) -> Lanes {
    let (mut tangents, mut squares, mut bases) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let (size, x) = (ys[i].abs(), xs[i]);
        let (small, large) = if size > x { (x, size) } else { (size, x) };
        let large = if large > f64::MIN_POSITIVE { large } else { f64::MIN_POSITIVE };
        // Above tan(π/8), the angle from π/4 is taken.
        let is_steep = small > EIGHTH * large;
        let above = if is_steep { small - large } else { small };
        let below = if is_steep { small + large } else { large };
        tangents[i] = above / below;
        squares[i] = tangents[i] * tangents[i];
        bases[i] = if is_steep { FRAC_PI_4 } else { 0.0 };
    }
    let series = polynomials(&ARCTANGENT, &squares);
    let mut angles = [0.0; LANES];
    for i in 0..LANES {
        let flat = tangents[i] * series[i] + bases[i];
        let whole = if ys[i].abs() > xs[i] { FRAC_PI_2 - flat } else { flat };
        angles[i] = whole.copysign(ys[i]);
    }
    angles
}

/// Σ `coefficients`[n] xⁿ.
#[inline(always)]
fn polynomials<const N: usize>(coefficients: &[f64; N], xs: &Lanes) -> Lanes {
    let mut sums = [0.0; LANES];
    for coefficient in coefficients.iter().rev() {
        for i in 0..LANES {
            sums[i] = sums[i] * xs[i] + coefficient;
        }
    }
    sums
}

/// tan(π/8).
const EIGHTH: f64 = 0.414_213_562_373_095_03;
/// Series of the arctangent up to tan(π/8), whose last term is below 1e-17.
const ARCTANGENT: [f64; 21] = odd_series(1.0, -1.0);

/// ln x of positive, normal x.
#[inline(always)]
fn logarithms(xs: &Lanes) -> Lanes {
    let (mut exponents, mut ratios, mut squares) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        // x = 2^k m with m between 0.6875 and 1.375; k as the low bits of a number just above 2^52.
        let bits = xs[i].to_bits();
        let biased = bits.wrapping_add(SHIFTED) >> 52;
        let m = f64::from_bits(bits.wrapping_sub(biased.wrapping_sub(1023) << 52));
        exponents[i] = f64::from_bits(biased | TWO_52.to_bits()) - (TWO_52 + 1023.0);
        ratios[i] = (m - 1.0) / (m + 1.0);
        squares[i] = ratios[i] * ratios[i];
    }
    let series = polynomials(&LOGARITHM, &squares);
    let mut logarithms = [0.0; LANES];
    for i in 0..LANES {
        logarithms[i] = exponents[i] * LN_2 + ratios[i] * series[i];
    }
    logarithms
}

/// 2^52.
const TWO_52: f64 = 4_503_599_627_370_496.0;
/// Bits of 1 less those of 0.6875.
const SHIFTED: u64 = 1f64.to_bits() - 0.6875f64.to_bits();
/// Series of ln m = 2 artanh((m − 1)/(m + 1)), whose last term is below 1e-17.
const LOGARITHM: [f64; 12] = odd_series(2.0, 1.0);

/// `first`/1, `first` `ratio`/3, `first` `ratio`²/5, …
const fn odd_series<const N: usize>(first: f64, ratio: f64) -> [f64; N] {
    let (mut series, mut value, mut term) = ([0.0; N], first, 0);
    while term < N {
        series[term] = value / (2 * term + 1) as f64;
        value *= ratio;
        term += 1;
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angle(y: f64, x: f64) -> f64 {
        angles(&[y; LANES], &[x; LANES])[0]
    }

    #[test]
    fn elementary_functions() {
        for i in 0..4000 {
            let x = (0.01 * f64::from(i) - 20.0).exp();
            assert!((logarithms(&[x; LANES])[3] - x.ln()).abs() <= 4e-16 * x.ln().abs().max(1.0), "{x}");
            let angles = [(x, 1.0), (-x, 1.0), (1.0, x), (-1e-3, 1e-3 * x)];
            for (y, x) in angles {
                assert!((angle(y, x) - y.atan2(x)).abs() <= 4e-16, "{y} {x}: {} {}", angle(y, x), y.atan2(x));
            }
        }
        assert_eq!((angle(0.0, 0.0), angle(2.0, 0.0), angle(-2.0, 0.0)), (0.0, FRAC_PI_2, -FRAC_PI_2));
    }
}

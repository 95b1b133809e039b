//! Elementary functions of several numbers at a time.
//!
//! They are taken in short loops that do not branch, for which the compiler takes the widest vector
//! unit. There are [`LANES`] lanes, and the same bits, on every machine.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E};

/// Numbers side by side.
pub(super) const LANES: usize = 8;

/// A number in each lane.
pub(super) type Lanes = [f64; LANES];

/// arctan(y/x) of x ≥ 0, which is −π/2 to π/2.
#[inline(always)]
pub(super) fn angles(ys: &Lanes, xs: &Lanes) -> Lanes {
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
pub(super) fn logarithms(xs: &Lanes) -> Lanes {
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

/// eˣ of |x| ≤ 700.
#[inline(always)]
pub(super) fn exponentials(xs: &Lanes) -> Lanes {
    let (mut powers, mut rests) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        // x = k ln 2 + rest; k in the low bits of a number near 2^52.
        let shifted = xs[i] * LOG2_E + ROUNDER;
        let k = shifted - ROUNDER;
        powers[i] = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
        rests[i] = (xs[i] - k * LN_2_HIGH) - k * LN_2_LOW;
    }
    let series = polynomials(&EXPONENTIAL, &rests);
    let mut exponentials = [0.0; LANES];
    for i in 0..LANES {
        exponentials[i] = series[i] * powers[i];
    }
    exponentials
}

/// Sines and cosines of angles up to a thousand.
#[inline(always)]
pub(super) fn sines_and_cosines(angles: &Lanes) -> [Lanes; 2] {
    let (mut quarters, mut rests, mut squares) = ([0u64; LANES], [0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let shifted = angles[i] * FRAC_2_PI + ROUNDER;
        let k = shifted - ROUNDER;
        quarters[i] = shifted.to_bits();
        rests[i] = (angles[i] - k * QUARTER_HIGH) - k * QUARTER_LOW;
        squares[i] = rests[i] * rests[i];
    }
    let (odd, even) = (polynomials(&SINE, &squares), polynomials(&COSINE, &squares));
    let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let (sine, cosine) = (rests[i] * odd[i], even[i]);
        let is_turned = quarters[i] & 1 == 1;
        let (s, c) = if is_turned { (cosine, sine) } else { (sine, cosine) };
        // Signs: of the sine in the third and fourth quarter, of the cosine in the second and
        // third.
        let below = (quarters[i] & 2) << 62;
        let behind = (quarters[i].wrapping_add(1) & 2) << 62;
        sines[i] = f64::from_bits(s.to_bits() ^ below);
        cosines[i] = f64::from_bits(c.to_bits() ^ behind);
    }
    [sines, cosines]
}

/// 1.5 · 2^52: a number below 2^51 added to it is rounded to an integer.
const ROUNDER: f64 = 1.5 * TWO_52;
/// ln 2 and π/2 in two parts, the first with 33 bits, so that its multiples are exact.
const LN_2_HIGH: f64 = f64::from_bits(LN_2.to_bits() & UPPER);
const LN_2_LOW: f64 = LN_2_REST + (LN_2 - LN_2_HIGH);
const QUARTER_HIGH: f64 = f64::from_bits(FRAC_PI_2.to_bits() & UPPER);
const QUARTER_LOW: f64 = QUARTER_REST + (FRAC_PI_2 - QUARTER_HIGH);
const UPPER: u64 = !0 << 20;
/// ln 2 and π/2 less the numbers next to them.
const LN_2_REST: f64 = 2.319_046_813_846_299_6e-17;
const QUARTER_REST: f64 = 6.123_233_995_736_766e-17;
/// Taylor series of eˣ up to ln 2 / 2, and of sin x / x and cos x in x² up to π/4; the next terms
/// are below 1e-17.
const EXPONENTIAL: [f64; 14] = taylor(0, 1, 1.0);
const SINE: [f64; 9] = taylor(1, 2, -1.0);
const COSINE: [f64; 9] = taylor(0, 2, -1.0);

/// Σ `sign`ⁿ / (`first` + n `step`)!
const fn taylor<const N: usize>(first: usize, step: usize, sign: f64) -> [f64; N] {
    let (mut series, mut factorial, mut signed, mut term) = ([0.0; N], 1.0, 1.0, 0);
    while term < N {
        let order = first + term * step;
        series[term] = signed / factorial;
        signed *= sign;
        let mut next = order + 1;
        while next <= order + step {
            factorial *= next as f64;
            next += 1;
        }
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
        for i in -3000..3000 {
            let x = 0.01 * f64::from(i);
            let exponential = exponentials(&[x; LANES])[5];
            assert!((exponential - x.exp()).abs() <= 4e-16 * x.exp(), "{x}: {exponential}");
            let [sine, cosine] = sines_and_cosines(&[x; LANES]).map(|lanes| lanes[2]);
            assert!(
                (sine - x.sin()).abs() <= 3e-16 && (cosine - x.cos()).abs() <= 3e-16,
                "{x}: {sine} {cosine}"
            );
        }
        assert_eq!((angle(0.0, 0.0), angle(2.0, 0.0), angle(-2.0, 0.0)), (0.0, FRAC_PI_2, -FRAC_PI_2));
    }
}

//! Legendre functions of the second kind with a complex argument.

use num_complex::Complex64 as Complex;

/// |u + √(u² − 1)| below which the recurrence upwards may be used.
const NEAR: f64 = 1.8;

/// Share of the start of the recurrence downwards that is left in Q_{N−1}.
const FORGOTTEN: f64 = 1e-11;

/// Largest number of orders above the largest one at which the recurrence downwards begins.
const ABOVE: usize = 40;

/// Largest share by which the recurrence upwards may multiply round-off.
const UPWARDS: f64 = 1e5;

/// Q_0 … Q_{N−1} at a complex `u` off the interval [−1, 1]: Q_m(u) = ½ ∫ P_m(t)/(u − t) dt over it.
///
/// The recurrence (m + 1) Q_{m+1} = (2m + 1) u Q_m − m Q_{m−1} is stable upwards next to the
/// interval, downwards elsewhere (Olver). Downwards, its start is forgotten as |u + √(u² − 1)| to
/// the power of twice the number of orders.
pub(crate) fn legendre_second<const N: usize>(u: Complex) -> [Complex; N] {
    let apart = |end: f64| ((u.re - end) * (u.re - end) + u.im * u.im).sqrt();
    let mean = (0.5 * (apart(1.0) + apart(-1.0))).max(1.0);
    let growth = mean + (mean * mean - 1.0).sqrt();
    if growth < NEAR && growth.powi(2 * N as i32 - 2) < UPWARDS {
        return upwards(u);
    }
    let above = (-0.5 * FORGOTTEN.ln() / growth.ln()).ceil() as usize;
    downwards(u, above.clamp(1, ABOVE))
}

/// Q_0 = ½ ln((u + 1)/(u − 1)), cut along [−1, 1].
pub(crate) fn legendre_zeroth(u: Complex) -> Complex {
    let (over, under) = ((u.re + 1.0).powi(2) + u.im * u.im, (u.re - 1.0).powi(2) + u.im * u.im);
    let angle = (2.0 * u.im).atan2(u.norm_sqr() - 1.0);
    Complex::new(0.25 * (over / under).ln(), -0.5 * angle)
}

fn upwards<const N: usize>(u: Complex) -> [Complex; N] {
    let mut values = [Complex::new(0.0, 0.0); N];
    let (mut value, mut previous) = (legendre_zeroth(u), Complex::new(0.0, 0.0));
    for (m, own) in values.iter_mut().enumerate() {
        *own = value;
        let order = m as f64;
        let after = if m == 0 {
            u * value - 1.0
        } else {
            ((2.0 * order + 1.0) * u * value - order * previous) / (order + 1.0)
        };
        (previous, value) = (value, after);
    }
    values
}

/// From the order N − 1 + `above` downwards in proportion to the values, which Q_0 gives.
fn downwards<const N: usize>(u: Complex, above: usize) -> [Complex; N] {
    let mut values = [Complex::new(0.0, 0.0); N];
    let (mut after, mut value) = (Complex::new(0.0, 0.0), Complex::new(SMALL, 0.0));
    for m in (0..N + above).rev() {
        if m < N {
            values[m] = value;
        }
        let [of_value, of_after] = DOWNWARDS[m];
        (after, value) = (value, u * (value * of_value) - after * of_after);
    }
    let scale = distant(u) / values[0];
    values.map(|value| value * scale)
}

/// The start of the recurrence downwards, which grows from it.
const SMALL: f64 = 1e-100;

/// (2m + 1)/m and (m + 1)/m of the recurrence downwards.
const DOWNWARDS: [[f64; 2]; 64] = {
    let mut all = [[0.0; 2]; 64];
    let mut m = 1;
    while m < 64 {
        let order = m as f64;
        all[m] = [(2.0 * order + 1.0) / order, (order + 1.0) / order];
        m += 1;
    }
    all
};

/// |u| beyond which the logarithm would be that of a number close to one.
const DISTANT: f64 = 20.0;

fn distant(u: Complex) -> Complex {
    if u.norm_sqr() < DISTANT * DISTANT {
        return legendre_zeroth(u);
    }
    let inverse = 1.0 / u;
    let square = inverse * inverse;
    inverse * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0 + square / 9.0))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gauss_legendre;

    fn legendre(m: usize, t: f64) -> f64 {
        let (mut value, mut before) = (1.0, 0.0);
        for j in 0..m {
            let j = j as f64;
            (value, before) = (((2.0 * j + 1.0) * t * value - j * before) / (j + 1.0), value);
        }
        value
    }

    /// ½ ∫ P_m/(u − t) dt by quadrature, far enough from the interval for it.
    fn by_quadrature(m: usize, u: Complex) -> Complex {
        gauss_legendre(200)
            .into_iter()
            .map(|(point, weight)| weight * legendre(m, 2.0 * point - 1.0) / (u - (2.0 * point - 1.0)))
            .sum()
    }

    #[test]
    fn neumann_integrals_near_and_far() {
        for u in [(0.3, 0.2), (-0.9, 0.1), (1.2, 0.05), (0.0, 1.0), (2.0, 1.0), (-30.0, 4.0), (0.1, 25.0)] {
            let u = Complex::new(u.0, u.1);
            let known = legendre_second::<12>(u);
            for m in 0..=11 {
                let want = by_quadrature(m, u);
                let off = (known[m] - want).norm();
                assert!(off < 1e-9 * want.norm() + 1e-15, "Q_{m}({u}): {} {want}", known[m]);
            }
        }
    }
}

//! Legendre functions of the second kind with a complex argument.

use num_complex::Complex64 as Complex;

/// Q_0 … Q_n at a complex u off the interval [−1, 1]: Q_m(u) = ½ ∫ P_m(t)/(u − t) dt over it.
#[derive(Debug, Clone)]
pub(crate) struct LegendreSecond {
    /// u.
    pub at: Complex,
    /// Q_0 … Q_n.
    pub values: Vec<Complex>,
}

/// |u| beyond which Q_m is summed from its smallest terms upwards.
const FAR: f64 = 1.8;

/// Orders above the largest one at which the recurrence downwards begins: from [`FAR`] on, its
/// start is forgotten as |u + √(u² − 1)| to the power of twice their number.
const ABOVE: usize = 30;

/// Largest share by which the recurrence upwards may multiply round-off.
const UPWARDS: f64 = 1e5;

impl LegendreSecond {
    /// Q_0 … Q_`most` at `u`.
    ///
    /// The recurrence (m + 1) Q_{m+1} = (2m + 1) u Q_m − m Q_{m−1} is stable upwards next to the
    /// interval, downwards elsewhere (Olver).
    pub fn new(u: Complex, most: usize) -> Self {
        let one = Complex::new(1.0, 0.0);
        let root = (u - one).sqrt() * (u + one).sqrt();
        let growth = (u + root).norm().max(1.0 / (u + root).norm());
        let values = if growth < FAR && growth.powi(2 * most as i32) < UPWARDS {
            upwards(u, most)
        } else {
            downwards(u, most)
        };
        Self { at: u, values }
    }

    /// Q_0 = ½ ln((u + 1)/(u − 1)), cut along [−1, 1].
    pub fn zeroth(u: Complex) -> Complex {
        let (over, under) = ((u.re + 1.0).powi(2) + u.im * u.im, (u.re - 1.0).powi(2) + u.im * u.im);
        let angle = (2.0 * u.im).atan2(u.norm_sqr() - 1.0);
        Complex::new(0.25 * (over / under).ln(), -0.5 * angle)
    }

    /// Q_m′ for m ≥ 1: (u² − 1) Q_m′ = m (u Q_m − Q_{m−1}).
    pub fn slope(&self, m: usize) -> Complex {
        let u = self.at;
        m as f64 * (u * self.values[m] - self.values[m - 1]) / (u * u - 1.0)
    }

    /// Q_m″ for m ≥ 1, from Legendre's equation.
    pub fn curvature(&self, m: usize) -> Complex {
        let u = self.at;
        (2.0 * u * self.slope(m) - (m * (m + 1)) as f64 * self.values[m]) / (1.0 - u * u)
    }
}

fn upwards(u: Complex, most: usize) -> Vec<Complex> {
    let mut values = vec![LegendreSecond::zeroth(u)];
    if most > 0 {
        values.push(u * values[0] - 1.0);
    }
    for m in 1..most {
        let order = m as f64;
        values.push(((2.0 * order + 1.0) * u * values[m] - order * values[m - 1]) / (order + 1.0));
    }
    values
}

/// Ratios Q_m/Q_{m−1} from above, then the values from Q_0.
fn downwards(u: Complex, most: usize) -> Vec<Complex> {
    let mut ratios = vec![Complex::new(0.0, 0.0); most + 1];
    let mut ratio = 0.5 / u;
    for m in (1..=most + ABOVE).rev() {
        let order = m as f64;
        ratio = order / ((2.0 * order + 1.0) * u - (order + 1.0) * ratio);
        if m <= most {
            ratios[m] = ratio;
        }
    }
    let mut values = vec![distant(u)];
    for m in 1..=most {
        values.push(values[m - 1] * ratios[m]);
    }
    values
}

/// |u| beyond which the logarithm would be that of a number close to one.
const DISTANT: f64 = 20.0;

fn distant(u: Complex) -> Complex {
    if u.norm() < DISTANT {
        return LegendreSecond::zeroth(u);
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
            let known = LegendreSecond::new(u, 11);
            for m in 0..=11 {
                let want = by_quadrature(m, u);
                let off = (known.values[m] - want).norm();
                assert!(off < 1e-9 * want.norm() + 1e-15, "Q_{m}({u}): {} {want}", known.values[m]);
            }
        }
    }

    #[test]
    fn slopes_and_curvatures_are_those_of_differences() {
        let (u, h) = (Complex::new(0.4, 0.7), 1e-4);
        let at = |shift: f64| LegendreSecond::new(u + shift, 6);
        for m in 1..=6 {
            let (ahead, behind) = (at(h), at(-h));
            let slope = (ahead.values[m] - behind.values[m]) / (2.0 * h);
            let curvature = (ahead.slope(m) - behind.slope(m)) / (2.0 * h);
            assert!((at(0.0).slope(m) - slope).norm() < 1e-7 * (1.0 + slope.norm()));
            assert!((at(0.0).curvature(m) - curvature).norm() < 1e-7 * (1.0 + curvature.norm()));
        }
    }
}

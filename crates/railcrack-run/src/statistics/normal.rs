//! The normal distribution.

use std::f64::consts::PI;

/// The standard normal distribution function, to 1e-15: Φ(z) = ½ + φ(z) (z + z³/3 + z⁵/(3·5) + …)
/// (Marsaglia 2004).
#[must_use]
pub fn distribution(z: f64) -> f64 {
    /// Beyond it, Φ is 0 or 1 to 1e-15.
    const FAR: f64 = 8.0;
    if z.abs() >= FAR {
        return f64::from(u8::from(z > 0.0));
    }
    let (mut sum, mut term, mut odd) = (z, z, 1.0);
    while term.abs() > 1e-17 * sum.abs() {
        odd += 2.0;
        term *= z * z / odd;
        sum += term;
    }
    (0.5 + sum * (-0.5 * z * z).exp() / (2.0 * PI).sqrt()).clamp(0.0, 1.0)
}

/// The standard normal density φ(z).
#[must_use]
pub fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

/// ln of the normal density of `x` about `mean` with `variance` > 0.
#[must_use]
pub fn log_density(x: f64, mean: f64, variance: f64) -> f64 {
    -0.5 * ((x - mean).powi(2) / variance + (2.0 * PI * variance).ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities() {
        assert!((density(1.0) - 0.241_970_724_519_143_37).abs() < 1e-15);
        assert!((log_density(3.0, 1.0, 4.0) - (density(1.0) / 2.0).ln()).abs() < 1e-14);
        assert!((distribution(1.959_963_984_540_054) - 0.975).abs() < 1e-15);
    }
}

//! Loops over vectors, compiled for the widest vector unit of the machine. Sums have a fixed order and no product is
//! fused with a sum, so that results are the same bits on every machine.

use pulp::{Arch, Simd, WithSimd};

/// Partial sums of a scalar product: as many as the widest vector unit needs to hide the latency of one sum.
const SUMS: usize = 8;

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    Arch::new().dispatch(Dot { a, b })
}

/// y += a x.
pub(crate) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(Axpy { a, x, y });
}

/// y += a x + b z, in one pass over y.
fn axpy_two((a, x): (f64, &[f64]), (b, z): (f64, &[f64]), y: &mut [f64]) {
    Arch::new().dispatch(AxpyTwo { a, x, b, z, y });
}

/// y += Σ weights_i rows(i), two rows at a time.
pub(crate) fn add_rows<'m>(weights: &[f64], rows: impl Fn(usize) -> &'m [f64], y: &mut [f64]) {
    let mut pairs = weights.chunks_exact(2);
    for (k, pair) in pairs.by_ref().enumerate() {
        axpy_two((pair[0], rows(2 * k)), (pair[1], rows(2 * k + 1)), y);
    }
    if let [last] = pairs.remainder() {
        axpy(*last, rows(weights.len() - 1), y);
    }
}

struct Dot<'a> {
    a: &'a [f64],
    b: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let mut sums = [0.0; SUMS];
        let (a_blocks, a_rest) = self.a.as_chunks::<SUMS>();
        let (b_blocks, b_rest) = self.b.as_chunks::<SUMS>();
        for (x, y) in a_blocks.iter().zip(b_blocks) {
            for k in 0..SUMS {
                sums[k] += x[k] * y[k];
            }
        }
        for (sum, (x, y)) in sums.iter_mut().zip(a_rest.iter().zip(b_rest)) {
            *sum += x * y;
        }
        let mut width = SUMS / 2;
        while width > 0 {
            for k in 0..width {
                sums[k] += sums[k + width];
            }
            width /= 2;
        }
        sums[0]
    }
}

struct Axpy<'a> {
    a: f64,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for Axpy<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (y, x) in self.y.iter_mut().zip(self.x) {
            *y += self.a * x;
        }
    }
}

struct AxpyTwo<'a> {
    a: f64,
    x: &'a [f64],
    b: f64,
    z: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for AxpyTwo<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for ((y, x), z) in self.y.iter_mut().zip(self.x).zip(self.z) {
            *y = (*y + self.a * x) + self.b * z;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agree_with_plain_loops() {
        for n in [0, 1, 7, 8, 15, 16, 17, 40, 100] {
            let a: Vec<f64> = (0..n).map(|i| (i as f64 * 0.7).sin()).collect();
            let b: Vec<f64> = (0..n).map(|i| (i as f64 * 1.3).cos()).collect();
            let plain: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
            assert!((dot(&a, &b) - plain).abs() < 1e-14 * (1.0 + n as f64), "{n}");
            let mut once = b.clone();
            axpy(2.0, &a, &mut once);
            axpy(-3.0, &b, &mut once);
            let mut both = b.clone();
            axpy_two((2.0, &a), (-3.0, &b), &mut both);
            assert_eq!(once, both);
            let mut together = b.clone();
            let rows = [&a, &b, &a];
            add_rows(&[2.0, -3.0, 0.0], |k| rows[k], &mut together);
            assert_eq!(once, together);
            assert!(once.iter().zip(&a).zip(&b).all(|((y, a), b)| (y - (2.0 * a - 2.0 * b)).abs() < 1e-14));
        }
    }
}

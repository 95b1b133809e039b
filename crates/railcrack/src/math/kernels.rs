//! Loops over vectors, compiled for the widest vector unit of the machine. Sums have a fixed order and no product is
//! fused with a sum, so that results are the same bits on every machine.

use pulp::Arch;

/// Partial sums of a scalar product: as many as the widest vector unit needs to hide the latency of one sum.
const SUMS: usize = 16;

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            let mut sums = [0.0; SUMS];
            let (a_blocks, b_blocks) = (a.chunks_exact(SUMS), b.chunks_exact(SUMS));
            let tail: f64 = a_blocks.remainder().iter().zip(b_blocks.remainder()).map(|(x, y)| x * y).sum();
            for (x, y) in a_blocks.zip(b_blocks) {
                for k in 0..SUMS {
                    sums[k] += x[k] * y[k];
                }
            }
            let mut width = SUMS / 2;
            while width > 0 {
                for k in 0..width {
                    sums[k] += sums[k + width];
                }
                width /= 2;
            }
            sums[0] + tail
        },
    )
}

/// y += a x.
pub(crate) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for (y, x) in y.iter_mut().zip(x) {
                *y += a * x;
            }
        },
    );
}

/// y += a x + b z, in one pass over y.
pub(crate) fn axpy_two((a, x): (f64, &[f64]), (b, z): (f64, &[f64]), y: &mut [f64]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for ((y, x), z) in y.iter_mut().zip(x).zip(z) {
                *y = (*y + a * x) + b * z;
            }
        },
    );
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
            assert!(once.iter().zip(&a).zip(&b).all(|((y, a), b)| (y - (2.0 * a - 2.0 * b)).abs() < 1e-14));
        }
    }
}

//! Sobol's sequence.

/// Dimensions that there are numbers for.
pub(in crate::study) const DIMENSIONS: usize = 21;

/// Bits of a coordinate.
const BITS: usize = 32;

/// Degree, inner coefficients and first direction numbers of the primitive polynomial of each
/// dimension from the second on: Joe and Kuo (2008), file new-joe-kuo-6.21201.
const POLYNOMIALS: [(usize, u32, [u32; 7]); DIMENSIONS - 1] = [
    (1, 0, [1, 0, 0, 0, 0, 0, 0]),
    (2, 1, [1, 3, 0, 0, 0, 0, 0]),
    (3, 1, [1, 3, 1, 0, 0, 0, 0]),
    (3, 2, [1, 1, 1, 0, 0, 0, 0]),
    (4, 1, [1, 1, 3, 3, 0, 0, 0]),
    (4, 4, [1, 3, 5, 13, 0, 0, 0]),
    (5, 2, [1, 1, 5, 5, 17, 0, 0]),
    (5, 4, [1, 1, 5, 5, 5, 0, 0]),
    (5, 7, [1, 1, 7, 11, 19, 0, 0]),
    (5, 11, [1, 1, 5, 1, 1, 0, 0]),
    (5, 13, [1, 1, 1, 3, 11, 0, 0]),
    (5, 14, [1, 3, 5, 5, 31, 0, 0]),
    (6, 1, [1, 3, 3, 9, 7, 49, 0]),
    (6, 13, [1, 1, 1, 15, 21, 21, 0]),
    (6, 16, [1, 3, 1, 13, 27, 49, 0]),
    (6, 19, [1, 1, 1, 15, 7, 5, 0]),
    (6, 22, [1, 3, 1, 15, 13, 25, 0]),
    (6, 25, [1, 1, 5, 5, 19, 61, 0]),
    (7, 1, [1, 3, 7, 11, 23, 15, 103]),
    (7, 4, [1, 3, 7, 13, 13, 15, 69]),
];

/// The first `samples` points, each coordinate shifted digit by digit (a random digital shift,
/// which keeps the sequence even): one dimension for each of `shifts`, at most [`DIMENSIONS`].
pub(super) fn points(samples: usize, shifts: &[u32]) -> Vec<Vec<f64>> {
    let directions: Vec<[u32; BITS]> = (0..shifts.len().min(DIMENSIONS)).map(directions).collect();
    let mut state = vec![0u32; directions.len()];
    let mut points = Vec::with_capacity(samples);
    for index in 0..samples {
        let shifted = state.iter().zip(shifts).map(|(x, shift)| x ^ shift);
        points.push(shifted.map(|x| (f64::from(x) + 0.5) / 2f64.powi(BITS as i32)).collect());
        // Gray code (Antonov and Saleev 1979): one direction per step.
        let bit = (index as u64).trailing_ones() as usize;
        for (x, directions) in state.iter_mut().zip(&directions) {
            *x ^= directions[bit.min(BITS - 1)];
        }
    }
    points
}

/// Direction numbers of a dimension, from 0, as binary fractions (Bratley and Fox 1988).
fn directions(dimension: usize) -> [u32; BITS] {
    let mut v = [0; BITS];
    if dimension == 0 {
        (0..BITS).for_each(|i| v[i] = 1 << (BITS - 1 - i));
        return v;
    }
    let (degree, coefficients, first) = POLYNOMIALS[dimension - 1];
    for i in 0..BITS {
        v[i] = if i < degree {
            first[i] << (BITS - 1 - i)
        } else {
            let mut next = v[i - degree] ^ (v[i - degree] >> degree);
            for k in 1..degree {
                if (coefficients >> (degree - 1 - k)) & 1 == 1 {
                    next ^= v[i - k];
                }
            }
            next
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_points_are_those_of_joe_and_kuo() {
        let points = points(5, &[0; DIMENSIONS]);
        let shown = |i: usize| points[i][..5].iter().map(|x| (x * 8.0).floor() / 8.0).collect::<Vec<f64>>();
        // Order of the Gray code: 0, 1/2, 3/4, 1/4, 3/8 in the first dimension.
        assert_eq!(shown(0), [0.0; 5]);
        assert_eq!(shown(1), [0.5; 5]);
        assert_eq!(shown(2), [0.75, 0.25, 0.25, 0.25, 0.75]);
        assert_eq!(shown(3), [0.25, 0.75, 0.75, 0.75, 0.25]);
        assert_eq!(shown(4), [0.375, 0.375, 0.625, 0.875, 0.375]);
    }

    #[test]
    fn every_dimension_is_a_permutation_of_its_parts() {
        let points = points(1024, &[0; DIMENSIONS]);
        for dimension in 0..DIMENSIONS {
            let mut parts: Vec<usize> =
                points.iter().map(|point| (point[dimension] * 1024.0) as usize).collect();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..1024), "dimension {dimension}");
        }
    }
}

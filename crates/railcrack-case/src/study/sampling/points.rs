//! Points of the unit cube: the shares at which the keys of a run are drawn.

use super::sobol;
use crate::tables::Sampling;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// `samples` points of the open unit cube of `dimensions` dimensions, for a seed: the same on every
/// machine.
pub(in crate::study) fn points(
    sampling: Sampling,
    samples: usize,
    dimensions: usize,
    seed: u64,
) -> Vec<Vec<f64>> {
    let mut random = Pcg64::new(u128::from(seed), STREAM);
    match sampling {
        Sampling::Random => {
            (0..samples).map(|_| (0..dimensions).map(|_| share(&mut random)).collect()).collect()
        }
        Sampling::LatinHypercube => {
            let columns: Vec<Vec<f64>> = (0..dimensions).map(|_| stratified(samples, &mut random)).collect();
            (0..samples).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
        }
        Sampling::Sobol => {
            let shifts: Vec<u32> = (0..dimensions).map(|_| random.next_u32()).collect();
            sobol::points(samples, &shifts)
        }
    }
}

/// Stream of the generator (O'Neill 2014): any odd constant.
const STREAM: u128 = 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96;

/// A number of (0, 1), its 52 bits followed by a half: never 0 or 1.
fn share(random: &mut Pcg64) -> f64 {
    ((random.next_u64() >> 12) as f64 + 0.5) / (1u64 << 52) as f64
}

/// One number in each of `samples` equal parts of (0, 1), in random order.
fn stratified(samples: usize, random: &mut Pcg64) -> Vec<f64> {
    let mut column: Vec<f64> = (0..samples).map(|i| (i as f64 + share(random)) / samples as f64).collect();
    // Fisher and Yates.
    for i in (1..samples).rev() {
        let other = (share(random) * (i + 1) as f64) as usize;
        column.swap(i, other.min(i));
    }
    column
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Sampling; 3] = [Sampling::Sobol, Sampling::LatinHypercube, Sampling::Random];

    #[test]
    fn points_lie_inside_and_follow_from_the_seed() {
        for sampling in ALL {
            let some = points(sampling, 100, 5, 1);
            assert_eq!(some, points(sampling, 100, 5, 1), "{sampling:?}");
            assert_ne!(some, points(sampling, 100, 5, 2), "{sampling:?}");
            assert!(some.iter().flatten().all(|&u| u > 0.0 && u < 1.0), "{sampling:?}");
        }
    }

    #[test]
    fn every_part_of_a_hypercube_has_one_point() {
        for sampling in [Sampling::Sobol, Sampling::LatinHypercube] {
            let points = points(sampling, 128, 9, 7);
            for dimension in 0..9 {
                let mut parts: Vec<usize> =
                    points.iter().map(|point| (point[dimension] * 128.0) as usize).collect();
                parts.sort_unstable();
                assert!(parts.into_iter().eq(0..128), "{sampling:?}, dimension {dimension}");
            }
        }
    }

    #[test]
    fn means_and_products_come_to_those_of_the_cube() {
        // 2/√N for random points, far less for the others.
        for (sampling, tolerance) in
            [(Sampling::Sobol, 2e-3), (Sampling::LatinHypercube, 2e-2), (Sampling::Random, 3e-2)]
        {
            let points = points(sampling, 4096, 6, 3);
            for one in 0..6 {
                for other in 0..one {
                    let mean: f64 =
                        points.iter().map(|point| 4.0 * point[one] * point[other]).sum::<f64>() / 4096.0;
                    assert!((mean - 1.0).abs() < tolerance, "{sampling:?}: {mean}");
                }
            }
        }
    }
}

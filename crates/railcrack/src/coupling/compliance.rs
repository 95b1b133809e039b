//! Compliance of the uncracked running surface under linear pressures.

use super::grid::{SurfaceGrid, SurfaceSegment};
use crate::math::{Matrix, gauss_legendre};
use std::f64::consts::PI;

/// Distance of two parts, over the length of the longer one, from which Gauss quadrature takes over
/// from the closed form, whose terms cancel there; its error is then 4e-11.
const FAR: f64 = 6.0;
/// Number of its points on each part.
const POINTS: usize = 4;
/// Distance over the same length from which fewer points have an error of 1e-12, and their number.
const FARTHER: f64 = 40.0;
const FEWER: usize = 3;

/// U_ij = −2/(π E*) ∬ ψ_i(x) ψ_j(t) ln|x − t| dx dt (mm² per MPa) of the nodes of `grid`, with
/// `modulus` = E* (MPa) of both bodies; distances count in mm, which determines the datum of the
/// approach.
pub(super) fn compliance(grid: &SurfaceGrid, modulus: f64) -> Matrix {
    let n = grid.nodes.len();
    let mut sums = Matrix::zeros(n, n);
    let rules = [POINTS, FEWER].map(gauss_legendre);
    for (k, one) in grid.segments.iter().enumerate() {
        for (l, other) in grid.segments.iter().enumerate().skip(k) {
            let distance = (one.middle() - other.middle()).abs() / one.length().max(other.length());
            let integrals = if distance > FARTHER {
                by_quadrature(one, other, &rules[1])
            } else if distance > FAR {
                by_quadrature(one, other, &rules[0])
            } else {
                closed_form(one, other)
            };
            for (i, &row) in one.nodes.iter().enumerate() {
                for (j, &column) in other.nodes.iter().enumerate() {
                    sums[(row, column)] += integrals[i][j];
                    if k != l {
                        sums[(column, row)] += integrals[i][j];
                    }
                }
            }
        }
    }
    let scale = -2.0 / (PI * modulus);
    sums.entries_mut().iter_mut().for_each(|entry| *entry *= scale);
    sums
}

/// ∬ N_i(x) M_j(t) ln|x − t| dx dt over two parts, with the shape functions of their ends.
fn by_quadrature(one: &SurfaceSegment, other: &SurfaceSegment, rule: &[(f64, f64)]) -> [[f64; 2]; 2] {
    let mut sums = [[0.0; 2]; 2];
    for &(s, weight) in rule {
        let x = one.range.0 + s * one.length();
        let mut inner = [0.0; 2];
        for &(t, weight) in rule {
            let value = weight * (x - other.range.0 - t * other.length()).abs().ln();
            inner[0] += (1.0 - t) * value;
            inner[1] += t * value;
        }
        for (sums, shape) in sums.iter_mut().zip([1.0 - s, s]) {
            sums[0] += weight * shape * inner[0];
            sums[1] += weight * shape * inner[1];
        }
    }
    let area = one.length() * other.length();
    sums.map(|row| row.map(|sum| sum * area))
}

/// The shape functions of the ends of a part, as sums of (x − x_e)₊ · ramp + [x > x_e] · step over
/// its ends e; rows (ramp, step) by end.
fn shapes(segment: &SurfaceSegment) -> [[(f64, f64); 2]; 2] {
    let slope = 1.0 / segment.length();
    [[(-slope, 1.0), (slope, 0.0)], [(slope, 0.0), (-slope, -1.0)]]
}

/// [`by_quadrature`] from the fourth antiderivative of ln|d|, d⁴/24 ln|d| − 25 d⁴/288, and its
/// derivatives.
fn closed_form(one: &SurfaceSegment, other: &SurfaceSegment) -> [[f64; 2]; 2] {
    // The fourth, third and second antiderivatives between two ends.
    let antiderivatives = |at: f64, other: f64| {
        let d = at - other;
        if d == 0.0 {
            return [0.0; 3];
        }
        let (square, log) = (d * d, d.abs().ln());
        [
            square * square * (log / 24.0 - 25.0 / 288.0),
            square * d * (log / 6.0 - 11.0 / 36.0),
            square * (0.5 * log - 0.75),
        ]
    };
    let (ours, theirs) = ([one.range.0, one.range.1], [other.range.0, other.range.1]);
    let between = ours.map(|at| theirs.map(|other| antiderivatives(at, other)));
    let (ones, others) = (shapes(one), shapes(other));
    let integral = |i: usize, j: usize| -> f64 {
        let mut sum = 0.0;
        for (&(ramp, step), between) in ones[i].iter().zip(&between) {
            for (&(other_ramp, other_step), [fourth, third, second]) in others[j].iter().zip(between) {
                sum += ramp * other_ramp * fourth + (ramp * other_step - step * other_ramp) * third
                    - step * other_step * second;
            }
        }
        sum
    };
    [[integral(0, 0), integral(0, 1)], [integral(1, 0), integral(1, 1)]]
}

#[cfg(test)]
mod tests {
    use super::super::grid::NodeSpacing;
    use super::*;

    fn segment(from: f64, to: f64) -> SurfaceSegment {
        SurfaceSegment { range: (from, to), nodes: [0, 1] }
    }

    #[test]
    fn closed_form_and_quadrature_agree_where_both_hold() {
        let rule = gauss_legendre(12);
        for (one, other) in [(segment(0.0, 0.5), segment(2.0, 2.3)), (segment(3.0, 3.1), segment(-1.0, -0.2))]
        {
            let (exact, sum) = (closed_form(&one, &other), by_quadrature(&one, &other, &rule));
            for (exact, sum) in exact.iter().flatten().zip(sum.iter().flatten()) {
                assert!((exact - sum).abs() < 1e-12, "{exact} {sum}");
            }
        }
    }

    #[test]
    fn fewer_points_are_as_accurate_farther_away() {
        let (one, other) = (segment(0.0, 0.5), segment(20.2, 20.4));
        let sums = [POINTS, FEWER].map(|points| by_quadrature(&one, &other, &gauss_legendre(points)));
        for (sum, fewer) in sums[0].iter().flatten().zip(sums[1].iter().flatten()) {
            assert!((sum - fewer).abs() < 1e-12 * sum.abs(), "{sum} {fewer}");
        }
    }

    #[test]
    fn one_part_alone_has_its_known_integral() {
        // ∫∫ ln|x − t| over [0, h]² = h² (ln h − 3/2).
        let h: f64 = 0.3;
        let sum: f64 = closed_form(&segment(1.0, 1.0 + h), &segment(1.0, 1.0 + h)).iter().flatten().sum();
        assert!((sum - h * h * (h.ln() - 1.5)).abs() < 1e-14, "{sum}");
    }

    #[test]
    fn a_uniform_grid_has_the_fourth_differences_of_the_antiderivative() {
        let spacing = NodeSpacing { at_mouth: 0.5, away: 0.5, near: 40.0 };
        let grid = SurfaceGrid::new((0.0, 40.0), &[30.0], spacing);
        let matrix = compliance(&grid, 2.0 / PI);
        let h = grid.segments[0].length();
        let antiderivative = |x: f64| {
            let log = if x == 0.0 { 0.0 } else { x.abs().ln() };
            x.powi(4) / 24.0 * log - 25.0 * x.powi(4) / 288.0
        };
        for apart in 0..10 {
            let weights = [1.0, -4.0, 6.0, -4.0, 1.0];
            let sum: f64 =
                (0..5).map(|k| weights[k] * antiderivative(h * (apart as f64 + k as f64 - 2.0))).sum();
            let got = matrix[(20, 20 + apart)];
            assert!((got + sum / (h * h)).abs() < 1e-9 * (1.0 + sum.abs()), "{apart}: {got}");
        }
    }
}

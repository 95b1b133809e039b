//! Minimal residuals of linear systems that are given by products only.

use crate::math::{axpy, dot};

/// The combination of directions with the smallest residual.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LeastResidual {
    /// The factor of each direction.
    pub factors: Vec<f64>,
    /// Residual over the size of the right-hand side.
    pub residual: f64,
}

/// Minimal residuals (GMRES; Saad & Schultz 1986) of A x = b: the directions are b and the
/// `product` of each previous direction, orthonormalised, and the solution is a combination of
/// them. The iteration ends when the residual falls below `tolerance` of b or after `most`
/// directions.
///
/// `product` returns A times a direction; the caller stores the direction or its equivalent.
///
/// Errors: those of `product`.
pub(crate) fn least_residual<E>(
    right: &[f64],
    tolerance: f64,
    most: usize,
    mut product: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<LeastResidual, E> {
    let size = dot(right, right).sqrt();
    if size == 0.0 {
        return Ok(LeastResidual { factors: Vec::new(), residual: 0.0 });
    }
    let mut directions = vec![right.iter().map(|b| b / size).collect::<Vec<f64>>()];
    // Columns of the upper triangular factor of Hessenberg's matrix, its rotations, and the
    // right-hand side after these rotations.
    let (mut triangle, mut rotations) = (Vec::<Vec<f64>>::new(), Vec::<[f64; 2]>::new());
    let mut turned = vec![size];
    for k in 0..most {
        let mut next = product(&directions[k])?;
        let mut column = Vec::with_capacity(k + 2);
        for direction in &directions {
            let part = dot(direction, &next);
            axpy(-part, direction, &mut next);
            column.push(part);
        }
        let rest = dot(&next, &next).sqrt();
        for (i, [cos, sin]) in rotations.iter().enumerate() {
            let (upper, lower) = (column[i], column[i + 1]);
            column[i] = cos * upper + sin * lower;
            column[i + 1] = cos * lower - sin * upper;
        }
        let pivot = column[k].hypot(rest);
        if pivot == 0.0 {
            break;
        }
        let [cos, sin] = [column[k] / pivot, rest / pivot];
        column[k] = pivot;
        triangle.push(column);
        rotations.push([cos, sin]);
        let last = turned[k];
        turned[k] = cos * last;
        turned.push(-sin * last);
        if turned[k + 1].abs() <= tolerance * size || rest == 0.0 {
            break;
        }
        next.iter_mut().for_each(|value| *value /= rest);
        directions.push(next);
    }
    let count = triangle.len();
    let mut factors = turned[..count].to_vec();
    for k in (0..count).rev() {
        factors[k] /= triangle[k][k];
        let known = factors[k];
        (0..k).for_each(|i| factors[i] -= known * triangle[k][i]);
    }
    Ok(LeastResidual { factors, residual: turned[count].abs() / size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Matrix;
    use std::convert::Infallible;

    #[test]
    fn solves_by_products() {
        let order = 40;
        let entry = |i: usize, j: usize| {
            let near = 1.0 / (1.0 + 3.0 * (i as f64 - j as f64).powi(2));
            near + 0.1 * f64::from(i == j + 1)
        };
        let matrix = Matrix::from_fn(order, order, entry);
        let right: Vec<f64> = (0..order).map(|i| (i as f64).cos()).collect();
        for tolerance in [1e-3, 1e-12] {
            let mut directions = Vec::new();
            let least = least_residual(&right, tolerance, order, |direction| {
                directions.push(direction.to_vec());
                Ok::<_, Infallible>(matrix.times(direction))
            })
            .unwrap();
            let mut solution = vec![0.0; order];
            for (factor, direction) in least.factors.iter().zip(&directions) {
                axpy(*factor, direction, &mut solution);
            }
            let left: Vec<f64> = matrix.times(&solution).iter().zip(&right).map(|(a, b)| b - a).collect();
            let residual = (dot(&left, &left) / dot(&right, &right)).sqrt();
            assert!(residual <= tolerance && (residual - least.residual).abs() < 1e-13, "{residual:e}");
        }
        let nothing = least_residual(&[0.0; 3], 0.1, 5, |v| Ok::<_, Infallible>(v.to_vec())).unwrap();
        assert!(nothing.factors.is_empty());
        let unit = least_residual(&[1.0, 2.0], 0.0, 5, |v| Ok::<_, Infallible>(v.to_vec())).unwrap();
        assert!(unit.factors.len() == 1 && unit.residual < 1e-15, "{unit:?}");
    }
}

//! Least squares with unknowns that are not negative.

/// Greatest number of changes of the set of positive unknowns, per unknown.
const ROUNDS: usize = 10;
/// Descent of the square, relative to the right-hand side, that counts as none.
const AT_REST: f64 = 1e-12;

/// The x ≥ 0 that minimises xᵀNx/2 − rᵀx, with the positive definite matrix of `normal` equations N
/// and their right-hand side r: the method of Lawson & Hanson (Solving Least Squares Problems,
/// 1974, chapter 23). Unknowns that N does not determine are zero.
pub(crate) fn minimum(normal: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let order = right.len();
    let mut at = vec![0.0; order];
    let mut positive = vec![false; order];
    let mut undetermined = vec![false; order];
    let scale = right.iter().fold(0.0f64, |most, value| most.max(value.abs()));
    for _ in 0..ROUNDS * order {
        let descent = |i: usize| right[i] - crate::math::dot(&normal[i], &at);
        let steepest = (0..order)
            .filter(|&i| !positive[i] && !undetermined[i])
            .map(|i| (i, descent(i)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a });
        let Some((entering, _)) = steepest.filter(|(_, descent)| *descent > AT_REST * scale) else { break };
        positive[entering] = true;
        loop {
            let set: Vec<usize> = (0..order).filter(|&i| positive[i]).collect();
            let Some(free) = solution(normal, right, &set) else {
                positive[entering] = false;
                undetermined[entering] = true;
                break;
            };
            let blocked = set.iter().zip(&free).filter(|(_, value)| **value <= 0.0);
            let parts = blocked.map(|(&i, value)| (i, at[i] / (at[i] - value)));
            let Some((leaving, part)) = parts.reduce(|a, b| if b.1 < a.1 { b } else { a }) else {
                set.iter().zip(free).for_each(|(&i, value)| at[i] = value);
                break;
            };
            let part = if part.is_nan() { 0.0 } else { part };
            for (&i, value) in set.iter().zip(&free) {
                at[i] += part * (value - at[i]);
            }
            at[leaving] = 0.0;
            positive[leaving] = false;
        }
    }
    at
}

/// The solution of the equations of `set`, with all other unknowns zero; none where they do not
/// determine it.
fn solution(normal: &[Vec<f64>], right: &[f64], set: &[usize]) -> Option<Vec<f64>> {
    let order = set.len();
    let row = |&i: &usize| set.iter().map(|&j| normal[i][j]).chain([right[i]]).collect();
    let mut matrix: Vec<Vec<f64>> = set.iter().map(row).collect();
    // Elimination without pivoting: the matrix is positive definite.
    for k in 0..order {
        let pivot = matrix[k][k];
        if pivot.is_nan() || pivot <= f64::EPSILON * normal[set[k]][set[k]] {
            return None;
        }
        for i in 0..order {
            if i != k {
                let factor = matrix[i][k] / pivot;
                for j in k..=order {
                    let above = matrix[k][j];
                    matrix[i][j] -= factor * above;
                }
            }
        }
    }
    Some((0..order).map(|k| matrix[k][order] / matrix[k][k]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The conditions of a minimum: no descent along positive unknowns, none into the others.
        #[test]
        fn no_admissible_change_descends(
            rows in proptest::collection::vec(proptest::collection::vec(-1.0f64..1.0, 6), 9),
            wanted in proptest::collection::vec(-1.0f64..1.0, 9),
        ) {
            let product = |i: usize, j: usize| rows.iter().map(|row| row[i] * row[j]).sum::<f64>();
            let normal: Vec<Vec<f64>> = (0..6).map(|i| (0..6).map(|j| product(i, j)).collect()).collect();
            let right: Vec<f64> =
                (0..6).map(|i| rows.iter().zip(&wanted).map(|(row, want)| row[i] * want).sum()).collect();
            let at = minimum(&normal, &right);
            for i in 0..6 {
                let descent = right[i] - crate::math::dot(&normal[i], &at);
                prop_assert!(at[i] >= 0.0 && descent < 1e-9, "{at:?} {descent}");
                prop_assert!(at[i] == 0.0 || descent > -1e-9, "{at:?} {descent}");
            }
        }
    }

    #[test]
    fn an_unknown_without_influence_is_zero() {
        let normal = [vec![2.0, 0.0], vec![0.0, 0.0]];
        assert_eq!(minimum(&normal, &[1.0, 0.0]), [0.5, 0.0]);
    }
}

//! Symmetric matrices over the faces of cracks.
//!
//! The stiffness of a crack that is its own mirror image about the line of dip through its middle
//! does not couple even jumps with odd ones. In the orthonormal basis (w ± w′)/√2, w′ being the
//! jump at the mirror image with the sign of its component, and w itself on the line, it consists
//! of two matrices of half the order: half the memory and half of a product of the whole matrix,
//! and a quarter of its inverse.

use super::mirror_image::{SIGNS, images};
use crate::interruption::Interruption;
use crate::linear::{LinearError, spd_inverse_unless};
use crate::math::{Matrix, add_rows_to_each};
use rayon::prelude::*;
use std::borrow::Cow;
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// Number of rows of a product that one thread computes; their sums do not depend on the thread.
const ROWS: usize = 450;

/// A symmetric matrix over the points of cracks: A (N/mm) maps jumps to nodal forces, C (mm/N)
/// forces to jumps. Component i of point a has the row 3a + i. The matrix of a crack that is its
/// own mirror image is kept in two parts, those of even and of odd values.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceMatrix {
    order: usize,
    parts: Vec<Part>,
}

/// The matrix Wᵀ M W, where each column of W has one entry at most.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    matrix: Arc<Matrix>,
    places: Places,
}

/// The entry of each column of W; none in a column that is zero.
#[derive(Debug, Clone, PartialEq)]
enum Places {
    /// W is the unit matrix.
    Unit,
    Given(Arc<[Option<Place>]>),
}

/// The entry of a column of W.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    row: usize,
    weight: f64,
}

impl Places {
    fn of(&self, column: usize) -> Option<Place> {
        match self {
            Self::Unit => Some(Place { row: column, weight: 1.0 }),
            Self::Given(places) => places[column],
        }
    }

    fn given(places: Vec<Option<Place>>) -> Self {
        Self::Given(places.into())
    }

    /// Those of even (1) or odd (−1) values at points with these mirror images, and the number of
    /// rows of W.
    fn about_the_middle(images: &[usize], parity: f64) -> (Self, usize) {
        let mut places = vec![None; 3 * images.len()];
        let mut rows = 0;
        for (point, &image) in images.iter().enumerate() {
            for (c, sign) in SIGNS.into_iter().enumerate() {
                let weight = parity * sign;
                if point == image && weight > 0.0 {
                    places[3 * point + c] = Some(Place { row: rows, weight });
                    rows += 1;
                } else if point < image {
                    places[3 * point + c] = Some(Place { row: rows, weight: FRAC_1_SQRT_2 });
                    places[3 * image + c] = Some(Place { row: rows, weight: weight * FRAC_1_SQRT_2 });
                    rows += 1;
                }
            }
        }
        (Self::given(places), rows)
    }
}

impl From<Matrix> for FaceMatrix {
    /// The symmetric `matrix` as a whole.
    fn from(matrix: Matrix) -> Self {
        let order = matrix.rows();
        Self { order, parts: vec![Part { matrix: Arc::new(matrix), places: Places::Unit }] }
    }
}

impl FaceMatrix {
    /// Number of rows and columns, 3p.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The entry in row i and column j, both from 0.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let of = |Part { matrix, places }: &Part| match (places.of(i), places.of(j)) {
            (Some(one), Some(other)) => one.weight * other.weight * matrix[(one.row, other.row)],
            _ => 0.0,
        };
        self.parts.iter().map(of).sum()
    }

    /// Row i, which is column i.
    pub(super) fn row(&self, i: usize) -> Cow<'_, [f64]> {
        if let [Part { matrix, places: Places::Unit }] = &self.parts[..] {
            return Cow::Borrowed(matrix.row(i));
        }
        Cow::Owned(self.row_at(i, 0..self.order / 3).into_flattened())
    }

    /// The entries of row i at the components of each of `points`.
    pub(super) fn row_at(
        &self,
        i: usize,
        points: impl ExactSizeIterator<Item = usize> + Clone,
    ) -> Vec<[f64; 3]> {
        let mut row = vec![[0.0; 3]; points.len()];
        for Part { matrix, places } in &self.parts {
            let Some(own) = places.of(i) else { continue };
            let entries = matrix.row(own.row);
            for (values, point) in row.iter_mut().zip(points.clone()) {
                for (c, value) in values.iter_mut().enumerate() {
                    if let Some(place) = places.of(3 * point + c) {
                        *value += own.weight * place.weight * entries[place.row];
                    }
                }
            }
        }
        row
    }

    /// All entries.
    pub fn to_matrix(&self) -> Matrix {
        Matrix::from_fn(self.order, self.order, |i, j| self.entry(i, j))
    }

    /// The product with `values` (3p), of which many may be zero.
    pub fn times(&self, values: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.order];
        self.parts.iter().for_each(|part| part.add_product(values, &mut product));
        product
    }

    /// The matrix times a factor.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        for part in &mut self.parts {
            Arc::make_mut(&mut part.matrix).entries_mut().iter_mut().for_each(|entry| *entry *= factor);
        }
        self
    }

    /// The inverse. An `interruption` ends the computation.
    ///
    /// Errors: a matrix that is not positive definite; the interruption.
    pub(super) fn inverse_unless(&self, interruption: Interruption<'_>) -> Result<Self, LinearError> {
        // The rows of W are orthonormal.
        let inverse = |Part { matrix, places }: &Part| {
            let inverse = spd_inverse_unless(interruption, matrix).map_err(|error| match error {
                LinearError::NotPositiveDefinite { pivot, .. } => {
                    let has_pivot = |&i: &usize| places.of(i).is_some_and(|place| place.row == pivot);
                    let pivot = (0..self.order).find(has_pivot).unwrap_or(pivot);
                    LinearError::NotPositiveDefinite { order: self.order, pivot }
                }
                error => error,
            })?;
            Ok::<_, LinearError>(Part { matrix: Arc::new(inverse), places: places.clone() })
        };
        Ok(Self { order: self.order, parts: self.parts.iter().map(inverse).collect::<Result<_, _>>()? })
    }

    /// The even part over the values at the first points of `pairs` of a point and its mirror
    /// image; `weight` makes the weight of a component from that in the orthonormal basis.
    /// Components that are zero by symmetry are kept apart, with the entry that `alone` makes of
    /// their number. None where the matrix does not consist of an even and an odd part.
    pub(super) fn even_part(
        &self,
        pairs: &[[usize; 2]],
        weight: impl Fn(f64) -> f64,
        alone: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        let [even, _] = &self.parts[..] else { return None };
        let components: Vec<usize> =
            pairs.iter().flat_map(|[one, _]| (0..3).map(move |c| 3 * one + c)).collect();
        let place = |i: &usize| {
            even.places.of(*i).map(|Place { row, weight: own }| Place { row, weight: weight(own) })
        };
        let places: Vec<_> = components.iter().map(place).collect();
        let vanishing: Vec<usize> = (0..components.len()).filter(|&k| places[k].is_none()).collect();
        let mut apart = vec![None; components.len()];
        vanishing.iter().enumerate().for_each(|(row, &k)| apart[k] = Some(Place { row, weight: 1.0 }));
        let own = |i: usize, j: usize| if i == j { alone(components[vanishing[i]]) } else { 0.0 };
        let own = Matrix::from_fn(vanishing.len(), vanishing.len(), own);
        let parts = vec![
            Part { matrix: Arc::clone(&even.matrix), places: Places::given(places) },
            Part { matrix: Arc::new(own), places: Places::given(apart) },
        ];
        Some(Self { order: components.len(), parts })
    }
}

impl Part {
    /// Adds the product with `values` to `product`.
    fn add_product(&self, values: &[f64], product: &mut [f64]) {
        let mut own = vec![0.0; self.matrix.rows()];
        for (column, value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            if let Some(Place { row, weight }) = self.places.of(column) {
                own[row] += weight * value;
            }
        }
        let (places, weights): (Vec<usize>, Vec<f64>) =
            own.iter().enumerate().filter(|(_, value)| **value != 0.0).unzip();
        let mut image = vec![0.0; own.len()];
        image.par_chunks_mut(ROWS).enumerate().for_each(|(k, chunk)| {
            let (from, to) = (k * ROWS, k * ROWS + chunk.len());
            // Rows are columns.
            add_rows_to_each(&[&weights], |i| &self.matrix.row(places[i])[from..to], &mut [chunk]);
        });
        for (column, sum) in product.iter_mut().enumerate() {
            if let Some(Place { row, weight }) = self.places.of(column) {
                *sum += weight * image[row];
            }
        }
    }
}

/// A sum of entries that becomes a symmetric matrix over the points of a crack.
pub(super) struct FaceSum {
    order: usize,
    parts: Vec<(Matrix, Places)>,
}

impl FaceSum {
    /// The empty sum over `points` (s, ζ): in two parts if they are their own mirror image about
    /// the line of dip through the middle. The sum is then averaged with its mirror image.
    pub fn over(points: &[[f64; 2]]) -> Self {
        let order = 3 * points.len();
        let empty = |(places, rows): (Places, usize)| (Matrix::zeros(rows, rows), places);
        let parts = match images(points) {
            Some(images) => [1.0, -1.0].map(|parity| empty(Places::about_the_middle(&images, parity))).into(),
            None => vec![empty((Places::Unit, order))],
        };
        Self { order, parts }
    }

    /// Adds `value` to the entry in row i and column j.
    pub fn add(&mut self, [i, j]: [usize; 2], value: f64) {
        for (matrix, places) in &mut self.parts {
            if let (Some(one), Some(other)) = (places.of(i), places.of(j)) {
                matrix[(one.row, other.row)] += one.weight * other.weight * value;
            }
        }
    }

    /// The sum and its transpose together.
    pub fn with_transpose(self) -> FaceMatrix {
        let symmetric = |(mut matrix, places): (Matrix, Places)| {
            for i in 0..matrix.rows() {
                for j in 0..=i {
                    let both = matrix[(i, j)] + matrix[(j, i)];
                    matrix[(i, j)] = both;
                    matrix[(j, i)] = both;
                }
            }
            Part { matrix: Arc::new(matrix), places }
        };
        FaceMatrix { order: self.order, parts: self.parts.into_iter().map(symmetric).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four points, of which the second lies on the line of dip.
    const POINTS: [[f64; 2]; 4] = [[1.0, -2.0], [0.5, 0.0], [1.0, 2.0], [3.0, 0.0]];
    const IMAGES: [usize; 4] = [2, 1, 0, 3];

    /// A positive definite matrix that is its own mirror image.
    fn symmetric() -> Matrix {
        let entry = |i: usize, j: usize| {
            let (low, high) = (i.min(j), i.max(j));
            (1.3 * (low * 5 + 3 * high) as f64).sin() + if i == j { 14.0 } else { 0.0 }
        };
        let image = |i: usize| 3 * IMAGES[i / 3] + i % 3;
        let sign = |i: usize| SIGNS[i % 3];
        Matrix::from_fn(12, 12, |i, j| 0.5 * (entry(i, j) + sign(i) * sign(j) * entry(image(i), image(j))))
    }

    fn summed(points: &[[f64; 2]], matrix: &Matrix) -> FaceMatrix {
        let mut sum = FaceSum::over(points);
        (0..12).for_each(|i| (0..12).for_each(|j| sum.add([i, j], 0.5 * matrix[(i, j)])));
        sum.with_transpose()
    }

    fn gap(one: &[f64], other: &[f64]) -> f64 {
        assert_eq!(one.len(), other.len());
        one.iter().zip(other).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
    }

    #[test]
    fn two_parts_are_the_whole() {
        let matrix = symmetric();
        let parts = summed(&POINTS, &matrix);
        let orders: Vec<usize> = parts.parts.iter().map(|part| part.matrix.rows()).collect();
        assert_eq!(orders, [7, 5]);
        let whole = FaceMatrix::from(matrix.clone());
        assert!(gap(parts.to_matrix().entries(), matrix.entries()) < 1e-14);
        let values: Vec<f64> = (0..12).map(|i| if i % 4 == 1 { 0.0 } else { (i as f64).cos() }).collect();
        let inverses = [&parts, &whole].map(|matrix| matrix.inverse_unless(Interruption::NEVER).unwrap());
        for (parts, whole) in [(&parts, &whole), (&inverses[0], &inverses[1])] {
            assert!(gap(&parts.times(&values), &whole.times(&values)) < 1e-13);
            (0..12).for_each(|i| assert!(gap(&parts.row(i), &whole.row(i)) < 1e-14, "row {i}"));
        }
        assert!(gap(&inverses[0].times(&parts.times(&values)), &values) < 1e-14);
    }

    #[test]
    fn what_is_not_mirrored_is_averaged_or_kept() {
        let lopsided = Matrix::from_fn(12, 12, |i, j| ((i * j) as f64).sin() + ((i + j) as f64).cos());
        let averaged = summed(&POINTS, &lopsided).to_matrix();
        for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
            let [row, column] = [i, j].map(|k| 3 * IMAGES[k / 3] + k % 3);
            let mirrored = SIGNS[i % 3] * SIGNS[j % 3] * lopsided[(row, column)];
            assert!((averaged[(i, j)] - 0.5 * (lopsided[(i, j)] + mirrored)).abs() < 1e-14, "({i}, {j})");
        }
        let mut moved = POINTS;
        moved[0][1] = -2.1;
        assert_eq!(summed(&moved, &lopsided), FaceMatrix::from(lopsided));
    }

    #[test]
    fn a_pivot_is_that_of_its_component() {
        let mut indefinite = symmetric();
        // Slip along the trace on the line of dip is in the odd part alone.
        indefinite[(5, 5)] = -1.0;
        for matrix in [summed(&POINTS, &indefinite), FaceMatrix::from(indefinite)] {
            let error = matrix.inverse_unless(Interruption::NEVER).unwrap_err();
            let LinearError::NotPositiveDefinite { order: 12, pivot } = error else { panic!("{error}") };
            assert!(pivot / 3 <= 1, "{pivot}");
        }
    }
}

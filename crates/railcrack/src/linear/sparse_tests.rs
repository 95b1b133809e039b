//! Sparse factor: residuals, comparison with dense algebra, and bits independent of other columns.

use super::{
    ElementSum, LinearError, PANEL_COLUMNS, ReachedPanel, SparseCholesky, SparseColumn, SparseFactor, gram,
    spd_inverse,
};
use crate::interruption::Interruption;
use crate::math::Matrix;
use std::sync::Arc;

/// Pseudo-random numbers in (−1, 1).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() + 1.0) * 0.5 * n as f64) as usize % n
    }
}

/// The sum of listed matrices.
struct Elements {
    order: usize,
    all: Vec<(Vec<Option<usize>>, Matrix)>,
}

impl ElementSum for Elements {
    fn order(&self) -> usize {
        self.order
    }

    fn count(&self) -> usize {
        self.all.len()
    }

    fn unknowns(&self, element: usize) -> Vec<Option<usize>> {
        self.all[element].0.clone()
    }

    fn matrix(&self, element: usize) -> Matrix {
        self.all[element].1.clone()
    }
}

impl Elements {
    fn dense(&self) -> Matrix {
        let mut dense = Matrix::zeros(self.order, self.order);
        self.for_entries(|i, j, value| dense[(i, j)] += value);
        dense
    }

    fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.order];
        self.for_entries(|i, j, value| product[i] += value * vector[j]);
        product
    }

    fn for_entries(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for (unknowns, matrix) in &self.all {
            for (i, row) in unknowns.iter().enumerate() {
                for (j, column) in unknowns.iter().enumerate() {
                    if let (Some(row), Some(column)) = (row, column) {
                        visit(*row, *column, matrix[(i, j)]);
                    }
                }
            }
        }
    }
}

/// Two unknowns at each node of `columns` × `rows` squares with random symmetric positive definite
/// blocks.
struct SquareLattice {
    columns: usize,
    rows: usize,
    squares: Vec<[Option<usize>; 8]>,
}

impl SquareLattice {
    fn new(columns: usize, rows: usize) -> Self {
        let square = |e: usize| {
            let first = (e / columns) * (columns + 1) + e % columns;
            let nodes = [first, first + 1, first + columns + 1, first + columns + 2];
            std::array::from_fn(|k| Some(2 * nodes[k / 2] + k % 2))
        };
        Self { columns, rows, squares: (0..columns * rows).map(square).collect() }
    }

    fn order(&self) -> usize {
        2 * (self.columns + 1) * (self.rows + 1)
    }

    fn matrix(&self, seed: u64) -> Elements {
        let mut chance = Chance(seed);
        let block = |square: &[Option<usize>; 8]| {
            let half = Matrix::from_fn(8, 8, |_, _| chance.next());
            let block = Matrix::from_fn(8, 8, |i, j| {
                let product: f64 = half.row(i).iter().zip(half.row(j)).map(|(a, b)| a * b).sum();
                product + 0.1 * f64::from(i == j)
            });
            (square.to_vec(), block)
        };
        Elements { order: self.order(), all: self.squares.iter().map(block).collect() }
    }

    /// Unknowns in the order of recursive bisection.
    fn elimination_order(&self) -> Vec<usize> {
        let mut order = Vec::new();
        self.bisect((0, self.columns + 1), (0, self.rows + 1), &mut order);
        order
    }

    fn bisect(&self, x: (usize, usize), y: (usize, usize), order: &mut Vec<usize>) {
        let (wide, high) = (x.1 - x.0, y.1 - y.0);
        if wide.max(high) <= 2 {
            for (r, c) in (y.0..y.1).flat_map(|r| (x.0..x.1).map(move |c| (r, c))) {
                let node = r * (self.columns + 1) + c;
                order.extend([2 * node, 2 * node + 1]);
            }
        } else if wide >= high {
            let line = (x.0 + x.1) / 2;
            for part in [(x.0, line), (line + 1, x.1), (line, line + 1)] {
                self.bisect(part, y, order);
            }
        } else {
            let line = (y.0 + y.1) / 2;
            for part in [(y.0, line), (line + 1, y.1), (line, line + 1)] {
                self.bisect(x, part, order);
            }
        }
    }

    fn factored(&self, seed: u64) -> (Elements, SparseFactor) {
        let matrix = self.matrix(seed);
        let analysed = SparseCholesky::analyse(&matrix, self.elimination_order()).unwrap();
        let factor = analysed.factor(&matrix).unwrap();
        (matrix, factor)
    }

    /// Columns on the unknowns of one to three squares that lie next to each other.
    fn local_columns(&self, count: usize) -> Vec<SparseColumn> {
        let mut chance = Chance(99);
        let column = |_| {
            let first = chance.below(self.squares.len() - 3);
            let squares = &self.squares[first..=first + chance.below(3)];
            let unknowns: Vec<usize> = squares.iter().flatten().copied().flatten().collect();
            SparseColumn { entries: unknowns.into_iter().map(|u| (u, chance.next())).collect() }
        };
        (0..count).map(column).collect()
    }
}

/// Round-off of a few thousand operations on numbers of order 1, times the condition number of the
/// matrices (below 1e4).
const ROUND_OFF: f64 = 1e-10;

fn full(order: usize, column: &SparseColumn) -> Vec<f64> {
    let mut full = vec![0.0; order];
    column.entries.iter().for_each(|&(unknown, value)| full[unknown] += value);
    full
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |worst, (x, y)| (x - y).abs().max(worst))
}

/// Half-solved `columns` in their panels.
fn panels(factor: &SparseFactor, columns: &[SparseColumn]) -> Vec<Arc<ReachedPanel>> {
    factor.forward(columns, Interruption::NEVER).unwrap().into_iter().map(Arc::new).collect()
}

#[test]
fn solutions_by_residual() {
    // The last size has fronts of several blocks.
    for (columns, rows) in [(1, 1), (2, 5), (7, 3), (16, 16), (40, 23), (110, 104)] {
        let grid = SquareLattice::new(columns, rows);
        let (matrix, factor) = grid.factored(5);
        let mut chance = Chance(1);
        // More columns than one panel holds.
        let right: Vec<f64> = (0..37 * grid.order()).map(|_| chance.next()).collect();
        let mut solutions = right.clone();
        factor.solve(&mut solutions).unwrap();
        for (b, x) in right.chunks(grid.order()).zip(solutions.chunks(grid.order())) {
            let residual = largest_difference(&matrix.times(x), b);
            assert!(residual < ROUND_OFF, "{columns} x {rows}: {residual:e}");
            let mut alone = b.to_vec();
            factor.solve(&mut alone).unwrap();
            assert_eq!(alone, x, "in other company");
        }
    }
}

#[test]
fn products_agree_with_dense_algebra() {
    let grid = SquareLattice::new(6, 5);
    let (matrix, factor) = grid.factored(8);
    let inverse = spd_inverse(&matrix.dense()).unwrap();
    let columns = grid.local_columns(30);
    let products = gram(&panels(&factor, &columns), 0, Interruption::NEVER).unwrap();
    assert_eq!(products.len(), columns.len());
    for (i, a) in columns.iter().enumerate() {
        let solution = inverse.times(&full(grid.order(), a));
        assert_eq!(products[i].len(), i + 1);
        for (j, b) in columns[..=i].iter().enumerate() {
            let want: f64 = full(grid.order(), b).iter().zip(&solution).map(|(x, y)| x * y).sum();
            assert!((products[i][j] - want).abs() < ROUND_OFF, "({i}, {j}): {} {want}", products[i][j]);
        }
    }
}

#[test]
fn panels_store_only_the_reach_of_their_columns() {
    let grid = SquareLattice::new(30, 30);
    let (matrix, factor) = grid.factored(3);
    let column = &grid.local_columns(1)[0];
    let alone = factor.forward(std::slice::from_ref(column), Interruption::NEVER).unwrap().remove(0);
    let rows: usize = alone.supernodes().iter().map(|&s| alone.rows_of(s).len()).sum();
    assert!(2 * rows < grid.order(), "{rows} of {}", grid.order());
    // Still, its square is the energy of the full solution.
    let right = full(grid.order(), column);
    let mut solution = right.clone();
    factor.solve(&mut solution).unwrap();
    assert!(largest_difference(&matrix.times(&solution), &right) < ROUND_OFF);
    let energy: f64 = right.iter().zip(&solution).map(|(b, x)| b * x).sum();
    assert!((gram(&[Arc::new(alone)], 0, Interruption::NEVER).unwrap()[0][0] - energy).abs() < ROUND_OFF);
}

#[test]
fn the_bits_do_not_depend_on_the_other_columns() {
    let grid = SquareLattice::new(30, 21);
    let (_, factor) = grid.factored(11);
    let columns = grid.local_columns(130);
    let together = panels(&factor, &columns);
    let all = gram(&together, 0, Interruption::NEVER).unwrap();

    // In reverse order, other columns share the panels.
    let reversed: Vec<SparseColumn> = columns.iter().rev().cloned().collect();
    let backwards = gram(&panels(&factor, &reversed), 0, Interruption::NEVER).unwrap();
    let last = columns.len() - 1;
    for i in 0..columns.len() {
        for j in 0..=i {
            let other = backwards[last - j][last - i];
            assert_eq!(all[i][j].to_bits(), other.to_bits(), "({i}, {j}) in other company");
        }
    }
    // Single pairs.
    for (i, j) in [(3, 2), (77, 5), (129, 128)] {
        let pair = panels(&factor, &[columns[j].clone(), columns[i].clone()]);
        assert_eq!(
            gram(&pair, 0, Interruption::NEVER).unwrap()[1][0].to_bits(),
            all[i][j].to_bits(),
            "({i}, {j}) alone"
        );
    }
    // The last panels with those before them.
    for first in 0..together.len() {
        assert_eq!(
            gram(&together, first, Interruption::NEVER).unwrap(),
            all[first * PANEL_COLUMNS..],
            "from panel {first}"
        );
    }
}

#[test]
fn wanted_unknowns_agree_with_the_full_solution() {
    let grid = SquareLattice::new(30, 30);
    let (_, factor) = grid.factored(3);
    let right: Vec<f64> = grid.local_columns(3).iter().flat_map(|b| full(grid.order(), b)).collect();
    let mut whole = right.clone();
    factor.solve(&mut whole).unwrap();
    // Unknowns far from the right-hand sides on several branches of the elimination tree, and close
    // to them.
    let wanted = [grid.order() - 1, 7, 8, 29, grid.order() - 30, grid.order() / 2];
    let mut part = right.clone();
    factor.solve_for(wanted, &mut part).unwrap();
    for (x, y) in whole.chunks(grid.order()).zip(part.chunks(grid.order())) {
        assert!(wanted.iter().all(|&i| x[i] == y[i] && x[i] != 0.0));
    }
    let left = right.iter().zip(&part).zip(&whole).filter(|((b, y), x)| b == y && y != x).count();
    assert!(2 * left > right.len(), "{left} of {} unknowns unsolved", right.len());
    assert!(matches!(
        factor.solve_for([grid.order()], &mut part).unwrap_err(),
        LinearError::NoSuchUnknown { .. }
    ));
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let grid = SquareLattice::new(110, 104);
    let columns = grid.local_columns(90);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (_, factor) = grid.factored(2);
            let mut solution = full(grid.order(), &columns[0]).repeat(20);
            factor.solve(&mut solution).unwrap();
            (gram(&panels(&factor, &columns), 0, Interruption::NEVER).unwrap(), solution)
        })
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn one_analysis_serves_every_matrix_of_the_same_elements() {
    let grid = SquareLattice::new(9, 4);
    let first = grid.matrix(1);
    let analysed = SparseCholesky::analyse(&first, grid.elimination_order()).unwrap();
    for matrix in [first, grid.matrix(2)] {
        let factor = analysed.factor(&matrix).unwrap();
        let mut solution = vec![1.0; grid.order()];
        factor.solve(&mut solution).unwrap();
        assert!(largest_difference(&matrix.times(&solution), &vec![1.0; grid.order()]) < ROUND_OFF);
    }
}

#[test]
fn an_indefinite_matrix_names_the_unknown() {
    let grid = SquareLattice::new(8, 8);
    let mut matrix = grid.matrix(4);
    let analysed = SparseCholesky::analyse(&matrix, grid.elimination_order()).unwrap();
    let unknown = 77;
    let enough = Matrix::from_fn(1, 1, |_, _| -2.0 * matrix.dense()[(unknown, unknown)]);
    matrix.all.push((vec![Some(unknown)], enough));
    let want = LinearError::NotPositiveDefinite { order: grid.order(), pivot: unknown };
    assert_eq!(analysed.factor(&matrix).unwrap_err(), want);
    matrix.all.push((vec![Some(unknown)], Matrix::from_fn(1, 1, |_, _| f64::NAN)));
    assert_eq!(analysed.factor(&matrix).unwrap_err(), want);
}

#[test]
fn held_unknowns_and_gaps_between_elements() {
    // Unknown 2 of the first element is held; the second has a single unknown; unknown 3 belongs to
    // none.
    let spring = Matrix::from_fn(2, 2, |i, j| if i == j { 3.0 } else { -1.0 });
    let springs = [vec![Some(0), Some(2)], vec![Some(2), Some(1)], vec![None, Some(1)], vec![Some(3), None]];
    let matrix =
        Elements { order: 4, all: springs.iter().map(|own| (own.clone(), spring.clone())).collect() };
    let dense = [[3.0, 0.0, -1.0, 0.0], [0.0, 6.0, -1.0, 0.0], [-1.0, -1.0, 6.0, 0.0], [0.0, 0.0, 0.0, 3.0]];
    let right = [1.0, 2.0, 3.0, 4.0];
    for order in [vec![0, 1, 2, 3], vec![3, 2, 0, 1]] {
        let mut solution = right.to_vec();
        SparseCholesky::analyse(&matrix, order)
            .unwrap()
            .factor(&matrix)
            .unwrap()
            .solve(&mut solution)
            .unwrap();
        for (row, right) in dense.iter().zip(right) {
            let sum: f64 = row.iter().zip(&solution).map(|(a, x)| a * x).sum();
            assert!((sum - right).abs() < 1e-14);
        }
    }
}

#[test]
fn refuses_elements_that_do_not_fit() {
    let unit = Matrix::from_fn(2, 2, |i, j| f64::from(i == j));
    let of = |order: usize, unknowns: [usize; 2]| Elements {
        order,
        all: vec![(unknowns.map(Some).to_vec(), unit.clone())],
    };
    let outside = SparseCholesky::analyse(&of(3, [0, 3]), vec![0, 1, 2]).unwrap_err();
    assert_eq!(outside, LinearError::NoSuchUnknown { unknown: 3, order: 3 });
    let analysed = SparseCholesky::analyse(&of(3, [0, 1]), vec![0, 1, 2]).unwrap();
    let refused = |matrix: &Elements| analysed.factor(matrix).unwrap_err();
    assert_eq!(refused(&of(3, [0, 2])), LinearError::OutsidePattern { row: 2, column: 0 });
    assert_eq!(refused(&of(3, [0, 3])), LinearError::NoSuchUnknown { unknown: 3, order: 3 });
    assert!(matches!(refused(&of(4, [0, 1])), LinearError::WrongLength { given: 4, expected: 3, .. }));
    let mut uneven = of(3, [0, 1]);
    uneven.all[0].1 = Matrix::zeros(1, 2);
    assert!(matches!(refused(&uneven), LinearError::WrongLength { given: 1, expected: 2, .. }));
}

#[test]
fn refuses_orders_and_columns_that_do_not_fit() {
    let grid = SquareLattice::new(2, 2);
    let matrix = grid.matrix(4);
    let order = grid.order();
    let refused = |order: Vec<usize>| SparseCholesky::analyse(&matrix, order).unwrap_err();
    assert_eq!(refused(vec![0; order]), LinearError::EliminatedTwice { unknown: 0 });
    assert_eq!(refused((1..=order).collect()), LinearError::NoSuchUnknown { unknown: order, order });
    assert!(matches!(refused(vec![0]), LinearError::WrongLength { .. }));
    let (_, factor) = grid.factored(4);
    assert!(factor.solve(&mut vec![0.0; order + 1]).is_err());
    let outside = SparseColumn { entries: vec![(order, 1.0)] };
    assert_eq!(
        factor.forward(&[outside], Interruption::NEVER),
        Err(LinearError::NoSuchUnknown { unknown: order, order })
    );
}

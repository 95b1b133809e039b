//! Sparse symmetric matrices, assembled from the blocks of elements.

use super::LinearError;
use crate::math::Matrix;
use std::sync::Arc;

/// The places of the entries of a sparse symmetric matrix: the lower triangle, column by column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SymmetricPattern {
    /// Column j has its rows at `starts[j]..starts[j + 1]`.
    starts: Vec<usize>,
    /// Rows in increasing order, the diagonal first.
    rows: Vec<usize>,
}

impl SymmetricPattern {
    /// The pattern of a matrix of `order` unknowns (from 0) to which each block couples its unknowns with each other. The
    /// diagonal is always there. `None` in a block is an unknown that is held: it has no row and no column.
    ///
    /// Errors: an unknown that is not below `order`.
    pub fn from_blocks<B: AsRef<[Option<usize>]>>(order: usize, blocks: &[B]) -> Result<Self, LinearError> {
        let unknowns = |block: usize| blocks[block].as_ref().iter().copied().flatten();
        // The blocks of each unknown, packed one unknown after the other.
        let mut first = vec![0; order + 1];
        for block in 0..blocks.len() {
            for unknown in unknowns(block) {
                if unknown >= order {
                    return Err(LinearError::NoSuchUnknown { unknown, order });
                }
                first[unknown + 1] += 1;
            }
        }
        for i in 0..order {
            first[i + 1] += first[i];
        }
        let mut blocks_of = vec![0; first[order]];
        let mut next = first.clone();
        for block in 0..blocks.len() {
            for unknown in unknowns(block) {
                blocks_of[next[unknown]] = block;
                next[unknown] += 1;
            }
        }
        let mut starts = vec![0];
        let mut rows = Vec::new();
        let mut column_of_last_visit = vec![usize::MAX; order];
        for column in 0..order {
            let begin = rows.len();
            column_of_last_visit[column] = column;
            rows.push(column);
            for &block in &blocks_of[first[column]..first[column + 1]] {
                for row in unknowns(block) {
                    if row > column && column_of_last_visit[row] != column {
                        column_of_last_visit[row] = column;
                        rows.push(row);
                    }
                }
            }
            rows[begin..].sort_unstable();
            starts.push(rows.len());
        }
        Ok(Self { starts, rows })
    }

    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.starts.len() - 1
    }

    /// Entries of the lower triangle, the diagonal included.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn starts(&self) -> &[usize] {
        &self.starts
    }

    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Where the entry (i, j) = (j, i) is kept.
    fn place(&self, i: usize, j: usize) -> Result<usize, LinearError> {
        let (row, column) = (i.max(j), i.min(j));
        let (Some(&begin), Some(&end)) = (self.starts.get(column), self.starts.get(column + 1)) else {
            return Err(LinearError::NoSuchUnknown { unknown: column, order: self.order() });
        };
        match self.rows[begin..end].binary_search(&row) {
            Ok(at) => Ok(begin + at),
            Err(_) => Err(LinearError::OutsidePattern { row: i, column: j }),
        }
    }
}

/// A sparse symmetric matrix: a pattern, which several matrices may share, and the values of its lower triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseSymmetric {
    pattern: Arc<SymmetricPattern>,
    values: Vec<f64>,
}

impl SparseSymmetric {
    /// The zero matrix on `pattern`.
    pub fn zeros(pattern: Arc<SymmetricPattern>) -> Self {
        Self { values: vec![0.0; pattern.entries()], pattern }
    }

    /// Adds the symmetric `block` (n × n) of an element to the rows and columns of its n `unknowns`; those that are `None` are held
    /// and dropped. Only the lower triangle of the block is read. Blocks add in the order of the calls.
    ///
    /// Errors: a block of another size, or an entry outside of the pattern; the matrix then holds a part of the block.
    pub fn add_block(&mut self, unknowns: &[Option<usize>], block: &Matrix) -> Result<(), LinearError> {
        if block.rows() != unknowns.len() || block.columns() != unknowns.len() {
            let given = block.rows().max(block.columns());
            return Err(LinearError::WrongLength {
                quantity: "rows and columns of a block",
                given,
                expected: unknowns.len(),
            });
        }
        for (i, row) in unknowns.iter().enumerate() {
            let Some(row) = *row else { continue };
            for (column, value) in unknowns[..=i].iter().zip(block.row(i)) {
                let Some(column) = *column else { continue };
                let at = self.pattern.place(row, column)?;
                self.values[at] += value;
            }
        }
        Ok(())
    }

    /// This matrix with further unknowns, numbered after its own. `border[i]` holds the entries (own unknown, value) between new unknown i
    /// and the old ones, `square[i]` those (new unknown j ≤ i, value) of row i among the new ones, both without repetitions and in increasing order;
    /// the diagonal ends each row of the square.
    ///
    /// Errors: not as many rows as columns; an unknown that is not there; a row without its diagonal.
    pub fn bordered(
        &self,
        border: &[Vec<(usize, f64)>],
        square: &[Vec<(usize, f64)>],
    ) -> Result<Self, LinearError> {
        let own = self.order();
        let order = own + border.len();
        if square.len() != border.len() {
            let quantity = "rows of the square beside a border";
            return Err(LinearError::WrongLength { quantity, given: square.len(), expected: border.len() });
        }
        let mut below: Vec<Vec<(usize, f64)>> = vec![Vec::new(); order];
        for (i, (column, row)) in border.iter().zip(square).enumerate() {
            for &(unknown, value) in column {
                if unknown >= own {
                    return Err(LinearError::NoSuchUnknown { unknown, order: own });
                }
                below[unknown].push((own + i, value));
            }
            if row.last().is_none_or(|&(j, _)| j != i) {
                return Err(LinearError::OutsidePattern { row: own + i, column: own + i });
            }
            for &(j, value) in row {
                below[own + j].push((own + i, value));
            }
        }
        let entries = self.values.len() + below.iter().map(Vec::len).sum::<usize>();
        let (mut starts, mut rows) = (vec![0], Vec::with_capacity(entries));
        let mut values = Vec::with_capacity(entries);
        for (j, below) in below.iter().enumerate() {
            if j < own {
                let column = self.pattern.starts[j]..self.pattern.starts[j + 1];
                rows.extend_from_slice(&self.pattern.rows[column.clone()]);
                values.extend_from_slice(&self.values[column]);
            }
            rows.extend(below.iter().map(|entry| entry.0));
            values.extend(below.iter().map(|entry| entry.1));
            starts.push(rows.len());
        }
        Ok(Self { pattern: Arc::new(SymmetricPattern { starts, rows }), values })
    }

    /// Entry (i, j); zero outside of the pattern.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.pattern.place(i, j).map_or(0.0, |at| self.values[at])
    }

    /// The pattern.
    pub fn pattern(&self) -> &Arc<SymmetricPattern> {
        &self.pattern
    }

    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.pattern.order()
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The product with a vector of `order` entries.
    ///
    /// Errors: another length.
    pub fn times(&self, vector: &[f64]) -> Result<Vec<f64>, LinearError> {
        let order = self.order();
        if vector.len() != order {
            return Err(LinearError::WrongLength {
                quantity: "entries of a vector",
                given: vector.len(),
                expected: order,
            });
        }
        let mut product = vec![0.0; order];
        for j in 0..order {
            let column = self.pattern.starts[j]..self.pattern.starts[j + 1];
            for (&i, value) in self.pattern.rows[column.clone()].iter().zip(&self.values[column]) {
                product[i] += value * vector[j];
                if i != j {
                    product[j] += value * vector[i];
                }
            }
        }
        Ok(product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELD: Option<usize> = None;

    #[test]
    fn assembles_blocks_and_multiplies() {
        let blocks = [[Some(0), Some(2)], [Some(2), Some(1)], [HELD, Some(1)]];
        let pattern = Arc::new(SymmetricPattern::from_blocks(4, &blocks).unwrap());
        assert_eq!(pattern.entries(), 4 + 2);
        let mut matrix = SparseSymmetric::zeros(pattern);
        let spring = Matrix::from_fn(2, 2, |i, j| if i == j { 1.0 } else { -1.0 });
        for block in &blocks {
            matrix.add_block(block, &spring).unwrap();
        }
        let dense = [[1.0, 0.0, -1.0, 0.0], [0.0, 2.0, -1.0, 0.0], [-1.0, -1.0, 2.0, 0.0], [0.0; 4]];
        for (i, row) in dense.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                assert_eq!(matrix.entry(i, j), entry, "({i}, {j})");
            }
        }
        assert_eq!(matrix.times(&[1.0, 2.0, 4.0, 8.0]), Ok(vec![-3.0, 0.0, 5.0, 0.0]));
    }

    #[test]
    fn a_border_adds_its_rows_and_columns() {
        let blocks = [[Some(0), Some(1)], [Some(1), Some(2)]];
        let mut matrix = SparseSymmetric::zeros(Arc::new(SymmetricPattern::from_blocks(3, &blocks).unwrap()));
        let spring = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { -1.0 });
        blocks.iter().for_each(|block| matrix.add_block(block, &spring).unwrap());
        let border = [vec![(0, 0.5), (2, 0.25)], vec![(1, -0.5)]];
        let square = [vec![(0, 7.0)], vec![(0, 1.5), (1, 9.0)]];
        let whole = matrix.bordered(&border, &square).unwrap();
        let dense = [
            [2.0, -1.0, 0.0, 0.5, 0.0],
            [-1.0, 4.0, -1.0, 0.0, -0.5],
            [0.0, -1.0, 2.0, 0.25, 0.0],
            [0.5, 0.0, 0.25, 7.0, 1.5],
            [0.0, -0.5, 0.0, 1.5, 9.0],
        ];
        for (i, row) in dense.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                assert_eq!(whole.entry(i, j), entry, "({i}, {j})");
            }
        }
        assert!(matches!(matrix.bordered(&border, &square[..1]), Err(LinearError::WrongLength { .. })));
        let beyond = matrix.bordered(&[vec![(3, 1.0)]], &square[..1]);
        assert_eq!(beyond, Err(LinearError::NoSuchUnknown { unknown: 3, order: 3 }));
        let headless = matrix.bordered(&border[..1], &[vec![]]);
        assert_eq!(headless, Err(LinearError::OutsidePattern { row: 3, column: 3 }));
    }

    #[test]
    fn refuses_what_does_not_fit() {
        let block = [Some(0), Some(3)];
        assert_eq!(
            SymmetricPattern::from_blocks(3, &[block]),
            Err(LinearError::NoSuchUnknown { unknown: 3, order: 3 })
        );
        let pattern = Arc::new(SymmetricPattern::from_blocks(4, &[block]).unwrap());
        let mut matrix = SparseSymmetric::zeros(pattern);
        let ones = Matrix::from_fn(2, 2, |_, _| 1.0);
        let outside = matrix.add_block(&[Some(0), Some(1)], &ones);
        assert_eq!(outside, Err(LinearError::OutsidePattern { row: 1, column: 0 }));
        assert!(matches!(matrix.add_block(&[Some(0)], &ones), Err(LinearError::WrongLength { .. })));
        assert!(matrix.times(&[0.0; 3]).is_err());
    }
}

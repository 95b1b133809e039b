//! Sparse symmetric matrices as sums of element matrices.

use super::LinearError;
use crate::interruption::Interruption;
use crate::math::Matrix;

/// A sparse symmetric matrix that is a sum of small dense ones, like a stiffness matrix. It is
/// never assembled: elements are added to the fronts of a factor one by one.
pub trait ElementSum: Sync {
    /// Number of unknowns.
    fn order(&self) -> usize;

    /// Number of elements.
    fn count(&self) -> usize;

    /// The unknowns of an element, from 0, each at most once; `None` stands for a held unknown
    /// without row and column.
    fn unknowns(&self, element: usize) -> Vec<Option<usize>>;

    /// The matrix of an element, n × n with its n unknowns. Only the lower triangle is read.
    fn matrix(&self, element: usize) -> Matrix;
}

/// The sparsity pattern of a symmetric matrix: the lower triangle, column by column, the diagonal
/// always included.
#[derive(Debug)]
pub(super) struct Pattern {
    /// Column j has its rows at `starts[j]..starts[j + 1]`.
    pub(super) starts: Vec<u32>,
    /// Rows in increasing order, the diagonal first.
    pub(super) rows: Vec<u32>,
}

/// Number of columns between two checks for an interruption.
const OFTEN: usize = 10_000;

impl Pattern {
    /// The pattern of `matrix`.
    ///
    /// Errors: an unknown out of range; too many entries for their indices; an interruption.
    pub(super) fn new(matrix: &impl ElementSum, interruption: Interruption<'_>) -> Result<Self, LinearError> {
        let order = matrix.order();
        let too_large = |_| LinearError::TooLarge { order };
        let elements = Incidence::new(matrix)?;
        let mut starts = vec![0];
        let mut rows = Vec::new();
        let mut column_of_last_visit = vec![usize::MAX; order];
        for column in 0..order {
            if column.is_multiple_of(OFTEN) {
                interruption.check()?;
            }
            let begin = rows.len();
            column_of_last_visit[column] = column;
            rows.push(column as u32);
            for element in elements.of(column) {
                for &row in elements.unknowns(element) {
                    if row as usize > column && column_of_last_visit[row as usize] != column {
                        column_of_last_visit[row as usize] = column;
                        rows.push(row);
                    }
                }
            }
            rows[begin..].sort_unstable();
            starts.push(u32::try_from(rows.len()).map_err(too_large)?);
        }
        Ok(Self { starts, rows })
    }
}

/// The unknowns of each element, and the elements of each unknown.
struct Incidence {
    /// Element e has its unknowns at `unknown_starts[e]..unknown_starts[e + 1]`.
    unknown_starts: Vec<usize>,
    unknowns: Vec<u32>,
    /// Unknown i has its elements at `element_starts[i]..element_starts[i + 1]`.
    element_starts: Vec<usize>,
    elements: Vec<u32>,
}

impl Incidence {
    fn new(matrix: &impl ElementSum) -> Result<Self, LinearError> {
        let order = matrix.order();
        if u32::try_from(order.max(matrix.count())).is_err() {
            return Err(LinearError::TooLarge { order });
        }
        let (mut unknown_starts, mut unknowns) = (vec![0], Vec::new());
        let mut element_starts = vec![0; order + 1];
        for element in 0..matrix.count() {
            for unknown in matrix.unknowns(element).into_iter().flatten() {
                if unknown >= order {
                    return Err(LinearError::NoSuchUnknown { unknown, order });
                }
                unknowns.push(unknown as u32);
                element_starts[unknown + 1] += 1;
            }
            unknown_starts.push(unknowns.len());
        }
        for i in 0..order {
            element_starts[i + 1] += element_starts[i];
        }
        let mut elements = vec![0; unknowns.len()];
        let mut next = element_starts.clone();
        for (element, range) in unknown_starts.windows(2).enumerate() {
            for &unknown in &unknowns[range[0]..range[1]] {
                elements[next[unknown as usize]] = element as u32;
                next[unknown as usize] += 1;
            }
        }
        Ok(Self { unknown_starts, unknowns, element_starts, elements })
    }

    fn unknowns(&self, element: usize) -> &[u32] {
        &self.unknowns[self.unknown_starts[element]..self.unknown_starts[element + 1]]
    }

    fn of(&self, unknown: usize) -> impl Iterator<Item = usize> {
        let range = self.element_starts[unknown]..self.element_starts[unknown + 1];
        self.elements[range].iter().map(|&element| element as usize)
    }
}

//! Sparse symmetric matrices as sums of element matrices, and the structure of their factors.

use super::LinearError;
use super::lanes::ROWS;
use crate::interruption::Interruption;
use crate::math::Matrix;
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use std::ops::Range;

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

/// The structure of L in P K Pᵀ = L Lᵀ. Columns with the same rows below them form supernodes,
/// which are dense blocks.
#[derive(Debug)]
pub(super) struct Structure {
    /// Elimination order: the unknown at each place.
    order: Vec<u32>,
    /// The place of each unknown in it.
    place: Vec<u32>,
    /// The supernodes in elimination order, each before its parent.
    pub(super) supernodes: Vec<Supernode>,
    /// The supernode of each place.
    supernode_of: Vec<u32>,
    /// Rows below the supernodes, one after the other.
    pattern: Vec<u32>,
}

/// A supernode.
#[derive(Debug, Clone, Copy)]
pub(super) struct Supernode {
    /// First column, a place in the elimination order.
    pub(super) start: usize,
    /// Number of columns.
    pub(super) columns: usize,
    /// Position in the pattern of its first row below.
    pattern: usize,
    /// Number of rows below.
    pub(super) below: usize,
    /// Index of its first tile among all.
    pub(super) first_tile: usize,
}

impl Supernode {
    /// Its columns, as places in the elimination order.
    pub(super) fn places(&self) -> Range<usize> {
        self.start..self.start + self.columns
    }

    /// Rows of its front.
    pub(super) fn size(&self) -> usize {
        self.columns + self.below
    }

    /// Blocks of rows of the triangle.
    pub(super) fn blocks(&self) -> usize {
        self.columns.div_ceil(ROWS)
    }

    /// Number of rows that it takes in a panel, including the padding.
    pub(super) fn panel_rows(&self) -> usize {
        self.blocks() * ROWS
    }

    /// The first tile of block `b` of the triangle, counted from the first tile of the supernode:
    /// all previous blocks have 6, 12, 18, … columns.
    pub(super) fn triangle(&self, b: usize) -> usize {
        ROWS * b * (b + 1) / 2
    }

    /// Number of its tiles.
    pub(super) fn tiles(&self) -> usize {
        self.triangle(self.blocks()) + self.below.div_ceil(ROWS) * self.columns
    }

    /// Entries of L, including the zeros that make it dense.
    pub(super) fn entries(&self) -> usize {
        self.columns * (self.columns + 1) / 2 + self.columns * self.below
    }
}

impl Structure {
    /// Errors: an order that is not a permutation of the unknowns; an element with an unknown out
    /// of range; an interruption.
    pub(super) fn new(
        matrix: &impl ElementSum,
        order: Vec<usize>,
        interruption: Interruption<'_>,
    ) -> Result<Self, LinearError> {
        let (order, place) = places(&order, matrix.order())?;
        let pattern = Pattern::new(matrix, interruption)?;
        let mut structure = Self {
            supernode_of: vec![0; order.len()],
            order,
            place,
            supernodes: Vec::new(),
            pattern: Vec::new(),
        };
        interruption.check()?;
        structure.analyse(&pattern)?;
        interruption.check()?;
        Ok(structure)
    }

    fn analyse(&mut self, pattern: &Pattern) -> Result<(), LinearError> {
        let unknowns = self.order.len();
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let permutation = SymmetricOrdering::Custom(PermRef::new_checked(&self.order, &self.place, unknowns));
        let view =
            SymbolicSparseColMatRef::new_checked(unknowns, unknowns, &pattern.starts, None, &pattern.rows);
        let symbolic = factorize_symbolic_cholesky(view, Side::Lower, permutation, params)
            .map_err(|_| LinearError::TooLarge { order: unknowns })?;
        if let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() {
            self.take_supernodes(symbolic);
        }
        Ok(())
    }

    fn take_supernodes(&mut self, symbolic: &SymbolicSupernodalCholesky<u32>) {
        self.pattern = symbolic.row_idx().to_vec();
        let patterns = symbolic.col_ptr_for_row_idx().windows(2);
        let columns = symbolic.supernode_begin().iter().zip(symbolic.supernode_end());
        let mut first_tile = 0;
        for (s, ((&start, &end), pattern)) in columns.zip(patterns).enumerate() {
            let [start, end, first, last] = [start, end, pattern[0], pattern[1]].map(|i| i as usize);
            self.supernode_of[start..end].fill(s as u32);
            let node =
                Supernode { start, columns: end - start, pattern: first, below: last - first, first_tile };
            first_tile += node.tiles();
            self.supernodes.push(node);
        }
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.order.len()
    }

    /// The unknown at a place in the elimination order.
    pub(super) fn unknown_at(&self, place: usize) -> usize {
        self.order[place] as usize
    }

    /// The place of an unknown in the elimination order.
    ///
    /// Errors: an unknown out of range.
    pub(super) fn place_of(&self, unknown: usize) -> Result<usize, LinearError> {
        let no_such = LinearError::NoSuchUnknown { unknown, order: self.unknowns() };
        self.place.get(unknown).map(|&place| place as usize).ok_or(no_such)
    }

    /// The supernode of a place in the elimination order.
    #[inline(always)]
    pub(super) fn supernode_at(&self, place: usize) -> usize {
        self.supernode_of[place] as usize
    }

    /// Rows below a supernode, as increasing places in the elimination order.
    pub(super) fn rows_below(&self, s: &Supernode) -> &[u32] {
        &self.pattern[s.pattern..s.pattern + s.below]
    }

    /// The next supernode on the path to the root of the elimination tree.
    pub(super) fn parent(&self, s: usize) -> Option<usize> {
        self.rows_below(&self.supernodes[s]).first().map(|&row| self.supernode_at(row as usize))
    }

    /// Memory in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        let indices = self.order.len() + self.place.len() + self.supernode_of.len() + self.pattern.len();
        indices * size_of::<u32>() + size_of_val(&*self.supernodes)
    }
}

/// An elimination order, which must contain each unknown once, and the place of each unknown in it.
fn places(order: &[usize], unknowns: usize) -> Result<(Vec<u32>, Vec<u32>), LinearError> {
    if order.len() != unknowns {
        return Err(LinearError::WrongLength {
            quantity: "unknowns in the elimination order",
            given: order.len(),
            expected: unknowns,
        });
    }
    if u32::try_from(unknowns).is_err() {
        return Err(LinearError::TooLarge { order: unknowns });
    }
    let mut place = vec![None; unknowns];
    for (at, &unknown) in order.iter().enumerate() {
        match place.get_mut(unknown) {
            None => return Err(LinearError::NoSuchUnknown { unknown, order: unknowns }),
            Some(Some(_)) => return Err(LinearError::EliminatedTwice { unknown }),
            Some(fresh) => *fresh = Some(at as u32),
        }
    }
    let order = order.iter().map(|&unknown| unknown as u32).collect();
    Ok((order, place.into_iter().flatten().collect()))
}

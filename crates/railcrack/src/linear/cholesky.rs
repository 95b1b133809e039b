//! Cholesky factorisation of sparse matrices: analysed once per pattern, factored once per matrix.

use super::lanes::ROWS;
use super::{LinearError, SparseSymmetric, SymmetricPattern};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side, Spec};
use std::sync::Arc;

/// The structure of the factor P K Pᵀ = L Lᵀ of all matrices on a pattern, with the unknowns in a given order.
#[derive(Debug)]
pub struct SparseCholesky {
    pattern: Arc<SymmetricPattern>,
    /// Elimination order: the unknown at each place.
    order: Vec<usize>,
    symbolic: SymbolicCholesky<usize>,
}

impl SparseCholesky {
    /// Analyses `pattern` for the elimination order `order`: every unknown once. A good order decides the size of the
    /// factor ([`crate::mesh::QuadMesh::nested_dissection`]).
    ///
    /// Errors: an order that is not one of the unknowns.
    pub fn analyse(pattern: Arc<SymmetricPattern>, order: Vec<usize>) -> Result<Self, LinearError> {
        let place = places(&order, pattern.order())?;
        let too_large = || LinearError::TooLarge { order: order.len() };
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let permutation = SymmetricOrdering::Custom(PermRef::new_checked(&order, &place, order.len()));
        let symbolic = factorize_symbolic_cholesky(view(&pattern), Side::Lower, permutation, params)
            .map_err(|_| too_large())?;
        Ok(Self { pattern, order, symbolic })
    }

    /// Factors `matrix`, whose pattern must be the one analysed.
    ///
    /// Errors: another pattern; a matrix that is not positive definite (the unknown is named); no memory.
    pub fn factor(&self, matrix: &SparseSymmetric) -> Result<SparseFactor, LinearError> {
        let order = self.order.len();
        if !Arc::ptr_eq(&self.pattern, matrix.pattern()) && self.pattern != *matrix.pattern() {
            return Err(LinearError::WrongLength {
                quantity: "entries of the pattern that was analysed",
                given: matrix.pattern().entries(),
                expected: self.pattern.entries(),
            });
        }
        let mut values = vec![0.0; self.symbolic.len_val()];
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| LinearError::TooLarge { order })?;
        let stack = MemStack::new(&mut buffer);
        let lower = SparseColMatRef::new(view(&self.pattern), matrix.values());
        let regularization = Default::default();
        // On the calling thread: the bits must not depend on the number of threads.
        let (par, params) = (Par::Seq, Spec::default());
        self.symbolic
            .factorize_numeric_llt(&mut values, lower, Side::Lower, regularization, par, stack, params)
            .map_err(|LltError::NonPositivePivot { index }| LinearError::NotPositiveDefinite {
                order,
                pivot: self.order[index],
            })?;
        Ok(self.pack(&values))
    }

    fn pack(&self, values: &[f64]) -> SparseFactor {
        let mut factor = SparseFactor {
            place: inverse(&self.order),
            order: self.order.clone(),
            supernodes: Vec::new(),
            supernode_of: vec![0; self.order.len()],
            pattern: Vec::new(),
            tiles: Vec::new(),
        };
        if let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() {
            let supernodal = SupernodalLltRef::new(symbolic, values);
            for s in 0..symbolic.n_supernodes() {
                let node = supernodal.supernode(s);
                let value = node.val();
                factor.push(node.start(), value.ncols(), node.pattern(), |i, j| value[(i, j)]);
            }
        }
        factor
    }
}

/// A Cholesky factor P K Pᵀ = L Lᵀ. Columns of L with the same rows below them form supernodes, dense blocks.
#[derive(Debug, Clone)]
pub struct SparseFactor {
    /// Elimination order: the unknown at each place.
    pub(super) order: Vec<usize>,
    /// The place of each unknown in it.
    pub(super) place: Vec<usize>,
    pub(super) supernodes: Vec<Supernode>,
    /// The supernode of each place.
    pub(super) supernode_of: Vec<usize>,
    /// Rows below the supernodes, one after the other.
    pub(super) pattern: Vec<usize>,
    /// L in tiles of [`ROWS`] rows, column by column: of each supernode first the blocks of the triangle, block b with the columns
    /// up to its own, then the blocks below. Rows that pad the last block are zero; on the diagonal stands 1 / L_ii.
    pub(super) tiles: Vec<[f64; ROWS]>,
}

/// Where a supernode has its numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Supernode {
    /// First column, a place in the elimination order.
    pub(super) start: usize,
    /// Number of columns.
    pub(super) columns: usize,
    /// First of its rows below, in the pattern.
    pub(super) pattern: usize,
    /// Number of rows below.
    pub(super) below: usize,
    /// First of its tiles.
    pub(super) tiles: usize,
}

impl Supernode {
    /// Blocks of rows of the triangle.
    pub(super) fn blocks(&self) -> usize {
        self.columns.div_ceil(ROWS)
    }

    /// Rows of a panel that it takes, the padding included.
    pub(super) fn panel_rows(&self) -> usize {
        self.blocks() * ROWS
    }

    /// Where block `b` of the triangle begins, counted from its first tile: all blocks before it have 6, 12, 18, … columns.
    pub(super) fn triangle(&self, b: usize) -> usize {
        ROWS * b * (b + 1) / 2
    }
}

impl SparseFactor {
    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.order.len()
    }

    /// Entries of L, the zeros included that make supernodes dense.
    pub fn entries(&self) -> usize {
        self.supernodes.iter().map(|s| s.columns * (s.columns + 1) / 2 + s.columns * s.below).sum()
    }

    /// Memory that it holds, bytes.
    pub fn memory_bytes(&self) -> usize {
        let indices = self.order.len() + self.place.len() + self.supernode_of.len() + self.pattern.len();
        size_of_val(&*self.tiles) + indices * size_of::<usize>() + size_of_val(&*self.supernodes)
    }

    /// Rows below a supernode, places in the elimination order, increasing.
    pub(super) fn rows_below(&self, s: &Supernode) -> &[usize] {
        &self.pattern[s.pattern..s.pattern + s.below]
    }

    /// The supernode next on the way to the root of the elimination tree.
    pub(super) fn parent(&self, s: usize) -> Option<usize> {
        self.rows_below(&self.supernodes[s]).first().map(|&row| self.supernode_of[row])
    }

    fn push(&mut self, start: usize, columns: usize, below: &[usize], value: impl Fn(usize, usize) -> f64) {
        let node = Supernode {
            start,
            columns,
            pattern: self.pattern.len(),
            below: below.len(),
            tiles: self.tiles.len(),
        };
        self.supernode_of[start..start + columns].fill(self.supernodes.len());
        self.pattern.extend_from_slice(below);
        for block in 0..node.blocks() {
            let first = block * ROWS;
            self.tiles.extend((0..first + ROWS).map(|j| {
                std::array::from_fn(|r| match first + r {
                    i if i >= columns || j > i => 0.0,
                    i if i == j => 1.0 / value(i, i),
                    i => value(i, j),
                })
            }));
        }
        for first in (0..below.len()).step_by(ROWS) {
            let entry = |j, r| if first + r < below.len() { value(columns + first + r, j) } else { 0.0 };
            self.tiles.extend((0..columns).map(|j| std::array::from_fn(|r| entry(j, r))));
        }
        self.supernodes.push(node);
    }
}

fn view(pattern: &SymmetricPattern) -> SymbolicSparseColMatRef<'_, usize> {
    let order = pattern.order();
    SymbolicSparseColMatRef::new_checked(order, order, pattern.starts(), None, pattern.rows())
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(i, &unknown)| place[unknown] = i);
    place
}

/// The place of each unknown in an elimination order, which must name each once.
fn places(order: &[usize], unknowns: usize) -> Result<Vec<usize>, LinearError> {
    if order.len() != unknowns {
        return Err(LinearError::WrongLength {
            quantity: "unknowns in the elimination order",
            given: order.len(),
            expected: unknowns,
        });
    }
    let mut seen = vec![false; unknowns];
    for &unknown in order {
        match seen.get_mut(unknown) {
            None => return Err(LinearError::NoSuchUnknown { unknown, order: unknowns }),
            Some(true) => return Err(LinearError::EliminatedTwice { unknown }),
            Some(fresh) => *fresh = true,
        }
    }
    Ok(inverse(order))
}

//! Cholesky factorisation of sparse matrices: analysed once per pattern, factored once per matrix.

use super::fronts::eliminated;
use super::lanes::ROWS;
use super::structure::Structure;
use super::{LinearError, SparseSymmetric, SymmetricPattern};
use std::sync::Arc;

/// The structure of the factor P K Pᵀ = L Lᵀ of all matrices on a pattern, with the unknowns in a given order.
#[derive(Debug)]
pub struct SparseCholesky {
    pattern: Arc<SymmetricPattern>,
    structure: Arc<Structure>,
}

impl SparseCholesky {
    /// Analyses `pattern` for the elimination order `order`: every unknown once. A good order decides the size of the
    /// factor ([`crate::mesh::QuadMesh::nested_dissection`]).
    ///
    /// Errors: an order that is not one of the unknowns.
    pub fn analyse(pattern: Arc<SymmetricPattern>, order: Vec<usize>) -> Result<Self, LinearError> {
        let structure = Arc::new(Structure::new(&pattern, order)?);
        Ok(Self { pattern, structure })
    }

    /// Factors `matrix`, whose pattern must be the one analysed, front by front: branches of the elimination tree in parallel, and towards its
    /// root the blocks of a front. The bits do not depend on the number of threads.
    ///
    /// Errors: another pattern; a matrix that is not positive definite (the unknown is named); too many entries for their indices.
    pub fn factor(&self, matrix: &SparseSymmetric) -> Result<SparseFactor, LinearError> {
        if !Arc::ptr_eq(&self.pattern, matrix.pattern()) && self.pattern != *matrix.pattern() {
            return Err(LinearError::WrongLength {
                quantity: "entries of the pattern that was analysed",
                given: matrix.pattern().entries(),
                expected: self.pattern.entries(),
            });
        }
        let tiles = eliminated(&self.structure, matrix)?;
        Ok(SparseFactor { structure: Arc::clone(&self.structure), tiles })
    }
}

/// A Cholesky factor P K Pᵀ = L Lᵀ. Columns of L with the same rows below them form supernodes, dense blocks.
#[derive(Debug, Clone)]
pub struct SparseFactor {
    pub(super) structure: Arc<Structure>,
    /// L in tiles, supernode by supernode.
    pub(super) tiles: Vec<Tiles>,
}

/// A supernode of L in tiles of [`ROWS`] rows, column by column: first the blocks of the triangle, block b with the columns up to its own,
/// then the blocks below. Rows that pad the last block are zero; on the diagonal stands 1 / L_ii.
pub(super) type Tiles = Vec<[f64; ROWS]>;

impl SparseFactor {
    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.structure.order.len()
    }

    /// Entries of L, the zeros included that make supernodes dense.
    pub fn entries(&self) -> usize {
        self.structure.supernodes.iter().map(|s| s.entries()).sum()
    }

    /// Memory that it holds, bytes.
    pub fn memory_bytes(&self) -> usize {
        let tiles: usize = self.tiles.iter().map(|tiles| size_of_val(&**tiles)).sum();
        tiles + self.structure.memory_bytes()
    }
}

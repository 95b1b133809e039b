//! Sparse Cholesky factorisation: one analysis per pattern, one factorisation per matrix.

use super::fronts::eliminated;
use super::lanes::Tile;
use super::structure::Structure;
use super::{ElementSum, LinearError};
use crate::interruption::Interruption;
use std::sync::Arc;

/// The structure of the factor P K Pᵀ = L Lᵀ of all matrices whose elements couple the same
/// unknowns, with the unknowns in a given order.
#[derive(Debug)]
pub struct SparseCholesky {
    structure: Arc<Structure>,
}

impl SparseCholesky {
    /// Analyses `matrix` for the elimination order `order`, which contains every unknown once. The
    /// order decides the size of the factor ([`crate::mesh::QuadMesh::nested_dissection`]).
    ///
    /// Errors: an order that is not a permutation of the unknowns; an element with an unknown out
    /// of range.
    pub fn analyse(matrix: &impl ElementSum, order: Vec<usize>) -> Result<Self, LinearError> {
        Self::analyse_unless(Interruption::NEVER, matrix, order)
    }

    /// [`SparseCholesky::analyse`] that stops on an `interruption`.
    pub(crate) fn analyse_unless(
        interruption: Interruption<'_>,
        matrix: &impl ElementSum,
        order: Vec<usize>,
    ) -> Result<Self, LinearError> {
        Ok(Self { structure: Arc::new(Structure::new(matrix, order, interruption)?) })
    }

    /// Factors `matrix`, whose elements must couple only unknowns that are coupled in the analysed
    /// matrix. The factorisation proceeds front by front, with branches of the elimination tree in
    /// parallel, and near its root the blocks of a front in parallel. The bits do not depend on the
    /// number of threads.
    ///
    /// Errors: a different number of unknowns, or entries outside the structure; an element whose
    /// matrix does not fit its unknowns; a matrix that is not positive definite (the error gives
    /// the unknown).
    pub fn factor(&self, matrix: &impl ElementSum) -> Result<SparseFactor, LinearError> {
        self.factor_unless(Interruption::NEVER, matrix)
    }

    /// [`SparseCholesky::factor`] that stops on an `interruption`.
    pub(crate) fn factor_unless(
        &self,
        interruption: Interruption<'_>,
        matrix: &impl ElementSum,
    ) -> Result<SparseFactor, LinearError> {
        let tiles = eliminated(&self.structure, matrix, interruption)?;
        Ok(SparseFactor { structure: Arc::clone(&self.structure), tiles })
    }
}

/// A Cholesky factor P K Pᵀ = L Lᵀ. Columns of L with the same rows below them form supernodes,
/// which are dense blocks.
#[derive(Debug, Clone)]
pub struct SparseFactor {
    pub(super) structure: Arc<Structure>,
    /// L in tiles, supernode by supernode.
    tiles: Vec<Tile>,
}

impl SparseFactor {
    /// The tiles of a supernode.
    pub(super) fn tiles(&self, s: usize) -> &[Tile] {
        let node = &self.structure.supernodes[s];
        &self.tiles[node.first_tile..][..node.tiles()]
    }

    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.structure.unknowns()
    }

    /// Entries of L, including the zeros that make supernodes dense.
    pub fn entries(&self) -> usize {
        self.structure.supernodes.iter().map(|s| s.entries()).sum()
    }

    /// Memory in bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.tiles) + self.structure.memory_bytes()
    }
}

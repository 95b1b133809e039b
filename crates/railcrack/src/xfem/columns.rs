//! Border columns that are kept from one growth step to the next.

use crate::linear::{LinearError, ReachedColumn, SparseColumn, SparseFactor, gram};
use crate::math::Matrix;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Half-solved columns L⁻¹ b and their scalar products, by the content of b.
///
/// What was computed for a column is used again as long as its entries are the same bits; since both depend on the factor and
/// on the column alone, a run that begins in the middle finds the same bits without them. A clone shares the columns.
#[derive(Debug, Clone, Default)]
pub struct ColumnStore {
    places: Arc<HashMap<Vec<(usize, u64)>, usize>>,
    reached: Vec<Option<Arc<ReachedColumn>>>,
    products: Option<Arc<Matrix>>,
}

impl ColumnStore {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// b_iᵀ K⁻¹ b_j of all `columns`, symmetric. Keeps them for the next call and forgets all others.
    pub(super) fn products(
        &mut self,
        factor: &SparseFactor,
        columns: &[SparseColumn],
    ) -> Result<Arc<Matrix>, LinearError> {
        let n = columns.len();
        let content = |column: &SparseColumn| -> Vec<(usize, u64)> {
            column.entries.iter().map(|&(unknown, value)| (unknown, value.to_bits())).collect()
        };
        let mut places = HashMap::with_capacity(n);
        let mut known: Vec<Option<usize>> = vec![None; n];
        let mut reached: Vec<Option<Arc<ReachedColumn>>> = vec![None; n];
        let mut fresh = Vec::new();
        for (i, column) in columns.iter().enumerate() {
            let key = content(column);
            known[i] = self.places.get(&key).copied();
            match known[i].and_then(|old| self.reached[old].take()) {
                Some(column) => reached[i] = Some(column),
                None => {
                    known[i] = None;
                    fresh.push(i);
                }
            }
            places.insert(key, i);
        }
        let wanted: Vec<SparseColumn> = fresh.iter().map(|&i| columns[i].clone()).collect();
        for (&i, column) in fresh.iter().zip(factor.forward(&wanted)?) {
            reached[i] = Some(Arc::new(column));
        }
        let all: Vec<&ReachedColumn> = reached.iter().flatten().map(Arc::as_ref).collect();
        let new: Vec<&ReachedColumn> = fresh.iter().map(|&i| all[i]).collect();
        let computed = gram(&new, &all);
        let mut row_of: Vec<Option<usize>> = vec![None; n];
        fresh.iter().enumerate().for_each(|(row, &i)| row_of[i] = Some(row));
        let old = self.products.take();
        let product = |i: usize, j: usize| match (row_of[i], row_of[j], &old) {
            (Some(row), _, _) => computed[(row, j)],
            (None, Some(row), _) => computed[(row, i)],
            (None, None, Some(old)) => known[i].zip(known[j]).map_or(0.0, |place| old[place]),
            (None, None, None) => 0.0,
        };
        let mut products = Matrix::zeros(n, n);
        products.entries_mut().par_chunks_mut(n.max(1)).enumerate().for_each(|(i, row)| {
            row.iter_mut().enumerate().for_each(|(j, entry)| *entry = product(i, j));
        });
        self.places = Arc::new(places);
        self.reached = reached;
        let products = Arc::new(products);
        self.products = Some(Arc::clone(&products));
        Ok(products)
    }
}

//! Border columns that are kept from one growth step to the next.

use crate::linear::{LinearError, ReachedColumn, SparseColumn, SparseFactor, gram};
use crate::math::Matrix;
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
    ) -> Result<Matrix, LinearError> {
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
        let mut products = Matrix::zeros(n, n);
        if let Some(old) = &self.products {
            for i in 0..n {
                let Some(from) = known[i] else { continue };
                for j in 0..n {
                    if let Some(to) = known[j] {
                        products[(i, j)] = old[(from, to)];
                    }
                }
            }
        }
        for (row, &i) in fresh.iter().enumerate() {
            for j in 0..n {
                products[(i, j)] = computed[(row, j)];
                products[(j, i)] = computed[(row, j)];
            }
        }
        self.places = Arc::new(places);
        self.reached = reached;
        self.products = Some(Arc::new(products.clone()));
        Ok(products)
    }
}

//! What the elimination of the border keeps from one growth step to the next.

use super::border::Entries;
use crate::linear::{LinearError, PANEL_COLUMNS, ReachedPanel, SparseColumn, SparseFactor, SpdFactor, gram};
use rayon::prelude::*;
use std::sync::Arc;

/// Half-solved columns L⁻¹ b of the border and their scalar products, and the factor of its Schur complement.
///
/// What the first columns came to is used again as long as these are the same bits; since it depends on nothing else, a run that begins in the
/// middle finds the same bits without it. A clone shares all of it.
#[derive(Debug, Clone, Default)]
pub struct ColumnStore {
    columns: Vec<Content>,
    panels: Vec<Arc<ReachedPanel>>,
    products: Vec<Arc<[f64]>>,
    factored: Option<Factored>,
}

/// Entries by their bits.
type Content = Arc<[(usize, u64)]>;

/// A factor, and what every row of its matrix was made of: the column, and its row of K_ee.
#[derive(Debug, Clone)]
struct Factored {
    rows: Vec<[Content; 2]>,
    factor: SpdFactor,
}

fn content(entries: &[(usize, f64)]) -> Content {
    entries.iter().map(|&(unknown, value)| (unknown, value.to_bits())).collect()
}

/// How many of the first ones are the same.
fn in_common<T: PartialEq>(one: &[T], other: &[T]) -> usize {
    one.iter().zip(other).take_while(|(a, b)| a == b).count()
}

impl ColumnStore {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// b_iᵀ K⁻¹ b_j of all `columns`: row i with the columns up to its own. Keeps them for the next call and forgets all others.
    pub(super) fn products(
        &mut self,
        factor: &SparseFactor,
        columns: &[SparseColumn],
    ) -> Result<&[Arc<[f64]>], LinearError> {
        let contents: Vec<Content> = columns.par_iter().map(|column| content(&column.entries)).collect();
        let panels = in_common(&contents, &self.columns) / PANEL_COLUMNS;
        let kept = panels * PANEL_COLUMNS;
        let fresh = factor.forward(&columns[kept..])?;
        self.columns = contents;
        self.panels.truncate(panels);
        self.products.truncate(kept);
        self.panels.extend(fresh.into_iter().map(Arc::new));
        self.products.extend(gram(&self.panels, panels).into_iter().map(Arc::from));
        Ok(&self.products)
    }

    /// The factor of the matrix that `fill` makes, as for [`SpdFactor::new`], of the first columns of the last call of [`Self::products`] and
    /// the rows `square` of K_ee. Of it those rows are taken over that were made of the same.
    pub(super) fn factor(
        &mut self,
        square: &[Entries],
        fill: impl Fn(usize, &mut [f64], &[f64]) + Sync,
    ) -> Result<SpdFactor, LinearError> {
        let rows: Vec<[Content; 2]> = square
            .par_iter()
            .zip(&self.columns)
            .map(|(square, column)| [Arc::clone(column), content(square)])
            .collect();
        let fill = |i: usize, row: &mut [f64]| fill(i, row, &self.products[i]);
        let factor = match self.factored.take() {
            Some(before) => before.factor.changed(in_common(&rows, &before.rows), square.len(), fill)?,
            None => SpdFactor::new(square.len(), fill)?,
        };
        self.factored = Some(Factored { rows, factor: factor.clone() });
        Ok(factor)
    }
}

//! What the elimination of the border keeps from one growth step to the next.

use super::border::Entries;
use crate::linear::{LinearError, PANEL_COLUMNS, ReachedPanel, SparseColumn, SparseFactor, SpdFactor, gram};
use std::sync::Arc;

/// Half-solved columns L⁻¹ b of the border and their scalar products, and the factor of its Schur complement.
///
/// What the first columns came to is used again as long as these are the same bits; since it depends on nothing else, a run that begins in the
/// middle finds the same bits without it. A clone shares all of it.
#[derive(Debug, Clone, Default)]
pub struct ColumnStore {
    columns: Arc<[SparseColumn]>,
    panels: Vec<Arc<ReachedPanel>>,
    products: Vec<Arc<[f64]>>,
    factored: Option<Factored>,
}

/// A factor, and what the rows of its matrix were made of: of each the column, and its row of K_ee.
#[derive(Debug, Clone)]
struct Factored {
    columns: Arc<[SparseColumn]>,
    square: Arc<[Entries]>,
    factor: SpdFactor,
}

/// How many of the first ones are the same, bit by bit.
fn in_common<'a>(one: impl Iterator<Item = &'a Entries>, other: impl Iterator<Item = &'a Entries>) -> usize {
    let same = |(a, b): &(&Entries, &Entries)| a.len() == b.len() && bits(a).eq(bits(b));
    one.zip(other).take_while(same).count()
}

fn bits(entries: &Entries) -> impl Iterator<Item = (usize, u64)> {
    entries.iter().map(|&(unknown, value)| (unknown, value.to_bits()))
}

fn entries(columns: &[SparseColumn]) -> impl Iterator<Item = &Entries> {
    columns.iter().map(|column| &column.entries)
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
        columns: Vec<SparseColumn>,
    ) -> Result<&[Arc<[f64]>], LinearError> {
        let panels = in_common(entries(&columns), entries(&self.columns)) / PANEL_COLUMNS;
        let kept = panels * PANEL_COLUMNS;
        let fresh = factor.forward(&columns[kept..])?;
        self.columns = columns.into();
        self.panels.truncate(panels);
        self.products.truncate(kept);
        self.panels.extend(fresh.into_iter().map(Arc::new));
        self.products.extend(gram(&self.panels, panels).into_iter().map(Arc::from));
        Ok(&self.products)
    }

    /// The factor of a matrix of the first columns of the last call of [`Self::products`] and the rows `square` of K_ee, of which
    /// `fill(i, row, products, square)` makes row i as for [`SpdFactor::new`], of the products of column i and its row of K_ee. Those rows are taken over
    /// that were made of the same.
    pub(super) fn factor(
        &mut self,
        square: Vec<Entries>,
        fill: impl Fn(usize, &mut [f64], &[f64], &Entries) + Sync,
    ) -> Result<SpdFactor, LinearError> {
        let (columns, square): (_, Arc<[Entries]>) = (Arc::clone(&self.columns), square.into());
        let fill = |i: usize, row: &mut [f64]| fill(i, row, &self.products[i], &square[i]);
        let factor = match self.factored.take() {
            Some(before) => {
                let same_columns = in_common(entries(&columns), entries(&before.columns));
                let unchanged = same_columns.min(in_common(square.iter(), before.square.iter()));
                before.factor.changed(unchanged, square.len(), fill)?
            }
            None => SpdFactor::new(square.len(), fill)?,
        };
        self.factored = Some(Factored { columns, square: Arc::clone(&square), factor: factor.clone() });
        Ok(factor)
    }
}

//! Solutions with a sparse factor: whole ones, and halves of them over the reach of sparse right-hand sides.

use super::LinearError;
use super::cholesky::SparseFactor;
use super::lanes::{LANES, Row};
use super::sweep::Panel;
use rayon::prelude::*;

/// A sparse right-hand side b: (unknown, value); values of the same unknown add.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseColumn {
    /// Unknowns, from 0, and their values.
    pub entries: Vec<(usize, f64)>,
}

/// W = L⁻¹ P b of up to [`PANEL_COLUMNS`] columns side by side, kept where one of them is not zero: on the supernodes between those of their b and
/// the root of the elimination tree.
///
/// The bits of a column depend on the factor and on its b alone. It is of use with the factor that made it and with none other.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedPanel {
    columns: usize,
    /// Supernodes, increasing.
    supernodes: Vec<u32>,
    /// Where each has its rows; one more at the end.
    starts: Vec<u32>,
    rows: Vec<Row>,
}

/// Columns that are solved side by side.
pub const PANEL_COLUMNS: usize = LANES;

impl ReachedPanel {
    /// Columns in it.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The rows of a supernode; none where no column reaches it.
    pub(super) fn rows_of(&self, supernode: u32) -> &[Row] {
        match self.supernodes.binary_search(&supernode) {
            Ok(k) => &self.rows[self.starts[k] as usize..self.starts[k + 1] as usize],
            Err(_) => &[],
        }
    }

    /// The supernodes that its columns reach.
    pub(super) fn supernodes(&self) -> &[u32] {
        &self.supernodes
    }

    /// Rows that it holds.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }
}

impl SparseFactor {
    /// W = L⁻¹ P b of every column, so that W_iᵀ W_j = b_iᵀ K⁻¹ b_j: panels of [`PANEL_COLUMNS`] columns that follow each other. Columns that begin
    /// near each other in the elimination tree should stand beside each other.
    ///
    /// Errors: an unknown that is not there.
    pub fn forward(&self, columns: &[SparseColumn]) -> Result<Vec<ReachedPanel>, LinearError> {
        columns.par_chunks(PANEL_COLUMNS).map(|columns| self.forward_panel(columns)).collect()
    }

    fn forward_panel(&self, columns: &[SparseColumn]) -> Result<ReachedPanel, LinearError> {
        let mut supernodes = Vec::new();
        for column in columns {
            supernodes.extend(self.reach(column)?);
        }
        supernodes.sort_unstable();
        supernodes.dedup();
        let mut panel = Panel::new(self, &supernodes);
        for (lane, column) in columns.iter().enumerate() {
            for &(unknown, value) in &column.entries {
                panel.add(self.structure.place[unknown], lane, value);
            }
        }
        panel.forward();
        let mut starts = vec![0];
        let mut rows = Vec::with_capacity(supernodes.iter().map(|&s| panel.rows_of(s).len()).sum());
        for &s in &supernodes {
            rows.extend_from_slice(panel.rows_of(s));
            starts.push(rows.len() as u32);
        }
        let supernodes = supernodes.iter().map(|&s| s as u32).collect();
        Ok(ReachedPanel { columns: columns.len(), supernodes, starts, rows })
    }

    /// The supernodes of the entries of a column and all their ancestors, increasing.
    fn reach(&self, column: &SparseColumn) -> Result<Vec<usize>, LinearError> {
        let mut reach = Vec::new();
        for &(unknown, _) in &column.entries {
            let place = self
                .structure
                .place
                .get(unknown)
                .ok_or(LinearError::NoSuchUnknown { unknown, order: self.order() })?;
            reach.push(self.structure.supernode_of[*place]);
        }
        reach.sort_unstable();
        reach.dedup();
        let mut pending = reach.clone();
        while let Some(s) = pending.pop() {
            if let Some(parent) = self.structure.parent(s)
                && let Err(at) = reach.binary_search(&parent)
            {
                reach.insert(at, parent);
                pending.push(parent);
            }
        }
        Ok(reach)
    }

    /// Solves K x = b for right-hand sides b one after the other in `columns` (a multiple of `order` entries), which become
    /// the solutions. The bits of a solution depend on its own right-hand side alone.
    ///
    /// Errors: another length.
    pub fn solve(&self, columns: &mut [f64]) -> Result<(), LinearError> {
        let order = self.order();
        if columns.len() != columns.len().next_multiple_of(order.max(1)) {
            let expected = columns.len().next_multiple_of(order.max(1));
            let quantity = "entries of right-hand sides";
            return Err(LinearError::WrongLength { quantity, given: columns.len(), expected });
        }
        let all: Vec<usize> = (0..self.structure.supernodes.len()).collect();
        columns.par_chunks_mut(LANES * order.max(1)).for_each(|columns| {
            let mut panel = Panel::new(self, &all);
            for (lane, column) in columns.chunks(order).enumerate() {
                for (unknown, &value) in column.iter().enumerate() {
                    panel.add(self.structure.place[unknown], lane, value);
                }
            }
            panel.forward();
            panel.backward();
            for (lane, column) in columns.chunks_mut(order).enumerate() {
                for (unknown, value) in column.iter_mut().enumerate() {
                    *value = panel.entry(self.structure.place[unknown], lane);
                }
            }
        });
        Ok(())
    }
}

//! Solutions with a sparse factor: whole ones, and halves of them over the reach of sparse right-hand sides.

use super::LinearError;
use super::cholesky::SparseFactor;
use super::lanes::LANES;
use super::sweep::Panel;
use rayon::prelude::*;
use std::ops::Range;

/// A sparse right-hand side b: (unknown, value); values of the same unknown add.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseColumn {
    /// Unknowns, from 0, and their values.
    pub entries: Vec<(usize, f64)>,
}

/// W = L⁻¹ P b, kept where it is not zero: on the supernodes between those of b and the root of the elimination tree.
///
/// Its bits depend on the factor and on b alone. It is of use with the factor that made it and with none other.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedColumn {
    /// Supernodes, increasing.
    supernodes: Vec<u32>,
    /// Where each has its values; one more at the end.
    starts: Vec<u32>,
    values: Vec<f64>,
}

impl ReachedColumn {
    /// The supernodes reached and the values on each.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, &[f64])> {
        let range = |k: usize| self.starts[k] as usize..self.starts[k + 1] as usize;
        self.supernodes.iter().enumerate().map(move |(k, &s)| (s as usize, &self.values[range(k)]))
    }

    /// Those of [`ReachedColumn::parts`] on a range of supernodes.
    pub(super) fn parts_on(&self, supernodes: Range<u32>) -> impl Iterator<Item = (usize, &[f64])> {
        let from = self.supernodes.partition_point(|&s| s < supernodes.start);
        let to = self.supernodes.partition_point(|&s| s < supernodes.end);
        (from..to).map(|k| {
            let range = self.starts[k] as usize..self.starts[k + 1] as usize;
            (self.supernodes[k] as usize, &self.values[range])
        })
    }

    /// The last supernode reached: the root of its part of the elimination tree.
    pub(super) fn last(&self) -> Option<u32> {
        self.supernodes.last().copied()
    }

    /// Values that it holds.
    pub fn entries(&self) -> usize {
        self.values.len()
    }

    /// Memory that it holds, bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.supernodes) + size_of_val(&*self.starts) + size_of_val(&*self.values)
    }
}

impl SparseFactor {
    /// W = L⁻¹ P b of every column, in the order given, so that W_iᵀ W_j = b_iᵀ K⁻¹ b_j.
    ///
    /// Columns that begin close to each other in the elimination tree are solved together, in parallel; the bits of each are the
    /// same in any company and on any number of threads.
    ///
    /// Errors: an unknown that is not there.
    pub fn forward(&self, columns: &[SparseColumn]) -> Result<Vec<ReachedColumn>, LinearError> {
        let mut reaches = Vec::with_capacity(columns.len());
        for column in columns {
            reaches.push(self.reach(column)?);
        }
        let mut together: Vec<usize> = (0..columns.len()).collect();
        together.sort_by(|&a, &b| reaches[a].cmp(&reaches[b]));
        let solved: Vec<Vec<ReachedColumn>> =
            together.par_chunks(LANES).map(|batch| self.forward_batch(batch, columns, &reaches)).collect();
        let mut by_column: Vec<(usize, ReachedColumn)> =
            together.into_iter().zip(solved.into_iter().flatten()).collect();
        by_column.sort_unstable_by_key(|(column, _)| *column);
        Ok(by_column.into_iter().map(|(_, reached)| reached).collect())
    }

    fn forward_batch(
        &self,
        batch: &[usize],
        columns: &[SparseColumn],
        reaches: &[Vec<usize>],
    ) -> Vec<ReachedColumn> {
        let mut supernodes = Vec::new();
        for &column in batch {
            supernodes.extend_from_slice(&reaches[column]);
        }
        supernodes.sort_unstable();
        supernodes.dedup();
        let mut panel = Panel::new(self, &supernodes);
        for (lane, &column) in batch.iter().enumerate() {
            for &(unknown, value) in &columns[column].entries {
                panel.add(self.structure.place[unknown], lane, value);
            }
        }
        panel.forward();
        batch.iter().enumerate().map(|(lane, &column)| self.keep(&panel, lane, &reaches[column])).collect()
    }

    fn keep(&self, panel: &Panel<'_>, lane: usize, reach: &[usize]) -> ReachedColumn {
        let mut starts = vec![0];
        let mut values =
            Vec::with_capacity(reach.iter().map(|&s| self.structure.supernodes[s].columns).sum());
        for &s in reach {
            values.extend(panel.lane(s, lane));
            starts.push(values.len() as u32);
        }
        ReachedColumn { supernodes: reach.iter().map(|&s| s as u32).collect(), starts, values }
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

    /// K⁻¹ Σ c_i b_i from the reached columns (W_i, c_i) of the b_i, which are summed in the order given: `order` entries.
    ///
    /// Errors: a column that was not made by this factor, where its shape shows it.
    pub fn backward(&self, combination: &[(&ReachedColumn, f64)]) -> Result<Vec<f64>, LinearError> {
        let all: Vec<usize> = (0..self.structure.supernodes.len()).collect();
        let mut panel = Panel::new(self, &all);
        for (column, factor) in combination {
            for (s, values) in column.parts() {
                let expected = self.structure.supernodes.get(s).map_or(0, |node| node.columns);
                if values.len() != expected {
                    return Err(LinearError::WrongLength {
                        quantity: "values of a reached column on a supernode",
                        given: values.len(),
                        expected,
                    });
                }
                let start = self.structure.supernodes[s].start;
                values.iter().enumerate().for_each(|(k, value)| panel.add(start + k, 0, factor * value));
            }
        }
        panel.backward();
        Ok((0..self.order()).map(|unknown| panel.entry(self.structure.place[unknown], 0)).collect())
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

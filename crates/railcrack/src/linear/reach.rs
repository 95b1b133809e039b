//! Solutions with a sparse factor: full solutions, and forward substitutions restricted to the
//! reach of sparse right-hand sides.

use super::LinearError;
use super::cholesky::SparseFactor;
use super::lanes::{LANES, LaneRow};
use super::sweep::Panel;
use crate::interruption::Interruption;
use rayon::prelude::*;

/// A sparse right-hand side b: (unknown, value); values of the same unknown are added.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseColumn {
    /// Unknowns, from 0, and their values.
    pub entries: Vec<(usize, f64)>,
}

/// W = L⁻¹ P b of up to `PANEL_COLUMNS` columns, stored where at least one of them is not zero: on
/// the supernodes between those of their b and the root of the elimination tree.
///
/// The bits of a column depend on the factor and on its b alone. It is valid only with the factor
/// from which it was made.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedPanel {
    columns: usize,
    /// Supernodes, increasing.
    supernodes: Vec<u32>,
    /// The first row of each; one more at the end.
    starts: Vec<u32>,
    rows: Vec<LaneRow>,
}

/// Number of columns of a panel.
pub(crate) const PANEL_COLUMNS: usize = LANES;

impl ReachedPanel {
    /// Number of columns.
    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    /// The rows of a supernode; none where no column reaches it.
    pub(super) fn rows_of(&self, supernode: u32) -> &[LaneRow] {
        match self.supernodes.binary_search(&supernode) {
            Ok(k) => &self.rows[self.starts[k] as usize..self.starts[k + 1] as usize],
            Err(_) => &[],
        }
    }

    /// The supernodes that its columns reach.
    pub(super) fn supernodes(&self) -> &[u32] {
        &self.supernodes
    }
}

impl SparseFactor {
    /// W = L⁻¹ P b of every column, so that W_iᵀ W_j = b_iᵀ K⁻¹ b_j: successive panels of
    /// `PANEL_COLUMNS` columns. Columns that begin near each other in the elimination tree should
    /// be neighbours.
    ///
    /// Errors: an unknown out of range; an interruption.
    pub fn forward(
        &self,
        columns: &[SparseColumn],
        interruption: Interruption<'_>,
    ) -> Result<Vec<ReachedPanel>, LinearError> {
        let panel = |columns| {
            interruption.check()?;
            self.forward_panel(columns)
        };
        columns.par_chunks(PANEL_COLUMNS).map(panel).collect()
    }

    fn forward_panel(&self, columns: &[SparseColumn]) -> Result<ReachedPanel, LinearError> {
        let entries = columns.iter().flat_map(|column| &column.entries);
        let supernodes = self.reach(entries.map(|&(unknown, _)| unknown))?;
        let mut panel = Panel::new(self, &supernodes);
        for (lane, column) in columns.iter().enumerate() {
            for &(unknown, value) in &column.entries {
                panel.add(self.structure.place_of(unknown)?, lane, value);
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

    /// The supernodes of `unknowns` and all their ancestors, increasing.
    fn reach(&self, unknowns: impl Iterator<Item = usize>) -> Result<Vec<usize>, LinearError> {
        let mut reached = vec![false; self.structure.supernodes.len()];
        for unknown in unknowns {
            let mut next = Some(self.structure.supernode_at(self.structure.place_of(unknown)?));
            while let Some(s) = next.filter(|&s| !reached[s]) {
                reached[s] = true;
                next = self.structure.parent(s);
            }
        }
        Ok((0..reached.len()).filter(|&s| reached[s]).collect())
    }

    /// Solves K x = b for right-hand sides b one after the other in `columns` (a multiple of
    /// `order` entries), which become the solutions. The bits of a solution depend on its own
    /// right-hand side alone.
    ///
    /// Errors: a wrong length.
    pub fn solve(&self, columns: &mut [f64]) -> Result<(), LinearError> {
        let all: Vec<usize> = (0..self.structure.supernodes.len()).collect();
        self.solve_over(&all, &[], columns)
    }

    /// [`SparseFactor::solve`] for some unknowns only. The solutions have the same bits at the
    /// `wanted` unknowns and are incomplete elsewhere. The work is limited to the paths from these
    /// unknowns and from the entries of the right-hand sides to the root of the elimination tree.
    ///
    /// Errors: a wrong length; an unknown out of range.
    pub(crate) fn solve_for(
        &self,
        wanted: impl IntoIterator<Item = usize>,
        columns: &mut [f64],
    ) -> Result<(), LinearError> {
        let given = columns.iter().enumerate().filter(|(_, value)| **value != 0.0);
        let trunk = self.reach(given.map(|(i, _)| i % self.order()))?;
        let branches = self.branches(&trunk, &self.reach(wanted.into_iter())?);
        self.solve_over(&trunk, &branches, columns)
    }

    /// The members of `supernodes` outside the `trunk`, as branches of the elimination tree that
    /// start from it; `supernodes` contain every ancestor of each member.
    fn branches(&self, trunk: &[usize], supernodes: &[usize]) -> Vec<Vec<usize>> {
        let in_trunk = |s: usize| trunk.binary_search(&s).is_ok();
        let mut branch_of = vec![0; self.structure.supernodes.len()];
        let mut branches: Vec<Vec<usize>> = Vec::new();
        for &s in supernodes.iter().rev().filter(|&&s| !in_trunk(s)) {
            branch_of[s] = match self.structure.parent(s).filter(|&parent| !in_trunk(parent)) {
                Some(parent) => branch_of[parent],
                None => {
                    branches.push(Vec::new());
                    branches.len() - 1
                }
            };
            branches[branch_of[s]].push(s);
        }
        branches.iter_mut().for_each(|branch| branch.reverse());
        branches
    }

    /// Solves for the unknowns of some supernodes in elimination order: those of the `trunk`, which
    /// contains all their ancestors, and those of `branches` that start from it, on which the
    /// right-hand sides are zero. The storage of a branch is reused for the next one.
    fn solve_over(
        &self,
        trunk: &[usize],
        branches: &[Vec<usize>],
        columns: &mut [f64],
    ) -> Result<(), LinearError> {
        let order = self.order();
        if columns.len() != columns.len().next_multiple_of(order.max(1)) {
            let expected = columns.len().next_multiple_of(order.max(1));
            let quantity = "entries of right-hand sides";
            return Err(LinearError::WrongLength { quantity, given: columns.len(), expected });
        }
        columns.par_chunks_mut(LANES * order.max(1)).for_each(|columns| {
            let mut panel = Panel::new(self, trunk);
            for (lane, column) in columns.chunks(order).enumerate() {
                self.places(trunk)
                    .for_each(|place| panel.add(place, lane, column[self.structure.unknown_at(place)]));
            }
            panel.forward();
            panel.backward();
            self.write(&panel, trunk, columns);
            let kept = panel.height();
            for branch in branches {
                panel.go_on(kept, branch);
                panel.backward();
                self.write(&panel, branch, columns);
            }
        });
        Ok(())
    }

    /// The places of some supernodes in the elimination order.
    fn places(&self, supernodes: &[usize]) -> impl Iterator<Item = usize> {
        supernodes.iter().flat_map(|&s| self.structure.supernodes[s].places())
    }

    /// Writes the rows of a panel at `supernodes` to the columns in its lanes.
    fn write(&self, panel: &Panel, supernodes: &[usize], columns: &mut [f64]) {
        for (lane, column) in columns.chunks_mut(self.order()).enumerate() {
            self.places(supernodes)
                .for_each(|place| column[self.structure.unknown_at(place)] = panel.entry(place, lane));
        }
    }
}

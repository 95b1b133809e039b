//! Solutions with a sparse factor: full solutions, and forward substitutions restricted to the
//! reach of sparse right-hand sides.

use super::LinearError;
use super::elements::Supernode;
use super::fronts::SparseFactor;
use super::lanes::{
    LANES, LaneRow, ROWS, add_row, add_tile, add_transposed_tile, scaled_difference, subtract,
};
use crate::interruption::Interruption;
use pulp::{Arch, Simd, WithSimd};
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

/// A panel over the rows of some supernodes of a factor, which are in elimination order and contain
/// every ancestor of each.
pub(super) struct Panel<'a> {
    factor: &'a SparseFactor,
    supernodes: &'a [usize],
    /// The first row in the panel of each participating supernode of the factor.
    offset: Vec<usize>,
    rows: Vec<LaneRow>,
}

impl<'a> Panel<'a> {
    /// The zero panel over `supernodes`, which must be in elimination order and hold every ancestor
    /// of each.
    pub(super) fn new(factor: &'a SparseFactor, supernodes: &'a [usize]) -> Self {
        let offset = vec![0; factor.structure.supernodes.len()];
        let mut panel = Self { factor, supernodes, offset, rows: Vec::new() };
        panel.go_on(0, supernodes);
        panel
    }

    /// Keeps the first `kept` rows, and continues with zeros over `supernodes` in elimination
    /// order, which contain every ancestor that has no row among those kept. [`Panel::backward`]
    /// then needs only these.
    pub(super) fn go_on(&mut self, kept: usize, supernodes: &'a [usize]) {
        let mut next = kept;
        for &s in supernodes {
            self.offset[s] = next;
            next += self.factor.structure.supernodes[s].panel_rows();
        }
        self.rows.truncate(kept);
        self.rows.reserve_exact(next - kept);
        self.rows.resize(next, LaneRow::ZERO);
        self.supernodes = supernodes;
    }

    /// Number of rows.
    pub(super) fn height(&self) -> usize {
        self.rows.len()
    }

    /// The row that belongs to a place in the elimination order.
    fn row_of(&self, place: usize) -> usize {
        let s = self.factor.structure.supernode_at(place);
        self.offset[s] + place - self.factor.structure.supernodes[s].start
    }

    /// Adds to the entry of a lane at a place in the elimination order.
    pub(super) fn add(&mut self, place: usize, lane: usize, value: f64) {
        let row = self.row_of(place);
        self.rows[row].0[lane] += value;
    }

    /// The entry of a lane at a place in the elimination order.
    pub(super) fn entry(&self, place: usize, lane: usize) -> f64 {
        self.rows[self.row_of(place)].0[lane]
    }

    /// The rows of a supernode.
    pub(super) fn rows_of(&self, s: usize) -> &[LaneRow] {
        &self.rows[self.offset[s]..][..self.factor.structure.supernodes[s].columns]
    }

    /// L⁻¹ of every lane.
    pub(super) fn forward(&mut self) {
        Arch::new().dispatch(Forward(self));
    }

    /// L⁻ᵀ of every lane, for the participating supernodes.
    pub(super) fn backward(&mut self) {
        Arch::new().dispatch(Backward(self));
    }
}

struct Forward<'a, 'b>(&'b mut Panel<'a>);

impl WithSimd for Forward<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let panel = self.0;
        let factor = panel.factor;
        for &s in panel.supernodes {
            let node = factor.structure.supernodes[s];
            let tiles = factor.tiles(s);
            let end = panel.offset[s] + node.panel_rows();
            let (before, after) = panel.rows.split_at_mut(end);
            let x = &mut before[panel.offset[s]..];
            for b in 0..node.blocks() {
                forward_block(simd, &tiles[node.triangle(b)..node.triangle(b + 1)], b * ROWS, x);
            }
            let mut tiles = tiles[node.triangle(node.blocks())..].chunks_exact(node.columns);
            for rows in factor.structure.rows_below(&node).chunks(ROWS) {
                let Some(tile) = tiles.next() else { break };
                let mut sums = [LaneRow::ZERO; ROWS];
                add_tile(simd, tile, x, &mut sums);
                for (row, sum) in rows.iter().map(|&row| row as usize).zip(&sums) {
                    let t = factor.structure.supernode_at(row);
                    let at = panel.offset[t] + row - factor.structure.supernodes[t].start;
                    subtract(simd, sum, &mut after[at - end]);
                }
            }
        }
    }
}

/// x[first..] of a block: x_i = (x_i − Σ_{j<i} L_ij x_j) / L_ii.
#[inline(always)]
fn forward_block<S: Simd>(simd: S, block: &[[f64; ROWS]], first: usize, x: &mut [LaneRow]) {
    let (left, triangle) = block.split_at(first);
    let mut sums = [LaneRow::ZERO; ROWS];
    add_tile(simd, left, x, &mut sums);
    let x = &mut x[first..first + ROWS];
    for r in 0..ROWS {
        for k in 0..r {
            add_row(simd, triangle[k][r], &x[k], &mut sums[r]);
        }
        x[r] = scaled_difference(simd, &x[r], &sums[r], triangle[r][r]);
    }
}

struct Backward<'a, 'b>(&'b mut Panel<'a>);

impl WithSimd for Backward<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let panel = self.0;
        let factor = panel.factor;
        let mut below = Vec::new();
        for &s in panel.supernodes.iter().rev() {
            let node = factor.structure.supernodes[s];
            let rows = factor.structure.rows_below(&node).iter();
            let rows = rows.map(|&row| panel.rows[panel.row_of(row as usize)]);
            below.clear();
            below.extend(rows);
            below.resize(node.below.next_multiple_of(ROWS), LaneRow::ZERO);
            let (below, _) = below.as_chunks::<ROWS>();
            let from = panel.offset[s];
            let x = &mut panel.rows[from..from + node.panel_rows()];
            for b in (0..node.blocks()).rev() {
                backward_block(simd, factor.tiles(s), &node, b, below, x);
            }
        }
    }
}

/// x of block `b`: x_k = (x_k − Σ_{i>k} L_ik x_i) / L_kk, with the rows below the supernode in
/// `below`.
#[inline(always)]
fn backward_block<S: Simd>(
    simd: S,
    tiles: &[[f64; ROWS]],
    node: &Supernode,
    b: usize,
    below: &[[LaneRow; ROWS]],
    x: &mut [LaneRow],
) {
    let first = b * ROWS;
    let columns = first..(first + ROWS).min(node.columns);
    let mut sums = [LaneRow::ZERO; ROWS];
    let under = tiles[node.triangle(node.blocks())..].chunks_exact(node.columns);
    for (tile, y) in under.zip(below) {
        add_transposed_tile(simd, &tile[columns.clone()], y, &mut sums);
    }
    let (x, later) = x.split_at_mut(first + ROWS);
    let (later, _) = later.as_chunks::<ROWS>();
    for (c, y) in later.iter().enumerate() {
        let tile = &tiles[node.triangle(b + 1 + c)..];
        add_transposed_tile(simd, &tile[columns.clone()], y, &mut sums);
    }
    let triangle = &tiles[node.triangle(b) + first..][..ROWS];
    let x = &mut x[first..];
    for k in (0..ROWS).rev() {
        for i in k + 1..ROWS {
            add_row(simd, triangle[k][i], &x[i], &mut sums[k]);
        }
        x[k] = scaled_difference(simd, &x[k], &sums[k], triangle[k][k]);
    }
}

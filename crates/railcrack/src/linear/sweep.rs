//! Forward and backward substitution with the supernodes of a factor for the columns of a panel.

use super::cholesky::SparseFactor;
use super::lanes::{LaneRow, ROWS, add_row, add_tile, add_transposed_tile, scaled_difference, subtract};
use super::structure::Supernode;
use pulp::{Arch, Simd, WithSimd};

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

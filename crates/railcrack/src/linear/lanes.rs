//! Inner kernel of the sparse solver: a tile of numbers times rows of several columns.
//!
//! Columns are lanes of vector registers: row r of a panel holds entry r of [`LANES`] columns. The
//! operations in one lane are a fixed sequence, independent of the other lanes, so that the bits of
//! a column do not depend on its neighbours. Products are fused with sums exactly where the code
//! states it, and rounded once, so that the bits do not depend on the vector unit either.

use pulp::Simd;

/// Columns of a panel.
pub(super) const LANES: usize = 16;

/// Rows of a tile: [`ROWS`] × 2 vectors of sums fill the registers of AVX2 and hide the latency of
/// the sums.
pub(super) const ROWS: usize = 6;

/// [`ROWS`] entries of a column. The tiles of a supernode are stored column by column: first the
/// blocks of the triangle, block b with the columns up to its own, then the blocks below. Rows that
/// pad the last block are zero; the diagonal holds 1 / L_ii.
pub(super) type Tile = [f64; ROWS];

/// One row of a panel, aligned to a cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub(super) struct LaneRow(pub(super) [f64; LANES]);

impl LaneRow {
    /// Zero in every lane.
    pub(super) const ZERO: Self = Self([0.0; LANES]);
}

/// Sums of a tile: row by row, lane by lane.
pub(super) type Sums = [LaneRow; ROWS];

/// sums[r] += Σ_k tile[k][r] x[k] over the columns of the tile, in their order.
#[inline(always)]
pub(super) fn add_tile<S: Simd>(simd: S, tile: &[[f64; ROWS]], x: &[LaneRow], sums: &mut Sums) {
    add_products(simd, tile.iter(), x, sums);
}

/// Rows of a block of sums that are held in registers at once.
const HELD: usize = 8;

/// sums[r] += Σ_k (lane r of a[k]) b[k], in the order of k.
#[inline(always)]
pub(super) fn add_outer<S: Simd>(simd: S, a: &[LaneRow], b: &[LaneRow], sums: &mut [LaneRow; LANES]) {
    let (groups, _) = sums.as_chunks_mut::<HELD>();
    for (group, sums) in groups.iter_mut().enumerate() {
        let lanes = a.iter().map(|row| &row.0.as_chunks::<HELD>().0[group]);
        add_products(simd, lanes, b, sums);
    }
}

/// sums[r] += Σ_k factors[k][r] x[k], in the order of k.
#[inline(always)]
fn add_products<'a, S: Simd, const R: usize>(
    simd: S,
    factors: impl Iterator<Item = &'a [f64; R]> + Clone,
    x: &[LaneRow],
    sums: &mut [LaneRow; R],
) {
    for v in (0..LANES / S::F64_LANES).step_by(2) {
        let mut held = [[simd.splat_f64s(0.0); 2]; R];
        for (held, sum) in held.iter_mut().zip(&*sums) {
            let (sum, _) = S::as_simd_f64s(&sum.0);
            *held = [sum[v], sum[v + 1]];
        }
        for (factors, x) in factors.clone().zip(x) {
            let (x, _) = S::as_simd_f64s(&x.0);
            let (left, right) = (x[v], x[v + 1]);
            for (held, &factor) in held.iter_mut().zip(factors) {
                let factor = simd.splat_f64s(factor);
                held[0] = simd.mul_add_f64s(factor, left, held[0]);
                held[1] = simd.mul_add_f64s(factor, right, held[1]);
            }
        }
        for (held, sum) in held.iter().zip(&mut *sums) {
            let (sum, _) = S::as_mut_simd_f64s(&mut sum.0);
            [sum[v], sum[v + 1]] = *held;
        }
    }
}

/// sums[k] += Σ_r tile[k][r] y[r]: the transpose of a tile of at most [`ROWS`] columns, rows in
/// their order.
#[inline(always)]
pub(super) fn add_transposed_tile<S: Simd>(
    simd: S,
    tile: &[[f64; ROWS]],
    y: &[LaneRow; ROWS],
    sums: &mut Sums,
) {
    let mut square = [[0.0; ROWS]; ROWS];
    for (k, column) in tile.iter().enumerate().take(ROWS) {
        for r in 0..ROWS {
            square[r][k] = column[r];
        }
    }
    add_tile(simd, &square, y, sums);
}

/// y += factor x, lane by lane.
#[inline(always)]
pub(super) fn add_row<S: Simd>(simd: S, factor: f64, x: &LaneRow, y: &mut LaneRow) {
    let factor = simd.splat_f64s(factor);
    let (x, _) = S::as_simd_f64s(&x.0);
    let (y, _) = S::as_mut_simd_f64s(&mut y.0);
    for (y, x) in y.iter_mut().zip(x) {
        *y = simd.mul_add_f64s(factor, *x, *y);
    }
}

/// y −= x, lane by lane.
#[inline(always)]
pub(super) fn subtract<S: Simd>(simd: S, x: &LaneRow, y: &mut LaneRow) {
    let (x, _) = S::as_simd_f64s(&x.0);
    let (y, _) = S::as_mut_simd_f64s(&mut y.0);
    for (y, x) in y.iter_mut().zip(x) {
        *y = simd.sub_f64s(*y, *x);
    }
}

/// (y − x) scale, lane by lane.
#[inline(always)]
pub(super) fn scaled_difference<S: Simd>(simd: S, y: &LaneRow, x: &LaneRow, scale: f64) -> LaneRow {
    let scale = simd.splat_f64s(scale);
    let mut difference = LaneRow::ZERO;
    let (out, _) = S::as_mut_simd_f64s(&mut difference.0);
    let ((y, _), (x, _)) = (S::as_simd_f64s(&y.0), S::as_simd_f64s(&x.0));
    for (out, (y, x)) in out.iter_mut().zip(y.iter().zip(x)) {
        *out = simd.mul_f64s(simd.sub_f64s(*y, *x), scale);
    }
    difference
}

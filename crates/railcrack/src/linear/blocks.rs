//! Blocks of a matrix for parallel tasks.

use faer::MatMut;
use rayon::prelude::*;

/// The columns of a matrix in blocks of `width`, the last one with what is left, in order.
pub(super) fn column_blocks<T: Send + Sync>(
    matrix: MatMut<'_, T>,
    width: usize,
) -> impl IndexedParallelIterator<Item = MatMut<'_, T>> {
    let mut blocks = Vec::with_capacity(matrix.ncols().div_ceil(width));
    let mut rest = matrix;
    while rest.ncols() > width {
        let (block, right) = rest.split_at_col_mut(width);
        blocks.push(block);
        rest = right;
    }
    if rest.ncols() > 0 {
        blocks.push(rest);
    }
    blocks.into_par_iter()
}

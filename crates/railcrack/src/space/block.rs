//! Products of the hat functions of two cells.

/// Hat functions of the first cell, components, hat functions of the second, components.
pub(super) type Block = [[[[f64; 3]; 4]; 3]; 4];
pub(super) const EMPTY: Block = [[[[0.0; 3]; 4]; 3]; 4];

/// A block `count` times, which is not computed for a count of zero.
pub(super) fn times(count: f64, block: impl FnOnce() -> Block) -> Block {
    if count == 0.0 {
        return EMPTY;
    }
    let mut block = block();
    block.iter_mut().flatten().flatten().flatten().for_each(|value| *value *= count);
    block
}

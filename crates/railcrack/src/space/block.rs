//! Products of the hat functions of two cells.

/// Hat functions of the first cell, components, hat functions of the second, components.
pub(super) type Block = [[[[f64; 3]; 4]; 3]; 4];
pub(super) const EMPTY: Block = [[[[0.0; 3]; 4]; 3]; 4];

/// A block `count` times; none for a count of zero, for which it is not computed.
pub(super) fn counted(count: f64, block: impl FnOnce() -> Block) -> Option<Block> {
    (count > 0.0).then(|| times(count, block()))
}

/// A block times a factor.
pub(super) fn times(factor: f64, mut block: Block) -> Block {
    block.iter_mut().flatten().flatten().flatten().for_each(|value| *value *= factor);
    block
}

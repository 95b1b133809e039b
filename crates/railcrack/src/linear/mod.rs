//! Linear algebra, dense and sparse; the only module that names faer.
//!
//! Results are the same bits whatever the number of threads: factorisations run on the calling thread, and what runs in
//! parallel are columns that do not know of each other.

mod cholesky;
mod dense;
mod error;
mod gram;
mod lanes;
mod reach;
mod sparse;
#[cfg(test)]
mod sparse_tests;
mod sweep;

pub use cholesky::{SparseCholesky, SparseFactor};
pub use dense::{
    SmallFactor, SpdFactor, add_product, general_inverse, product, product_transposed, spd_inverse,
};
pub use error::LinearError;
pub use gram::{gram, gram_of};
pub use reach::{ReachedColumn, SparseColumn};
pub use sparse::{SparseSymmetric, SymmetricPattern};

//! Linear algebra, dense and sparse; the only module that uses faer. Results have the same bits for
//! any number of threads: parallel tasks are independent blocks and columns whose division does not
//! depend on that number.

mod bordered;
mod dense;
mod elements;
mod error;
mod fronts;
mod gmres;
mod gram;
mod lanes;
mod large;
mod reach;
#[cfg(test)]
mod sparse_tests;
mod spd;

pub(crate) use bordered::BorderedFactor;
pub(crate) use dense::{SmallFactor, add_product, coupling, products_of_rows, spd_inverse_unless};
pub use dense::{general_inverse, product, spd_inverse};
pub use elements::ElementSum;
pub use error::LinearError;
pub use fronts::{SparseCholesky, SparseFactor};
pub(crate) use gmres::least_residual;
pub use gram::gram;
pub(crate) use large::LargeFactor;
pub(crate) use reach::PANEL_COLUMNS;
pub use reach::{ReachedPanel, SparseColumn};
pub(crate) use spd::SpdFactor;

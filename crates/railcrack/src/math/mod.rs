//! Vectors, plane-strain stress tensors, dense matrices, quadrature rules, exact orientation,
//! enclosing balls.

mod anderson;
mod ball;
pub(crate) mod chebyshev;
mod golden;
mod legendre;
mod matrix;
pub(crate) mod nonnegative;
pub(crate) mod periodic;
mod quadrature;
mod tensor;
mod track;
mod vector;

pub(crate) use anderson::Anderson;
pub(crate) use ball::{Orientation, orientation, segments_touch, smallest_ball};
pub use golden::{Ties, golden_section};
pub(crate) use legendre::{legendre_second, legendre_zeroth};
pub use matrix::Matrix;
pub(crate) use matrix::{add_rows_to_each, axpy, dot, inlined};
pub use quadrature::gauss_legendre;
pub(crate) use quadrature::{complete_elliptic, lagrange, quantiles};
pub use tensor::Tensor;
pub(crate) use track::{Track, every_second};
pub(crate) use vector::dot3;
pub use vector::{MPA_SQRT_MM, OutOfRange, RailBox, Stress, Vec2};

//! Vectors, plane-strain stress tensors, dense matrices, quadrature rules, exact orientation,
//! enclosing balls.

mod anderson;
mod ball;
pub(crate) mod chebyshev;
mod elliptic;
mod golden;
mod grading;
mod kernels;
mod matrix;
pub(crate) mod nonnegative;
pub(crate) mod periodic;
mod predicate;
mod quadrature;
mod rail_box;
mod range;
mod stress;
mod track;
mod units;
mod vector;

pub(crate) use anderson::Anderson;
pub(crate) use ball::smallest_ball;
pub(crate) use elliptic::complete_elliptic;
pub use golden::{Ties, golden_section};
pub(crate) use grading::quantiles;
pub(crate) use kernels::{add_rows_to_each, axpy, dot, inlined};
pub use matrix::Matrix;
pub(crate) use predicate::{Orientation, orientation, segments_touch};
pub use quadrature::gauss_legendre;
pub use rail_box::RailBox;
pub use range::OutOfRange;
pub use stress::Stress;
pub(crate) use track::{Track, every_second};
pub use units::MPA_SQRT_MM;
pub use vector::Vec2;
pub(crate) use vector::dot3;

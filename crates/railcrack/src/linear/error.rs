//! Errors of factorisations and solutions.

use crate::interruption::Interrupted;
use thiserror::Error;

/// A matrix that cannot be built or factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum LinearError {
    /// A matrix that is not positive definite.
    #[error("matrix of order {order} is not positive definite: pivot {pivot} is not positive")]
    NotPositiveDefinite {
        /// Order of the matrix.
        order: usize,
        /// Index of the pivot, from 0: the unknown of a sparse matrix, whatever the order of
        /// elimination.
        pivot: usize,
    },
    /// A matrix without inverse.
    #[error("matrix of order {order} is singular to working precision")]
    Singular {
        /// Order of the matrix.
        order: usize,
    },
    /// An unknown out of range.
    #[error("unknown {unknown} is out of range: the {order} unknowns are numbered from 0")]
    NoSuchUnknown {
        /// The given value.
        unknown: usize,
        /// Order of the matrix.
        order: usize,
    },
    /// An entry outside the pattern.
    #[error("entry ({row}, {column}) is not in the pattern of the matrix")]
    OutsidePattern {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
    },
    /// A number of entries that does not fit the unknowns.
    #[error("{quantity}: {given} given, {expected} expected")]
    WrongLength {
        /// The quantity that was counted.
        quantity: &'static str,
        /// The given number.
        given: usize,
        /// The required number.
        expected: usize,
    },
    /// An elimination order that contains an unknown twice.
    #[error("the elimination order contains unknown {unknown} twice")]
    EliminatedTwice {
        /// The unknown.
        unknown: usize,
    },
    /// More entries than fit into memory.
    #[error("the factor of a matrix of order {order} does not fit into memory")]
    TooLarge {
        /// Order of the matrix.
        order: usize,
    },
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

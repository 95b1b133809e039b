//! Errors of unstructured grids.

use thiserror::Error;

/// Inconsistencies of an unstructured grid.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GridError {
    /// A number of nodes that is not a multiple of the nodes of one cell.
    #[error(
        "block {block} of the cells has {found} nodes, which is not a multiple of the {nodes} nodes of a cell"
    )]
    PartialCell {
        /// Block, from 0.
        block: usize,
        /// Its number of nodes.
        found: usize,
        /// Number of nodes of one cell.
        nodes: usize,
    },
    /// A cell that refers to a point outside the list of points.
    #[error(
        "block {block} of the cells refers to point {point}, but the {points} points are numbered from 0"
    )]
    NoSuchPoint {
        /// Block, from 0.
        block: usize,
        /// The point that it refers to.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// Data whose length does not fit the points or cells.
    #[error("`{name}` has {found} values, not {components} for each of {entries} points or cells")]
    Length {
        /// The data.
        name: String,
        /// Its number of values.
        found: usize,
        /// Its number of components.
        components: usize,
        /// Number of points or cells.
        entries: usize,
    },
    /// Data with an unsuitable number of components.
    #[error("`{name}` has {found} components: must be {accepted}")]
    Components {
        /// The data.
        name: String,
        /// Its number of components.
        found: usize,
        /// The accepted numbers of components.
        accepted: &'static str,
    },
    /// Two arrays with the same name.
    #[error("`{name}` occurs twice")]
    SameName {
        /// The name.
        name: String,
    },
    /// A value that is not a finite number.
    #[error("`{name}` is {value} at entry {entry} (from 0): must be a finite number")]
    NotFinite {
        /// The data, or `points`.
        name: String,
        /// Point or cell, from 0.
        entry: usize,
        /// The value.
        value: f64,
    },
}

//! Errors of an unstructured grid.

use thiserror::Error;

/// An inconsistent grid.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GridError {
    /// A number of nodes that does not make whole cells.
    #[error(
        "block {block} of the cells has {found} nodes, which is not a multiple of the {nodes} nodes of a cell"
    )]
    PartialCell {
        /// Block, from 0.
        block: usize,
        /// Its nodes.
        found: usize,
        /// Nodes of one cell.
        nodes: usize,
    },
    /// A cell with a point that does not exist.
    #[error("block {block} of the cells names point {point}: points are numbered from 0, there are {points}")]
    NoSuchPoint {
        /// Block, from 0.
        block: usize,
        /// The point that it names.
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
    /// Data with another number of components than required.
    #[error("`{name}` has {found} components: must be {accepted}")]
    Components {
        /// The data.
        name: String,
        /// Its number of components.
        found: usize,
        /// The accepted numbers of components.
        accepted: &'static str,
    },
    /// Two arrays of one name.
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

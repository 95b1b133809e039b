//! Errors of an unstructured grid.

use thiserror::Error;

/// Parts of a grid that do not fit together.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GridError {
    /// Nodes that do not make whole cells.
    #[error("block {block} of the cells has {found} nodes, which is not a number of cells of {nodes} nodes")]
    PartialCell {
        /// Block, from 0.
        block: usize,
        /// Its nodes.
        found: usize,
        /// Nodes of one cell.
        nodes: usize,
    },
    /// A cell names a point that is not there.
    #[error("block {block} of the cells names point {point}: points are numbered from 0, there are {points}")]
    NoSuchPoint {
        /// Block, from 0.
        block: usize,
        /// The point that it names.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// Data of another length than what it belongs to.
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
    /// Data with another number of components than asked for.
    #[error("`{name}` has {found} components: must be {accepted}")]
    Components {
        /// The data.
        name: String,
        /// Its number of components.
        found: usize,
        /// What is accepted.
        accepted: &'static str,
    },
    /// Two arrays of one name.
    #[error("`{name}` is there twice")]
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

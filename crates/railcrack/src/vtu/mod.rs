//! Fields on a mesh in the XML format of VTK: unstructured grids (`.vtu`) and collections of them
//! (`.pvd`).
//!
//! Source: *VTK File Formats*, chapter of *The VTK User's Guide* (Kitware), "XML File Formats".

mod array;
pub(crate) mod base64;
mod error;
mod grid;
mod numbers;
mod payload;
mod pvd;
mod read;
mod write;

pub use array::Array;
pub use error::{GridError, VtuError};
pub use grid::{CellBlock, CellShape, UnstructuredGrid};
pub use pvd::{Snapshot, pvd_text, write_pvd};
pub use read::{read_vtu, read_vtu_bytes};
pub use write::{vtu_text, write_vtu};

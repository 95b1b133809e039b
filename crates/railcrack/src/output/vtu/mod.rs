//! Fields on a mesh in the XML format of VTK: unstructured grids (`.vtu`) and collections of them (`.pvd`).
//!
//! Source: *VTK File Formats*, chapter of *The VTK User's Guide* (Kitware), "XML File Formats".

mod array;
pub(super) mod base64;
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
pub(super) use pvd::write_pvd_durably;
pub use pvd::{Snapshot, write_pvd};
pub use read::read_vtu;
pub use write::write_vtu;
pub(super) use write::write_vtu_durably;

//! Fields on a mesh in the XML format of VTK: unstructured grids (`.vtu`) and collections of them
//! (`.pvd`).
//!
//! Source: *VTK File Formats*, chapter of *The VTK User's Guide* (Kitware), "XML File Formats".

mod base64;
mod cell_type;
mod error;
mod numbers;
mod payload;
mod pvd;
mod read;
mod write;

pub use cell_type::vtk_type;
pub use error::VtuError;
pub use pvd::{Snapshot, pvd_text, write_pvd};
pub use read::{read_vtu, read_vtu_bytes};
pub use write::{escaped, vtu_text, vtu_text_with, write_vtu};

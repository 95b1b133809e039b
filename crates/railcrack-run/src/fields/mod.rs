//! Fields of a run as files of VTK, written and read back.

mod files;
mod names;
mod space;
mod stored;

pub(crate) use files::{FieldFileEntry, collection, write_collection, write_fields};
pub use files::{field_file, field_grids};
pub(crate) use names::is_field_file;
pub use stored::{FieldFile, field_files};

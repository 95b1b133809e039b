//! The tables of a run as CSV.

mod column;
mod faces;
mod fields;
mod file;
mod growth;
mod read;
mod residual;
mod rows;
mod sif;
mod table;

pub use column::Column;
pub use faces::FaceRow;
pub use fields::Fields;
pub(crate) use file::CsvFile;
pub use growth::{TipRow, deferred_growth};
pub use read::{StepBlock, StepBlocks, read_table};
pub use residual::ResidualRow;
pub use rows::Rows;
pub use sif::{SifRow, SifScale};
pub use table::{Cell, Table, column_names, table};
pub(crate) use table::{header, header_of, markdown, whole};

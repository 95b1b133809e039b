//! The tables of a run as CSV.

mod by_column;
mod column;
mod columns;
mod contact;
mod faces;
mod fields;
mod file;
mod growth;
mod line;
mod read;
mod residual;
mod rows;
mod sif;
mod table;

pub use by_column::columns_of;
pub use column::Column;
pub use columns::{ColumnValues, Columns};
pub use contact::ContactRow;
pub use faces::FaceRow;
pub use fields::Fields;
pub(crate) use file::{CsvFile, check_sealed};
pub use growth::{TipRow, deferred_growth};
pub use line::{line_field, line_fields, text_field};
pub use read::{StepBlock, StepBlocks, read_table};
pub use residual::ResidualRow;
pub use rows::Rows;
pub use sif::{SifRow, SifScale};
pub use table::{Cell, Table, column_names};
pub(crate) use table::{header, header_of, markdown, table, table_text, whole};

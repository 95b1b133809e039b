//! The tables of a run as CSV.

mod faces;
mod file;
mod growth;
mod read;
mod residual;
mod rows;
mod sif;
mod tip_row;

pub use faces::FACES_COLUMNS;
pub use growth::GROWTH_COLUMNS;
pub use residual::{RESIDUAL_COLUMNS, ResidualRow};
pub use sif::SIF_COLUMNS;

pub use faces::{FACES_FILE, FaceRows, faces_header, status_of};
pub use file::CsvFile;
pub use growth::{GROWTH_FILE, growth_header, growth_rows};
pub use read::{Row, StepBlock, read_columns, read_step_blocks, read_steps};
pub use residual::{RESIDUAL_FILE, residual_table};
pub use rows::Rows;
pub use sif::{SIF_FILE, SifScale, sif_header, sif_rows};
pub use tip_row::{TipRow, read_growth, waiting};

/// Comment lines, then the column names.
pub fn header(comments: &[&str], columns: &[&str]) -> String {
    let mut text = format!("# railcrack {}\n", super::VERSION);
    for comment in comments {
        text.push_str("# ");
        text.push_str(comment);
        text.push('\n');
    }
    text.push_str(&columns.join(","));
    text.push('\n');
    text
}

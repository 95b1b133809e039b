//! Readers of files of results for the fuzz targets in `fuzz/`: whatever a file holds, they end
//! with a result or an error.

use crate::csv::{ContactRow, FaceRow, ResidualRow, SifRow, Table, TipRow, read_table};
use std::path::Path;

pub use crate::run_folder::fuzz_checkpoint as checkpoint;
pub use crate::study::fuzz_packed as packed;

/// Reads `input` as a Parquet table.
pub fn parquet(input: &[u8]) {
    let _ = crate::parquet::check(input, "study");
}

/// Reads `input` but for its first byte as the table that this byte selects, in `folder`.
pub fn results(folder: &Path, input: &[u8]) {
    let Some((&kind, content)) = input.split_first() else { return };
    match kind % 5 {
        0 => read::<SifRow>(folder, content),
        1 => read::<TipRow>(folder, content),
        2 => read::<FaceRow>(folder, content),
        3 => read::<ContactRow>(folder, content),
        _ => read::<ResidualRow>(folder, content),
    }
}

fn read<T: Table>(folder: &Path, content: &[u8]) {
    std::fs::write(folder.join(T::FILE), content).expect("a file");
    let _ = read_table::<T>(folder);
}

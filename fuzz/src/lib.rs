//! Fixtures of the fuzz targets.

pub mod case_files;

use std::path::PathBuf;

/// The folder of this process for files that a target reads, in memory where the system has such
/// a folder.
pub fn folder() -> PathBuf {
    let memory = PathBuf::from("/dev/shm");
    let place = if memory.is_dir() { memory } else { std::env::temp_dir() };
    let folder = place.join(format!("railcrack-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    folder
}

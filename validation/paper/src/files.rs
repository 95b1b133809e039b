//! Files of the results.

use railcrack_run::OutputError;
use std::path::Path;

/// Writes `text` to `path`, in a folder that is made where it does not exist.
///
/// Errors: the system refuses.
pub fn write(path: &Path, text: &str) -> Result<(), OutputError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
    }
    railcrack_report::put(path, text)
}

//! `railcrack schema`.

use crate::exit::{Exit, Failure};
use crate::print;

/// Prints the JSON Schema of the case file.
pub fn schema() -> Result<Exit, Failure> {
    print::stdout(&format!("{:#}\n", railcrack::case::json_schema()))?;
    Ok(Exit::Done)
}

//! Room for the names of those who answer for a sheet.

use crate::table::Table;

/// The lines to sign, below what they are signed for.
pub(super) fn approval(caption: String) -> Table {
    let mut table = Table::new(["", "Name", "Date", "Signature"]);
    table.caption = caption;
    for role in ["Prepared by", "Checked by", "Approved by"] {
        let line = "_".repeat(18);
        table.row([role.to_owned(), line.clone(), line.clone(), line]);
    }
    table
}

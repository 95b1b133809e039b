//! The `railcrack` command.
fn main() {}

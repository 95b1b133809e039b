//! The `railcrack` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(railcrack_cli::command(std::env::args_os()))
}

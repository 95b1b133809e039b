//! The `railcrack` command.

use std::process::ExitCode;

/// Of the static program, whose library of C has a slow one.
#[cfg(target_env = "musl")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    railcrack_cli::start_alone();
    ExitCode::from(railcrack_cli::command(std::env::args_os()))
}

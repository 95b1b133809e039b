//! `railcrack completions` and `railcrack man`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::{Args, Command};
use clap_complete::Shell;
use std::path::PathBuf;

/// Print the completion script of a shell
///
/// For bash: railcrack completions bash > ~/.local/share/bash-completion/completions/railcrack
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Print the manual page, or write the pages of all commands to a folder
#[derive(Debug, Args)]
pub struct ManArguments {
    /// Folder for the pages railcrack.1, railcrack-run.1, …
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Prints the completion script of `command`.
pub fn completions(arguments: &CompletionsArguments, mut command: Command) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "railcrack", &mut script);
    print::stdout(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}

/// Prints the manual page of `command`, or writes the pages of all commands.
pub fn man(arguments: &ManArguments, command: Command) -> Result<Exit, Failure> {
    match &arguments.out {
        None => {
            let mut page = Vec::new();
            clap_mangen::Man::new(command).render(&mut page).map_err(Failure::Stdout)?;
            print::stdout(&String::from_utf8_lossy(&page))?;
        }
        Some(folder) => {
            let refused = |source| Failure::CannotWrite { path: folder.clone(), source };
            std::fs::create_dir_all(folder).map_err(refused)?;
            clap_mangen::generate_to(command, folder).map_err(refused)?;
            print::stdout(&format!("manual pages in {}\n", folder.display()))?;
        }
    }
    Ok(Exit::Done)
}

//! Arguments of `railcrack view`, and what it says.

use super::server::serve;
use super::site::Site;
use crate::exit::{Exit, Failure};
use crate::interruption::end_on_signal;
use crate::print;
use clap::Args;
use railcrack_run::OutputError;
use railcrack_run::simulation::RunError;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;

/// Show the page of a folder in a browser, and follow a run or a study while it computes
///
/// The folder is that of a run, of a plastic state, of a comparison or of a study. The page is
/// served to this machine alone (127.0.0.1) and changes as steps and runs are finished; Ctrl-C ends
/// it. Nothing is written to the folder, and no file outside of it is served.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// The folder
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Port of the address [default: one that is free]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
}

/// Serves the folder until a signal comes.
pub fn view(arguments: &ViewArguments) -> Result<Exit, Failure> {
    let no_folder = || OutputError::NoFolder { folder: arguments.folder.clone() };
    let site = Site::of(&arguments.folder).map_err(|_| RunError::from(no_folder()))?;
    let refused = |action: String| {
        move |reason: std::io::Error| RunError::System { action, reason: reason.to_string() }
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port))
        .map_err(refused(format!("listen at port {} of 127.0.0.1", arguments.port)))?;
    let address = listener.local_addr().map_err(refused("listen".to_owned()))?;
    let end = end_on_signal().map_err(refused("listen to signals".to_owned()))?;
    print::stdout(&format!("{} at http://{address}/, Ctrl-C ends it\n", arguments.folder.display()))?;
    serve(&listener, &site, &end).map_err(refused(format!("listen at {address}")))?;
    Ok(Exit::Done)
}

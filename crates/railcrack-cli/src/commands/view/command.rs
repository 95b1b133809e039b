//! Arguments and messages of `railcrack view`.

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
use std::sync::Arc;

/// Show the report of a folder in a browser and update it while a run or a study computes
///
/// The folder is that of a run, a plastic state, a comparison or a study. The page is served on
/// this machine only (127.0.0.1) and is updated as steps and runs finish; Ctrl-C stops the server.
/// Nothing is written to the folder, and no file outside of it is served.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Folder of results
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Port to listen on [default: any free port]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
}

/// Serves the folder until a signal arrives.
pub fn view(arguments: &ViewArguments) -> Result<Exit, Failure> {
    let no_folder = || OutputError::NoFolder { folder: arguments.folder.clone() };
    let site = Arc::new(Site::of(&arguments.folder).map_err(|_| RunError::from(no_folder()))?);
    let refused = |action: String| {
        move |reason: std::io::Error| RunError::System { action, reason: reason.to_string() }
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port))
        .map_err(refused(format!("listen on port {} of 127.0.0.1", arguments.port)))?;
    let address = listener.local_addr().map_err(refused("listen".to_owned()))?;
    let end = end_on_signal().map_err(refused("install signal handlers".to_owned()))?;
    print::stdout(&format!(
        "{} at http://{address}/, Ctrl-C stops the server\n",
        arguments.folder.display()
    ))?;
    serve(&listener, &site, &end).map_err(refused(format!("listen on {address}")))?;
    Ok(Exit::Done)
}

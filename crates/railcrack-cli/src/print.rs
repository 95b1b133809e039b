//! Standard output and standard error.

use crate::display::stderr_columns;
use crate::exit::Failure;
use miette::{GraphicalReportHandler, GraphicalTheme};
use std::io::{ErrorKind, IsTerminal, Write};

/// Writes `text` to standard output. A reader that closes the pipe (`| head`) is not a failure.
pub fn stdout(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}

/// Writes a warning to standard error.
pub fn warning(says: &str) {
    // A failure to write to standard error cannot be reported.
    let _ = writeln!(std::io::stderr(), "warning: {says}");
}

/// Reports a failure on standard error: graphically with an excerpt of the file on a terminal,
/// otherwise with one line per error followed by the line of the file.
pub fn failure(failure: &Failure) {
    let mut err = std::io::stderr().lock();
    let text = match failure {
        Failure::Case(errors) if err.is_terminal() => {
            let theme = if std::env::var_os("NO_COLOR").is_some() {
                GraphicalTheme::unicode_nocolor()
            } else {
                GraphicalTheme::unicode()
            };
            let handler =
                GraphicalReportHandler::new_themed(theme).with_width(stderr_columns().unwrap_or(100).max(40));
            let mut text = String::new();
            for error in errors.errors() {
                if handler.render_report(&mut text, error).is_err() {
                    text.push_str(&format!("error: {}\n", error.one_line()));
                }
            }
            text
        }
        Failure::Case(errors) => {
            let lines = errors.errors().iter();
            lines.map(|error| format!("error: {}\n{}", error.one_line(), error.excerpt())).collect()
        }
        other => format!("error: {other}\n"),
    };
    // A failure to write to standard error cannot be reported.
    let _ = err.write_all(text.as_bytes());
}

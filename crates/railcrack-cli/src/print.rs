//! Standard output and standard error.

use crate::exit::Failure;
use miette::{GraphicalReportHandler, GraphicalTheme};
use std::io::{ErrorKind, IsTerminal, Write};

/// Writes `text` to standard output. A reader that has seen enough (`| head`) is no failure.
pub fn stdout(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}

/// Says on standard error what went wrong: drawn with the lines of the file on a terminal;
/// otherwise a line per error, and under it the line of the file.
pub fn failure(failure: &Failure) {
    let mut err = std::io::stderr().lock();
    let text = match failure {
        Failure::Case(errors) if err.is_terminal() => {
            let theme = if std::env::var_os("NO_COLOR").is_some() {
                GraphicalTheme::unicode_nocolor()
            } else {
                GraphicalTheme::unicode()
            };
            let handler = GraphicalReportHandler::new_themed(theme).with_width(100);
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
    // Nobody is left to tell when standard error itself is gone.
    let _ = err.write_all(text.as_bytes());
}

//! Display of progress: a bar on a terminal, lines elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::time::Duration;

/// Display of a computation in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verbosity {
    /// A bar on a terminal, lines elsewhere.
    Progress,
    /// Nothing.
    Quiet,
}

/// Display of progress on standard error.
#[derive(Debug)]
pub enum Display {
    Bar(ProgressBar),
    Lines,
    Quiet,
}

impl Display {
    /// The display of a computation with this `bar` on a terminal.
    pub fn new(verbosity: Verbosity, bar: impl FnOnce() -> ProgressBar) -> Self {
        match verbosity {
            Verbosity::Quiet => Self::Quiet,
            Verbosity::Progress if std::io::stderr().is_terminal() => Self::Bar(bar()),
            Verbosity::Progress => Self::Lines,
        }
    }

    /// The bar, if the display has one.
    pub fn bar(&self) -> Option<&ProgressBar> {
        match self {
            Self::Bar(bar) => Some(bar),
            Self::Lines | Self::Quiet => None,
        }
    }

    /// Writes a line of text. A failure to write to standard error cannot be reported.
    pub fn say(&self, line: &str) {
        match self {
            Self::Bar(bar) => bar.println(line),
            Self::Lines => drop(writeln!(std::io::stderr().lock(), "{line}")),
            Self::Quiet => {}
        }
    }

    /// Removes the bar.
    pub fn close(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// A bar of `length` parts in the format of `template`.
pub fn styled_bar(length: u64, template: &str) -> ProgressBar {
    let bar = ProgressBar::new(length);
    // An invalid template leaves the default bar.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
        // The elapsed time is updated between steps too.
        bar.enable_steady_tick(Duration::from_millis(250));
    }
    bar
}

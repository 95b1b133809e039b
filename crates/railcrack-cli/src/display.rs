//! Where progress is shown: a bar on a terminal, lines elsewhere.

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

/// Standard error, as a user looks at it.
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

    /// The bar, where there is one.
    pub fn bar(&self) -> Option<&ProgressBar> {
        match self {
            Self::Bar(bar) => Some(bar),
            Self::Lines | Self::Quiet => None,
        }
    }

    /// A line of text; nobody is left to tell when standard error itself is gone.
    pub fn say(&self, line: &str) {
        match self {
            Self::Bar(bar) => bar.println(line),
            Self::Lines => drop(writeln!(std::io::stderr().lock(), "{line}")),
            Self::Quiet => {}
        }
    }

    /// Takes the bar away.
    pub fn close(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// A bar of `length` parts by `template`.
pub fn styled_bar(length: u64, template: &str) -> ProgressBar {
    let bar = ProgressBar::new(length);
    // A template that does not parse leaves the plain bar.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
        // Between two steps, too, a reader sees that time passes.
        bar.enable_steady_tick(Duration::from_millis(250));
    }
    bar
}

//! Display of progress: a bar on a terminal, lines elsewhere.

use crate::terminal;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};
use terminal_size::{Width, terminal_size_of};

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
            Self::Bar(bar) => bar.println(terminal::plain(line)),
            Self::Lines => terminal::stderr(&format!("{line}\n")),
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

/// Columns of the terminal on standard output; `None` where it is no terminal, or unknown.
pub fn stdout_columns() -> Option<usize> {
    terminal_size_of(std::io::stdout()).map(|(Width(columns), _)| columns.into())
}

/// Columns of the terminal on standard error.
pub fn stderr_columns() -> Option<usize> {
    terminal_size_of(std::io::stderr()).map(|(Width(columns), _)| columns.into())
}

/// Indentation of a continued line of [`wrapped`]: below the values of a summary.
const BELOW: usize = 23;

/// `text` in lines of at most `columns` characters, broken between words; lines that are continued
/// are indented. Without `columns` the text itself.
pub fn wrapped(text: &str, columns: Option<usize>) -> String {
    let Some(columns) = columns.filter(|columns| *columns > 2 * BELOW) else { return text.to_owned() };
    let mut lines = String::with_capacity(text.len());
    for line in text.lines() {
        let mut rest = line;
        let mut indent = 0;
        while indent + rest.chars().count() > columns {
            let room = rest.char_indices().nth(columns - indent).map_or(rest.len(), |(end, _)| end);
            // A word that is longer than a line is not broken.
            let Some(end) = rest[..room].rfind(' ').filter(|end| !rest[..*end].trim().is_empty()) else {
                break;
            };
            lines.push_str(&format!("{:indent$}{}\n", "", rest[..end].trim_end()));
            rest = rest[end..].trim_start();
            indent = BELOW;
        }
        lines.push_str(&format!("{:indent$}{rest}\n", ""));
    }
    lines
}

/// Time left that does not jump from estimate to estimate: it runs down by itself, and is drawn to
/// each new estimate.
#[derive(Debug, Default)]
pub struct SteadyTime {
    /// Seconds left when they were last asked for, and when that was.
    last: Option<(f64, Instant)>,
}

/// Seconds in which the time left comes to two thirds of the difference to a new estimate; of a
/// long one, a tenth of it.
const DRAWN_IN: f64 = 10.0;

impl SteadyTime {
    /// The time left at `now`, with the `estimate` of it, both in seconds.
    pub fn left(&mut self, estimate: f64, now: Instant) -> f64 {
        let left = match self.last {
            None => estimate,
            Some((before, then)) => {
                let passed = now.saturating_duration_since(then).as_secs_f64();
                let expected = (before - passed).max(0.0);
                let within = DRAWN_IN.max(0.1 * estimate);
                expected + (1.0 - (-passed / within).exp()) * (estimate - expected)
            }
        };
        self.last = Some((left, now));
        left
    }
}

/// Seconds as a reader takes them in: `40 s`, `5 min`, `2 h 10 min`.
pub fn time_text(seconds: f64) -> String {
    let whole = seconds.max(0.0).ceil() as u64;
    match whole {
        0..90 => format!("{} s", if whole > 20 { whole.div_ceil(5) * 5 } else { whole }),
        90..5400 => format!("{} min", whole.div_ceil(60)),
        _ => {
            let minutes = whole.div_ceil(600) * 10;
            format!("{} h {} min", minutes / 60, minutes % 60)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words_and_indented() {
        let text = "rail\n  elasticity           E = 210000 MPa, nu = 0.3, and more of it\n";
        assert_eq!(wrapped(text, None), text);
        let lines =
            "rail\n  elasticity           E = 210000 MPa, nu =\n                       0.3, and more of it\n";
        assert_eq!(wrapped(text, Some(48)), lines);
        let word = format!("{}\n", "x".repeat(200));
        assert_eq!(wrapped(&word, Some(60)), word);
    }

    #[test]
    fn the_time_left_is_drawn_to_its_estimates() {
        let mut steady = SteadyTime::default();
        let begin = Instant::now();
        let after = |seconds| begin + Duration::from_secs(seconds);
        assert_eq!(steady.left(100.0, begin), 100.0);
        // An estimate that holds: the time runs down.
        assert!((steady.left(98.0, after(2)) - 98.0).abs() < 1e-9);
        // One that jumps is followed slowly, and in the end.
        let jumped = steady.left(300.0, after(3));
        assert!((97.0..105.0).contains(&jumped), "{jumped}");
        let late = steady.left(300.0, after(303));
        assert!((late - 300.0).abs() < 1.0, "{late}");
        assert_eq!([7.2, 44.0, 130.0, 8000.0].map(time_text), ["8 s", "45 s", "3 min", "2 h 20 min"]);
    }
}

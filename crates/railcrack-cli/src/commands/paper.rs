//! `railcrack paper`.

use super::run;
use crate::exit::{Exit, Failure};
use crate::interruption::Interruption;
use crate::print;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use railcrack::growth::Observer;
use railcrack_paper::{
    Earlier, Overlay, PaperError, Reproduction, SETUPS, Telling, parse_figures, reproduce,
};
use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::sync::Mutex;

/// Recompute the figures of Trolle et al. (2014) and check every statement of its text
///
/// Recomputes Figs 13 to 25 and 27 to 30 for each choice that the paper leaves open: half-plane or
/// block, direction of travel, friction, load steps, criterion. Written to the folder: the case
/// files (cases/), a plot and a table of each figure (figures/), the numbers that decide each
/// statement (claims.csv), and the pages (paper.md and, for each group of figures, paper-fig….md).
#[derive(Debug, Args)]
pub struct PaperArguments {
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "paper")]
    out: PathBuf,
    /// Recompute only these figures (13 to 25 and 27 to 30) and the statements they decide
    #[arg(long, value_name = "FIG", num_args = 1..)]
    only: Vec<String>,
    /// Curves digitised from a figure of the paper, in a file named after it (fig18.csv): drawn
    /// over the computed curves, with their distances in overlays.csv
    #[arg(long, value_name = "FILE", num_args = 1..)]
    overlay: Vec<PathBuf>,
    /// Suppress progress output
    #[arg(long)]
    quiet: bool,
    /// Replace existing results in the folder
    #[arg(long, conflicts_with = "resume")]
    force: bool,
    /// Reuse the finished runs in the folder that have the same case and version, and compute the
    /// others
    #[arg(long)]
    resume: bool,
}

/// Recomputes the paper.
pub fn paper(arguments: &PaperArguments) -> Result<Exit, Failure> {
    let figures = parse_figures(&arguments.only)?;
    let overlays = arguments.overlay.iter().map(|path| Overlay::read(path)).collect::<Result<Vec<_>, _>>()?;
    let earlier = match (arguments.force, arguments.resume) {
        (true, _) => Earlier::Replace,
        (_, true) => Earlier::TakeOver,
        _ => Earlier::Refuse,
    };
    let told = Told {
        interruption: run::listen()?,
        display: Display::of(arguments.quiet),
        done: Mutex::new((0, 0)),
    };
    let computed = reproduce(&arguments.out, &figures, &overlays, earlier, &told);
    told.close();
    match computed {
        Ok(reproduction) => {
            print::stdout(&result_text(&reproduction))?;
            Ok(if reproduction.failures.is_empty() { Exit::Done } else { Exit::NotConverged })
        }
        Err(PaperError::Interrupted) => {
            print::stdout(
                "interrupted: no figure was written, finished runs are kept; --resume continues\n",
            )?;
            Ok(Exit::Interrupted)
        }
        Err(error) => Err(error.into()),
    }
}

fn result_text(reproduction: &Reproduction) -> String {
    let mut text = String::new();
    for verdict in &reproduction.verdicts {
        text.push_str(&format!("{}: {}\n", verdict.claim.id, verdict.words()));
    }
    for (name, reason) in &reproduction.failures {
        text.push_str(&format!("ended early: {name}: {reason}\n"));
    }
    let setups = reproduction.results.setups().count();
    text.push_str(&format!(
        "{} statements, {} runs, {setups} of {} set-ups; page in {}\n",
        reproduction.verdicts.len(),
        reproduction.runs,
        SETUPS.len(),
        reproduction.page.display()
    ));
    text
}

enum Display {
    Bar(ProgressBar),
    Lines,
    Quiet,
}

impl Display {
    fn of(quiet: bool) -> Self {
        if quiet {
            Self::Quiet
        } else if std::io::stderr().is_terminal() {
            let bar = ProgressBar::new(0);
            let template = "[{bar:28}] {pos}/{len} runs  {msg}  {elapsed} elapsed, {eta} left";
            // A template that does not parse leaves the plain bar.
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style.progress_chars("=> "));
            }
            Self::Bar(bar)
        } else {
            Self::Lines
        }
    }
}

/// Reports finished runs on standard error.
struct Told {
    interruption: Interruption,
    display: Display,
    /// Numbers of finished and of planned runs.
    done: Mutex<(usize, usize)>,
}

impl Told {
    fn close(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

impl Observer for Told {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

impl Telling for Told {
    fn planned(&self, runs: usize) {
        if let Display::Bar(bar) = &self.display {
            bar.set_length(runs as u64);
        }
        *self.done.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = (0, runs);
    }

    fn finished(&self, name: &str, wall_s: f64) {
        let mut done = self.done.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        done.0 += 1;
        match &self.display {
            Display::Bar(bar) => {
                bar.set_message(name.to_owned());
                bar.set_position(done.0 as u64);
            }
            Display::Lines => {
                drop(writeln!(std::io::stderr().lock(), "{}/{} {name}, {wall_s:.1} s", done.0, done.1))
            }
            Display::Quiet => {}
        }
    }
}

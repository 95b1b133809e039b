//! `railcrack validate`: the model against measured numbers.

use crate::commands::run::listen;
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::Inputs;
use crate::interruption::{Interruption, Remains};
use crate::print;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use railcrack::growth::StepRecord;
use railcrack_report::{ValidationPage, is_validation_plot};
use railcrack_run::simulation::{RunError, RunObserver};
use railcrack_run::validation::{Scores, Space, Validation, ValidationError, validation_table};
use railcrack_run::{Existing, ResultFolder, ResultKind, WithRun};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Compare the model with measured growth rates, and score the comparison
///
/// An entry is a file NAME.toml with a measured number, its source and how it was read; its
/// conditions are a study with distributions. The growth of all samples is computed, and each
/// scored entry is compared with the distribution that they give. The folder gets validation.csv,
/// validation.html and plots/.
#[derive(Debug, Args)]
pub struct ValidateArguments {
    /// Folder of the entries [default: those that come with the program]
    #[arg(value_name = "DIR")]
    dir: Option<PathBuf>,
    /// Folder for the results [default: DIR, or validation]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave out the predictions in space, which take most of the time
    #[arg(long)]
    no_space: bool,
    /// Suppress progress output
    #[arg(long)]
    quiet: bool,
    /// Replace existing results in the folder
    #[arg(long)]
    force: bool,
}

/// Computes the samples, scores, writes the folder and prints the scores by grade.
pub fn validate(arguments: &ValidateArguments) -> Result<Exit, Failure> {
    let read = match &arguments.dir {
        Some(dir) => Validation::read(dir),
        None => Validation::shipped(),
    };
    let mut validation = read.map_err(|error| match error {
        ValidationError::Case(errors) => Failure::Case(errors),
        ValidationError::Folder { path, source } => Failure::CannotRead { path, source },
        other => Failure::Calibration { reason: other.to_string() },
    })?;
    if arguments.no_space {
        validation = validation.with(Space::LeftOut);
    }
    let out = arguments.out.clone().or_else(|| arguments.dir.clone());
    let out = out.unwrap_or_else(|| PathBuf::from("validation"));
    let inputs = Inputs::default().with_all(validation.files().iter().cloned());
    inputs.stay(&out, |name| VALIDATION.owns(name))?;
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    let entered = ResultFolder::enter(&out, &VALIDATION, existing).map_err(RunError::from)?;
    let progress = ValidationProgress {
        interruption: listen(Remains::Nothing)?,
        bar: ValidationProgress::bar(
            if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress },
            validation.runs(),
        ),
    };
    validation.compute(&progress);
    progress.bar.finish_and_clear();
    if progress.interruption.asked() {
        return Ok(print::interrupted());
    }
    let validated = validation.validated();
    let scores = Scores::of(&validated);
    let page = ValidationPage::of(&validation, &validated, &scores);
    let mut files = BTreeMap::from([
        ("validation.csv".to_owned(), validation_table(&validated)),
        ("validation.html".to_owned(), page.page().html()),
    ]);
    files.extend(page.plots().into_iter().map(|(name, svg)| (format!("plots/{name}"), svg)));
    entered.write(&files).map_err(RunError::from)?;
    print::stdout(&scores.text(&validated))?;
    print::stdout(&format!("results in {}\n", out.display()))?;
    Ok(Exit::Done)
}

/// The files of the command.
static VALIDATION: ResultKind = ResultKind {
    files: &["validation.csv", "validation.html"],
    folders: &[("plots", is_validation_plot)],
    run: WithRun::No,
};

/// Counts finished runs on standard error.
struct ValidationProgress {
    interruption: Interruption,
    bar: ProgressBar,
}

impl ValidationProgress {
    fn bar(verbosity: Verbosity, runs: usize) -> ProgressBar {
        if verbosity == Verbosity::Quiet {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(runs as u64);
        // A template that does not parse leaves the plain bar.
        if let Ok(style) =
            ProgressStyle::with_template("[{bar:28}] {pos}/{len} runs  {elapsed} elapsed, {eta} left")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        bar
    }
}

impl RunObserver for ValidationProgress {
    fn finished(&self, _: &StepRecord) {}

    fn close(&self) {
        self.bar.inc(1);
    }

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

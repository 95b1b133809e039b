//! `railcrack validate`: the model against measured numbers.

mod page;
mod table;

use crate::commands::run::listen;
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::interruption::Interruption;
use crate::print;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use railcrack::growth::StepRecord;
use railcrack_report::put;
use railcrack_run::simulation::{RunError, RunObserver};
use railcrack_run::validation::{GradeScore, Validated, Validation, ValidationError, grade_scores};
use std::path::{Path, PathBuf};

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
    /// Suppress progress output
    #[arg(long)]
    quiet: bool,
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
    let out = arguments.out.clone().or_else(|| arguments.dir.clone());
    let out = out.unwrap_or_else(|| PathBuf::from("validation"));
    let told = Told {
        interruption: listen()?,
        bar: Told::bar(
            if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress },
            validation.runs(),
        ),
    };
    validation.compute(&told);
    told.bar.finish_and_clear();
    if told.interruption.asked() {
        print::stdout("interrupted: nothing was written\n")?;
        return Ok(Exit::Interrupted);
    }
    let validated = validation.validated();
    let scored: Vec<_> = validated
        .iter()
        .filter(|one| one.entry.is_scored())
        .filter_map(|one| Some((one.entry.grade, one.score?)))
        .collect();
    let grades = grade_scores(&scored);
    let plots = out.join("plots");
    std::fs::create_dir_all(&plots).map_err(|source| Failure::CannotWrite { path: plots.clone(), source })?;
    let page = page::Drawn::of(&validation, &validated, &grades);
    write(&out.join("validation.csv"), &table::csv(&validated))?;
    for (name, svg) in page.plots() {
        write(&plots.join(name), &svg)?;
    }
    write(&out.join("validation.html"), &page.page().html())?;
    print::stdout(&told_by_grade(&grades, &validated))?;
    print::stdout(&format!("results in {}\n", out.display()))?;
    Ok(Exit::Done)
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(put(path, text).map_err(RunError::from)?)
}

fn told_by_grade(grades: &[GradeScore], validated: &[Validated]) -> String {
    let mut text = String::new();
    for of in grades {
        text.push_str(&format!(
            "{}: {} entries, {} within 95 %, {} within a factor of 2, {} of 5; predicted over measured {:.2} in the mean, CRPS of ln {:.2}\n",
            of.grade.word(),
            of.entries,
            of.inside,
            of.within_2,
            of.within_5,
            of.factor,
            of.crps
        ));
    }
    let scored = validated.iter().filter(|one| one.entry.is_scored() && one.score.is_some()).count();
    let remembered = validated.iter().filter(|one| one.entry.certainty == 1).count();
    text.push_str(&format!(
        "{} entries, {scored} scored; {remembered} from memory, never scored\n",
        validated.len()
    ));
    text
}

/// Counts finished runs on standard error.
struct Told {
    interruption: Interruption,
    bar: ProgressBar,
}

impl Told {
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

impl RunObserver for Told {
    fn finished(&self, _: &StepRecord) {}

    fn close(&self) {
        self.bar.inc(1);
    }

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

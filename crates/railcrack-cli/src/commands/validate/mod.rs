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
use railcrack_case::{Grade, Quantity};
use railcrack_report::put;
use railcrack_run::simulation::{RunError, RunObserver};
use railcrack_run::validation::{
    GradeScore, Residuals, Score, Space, Validated, Validation, ValidationError, grade_scores,
};
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
    /// Leave out the predictions in space, which take most of the time
    #[arg(long)]
    no_space: bool,
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
    if arguments.no_space {
        validation = validation.with(Space::LeftOut);
    }
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
    let scores = Scores::of(&validated);
    let plots = out.join("plots");
    std::fs::create_dir_all(&plots).map_err(|source| Failure::CannotWrite { path: plots.clone(), source })?;
    let page = page::Drawn::of(&validation, &validated, &scores);
    write(&out.join("validation.csv"), &table::csv(&validated))?;
    for (name, svg) in page.plots() {
        write(&plots.join(name), &svg)?;
    }
    write(&out.join("validation.html"), &page.page().html())?;
    print::stdout(&told_by_grade(&scores, &validated))?;
    print::stdout(&format!("results in {}\n", out.display()))?;
    Ok(Exit::Done)
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(put(path, text).map_err(RunError::from)?)
}

/// The scores by grade and geometry, and what they say of the coefficient.
struct Scores {
    /// In the plane, or of a law.
    plane: Vec<GradeScore>,
    /// In space.
    space: Vec<GradeScore>,
    /// The prior of ln C by the residuals of growth in depth of rails in service, with the name of
    /// the geometry.
    residuals: Vec<(&'static str, Residuals)>,
}

impl Scores {
    fn of(validated: &[Validated]) -> Self {
        let scored = || validated.iter().filter(|one| one.entry.is_scored());
        let by_grade = |of: &dyn Fn(&Validated) -> Option<Score>| {
            let all: Vec<_> = scored().filter_map(|one| Some((one.entry.grade, of(one)?))).collect();
            grade_scores(&all)
        };
        let residuals = |of: &dyn Fn(&Validated) -> Option<Score>| {
            let of_track = scored().filter(|one| one.entry.grade == Grade::Track).filter_map(|one| {
                let comparison = one.entry.comparison.as_ref()?;
                let is_rate = matches!(comparison.quantity, Quantity::DepthRate { .. });
                is_rate.then_some((of(one)?, comparison.place_log_std?))
            });
            Residuals::of(&of_track.collect::<Vec<_>>())
        };
        let both = [("plane", residuals(&|one| one.score)), ("space", residuals(&|one| one.in_space))];
        Self {
            plane: by_grade(&|one| one.score),
            space: by_grade(&|one| one.in_space),
            residuals: both.into_iter().filter_map(|(name, of)| Some((name, of?))).collect(),
        }
    }

    /// Each with the words that name it: `track`, `track, in space`.
    fn all(&self) -> impl Iterator<Item = (String, &GradeScore)> {
        let plane = self.plane.iter().map(|of| (of.grade.word().to_owned(), of));
        plane.chain(self.space.iter().map(|of| (format!("{}, in space", of.grade.word()), of)))
    }
}

fn told_by_grade(scores: &Scores, validated: &[Validated]) -> String {
    let mut text = String::new();
    for (name, of) in scores.all() {
        text.push_str(&format!(
            "{}: {}, {} within 95 %, {} within a factor of 2, {} of 5; predicted over measured {:.2} in the mean, CRPS of ln {:.2}\n",
            name,
            entries(of.entries),
            of.inside,
            of.within_2,
            of.within_5,
            of.factor,
            of.crps
        ));
    }
    for (name, of) in &scores.residuals {
        text.push_str(&format!(
            "prior of ln C by the residuals of {} entries of track in {}: mean {:.2}, sd {:.2}\n",
            of.entries,
            if *name == "plane" { "the plane" } else { "space" },
            of.mean,
            of.log_std
        ));
    }
    let scored = validated.iter().filter(|one| one.entry.is_scored() && one.score.is_some()).count();
    let remembered = validated.iter().filter(|one| one.entry.certainty == 1).count();
    let is_missing =
        |one: &&Validated| one.entry.is_scored() && one.entry.comparison.is_some() && one.score.is_none();
    for one in validated.iter().filter(is_missing) {
        text.push_str(&format!(
            "{}: not compared, since no sample of its conditions reaches what was measured\n",
            one.entry.id
        ));
    }
    text.push_str(&format!(
        "{}, {scored} scored; {remembered} from memory, never scored\n",
        entries(validated.len())
    ));
    text
}

fn entries(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
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

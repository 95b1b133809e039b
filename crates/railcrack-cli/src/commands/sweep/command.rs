//! The command: what is computed, by how many threads, and how it ends.

use super::progress::StudyProgress;
use super::shard::Shard;
use super::tell::{result_json, result_text, tell_failed};
use crate::commands::run::listen;
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::{self, Set, default_folder};
use crate::json::Json;
use clap::Args;
use railcrack_case::{Overrides, SampleTable, Study};
use railcrack_report::Pages;
use railcrack_run::StudyFolder;
use railcrack_run::machine::{Budget, Needs, OverBudget};
use railcrack_run::simulation::{Ending, FailedRun, RunError, StudyComputation, case_files, study_plan};
use railcrack_run::study::Entry;
use railcrack_run::summary::RunEnd;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Compute the runs of a study: a case file with lists in place of values
///
/// Every run has a run folder of its own; summary.csv has a row per run, plots/ and report.html
/// show all runs together. Runs are computed on all cores; a run that fails is reported, and the
/// others go on. An interrupted study keeps what was computed.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// The study file; `-` is standard input
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// The folder of the study [default: the study's name beside it]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Compute runs I, I + N, I + 2 N, … only; other processes compute the others, into the same
    /// folder or others
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// A table of samples: a column for each key that varies (contact.friction,
    /// crack[1].angle_deg), a row for each run; the file is then a case or a study
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Engine in place of the study's: xfem or dislocation
    #[arg(long, value_name = "ENGINE")]
    engine: Option<String>,
    /// Contact solver in place of the study's: latin or newton
    #[arg(long, value_name = "SOLVER")]
    contact: Option<String>,
    /// Number of increments of every run, in place of the study's
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
    #[command(flatten)]
    set: Set,
    /// Number of threads [default: all]; results are the same with any
    #[arg(long, value_name = "N", value_parser = crate::commands::run::threads)]
    threads: Option<NonZeroUsize>,
    /// Say nothing while computing
    #[arg(long)]
    quiet: bool,
    /// Compute what is missing of the study in the folder, and gather its results anew
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Replace the study in the folder; with --shard, this part of it
    #[arg(long)]
    force: bool,
    /// Compute what needs more memory or disk than there is
    #[arg(long)]
    no_limits: bool,
    #[command(flatten)]
    json: Json,
}

impl SweepArguments {
    fn entry(&self) -> Entry {
        match (self.shard.is_some(), self.resume, self.force) {
            (false, true, _) => Entry::Resume,
            (true, true, _) => Entry::ResumePart,
            (false, _, true) => Entry::Replace,
            (true, _, true) => Entry::ReplacePart,
            (false, ..) => Entry::Begin,
            (true, ..) => Entry::Join,
        }
    }

    /// The options that change what is computed.
    fn options(&self) -> Vec<String> {
        let steps = self.steps.map(|steps| format!("--steps {steps}"));
        let engine = self.engine.as_ref().map(|engine| format!("--engine {engine}"));
        let contact = self.contact.as_ref().map(|contact| format!("--contact {contact}"));
        let settings = self.set.set.iter().map(|given| format!("--set {given}"));
        [steps, engine, contact].into_iter().flatten().chain(settings).collect()
    }
}

/// Computes the study, or a part of it, and gathers the results.
pub fn sweep(arguments: &SweepArguments) -> Result<Exit, Failure> {
    arguments.json.told(|| compute(arguments))
}

fn compute(arguments: &SweepArguments) -> Result<Exit, Failure> {
    let overrides = Overrides {
        steps: arguments.steps,
        engine: arguments.engine.clone(),
        contact: arguments.contact.clone(),
        settings: arguments.set.set.clone(),
        ..Overrides::default()
    };
    let samples = arguments.table.as_deref().map(SampleTable::read).transpose()?;
    let study = input::study(&arguments.study, &overrides, samples.as_ref())?;
    let interruption = listen()?;
    let own: Vec<usize> = study
        .runs
        .iter()
        .map(|run| run.number)
        .filter(|&number| arguments.shard.is_none_or(|shard| shard.has(number)))
        .collect();
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study));
    let threads = threads(arguments.threads);
    if !arguments.no_limits {
        within_budget(&study, &own, threads, &Budget::of(&path))?;
    }
    let cases: Vec<_> = study.runs.iter().map(|run| case_files(&run.case)).collect();
    let plan = study_plan(&study, arguments.options());
    let folder = StudyFolder::enter(&path, plan, &study.text, arguments.entry(), &own, &cases)
        .map_err(RunError::from)?;
    drop(cases);

    let (waiting, mut failed) = folder.left_to_do(&study, &own).map_err(RunError::from)?;
    let steps = waiting.iter().map(|&run| study.runs[run].case.growth.steps + 1).sum();
    let verbosity = if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
    let progress = StudyProgress::new(verbosity, waiting.len(), steps, &interruption);
    let computation =
        StudyComputation { study: &study, folder: &folder, observer: &progress, presentation: &Pages };
    let computed = computation.compute(&waiting, threads)?;
    progress.close();
    interruption.acknowledge();

    let results = folder.write_results(&Pages).map_err(RunError::from)?;
    for (number, reason) in results.damaged() {
        if failed.iter().chain(&computed).all(|run| run.number != number) {
            let label = study.runs[number - 1].label.clone();
            failed.push(FailedRun {
                number,
                label,
                end: RunEnd::CannotReadOrWrite,
                reason: reason.to_owned(),
            });
        }
    }
    // The others have been told as they failed.
    tell_failed(&failed);
    if arguments.quiet {
        tell_failed(&computed);
    }
    failed.extend(computed);
    failed.sort_by_key(|run| run.number);
    let ending = if interruption.asked() { Ending::Interrupted } else { Ending::Ended };
    let exit = exit(&failed, ending);
    arguments.json.print(
        || result_text(&folder, &results, &failed, ending),
        || result_json(&folder, &results, &failed, exit),
    )?;
    Ok(exit)
}

/// Whether the runs `own` fit, the largest ones side by side.
fn within_budget(study: &Study, own: &[usize], threads: usize, budget: &Budget) -> Result<(), OverBudget> {
    let needs = study.runs.iter().filter(|run| own.contains(&run.number)).map(|run| Needs::of(&run.case));
    let largest = needs.reduce(|a, b| Needs { memory: a.memory.max(b.memory), disk: a.disk.max(b.disk) });
    largest.map_or(Ok(()), |needs| budget.allows(needs, own.len(), threads.min(own.len())))
}

fn exit(failed: &[FailedRun], ending: Ending) -> Exit {
    let has = |end| failed.iter().any(|run| run.end == end);
    match ending {
        Ending::Interrupted => Exit::Interrupted,
        Ending::Ended if has(RunEnd::NotConverged) => Exit::NotConverged,
        Ending::Ended if has(RunEnd::CannotReadOrWrite) => Exit::CannotReadOrWrite,
        Ending::Ended => Exit::Done,
    }
}

fn threads(asked: Option<NonZeroUsize>) -> usize {
    asked.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get)
}

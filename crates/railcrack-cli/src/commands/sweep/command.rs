//! Arguments and execution of `railcrack sweep`.

use super::messages::{print_damages, print_failed, print_flaws, result_json, result_text};
use super::progress::StudyProgress;
use super::shard::Shard;
use crate::commands::run::{listen, thread_count};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::{self, Inputs, Set, default_folder};
use crate::interruption::{Interruption, Remains};
use crate::json::Json;
use clap::Args;
use railcrack_case::{ByGeometry, Case, Overrides, SampleTable, Study};
use railcrack_report::Pages;
use railcrack_run::StudyFolder;
use railcrack_run::machine::{Budget, Needs, OverBudget};
use railcrack_run::setup::RunSize;
use railcrack_run::simulation::{Ending, FailedRun, RunError, StudyComputation, case_files, study_plan};
use railcrack_run::study::{Entry, ExistingRuns};
use railcrack_run::summary::RunEnd;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Compute the runs of a study, which is a case file with lists of values
///
/// Every run has its own run folder; summary.csv has one row per run, plots/ and report.html show
/// all runs together. Runs are computed on all cores; a failed run is reported and the others
/// continue. An interrupted study keeps its finished results.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// Study file; `-` is standard input
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// Folder of the study [default: name of the study file without its extension, next to it]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Compute only runs I, I + N, I + 2 N, …; other processes compute the others, in the same
    /// folder or in other folders
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Table of samples with one column for each key that varies (contact.friction,
    /// crack[1].angle_deg) and one row for each run; STUDY can then be a case file
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Engine, overriding the study: xfem, dislocation or space
    #[arg(long, value_name = "ENGINE")]
    engine: Option<String>,
    /// Contact solver, overriding the study: latin or newton
    #[arg(long, value_name = "SOLVER")]
    contact: Option<String>,
    /// Number of increments of every run, overriding the study
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
    #[command(flatten)]
    set: Set,
    /// Number of threads [default: all]; it does not affect the results
    #[arg(long, value_name = "N", value_parser = crate::commands::run::threads)]
    threads: Option<NonZeroUsize>,
    /// Suppress progress output
    #[arg(long)]
    quiet: bool,
    /// Compute the missing runs of the study in the folder and collect its results again
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Replace an existing study in the folder; with --shard, only this part of it
    #[arg(long)]
    force: bool,
    /// Run even if the estimate exceeds the available memory or disk space
    #[arg(long)]
    no_limits: bool,
    #[command(flatten)]
    json: Json,
}

impl SweepArguments {
    /// The entry of a process that computes the runs `own`.
    fn entry(&self, own: &[usize]) -> Entry {
        let existing = match (self.resume, self.force) {
            (true, _) => ExistingRuns::Resume,
            (false, true) => ExistingRuns::Replace,
            (false, false) => ExistingRuns::Refuse,
        };
        Entry { part: self.shard.map(|_| own.iter().copied().collect()), existing }
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

/// Computes the study or a part of it, and collects the results.
pub fn sweep(arguments: &SweepArguments) -> Result<Exit, Failure> {
    arguments.json.with_failures(|| compute(arguments))
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
    let interruption = listen(Remains::FinishedSteps)?;
    let own: Vec<usize> = study
        .runs
        .iter()
        .map(|run| run.number)
        .filter(|&number| arguments.shard.is_none_or(|shard| shard.has(number)))
        .collect();
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study));
    let mut inputs = Inputs::of_study(&arguments.study, &study);
    inputs = inputs.with_all(arguments.table.clone());
    inputs.stay(&path, StudyFolder::owns)?;
    let threads = thread_count(arguments.threads).map_err(Failure::Show)?;
    if !arguments.no_limits {
        within_budget(&study, &own, threads, &Budget::of(&path))?;
    }
    let cases: Vec<_> = study.runs.iter().map(|run| case_files(&run.case)).collect();
    let plan = study_plan(&study, arguments.options());
    let folder = StudyFolder::enter(&path, plan, &study.text, &arguments.entry(&own), &cases)
        .map_err(RunError::from)?;
    drop(cases);
    print_damages(folder.damages());

    let (waiting, failed) = folder.left_to_do(&study, &own).map_err(RunError::from)?;
    let steps = waiting.iter().map(|&run| study.runs[run].case.growth.expected_steps() + 1).sum();
    let verbosity = if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
    let progress = StudyProgress::new(verbosity, waiting.len(), steps, &interruption);
    let computation =
        StudyComputation { study: &study, folder: &folder, observer: &progress, presentation: &Pages };
    let computed = computation.compute(&waiting, threads)?;
    progress.close();
    interruption.acknowledge();

    collect(arguments, &study, &folder, failed, computed, &interruption)
}

/// Collects the results of all runs: those that `failed` before and those that failed as they were
/// `computed`.
fn collect(
    arguments: &SweepArguments,
    study: &Study,
    folder: &StudyFolder,
    mut failed: Vec<FailedRun>,
    computed: Vec<FailedRun>,
    interruption: &Interruption,
) -> Result<Exit, Failure> {
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
    // The other failures have been reported when they occurred.
    print_failed(&failed);
    if arguments.quiet {
        print_failed(&computed);
    }
    print_flaws(&results.flaws);
    failed.extend(computed);
    failed.sort_by_key(|run| run.number);
    let ending = if interruption.asked() { Ending::Interrupted } else { Ending::Ended };
    let exit = match exit(&failed, ending) {
        Exit::Done if !results.flaws.is_empty() => Exit::CannotReadOrWrite,
        exit => exit,
    };
    arguments.json.print(
        || result_text(folder, &results, &failed, ending),
        || result_json(folder, &results, &failed, exit),
    )?;
    Ok(exit)
}

/// Checks that the runs `own` fit into the machine with the largest ones running at the same time.
fn within_budget(study: &Study, own: &[usize], threads: usize, budget: &Budget) -> Result<(), OverBudget> {
    let sizes = ByGeometry::default();
    let own_runs = study.runs.iter().filter(|run| own.contains(&run.number));
    let size = |case: &Case| sizes.value(case, || RunSize::estimate(case));
    let needs = own_runs.map(|run| Needs::with(&run.case, &size(&run.case)));
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

//! The command: what is computed, by how many threads, and how it ends.

use super::job::{FailedRun, Workplace};
use super::progress::StudyProgress;
use super::shard::Shard;
use super::tell::result_text;
use crate::commands::run::{case_files, default_folder, listen};
use crate::display::Verbosity;
use crate::drive::{Ending, RunError};
use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack::case::{Axis, Overrides, RunQueue, Study, WaitingRun};
use railcrack::output::{Entry, PlannedRun, RunEnd, StudyAxis, StudyFolder, StudyKey, StudyPlan, VERSION};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Compute the runs of a study: a case file with lists in place of values
///
/// Every run has a run folder of its own; summary.csv has a row per run, plots/ and report.html show all runs together. Runs are computed on all
/// cores; a run that fails is reported, and the others go on. An interrupted study keeps what was computed.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// The study file
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// The folder of the study [default: the study's name beside it]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Compute runs I, I + N, I + 2 N, … only; other processes compute the others, into the same folder or others
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// What computes the cracked rail, in place of the study's: xfem or dislocation
    #[arg(long, value_name = "ENGINE")]
    engine: Option<String>,
    /// What solves the contact of the crack faces, in place of the study's: latin or newton
    #[arg(long, value_name = "SOLVER")]
    contact: Option<String>,
    /// Number of increments of every run, in place of the study's
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
    /// Number of threads [default: all]; results are the same with any
    #[arg(long, value_name = "N")]
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
        [steps, engine, contact].into_iter().flatten().collect()
    }
}

/// Computes the study, or a part of it, and gathers the results.
pub fn sweep(arguments: &SweepArguments) -> Result<Exit, Failure> {
    let overrides = Overrides {
        steps: arguments.steps,
        engine: arguments.engine.clone(),
        contact: arguments.contact.clone(),
    };
    let study = Study::read_with(&arguments.study, &overrides)?;
    let interruption = listen()?;
    let own: Vec<usize> = study
        .runs
        .iter()
        .map(|run| run.number)
        .filter(|&number| arguments.shard.is_none_or(|shard| shard.has(number)))
        .collect();
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study));
    let cases: Vec<_> = study.runs.iter().map(|run| case_files(&run.case)).collect();
    let plan = plan(&study, arguments.options());
    let folder = StudyFolder::enter(&path, plan, &study.text, arguments.entry(), &own, &cases)
        .map_err(RunError::from)?;
    drop(cases);

    let (waiting, mut failed) = left_to_do(&study, &folder, &own)?;
    let steps = waiting.iter().map(|&run| study.runs[run].case.growth.steps + 1).sum();
    let verbosity = if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
    let progress = StudyProgress::new(verbosity, waiting.len(), steps);
    let workplace = Workplace { folder: &folder, progress: &progress, interruption: &interruption };
    failed.extend(compute(&study, &waiting, &workplace, threads(arguments.threads))?);
    progress.close();
    failed.sort_by_key(|run| run.number);

    let results = folder.write_results().map_err(RunError::from)?;
    let ending = if interruption.asked() { Ending::Interrupted } else { Ending::Ended };
    print::stdout(&result_text(&folder, &results, &failed, ending))?;
    Ok(exit(&failed, ending))
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

/// The runs `own` (numbers) that are still to be computed (indices), and those that cannot be.
fn left_to_do(
    study: &Study,
    folder: &StudyFolder,
    own: &[usize],
) -> Result<(Vec<usize>, Vec<FailedRun>), RunError> {
    let (mut waiting, mut failed) = (Vec::new(), Vec::new());
    for (i, (run, planned)) in study.runs.iter().zip(&folder.plan().runs).enumerate() {
        if !own.contains(&run.number) {
            continue;
        }
        match folder.outcome(planned)? {
            Some(outcome) if outcome.is_settled() => {
                if let Some(reason) = outcome.reason {
                    let (number, label) = (run.number, run.label.clone());
                    failed.push(FailedRun { number, label, end: outcome.end, reason });
                }
            }
            _ => waiting.push(i),
        }
    }
    Ok((waiting, failed))
}

fn threads(asked: Option<NonZeroUsize>) -> usize {
    asked.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get)
}

/// Computes the runs `waiting` on `threads` threads: one run each, and where there are fewer runs than threads, several threads for
/// each. Those that failed.
fn compute(
    study: &Study,
    waiting: &[usize],
    workplace: &Workplace,
    threads: usize,
) -> Result<Vec<FailedRun>, RunError> {
    let of_run = |&run: &usize| {
        let case = &study.runs[run].case;
        WaitingRun { run, case, effort: (case.growth.steps + 1) as f64 }
    };
    let queue = RunQueue::new(waiting.iter().map(of_run));
    let failed = Mutex::new(Vec::new());
    let at_once = threads.min(waiting.len());
    let pools: Result<Vec<_>, _> = (0..at_once)
        .map(|i| {
            // The first runs have the threads that are left over.
            let own = threads / at_once + usize::from(i < threads % at_once);
            rayon::ThreadPoolBuilder::new().num_threads(own).build()
        })
        .collect();
    let pools = pools.map_err(|reason| RunError::System {
        action: format!("start {threads} threads"),
        reason: reason.to_string(),
    })?;
    std::thread::scope(|scope| {
        for pool in &pools {
            let (queue, failed) = (&queue, &failed);
            scope.spawn(move || {
                pool.install(|| {
                    let mut last = None;
                    while !workplace.interruption.asked()
                        && let Some(next) = queue.take(last.as_ref())
                    {
                        let planned = &workplace.folder.plan().runs[next.run];
                        let end = workplace.compute(&study.runs[next.run], planned, &next);
                        failed.lock().unwrap_or_else(PoisonError::into_inner).extend(end);
                        last = Some(next);
                    }
                });
            });
        }
    });
    Ok(failed.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// The study as its folder remembers it.
fn plan(study: &Study, options: Vec<String>) -> StudyPlan {
    let axis = |axis: &Axis| {
        let key = |variation: &railcrack::case::Variation| StudyKey {
            key: variation.key.clone(),
            name: variation.name.clone(),
            values: (0..axis.len()).map(|i| variation.shown(i)).collect(),
        };
        StudyAxis { keys: axis.variations.iter().map(key).collect() }
    };
    let run = |run: &railcrack::case::StudyRun| PlannedRun {
        number: run.number,
        folder: run.folder.clone(),
        choice: run.choice.clone(),
    };
    StudyPlan {
        version: VERSION.to_owned(),
        title: study.title.clone(),
        combine: study.combine.name().to_owned(),
        axes: study.axes.iter().map(axis).collect(),
        colour_axis: study.colour_axis,
        options,
        runs: study.runs.iter().map(run).collect(),
    }
}

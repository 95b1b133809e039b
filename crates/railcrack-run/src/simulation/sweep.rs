//! Parallel computation of the runs of a study.

use super::drive::Ending;
use super::error::RunError;
use super::observer::StudyObserver;
use super::queue::{NextRun, RunQueue, WaitingRun};
use super::run::{RunEntry, Simulation};
use crate::disk::VERSION;
use crate::error::OutputError;
use crate::presentation::Presentation;
use crate::run_folder::check_numbers;
use crate::study::{Between, PlannedRun, PopulationPlan, StudyAxis, StudyFolder, StudyKey, StudyPlan};
use crate::summary::{Outcome, RunEnd, Summary};
use railcrack::growth::RunStop;
use railcrack::shakedown::ShakedownError;
use railcrack::words::Choice;
use railcrack_case::{Axis, Keeping, Study, StudyRun, Variation};
use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

/// Runs of a study that are to be computed, and where.
pub struct StudyComputation<'a> {
    /// The study.
    pub study: &'a Study,
    /// Its folder.
    pub folder: &'a StudyFolder,
    /// Observer of the study.
    pub observer: &'a dyn StudyObserver,
    /// Maker of plots and pages.
    pub presentation: &'a dyn Presentation,
}

/// A run that failed.
#[derive(Debug)]
pub struct FailedRun {
    /// Its number, from 1.
    pub number: usize,
    /// Its values.
    pub label: String,
    /// How it ended.
    pub end: RunEnd,
    /// Why, a sentence.
    pub reason: String,
}

impl StudyComputation<'_> {
    /// Computes the runs `waiting` (indices) on `threads` threads: one run each, and where there
    /// are fewer runs than threads, several threads for each. Those that failed.
    ///
    /// Errors: the system refuses threads.
    pub fn compute(&self, waiting: &[usize], threads: usize) -> Result<Vec<FailedRun>, RunError> {
        let of_run = |&run: &usize| {
            let case = &self.study.runs[run].case;
            WaitingRun { run, case, effort: (case.growth.expected_steps() + 1) as f64 }
        };
        let queue = RunQueue::new(waiting.iter().map(of_run));
        let failed = Mutex::new(Vec::new());
        let at_once = threads.min(waiting.len());
        let pools: Result<Vec<_>, _> = (0..at_once)
            .map(|i| {
                // The first runs use the remaining threads.
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
                        while !self.observer.interrupted()
                            && let Some(next) = queue.take(last.as_ref())
                        {
                            let end = self.compute_run(&next);
                            failed.lock().unwrap_or_else(PoisonError::into_inner).extend(end);
                            last = Some(next);
                        }
                    });
                });
            }
        });
        Ok(failed.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Computes a run, or the missing part of it, into its run folder, and records there how it
    /// ended. An interrupted run has not ended.
    fn compute_run(&self, next: &NextRun) -> Option<FailedRun> {
        let (run, planned) = (&self.study.runs[next.run], &self.folder.plan().runs[next.run]);
        let computed = self.steps(run, planned, next);
        let (outcome, told) = match &computed {
            Ok((Ending::Interrupted, _)) => return None,
            Err(error @ RunError::Output(OutputError::InUse { .. })) => {
                self.observer.left(planned, &format!("run {} ({}): {error}", run.number, run.label));
                return None;
            }
            Ok((Ending::Ended, summary)) => (Outcome::done(), done(summary)),
            Err(error) => (Outcome::failed(end_of(error), &error.to_string()), format!("failed: {error}")),
        };
        let settled = self.folder.settle(planned, &outcome).map_err(RunError::from);
        self.observer.over(planned, &format!("run {} ({}): {told}", run.number, run.label));
        let error = computed.err().or(settled.err())?;
        Some(FailedRun::of(run, end_of(&error), error.to_string()))
    }

    fn steps(
        &self,
        run: &StudyRun,
        planned: &PlannedRun,
        next: &NextRun,
    ) -> Result<(Ending, Summary), RunError> {
        self.folder.reopen(planned)?;
        let observer = self.observer.of_run(run.case.growth.expected_steps() + 1);
        let simulation = Simulation::new(&run.case)
            .observed_by(observer.as_ref())
            .presented_by(self.presentation)
            .sharing(next.shared_rail(&run.case))
            .of_a_study();
        let simulation = match &self.folder.plan().population {
            Some(plan) if plan.between == Between::Paths => simulation.sampled_by_its_study(),
            _ => simulation,
        };
        let finished = simulation.run_in(&self.folder.own_run_folder(planned)?, RunEntry::ResumeOrBegin)?;
        Ok((finished.ending, finished.summary))
    }
}

impl StudyFolder {
    /// The runs of `study` with the numbers `own` that are still to be computed (indices), and
    /// those that failed before for good.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn left_to_do(
        &self,
        study: &Study,
        own: &[usize],
    ) -> Result<(Vec<usize>, Vec<FailedRun>), OutputError> {
        let (mut waiting, mut failed) = (Vec::new(), Vec::new());
        let own: HashSet<usize> = own.iter().copied().collect();
        let packed = self.packed()?;
        for (i, (run, planned)) in study.runs.iter().zip(&self.plan().runs).enumerate() {
            if !own.contains(&run.number) {
                continue;
            }
            if packed.has(run.number) {
                self.clear_packed(planned)?;
                continue;
            }
            match self.outcome(planned)? {
                Some(outcome) if outcome.is_settled() => {
                    if let Err(error @ OutputError::Damaged { .. }) = check_numbers(&self.run_folder(planned))
                    {
                        failed.push(FailedRun::of(run, RunEnd::CannotReadOrWrite, error.to_string()));
                    } else if let Some(reason) = outcome.reason {
                        failed.push(FailedRun::of(run, outcome.end, reason));
                    } else {
                        self.tidy(planned)?;
                    }
                }
                _ => waiting.push(i),
            }
        }
        Ok((waiting, failed))
    }
}

impl FailedRun {
    fn of(run: &StudyRun, end: RunEnd, reason: String) -> Self {
        Self { number: run.number, label: run.label.clone(), end, reason }
    }
}

fn end_of(error: &RunError) -> RunEnd {
    let no_solution = match error {
        RunError::Output(OutputError::NotFinite { .. } | OutputError::Field(_))
        | RunError::Growth(_)
        | RunError::NoLayers
        | RunError::Shakedown(ShakedownError::NotConverged { .. }) => true,
        RunError::Residual(error) => !matches!(error, crate::setup::CarriedStressError::Field(_)),
        _ => false,
    };
    if no_solution { RunEnd::NotConverged } else { RunEnd::CannotReadOrWrite }
}

fn done(summary: &Summary) -> String {
    let stop = summary.stop.map_or("ended", RunStop::word);
    format!("{stop} at step {}, {:.1} s", summary.steps, summary.wall_s)
}

/// The study as recorded in its folder; `options` are those of the command line that change what
/// is computed.
pub fn study_plan(study: &Study, options: Vec<String>) -> StudyPlan {
    let axis = |axis: &Axis| {
        let key = |variation: &Variation| StudyKey {
            key: variation.key.clone(),
            name: variation.name.clone(),
            values: (0..axis.len()).map(|i| variation.shown(i)).collect(),
            distribution: variation.distribution.as_ref().map(ToString::to_string),
        };
        StudyAxis { keys: axis.variations.iter().map(key).collect() }
    };
    let run = |run: &StudyRun| PlannedRun {
        number: run.number,
        folder: run.folder.clone(),
        choice: run.choice.clone(),
        // Of the files of the case, with which the folder is entered.
        case: None,
    };
    StudyPlan {
        version: VERSION.to_owned(),
        title: study.title.clone(),
        combine: study.combine.word().to_owned(),
        axes: study.axes.iter().map(axis).collect(),
        colour_axis: study.colour_axis,
        run_folders: study.keeping == Keeping::Folders,
        // Of the text with which the folder is entered.
        text: None,
        options,
        population: PopulationPlan::of(study),
        runs: study.runs.iter().map(run).collect(),
    }
}

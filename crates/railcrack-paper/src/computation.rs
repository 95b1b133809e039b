//! Computation of the runs in parallel, or reuse of finished runs.

use crate::case_run::{CaseRun, Effort};
use crate::error::PaperError;
use crate::plan::Job;
use crate::stored::{store, stored};
use crate::telling::{Earlier, Telling};
use railcrack::growth::Observer;
use railcrack_case::Case;
use railcrack_run::simulation::{NextRun, RunQueue, WaitingRun};
use std::path::Path;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// All runs.
pub(super) struct Computation<'a> {
    /// Where they are kept.
    pub folder: &'a Path,
    pub earlier: Earlier,
    pub jobs: &'a [Job],
    /// The case of each.
    pub cases: &'a [Case],
    pub telling: &'a dyn Telling,
}

impl Computation<'_> {
    /// Computes all runs, one thread each because runs are independent, on shared rails.
    ///
    /// Errors: the system refuses threads.
    pub(super) fn run(&self) -> Result<Vec<Result<CaseRun, PaperError>>, PaperError> {
        let slots: Vec<OnceLock<Result<CaseRun, PaperError>>> =
            self.jobs.iter().map(|_| OnceLock::new()).collect();
        let mut waiting: Vec<usize> = Vec::new();
        for (i, (job, case)) in self.jobs.iter().zip(self.cases).enumerate() {
            let taken =
                if self.earlier == Earlier::TakeOver { stored(self.folder, &job.name, case) } else { None };
            match taken {
                Some(run) => {
                    self.telling.finished(&job.name, 0.0);
                    let _ = slots[i].set(Ok(run));
                }
                None => waiting.push(i),
            }
        }
        let of_job = |run| WaitingRun { run, case: &self.cases[run], effort: self.jobs[run].effort };
        let queue = RunQueue::new(waiting.into_iter().map(of_job));
        // A pool for each run: in a common pool a thread that waits for parts of its run could
        // start another run and wait there for the rail that it is about to make.
        let pools = (0..rayon::current_num_threads())
            .map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build())
            .collect::<Result<Vec<_>, _>>()?;
        std::thread::scope(|scope| {
            for pool in &pools {
                scope.spawn(|| {
                    pool.install(|| {
                        let mut last = None;
                        while let Some(next) = queue.take(last.as_ref()) {
                            let _ = slots[next.run].set(self.compute(&next));
                            last = Some(next);
                        }
                    });
                });
            }
        });
        Ok(slots.into_iter().map(|slot| slot.into_inner().unwrap_or(Err(PaperError::Interrupted))).collect())
    }

    fn compute(&self, next: &NextRun) -> Result<CaseRun, PaperError> {
        if self.telling.interrupted() {
            return Err(PaperError::Interrupted);
        }
        let (job, case) = (&self.jobs[next.run], &self.cases[next.run]);
        let started = Instant::now();
        let mut run = CaseRun::compute(&job.name, case, next.shared_rail(case), &Silent(self.telling))?;
        run.effort.wall_s = started.elapsed().as_secs_f64();
        store(self.folder, &job.name, case, &run)?;
        self.telling.finished(&job.name, run.effort.wall_s);
        Ok(run)
    }
}

/// Forwards interruptions only; progress within a run is not shown.
struct Silent<'a>(&'a dyn Telling);

impl Observer for Silent<'_> {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

/// The columns of `runs.csv`.
pub const RUNS_COLUMNS: &str = "run,steps,contact_solutions,body_s,contact_s,wall_s,ended";

/// Effort of each run.
pub(super) fn runs_table(jobs: &[Job], runs: &[Arc<CaseRun>]) -> String {
    let mut text = format!("{RUNS_COLUMNS}\n");
    for (job, run) in jobs.iter().zip(runs) {
        let Effort { steps, solves, body_s, contact_s, wall_s } = run.effort;
        let ended = if run.failure.is_some() { "early" } else { "" };
        text.push_str(&format!(
            "{},{steps},{solves},{body_s:.3},{contact_s:.3},{wall_s:.3},{ended}\n",
            job.name
        ));
    }
    text
}

//! `railcrack run`.

use crate::commands::residual::{self, Residual};
use crate::display::Verbosity;
use crate::drive::{Ending, RunError, StepSource, drive};
use crate::exit::{Exit, Failure};
use crate::interruption::Interruption;
use crate::print;
use crate::progress::{Progress, Tell, cycles};
use clap::Args;
use railcrack::case::{Case, Overrides, SharedRail};
use railcrack::growth::GrowthState;
use railcrack::output::{CaseFiles, Existing, Recorder, RunInfo, Summary};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Compute the growth of the cracks of a case
///
/// Results go to the run folder as steps finish. An interrupted run keeps what was computed; --resume goes on with
/// it.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The case file
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// The run folder [default: the case's name beside it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// What computes the cracked rail, in place of the case's: xfem or dislocation
    #[arg(long, value_name = "ENGINE")]
    pub engine: Option<String>,
    /// What solves the contact of the crack faces, in place of the case's: latin or newton
    #[arg(long, value_name = "SOLVER")]
    pub contact: Option<String>,
    /// Number of increments, in place of the case's
    #[arg(long, value_name = "N")]
    pub steps: Option<u64>,
    /// Number of threads [default: all]; results are the same with any
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Say nothing while computing
    #[arg(long)]
    pub quiet: bool,
    /// Go on with the run in the folder after its last finished step
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Replace the run in the folder
    #[arg(long)]
    pub force: bool,
}

/// Runs the case and prints the result.
pub fn run(arguments: &RunArguments) -> Result<Exit, Failure> {
    use_threads(arguments.threads)?;
    let finished = compute(arguments, &listen()?)?;
    print::stdout(&result_text(&finished))?;
    Ok(match finished.ending {
        Ending::Ended => Exit::Done,
        Ending::Interrupted => Exit::Interrupted,
    })
}

/// Listens to the signals by which a user stops a run.
///
/// Errors: the system refuses.
pub fn listen() -> Result<Interruption, RunError> {
    Interruption::listen()
        .map_err(|reason| RunError::System { action: "listen to signals".into(), reason: reason.to_string() })
}

/// Runs the case until it ends or is interrupted.
///
/// Errors: the case is wrong; the run fails.
pub fn compute(arguments: &RunArguments, interruption: &Interruption) -> Result<Finished, Failure> {
    let overrides = Overrides {
        steps: arguments.steps,
        engine: arguments.engine.clone(),
        contact: arguments.contact.clone(),
    };
    let case = Case::read_with(&arguments.case, &overrides)?;
    let finished = execute(arguments, Job::of(&case), interruption, |stage| {
        let (prepared, residual) = residual::prepare(&case, &stage)?;
        Ok((prepared.growth(stage.state), residual))
    })?;
    Ok(finished)
}

/// What a run starts from.
pub struct Stage<'a> {
    /// The run folder.
    pub folder: &'a Path,
    /// What is told of the run.
    pub progress: &'a dyn Tell,
    /// What another run computed already.
    pub shared: Option<&'a SharedRail>,
    /// The state to go on from; none at the beginning.
    pub state: Option<GrowthState>,
}

/// What the case says of a run before anything is computed.
#[derive(Debug)]
pub struct Job {
    /// `case.toml` and the files that it names.
    pub case: CaseFiles,
    /// What the files say of the run.
    pub info: RunInfo,
    /// Number of increments.
    pub increments: usize,
}

impl Job {
    /// The run of `case`.
    pub fn of(case: &Case) -> Self {
        Self {
            case: case_files(case),
            info: RunInfo {
                title: case.title.clone(),
                engine: case.engine.name().into(),
                contact: case.contact_solver.name().into(),
                boundary: case.rail.boundary_name(),
                half_width: case.contact.half_width,
                axle_load: case.axle_load,
                warnings: Vec::new(),
            },
            increments: case.growth.steps,
        }
    }
}

/// A run that came to an end or was interrupted.
#[derive(Debug)]
pub struct Finished {
    /// How it ended.
    pub ending: Ending,
    /// The run in numbers.
    pub summary: Summary,
    /// The run folder.
    pub folder: PathBuf,
}

/// Runs `job`: checks and prepares the run folder, then has `start` build what computes the steps with the residual stress that the
/// rail carries, and writes step by step.
///
/// Errors: see [`RunError`].
pub fn execute<S: StepSource>(
    arguments: &RunArguments,
    job: Job,
    interruption: &Interruption,
    start: impl FnOnce(Stage) -> Result<(S, Option<Residual>), RunError>,
) -> Result<Finished, RunError> {
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    let opened = open(arguments, &folder, job.case, job.info)?;
    let verbosity = if arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
    let progress = |first| Progress::new(verbosity, job.increments, first);
    let (ending, summary) = carry_out(&folder, opened, progress, interruption, start)?;
    Ok(Finished { ending, summary, folder })
}

/// Goes on with a run in `folder`, which is `opened` (its recorder, and the state after its last finished step): tells `progress`, made for its
/// first step, has `start` build what computes the steps, and writes step by step.
///
/// Errors: see [`RunError`].
pub fn carry_out<S: StepSource, T: Tell>(
    folder: &Path,
    opened: (Recorder, Option<GrowthState>),
    progress: impl FnOnce(usize) -> T,
    interruption: &Interruption,
    start: impl FnOnce(Stage) -> Result<(S, Option<Residual>), RunError>,
) -> Result<(Ending, Summary), RunError> {
    let (mut recorder, state) = opened;
    let progress = progress(state.as_ref().map_or(0, |state| state.step));
    if state.as_ref().is_some_and(|state| state.ended.is_some()) {
        progress.close();
        return Ok((Ending::Ended, recorder.finish()?));
    }
    let (source, residual) = start(Stage { folder, progress: &progress, shared: None, state })?;
    if let Some(residual) = residual {
        residual.record(&mut recorder, &progress)?;
    }
    drive(source, &mut recorder, &progress, interruption)
}

/// Has all parallel parts use `threads` threads; all of the machine where none are given. The calling thread is one of them, so that what it computes between two
/// parallel parts stays in its caches and in its memory. A thread beside it, like the one that writes steps, must not have parallel parts: it might wait for a
/// caller that waits for it. Once per program, before any parallel part.
///
/// Errors: the system refuses.
pub fn use_threads(threads: Option<NonZeroUsize>) -> Result<(), RunError> {
    // None is the default of the pool: as many as the machine has.
    let count = threads.map_or(0, NonZeroUsize::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).use_current_thread();
    pool.build_global()
        .map_err(|reason| RunError::System { action: "start threads".to_owned(), reason: reason.to_string() })
}

/// `case.toml` and the files that it names.
pub fn case_files(case: &Case) -> CaseFiles {
    let companions = case.companions().into_iter().map(|file| (file.name.into(), file.text.into())).collect();
    CaseFiles { toml: case.to_toml(), companions }
}

/// The name of the case file without its ending, beside it.
pub fn default_folder(case: &Path) -> PathBuf {
    case.with_extension("")
}

fn open(
    arguments: &RunArguments,
    folder: &Path,
    case: CaseFiles,
    info: RunInfo,
) -> Result<(Recorder, Option<GrowthState>), RunError> {
    if arguments.resume {
        return Ok(Recorder::resume(folder, case, info)?);
    }
    if is_same_file(&arguments.case, &folder.join("case.toml")) {
        return Err(RunError::CaseInRunFolder { path: arguments.case.clone() });
    }
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    Ok((Recorder::start(folder, case, info, existing)?, None))
}

/// Whether both paths lead to one file.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => false,
    }
}

/// The result as a few lines for standard output.
pub fn result_text(finished: &Finished) -> String {
    let Finished { ending, summary, .. } = finished;
    if summary.steps_recorded == 0 {
        return format!("interrupted before the first step was finished\n{}", where_and_on(finished));
    }
    let how = match (ending, &summary.stop) {
        (Ending::Ended, Some(stop)) => format!("{stop} at"),
        (Ending::Ended, None) => "ended at".to_owned(),
        (Ending::Interrupted, _) => "interrupted after".to_owned(),
    };
    let mut text = format!("{how} step {}, {} load cycles", summary.steps, cycles(summary.load_cycles));
    if let Some(tonnes) = summary.million_gross_tonnes {
        text.push_str(&format!(", {tonnes:.3} million gross tonnes"));
    }
    text.push('\n');
    for tip in &summary.tips {
        let stop = tip.stop.as_ref().map_or_else(String::new, |stop| format!(", {stop}"));
        let waits = tip.waiting_mm > 0.0;
        let waiting = if waits { format!(", {:.3} mm waiting", tip.waiting_mm) } else { String::new() };
        text.push_str(&format!(
            "crack {} tip {}: at ({:.3}, {:.3}) mm, length {:.3} mm{waiting}{stop}\n",
            tip.crack, tip.tip, tip.x_mm, tip.y_mm, tip.length_mm
        ));
    }
    for junction in &summary.junctions {
        let (x, y) = (junction.x_mm, junction.y_mm);
        text.push_str(&format!(
            "crack {} has joined crack {} at ({x:.3}, {y:.3}) mm\n",
            junction.crack, junction.onto
        ));
    }
    for piece in &summary.pieces {
        text.push_str(&format!(
            "{} at crack {} in step {}: {:.3} mm\u{b2}\n",
            piece.kind, piece.crack, piece.step, piece.area_mm2
        ));
    }
    match summary.warnings.len() {
        0 => {}
        1 => text.push_str("1 warning, see summary.json\n"),
        count => text.push_str(&format!("{count} warnings, see summary.json\n")),
    }
    text.push_str(&where_and_on(finished));
    text
}

/// Where the results are, and how to go on.
fn where_and_on(finished: &Finished) -> String {
    let mut text = format!("results in {}\n", finished.folder.display());
    if finished.ending == Ending::Interrupted {
        text.push_str("the same command with --resume goes on from here\n");
    }
    text
}

#[cfg(test)]
#[path = "run_tests.rs"]
mod tests;

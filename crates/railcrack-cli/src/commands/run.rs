//! `railcrack run`.

use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::{self, Inputs, Set, default_folder};
use crate::interruption::{Interruption, Remains};
use crate::json::Json;
use crate::print;
use crate::progress::{Progress, cycles};
use crate::terminal;
use clap::Args;
use railcrack::words::Choice;
use railcrack_case::{Case, Overrides};
use railcrack_report::{PageEngine, Pages};
use railcrack_run::decision::{
    Reason, StageSummary, StagesSummary, TonnageWords, Verdict, VerdictLevel, interval_in_words, three_digits,
};
use railcrack_run::description::{RunTime, long_step};
use railcrack_run::machine::{Budget, Needs, short_of_address_space};
use railcrack_run::setup::RunSize;
use railcrack_run::simulation::{Ending, Finished, RunEntry, RunError, Simulation};
use railcrack_run::summary::validity::warning_pages;
use railcrack_run::{FrontSummary, JunctionSummary, PieceSummary, Summary, TipSummary, is_file_of_run};
use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Compute the growth of the cracks of a case
///
/// Results are written to the run folder as steps finish. An interrupted run keeps its finished
/// steps, and --resume continues after the last of them.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// Case file; `-` is standard input
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Run folder [default: name of the case file without its extension, in the same directory]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Engine, overriding the case: xfem, dislocation or space
    #[arg(long, value_name = "ENGINE")]
    pub engine: Option<String>,
    /// Contact solver, overriding the case: latin or newton
    #[arg(long, value_name = "SOLVER")]
    pub contact: Option<String>,
    /// Number of increments, overriding the case
    #[arg(long, value_name = "N")]
    pub steps: Option<u64>,
    #[command(flatten)]
    pub execution: Execution,
    /// Continue the run in the folder after its last finished step
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Replace an existing run in the folder
    #[arg(long)]
    pub force: bool,
    /// Run even if the estimate exceeds the available memory or disk space
    #[arg(long)]
    pub no_limits: bool,
    #[command(flatten)]
    pub json: Json,
}

/// Settings of the case and of the computation.
#[derive(Debug, Args)]
pub struct Execution {
    #[command(flatten)]
    pub set: Set,
    /// Number of threads [default: all]; it does not affect the results
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<NonZeroUsize>,
    /// Suppress progress output
    #[arg(long)]
    pub quiet: bool,
}

impl Execution {
    /// The progress that is shown.
    pub fn verbosity(&self) -> Verbosity {
        if self.quiet { Verbosity::Quiet } else { Verbosity::Progress }
    }
}

/// Runs the case and prints a summary.
pub fn run(arguments: &RunArguments) -> Result<Exit, Failure> {
    arguments.json.with_failures(|| {
        let finished = compute(arguments, &listen(Remains::FinishedSteps)?)?;
        let exit = match finished.ending {
            Ending::Ended => Exit::Done,
            Ending::Interrupted => Exit::Interrupted,
        };
        let text = || format!("{}{}", result_text(&finished), beside_case(arguments, &finished.folder));
        arguments.json.print(text, || result_json(&finished, exit))?;
        Ok(exit)
    })
}

/// Note on the location of the results, where it was not given with `--out` and is not the current
/// directory.
fn beside_case(arguments: &RunArguments, folder: &Path) -> &'static str {
    let is_here = folder.parent().is_none_or(|parent| parent == Path::new("") || parent == Path::new("."));
    if arguments.out.is_some() || is_here {
        ""
    } else {
        "(next to the case file, not in the current directory; --out DIR chooses another folder)\n"
    }
}

/// The result as one JSON object: exit code, folder, `summary.json`.
fn result_json(finished: &Finished, exit: Exit) -> Value {
    json!({
        "exit": exit.code(),
        "folder": finished.folder,
        "ending": if finished.ending == Ending::Ended { "ended" } else { "interrupted" },
        "summary": finished.summary,
    })
}

/// Installs the handlers of the signals that interrupt a computation of which `remains` is left.
///
/// Errors: the system refuses.
pub fn listen(remains: Remains) -> Result<Interruption, RunError> {
    Interruption::listen(remains)
        .map_err(|reason| RunError::System { action: "listen to signals".into(), reason: reason.to_string() })
}

/// Runs the case until it ends or is interrupted.
///
/// Errors: the case is invalid; the run fails.
pub fn compute(arguments: &RunArguments, interruption: &Interruption) -> Result<Finished, Failure> {
    let overrides = Overrides {
        steps: arguments.steps,
        engine: arguments.engine.clone(),
        contact: arguments.contact.clone(),
        settings: arguments.execution.set.set.clone(),
        ..Overrides::default()
    };
    let case = input::case(&arguments.case, &overrides)?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    let entry = arguments.entry();
    if entry != RunEntry::Resume {
        Inputs::of_case(&arguments.case, &case).stay(&folder, is_file_of_run)?;
    }
    if !arguments.execution.quiet {
        announce_groups(&case);
    }
    if case.output.explorer {
        // Said now, not when the page is written.
        PageEngine::find().map_err(RunError::from)?;
    }
    let size = RunSize::estimate(&case);
    if !arguments.no_limits {
        Budget::of(&folder).allows(Needs::with(&case, &size), 1, 1)?;
    }
    if let Some(says) =
        long_step(RunTime::of(&case, &size).step, &size).filter(|_| !arguments.execution.quiet)
    {
        print::warning(&says);
    }
    let progress = Progress::new(arguments.execution.verbosity(), case.growth.expected_steps(), interruption)
        .with_axle_load(case.axle_load);
    let simulation = Simulation::new(&case).observed_by(&progress).presented_by(&Pages);
    Ok(simulation.run_in(&folder, entry)?)
}

impl RunArguments {
    fn entry(&self) -> RunEntry {
        match (self.resume, self.force) {
            (true, _) => RunEntry::Resume,
            (false, true) => RunEntry::Replace,
            (false, false) => RunEntry::Begin,
        }
    }
}

/// Number of wheels of a table whose grouping takes a moment only.
const FEW_WHEELS: usize = 2000;

/// Announces that the wheels of a long table of `case` are grouped, which takes seconds to minutes.
pub fn announce_groups(case: &Case) {
    let waiting = case.wheel_table.as_ref().filter(|table| table.groups.is_none());
    if let Some(table) = waiting.filter(|table| table.wheels.len() > FEW_WHEELS) {
        terminal::stderr(&format!("grouping the {} wheels of the table\n", table.wheels.len()));
    }
}

/// Maximum number of threads, the processor count of the largest machines. Each thread has a stack
/// and waits for work in a busy loop.
pub const MOST_THREADS: usize = 1024;

/// Parses the number of threads.
pub fn threads(given: &str) -> Result<NonZeroUsize, String> {
    match given.parse::<NonZeroUsize>() {
        Ok(count) if count.get() <= MOST_THREADS => Ok(count),
        _ => Err(format!("must be an integer from 1 to {MOST_THREADS}")),
    }
}

/// The variable that gives a number of threads where none is given on the command line.
const THREADS_VARIABLE: &str = "RAYON_NUM_THREADS";

/// The number of threads: the `given` one, or that of the variable RAYON_NUM_THREADS, or one per
/// processor.
///
/// Errors: the variable does not hold an accepted number.
pub fn thread_count(given: Option<NonZeroUsize>) -> Result<usize, String> {
    if let Some(count) = given {
        return Ok(count.get());
    }
    match std::env::var(THREADS_VARIABLE) {
        // Zero is the default of the pool.
        Ok(text) if !matches!(text.as_str(), "" | "0") => threads(&text)
            .map(NonZeroUsize::get)
            .map_err(|says| format!("{THREADS_VARIABLE} = {text:?}: {says}")),
        _ => Ok(std::thread::available_parallelism().map_or(1, NonZeroUsize::get).min(MOST_THREADS)),
    }
}

/// Sets up the thread pool with `threads` threads, by default one per processor. The calling thread
/// is one of them, so that its data stay in its caches between two parallel sections. Other
/// threads, such as the one that writes steps, must not contain parallel sections, because they
/// could deadlock with the calling thread. Called once per process, before any parallel section.
///
/// Errors: an invalid number in the environment; too little address space; the system refuses.
pub fn use_threads(threads: Option<NonZeroUsize>) -> Result<(), Failure> {
    let count = affordable_threads(threads)?;
    build(count, rayon::ThreadPoolBuilder::new().num_threads(count).use_current_thread())
}

/// Sets up the thread pool of a command that computes on other threads than the calling one.
///
/// Errors: those of [`use_threads`].
pub fn use_other_threads() -> Result<(), Failure> {
    let count = affordable_threads(None)?;
    build(count, rayon::ThreadPoolBuilder::new().num_threads(count))
}

/// The number of threads, for which there is address space.
fn affordable_threads(threads: Option<NonZeroUsize>) -> Result<usize, Failure> {
    let count = thread_count(threads).map_err(Failure::Show)?;
    match short_of_address_space(count) {
        Some(reason) => Err(RunError::System { action: format!("start {count} threads"), reason }.into()),
        None => Ok(count),
    }
}

fn build(count: usize, pool: rayon::ThreadPoolBuilder) -> Result<(), Failure> {
    let refused = |reason: rayon::ThreadPoolBuildError| RunError::System {
        action: format!("start {count} threads"),
        reason: reason.to_string(),
    };
    match pool.build_global() {
        // In Python an earlier command has made the pool, which serves this one too.
        Err(reason) if std::error::Error::source(&reason).is_none() => Ok(()),
        made => Ok(made.map_err(refused)?),
    }
}

/// One line for each reason of a verdict.
fn verdict(verdict: &Verdict) -> String {
    let level = match verdict.level {
        VerdictLevel::Outside => "outside of what the model describes",
        VerdictLevel::Unknown => "unknown",
        level => level.word(),
    };
    let head = |i: usize| if i == 0 { format!("verdict: {level}: ") } else { "also: ".to_owned() };
    let line = |(i, reason): (usize, &Reason)| format!("{}{}\n", head(i), reason.text);
    verdict.reasons.iter().enumerate().map(line).collect()
}

/// One line for each stage of a head check that turns down.
fn stages(stages: &StagesSummary) -> String {
    let one = |name: &str, stage: &StageSummary, by: &str| {
        let Some(mgt) = stage.mgt else { return format!("{name}: the run ends within it\n") };
        let depth =
            stage.detectable_depth_mm.map_or_else(String::new, |depth| format!(" (from {depth} mm on)"));
        let found = match (stage.mgt_detectable_to_end, stage.detectable_depth_mm) {
            (Some(left), _) => format!(", {by}{depth} finds it {} before its end", three_digits(left)),
            (None, Some(_)) => format!(", {by}{depth} does not find it before its end"),
            (None, None) => String::new(),
        };
        format!("{name}: {} million gross tonnes{found}\n", three_digits(mgt))
    };
    let transverse = one("stage 2, from the turn to failure", &stages.transverse, "ultrasonics");
    let Some(head_check) = &stages.head_check else {
        return format!(
            "has turned down, {:.2} mm deep at the beginning\n{transverse}",
            stages.turn_depth_mm
        );
    };
    format!(
        "turns down {:.2} mm deep after {:.3} million gross tonnes\n{}{transverse}",
        stages.turn_depth_mm,
        stages.mgt_to_turn,
        one("stage 1, until it turns", head_check, "eddy current"),
    )
}

/// One line for each wheel of a mix, and one for the inspection interval.
fn decision(summary: &Summary) -> String {
    let mut text = summary.verdict.as_ref().map_or_else(String::new, verdict);
    let Some(decision) = &summary.decision else { return text };
    let words = TonnageWords { mgt_per_year: decision.mgt_per_year };
    let to_act_on = interval_in_words(decision.inspection.as_ref(), &decision.risk, words);
    text.extend(to_act_on.map(|interval| format!("{interval}\n")));
    if let Some(paths) = decision.paths {
        let life = |mgt: Option<f64>| mgt.map_or_else(|| "none within the run".to_owned(), three_digits);
        text.push_str(&format!(
            "million gross tonnes to failure: straight ahead {}, as computed {}, limit path {}\n",
            life(paths.straight),
            life(paths.nominal),
            life(paths.limit)
        ));
    }
    if let Some(stages) = &decision.stages {
        text.push_str(&self::stages(stages));
    }
    for of in &decision.frictions {
        let life = of.mgt.map_or_else(|| "none within the run".to_owned(), three_digits);
        text.push_str(&format!(
            "million gross tonnes to failure with friction {} between the faces: {life}\n",
            of.friction
        ));
    }
    if let Some(part) = &decision.part_of_row {
        text.push_str(&format!(
            "other paths and speeds: with cracks {} of {} alone, which changes the {} by {:.2} %\n",
            part.numbers(),
            part.of,
            if part.mgt.is_some() { "life" } else { "growth" },
            part.difference_percent
        ));
    }
    for wheel in &decision.wheels {
        let turns = match wheel.turns_in_steps {
            0 => String::new(),
            steps => format!(", changes the crack direction in {steps} of {} steps", summary.steps_recorded),
        };
        text.push_str(&format!(
            "{}: {:.1} % of the axles, {:.1} % of the growth{turns}\n",
            wheel.name,
            100.0 * wheel.share_of_axles,
            100.0 * wheel.share_of_growth
        ));
    }
    text.push_str(&format!("{}\n", decision.calibration));
    text
}

/// Summary of the result for standard output.
pub fn result_text(finished: &Finished) -> String {
    let Finished { ending, summary, .. } = finished;
    if summary.steps_recorded == 0 {
        return format!("interrupted before the end of the first step\n{}", where_and_on(finished));
    }
    let how = match (ending, &summary.stop) {
        (Ending::Ended, Some(stop)) => format!("{} at", stop.word()),
        (Ending::Ended, None) => "ended at".to_owned(),
        (Ending::Interrupted, _) => "interrupted after".to_owned(),
    };
    let mut text = format!("{how} step {}, {} load cycles", summary.steps, cycles(summary.load_cycles));
    if let Some(tonnes) = summary.million_gross_tonnes {
        text.push_str(&format!(", {tonnes:.3} million gross tonnes"));
    }
    text.push('\n');
    text.push_str(&fronts(summary));
    text.push_str(&tips(summary));
    text.push_str(&events(summary));
    text.push_str(&decision(summary));
    text.push_str(&warnings(summary));
    text.push_str(&where_and_on(finished));
    text
}

/// One line for each crack in space.
fn fronts(summary: &Summary) -> String {
    let all = if summary.fronts.is_empty() { summary.front.as_slice() } else { &summary.fronts };
    let line = |(k, front): (usize, &FrontSummary)| {
        let whose = if all.len() > 1 { format!("crack {}: ", k + 1) } else { String::new() };
        let (axes, fold) = match front.fold_mm {
            Some(fold) => ("length and half-length", format!("; fold at {fold:.3} mm")),
            None => ("semi-axes", String::new()),
        };
        let free = front.front_deviation.map_or_else(String::new, |most| {
            format!("; free front within {:.1} % of its ellipse", 100.0 * most)
        });
        format!(
            "{whose}{axes} {:.3} mm down the dip and {:.3} mm along the surface, from {:.3} and {:.3} mm; {:.3} mm deep{fold}{free}\n",
            front.length_mm,
            front.surface_half_length_mm,
            front.initial_length_mm,
            front.initial_surface_half_length_mm,
            front.depth_mm
        )
    };
    all.iter().enumerate().map(line).collect()
}

/// One line for each tip; a front has many points and is summarised by its semi-axes.
fn tips(summary: &Summary) -> String {
    let line = |tip: &TipSummary| {
        let stop = tip.stop.map_or_else(String::new, |stop| format!(", {}", stop.word()));
        let waits = tip.waiting_mm > 0.0;
        let waiting = if waits { format!(", {:.3} mm waiting", tip.waiting_mm) } else { String::new() };
        format!(
            "crack {} tip {}: at ({:.3}, {:.3}) mm, length {:.3} mm{waiting}{stop}\n",
            tip.crack, tip.tip, tip.x_mm, tip.y_mm, tip.length_mm
        )
    };
    summary.tips.iter().filter(|_| summary.front.is_none()).map(line).collect()
}

/// One line for each junction and enclosed piece, and one for the largest k1.
fn events(summary: &Summary) -> String {
    let mut text = String::new();
    for JunctionSummary { crack, onto, x_mm, y_mm, .. } in &summary.junctions {
        text.push_str(&format!("crack {crack} has joined crack {onto} at ({x_mm:.3}, {y_mm:.3}) mm\n"));
    }
    for PieceSummary { kind, crack, step, area_mm2, .. } in &summary.pieces {
        let kind = kind.word();
        text.push_str(&format!("{kind} at crack {crack} in step {step}: {area_mm2:.3} mm\u{b2}\n"));
    }
    if let Some(fracture) = &summary.fracture
        && let Some(share) = fracture.of_toughness
    {
        let at =
            fracture.xc_mm.map_or_else(String::new, |xc| format!(" with the wheel at {:.2} m", 1e-3 * xc));
        text.push_str(&format!(
            "largest k1 {:.1} MPa\u{221a}m in step {}{at}, {:.0} % of the toughness\n",
            fracture.largest_k1_mpa_sqrt_m,
            fracture.step,
            100.0 * share
        ));
    }
    text
}

/// Maximum number of warnings printed; summary.json lists all.
const WARNINGS: usize = 8;

/// One line for each distinct warning.
fn warnings(summary: &Summary) -> String {
    let mut texts: Vec<String> = Vec::new();
    for warning in &summary.warnings {
        let text = format!("warning, {}: {}\n", warning.place(), warning.text);
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    let more = texts.len().saturating_sub(WARNINGS);
    texts.truncate(WARNINGS);
    let mut text = texts.concat();
    if more > 0 {
        text.push_str(&format!("and {more} more, see summary.json\n"));
    }
    let pages = warning_pages(summary.warnings.iter().map(|warning| warning.kind));
    text.extend(pages.map(|pages| format!("what they mean and what to do: {pages}\n")));
    text
}

/// Location of the results, and how to continue an interrupted run.
fn where_and_on(finished: &Finished) -> String {
    let mut text = format!("results in {}\n", finished.folder.display());
    if finished.ending == Ending::Interrupted {
        text.push_str("repeat the command with --resume to continue\n");
    }
    text
}

//! `railcrack compare`.

use crate::commands::run::{self, Execution, RunArguments};
use crate::exit::{Exit, Failure};
use crate::input::Set;
use crate::interruption::Remains;
use crate::json::Json;
use crate::print;
use clap::{ArgGroup, Args};
use railcrack::words::Choice;
use railcrack_case::{Case, Engine, PlaneEngine};
use railcrack_report::Pages;
use railcrack_run::compare::COMPARISON;
use railcrack_run::files::COMPARE_FILE;
use railcrack_run::simulation::{Ending, RunError};
use railcrack_run::{Comparison, Existing, Presentation, ResultFolder, clear_run};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Compare two runs: SIF histories, crack paths, load cycles
///
/// Compares two run folders, or computes one case twice and compares the two runs: with --engines
/// by both plane engines, with --coupled under wheels that feel the cracks and that do not. The
/// stabilised passage of each step is compared. The differences are printed, and written with plots
/// to a separate folder.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("computed").args(["engines", "coupled"])))]
pub struct CompareArguments {
    /// The first run folder; with --engines or --coupled the case file
    #[arg(value_name = "DIR|CASE")]
    first: PathBuf,
    /// The second run folder
    #[arg(value_name = "DIR", required_unless_present = "computed", conflicts_with = "computed")]
    second: Option<PathBuf>,
    /// Compute the case with both plane engines and compare the two runs
    #[arg(long)]
    engines: bool,
    /// Compute the case under wheels that feel the cracks (coupled = true) and under wheels that do
    /// not, and compare the two runs
    #[arg(long)]
    coupled: bool,
    /// Folder of the comparison [default: name of the first run or of the case followed by
    /// -compare, in the same directory]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Largest accepted difference of K, in per cent of the largest |K| of the case; the exit code
    /// is 1 if it is exceeded, or if the runs have no step, tip or wheel position in common
    #[arg(long, value_name = "P", value_parser = percent, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// With --engines or --coupled: number of increments, overriding the case
    #[arg(long, value_name = "N", requires = "computed")]
    steps: Option<u64>,
    /// Suppress progress output
    #[arg(long)]
    quiet: bool,
    /// Replace an existing comparison in the folder, with --engines or --coupled also its runs
    #[arg(long)]
    force: bool,
    /// With --engines or --coupled: run even if the estimate exceeds the available memory or disk
    /// space
    #[arg(long, requires = "computed")]
    no_limits: bool,
    #[command(flatten)]
    json: Json,
}

fn percent(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite() && *value >= 0.0);
    value.ok_or_else(|| "must be a percentage of at least 0".to_owned())
}

/// Compares two stored runs, or two runs computed for the comparison.
pub fn compare(arguments: &CompareArguments) -> Result<Exit, Failure> {
    let out = match &arguments.out {
        Some(folder) => folder.clone(),
        None => beside(&arguments.first),
    };
    arguments.json.with_failures(|| match &arguments.second {
        Some(second) => compare_folders(arguments, [&arguments.first, second], enter(arguments, &out)?),
        None => compare_computed(arguments, &out),
    })
}

/// Name of the first run or of the case without its extension, followed by `-compare`.
fn beside(first: &Path) -> PathBuf {
    // `.` and `..` do not end in a name.
    let named = match first.file_name() {
        Some(_) => first.to_path_buf(),
        None => first.canonicalize().unwrap_or_else(|_| first.join("run")),
    };
    let stem = if named.is_dir() { named.file_name() } else { named.file_stem() };
    let mut name = stem.unwrap_or_default().to_owned();
    name.push("-compare");
    named.with_file_name(name)
}

/// The folder `out`, entered for the comparison.
fn enter(arguments: &CompareArguments, out: &Path) -> Result<ResultFolder, Failure> {
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    Ok(ResultFolder::enter(out, &COMPARISON, existing).map_err(RunError::from)?)
}

fn compare_folders(
    arguments: &CompareArguments,
    runs: [&PathBuf; 2],
    entered: ResultFolder,
) -> Result<Exit, Failure> {
    let out = &entered.path().to_path_buf();
    let comparison = Comparison::of(runs[0], runs[1]).map_err(RunError::from)?;
    comparison
        .write(entered, arguments.tolerance, |folder| Pages.comparison(folder))
        .map_err(RunError::from)?;
    let keeps = arguments.tolerance.is_none_or(|tolerance| comparison.is_within(tolerance));
    let exit = if keeps { Exit::Done } else { Exit::Differs };
    let text = || format!("{}comparison in {}\n", comparison.text(arguments.tolerance), out.display());
    let stored = || {
        let stored = std::fs::read(out.join(COMPARE_FILE)).ok();
        stored.and_then(|text| serde_json::from_slice::<Value>(&text).ok())
    };
    let value = || json!({ "exit": exit.code(), "folder": out, "comparison": stored() });
    arguments.json.print(text, value)?;
    Ok(exit)
}

/// Runs the case with both plane engines, or under wheels that feel the cracks and that do not,
/// each into a folder of its name in `out`, and compares the runs.
fn compare_computed(arguments: &CompareArguments, out: &Path) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.first)?;
    let interruption = run::listen(Remains::Nothing)?;
    let entered = enter(arguments, out)?;
    let mut folders = Vec::new();
    let runs: Vec<RunArguments> = if arguments.engines {
        let engines = [PlaneEngine::Xfem, PlaneEngine::Dislocation].map(Engine::Plane);
        engines.map(|engine| run_with(arguments, engine, out)).into()
    } else {
        COUPLINGS.into_iter().map(|coupling| run_coupled(arguments, &case, coupling, out)).collect()
    };
    let named = runs.iter().filter_map(|run| run.out.as_deref());
    named.into_iter().try_for_each(|folder| entered.refuse_run(folder)).map_err(RunError::from)?;
    entered.mark().map_err(RunError::from)?;
    for run in runs {
        let run = RunArguments { force: entered.replaces(), ..run };
        let finished = run::compute(&run, &interruption)?;
        folders.push(finished.folder);
        if finished.ending == Ending::Interrupted {
            folders.iter().try_for_each(|folder| clear_run(folder)).map_err(RunError::from)?;
            entered.abandon().map_err(RunError::from)?;
            return Ok(print::interrupted());
        }
    }
    compare_folders(arguments, [&folders[0], &folders[1]], entered)
}

/// A run of the case with one engine.
fn run_with(arguments: &CompareArguments, engine: Engine, out: &Path) -> RunArguments {
    RunArguments { engine: Some(engine.word().to_owned()), ..run_named(arguments, engine.word(), out) }
}

/// Folders of the runs under wheels that feel the cracks and that do not, and values of `coupled`.
const COUPLINGS: [(&str, &str); 2] = [("coupled", "true"), ("uncoupled", "false")];

/// A run of `case` with one of [`COUPLINGS`].
fn run_coupled(
    arguments: &CompareArguments,
    case: &Case,
    (name, coupled): (&str, &str),
    out: &Path,
) -> RunArguments {
    let of_contact = |section: String| format!("{section}.coupled={coupled}");
    let set = case.contact_sections().into_iter().map(of_contact).collect();
    let plain = run_named(arguments, name, out);
    let execution = Execution { set: Set { set }, ..plain.execution };
    RunArguments { execution, ..plain }
}

/// A run of the case as it is, into the folder `name` in `out`.
fn run_named(arguments: &CompareArguments, name: &str, out: &Path) -> RunArguments {
    RunArguments {
        case: arguments.first.clone(),
        out: Some(out.join(name)),
        engine: None,
        contact: None,
        steps: arguments.steps,
        resume: false,
        force: arguments.force,
        no_limits: arguments.no_limits,
        execution: Execution { set: Set::default(), threads: None, quiet: arguments.quiet },
        json: Json::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_folder_is_beside_the_first_run() {
        assert_eq!(
            beside(Path::new("runs/a.b/")),
            Path::new("runs/a-compare"),
            "a missing path is treated as a case file"
        );
        assert_eq!(beside(Path::new("cases/rail.toml")), Path::new("cases/rail-compare"));
        let here = std::env::current_dir().unwrap();
        let name = format!("{}-compare", here.file_name().unwrap().to_string_lossy());
        assert_eq!(beside(Path::new(".")), here.with_file_name(name));
    }

    #[test]
    fn tolerances_are_per_cent() {
        assert_eq!(percent("0.5"), Ok(0.5));
        for text in ["-1", "nan", "inf", "1%", ""] {
            assert!(percent(text).is_err(), "{text}");
        }
    }
}

//! Names of the files and folders of results, and the version of the program that writes them.

use railcrack_case::file_keys;

/// Version of the program that writes the files.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The case of a run, defaults filled in.
pub const CASE_FILE: &str = "case.toml";
/// State from which a run continues.
pub const CHECKPOINT_FILE: &str = "checkpoint.bin";
/// Run log: an entry per finished growth step.
pub const RUN_LOG_FILE: &str = "run-log.bin";
/// A run in numbers.
pub const SUMMARY_FILE: &str = "summary.json";
/// SHA-256 of the files of a folder, as `sha256sum -c` reads them.
pub const SUMS_FILE: &str = "SHA256SUMS";
/// Mark of a folder whose results are unfinished: of a command that does not continue them.
pub(crate) const UNFINISHED_FILE: &str = "results.partial";
/// How a run of a study ended.
pub const OUTCOME_FILE: &str = "outcome.json";
/// List of the field files.
pub const FIELDS_FILE: &str = "fields.pvd";
/// Folder of the field files.
pub const FIELDS_FOLDER: &str = "fields";
/// The stabilised plastic state in numbers.
pub const SHAKEDOWN_FILE: &str = "shakedown.json";
/// The plastic stress that rolling has left, as a field of the rail.
pub const PLASTIC_FILE: &str = "plastic.vtu";
/// Stress and plastic strain around the contact.
pub const CYCLE_FILE: &str = "cycle.vtu";
/// The plastic state across the rail.
pub const SECTION_FILE: &str = "section.vtu";
/// Folder of the stabilised plastic state that a run computed first.
pub const ROLLED_FOLDER: &str = "shakedown";
/// Groups of the wheels of a table, as the run made them.
pub(crate) const WHEEL_GROUPS_FILE: &str = "inputs/wheel-groups.json";
/// Folder of the files that `case.toml` names.
pub(crate) const INPUTS_FOLDER: &str = "inputs";
/// The page in a folder.
pub const REPORT_FILE: &str = "report.html";
/// Folder of the plots.
pub const PLOTS_FOLDER: &str = "plots";
/// A comparison in numbers.
pub const COMPARE_FILE: &str = "compare.json";
/// Text of a study.
pub(crate) const STUDY_FILE: &str = "study.toml";
/// Folder of the run folders of a study.
pub(crate) const RUNS_FOLDER: &str = "runs";
/// Plan of a study.
pub const PLAN_FILE: &str = "study.json";
/// Samples between the runs of a study.
pub const POPULATION_FILE: &str = "population.json";

/// Grinding plans in numbers.
pub const PLANS_FILE: &str = "plan.json";

/// Table of a study with a row per run.
pub(crate) const RUNS_TABLE: &str = "runs.parquet";
/// Table of a study with a row per run, step and tip.
pub(crate) const GROWTH_TABLE: &str = "growth.parquet";
/// Table of a study with a row per run, step, tip and wheel position.
pub(crate) const SIF_TABLE: &str = "sif.parquet";

/// Tables of all runs of a study.
pub(crate) const STUDY_TABLES: [&str; 6] =
    ["summary.csv", "times.csv", RUNS_TABLE, GROWTH_TABLE, SIF_TABLE, POPULATION_FILE];

/// Every plot that a study may have.
pub const STUDY_PLOTS: [&str; 4] = ["ki.svg", "kii.svg", "paths.svg", "length-cycles.svg"];

/// Every plot of a run or of a stabilised plastic state.
pub(crate) const PLOT_FILES: [&str; 19] = [
    "ki.svg",
    "kii.svg",
    "kiii.svg",
    "along-front.svg",
    "paths.svg",
    "length-cycles.svg",
    "row.svg",
    "faces.svg",
    "faces-last.svg",
    "residual-stress.svg",
    "plastic-strain.svg",
    "passes.svg",
    "passes-change.svg",
    "bounds.svg",
    "shakedown-map.svg",
    "dang-van.svg",
    "field.svg",
    "section.svg",
    "plan.svg",
];

/// Results of a run, in the order in which a replaced run is removed: a run without its checkpoint
/// counts as not started.
const RUN_RESULTS: [&str; 21] = [
    CHECKPOINT_FILE,
    RUN_LOG_FILE,
    OUTCOME_FILE,
    SUMS_FILE,
    "sif.csv",
    "growth.csv",
    "faces.csv",
    "contact.csv",
    "residual.csv",
    SUMMARY_FILE,
    "passes.csv",
    "profile.csv",
    "section.csv",
    SHAKEDOWN_FILE,
    PLASTIC_FILE,
    CYCLE_FILE,
    SECTION_FILE,
    PLANS_FILE,
    "plan.csv",
    REPORT_FILE,
    FIELDS_FILE,
];

/// Names, in a run folder, of the files that a case may name, as the keys of a case declare them.
pub(crate) fn input_files() -> impl Iterator<Item = &'static str> {
    // Each file is the copy for one key.
    file_keys().into_iter().map(|key| key.kept_as)
}

/// Files of a run other than `case.toml`: its results and the files that its case names.
pub(crate) fn run_files() -> impl Iterator<Item = &'static str> {
    RUN_RESULTS.into_iter().chain(input_files()).chain([WHEEL_GROUPS_FILE])
}

//! `railcrack check` of a study.

use railcrack::words::Choice;
use railcrack_case::{Axis, ByGeometry, Study, StudyRun, Variation};
use railcrack_run::description::{RunTime, duration, long_step};
use railcrack_run::machine::{Budget, Needs, mb};
use railcrack_run::setup::{RailKey, RunSize};
use railcrack_run::summary::validity::{of_case, pattern};
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Maximum number of runs listed individually.
const MOST_LISTED: usize = 50;

/// Maximum number of runs whose sizes are computed, spread evenly over the study.
const MOST_SIZED: usize = 100;

/// Needs of the runs of a study.
struct StudyNeeds {
    /// Disk of all runs, bytes.
    disk: u64,
    /// Processor time of all runs, s.
    seconds: f64,
    /// Remark on the slowest one; none where all are quick.
    slow: Option<String>,
}

impl StudyNeeds {
    fn of(study: &Study) -> Self {
        let sizes = ByGeometry::default();
        let every = study.runs.len().div_ceil(MOST_SIZED).max(1);
        let (mut disk, mut time, mut count, mut slowest) = (0u128, 0.0, 0, None::<(f64, RunSize)>);
        for run in study.runs.iter().step_by(every) {
            let size = sizes.value(&run.case, || RunSize::estimate(&run.case));
            disk += u128::from(Needs::with(&run.case, &size).disk);
            count += 1;
            let RunTime { step: seconds, run: of_run, .. } = RunTime::of(&run.case, &size);
            time += of_run;
            if slowest.is_none_or(|(most, _)| seconds > most) {
                slowest = Some((seconds, size));
            }
        }
        let disk = disk * study.runs.len() as u128 / count.max(1);
        let slow = slowest.and_then(|(seconds, size)| long_step(seconds, &size));
        let seconds = time * study.runs.len() as f64 / count.max(1) as f64;
        Self { disk: u64::try_from(disk).unwrap_or(u64::MAX), seconds, slow }
    }
}

/// Summary of a study: the keys that vary, what the runs share, and the runs.
pub fn study_summary(study: &Study, folder: &Path) -> String {
    let count = study.runs.len();
    let runs = if count == 1 { "1 run".to_owned() } else { format!("{count} runs") };
    let mut text = format!("{}\n\nstudy\n  {:<20} {runs}, {}\n", study.title, "runs", study.combine.word());
    for axis in &study.axes {
        text.push_str(&axis_lines(axis));
    }
    if let Some(axis) = study.axes.get(study.colour_axis) {
        let names: Vec<&str> = axis.variations.iter().map(|v| v.name.as_str()).collect();
        text.push_str(&format!("  {:<20} {}\n", "colours of the plots", names.join(", ")));
    }
    text.push_str(&format!("  {:<20} {}\n", "shared", shared(study)));
    if let Some(first) = study.runs.first() {
        let memory = RunSize::estimate(&first.case).memory_bytes.div_ceil(1 << 20);
        text.push_str(&format!(
            "  {:<20} about {memory} MB for the first run, times the threads\n",
            "memory"
        ));
    }
    let StudyNeeds { disk, seconds, slow } = StudyNeeds::of(study);
    let budget = Budget::of(folder);
    let of = |has: Option<u64>| has.map_or_else(|| "unknown".to_owned(), |has| format!("{} MB", mb(has)));
    text.push_str(&format!("  {:<20} about {} MB of tables, all runs\n", "disk", mb(disk)));
    text.push_str(&format!("  {:<20} about {} on one core, all runs\n", "time", duration(seconds)));
    text.push_str(&format!(
        "  {:<20} {} of memory, {} of free disk\n",
        "machine",
        of(budget.memory),
        of(budget.disk)
    ));
    if let Some(says) = slow {
        text.push_str(&format!("  {:<20} {says} (the slowest run)\n", "slow"));
    }
    let warnings = warnings(study);
    if !warnings.is_empty() {
        text.push_str("\nwarnings\n");
        warnings.iter().for_each(|(run, warning)| text.push_str(&format!("  run {run}: {warning}\n")));
    }
    text.push_str("\nruns\n");
    for run in study.runs.iter().take(MOST_LISTED) {
        let StudyRun { number, label, case, .. } = run;
        let (engine, steps) = (case.engine().word(), case.growth.steps);
        text.push_str(&format!("  {number:>5}   {label}   {engine}, {steps} increments\n"));
    }
    if count > MOST_LISTED {
        text.push_str(&format!("  and {} more\n", count - MOST_LISTED));
    }
    text
}

/// The study as one JSON object.
pub fn study_json(study: &Study) -> Value {
    let varies = |axis: &Axis| -> Vec<Value> {
        let of = |variation: &Variation| {
            let values: Vec<String> = (0..axis.len()).map(|index| variation.shown(index)).collect();
            json!({ "key": variation.key, "values": values })
        };
        axis.variations.iter().map(of).collect()
    };
    let runs: Vec<Value> = study
        .runs
        .iter()
        .map(|run| json!({ "run": run.number, "values": run.label, "increments": run.case.growth.steps }))
        .collect();
    let StudyNeeds { disk, seconds, .. } = StudyNeeds::of(study);
    json!({
        "exit": 0,
        "kind": "study",
        "title": study.title,
        "combine": study.combine.word(),
        "axes": study.axes.iter().map(varies).collect::<Vec<_>>(),
        "disk_bytes": disk,
        "seconds": seconds,
        "warnings": warnings(study).into_iter().map(|(run, text)| json!({ "run": run, "text": text })).collect::<Vec<_>>(),
        "runs": runs,
    })
}

/// The warnings that runs would begin with, each with the first run that does; of many runs, some
/// spread evenly over the study are asked.
fn warnings(study: &Study) -> Vec<(usize, String)> {
    let every = study.runs.len().div_ceil(MOST_SIZED).max(1);
    let mut known = HashSet::new();
    let mut found = Vec::new();
    for run in study.runs.iter().step_by(every) {
        let texts = of_case(&run.case).into_iter().map(|warning| warning.text);
        let fresh = texts.filter(|text| known.insert(pattern(text)));
        found.extend(fresh.map(|text| (run.number, text)));
    }
    found
}

/// The keys of an axis with their values.
fn axis_lines(axis: &Axis) -> String {
    let mut text = String::new();
    for (i, variation) in axis.variations.iter().enumerate() {
        let listed = axis.len().min(MOST_LISTED);
        let mut values: Vec<String> = (0..listed).map(|index| variation.shown(index)).collect();
        if axis.len() > listed {
            values.push(format!("… ({} values)", axis.len()));
        }
        let name = if i == 0 { "varies" } else { "  together with" };
        text.push_str(&format!("  {name:<20} {} = {}\n", variation.key, values.join(", ")));
    }
    text
}

/// Number of meshes and factorisations that the runs share.
fn shared(study: &Study) -> String {
    let mut rails: HashMap<RailKey, usize> = HashMap::new();
    for key in study.runs.iter().filter_map(|run| RailKey::of_case(&run.case)) {
        *rails.entry(key).or_default() += 1;
    }
    let runs: usize = rails.values().sum();
    match rails.len() {
        0 => "nothing: the dislocation engine has no mesh".to_owned(),
        1 => format!("one mesh and factorisation for {runs} runs"),
        count => format!("{count} meshes and factorisations for {runs} runs"),
    }
}

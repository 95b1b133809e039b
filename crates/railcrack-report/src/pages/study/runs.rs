//! The table of the runs.

use crate::figures::StudyRun;
use crate::numbers::{brief, fixed, grouped, significant, tonnage};
use crate::table::{Cell, MISSING, Table};
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use railcrack_run::decision::Verdict;
use railcrack_run::study::{RunState, StudyPlan};

/// Maximum number of rows of the table; `summary.csv` has all.
const TABLE_ROWS: usize = 500;

/// A row per run, with a link to its report.
pub(super) fn table(plan: &StudyPlan, all: &[StudyRun]) -> Table {
    let keys = plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.name.clone());
    let shown = TrafficColumns {
        tonnes: all.iter().any(|run| tonnes(run).is_some()),
        interval: all.iter().any(|run| interval(run).is_some()),
        verdict: all.iter().any(|run| verdict(run).is_some()),
        failure: all.iter().any(|run| failure(run).is_some()),
    };
    let mut headings: Vec<String> = vec!["Run".to_owned()];
    headings.extend(keys);
    headings.extend(["Length (mm)", "Tip depth (mm)", "Load cycles"].map(str::to_owned));
    if shown.tonnes {
        headings.push("Million gross tonnes".to_owned());
    }
    if shown.interval {
        headings.push("Inspection interval (MGT)".to_owned());
    }
    if shown.verdict {
        headings.extend(["Verdict", "Reasons"].map(str::to_owned));
    }
    if shown.failure {
        headings.push("Failure".to_owned());
    }
    headings.extend(
        ["Initial ΔK_{eq} (MPa√m)", "Initial rate (mm/cycle)", "Direction", "Ended by", "Warnings"]
            .map(str::to_owned),
    );
    let mut table = Table::new(headings).sortable();
    table.caption =
        "Tip of the crack with the largest growth in each run. The run number links to the report of the run, which \
         railcrack report builds from its folder"
            .to_owned();
    if all.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of summary.csv"));
    }
    for run in all.iter().take(TABLE_ROWS) {
        table.row_of(&run.name, &run.planned.choice, cells(plan, run, shown));
    }
    table
}

/// Which columns of traffic some run fills.
#[derive(Debug, Clone, Copy)]
struct TrafficColumns {
    tonnes: bool,
    interval: bool,
    verdict: bool,
    failure: bool,
}

/// The verdict on a run.
pub(super) fn verdict<'a>(run: &'a StudyRun) -> Option<&'a Verdict> {
    run.row.summary.as_ref()?.verdict.as_ref()
}

/// How a run fails, and when; none of a run without a failure.
fn failure(run: &StudyRun) -> Option<String> {
    let failure = run.row.summary.as_ref()?.decision.as_ref()?.failure;
    let (mode, mgt) = failure.mode.zip(failure.mgt)?;
    Some(format!("{}, {} MGT", mode.words(), tonnage(mgt)))
}

/// Million gross tonnes of a run.
fn tonnes(run: &StudyRun) -> Option<f64> {
    run.row.summary.as_ref()?.million_gross_tonnes
}

/// The inspection interval of a run, million gross tonnes.
fn interval(run: &StudyRun) -> Option<f64> {
    run.row.summary.as_ref()?.decision.as_ref()?.inspection.as_ref()?.interval_mgt
}

fn cells(plan: &StudyPlan, run: &StudyRun, shown: TrafficColumns) -> Vec<Cell> {
    let number = run.number().to_string();
    let mut cells: Vec<Cell> = vec![match run.row.summary {
        Some(_) if run.has_report => {
            Cell::linked(&number, &format!("runs/{}/report.html", run.planned.folder))
        }
        _ => number.into(),
    }];
    cells.extend(plan.values_of(run.planned).map(|(_, value)| Cell::from(brief(value))));
    let missing = || Cell::from(MISSING);
    let (tip, summary) = (run.tip(), run.row.summary.as_ref());
    let of_tip = |text: &dyn Fn(&railcrack_run::run_folder::RepresentativeTip) -> String| {
        tip.map_or_else(missing, |tip| text(tip).into())
    };
    cells.push(of_tip(&|tip| format!("{} → {}", fixed(tip.first.length, 2), fixed(tip.last().length, 2))));
    cells.push(of_tip(&|tip| fixed(-tip.last().place[1], 2)));
    cells.push(of_tip(&|tip| grouped(tip.last().load_cycles)));
    if shown.tonnes {
        cells.push(tonnes(run).map_or_else(missing, |tonnes| tonnage(tonnes).into()));
    }
    if shown.interval {
        cells.push(interval(run).map_or_else(missing, |mgt| tonnage(mgt).into()));
    }
    if shown.verdict {
        cells.push(verdict(run).map_or_else(missing, |verdict| verdict.level.word().into()));
        cells.push(verdict(run).map_or_else(missing, |verdict| verdict.kinds().into()));
    }
    if shown.failure {
        cells.push(failure(run).map_or_else(missing, Cell::from));
    }
    cells.push(of_tip(&|tip| significant(tip.first.delta_keq)));
    cells.push(of_tip(&|tip| significant(tip.first.rate)));
    cells.push(run.heading().map_or_else(missing, |heading| heading.course().word().into()));
    cells.push(match &run.row.state {
        RunState::Done => summary.and_then(|s| s.stop).map_or("", RunStop::word).replace('-', " ").into(),
        RunState::Failed { .. } => "failed".into(),
        state => state.name().replace('-', " ").into(),
    });
    cells.push(summary.map_or_else(missing, |summary| summary.warnings.len().to_string().into()));
    cells
}

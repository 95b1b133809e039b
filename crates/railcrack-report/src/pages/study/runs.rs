//! The table of the runs.

use crate::figures::StudyRun;
use crate::numbers::{brief, fixed, grouped, significant, tonnage};
use crate::table::{Cell, MISSING, Table};
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use railcrack_run::study::{RunState, StudyPlan};

/// Maximum number of rows of the table; `summary.csv` has all.
const TABLE_ROWS: usize = 500;

/// A row per run, with a link to its report.
pub(super) fn table(plan: &StudyPlan, all: &[StudyRun]) -> Table {
    let keys = plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.name.clone());
    let has_tonnes =
        all.iter().any(|run| run.row.summary.as_ref().is_some_and(|s| s.million_gross_tonnes.is_some()));
    let mut headings: Vec<String> = vec!["Run".to_owned()];
    headings.extend(keys);
    headings.extend(["Length (mm)", "Load cycles"].map(str::to_owned));
    if has_tonnes {
        headings.push("Million gross tonnes".to_owned());
    }
    headings.extend(
        ["Initial ΔK_{eq} (MPa√m)", "Initial rate (mm/cycle)", "Direction", "Ended by", "Warnings"]
            .map(str::to_owned),
    );
    let mut table = Table::new(headings);
    table.caption =
        "Tip of the crack with the largest growth in each run. The run number links to the report of the run, which \
         railcrack report builds from its folder"
            .to_owned();
    if all.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of summary.csv"));
    }
    for run in all.iter().take(TABLE_ROWS) {
        table.row_of(&run.name, &run.planned.choice, cells(plan, run, has_tonnes));
    }
    table
}

fn cells(plan: &StudyPlan, run: &StudyRun, has_tonnes: bool) -> Vec<Cell> {
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
    cells.push(of_tip(&|tip| grouped(tip.last().load_cycles)));
    if has_tonnes {
        let tonnes = summary.and_then(|summary| summary.million_gross_tonnes);
        cells.push(tonnes.map_or_else(missing, |tonnes| tonnage(tonnes).into()));
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

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
    let judged: Vec<Judged> = all.iter().map(Judged::of).collect();
    let shown = ShownColumns::of(&judged);
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
    for (run, judged) in all.iter().zip(judged).take(TABLE_ROWS) {
        table.row_of(&run.name, &run.planned.choice, cells(plan, run, judged, shown));
    }
    table
}

/// Conclusions from a run, as far as there are any.
struct Judged<'a> {
    /// Million gross tonnes.
    tonnes: Option<f64>,
    /// The inspection interval, million gross tonnes.
    interval: Option<f64>,
    verdict: Option<&'a Verdict>,
    /// How it fails, and when.
    failure: Option<String>,
}

impl<'a> Judged<'a> {
    fn of(run: &'a StudyRun) -> Self {
        let summary = run.row.summary.as_ref();
        let decision = summary.and_then(|summary| summary.decision.as_ref());
        let failure = decision.and_then(|decision| decision.failure.mode.zip(decision.failure.mgt));
        Self {
            tonnes: summary.and_then(|summary| summary.million_gross_tonnes),
            interval: decision.and_then(|decision| decision.inspection.as_ref()?.interval_mgt),
            verdict: verdict(run),
            failure: failure.map(|(mode, mgt)| format!("{}, {} MGT", mode.words(), tonnage(mgt))),
        }
    }
}

/// Which columns some run fills.
#[derive(Debug, Clone, Copy)]
struct ShownColumns {
    tonnes: bool,
    interval: bool,
    verdict: bool,
    failure: bool,
}

impl ShownColumns {
    fn of(judged: &[Judged]) -> Self {
        let any = |has: fn(&Judged) -> bool| judged.iter().any(has);
        Self {
            tonnes: any(|run| run.tonnes.is_some()),
            interval: any(|run| run.interval.is_some()),
            verdict: any(|run| run.verdict.is_some()),
            failure: any(|run| run.failure.is_some()),
        }
    }
}

/// The verdict on a run.
pub(super) fn verdict<'a>(run: &'a StudyRun) -> Option<&'a Verdict> {
    run.row.summary.as_ref()?.verdict.as_ref()
}

fn cells(plan: &StudyPlan, run: &StudyRun, judged: Judged, shown: ShownColumns) -> Vec<Cell> {
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
        cells.push(judged.tonnes.map_or_else(missing, |tonnes| tonnage(tonnes).into()));
    }
    if shown.interval {
        cells.push(judged.interval.map_or_else(missing, |mgt| tonnage(mgt).into()));
    }
    if shown.verdict {
        cells.push(judged.verdict.map_or_else(missing, |verdict| verdict.level.word().into()));
        cells.push(judged.verdict.map_or_else(missing, |verdict| verdict.kinds().into()));
    }
    if shown.failure {
        cells.push(judged.failure.map_or_else(missing, Cell::from));
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

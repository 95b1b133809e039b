//! The page of a study.

mod charts;
mod facts;
mod runs;
mod styles;

use crate::direction::{Heading, heading};
use crate::{Block, Page, Section};
use railcrack_run::representative::RepresentativeTip;
use railcrack_run::study::{PlannedRun, StudyPlan, StudyRow};
use styles::Styles;

/// Runs of a study on its charts; of more, evenly chosen ones.
const MOST_SHOWN: usize = 150;
/// Runs up to which the table stands above the charts.
const SHORT_TABLE: usize = 12;

/// A run with its place in the plan.
struct StudyRun<'a> {
    planned: &'a PlannedRun,
    row: &'a StudyRow,
    /// `run 3: friction 0.4, angle_deg 15`, also the name of its curves.
    name: String,
}

impl<'a> StudyRun<'a> {
    fn tip(&self) -> Option<&'a RepresentativeTip> {
        self.row.representative.as_ref()
    }

    fn number(&self) -> usize {
        self.planned.number
    }

    /// Where the tip that stands for the run is heading.
    fn heading(&self) -> Option<Heading> {
        let (tip, summary) = (self.tip()?, self.row.summary.as_ref()?);
        let crack = summary.cracks.get(tip.first.crack.checked_sub(1)?)?;
        heading(crack, &tip.rows.iter().collect::<Vec<_>>())
    }
}

/// The page of the study `plan` with the runs `rows`; `study` is its file, `pictures` (file name and SVG) are its plots, for readers
/// without scripts.
pub(crate) fn study_page(
    plan: &StudyPlan,
    rows: &[StudyRow],
    study: &str,
    pictures: &[(&'static str, String)],
) -> Page {
    let run = |(planned, row)| StudyRun { planned, row, name: name(plan, planned) };
    let all: Vec<StudyRun> = plan.runs.iter().zip(rows).map(run).collect();
    let styles = Styles::new(plan);
    let mut lead = Vec::new();
    let warnings = facts::warnings(&all);
    if !warnings.is_empty() {
        lead.push(Block::Warnings(warnings));
    }
    let table = Block::Table(runs::table(plan, &all));
    let mut together = vec![Block::Choices(styles.choices())];
    let charts = charts::charts(plan, &all, &styles, pictures);
    if all.len() <= SHORT_TABLE {
        together.push(table);
        together.extend(charts);
    } else {
        together.extend(charts);
        together.push(table);
    }
    Page {
        title: plan.title.clone(),
        kind: "Parametric study".to_owned(),
        verdict: facts::verdict(plan, &all),
        facts: facts::facts(plan, &all),
        lead,
        sections: vec![
            Section { id: "runs".to_owned(), heading: "All runs".to_owned(), blocks: together },
            Section {
                id: "study".to_owned(),
                heading: "Study".to_owned(),
                blocks: vec![Block::Folded {
                    heading: "The study file".to_owned(),
                    blocks: vec![Block::Verbatim(study.to_owned())],
                }],
            },
        ],
    }
}

/// The values of a run: `friction 0.4, angle_deg 15`.
fn values(plan: &StudyPlan, run: &PlannedRun) -> String {
    let values = plan.values_of(run).map(|(key, value)| format!("{} {value}", key.name));
    values.collect::<Vec<_>>().join(", ")
}

fn name(plan: &StudyPlan, run: &PlannedRun) -> String {
    format!("run {}: {}", run.number, values(plan, run))
}

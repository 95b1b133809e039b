//! The report of a parametric study.

mod charts;
mod facts;
mod many;
mod population;
mod runs;
mod warnings;

use crate::figures::{MANY, StudyRun, Styles};
use crate::page::{Block, Page, Section};
use crate::pages::described::file_section;
use railcrack_run::study::{Population, StudyPlan};

/// Maximum number of runs for which the table precedes the charts.
const SHORT_TABLE: usize = 12;

/// The page of the study `plan` with the samples between its `runs`; `study` is the text of its
/// file.
pub(crate) fn study_page(
    (plan, populations): (&StudyPlan, &[Population]),
    runs: &[StudyRun],
    styles: &Styles,
    study: &str,
) -> Page {
    let decision = population::blocks(populations);
    if runs.len() > MANY {
        return page(plan, runs, study, decision, many::blocks(plan, runs));
    }
    let table = Block::Table(runs::table(plan, runs));
    let mut together = vec![Block::Choices(styles.choices())];
    let charts = charts::charts(plan, runs, styles);
    if runs.len() <= SHORT_TABLE {
        together.push(table);
        together.extend(charts);
    } else {
        together.extend(charts);
        together.push(table);
    }
    page(plan, runs, study, decision, together)
}

/// The page with the `decision`, and what it shows of all runs `together`.
fn page(
    plan: &StudyPlan,
    runs: &[StudyRun],
    study: &str,
    decision: Vec<Block>,
    together: Vec<Block>,
) -> Page {
    let warnings = warnings::warnings(runs);
    let mut lead = if warnings.is_empty() { Vec::new() } else { vec![Block::Warnings(warnings)] };
    lead.extend(warnings::verdicts(runs).map(Block::Table));
    lead.extend(decision);
    Page {
        title: plan.title.clone(),
        kind: "Parametric study".to_owned(),
        decision: None,
        verdict: facts::verdict(plan, runs),
        facts: facts::facts(plan, runs),
        lead,
        sections: vec![
            Section::new("runs", "All runs", together),
            file_section("study", "Study", "The study file".to_owned(), study),
        ],
    }
}

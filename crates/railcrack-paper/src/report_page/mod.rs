//! The report of the recomputed paper.

mod figures;
mod statements;

use crate::closest::closest;
use crate::document::{PaperRecord, SetupRecord};
use railcrack_report::{
    AtFirst, Block, Choice, ChoiceGroup, ChoiceMark, Choices, CurveLook, Fact, Page, Section, Table,
};
use railcrack_run::OutputError;
use std::path::Path;

/// The page of the results in `folder`.
///
/// Errors: no such results in the folder; a file of it is damaged; the system refuses.
pub(crate) fn paper_page(folder: &Path) -> Result<Page, OutputError> {
    let record = PaperRecord::read(folder)?;
    let mut lead = Vec::new();
    if !record.failures.is_empty() {
        let text = |failure: &crate::document::FailureRecord| {
            let dot = if failure.reason.ends_with('.') { "" } else { "." };
            format!("The run {} ended early: {}{dot}", failure.run, failure.reason)
        };
        lead.push(Block::Warnings(record.failures.iter().map(text).collect()));
    }
    lead.push(Block::Text(
        "The paper does not specify several inputs that its results depend on: the supports of its block, whether the cracks lean along the travel or \
         against it, the sign of the wheel–rail friction, the load steps. Each statement of its text is therefore decided in several \
         set-ups, by a rule. Statements and the few numbers in the text are compared, not the curves of its figures."
            .to_owned(),
    ));
    lead.extend(closest(&record).map(Block::Text));
    let mut figures = vec![Block::Choices(choices(&record.setups))];
    figures.extend(figures::blocks(folder, &record)?);
    let mut sections = Vec::new();
    if !record.statements.is_empty() {
        sections.push(Section {
            id: "statements".to_owned(),
            heading: "Statements".to_owned(),
            blocks: statements::blocks(&record),
        });
    }
    sections.push(Section { id: "figures".to_owned(), heading: "Figures".to_owned(), blocks: figures });
    sections.push(Section {
        id: "setups".to_owned(),
        heading: "Set-ups".to_owned(),
        blocks: vec![Block::Table(setups(&record.setups))],
    });
    Ok(Page {
        decision: None,
        title: "The paper, recomputed".to_owned(),
        kind: "Trollé, Baietto, Gravouil, Mai & Prabel, Eng. Fract. Mech. 123 (2014) 163–181".to_owned(),
        verdict: statements::verdict(&record),
        facts: facts(&record),
        lead,
        sections,
    })
}

fn facts(record: &PaperRecord) -> Vec<Fact> {
    let fact = |name: &str, value: usize, note: &str| Fact {
        name: name.to_owned(),
        value: value.to_string(),
        note: note.to_owned(),
    };
    let [everywhere, somewhere, nowhere] = statements::counts(record);
    vec![
        fact("Statements", record.statements.len(), "of the text, each with a rule"),
        fact("Hold", everywhere, "in all main set-ups that decide them"),
        fact("Hold in some", somewhere, "main set-ups, or in variants only"),
        fact("Do not hold", nowhere, "in any set-up"),
        fact("Figures", record.figures.len(), "with tables of their numbers"),
        fact("Runs", record.runs, &format!("in {} set-ups", record.setups.len())),
    ]
}

/// Looks of the main set-ups.
const LOOKS: [CurveLook; 4] =
    [CurveLook::Line, CurveLook::FineDashed, CurveLook::Dashed, CurveLook::DashDotted];

/// The look of the curves of the set-up at `index`, which no other one has: plain for the main
/// set-ups, a varied pattern for the variants.
fn look(setups: &[SetupRecord], index: usize) -> CurveLook {
    let is_variant = |setup: &SetupRecord| setup.varies.is_some();
    let before = setups.iter().take(index).filter(|setup| is_variant(setup)).count();
    match setups.get(index).is_some_and(is_variant) {
        true => CurveLook::Varied(u8::try_from(before).unwrap_or(u8::MAX)),
        false => LOOKS[(index - before) % LOOKS.len()],
    }
}

/// A text of the paper's table with its symbols set: `K_II` as `K_{II}`.
fn symbols(text: &str) -> String {
    text.replace("K_II", "K_{II}").replace("K_I", "K_{I}")
}

fn choices(setups: &[SetupRecord]) -> Choices {
    let choice = |(i, setup): (usize, &SetupRecord)| Choice {
        name: setup.name.clone(),
        mark: ChoiceMark::Look(look(setups, i)),
        // One, so that the figures can be read.
        at_first: if i == 0 { AtFirst::Shown } else { AtFirst::Hidden },
    };
    Choices {
        groups: vec![ChoiceGroup {
            name: "Set-ups".to_owned(),
            values: setups.iter().enumerate().map(choice).collect(),
        }],
    }
}

fn setups(setups: &[SetupRecord]) -> Table {
    let mut table = Table::new(["Set-up", "Description", "Varies"]);
    for setup in setups {
        table.row([setup.name.clone(), setup.words.clone(), setup.varies.clone().unwrap_or_default()]);
    }
    table
}

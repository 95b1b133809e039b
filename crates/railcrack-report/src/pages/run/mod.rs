//! The page of a growth run: of cracks in the plane, of a row of them, of cracks in space.

mod assumptions;
mod crack_feedback;
mod curves;
mod data;
mod decision;
mod events;
mod facts;
mod fields;
mod front_data;
mod front_wheels;
mod fronts;
mod lengths;
mod passage;
mod plane;
mod rail_bending;
mod row_map;
mod stored;
mod tiles;
mod traffic;
mod warnings;
mod wheels;

use super::approval::approval;
use super::described::{case_section, described};
use super::what_if;
use crate::engine::PageEngine;
use crate::figures::Plot;
use crate::page::{Block, Fact, Page, Section};
use crate::page_data::PageData;
use crate::table::Table;
use railcrack_run::VERSION;
use railcrack_run::description::Subject;

pub(crate) use stored::RunFolder;

/// Controls of a passage.
const EXPLORER: &str = include_str!("../../assets/passage.html");
/// Introduction of the part that computes.
const WHAT_IF: &str = "Recomputed here and now, in this browser, from the case of this run: nothing below is a result of the run folder. Move a slider or edit the case file; the dashed curves are those of the run.";
/// Maximum number of rows of the table of steps; `growth.csv` has all.
const TABLE_ROWS: usize = 500;

/// The parts of the page about the cracks of a run, in the plane or in space.
struct RunParts {
    kind: &'static str,
    /// The main result in one or two sentences.
    verdict: String,
    facts: Vec<Fact>,
    /// Growth, before the decision.
    growth: Vec<Block>,
    /// Tables, after the decision.
    tables: Vec<Block>,
    assumptions: Vec<String>,
    sections: Vec<Section>,
}

/// The page of a run with what it shows of the long tables and its `plots`; with `engine` it
/// computes.
pub(crate) fn run_page(
    run: &RunFolder,
    page_data: &PageData,
    plots: &[Plot],
    engine: Option<&PageEngine>,
) -> Page {
    let parts = match run.case.space() {
        Some(space) => fronts::parts(run, space, page_data, plots),
        None => plane::parts(run, page_data, plots),
    };
    let warnings = warnings::warnings(run);
    let warnings: Vec<Block> =
        (!warnings.is_empty()).then_some(Block::Warnings(warnings)).into_iter().collect();
    let mut lead: Vec<Block> = decision::decision(run);
    if run.is_signed() {
        // The first printed sheet is signed; what the answer hangs on is part of it.
        lead.extend(parts.growth.into_iter().chain(inputs(run)));
        let caption = format!("Computed with railcrack {VERSION} from the case below");
        lead.push(Block::Approval(approval(caption)));
        lead.extend(warnings);
    } else {
        lead.extend(warnings.into_iter().chain(parts.growth));
    }
    lead.extend(decision::tables(run));
    lead.extend(parts.tables);
    lead.push(Block::Heading("Assumptions".to_owned()));
    lead.push(Block::List(parts.assumptions));
    let mut sections = parts.sections;
    sections.extend(engine.map(|engine| what_if::section(engine, &run.text, "this run", WHAT_IF)));
    sections.push(case_section(&run.text));
    Page {
        title: run.summary.title.clone(),
        kind: parts.kind.to_owned(),
        decision: decision::banner(run),
        verdict: parts.verdict,
        facts: tiles::of_page(run, parts.facts),
        lead,
        sections,
    }
}

/// The inputs that matter most to the answer: wheels and cracks.
fn inputs(run: &RunFolder) -> [Block; 2] {
    let paragraphs = described(&run.case, &[Subject::Wheels, Subject::Cracks]);
    [Block::Heading("Inputs".to_owned()), Block::List(paragraphs)]
}

/// The growth steps, of which `table` has the first rows.
fn steps_section(run: &RunFolder, mut table: Table) -> Section {
    table.caption = "State at the start of each growth step; ranges over the stabilised passage".to_owned();
    if run.growth.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of growth.csv"));
    }
    let heading = format!("{} rows", run.growth.len().min(TABLE_ROWS));
    Section::new(
        "steps",
        "All growth steps",
        vec![Block::Folded { heading, blocks: vec![Block::Table(table)] }],
    )
}

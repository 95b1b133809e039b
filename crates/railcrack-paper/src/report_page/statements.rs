//! The statements with their verdicts and numbers.

use super::symbols;
use crate::document::{DecisionRecord, PaperRecord, SetupRecord, StatementRecord};
use railcrack_report::MISSING;
use railcrack_report::significant;
use railcrack_report::{Block, Table};

/// Columns of numbers of a statement beyond which they become rows.
const MOST_COLUMNS: usize = 6;

fn is_main(setup: &SetupRecord) -> bool {
    setup.varies.is_none()
}

/// How many statements hold in all main set-ups that decide them, in some set-up, in none.
pub(super) fn counts(record: &PaperRecord) -> [usize; 3] {
    let mut counts = [0; 3];
    for statement in &record.statements {
        let main = record.setups.iter().filter(|setup| is_main(setup));
        let main: Vec<bool> =
            main.filter_map(|setup| Some(decision(statement, &setup.name)?.holds)).collect();
        let place = if !main.is_empty() && main.iter().all(|holds| *holds) {
            0
        } else if statement.decisions.iter().any(|decision| decision.holds) {
            1
        } else {
            2
        };
        counts[place] += 1;
    }
    counts
}

fn decision<'a>(statement: &'a StatementRecord, setup: &str) -> Option<&'a DecisionRecord> {
    statement.decisions.iter().find(|decision| decision.setup == setup)
}

/// The result in a sentence.
pub(super) fn verdict(record: &PaperRecord) -> String {
    if record.statements.is_empty() {
        return "The chosen figures decide no statement of the paper by themselves.".to_owned();
    }
    let [everywhere, somewhere, nowhere] = counts(record);
    format!(
        "Of {} statements of the paper, {everywhere} hold in every main set-up that decides them, {somewhere} in some set-ups only, \
         {nowhere} in none.",
        record.statements.len()
    )
}

/// How many of the statements that a set-up can decide hold in it.
pub(super) fn by_setup(record: &PaperRecord) -> Table {
    let mut table = Table::new(["Set-up", "Statements that hold", "Statements decided"]);
    for setup in record.setups.iter().filter(|setup| is_main(setup)) {
        let decided = || record.statements.iter().filter_map(|statement| decision(statement, &setup.name));
        let holding = decided().filter(|decision| decision.holds).count();
        table.row([setup.name.clone(), holding.to_string(), decided().count().to_string()]);
    }
    table
}

/// A table of all, then each with its rule and its numbers.
pub(super) fn blocks(record: &PaperRecord) -> Vec<Block> {
    let main: Vec<&SetupRecord> = record.setups.iter().filter(|setup| is_main(setup)).collect();
    let mut headings = vec!["Statement".to_owned(), "Where".to_owned()];
    headings.extend(main.iter().map(|setup| setup.name.clone()));
    headings.extend(["Verdict", "Why"].map(str::to_owned));
    let mut table = Table::new(headings);
    table.caption =
        "With: the cracks lean along the travel of the wheel; against: they lean against it".to_owned();
    for statement in &record.statements {
        let mut cells = vec![symbols(&statement.statement), place(statement)];
        cells.extend(main.iter().map(|setup| says(decision(statement, &setup.name)).to_owned()));
        cells.extend([statement.verdict.clone(), symbols(&statement.why)]);
        table.row(cells);
    }
    let mut blocks = vec![
        Block::Table(table),
        Block::Heading("Rules and numbers".to_owned()),
        Block::Text("K in MPa√m, depths in mm; unrounded in claims.csv.".to_owned()),
    ];
    blocks.extend(record.statements.iter().map(|statement| Block::Folded {
        heading: format!("{} ({}): {}", statement.id, place(statement), statement.verdict),
        blocks: vec![
            Block::Text(symbols(&statement.statement)),
            Block::Text(format!("Rule: {}.", symbols(statement.rule.trim_end_matches('.')))),
            Block::Table(numbers(statement)),
        ],
    }));
    blocks
}

/// Where the paper says it: `§ 5.1, Fig. 14b`.
fn place(statement: &StatementRecord) -> String {
    let sign = if statement.place.starts_with(|letter: char| letter.is_ascii_digit()) { "§ " } else { "" };
    format!("{sign}{}", statement.place)
}

fn says(decision: Option<&DecisionRecord>) -> &'static str {
    decision.map_or(MISSING, |decision| if decision.holds { "yes" } else { "no" })
}

/// The numbers of a statement: a row per set-up; with many numbers, a row per number.
fn numbers(statement: &StatementRecord) -> Table {
    let mut names: Vec<&str> = Vec::new();
    for number in statement.decisions.iter().flat_map(|decision| &decision.numbers) {
        if !names.contains(&number.name.as_str()) {
            names.push(&number.name);
        }
    }
    let value = |decision: &DecisionRecord, name: &str| {
        let number = decision.numbers.iter().find(|number| number.name == name);
        number.map_or_else(String::new, |n| n.value.map_or_else(|| MISSING.to_owned(), significant))
    };
    let yes_or_no = |decision: &DecisionRecord| says(Some(decision)).to_owned();
    if names.len() <= MOST_COLUMNS {
        let mut headings = vec!["Set-up".to_owned(), "Holds".to_owned()];
        headings.extend(names.iter().map(|name| symbols(name)));
        let mut table = Table::new(headings);
        for decision in &statement.decisions {
            let mut cells = vec![decision.setup.clone(), yes_or_no(decision)];
            cells.extend(names.iter().map(|name| value(decision, name)));
            table.row(cells);
        }
        return table;
    }
    let setups = statement.decisions.iter().map(|decision| decision.setup.as_str());
    let mut table = Table::new(std::iter::once("Number").chain(setups));
    table.row(std::iter::once("holds".to_owned()).chain(statement.decisions.iter().map(yes_or_no)));
    for name in names {
        let values = statement.decisions.iter().map(|decision| value(decision, name));
        table.row(std::iter::once(symbols(name)).chain(values));
    }
    table
}

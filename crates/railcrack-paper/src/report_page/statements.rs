//! The statements with their verdicts and numbers.

use super::symbols;
use crate::document::{DecisionRecord, PaperRecord, SetupRecord, StatementRecord};
use railcrack_report::{Block, Cell, CellTone, MISSING, Table, significant};

/// Columns of numbers of a statement beyond which they become rows.
const MOST_COLUMNS: usize = 6;

/// How many statements hold in all main set-ups that decide them, in some set-up, in none.
pub(super) fn counts(record: &PaperRecord) -> [usize; 3] {
    let mut counts = [0; 3];
    for statement in &record.statements {
        let main: Vec<bool> =
            record.main_setups().filter_map(|setup| Some(statement.decision(&setup.name)?.holds)).collect();
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

/// The result in a sentence.
pub(super) fn verdict(record: &PaperRecord) -> String {
    if record.statements.is_empty() {
        return "The selected figures alone decide no statement of the paper.".to_owned();
    }
    let [everywhere, somewhere, nowhere] = counts(record);
    format!(
        "Of {} statements of the paper, {everywhere} hold in every main set-up that decides them, {somewhere} in some set-ups only, \
         {nowhere} in none. A statement that depends on the set-up depends on what the paper leaves open, such as supports and \
         increments; it does not measure the program, whose accuracy against theory and independent programs is in its page on \
         verification.",
        record.statements.len()
    )
}

/// The matrix of statements and main set-ups, that of all set-ups, then each statement with its
/// rule and its numbers.
pub(super) fn blocks(record: &PaperRecord) -> Vec<Block> {
    let main: Vec<&SetupRecord> = record.main_setups().collect();
    let mut table =
        matrix(record, &main, &["Statement", "Where"], &["Reason for differences"], |statement| {
            (vec![symbols(&statement.statement), place(statement)], vec![symbols(&statement.why)])
        });
    table.caption = "In the order of the paper. Along: the cracks lean along the travel of the wheel; against: they lean against it. \
                     *: a contributing run has warnings"
        .to_owned();
    let all: Vec<&SetupRecord> = record.setups.iter().collect();
    let variants = matrix(record, &all, &["Statement"], &[], |statement| {
        (vec![format!("{} ({})", statement.id, place(statement))], Vec::new())
    });
    let mut blocks = vec![
        Block::Table(table),
        Block::Folded { heading: "All set-ups".to_owned(), blocks: vec![Block::Table(variants)] },
        Block::Heading("Rules and numbers".to_owned()),
        Block::Text("K in MPa√m, depths in mm; unrounded values are in claims.csv.".to_owned()),
    ];
    blocks.extend(record.statements.iter().map(|statement| {
        let mut parts = vec![
            Block::Text(symbols(&statement.statement)),
            Block::Text(format!("Rule: {}.", symbols(statement.rule.trim_end_matches('.')))),
            Block::Table(numbers(statement)),
        ];
        let warnings = warnings(statement);
        if !warnings.is_empty() {
            parts.push(Block::Warnings(warnings));
        }
        Block::Folded {
            heading: format!("{} ({}): {}", statement.id, place(statement), statement.verdict),
            blocks: parts,
        }
    }));
    blocks
}

/// Statements by `setups`, with the cells that `beside` returns before and after the decisions.
fn matrix(
    record: &PaperRecord,
    setups: &[&SetupRecord],
    before: &[&str],
    after: &[&str],
    beside: impl Fn(&StatementRecord) -> (Vec<String>, Vec<String>),
) -> Table {
    let names = setups.iter().map(|setup| setup.name.as_str());
    let mut table = Table::new(before.iter().copied().chain(names).chain(after.iter().copied()));
    for statement in &record.statements {
        let (first, last) = beside(statement);
        let decisions = setups.iter().map(|setup| match statement.decision(&setup.name) {
            None => Cell::default(),
            Some(decision) => {
                let tone = if decision.holds { CellTone::Holds } else { CellTone::Fails };
                let mark = if decision.warnings.is_empty() { "" } else { "*" };
                Cell::toned(&format!("{}{mark}", says(decision)), tone)
            }
        });
        let first = first.into_iter().map(Cell::from);
        table.row(first.chain(decisions).chain(last.into_iter().map(Cell::from)));
    }
    table
}

/// Warnings of the runs behind a statement: each once, with the set-ups that have it.
fn warnings(statement: &StatementRecord) -> Vec<String> {
    let mut known: Vec<(&str, Vec<&str>)> = Vec::new();
    for decision in &statement.decisions {
        for warning in &decision.warnings {
            match known.iter_mut().find(|(text, _)| text == warning) {
                Some((_, setups)) => setups.push(&decision.setup),
                None => known.push((warning, vec![&decision.setup])),
            }
        }
    }
    known.iter().map(|(text, setups)| format!("{} \u{2013} {text}", setups.join("; "))).collect()
}

/// Where the paper says it: `§ 5.1, Fig. 14b`.
fn place(statement: &StatementRecord) -> String {
    let sign = if statement.place.starts_with(|letter: char| letter.is_ascii_digit()) { "§ " } else { "" };
    format!("{sign}{}", statement.place)
}

fn says(decision: &DecisionRecord) -> &'static str {
    if decision.holds { "yes" } else { "no" }
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
    let yes_or_no = |decision: &DecisionRecord| says(decision).to_owned();
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

//! The report of a comparison of two runs.

use crate::chart::Chart;
use crate::figures::{Plot, chart, lengths_of_both, steps_of_both};
use crate::numbers::{fixed, given, grouped, significant, tonnage};
use crate::page::{Block, Fact, Page, Section};
use crate::table::{MISSING, Table};
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use railcrack_run::Comparison;
use railcrack_run::compare::{SameLength, SifDifference, TipSifs};

/// Maximum number of rows of the table of tips; `compare.csv` has all.
const TABLE_ROWS: usize = 500;
/// Maximum number of curves on a chart of the page; the SVG files show all tips.
const CURVES: usize = 24;

/// The page of `comparison` with its `plots`, judged by `tolerance` (per cent of the largest |K|)
/// where there is one.
pub(crate) fn comparison_page(comparison: &Comparison, tolerance: Option<f64>, plots: &[Plot]) -> Page {
    let names = comparison.names();
    let mut lead = Vec::new();
    if !comparison.notes.is_empty() {
        lead.push(Block::Warnings(comparison.notes.clone()));
    }
    lead.push(Block::Table(runs(comparison)));
    lead.push(if comparison.case_differences.is_empty() {
        Block::Text("Both runs have the same case.".to_owned())
    } else {
        Block::Table(differences(comparison))
    });
    let mut sections = Vec::new();
    if comparison.common_steps > 0 {
        sections.push(Section::new("k", "K over the stabilised passage", k_blocks(comparison, plots)));
        sections.push(Section::new(
            "paths",
            "Paths and growth",
            vec![Block::charts(chart(plots, "paths").into_iter().chain([lengths_of_both(comparison)]))],
        ));
        let rows = comparison.tips.len().min(TABLE_ROWS);
        sections.push(Section::new(
            "steps",
            "All steps and tips",
            vec![Block::Folded {
                heading: format!("{rows} rows"),
                blocks: vec![Block::Table(tips(comparison))],
            }],
        ));
    }
    Page {
        title: format!("{} and {}", names[0], names[1]),
        kind: "Comparison of two runs".to_owned(),
        decision: None,
        verdict: verdict(comparison, tolerance),
        facts: facts(comparison, tolerance),
        lead,
        sections,
    }
}

fn verdict(comparison: &Comparison, tolerance: Option<f64>) -> String {
    let (Some(largest), Some(farthest)) = (comparison.largest_percent(), comparison.farthest()) else {
        return "The runs have no step, tip or wheel position in common, so K cannot be compared.".to_owned();
    };
    let judged = match tolerance {
        Some(tolerance) if largest <= tolerance => {
            format!(", within the tolerance of {} %", given(tolerance))
        }
        Some(tolerance) => format!(", NOT within the tolerance of {} %", given(tolerance)),
        None => String::new(),
    };
    let parting = match &comparison.parting {
        None => "the crack paths do not diverge".to_owned(),
        Some(parting) => format!(
            "the crack paths diverge in step {} at crack {}{}",
            parting.step,
            parting.crack,
            if parting.near_tie { ", a near tie of directions" } else { "" }
        ),
    };
    let life =
        comparison.life().map_or_else(String::new, |life| format!("{} ", life_sentence(comparison, &life)));
    format!(
        "{life}K differs by at most {} % of the largest |K| in the {} common steps{judged}. The tips are at most {} mm apart, and \
         {parting}.",
        significant(largest),
        comparison.common_steps,
        significant(farthest.distance)
    )
}

/// The lives of both runs, and how they compare.
fn life_sentence(comparison: &Comparison, life: &SameLength) -> String {
    let crack =
        if comparison.cracks[0].len() > 1 { format!(" of crack {}", life.crack) } else { String::new() };
    let [first, second] = [0, 1].map(|run| {
        let tonnes =
            life.million_gross_tonnes.map_or_else(String::new, |mgt| format!(" ({} MGT)", tonnage(mgt[run])));
        format!("{}{tonnes}", grouped(life.load_cycles[run]))
    });
    format!(
        "To a length{crack} of {} mm, the first run needs {first} load cycles and the second {second}, {}.",
        fixed(life.length, 2),
        ratio(life.load_cycles)
    )
}

/// The second of two lives in relation to the first.
fn ratio([first, second]: [f64; 2]) -> String {
    let times = second / first;
    if (times - 1.0).abs() < 0.1 {
        let sign = if times < 1.0 { "less" } else { "more" };
        format!("{} % {sign}", significant(100.0 * (times - 1.0).abs()))
    } else {
        format!("{} times as many", significant(times))
    }
}

fn facts(comparison: &Comparison, tolerance: Option<f64>) -> Vec<Fact> {
    let mut facts = lives(comparison);
    facts.extend(difference(comparison, "Difference of K_{I}", |sifs| sifs.ki));
    facts.extend(difference(comparison, "Difference of K_{II}", |sifs| sifs.kii));
    if let Some(tip) = comparison.farthest() {
        facts.push(Fact::new(
            "Distance between tips",
            format!("{} mm", significant(tip.distance)),
            format!("step {}, crack {}", tip.step, tip.crack),
        ));
    }
    if let Some(parting) = &comparison.parting {
        let how = format!("kinks {}° apart", fixed(parting.apart_deg, 1));
        facts.push(Fact::new("Paths diverge", format!("step {}", parting.step), how));
    }
    if let Some(tolerance) = tolerance {
        let within = comparison.largest_percent().is_some_and(|largest| largest <= tolerance);
        let note = if within { "met" } else { "not met" };
        facts.push(Fact::new("Tolerance", format!("{} %", given(tolerance)), note));
    }
    facts
}

/// The lives of both runs, to the same length and to failure.
fn lives(comparison: &Comparison) -> Vec<Fact> {
    let mut facts = Vec::new();
    let of_both = |values: [String; 2]| values.join(" and ");
    if let Some(life) = comparison.life() {
        let to = format!("to {} mm of crack {}", fixed(life.length, 2), life.crack);
        let note = format!("{to}; second: {}", ratio(life.load_cycles));
        facts.push(Fact::new("Load cycles", of_both(life.load_cycles.map(grouped)), note));
        let mgt = life.million_gross_tonnes;
        facts.extend(mgt.map(|mgt| Fact::new("Million gross tonnes", of_both(mgt.map(tonnage)), to)));
    }
    if let [Some(first), Some(second)] = comparison.runs.each_ref().map(|run| run.failure_mgt) {
        let note = format!("second: {}", ratio([first, second]));
        facts.push(Fact::new("MGT to failure", of_both([first, second].map(tonnage)), note));
    }
    facts
}

/// The largest difference of a mode.
fn difference(comparison: &Comparison, name: &str, mode: fn(TipSifs) -> SifDifference) -> Option<Fact> {
    let (tip, difference) = comparison.largest(mode)?;
    let note = format!(
        "{} MPa√m in step {}, crack {}, at x_{{c}}/a = {}",
        significant(difference.largest),
        tip.step,
        tip.crack,
        fixed(difference.xc_over_a, 2)
    );
    let percent = comparison.percent(difference.largest);
    Some(Fact::new(name, format!("{} %", significant(percent)), note))
}

fn runs(comparison: &Comparison) -> Table {
    let has_tonnes = comparison.runs.iter().any(|run| run.million_gross_tonnes.is_some());
    let mut headings = vec!["Run", "Engine", "Contact", "Boundary", "Steps", "Ended by", "Load cycles"];
    headings.extend(has_tonnes.then_some("Million gross tonnes"));
    let mut table = Table::new(headings);
    table.caption = "The runs, and how they ended".to_owned();
    for run in &comparison.runs {
        let mut cells = vec![
            run.folder.display().to_string(),
            run.engine.word().to_owned(),
            run.contact.word().to_owned(),
            run.boundary.word().to_owned(),
            run.steps_recorded.to_string(),
            run.stop.map_or("not ended", RunStop::word).replace('-', " "),
            grouped(run.load_cycles),
        ];
        if has_tonnes {
            cells.push(run.million_gross_tonnes.map_or_else(|| MISSING.to_owned(), tonnage));
        }
        table.row(cells);
    }
    table
}

fn differences(comparison: &Comparison) -> Table {
    let mut table = Table::new(["Key of the case", "First", "Second"]);
    table.caption = "Keys in which the two cases differ".to_owned();
    for difference in &comparison.case_differences {
        let [first, second] =
            difference.values.each_ref().map(|value| value.clone().unwrap_or_else(|| "–".to_owned()));
        table.row([difference.key.clone(), first, second]);
    }
    table
}

fn k_blocks(comparison: &Comparison, plots: &[Plot]) -> Vec<Block> {
    let mut blocks = Vec::new();
    for step in steps_of_both(comparison) {
        blocks.push(Block::Heading(if step == 0 {
            "Step 0, the initial cracks".to_owned()
        } else {
            format!("Step {step}, the last common one")
        }));
        let ids = ["ki", "ki-difference", "kii", "kii-difference", "ki-far", "kii-far"];
        let shown = ids.into_iter().map(|id| format!("{id}-{step}"));
        blocks.push(Block::charts(shown.filter_map(|id| chart(plots, &id)).map(|chart| {
            let curves = chart.curves.iter().take(CURVES).cloned().collect();
            Chart { curves, ..chart }
        })));
    }
    blocks
}

fn tips(comparison: &Comparison) -> Table {
    let headings = [
        "Step",
        "Crack",
        "Tip",
        "Difference of K_{I} (MPa√m)",
        "%",
        "Difference of K_{II} (MPa√m)",
        "%",
        "Distance between tips (mm)",
        "Length, first (mm)",
        "Length, second (mm)",
        "Kink, first (°)",
        "Kink, second (°)",
        "Load cycles, first",
        "Load cycles, second",
    ];
    let mut table = Table::new(headings);
    table.caption =
        "Largest differences over the passage, in per cent of the largest |K| of the step".to_owned();
    if comparison.tips.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of compare.csv"));
    }
    let angle = |angle: Option<f64>| angle.map_or_else(String::new, |angle| fixed(angle, 1));
    for tip in comparison.tips.iter().take(TABLE_ROWS) {
        let mode = |largest: Option<f64>| {
            largest.map_or([String::new(), String::new()], |k| [significant(k), fixed(tip.percent(k), 3)])
        };
        let [ki, ki_percent] = mode(tip.sifs().map(|sifs| sifs.ki.largest));
        let [kii, kii_percent] = mode(tip.sifs().map(|sifs| sifs.kii.largest));
        table.row([
            tip.step.to_string(),
            tip.crack.to_string(),
            tip.tip.to_string(),
            ki,
            ki_percent,
            kii,
            kii_percent,
            significant(tip.distance),
            fixed(tip.lengths[0], 3),
            fixed(tip.lengths[1], 3),
            angle(tip.kink_deg[0]),
            angle(tip.kink_deg[1]),
            grouped(tip.load_cycles[0]),
            grouped(tip.load_cycles[1]),
        ]);
    }
    table
}

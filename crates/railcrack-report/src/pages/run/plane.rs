//! Cracks in the plane on the page of a run: growth, passage, tables.

use super::{
    RunParts, assumptions, crack_feedback, curves::curves, data, decision, events, facts, fields, lengths,
    passage, rail_bending, row_map, steps_section, stored::RunFolder, traffic, warnings,
};
use crate::chart::{Chart, ChartAxis};
use crate::figures::{Plot, chart};
use crate::numbers::{fixed, grouped, significant, tonnage};
use crate::page::{Block, Section};
use crate::page_data::PageData;
use crate::row::{CrackRow, NamedCrack, is_many, named};
use crate::table::Table;
use railcrack_run::csv::TipRow;

const EXPLORER_SCRIPT: &str = include_str!("../../assets/run.js");
/// Maximum number of columns of a table with a chart to its right, also in print.
const BESIDE_COLUMNS: usize = 5;

/// The parts of the page of `run` about cracks in the plane.
pub(super) fn parts(run: &RunFolder, page_data: &PageData, plots: &[Plot]) -> RunParts {
    let row =
        is_many(run.summary.cracks.len()).then(|| CrackRow::of(&run.summary.cracks, &run.growth)).flatten();
    let named: Option<Vec<NamedCrack>> = row.as_ref().map(named);
    let named = named.as_deref();
    let lengths = lengths::lengths(run, named);
    let mut by_cycles = chart(plots, "length-cycles").filter(|_| lengths.is_some());
    let depths = traffic::depth_by_tonnage(run, named).map(|depths| match decision::sensitivities(run) {
        Some(table) => Block::Beside(vec![Block::Table(table), Block::Chart(depths)]),
        None => Block::charts([depths].into_iter().chain(by_cycles.take())),
    });
    let mut after = match (lengths, by_cycles) {
        // A table of many cracks needs the whole width.
        (Some(table), Some(chart)) if table.headings.len() <= BESIDE_COLUMNS => {
            vec![Block::Beside(vec![Block::Table(table), Block::charts([chart])])]
        }
        (table, chart) => {
            let chart = chart.map(|chart| Block::charts([chart]));
            table.map(Block::Table).into_iter().chain(chart).collect()
        }
    };
    if row.is_none() {
        after.extend(facts::cracks(run).map(Block::Table));
    }
    after.extend(events::table(run).map(Block::Table));
    let mut sections = Vec::new();
    if run.summary.steps_recorded > 0 {
        sections.extend(row.as_ref().zip(named).map(|(row, named)| row_map::section(run, row, named, plots)));
        sections.push(explorer(run, page_data, named, plots));
        sections.extend(rail_bending::section(run, plots));
        sections.extend(water(plots));
        sections.extend(crack_feedback::section(run, page_data));
        sections.extend(fields::section(page_data));
        sections.push(growth(run, named, warnings::remarks(run, page_data, named)));
        sections.push(steps(run));
    }
    RunParts {
        kind: "Crack growth under rolling contact",
        verdict: facts::verdict(run),
        facts: facts::facts(run, warnings::count(run)),
        growth: depths.into_iter().collect(),
        tables: after,
        assumptions: assumptions::assumptions(run),
        sections,
    }
}

/// The passage of every wheel.
fn explorer(run: &RunFolder, page_data: &PageData, named: Option<&[NamedCrack]>, plots: &[Plot]) -> Section {
    let viewer = Block::Viewer {
        id: "explorer",
        html: super::EXPLORER,
        blocks: passage::charts(run, page_data, named, plots),
        data_id: "run-data",
        data: data::explorer(run, page_data, named),
        script: EXPLORER_SCRIPT,
    };
    Section::new("passage", "Passage of the wheel", vec![viewer])
}

/// Pressure and volume of the fluid in the cracks; none of dry ones.
fn water(plots: &[Plot]) -> Option<Section> {
    let charts: Vec<Chart> =
        ["fluid-pressure", "fluid-volume"].into_iter().filter_map(|id| chart(plots, id)).collect();
    (!charts.is_empty()).then(|| Section::new("water", "Fluid in the cracks", vec![Block::charts(charts)]))
}

fn growth(run: &RunFolder, named: Option<&[NamedCrack]>, remarks: Vec<String>) -> Section {
    let mut blocks = Vec::new();
    if run.summary.steps_recorded > 1 {
        let chart = |id: &str, caption: &str, x: ChartAxis, point: fn(&TipRow) -> [f64; 2]| Chart {
            id: id.to_owned(),
            caption: caption.to_owned(),
            x,
            y: ChartAxis::logarithmic("da/dN", "mm/cycle"),
            curves: curves(run, named, point),
            ..Chart::default()
        };
        let by_length = chart(
            "rate-length",
            "Growth rate against crack length.",
            ChartAxis::linear("Crack length", "mm"),
            |row| [row.length, row.rate],
        );
        blocks.push(Block::charts([by_length].into_iter().chain(traffic::rate_by_depth(run))));
    }
    if !remarks.is_empty() {
        blocks.push(Block::List(remarks));
    }
    Section::new("growth", "Growth", blocks)
}

fn steps(run: &RunFolder) -> Section {
    let load = run.case.axle_load;
    let mut headings = vec![
        "Step",
        "Crack",
        "Tip",
        "Length (mm)",
        "x (mm)",
        "Depth (mm)",
        "ΔK_{I} (MPa√m)",
        "ΔK_{II} (MPa√m)",
        "ΔK_{eq} (MPa√m)",
        "Kink (°)",
        "Secondary maximum (°)",
        "Ratio to the main maximum",
        "Rate (mm/cycle)",
        "Load cycles",
    ];
    if load.is_some() {
        headings.push("Million gross tonnes");
    }
    headings.push("Stop");
    let mut table = Table::new(headings);
    let degrees = |angle: Option<f64>| angle.map_or_else(String::new, |angle| fixed(angle, 1));
    for row in run.growth.iter().take(super::TABLE_ROWS) {
        let mut cells = vec![
            row.step.to_string(),
            row.crack.to_string(),
            row.tip.to_string(),
            fixed(row.length, 3),
            fixed(row.place[0], 3),
            fixed(-row.place[1], 3),
            fixed(row.delta_ki, 3),
            fixed(row.delta_kii, 3),
            fixed(row.delta_keq, 3),
            degrees(row.kink_deg),
            degrees(row.rival_deg),
            row.rival_ratio.map_or_else(String::new, |ratio| fixed(ratio, 3)),
            significant(row.rate),
            grouped(row.load_cycles),
        ];
        cells.extend(load.map(|load| tonnage(row.load_cycles * load / 1e6)));
        cells.push(facts::stop_of(run, row));
        table.row(cells);
    }
    steps_section(run, table)
}

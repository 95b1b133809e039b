//! The page of a growth run.

mod around;
mod assumptions;
mod data;
mod decision;
mod events;
mod facts;
mod far;
mod lengths;
mod lips;
mod row;
mod stored;
mod warnings;
mod wheels;

use super::pictures::still;
use super::what_if;
use crate::chart::{Chart, ChartAxis, Curve, CurveColour, CurveDots, CurveLook};
use crate::engine::PageEngine;
use crate::figures::{Plot, bundle, chart};
use crate::numbers::{fixed, given, grouped, significant, tonnage};
use crate::page::{Block, Page, Section};
use crate::row::{CrackRow, NamedCrack, is_many, named};
use crate::shown::ShownRun;
use crate::table::Table;
use railcrack_run::csv::TipRow;
use railcrack_run::decision::Quantiles;
use railcrack_run::files::CASE_FILE;
use serde_json::Value;

pub(super) use assumptions::long_rail;
pub(super) use decision::{banner, decision};
pub(super) use facts::{ending, stop_of, stop_sentence};
pub(crate) use stored::RunFolder;
pub(super) use warnings::{count as warning_count, warnings};
pub(super) use wheels::passage_of;

const EXPLORER: &str = include_str!("../../assets/run.html");
const EXPLORER_SCRIPT: &str = include_str!("../../assets/run.js");
/// Introduction of the part that computes.
const WHAT_IF: &str = "Recomputed here and now, in this browser, from the case of this run: nothing below is a result of the run folder. Move a slider or edit the case file; the dashed curves are those of the run.";
/// Maximum number of columns of a table with a chart to its right, also in print.
const BESIDE_COLUMNS: usize = 5;
/// Maximum number of rows of the table of steps; `growth.csv` has all.
const TABLE_ROWS: usize = 500;

/// The page of a run with its long tables `shown` and its `plots`; with `engine` it computes.
pub(crate) fn run_page(
    run: &RunFolder,
    shown: &ShownRun,
    plots: &[Plot],
    engine: Option<&PageEngine>,
) -> Page {
    let warnings = warnings(run);
    let row =
        is_many(run.summary.cracks.len()).then(|| CrackRow::of(&run.summary.cracks, &run.growth)).flatten();
    let told: Option<Vec<NamedCrack>> = row.as_ref().map(named);
    let told = told.as_deref();
    let mut page = Page {
        title: run.summary.title.clone(),
        kind: "Crack growth under rolling contact".to_owned(),
        decision: decision::banner(run),
        verdict: facts::verdict(run),
        facts: facts::facts(run, warnings::count(run)),
        lead: Vec::new(),
        sections: Vec::new(),
    };
    if !warnings.is_empty() {
        page.lead.push(Block::Warnings(warnings));
    }
    let lengths = lengths::lengths(run, told);
    let mut by_cycles = chart(plots, "length-cycles").filter(|_| lengths.is_some());
    if let Some(depths) = depth_by_tonnage(run, told) {
        page.lead.push(Block::charts([depths].into_iter().chain(by_cycles.take())));
    }
    page.lead.extend(decision::decision(run));
    match (lengths, by_cycles) {
        // A table of many cracks needs the whole width.
        (Some(table), Some(chart)) if table.headings.len() <= BESIDE_COLUMNS => {
            page.lead.push(Block::Beside(vec![Block::Table(table), Block::charts([chart])]));
        }
        (table, chart) => {
            page.lead.extend(table.map(Block::Table));
            page.lead.extend(chart.map(|chart| Block::charts([chart])));
        }
    }
    if row.is_none() {
        page.lead.extend(facts::cracks(run).map(Block::Table));
    }
    page.lead.extend(events::table(run).map(Block::Table));
    page.lead.push(Block::Heading("Assumptions".to_owned()));
    page.lead.push(Block::List(assumptions::assumptions(run)));
    if run.summary.steps_recorded > 0 {
        if let Some((row, told)) = row.as_ref().zip(told) {
            page.sections.push(row::section(run, row, told, plots));
        }
        page.sections.push(explorer(
            data::explorer(run, shown, told),
            told,
            run.case.mix.first().map(|mixed| mixed.name.as_str()),
            plots,
        ));
        page.sections.extend(far::section(run, plots));
        page.sections.extend(water(plots));
        page.sections.extend(lips::section(run, shown));
        page.sections.extend(around::section(shown));
        page.sections.push(growth(run, told, warnings::remarks(run, shown, told)));
        page.sections.push(steps(run));
    }
    page.sections.extend(engine.map(|engine| what_if::section(engine, &run.text, "this run", WHAT_IF)));
    page.sections.push(case_section(run));
    page
}

/// The case of the run.
pub(super) fn case_section(run: &RunFolder) -> Section {
    Section {
        id: "case".to_owned(),
        heading: "Case".to_owned(),
        blocks: vec![Block::Folded {
            heading: format!("{CASE_FILE}, defaults filled in"),
            blocks: vec![Block::Verbatim(run.text.clone())],
        }],
    }
}

/// The passage of every wheel; pictures for readers without scripts are those under the `first`
/// wheel of a mix.
fn explorer(data: Value, told: Option<&[NamedCrack]>, first: Option<&str>, plots: &[Plot]) -> Section {
    let mut blocks =
        vec![Block::Viewer { html: EXPLORER, data_id: "run-data", data, script: EXPLORER_SCRIPT }];
    let under = |block: Block| match (block, first) {
        (Block::Still { svg, caption }, Some(first)) => {
            Block::Still { svg, caption: format!("{caption} Under \u{201c}{first}\u{201d}.") }
        }
        (other, _) => other,
    };
    // For many cracks the largest pictures are available as files only.
    let of_k: &[&str] = if told.is_some() { &["kii.svg"] } else { &["ki.svg", "kii.svg"] };
    blocks.extend(of_k.iter().filter_map(|file| still(plots, file, "")).map(under));
    blocks.extend(still(plots, "paths.svg", ""));
    if told.is_none() {
        blocks.extend(still(plots, "faces.svg", "Crack faces in step 0.").map(under));
    }
    let wheels: Vec<Chart> =
        ["wheels-ki", "wheels-kii"].into_iter().filter_map(|id| chart(plots, id)).collect();
    if !wheels.is_empty() {
        blocks.push(Block::charts(wheels));
    }
    Section { id: "passage".to_owned(), heading: "Passage of the wheel".to_owned(), blocks }
}

/// Pressure and volume of the fluid in the cracks; none of dry ones.
fn water(plots: &[Plot]) -> Option<Section> {
    let charts: Vec<Chart> =
        ["fluid-pressure", "fluid-volume"].into_iter().filter_map(|id| chart(plots, id)).collect();
    (!charts.is_empty()).then(|| Section {
        id: "water".to_owned(),
        heading: "Fluid in the cracks".to_owned(),
        blocks: vec![Block::charts(charts)],
    })
}

fn growth(run: &RunFolder, told: Option<&[NamedCrack]>, remarks: Vec<String>) -> Section {
    let mut blocks = Vec::new();
    if run.summary.steps_recorded > 1 {
        let chart = |id: &str, caption: &str, x: ChartAxis, point: fn(&TipRow) -> [f64; 2]| Chart {
            id: id.to_owned(),
            caption: caption.to_owned(),
            x,
            y: ChartAxis::logarithmic("da/dN", "mm/cycle"),
            curves: curves(run, told, point),
            ..Chart::default()
        };
        blocks.push(Block::charts([chart(
            "rate-length",
            "Growth rate against crack length.",
            ChartAxis::linear("Crack length", "mm"),
            |row| [row.length, row.rate],
        )]));
    }
    if !remarks.is_empty() {
        blocks.push(Block::List(remarks));
    }
    Section { id: "growth".to_owned(), heading: "Growth".to_owned(), blocks }
}

/// Quantiles of the depth over traffic, where there is scatter.
fn quantiles(run: &RunFolder) -> Vec<Curve> {
    let decision = run.summary.decision.as_ref();
    let Some(scatter) = decision.and_then(|decision| decision.scatter.as_ref()) else { return Vec::new() };
    let of = |name: &str, quantile: fn(&Quantiles) -> Option<f64>| {
        let points = scatter.depth.iter().filter_map(|at| Some([at.mgt, quantile(&at.depth_mm)?]));
        Curve::line(name, points.collect()).with_look(CurveLook::Dashed)
    };
    vec![
        of("5 % quantile of the samples", |depth| depth.p05),
        of("95 % quantile of the samples", |depth| depth.p95),
    ]
}

/// The `curves` of the run and others: then the curve of a single tip needs a name, too.
fn named_beside(mut curves: Vec<Curve>, others: Vec<Curve>) -> Vec<Curve> {
    if let ([only], false) = (&mut curves[..], others.is_empty())
        && only.name.is_empty()
    {
        only.name = "this run".to_owned();
    }
    curves.extend(others);
    curves
}

/// Depth of the tips against million gross tonnes; none without growth or without axle loads.
fn depth_by_tonnage(run: &RunFolder, told: Option<&[NamedCrack]>) -> Option<Chart> {
    let load = run.case.axle_load.filter(|_| run.summary.steps_recorded > 1)?;
    Some(Chart {
        id: "depth-mgt".to_owned(),
        caption: format!(
            "Depth of the tip below the running surface against traffic, at {} t per axle.",
            given(load)
        ),
        x: ChartAxis::linear("Traffic", "million gross tonnes"),
        y: ChartAxis::depth(),
        curves: named_beside(
            curves(run, told, |row| [1e-6 * load * row.load_cycles, -row.place[1]]),
            quantiles(run),
        ),
        ..Chart::default()
    })
}

/// A curve for each tip, unnamed for a single tip, which needs no legend. For many cracks only the
/// `told` ones are named.
fn curves(run: &RunFolder, told: Option<&[NamedCrack]>, point: impl Fn(&TipRow) -> [f64; 2]) -> Vec<Curve> {
    let tips = run.tips();
    let has_two = tips.iter().any(|&(_, tip)| tip > 1);
    let curve = |(place, &(crack, tip)): (usize, &(usize, usize))| {
        let name = match (tips.len(), has_two) {
            (1, _) => String::new(),
            (_, false) => format!("crack {crack}"),
            (_, true) => format!("crack {crack}, tip {tip}"),
        };
        Curve::line(&name, run.history(crack, tip).map(&point).collect())
            .with_dots(CurveDots::All)
            .with_colour(CurveColour::of(place, tips.len()))
    };
    let curves: Vec<Curve> = tips.iter().enumerate().map(curve).collect();
    match told {
        Some(told) => bundle(told, tips.iter().map(|&(crack, _)| crack).zip(curves).collect()),
        None => curves,
    }
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
    for row in run.growth.iter().take(TABLE_ROWS) {
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
    table.caption = "State at the start of each growth step; ranges over the stabilised passage".to_owned();
    if run.growth.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of growth.csv"));
    }
    let heading = format!("{} rows", run.growth.len().min(TABLE_ROWS));
    Section {
        id: "steps".to_owned(),
        heading: "All growth steps".to_owned(),
        blocks: vec![Block::Folded { heading, blocks: vec![Block::Table(table)] }],
    }
}

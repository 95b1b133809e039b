//! The page of a growth run.

mod assumptions;
mod data;
mod events;
mod facts;
mod stored;
mod warnings;

use crate::numbers::{fixed, grouped, significant, tonnage};
use crate::shown::{ShownFields, ShownRun};
use crate::{Block, ChartAxis, Curve, CurveLook, LineChart, Page, Section, Table};
use railcrack_run::csv::TipRow;
use railcrack_run::files::CASE_FILE;
use serde_json::Value;

pub(crate) use stored::RunFolder;

const EXPLORER: &str = include_str!("../../assets/run.html");
const EXPLORER_SCRIPT: &str = include_str!("../../assets/run.js");
const FIELDS: &str = include_str!("../../assets/fields.html");
const FIELDS_SCRIPT: &str = include_str!("../../assets/fields.js");
/// Columns of a table that leave room for a chart beside it, on paper too.
const BESIDE_COLUMNS: usize = 5;
/// Rows of the table of steps; `growth.csv` has all.
const TABLE_ROWS: usize = 500;

/// The page of the run in a folder, of which `shown` is what is long; `pictures` (file name and SVG) are its plots, for readers without scripts.
pub(crate) fn run_page(run: &RunFolder, shown: &ShownRun, pictures: &[(&'static str, String)]) -> Page {
    let warnings = warnings::warnings(run);
    let mut page = Page {
        title: run.summary.title.clone(),
        kind: "Growth of cracks under rolling contact".to_owned(),
        verdict: facts::verdict(run),
        facts: facts::facts(run, warnings.len()),
        lead: Vec::new(),
        sections: Vec::new(),
    };
    if !warnings.is_empty() {
        page.lead.push(Block::Warnings(warnings));
    }
    if let Some(table) = facts::lengths(run) {
        let chart = Block::Chart(length_cycles(run));
        // A table of many cracks takes the whole width.
        if table.headings.len() <= BESIDE_COLUMNS {
            page.lead.push(Block::Beside(vec![Block::Table(table), chart]));
        } else {
            page.lead.extend([Block::Table(table), Block::Beside(vec![chart])]);
        }
    }
    page.lead.extend(facts::cracks(run).map(Block::Table));
    page.lead.extend(events::table(run).map(Block::Table));
    page.lead.push(Block::Heading("Assumptions".to_owned()));
    page.lead.push(Block::List(assumptions::assumptions(run)));
    if run.summary.steps_recorded > 0 {
        page.sections.push(explorer(data::explorer(run, shown), pictures));
        page.sections.extend(around(&shown.fields));
        page.sections.push(growth(run, warnings::remarks(run, shown)));
        page.sections.push(steps(run));
    }
    page.sections.push(Section {
        id: "case".to_owned(),
        heading: "Case".to_owned(),
        blocks: vec![Block::Folded {
            heading: format!("{CASE_FILE}, defaults filled in"),
            blocks: vec![Block::Verbatim(run.case.clone())],
        }],
    });
    page
}

fn explorer(data: Value, pictures: &[(&'static str, String)]) -> Section {
    let mut blocks =
        vec![Block::Viewer { html: EXPLORER, data_id: "run-data", data, script: EXPLORER_SCRIPT }];
    let still = [
        ("ki.svg", "K_{I} over the passage."),
        ("kii.svg", "K_{II} over the passage."),
        ("paths.svg", "Crack paths."),
        ("faces.svg", "Crack faces in step 0."),
    ];
    blocks.extend(still.iter().filter_map(|(file, caption)| {
        let (_, svg) = pictures.iter().find(|(name, _)| name == file)?;
        Some(Block::Still { svg: svg.clone(), caption: (*caption).to_owned() })
    }));
    Section { id: "passage".to_owned(), heading: "Passage of the wheel".to_owned(), blocks }
}

fn around(fields: &ShownFields) -> Option<Section> {
    if fields.is_empty() {
        return None;
    }
    let block = match fields.data() {
        None => Block::Text(
            "The files in fields/ have too many cells for this page; ParaView shows them by fields.pvd."
                .to_owned(),
        ),
        Some(data) => Block::Viewer { html: FIELDS, data_id: "field-data", data, script: FIELDS_SCRIPT },
    };
    let (id, heading) = ("around".to_owned(), "Around the cracks, deformed".to_owned());
    Some(Section { id, heading, blocks: vec![block] })
}

fn length_cycles(run: &RunFolder) -> LineChart {
    let first_tips: Vec<(usize, usize)> = run.tips().into_iter().filter(|&(_, tip)| tip == 1).collect();
    LineChart {
        id: "length-cycles".to_owned(),
        caption: "Crack length against load cycles (axles); a dot for each step.".to_owned(),
        x: ChartAxis::linear("Load cycles (axles)"),
        y: ChartAxis::linear("Crack length (mm)"),
        // Both tips of a buried crack share its length.
        curves: curves(run, &first_tips, |row| [row.load_cycles, row.length]),
        ..LineChart::default()
    }
}

fn growth(run: &RunFolder, remarks: Vec<String>) -> Section {
    let mut blocks = Vec::new();
    if run.summary.steps_recorded > 1 {
        let x = |title: &str| ChartAxis::linear(title);
        let rate = ChartAxis::logarithmic("da/dN (mm per load cycle)");
        let tips = run.tips();
        let of_tips = |point: fn(&TipRow) -> [f64; 2]| curves(run, &tips, point);
        blocks.push(Block::charts(vec![
            LineChart {
                id: "rate-length".to_owned(),
                caption: "Growth rate against crack length.".to_owned(),
                x: x("Crack length (mm)"),
                y: rate.clone(),
                curves: of_tips(|row| [row.length, row.rate]),
                ..LineChart::default()
            },
            LineChart {
                id: "rate-delta-k".to_owned(),
                caption: "Growth rate against the range of the stress intensity at the actual tip: the law."
                    .to_owned(),
                x: ChartAxis::logarithmic("ΔK_{eq} (MPa√m)"),
                y: rate,
                curves: of_tips(|row| [row.delta_keq, row.rate]),
                ..LineChart::default()
            },
        ]));
    }
    if !remarks.is_empty() {
        blocks.push(Block::List(remarks));
    }
    Section { id: "growth".to_owned(), heading: "Growth".to_owned(), blocks }
}

/// A curve for each of `tips`; a single one has no name, it needs no legend.
fn curves(run: &RunFolder, tips: &[(usize, usize)], point: fn(&TipRow) -> [f64; 2]) -> Vec<Curve> {
    let has_two = tips.iter().any(|&(_, tip)| tip > 1);
    let curve = |&(crack, tip): &(usize, usize)| {
        let name = match (tips.len(), has_two) {
            (1, _) => String::new(),
            (_, false) => format!("crack {crack}"),
            (_, true) => format!("crack {crack}, tip {tip}"),
        };
        // Each tip has one colour on all charts of the page.
        let colour = run.tips().iter().position(|&other| other == (crack, tip)).unwrap_or(0);
        Curve::line(&name, run.history(crack, tip).map(point).collect())
            .with_look(CurveLook::Dotted)
            .with_colour(colour)
    };
    tips.iter().map(curve).collect()
}

fn steps(run: &RunFolder) -> Section {
    let load = run.axle_load();
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
        "Rival (°)",
        "Its rate, relative",
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
        cells.push(row.stop_word().replace('-', " "));
        table.row(cells);
    }
    table.caption = "The state at the start of each step; K over the stabilised passage".to_owned();
    if run.growth.len() > TABLE_ROWS {
        table.caption.push_str(&format!("; the first {TABLE_ROWS} rows of growth.csv"));
    }
    let heading = format!("{} rows", run.growth.len().min(TABLE_ROWS));
    Section {
        id: "steps".to_owned(),
        heading: "Every step".to_owned(),
        blocks: vec![Block::Folded { heading, blocks: vec![Block::Table(table)] }],
    }
}

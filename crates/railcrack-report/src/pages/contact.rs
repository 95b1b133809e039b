//! `contact.html`.

use super::described::described;
use crate::chart::{Chart, ChartAxis, Curve, CurveLook};
use crate::figures::{PATCH_KEY, PatchKey, patches_picture};
use crate::numbers::{fixed, significant};
use crate::page::{Block, Fact, Page, Section};
use crate::table::{MISSING, Table};
use railcrack_case::Case;
use railcrack_run::contact::{GrowthAcross, WheelRow, by_growth, sentences};
use railcrack_run::description::Subject;

/// Rows of the table of the page; wheels.csv has all.
const SHOWN: usize = 40;

/// The subjects of the case from which growth is computed, besides the wheels.
const ASSUMED: [Subject; 6] =
    [Subject::Rail, Subject::Passage, Subject::Cracks, Subject::Fronts, Subject::Growth, Subject::Model];

/// The page of the wheels, of which those in `drawn` have pictures.
pub fn contact_page(case: &Case, rows: &[WheelRow], drawn: &[usize], across: Option<&GrowthAcross>) -> Page {
    let sentences = sentences(case, rows, across);
    let pictures: Vec<Block> = drawn
        .iter()
        .filter_map(|wheel| {
            let row = &rows[*wheel];
            let caption = format!(
                "Wheel {}: {} % of the axles, {} % of the growth.",
                row.number,
                fixed(100.0 * row.share, 1),
                fixed(100.0 * row.growth_share, 1)
            );
            Some(Block::Picture { svg: patches_picture(row, PatchKey::OnPage)?, caption })
        })
        .collect();
    let mut sections = vec![Section::new("wheels", "Wheels", vec![Block::Table(table(rows))])];
    if !pictures.is_empty() {
        let key = Block::Text(PATCH_KEY.to_owned());
        sections.push(Section::new("patches", "Patches", vec![key, Block::Beside(pictures)]));
    }
    let charts = charts(rows, across);
    if !charts.is_empty() {
        sections.push(Section::new("places", "Lateral places", vec![Block::charts(charts)]));
    }
    sections.push(Section::new("meaning", "Meaning of the numbers", vec![Block::List(meaning(case))]));
    sections.push(Section::new("assumptions", "Assumptions", vec![Block::List(described(case, &ASSUMED))]));
    let mean = rows.iter().map(|row| row.share * row.rate).sum::<f64>();
    Page {
        title: case.title.clone(),
        kind: "Contact".into(),
        decision: None,
        verdict: sentences.first().map_or_else(String::new, |first| format!("{first}.")),
        facts: vec![
            Fact::new("Wheels", rows.len().to_string(), ""),
            Fact::new("Mean rate", significant(mean), "mm per axle, of the cracks as they are"),
        ],
        lead: vec![Block::List(sentences.iter().skip(1).map(|text| format!("{text}.")).collect())],
        sections,
    }
}

fn meaning(case: &Case) -> Vec<String> {
    let [demand, places] = if case.space().is_some() { IN_SPACE } else { IN_THE_PLANE };
    ON_THE_RAIL.into_iter().chain([demand, places]).map(str::to_owned).collect()
}

const ON_THE_RAIL: [&str; 2] = [
    "Forces act on the rail: x with the travel, y across; they are those of the whole patch.",
    "Tγ = −(F_{x} ξ + F_{y} η) without the work of the spin, as damage functions use it; wheels.csv also has it with spin.",
];

const IN_THE_PLANE: [&str; 2] = [
    "ΔK_{eq} and the share of the growth are of a stabilised passage over the cracks as they are at the beginning, of each wheel alone.",
    "The growth by lateral place ranks places by a crack whose faces are open: contact of the faces and friction are not part of it.",
];

const IN_SPACE: [&str; 2] = [
    "ΔK_{eq} is the largest along the fronts, and the share of the growth is that of the mean rate along them, in a stabilised passage over \
     the cracks as they are at the beginning, of each wheel alone. Wheels that another one represents are scaled from a coarse crack.",
    "The growth by lateral place is the mean rate along the front of a coarse crack with contact and friction of its faces.",
];

fn table(rows: &[WheelRow]) -> Table {
    let mut table = Table::new([
        "Wheel",
        "Axles (%)",
        "Growth (%)",
        "p_{0} (MPa)",
        "a (mm)",
        "b (mm)",
        "F_{x} (kN)",
        "F_{y} (kN)",
        "Slips (%)",
        "Tγ (N)",
        "ΔK_{eq} (MPa√m)",
    ]);
    let or_missing = |value: Option<String>| value.unwrap_or_else(|| MISSING.to_owned());
    for row in by_growth(rows).iter().take(SHOWN).map(|wheel| &rows[*wheel]) {
        table.row([
            row.number.to_string(),
            significant(100.0 * row.share),
            fixed(100.0 * row.growth_share, 1),
            fixed(row.peak_pressure, 0),
            fixed(row.along, 2),
            or_missing(row.across.map(|across| fixed(across, 2))),
            or_missing(row.force.map(|force| fixed(1e-3 * force[0], 2))),
            or_missing(row.force.map(|force| fixed(1e-3 * force[1], 2))),
            or_missing(row.slip_share.map(|share| fixed(100.0 * share, 0))),
            or_missing(row.t_gamma.map(|work| fixed(work, 1))),
            fixed(row.delta_keq, 2),
        ]);
    }
    if rows.len() > SHOWN {
        table.caption =
            format!("The {SHOWN} wheels that grow the cracks most; wheels.csv has all {}", rows.len());
    }
    table.without_empty_columns()
}

fn charts(rows: &[WheelRow], across: Option<&GrowthAcross>) -> Vec<Chart> {
    let mut charts = Vec::new();
    if let Some(across) = across {
        let points = across.places.iter().map(|[place, rate, _]| [*place, *rate]).collect();
        charts.push(Chart {
            id: "across".into(),
            caption: format!(
                "Mean growth rate by the lateral place of the crack, over that at its place in the case, by {}.",
                across.by
            ),
            x: ChartAxis::linear("Lateral place of the crack", "mm"),
            y: ChartAxis::linear("Rate over that of the case", ""),
            curves: vec![Curve::line("", points)],
            ..Chart::default()
        });
    }
    let points: Vec<[f64; 2]> =
        rows.iter().filter_map(|row| Some([row.y_rail?, 100.0 * row.growth_share])).collect();
    if points.len() > 1 {
        charts.push(Chart {
            id: "wheels-across".into(),
            caption: "Share of each wheel in the growth, by the lateral place of its patch.".into(),
            x: ChartAxis::linear("Lateral place of the patch", "mm"),
            y: ChartAxis::linear("Share of the growth", "%"),
            curves: vec![Curve::line("", points).with_look(CurveLook::Dots)],
            ..Chart::default()
        });
    }
    charts
}

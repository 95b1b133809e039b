//! The report of a stabilised plastic state.

use crate::figures::{Plot, charts};
use crate::numbers::{fixed, significant};
use crate::page::{Block, Fact, Page, Section};
use crate::pages::described::{case_section, described};
use crate::pages::phrases::sentence;
use crate::table::Table;
use railcrack::shakedown::Method;
use railcrack::words::Choice;
use railcrack_case::Case;
use railcrack_run::description::Subject;
use railcrack_run::shakedown::{ShakedownFolder, ShakedownSummary};

/// The page of `state` under the wheels of `case`, with its plots.
pub(crate) fn shakedown_page(state: &ShakedownFolder, case: &Case, plots: &[Plot]) -> Page {
    let summary = &state.summary;
    let mut lead = Vec::new();
    if !summary.warnings.is_empty() {
        lead.push(Block::Warnings(summary.warnings.iter().map(|text| sentence(text)).collect()));
    }
    lead.push(Block::Heading("Assumptions".to_owned()));
    lead.push(Block::List(assumptions(summary, case)));
    let charts = |ids: &[&str]| vec![charts(plots, ids)];
    let picture = |file: &str, caption: &str| -> Vec<Block> {
        let plot = plots.iter().find(|plot| plot.file == file);
        plot.map(|plot| Block::Picture { svg: plot.svg.clone(), caption: caption.to_owned() })
            .into_iter()
            .collect()
    };
    let across = picture(
        "section.svg",
        "Residual stress, plastic strain and the Dang Van criterion by lateral place and depth, from section.csv.",
    );
    Page {
        title: summary.title.clone(),
        kind: "Stabilised plastic state under repeated passages".to_owned(),
        decision: None,
        verdict: verdict(summary),
        facts: facts(summary),
        lead,
        sections: [(!across.is_empty()).then(|| Section::new("across", "Across the rail", across))]
            .into_iter()
            .flatten()
            .chain([
                Section::new(
                    "depth",
                    "Residual stress and plastic strain",
                    charts(&["residual-stress", "plastic-strain"]),
                ),
                Section::new("initiation", "Crack initiation", charts(&["dang-van"])),
                Section::new("passages", "Evolution over the passages", charts(&["passes", "passes-change"])),
                Section::new("limits", "Shakedown limits", charts(&["bounds", "shakedown-map"])),
                Section::new(
                    "around",
                    "Around the contact",
                    picture(
                        "field.svg",
                        "Von Mises stress and equivalent plastic strain in the last passage, from cycle.vtu.",
                    ),
                ),
                Section::new("numbers", "Key figures", vec![Block::Table(numbers(summary))]),
                case_section(&state.case_text),
            ])
            .collect(),
    }
}

fn passages(count: usize) -> String {
    if count == 1 { "1 passage".to_owned() } else { format!("{count} passages") }
}

fn verdict(summary: &ShakedownSummary) -> String {
    let dang_van = &summary.dang_van;
    let depth = if dang_van.critical_depth_mm == 0.0 {
        "at the running surface".to_owned()
    } else {
        format!("at a depth of {} mm", fixed(dang_van.critical_depth_mm, 2))
    };
    let place = match dang_van.critical_lateral_mm {
        Some(lateral) => format!("{depth}, at the lateral place {} mm", fixed(lateral, 2)),
        None => depth,
    };
    let starts = if dang_van.margin_mpa < 0.0 {
        format!(
            "Crack initiation is predicted {place}: the Dang Van criterion is exceeded by {} MPa.",
            fixed(-dang_van.margin_mpa, 1)
        )
    } else {
        format!(
            "No crack initiation is predicted: the smallest margin of the Dang Van criterion is {} MPa, {place}.",
            fixed(dang_van.margin_mpa, 1)
        )
    };
    let state = match summary.state.word() {
        "elastic" => "The rail stays elastic.".to_owned(),
        "elastic shakedown" => {
            format!("The rail shakes down to an elastic state in {}.", passages(summary.passes))
        }
        "plastic shakedown" => summary.alternating_zone.map_or_else(
            || "Plastic strain alternates in every passage.".to_owned(),
            |zone| {
                format!(
                    "Plastic strain alternates in every passage between depths of {} and {} mm, by at most {}.",
                    fixed(zone.from_depth_mm, 2),
                    fixed(zone.to_depth_mm, 2),
                    significant(zone.plastic_strain_per_pass)
                )
            },
        ),
        _ => format!("The rail has not reached a stabilised state in {}.", passages(summary.passes)),
    };
    format!("{state} {starts}")
}

fn facts(summary: &ShakedownSummary) -> Vec<Fact> {
    let peak = &summary.peak_residual_stress;
    let warnings = summary.warnings.len();
    vec![
        Fact::new(
            "State",
            summary.state.word().to_owned(),
            format!("{}, {}", passages(summary.passes), summary.method.word()),
        ),
        Fact::new(
            "Load p_{0}/k",
            fixed(summary.p0_over_k, 3),
            format!(
                "first yield {}, shakedown limit {}",
                fixed(summary.first_yield.p0_over_k, 3),
                fixed(summary.shakedown_limit.p0_over_k, 3)
            ),
        ),
        Fact::new(
            "Largest residual stress",
            format!("{} MPa", fixed(peak.stress_mpa, 1)),
            format!(
                "σ{} at a depth of {} mm",
                peak.component.name().trim_start_matches('s'),
                fixed(peak.depth_mm, 2)
            ),
        ),
        Fact::new(
            "Dang Van margin",
            format!("{} MPa", fixed(summary.dang_van.margin_mpa, 1)),
            format!(
                "{} of b = {} MPa at a depth of {} mm",
                fixed(summary.dang_van.critical_value_mpa, 1),
                significant(summary.dang_van.b_mpa),
                fixed(summary.dang_van.critical_depth_mm, 2)
            ),
        ),
        Fact::new(
            "Warnings",
            if warnings == 0 { "none".to_owned() } else { warnings.to_string() },
            if warnings == 0 { String::new() } else { "below".to_owned() },
        ),
    ]
}

/// The subjects of the case from which the state is computed.
const ASSUMED: [Subject; 2] = [Subject::Wheels, Subject::PlasticState];

fn assumptions(summary: &ShakedownSummary, case: &Case) -> Vec<String> {
    let mut all = described(case, &ASSUMED);
    all.extend([
        format!(
            "The {} passes again and again, over a rail without initial plastic strain.",
            if case.is_mix() { "heaviest wheel" } else { "same wheel" }
        ),
        format!(
            "Steel: unbounded linear kinematic hardening, which leads to elastic or plastic shakedown, never to \
             ratchetting. {}.",
            if summary.grid.is_some() {
                "Half-space under the whole patch; the rail cannot lengthen"
            } else {
                "Plane strain, half-plane"
            }
        ),
        format!(
            "The stabilised state was computed {}; in elastic shakedown the residual stress depends on the \
             first passages.",
            if summary.method == Method::Direct {
                "by the direct method, which does not follow the passages"
            } else {
                "pass by pass"
            }
        ),
        format!(
            "Crack initiation: τ + {} p_{{h}} ≤ b = {} MPa over the stabilised cycle (Dang Van); the criterion gives no \
             number of cycles.",
            summary.dang_van.a, summary.dang_van.b_mpa
        ),
    ]);
    all
}

fn numbers(summary: &ShakedownSummary) -> Table {
    let mut table = Table::new(["Quantity", "Value", "Where"]);
    let at = |depth: f64| format!("depth {} mm", fixed(depth, 3));
    let dang_van = &summary.dang_van;
    table.row(["p_{0}/k of the case".to_owned(), fixed(summary.p0_over_k, 4), String::new()]);
    table.row([
        "p_{0}/k at first yield".to_owned(),
        fixed(summary.first_yield.p0_over_k, 4),
        at(summary.first_yield.depth_mm),
    ]);
    table.row([
        "p_{0}/k at the shakedown limit".to_owned(),
        fixed(summary.shakedown_limit.p0_over_k, 4),
        at(summary.shakedown_limit.depth_mm),
    ]);
    table.row([
        "Dang Van value at the surface (MPa)".to_owned(),
        fixed(dang_van.surface.value_mpa, 1),
        at(0.0),
    ]);
    if let Some(below) = dang_van.subsurface {
        table.row([
            "Largest Dang Van value below the surface (MPa)".to_owned(),
            fixed(below.value_mpa, 1),
            at(below.depth_mm),
        ]);
    }
    table.row([
        "Overshoot of the yield surface, relative".to_owned(),
        significant(summary.admissibility.overshoot),
        "whole cycle".to_owned(),
    ]);
    table.row([
        "Drift of the plastic strain in a passage".to_owned(),
        significant(summary.admissibility.drift),
        String::new(),
    ]);
    table.row([
        "Imbalance of forces, relative to the yield stress".to_owned(),
        significant(summary.admissibility.imbalance),
        String::new(),
    ]);
    if let Some([columns, rows, layers]) = summary.grid {
        table.row([
            "Columns along, rows across, layers".to_owned(),
            format!("{columns} × {rows} × {layers}"),
            String::new(),
        ]);
    }
    table.row([
        "Elastic redistributions".to_owned(),
        summary.redistributions.to_string(),
        "all passages".to_owned(),
    ]);
    if let Some(other) = &summary.direct_against_pass_by_pass {
        table.row([
            "Largest difference from the pass-by-pass method (MPa)".to_owned(),
            fixed(other.stress_difference_mpa, 1),
            format!("{}, {}", other.state.word(), passages(other.passes)),
        ]);
    }
    table
}

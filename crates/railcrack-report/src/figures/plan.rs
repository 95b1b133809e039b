//! The map of grinding plans: a cell for each depth and interval, labelled with its numbers.

use super::plot::Plot;
use crate::chart::{HEADING, draw_heading};
use crate::numbers::{fixed, given, rounded};
use crate::svg::{Anchor, GREY, INK, Svg, TextStyle, text};
use crate::table::CellTone;
use railcrack_run::decision::VerdictLevel;
use railcrack_run::planner::{PlanOutcome, PlanSummary, PlannedGrinding};

/// Width and height of a cell, and the margins, pixels.
const CELL: (f64, f64) = (178.0, 74.0);
const LEFT: f64 = 96.0;
const BELOW: f64 = 62.0;

/// Grounds of cells: holds, holds without keeping the target or without an answer, fails.
const HOLDS: &str = "#cfe8d5";
const DOUBTFUL: &str = "#f4ecc8";
const FAILS: &str = "#f3cdc6";

/// The plots of plans.
pub(crate) fn plan_plots(plans: &PlanSummary) -> Vec<Plot> {
    vec![Plot::picture("plan.svg", map(plans))]
}

fn map(plans: &PlanSummary) -> String {
    let (columns, rows) = (plans.grinding_interval_mgt.len(), plans.grinding_mm.len());
    let (width, height) = (columns as f64 * CELL.0, rows as f64 * CELL.1);
    let top = HEADING + 6.0;
    let mut svg = Svg::new(f64::max(LEFT + width + 24.0, 470.0), top + height + BELOW);
    let subtitle = format!("MGT until the outcome, up to a horizon of {} MGT", mgt(plans.horizon_mgt));
    draw_heading(&mut svg, 16.0, f64::max(LEFT + width, 440.0), &plans.title, &subtitle);
    let bold = TextStyle { size: 13.0, anchor: Anchor::Middle, colour: INK, weight: "bold" };
    let small = TextStyle { size: 11.0, weight: "normal", ..bold };
    for (row, depth) in plans.grinding_mm.iter().enumerate() {
        // The deepest grinding is on top.
        let y = top + (rows - 1 - row) as f64 * CELL.1;
        svg.text(
            [LEFT - 10.0, y + 0.5 * CELL.1 + 4.0],
            &text(&given(*depth)),
            TextStyle { anchor: Anchor::End, ..small },
        );
        for column in 0..columns {
            let Some(plan) = plans.plan(row, column) else { continue };
            let x = LEFT + column as f64 * CELL.0;
            svg.rectangle([x + 1.0, y + 1.0, CELL.0 - 2.0, CELL.1 - 2.0], ground(plan), GREY);
            let middle = x + 0.5 * CELL.0;
            for (line, words) in words(plan).iter().enumerate() {
                let style = if line == 0 { bold } else { small };
                svg.text([middle, y + 19.0 + 15.5 * line as f64], &text(words), style);
            }
        }
    }
    for (column, interval) in plans.grinding_interval_mgt.iter().enumerate() {
        let middle = LEFT + (column as f64 + 0.5) * CELL.0;
        svg.text([middle, top + height + 18.0], &text(&given(*interval)), small);
    }
    let quiet = TextStyle { colour: GREY, ..small };
    svg.text([LEFT + 0.5 * width, top + height + 38.0], &text("Grinding every … MGT"), quiet);
    let upwards = TextStyle { anchor: Anchor::Upwards, ..quiet };
    svg.text([24.0, top + 0.5 * height], &text("Depth of each grinding (mm)"), upwards);
    svg.finish(&format!("Grinding plans: {}", plans.title))
}

/// The lines of a cell.
pub(crate) fn words(plan: &PlannedGrinding) -> Vec<String> {
    let first = match plan.level {
        VerdictLevel::Outside => "outside the model".to_owned(),
        _ => match plan.outcome {
            PlanOutcome::Holds => format!("holds to {}", mgt(plan.mgt)),
            PlanOutcome::Unknown => format!("not known beyond {}", mgt(plan.mgt)),
            outcome => format!("{} {}", outcome.words(), mgt(plan.mgt)),
        },
    };
    let mut lines = vec![first, format!("largest depth {} mm", fixed(plan.largest_depth_mm, 2))];
    if let Some(probability) = plan.probability_of_failure {
        let or_more = if plan.probability_not_known.is_some_and(|share| share > 0.0) { "≥ " } else { "" };
        lines.push(format!("P(failure) {or_more}{}", given(rounded(probability, 3))));
    }
    lines
}

/// Tonnage to the digits that matter on a map.
fn mgt(value: f64) -> String {
    given(rounded(value, 4))
}

fn ground(plan: &PlannedGrinding) -> &'static str {
    match tone(plan) {
        CellTone::Holds => HOLDS,
        CellTone::Doubtful => DOUBTFUL,
        _ => FAILS,
    }
}

/// Whether a plan holds, is not known to, or fails.
pub(crate) fn tone(plan: &PlannedGrinding) -> CellTone {
    let is_safe = plan.outcome.is_safe() || plan.outcome == PlanOutcome::Unknown;
    match plan.level < VerdictLevel::Stop && is_safe {
        _ if plan.holds => CellTone::Holds,
        true => CellTone::Doubtful,
        false => CellTone::Fails,
    }
}

//! The report of grinding plans: a page that can be printed and signed.

use crate::figures::{tone, words};
use crate::numbers::{fixed, given, rounded, significant};
use crate::page::{Banner, Block, Fact, Page, Section};
use crate::pages::described::{OF_GROWTH, case_section, described};
use crate::pages::phrases::{calibration, sentence};
use crate::table::{Cell, CellTone, MISSING, Table};
use railcrack_case::Case;
use railcrack_run::PlanFolder;
use railcrack_run::decision::VerdictLevel;
use railcrack_run::files::CASE_FILE;
use railcrack_run::planner::{LeastGrinding, PlanSummary, PlannedGrinding};

/// The page of `plans` for `case`.
pub(crate) fn plan_page(plans: &PlanFolder, case: &Case) -> Page {
    let summary = &plans.summary;
    let mut lead: Vec<Block> =
        calibration(&summary.calibration).map(|text| Block::List(vec![text])).into_iter().collect();
    if !summary.warnings.is_empty() {
        lead.push(Block::Warnings(summary.warnings.iter().map(|text| format!("{text}.")).collect()));
    }
    lead.push(Block::Table(map(summary)));
    Page {
        title: summary.title.clone(),
        kind: "Grinding plan".to_owned(),
        decision: Some(banner(summary)),
        verdict: verdict(summary),
        facts: facts(summary),
        lead,
        sections: vec![
            Section::new(
                "plans",
                "All plans",
                vec![Block::Table(table(summary)), Block::Table(least(summary))],
            ),
            Section::new("assumptions", "Assumptions", assumptions(summary, case)),
            Section::new("approval", "Approval", vec![Block::Approval(approval(summary))]),
            case_section(&plans.case_text),
        ],
    }
}

/// The fate of the rail by depth, the deepest on top, and interval of grinding: as a table,
/// which a phone shows whole.
fn map(summary: &PlanSummary) -> Table {
    let intervals = summary.grinding_interval_mgt.iter().map(|mgt| format!("every {} MGT", given(*mgt)));
    let mut table = Table::new([String::new()].into_iter().chain(intervals));
    table.caption = format!(
        "What becomes of the rail by depth and interval of grinding, up to a horizon of {} MGT; plan.csv has the numbers",
        given(rounded(summary.horizon_mgt, 4))
    );
    for (row, depth) in summary.grinding_mm.iter().enumerate().rev() {
        let cells = (0..summary.grinding_interval_mgt.len()).map(|column| {
            let plan = summary.plan(row, column);
            plan.map_or_else(Cell::default, |plan| Cell::toned(&words(plan).join("; "), tone(plan)))
        });
        table.row([Cell::from(format!("{}\u{a0}mm", given(*depth)))].into_iter().chain(cells));
    }
    table
}

/// Those of the plans, and the case from which they begin.
fn assumptions(summary: &PlanSummary, case: &Case) -> Vec<Block> {
    vec![
        Block::List(summary.assumptions.clone()),
        Block::Heading("The cracks under traffic".to_owned()),
        Block::List(described(case, &OF_GROWTH)),
    ]
}

/// The verdict on the rail without grinding.
fn banner(summary: &PlanSummary) -> Banner {
    let (level, word) = match summary.verdict.level {
        VerdictLevel::Ok => ("ok", "Without grinding: OK"),
        VerdictLevel::Act => ("act", "Without grinding: act"),
        VerdictLevel::Unknown => ("unknown", "Without grinding: not known"),
        VerdictLevel::Stop => ("stop", "Without grinding: stop"),
        VerdictLevel::Outside => ("outside", "Outside of what the model describes"),
    };
    let reason =
        summary.verdict.reasons.first().map_or_else(String::new, |reason| format!("{}.", reason.text));
    Banner { level, word, text: reason }
}

fn verdict(summary: &PlanSummary) -> String {
    if summary.verdict.level >= VerdictLevel::Stop {
        return "No grinding plan is derived from this case: the reason above says why.".to_owned();
    }
    match &summary.least {
        Some(LeastGrinding { grinding_interval_mgt: None, .. }) => {
            "The rail holds without grinding.".to_owned()
        }
        Some(least) => format!(
            "The least grinding of these plans that holds is {}, {} mm per MGT with the wear.",
            shown(least),
            significant(least.removal_mm_per_mgt)
        ),
        None => summary.next_step().map_or_else(|| "None of these plans holds.".to_owned(), sentence),
    }
}

fn shown(least: &LeastGrinding) -> String {
    match least.grinding_interval_mgt {
        Some(interval) => format!("{} mm every {} MGT", given(least.grinding_mm), given(interval)),
        None => "none".to_owned(),
    }
}

/// Traffic with months, where they are known.
fn traffic(mgt: f64, months: Option<f64>) -> String {
    let months = months.map_or_else(String::new, |months| format!(" ({months:.0} months)"));
    format!("{} MGT{months}", given(rounded(mgt, 4)))
}

/// Digits of a checksum in a tile.
const CHECKSUM: usize = 12;

/// The year of an ISO `date`.
fn year(date: &str) -> &str {
    date.split('-').next().unwrap_or(date)
}

fn facts(summary: &PlanSummary) -> Vec<Fact> {
    let without = &summary.without_grinding;
    let mut facts = vec![Fact::new(
        "Without grinding",
        without.outcome.words().to_owned(),
        format!("after {}", traffic(without.mgt, without.months)),
    )];
    if let Some(least) = &summary.least {
        let removal = format!("{} mm per MGT with the wear", significant(least.removal_mm_per_mgt));
        facts.push(Fact::new("Least grinding", shown(least), removal));
        if let Some(mgt) = least.mgt_to_wear_limit {
            let limit = summary.wear_limit_mm.map_or_else(String::new, |limit| {
                format!("at a removal of {} mm, with the least grinding", fixed(limit, 1))
            });
            let when = match &least.replacement_date {
                // A day years ahead would promise more than is known.
                Some(date) => format!("{}, after {}", year(date), traffic(mgt, least.months_to_wear_limit)),
                None => format!("after {}", traffic(mgt, least.months_to_wear_limit)),
            };
            facts.push(Fact::new("Replacement", when, limit));
        }
    }
    facts.push(Fact::new("Horizon", format!("{} MGT", given(rounded(summary.horizon_mgt, 4))), ""));
    facts.push(Fact::new("Date", summary.date.clone(), format!("railcrack {}", summary.version)));
    facts.push(Fact::new(
        "Case",
        summary.case_checksum.chars().take(CHECKSUM).collect::<String>(),
        format!("the beginning of the SHA-256 of {CASE_FILE}; all of it above the signatures"),
    ));
    facts
}

fn table(summary: &PlanSummary) -> Table {
    let mut table = Table::new([
        "Depth (mm)",
        "Every (MGT)",
        "Removal (mm/MGT)",
        "Outcome",
        "After (MGT)",
        "After (months)",
        "Largest depth (mm)",
        "P(failure)",
        "Wear limit (MGT)",
        "Wear limit (months)",
    ]);
    table.caption = "The first row is the rail without grinding".to_owned();
    let months =
        |value: Option<f64>| value.map_or_else(|| MISSING.to_owned(), |months| format!("{months:.0}"));
    for plan in std::iter::once(&summary.without_grinding).chain(&summary.plans) {
        let cells: [Cell; 10] = [
            given(plan.grinding_mm).into(),
            plan.grinding_interval_mgt.map_or_else(|| MISSING.to_owned(), given).into(),
            significant(plan.removal_mm_per_mgt).into(),
            outcome(plan),
            given(rounded(plan.mgt, 5)).into(),
            months(plan.months).into(),
            fixed(plan.largest_depth_mm, 2).into(),
            probability(plan).into(),
            plan.mgt_to_wear_limit.map_or_else(|| MISSING.to_owned(), |mgt| given(rounded(mgt, 5))).into(),
            months(plan.months_to_wear_limit).into(),
        ];
        table.row(cells);
    }
    table.without_empty_columns()
}

/// The share of the samples that fail; with those whose fate is not known where there are any.
fn probability(plan: &PlannedGrinding) -> String {
    let Some(fails) = plan.probability_of_failure else { return MISSING.to_owned() };
    let unknown = plan.probability_not_known.unwrap_or(0.0);
    let least = given(rounded(fails, 3));
    if unknown > 0.0 { format!("{least} to {}", given(rounded(fails + unknown, 3))) } else { least }
}

fn outcome(plan: &PlannedGrinding) -> Cell {
    let words = match plan.level {
        VerdictLevel::Outside => "outside the model",
        _ => plan.outcome.words(),
    };
    Cell::toned(words, if plan.holds { CellTone::Holds } else { CellTone::Fails })
}

fn least(summary: &PlanSummary) -> Table {
    let mut table = Table::new(["Every (MGT)", "Least depth that holds (mm)", "Removal (mm/MGT)"]);
    table.caption = "Least grinding by interval".to_owned();
    for (interval, least) in summary.grinding_interval_mgt.iter().zip(&summary.least_by_interval) {
        let (depth, removal) = match least {
            Some(least) => (given(least.grinding_mm), significant(least.removal_mm_per_mgt)),
            None => ("none of those tried".to_owned(), MISSING.to_owned()),
        };
        table.row([given(*interval), depth, removal]);
    }
    table
}

/// Space for names.
fn approval(summary: &PlanSummary) -> Table {
    super::approval::approval(format!(
        "Computed on {} with railcrack {} from the case {}",
        summary.date, summary.version, summary.case_checksum
    ))
}

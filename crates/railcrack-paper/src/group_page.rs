//! `paper-figs-14-16.md` and its like: the figures of a group, its statements with their rules and
//! numbers.

use crate::claim::rounded;
use crate::document::PaperRecord;
use crate::figure::FIGURES;
use crate::figure_group::FigureGroup;
use crate::profile::StressProfile;
use crate::results::Results;
use crate::rolled::ROLLED_CLAIMS;
use crate::setup::SETUPS;
use crate::verdict::{MAIN, Verdict};
use railcrack::shakedown::RailState;
use railcrack::words::Choice;

/// The page of a group.
pub(super) fn group_page(
    group: &FigureGroup,
    figures: &[u8],
    results: &Results,
    verdicts: &[Verdict],
    profiles: Option<&[StressProfile]>,
    record: &PaperRecord,
) -> String {
    let mut text = format!(
        "# {}\n\nPart of [the paper, recomputed](paper.md), which describes the set-ups.\n\n",
        group.heading()
    );
    text.push_str(&pictures(group, figures, results));
    if let Some(profiles) = profiles.filter(|_| group.figures.contains(&21)) {
        text.push_str(&profile_section(profiles));
    }
    let of_group: Vec<&Verdict> = verdicts.iter().filter(|verdict| group.decides(verdict.claim)).collect();
    if !of_group.is_empty() {
        text.push_str(&numbers(&of_group, record));
    }
    text.trim_end().to_owned() + "\n"
}

fn pictures(group: &FigureGroup, figures: &[u8], results: &Results) -> String {
    let mut text = "K: half-plane solid, block dashed. The numbers of all set-ups are in `figures/*.csv` of the folder.\n\n".to_owned();
    for figure in FIGURES
        .iter()
        .filter(|figure| group.figures.contains(&figure.number) && figures.contains(&figure.number))
    {
        let stem = figure.file_stem();
        text.push_str(&format!("![Fig. {}: {}](figures/{stem}.svg)\n\n", figure.number, figure.title));
    }
    if group.figures.contains(&13) && crate::figures::engines(results).is_some() {
        text.push_str("![Two engines on the case of Fig. 13](figures/engines.svg)\n\n");
    }
    text
}

fn profile_section(profiles: &[StressProfile]) -> String {
    let mut text = "## Fig. 21

The largest residual stress \u{3c3}_xx due to rolling alone under the wheel of Table 1, for steels that the
paper might have used, and for the two readings of the figure.

| profile | state | largest \u{3c3}_xx, MPa | at depth, mm |
|---|---|---|---|
"
    .to_owned();
    for profile in profiles {
        let (depth, stress) = profile.extreme();
        let state = profile.state.map_or("", RailState::word);
        let depth = if stress == 0.0 { String::new() } else { rounded(depth) };
        text.push_str(&format!("| {} | {state} | {} | {depth} |\n", profile.name, rounded(stress)));
    }
    text.push('\n');
    text.push_str("Statements of the paper on the stabilised state, decided for these steels in this order:\n\n| statement | where | rule |");
    let steels = profiles.iter().filter(|profile| profile.state.is_some()).count();
    text.push_str(&format!(
        "{} verdict |\n|---|---|---|{}---|\n",
        " |".repeat(steels),
        "---|".repeat(steels)
    ));
    for claim in ROLLED_CLAIMS {
        let decisions = claim.decisions(profiles);
        let cells: String =
            decisions.iter().map(|(_, holds)| if *holds { " yes |" } else { " no |" }).collect();
        let holding = decisions.iter().filter(|(_, holds)| *holds).count();
        let verdict = match holding {
            0 => "does not hold".to_owned(),
            all if all == decisions.len() => "holds".to_owned(),
            some => format!("holds in {some} of {}", decisions.len()),
        };
        text.push_str(&format!(
            "| {} | {} | {} |{cells} {verdict} |\n",
            claim.statement, claim.place, claim.rule
        ));
    }
    text.push('\n');
    text
}

fn numbers(verdicts: &[&Verdict], record: &PaperRecord) -> String {
    let mut text = "## Rules and numbers

K in MPa\u{221a}m, depths in mm. Numbers of all set-ups, unrounded, are in `claims.csv`; the texts of the
warnings of the runs behind a decision are in `statements.json` and `report.html`.

"
    .to_owned();
    for verdict in verdicts {
        let claim = verdict.claim;
        text.push_str(&format!(
            "**{}** ({}). {} *Rule:* {}.\n\n",
            claim.id, claim.place, claim.statement, claim.rule
        ));
        let departing: Vec<usize> = verdict.departures().iter().map(|(at, _)| *at).collect();
        let shown = verdict.decisions.iter().filter(|(at, _)| {
            *at < MAIN || departing.contains(at) || verdict.decision_of_varied(*at).is_none()
        });
        for (at, decision) in shown {
            let says = if decision.holds { "yes" } else { "no" };
            let name = SETUPS[*at].name;
            let told = record.statements.iter().find(|statement| statement.id == claim.id);
            let warnings = told.and_then(|statement| statement.decision(name)).map(|d| d.warnings.as_slice());
            let runs: Vec<&str> = warnings
                .unwrap_or_default()
                .iter()
                .filter_map(|warning| warning.split(", ").next())
                .collect();
            let warned =
                if runs.is_empty() { String::new() } else { format!(" (warnings: {})", runs.join("; ")) };
            text.push_str(&format!("* {name}: {says}; {}{warned}\n", decision.text()));
        }
        text.push('\n');
    }
    text
}

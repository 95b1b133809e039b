//! `paper.md`: every statement with its verdict, reasons for differences, set-ups.

use crate::claim::rounded;
use crate::closest::closest;
use crate::document::{FailureRecord, PaperRecord};
use crate::figure::FIGURES;
use crate::figure_group::GROUPS;
use crate::increment::on_the_increment;
use crate::profile::StressProfile;
use crate::results::Results;
use crate::rolled::ROLLED_CLAIMS;
use crate::setup::SETUPS;
use crate::verdict::Verdict;
use railcrack_run::VERSION;

/// The columns of `claims.csv`.
pub const CLAIMS_COLUMNS: &str = "claim,place,setup,holds,number,value";

/// Every decision and every number that it rests on.
pub(super) fn claims_table(verdicts: &[Verdict], profiles: &[StressProfile]) -> String {
    let mut text = format!("{CLAIMS_COLUMNS}\n");
    for verdict in verdicts {
        for (at, decision) in &verdict.decisions {
            let claim = verdict.claim;
            let start =
                format!("{},\"{}\",\"{}\",{}", claim.id, claim.place, SETUPS[*at].name, decision.holds);
            for number in &decision.numbers {
                text.push_str(&format!("{start},\"{}\",{:?}\n", number.name, number.value));
            }
        }
    }
    for claim in ROLLED_CLAIMS {
        for (steel, holds) in claim.decisions(profiles) {
            text.push_str(&format!("{},\"{}\",\"{steel}\",{holds},,\n", claim.id, claim.place));
        }
    }
    text
}

const HEAD: &str = "# The paper, recomputed

COMMAND

Trollé, Baietto, Gravouil, Mai & Prabel, *2D fatigue crack propagation in rails taking into account
actual plastic stresses*, Eng. Fract. Mech. 123 (2014) 163\u{2013}181, does not specify several inputs
that its results depend on: the supports of its block; whether the cracks lean along the travel or
against it; the sign of the wheel\u{2013}rail friction (text, caption and conclusion contradict each other
on Fig. 16); the crack-face friction in Figs 24 and 25 (0.5 in the text, 0.01 in the captions); the
load steps of a passage; whether k1 of a closed kink counts as zero; and whether Fig. 21 is the
plastic stress or the balanced one. Each statement of its text is therefore decided in several
set-ups, by a rule that a program can apply. The answer is a table: statement by set-up.

Statements and the few numbers in the text are compared, not the curves of the figures: these were
not available as numbers, and none were digitised. The text does not give the crack-face
frictions of Figs 17 and 18; those here (0.1, 0.2, 0.5, 0.8) and the borders of the layers of Fig. 21
are assumptions.

";

/// The page with the result; rules, numbers and pictures are on the pages of the groups of figures.
pub(super) fn page(figures: &[u8], results: &Results, verdicts: &[Verdict], record: &PaperRecord) -> String {
    let mut text = HEAD.replace("COMMAND", &command(figures));
    text.push_str(&summary(verdicts, record));
    text.push_str(&statements(verdicts));
    text.push_str(&on_the_increment(verdicts.iter().map(|verdict| verdict.claim)));
    text.push_str(&groups(figures, verdicts));
    text.push_str(&reference_ranges(results));
    text.push_str(&fixed_steps(verdicts));
    text.push_str(&setups(results));
    if !record.failures.is_empty() {
        text.push_str("## Runs that ended early\n\n");
        for FailureRecord { run, reason } in &record.failures {
            text.push_str(&format!("* `{run}`: {reason}\n"));
        }
        text.push('\n');
    }
    text.trim_end().to_owned() + "\n"
}

/// Origin of the page.
fn command(figures: &[u8]) -> String {
    let only = if figures.len() == FIGURES.len() {
        String::new()
    } else {
        let numbers: Vec<String> = figures.iter().map(u8::to_string).collect();
        format!(" --only {}", numbers.join(" "))
    };
    format!(
        "`paper.md` in the folder that `railcrack paper{only}` writes (version {VERSION}): computed,\nexcept for the column *why*, which is written by hand. The folder also has the case files, the numbers\nof each figure (`figures/*.csv`) and decision (`claims.csv`), and the effort of each run (`runs.csv`)."
    )
}

fn summary(verdicts: &[Verdict], record: &PaperRecord) -> String {
    let count = |start: &str| verdicts.iter().filter(|v| v.words().starts_with(start)).count();
    let only = count("holds only");
    let everywhere = count("holds") - only;
    let mut text = format!(
        "## Result\n\n{} statements, {} runs: {everywhere} hold in all of the main set-ups that\ndecide them, {only} in some set-ups only, {} in none.\n\n",
        verdicts.len(),
        record.runs,
        count("does not")
    );
    if let Some(closest) = closest(record) {
        text.push_str(&format!("{closest}\n\n"));
    }
    text
}

/// In colour where the page is rendered: ✅ holds, ❌ does not.
fn mark(verdict: &Verdict, at: usize) -> &'static str {
    verdict.decision(at).map_or("", |decision| if decision.holds { "\u{2705}" } else { "\u{274c}" })
}

fn statements(verdicts: &[Verdict]) -> String {
    let mut text = "## Statements

In the order of the paper: \u{2705} holds, \u{274c} does not hold, empty: not decided. *Along*: the cracks
lean along the travel of the wheel, which meets the mouth first and then passes over the tip;
*against*: they lean against it. The rule for each statement and its numbers are on the pages of
its figures. A variant is listed if its decision differs from that of the set-up that it varies.

| statement | where | half-plane, along | half-plane, against | block, along | block, against | variants that differ | verdict | why |
|---|---|---|---|---|---|---|---|---|
"
    .to_owned();
    for verdict in verdicts {
        let claim = verdict.claim;
        let departures: Vec<String> = verdict
            .departures()
            .iter()
            .map(|(at, d)| format!("{}: {}", SETUPS[*at].name, if d.holds { "yes" } else { "no" }))
            .collect();
        text.push_str(&format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            claim.statement,
            claim.place,
            mark(verdict, 0),
            mark(verdict, 1),
            mark(verdict, 2),
            mark(verdict, 3),
            departures.join("; "),
            verdict.words(),
            claim.why
        ));
    }
    text.push('\n');
    text
}

/// ΔK of the initial crack of Table 1 and of Fig. 13 in every set-up: supports, fixed steps,
/// engines, E.
fn reference_ranges(results: &Results) -> String {
    let mut rows = String::new();
    for r in results.setups() {
        let range = |name: &str| r.run(name).map(|run| (run.crack().delta_ki(), run.crack().delta_kii()));
        let parent = r.setup().varies.unwrap_or(r.setup().name);
        if parent != r.setup().name && !r.setup().changes_k() {
            continue;
        }
        // How far K of the curve is from that in the set-up it varies, where the positions are the
        // same.
        let off = |name: &str| {
            let (mine, other) = (r.run(name)?, r.elsewhere(parent, name)?);
            Some(100.0 * mine.crack().sif.difference(&other.crack().sif))
        };
        let cell = |name: &str| match (range(name), off(name)) {
            (Some((ki, kii)), Some(off)) if parent != r.setup().name => {
                // Smaller values are round-off.
                let off = if off < 1e-3 { "0".to_owned() } else { rounded(off) };
                format!("{} | {} | {off}", rounded(ki), rounded(kii))
            }
            (Some((ki, kii)), _) => format!("{} | {} | ", rounded(ki), rounded(kii)),
            (None, _) => " | | ".into(),
        };
        if range("reference").is_some() || range("fig13").is_some() {
            rows.push_str(&format!("| {} | {} | {} |\n", r.setup().name, cell("reference"), cell("fig13")));
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "## Effect of the set-up on K

\u{394}K_I and \u{394}K_II of the initial crack, and the largest difference of K from the set-up
that is varied, in per cent of its peak: supports, fixed load steps, engines, Young's modulus. Fixed
steps of 0.1 a and 0.05 a show the error without load step control.

| set-up | Table 1 \u{394}K_I | \u{394}K_II | difference % | Fig. 13 \u{394}K_I | \u{394}K_II | difference % |
|---|---|---|---|---|---|---|
{rows}
"
    )
}

/// Effect of fixed load steps on the verdicts.
fn fixed_steps(verdicts: &[Verdict]) -> String {
    let of = |verdict: &Verdict, departing: bool| -> Vec<&'static str> {
        let places: Vec<usize> = if departing {
            verdict.departures().iter().map(|(at, _)| *at).collect()
        } else {
            verdict.decisions.iter().map(|(at, _)| *at).collect()
        };
        places.into_iter().filter(|at| SETUPS[*at].has_fixed_steps()).map(|at| SETUPS[at].name).collect()
    };
    let decided: usize = verdicts.iter().map(|verdict| of(verdict, false).len()).sum();
    if decided == 0 {
        return String::new();
    }
    let mut text = format!("Of the {decided} decisions with fixed load steps, ");
    let rows: Vec<String> = verdicts
        .iter()
        .filter(|verdict| !of(verdict, true).is_empty())
        .map(|verdict| format!("{} ({})", verdict.claim.id, of(verdict, true).join("; ")))
        .collect();
    match rows.is_empty() {
        true => text.push_str("none differs from that with controlled load steps.\n\n"),
        false => text.push_str(&format!(
            "these differ from those with controlled load steps: {}.\n\n",
            rows.join(", ")
        )),
    }
    text
}

/// Links to the pages of the groups.
fn groups(figures: &[u8], verdicts: &[Verdict]) -> String {
    let mut text = "## Figures, rules and numbers\n\n".to_owned();
    for group in GROUPS.iter().filter(|group| group.is_computed(figures)) {
        let count = verdicts.iter().filter(|verdict| group.decides(verdict.claim)).count();
        let statements = match count {
            0 => String::new(),
            1 => ": 1 statement".to_owned(),
            more => format!(": {more} statements"),
        };
        text.push_str(&format!("* [{}]({}){statements}\n", group.heading(), group.file()));
    }
    text.push('\n');
    text
}

fn setups(results: &Results) -> String {
    let mut text = "## Set-ups\n\n| name | description |\n|---|---|\n".to_owned();
    for r in results.setups() {
        text.push_str(&format!("| {} | {} |\n", r.setup().name, r.setup().words));
    }
    text.push('\n');
    text
}

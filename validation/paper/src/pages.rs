//! The pages: `statements.md` with every statement, and a page of each group of figures.

use crate::error::PaperError;
use crate::results::{Results, SetupResults};
use crate::rolled::StressProfile;
use crate::rules::rounded;
use crate::tables::{Group, MAIN, Paper, home};
use crate::verdict::{Verdict, closest};
use railcrack::shakedown::RailState;
use railcrack::words::Choice;
use railcrack_run::OutputError;

/// The page with every statement.
pub const STATEMENTS: &str = "statements.md";

/// Contents from which the pages are written.
pub struct Contents<'a> {
    /// The tables of the paper.
    pub paper: &'a Paper,
    /// The recomputed figures.
    pub figures: &'a [u8],
    /// Their runs.
    pub results: &'a Results,
    /// The statements that they decide.
    pub verdicts: &'a [Verdict<'a>],
    /// The profiles of Fig. 21; empty if it is not recomputed.
    pub profiles: &'a [StressProfile],
}

impl Group {
    fn ends(&self) -> (u8, u8) {
        let first = self.figures.first().copied().unwrap_or_default();
        (first, self.figures.last().copied().unwrap_or(first))
    }

    /// `Figs 14 to 16: Wheel–rail friction`, the heading of its page.
    fn heading(&self) -> String {
        match self.ends() {
            (first, last) if first == last => format!("Fig. {first}: {}", self.title),
            (first, last) => format!("Figs {first} to {last}: {}", self.title),
        }
    }

    /// `figs-14-16.md`, the file of its page.
    pub fn file(&self) -> String {
        match self.ends() {
            (first, last) if first == last => format!("fig-{first}.md"),
            (first, last) => format!("figs-{first}-{last}.md"),
        }
    }

    /// Whether its figures decide the statement of `verdict`; of the figures of a statement the
    /// first counts.
    pub fn decides(&self, verdict: &Verdict) -> bool {
        verdict.claim.figures.first().is_some_and(|figure| self.figures.contains(figure))
    }
}

/// In colour where the page is rendered: ✅ holds, ❌ does not.
fn mark(holds: bool) -> &'static str {
    if holds { "\u{2705}" } else { "\u{274c}" }
}

/// Lines of a page.
fn lines(rows: impl Iterator<Item = String>) -> String {
    rows.collect::<Vec<_>>().join("\n")
}

impl Contents<'_> {
    /// `claims.csv`: every decision and every number that it rests on.
    pub fn claims_table(&self) -> String {
        let mut text = "claim,place,setup,holds,number,value\n".to_owned();
        for Verdict { claim, decisions, .. } in self.verdicts {
            for (at, decision) in decisions {
                let setup = &self.paper.setups[*at].name;
                let start = format!("{},\"{}\",\"{setup}\",{}", claim.id, claim.place, decision.holds);
                for (name, value) in &decision.numbers {
                    text.push_str(&format!("{start},\"{name}\",{value:?}\n"));
                }
            }
        }
        for claim in &self.paper.rolled {
            for (steel, holds) in claim.decisions(self.profiles) {
                text.push_str(&format!("{},\"{}\",\"{steel}\",{holds},,\n", claim.id, claim.place));
            }
        }
        text
    }

    /// `statements.md`, the page with every statement.
    ///
    /// Errors: the system refuses.
    pub fn statements(&self) -> Result<String, PaperError> {
        let path = home().join(STATEMENTS);
        let template = std::fs::read_to_string(&path).map_err(OutputError::io("read", &path))?;
        let main: Vec<&str> = self.paper.setups[..MAIN].iter().map(|setup| setup.name.as_str()).collect();
        let setups = self.results.setups(self.paper).map(SetupResults::setup);
        let parts = [
            ("{result}", self.result()),
            ("{main}", main.join(" | ")),
            ("{statements}", lines(self.verdicts.iter().map(|verdict| self.row(verdict)))),
            ("{groups}", self.groups()),
            ("{ranges}", lines(self.results.setups(self.paper).filter_map(ranges))),
            ("{fixed steps}", self.fixed_steps()),
            ("{setups}", lines(setups.map(|setup| format!("| {} | {} |", setup.name, setup.words)))),
            ("{failures}", self.failures()),
        ];
        let page = parts.iter().fold(template, |page, (place, part)| page.replace(place, part));
        Ok(page.trim_end().to_owned() + "\n")
    }

    /// The result in a few sentences.
    pub fn result(&self) -> String {
        let count = |start: &str| self.verdicts.iter().filter(|v| v.words().starts_with(start)).count();
        let only = count("holds only");
        format!(
            "{} statements, {} runs: {} hold in all of the main set-ups that decide them, {only} in some set-ups only, {} in none. {}",
            self.verdicts.len(),
            self.results.count,
            count("holds") - only,
            count("does not"),
            closest(self.verdicts).words(self.paper)
        )
    }

    /// The row of a statement in the table of all.
    pub fn row(&self, verdict: &Verdict) -> String {
        let claim = verdict.claim;
        let marks = (0..MAIN).map(|at| verdict.decision(at).map_or("", |decision| mark(decision.holds)));
        let departing = verdict.decisions.iter().filter(|(at, _)| verdict.departs(*at));
        let departing = departing.map(|(at, d)| format!("{}: {}", self.paper.setups[*at].name, d.answer()));
        format!(
            "| {} | {} | {} | {} | {} | {} |",
            claim.statement,
            claim.place,
            marks.collect::<Vec<_>>().join(" | "),
            departing.collect::<Vec<_>>().join("; "),
            verdict.words(),
            claim.why
        )
    }

    /// Links to the pages of the groups.
    fn groups(&self) -> String {
        let computed = self.paper.groups.iter().filter(|group| self.has(group));
        lines(computed.map(|group| {
            let statements = match self.verdicts.iter().filter(|verdict| group.decides(verdict)).count() {
                0 => String::new(),
                1 => ": 1 statement".to_owned(),
                more => format!(": {more} statements"),
            };
            format!("* [{}]({}){statements}", group.heading(), group.file())
        }))
    }

    /// Whether some figures of `group` are recomputed.
    pub fn has(&self, group: &Group) -> bool {
        group.figures.iter().any(|figure| self.figures.contains(figure))
    }

    /// Effect of fixed load steps on the verdicts.
    fn fixed_steps(&self) -> String {
        let fixed = |at: usize| self.paper.setups[at].row.fixed_steps;
        let decisions = self.verdicts.iter().flat_map(|verdict| {
            verdict.decisions.iter().map(move |(at, _)| (verdict, *at)).filter(|(_, at)| fixed(*at))
        });
        let decisions: Vec<(&Verdict, usize)> = decisions.collect();
        let departing = decisions.iter().filter(|(verdict, at)| verdict.departs(*at));
        let departing =
            departing.map(|(verdict, at)| format!("{} ({})", verdict.claim.id, self.paper.setups[*at].name));
        let departing = departing.collect::<Vec<_>>().join(", ");
        let all = decisions.len();
        match departing.is_empty() {
            true => format!(
                "Of the {all} decisions with fixed load steps, none differs from that with controlled load steps."
            ),
            false => format!(
                "Of the {all} decisions with fixed load steps, these differ from those with controlled load steps: {departing}."
            ),
        }
    }

    fn failures(&self) -> String {
        let failures = self.results.failures.iter().map(|(run, reason)| format!("* `{run}`: {reason}"));
        let failures = lines(failures);
        if failures.is_empty() { failures } else { format!("\n## Runs that ended early\n\n{failures}\n") }
    }

    /// The page of `group`: its figures, its statements with their rules and numbers.
    pub fn group_page(&self, group: &Group) -> String {
        let mut text = format!(
            "# {}\n\nPart of [the paper, recomputed](../../../docs/paper.md); [the set-ups](statements.md#set-ups).\n\n\
             K: half-plane solid, block dashed. The numbers of all set-ups are in `figures/*.csv`.\n\n",
            group.heading()
        );
        let is_drawn = |number: &u8| group.figures.contains(number) && self.figures.contains(number);
        for figure in self.paper.figures.iter().filter(|figure| is_drawn(&figure.number)) {
            let number = figure.number;
            text.push_str(&format!("![Fig. {number}: {}](figures/fig{number}.svg)\n\n", figure.title));
        }
        if group.figures.contains(&13) {
            text.push_str("![Two engines on the case of Fig. 13](figures/engines.svg)\n\n");
        }
        if group.figures.contains(&21) && !self.profiles.is_empty() {
            text.push_str(&self.profile_section());
        }
        text.push_str(
            "## Rules and numbers\n\nK in MPa√m, depths in mm. Numbers of all set-ups, unrounded, are in `claims.csv`; the texts of the\nwarnings of the runs behind a decision are in `runs.csv`.\n\n",
        );
        for verdict in self.verdicts.iter().filter(|verdict| group.decides(verdict)) {
            text.push_str(&self.numbers(verdict));
        }
        text.trim_end().to_owned() + "\n"
    }

    fn numbers(&self, verdict: &Verdict) -> String {
        let claim = verdict.claim;
        let mut text =
            format!("**{}** ({}). {} *Rule:* {}.\n\n", claim.id, claim.place, claim.statement, claim.rule);
        for (at, decision) in verdict.shown() {
            let name = &self.paper.setups[*at].name;
            let warned = self.results.setup(self.paper, name);
            let warned = warned.map(|r| r.curves_with_warnings(&claim.figures)).unwrap_or_default();
            let warned =
                if warned.is_empty() { String::new() } else { format!(" (warnings: {})", warned.join("; ")) };
            text.push_str(&format!("* {name}: {}{warned}\n", decision.text()));
        }
        text + "\n"
    }

    fn profile_section(&self) -> String {
        let profile = |profile: &StressProfile| {
            let [stress, depth] = profile.extreme();
            let state = profile.state.map_or("", RailState::word);
            let depth = if stress == 0.0 { String::new() } else { rounded(depth) };
            format!("| {} | {state} | {} | {depth} |", profile.name, rounded(stress))
        };
        let claims = self.paper.rolled.iter().map(|claim| {
            let decisions = claim.decisions(self.profiles);
            let cells: String =
                decisions.iter().map(|(_, holds)| if *holds { " yes |" } else { " no |" }).collect();
            let verdict = match decisions.iter().filter(|(_, holds)| *holds).count() {
                0 => "does not hold".to_owned(),
                all if all == decisions.len() => "holds".to_owned(),
                some => format!("holds in {some} of {}", decisions.len()),
            };
            format!("| {} | {} | {} |{cells} {verdict} |", claim.statement, claim.place, claim.rule)
        });
        let steels = self.profiles.iter().filter(|profile| profile.state.is_some()).count();
        format!(
            "## Fig. 21

The largest residual stress σ_xx due to rolling alone under the wheel of Table 1, for steels that the
paper might have used, and for the two readings of the figure.

| profile | state | largest σ_xx, MPa | at depth, mm |
|---|---|---|---|
{}

Statements of the paper on the stabilised state, decided for these steels in this order:

| statement | where | rule |{} verdict |
|---|---|---|{}---|
{}

",
            lines(self.profiles.iter().map(profile)),
            " |".repeat(steels),
            "---|".repeat(steels),
            lines(claims)
        )
    }
}

/// ΔK of the initial crack of Table 1 and of Fig. 13 in the set-up of `r`, and how far K is from
/// that in the set-up that it varies; none where it does not change K.
fn ranges(r: SetupResults) -> Option<String> {
    let setup = r.setup();
    if setup.row.same_k {
        return None;
    }
    let varied = setup.varies.as_ref().and_then(|name| r.elsewhere(name));
    let cell = |name: &str| {
        let crack = r.crack(name)?;
        let first = crack.steps.first()?;
        let off = varied.and_then(|varied| varied.crack(name));
        let off = off.map(|other| 100.0 * crack.sif.difference(&other.sif));
        // Smaller values are round-off.
        let off = off.map_or_else(String::new, |off| if off < 1e-3 { "0".to_owned() } else { rounded(off) });
        Some(format!("{} | {} | {off}", rounded(first.delta_ki), rounded(first.delta_kii)))
    };
    let (table_1, fig_13) = (cell("reference"), cell("fig13"));
    let shown = |cell: &Option<String>| cell.clone().unwrap_or_else(|| " | | ".to_owned());
    (table_1.is_some() || fig_13.is_some())
        .then(|| format!("| {} | {} | {} |", setup.name, shown(&table_1), shown(&fig_13)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_and_statement_has_one_page() {
        let paper = Paper::read().unwrap();
        for figure in &paper.figures {
            let groups = paper.groups.iter().filter(|group| group.figures.contains(&figure.number));
            assert_eq!(groups.count(), 1, "Fig. {}", figure.number);
        }
        for claim in &paper.claims {
            let verdict = Verdict::new(&paper, claim, Vec::new());
            assert_eq!(paper.groups.iter().filter(|g| g.decides(&verdict)).count(), 1, "{}", claim.id);
        }
    }
}

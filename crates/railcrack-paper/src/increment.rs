//! Statements on crack paths that depend on the increment of the paper.

use crate::claim::Claim;

/// Decisions in the half-plane by travel and increment, made with `tools/path_limit.py`.
const DECISIONS: &str = include_str!("../path/statements.csv");

/// The increments of the table: the fraction of the length, and the heading.
const INCREMENTS: [(&str, &str); 7] = [
    ("0.16", "16 %"),
    ("0.08", "8 %"),
    ("0.04", "4 %"),
    ("0.02", "2 %"),
    ("0.01", "1 %"),
    ("0.005", "0.5 %"),
    ("l", "ℓ = 0.5 mm"),
];

/// The section on the increment: which of `claims` it decides; empty where none concerns a path.
pub(super) fn on_the_increment<'a>(claims: impl Iterator<Item = &'a Claim>) -> String {
    let mut rows = String::new();
    let (mut decided, mut dependent) = (0, 0);
    for claim in claims {
        let id = claim.id;
        let mut depends = false;
        let by_travel = ["along", "against"].map(|travel| {
            (travel, INCREMENTS.map(|(increment, _)| decision(DECISIONS, travel, increment, id)))
        });
        if by_travel.iter().all(|(_, all)| all.iter().all(Option::is_none)) {
            continue;
        }
        decided += 1;
        for (travel, all) in by_travel {
            let mut known = all.iter().flatten();
            let first = known.next();
            if known.all(|other| Some(other) == first) {
                continue;
            }
            depends = true;
            let cells = all.map(|one| match one {
                Some(true) => "\u{2705}",
                Some(false) => "\u{274c}",
                None => "",
            });
            rows.push_str(&format!("| {} | {travel} | {} |\n", claim.statement, cells.join(" | ")));
        }
        dependent += usize::from(depends);
    }
    if decided == 0 {
        return String::new();
    }
    let headings = INCREMENTS.map(|(_, heading)| heading).join(" | ");
    format!(
        "## Statements that depend on the increment

The paper grows its cracks by 4 % of their length, and kinks them by the whole angle of the direction
criterion in each increment. The best kink of a tip that slides in both directions does not vanish
with the increment, so that half the increment gives nearly twice the curvature, and the path has no
limit that can be reached. Of the {decided} statements on the paths of one and two cracks decided here,
{dependent} have another answer with another increment: they say something about the increment as well as
about the crack. Decided in the half-plane, by the rules below with lengths instead of numbers of
increments, empty where not computed; the last column has a path that turns over a length ℓ, which
does not depend on the increment.

| statement | travel | {headings} |
|---|---|{}
{rows}
![Life and path over the increment](figures/increments.svg)

The life to 11 mm and the depth of the tip there, in the half-plane along the travel; a path that met
itself before has no dot.

",
        "---|".repeat(INCREMENTS.len())
    )
}

/// Whether the statement `id` holds in the rows of `table` for this travel and increment; none if
/// it has not been decided.
fn decision(table: &str, travel: &str, increment: &str, id: &str) -> Option<bool> {
    let start = format!("{travel},{increment},{id},");
    let row = table.lines().find_map(|line| line.strip_prefix(&start))?;
    match row.split(',').next()? {
        "yes" => Some(true),
        "no" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::CLAIMS;

    #[test]
    fn decisions_are_read_by_travel_increment_and_statement() {
        let table = "# note\ntravel,increment,statement,holds,paths\nalong,0.04,5.2-sides,yes,\"up; down\"\n\
            along,0.04,5.2-sides-too,no,up\n";
        assert_eq!(decision(table, "along", "0.04", "5.2-sides"), Some(true));
        assert_eq!(decision(table, "along", "0.04", "5.2-sides-too"), Some(false));
        assert_eq!(decision(table, "against", "0.04", "5.2-sides"), None);
    }

    #[test]
    fn the_page_in_docs_has_the_section() {
        let section = on_the_increment(CLAIMS.iter().copied().flatten());
        assert!(include_str!("../../../docs/paper.md").contains(&section), "docs/paper.md lacks\n{section}");
        assert_eq!(
            on_the_increment(CLAIMS.iter().copied().flatten().filter(|claim| claim.figures == [13u8])),
            ""
        );
    }

    #[test]
    fn every_decision_is_of_a_statement_and_of_an_increment_of_the_table() {
        let rows = DECISIONS.lines().filter(|line| !line.starts_with('#')).skip(1);
        let mut count = 0;
        for row in rows {
            let cells: Vec<&str> = row.split(',').collect();
            assert!(INCREMENTS.iter().any(|(increment, _)| *increment == cells[1]), "{row}");
            assert!(CLAIMS.iter().copied().flatten().any(|claim| claim.id == cells[2]), "{row}");
            count += 1;
        }
        assert!(count > 200, "{count}");
    }
}

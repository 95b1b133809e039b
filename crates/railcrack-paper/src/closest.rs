//! The set-up in which most statements of the paper hold.

use crate::document::{PaperRecord, StatementRecord};

/// The main set-up that is closest to the paper, in a sentence with the counts that say so; none
/// where fewer than two main set-ups were computed. Only statements that all main set-ups decide
/// are counted, so that the counts can be compared.
pub(super) fn closest(record: &PaperRecord) -> Option<String> {
    let main: Vec<&str> = record.main_setups().map(|setup| setup.name.as_str()).collect();
    let in_all = |statement: &&StatementRecord| main.iter().all(|name| statement.decision(name).is_some());
    let decided: Vec<&StatementRecord> = record.statements.iter().filter(in_all).collect();
    let holding = |name: &str| {
        decided.iter().filter(|statement| statement.decision(name).is_some_and(|d| d.holds)).count()
    };
    let counts: Vec<(&str, usize)> = main.iter().map(|name| (*name, holding(name))).collect();
    let most = counts.iter().map(|(_, count)| *count).max()?;
    if counts.len() < 2 || decided.is_empty() {
        return None;
    }
    let [best, others] = [true, false].map(|is_best| {
        counts.iter().filter(|(_, count)| (*count == most) == is_best).copied().collect::<Vec<_>>()
    });
    let names =
        best.iter().map(|(name, _)| format!("\u{201c}{name}\u{201d}")).collect::<Vec<_>>().join(" and ");
    let rest = others.iter().map(|(name, count)| format!("{count} in \u{201c}{name}\u{201d}"));
    let rest = rest.collect::<Vec<_>>().join(", ");
    let all = decided.len();
    Some(if others.is_empty() {
        format!(
            "No main set-up is closest to the paper: of the {all} statements decided by all of them, {most} hold in each."
        )
    } else {
        format!(
            "Closest to the paper is {names}: of the {all} statements decided by all main set-ups, {most} hold there, compared with {rest}."
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{DecisionRecord, SetupRecord};

    fn setup(name: &str, varies: Option<&str>) -> SetupRecord {
        SetupRecord { name: name.into(), words: String::new(), varies: varies.map(Into::into) }
    }

    fn statement(decisions: &[(&str, bool)]) -> StatementRecord {
        let decision = |&(setup, holds): &(&str, bool)| DecisionRecord {
            setup: setup.into(),
            holds,
            numbers: Vec::new(),
            warnings: Vec::new(),
        };
        StatementRecord {
            id: String::new(),
            place: String::new(),
            statement: String::new(),
            rule: String::new(),
            verdict: String::new(),
            why: String::new(),
            decisions: decisions.iter().map(decision).collect(),
        }
    }

    #[test]
    fn only_statements_that_all_main_setups_decide_count() {
        let mut record = PaperRecord {
            version: String::new(),
            runs: 0,
            figures: Vec::new(),
            curves: Vec::new(),
            setups: vec![setup("a", None), setup("b", None), setup("a, varied", Some("a"))],
            statements: vec![
                statement(&[("a", true), ("b", false), ("a, varied", false)]),
                statement(&[("a", true), ("b", true)]),
                statement(&[("b", true)]),
                statement(&[("b", true)]),
            ],
            failures: Vec::new(),
        };
        let text = closest(&record).unwrap();
        assert!(text.contains("\u{201c}a\u{201d}: of the 2 statements"), "{text}");
        assert!(text.ends_with("2 hold there, compared with 1 in \u{201c}b\u{201d}."), "{text}");
        record.statements.remove(0);
        assert!(closest(&record).unwrap().starts_with("No main set-up"));
        record.setups.truncate(1);
        assert_eq!(closest(&record), None);
    }
}

//! Warnings of many steps that say the same, as one.

use super::parts::WarningSummary;
use super::validity::pattern;
use railcrack::growth::Warning;

/// The `warnings` of the steps of a run, in order, without repetition: of those that say the same
/// with other numbers, about whatever tip or wheel, the gravest, and of those with the same text
/// the first, with the number of steps concerned.
pub(super) fn condensed<'a>(warnings: impl Iterator<Item = &'a Warning>) -> Vec<WarningSummary> {
    let mut groups: Vec<Group> = Vec::new();
    for warning in warnings {
        let says = if warning.severity.is_some() { pattern(&warning.text) } else { warning.text.clone() };
        let group = groups
            .iter_mut()
            .find(|group| (group.says.as_str(), group.worst.kind) == (says.as_str(), warning.kind));
        let Some(group) = group else {
            groups.push(Group { says, worst: warning, last: warning.step, steps: 1 });
            continue;
        };
        if group.last != warning.step {
            group.last = warning.step;
            group.steps += 1;
        }
        if warning.severity > group.worst.severity {
            group.worst = warning;
        }
    }
    groups
        .into_iter()
        .map(|group| WarningSummary {
            steps: Some(group.steps),
            ..WarningSummary::of_step(group.worst.clone())
        })
        .collect()
}

/// Warnings that say the same.
struct Group<'a> {
    says: String,
    worst: &'a Warning,
    /// The last step with one.
    last: usize,
    /// The number of steps with one.
    steps: usize,
}

#[cfg(test)]
mod tests {
    use super::*;
    use railcrack::growth::WarningKind;

    fn tie(step: usize, crack: usize, angle: f64, ratio: f64) -> Warning {
        let text = format!("crack {crack} tip 1: kinks of {angle:.1} and 20.0 degrees, ratio {ratio:.3}");
        Warning { step, kind: WarningKind::NearTie, text, severity: Some(ratio) }
    }

    #[test]
    fn the_worst_of_many_steps_with_their_number() {
        let all =
            [tie(3, 1, -74.0, 0.985), tie(3, 2, 71.0, 0.981), tie(4, 1, 73.0, 0.999), tie(9, 2, 0.1, 0.99)];
        let found = condensed(all.iter());
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].step, found[0].steps), (4, Some(3)));
        assert!(found[0].text.contains("0.999"), "{found:?}");
    }

    #[test]
    fn other_statements_stay_apart() {
        let other = |step: usize, text: &str, severity| Warning {
            step,
            kind: WarningKind::Engine,
            text: text.to_owned(),
            severity,
        };
        let all = [
            other(1, "a flap of 3 degrees", None),
            other(1, "K still changes by 1.00e-2", Some(1e-2)),
            other(2, "a flap of 4 degrees", None),
            other(3, "a flap of 3 degrees", None),
            tie(3, 1, 2.0, 0.99),
            other(4, "K still changes by 2.00e-3", Some(2e-3)),
        ];
        let found: Vec<_> = condensed(all.iter()).iter().map(|one| (one.step, one.steps)).collect();
        assert_eq!(found, [(1, Some(2)), (1, Some(2)), (2, Some(1)), (3, Some(1))]);
    }
}

//! The decisions, for `statements.json` and the report.

use crate::curve::CURVES;
use crate::document::{
    CurveRecord, DecisionRecord, FailureRecord, FigureRecord, NumberRecord, PaperRecord, SetupRecord,
    StatementRecord,
};
use crate::figure::FIGURES;
use crate::results::Results;
use crate::setup::SETUPS;
use crate::verdict::Verdict;
use railcrack_run::VERSION;

pub(super) fn record(
    figures: &[u8],
    results: &Results,
    verdicts: &[Verdict],
    failures: &[(String, String)],
    runs: usize,
) -> PaperRecord {
    PaperRecord {
        version: VERSION.into(),
        runs,
        figures: FIGURES
            .iter()
            .filter(|figure| figures.contains(&figure.number))
            .map(|figure| FigureRecord { number: figure.number, title: figure.title.into() })
            .collect(),
        curves: CURVES
            .iter()
            .map(|curve| CurveRecord { name: curve.name.into(), legend: curve.legend.into() })
            .collect(),
        setups: results
            .setups()
            .map(|r| r.setup())
            .map(|setup| SetupRecord {
                name: setup.name.into(),
                words: setup.words.into(),
                varies: setup.varies.map(Into::into),
            })
            .collect(),
        statements: verdicts.iter().map(|verdict| statement(verdict, results)).collect(),
        failures: failures
            .iter()
            .map(|(run, reason)| FailureRecord { run: run.clone(), reason: reason.clone() })
            .collect(),
    }
}

fn statement(verdict: &Verdict, results: &Results) -> StatementRecord {
    let claim = verdict.claim;
    StatementRecord {
        id: claim.id.into(),
        place: claim.place.into(),
        statement: claim.statement.into(),
        rule: claim.rule.into(),
        verdict: verdict.words(),
        why: claim.why.into(),
        decisions: verdict
            .decisions
            .iter()
            .map(|(setup, decision)| DecisionRecord {
                setup: SETUPS[*setup].name.into(),
                holds: decision.holds,
                numbers: decision
                    .numbers
                    .iter()
                    .map(|number| NumberRecord {
                        name: number.name.clone(),
                        value: number.value.is_finite().then_some(number.value),
                    })
                    .collect(),
                warnings: results
                    .setup(SETUPS[*setup].name)
                    .map_or_else(Vec::new, |r| r.warnings(claim.figures)),
            })
            .collect(),
    }
}

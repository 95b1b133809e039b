//! `summary.csv` and `times.csv` of a study.

use super::plan::StudyPlan;
use super::results::StudyResults;
use super::state::{RunState, StudyRow};
use crate::csv::{Rows, Table, column_names, header_of, line_fields, table, whole};
use crate::decision::{FailureMode, Verdict};
use crate::error::OutputError;
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use std::collections::HashSet;

table! {
    /// A run of a study, following its number, its folder and the values of the keys that vary.
    #[derive(Debug, Clone, PartialEq)]
    pub struct StudySummaryRow in "summary.csv", [
        "One row per run of the study, in its order; folder: in runs/; then the keys that vary, as in the case file",
        "state: done, not-converged, cannot-read-or-write (reason: why), unfinished (interrupted, or being computed), missing",
        "stop: why the run ended; steps: increments done; load_cycles: axles at the start of the last finished step",
        "crack, tip: the tip of the crack that grew most (in a tie, the one with the largest delta_keq); the following columns refer to this tip",
        "initial_length_mm, length_mm: of its crack at step 0 and at the last finished step; tip_x_mm, tip_y_mm: position at that step, y upwards",
        "ki_max ... rate: step 0, stabilised passage; K: MPa sqrt(m); kii_peak: the largest |K_II|; angle: from straight ahead",
        "verdict, reasons (kinds, the gravest first), failure (mode), failure_mgt, failure_crack: as in the decision of summary.json",
        "empty: not computed, or not applicable. Wall times are in times.csv",
    ] {
        /// `done`; `not-converged` or `cannot-read-or-write`, with the `reason`; `unfinished`:
        /// interrupted, or being computed; `missing`: no step yet.
        state: String = "state";
        /// As in `summary.json`.
        stop: Option<RunStop> = "stop";
        /// As in `summary.json`.
        steps: Option<usize> = "steps";
        /// As in `summary.json`.
        load_cycles: Option<f64> = "load_cycles";
        /// As in `summary.json`.
        million_gross_tonnes: Option<f64> = "million_gross_tonnes";
        /// The representative tip: that of the crack that grew most; in a tie, the one with the
        /// largest ΔK_eq in step 0, then the first. The following columns refer to this tip.
        crack: Option<usize> = "crack";
        /// The representative tip: that of the crack that grew most; in a tie, the one with the
        /// largest ΔK_eq in step 0, then the first. The following columns refer to this tip.
        tip: Option<usize> = "tip";
        /// Length of its crack in step 0 and in the last finished step, mm.
        initial_length: Option<f64> = "initial_length_mm";
        /// Length of its crack in step 0 and in the last finished step, mm.
        length: Option<f64> = "length_mm";
        /// Its position in the last finished step, mm.
        x: Option<f64> = "tip_x_mm";
        /// Its position in the last finished step, mm.
        y: Option<f64> = "tip_y_mm";
        /// Of step 0, as in `growth.csv`.
        ki_max: Option<f64> = "ki_max_mpa_sqrt_m";
        /// Largest \|K_II\| of the stabilised passage of step 0, MPa√m.
        kii_peak: Option<f64> = "kii_peak_mpa_sqrt_m";
        /// Of step 0, as in `growth.csv`.
        delta_ki: Option<f64> = "delta_ki_mpa_sqrt_m";
        /// Of step 0, as in `growth.csv`.
        delta_kii: Option<f64> = "delta_kii_mpa_sqrt_m";
        /// Of step 0, as in `growth.csv`.
        delta_keq: Option<f64> = "delta_keq_mpa_sqrt_m";
        /// Of step 0, as in `growth.csv`.
        kink_deg: Option<f64> = "kink_angle_deg";
        /// Of step 0, as in `growth.csv`.
        rate: Option<f64> = "rate_mm_per_cycle";
        /// As in `summary.json`.
        passages: Option<usize> = "passages";
        /// Number of warnings.
        warnings: Option<usize> = "warnings";
        /// Why a failed run failed.
        reason: Option<String> = "reason";
        /// Level of the verdict: `ok`, `act`, `unknown`, `stop` or `outside`; without axle loads
        /// only `outside`, or empty.
        verdict: Option<String> = "verdict";
        /// Kinds of the reasons of the verdict, the gravest first, separated by spaces.
        reasons: Option<String> = "reasons";
        /// Mode of the first failure over all cracks and tips, or `none`; empty without axle loads.
        failure: Option<String> = "failure";
        /// Million gross tonnes until then.
        failure_mgt: Option<f64> = "failure_mgt";
        /// Its crack.
        failure_crack: Option<usize> = "failure_crack";
    }
}

table! {
    /// Cost of a run of a study.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct TimesRow in "times.csv", [
        "Wall time of each run and its resumptions, seconds, by phase; peak_memory_mb: of the process that computed it",
        "Meshes and factors shared by several runs are computed beforehand and not included in any row",
    ] {
        /// Number of the run.
        run: usize = "run";
        /// Wall time of the run and its resumptions, s.
        wall_s: Option<f64> = "wall_s";
        /// Part of it spent on the cracked body.
        body_s: Option<f64> = "body_s";
        /// Part of it spent on loads and contact.
        contact_s: Option<f64> = "contact_s";
        /// Part of it spent on direction, rate and increments.
        growth_s: Option<f64> = "growth_s";
        /// Part of it spent on the run folder.
        output_s: Option<f64> = "output_s";
        /// Peak memory of the process that computed it, 10⁶ bytes.
        peak_memory_mb: Option<f64> = "peak_memory_mb";
    }
}

impl From<&StudyRow> for StudySummaryRow {
    fn from(row: &StudyRow) -> Self {
        let summary = row.summary.as_ref();
        let tip = row.representative.as_ref();
        let (first, last) = (tip.map(|tip| &tip.first), tip.map(|tip| tip.last()));
        let verdict = summary.and_then(|summary| summary.verdict.as_ref());
        let failure = summary.and_then(|summary| Some(summary.decision.as_ref()?.failure));
        let peak = |values: &[f64]| values.iter().fold(0.0, |peak: f64, k| peak.max(k.abs()));
        Self {
            state: row.state.name().to_owned(),
            stop: summary.and_then(|summary| summary.stop),
            steps: summary.map(|summary| summary.steps),
            load_cycles: summary.map(|summary| summary.load_cycles),
            million_gross_tonnes: summary.and_then(|summary| summary.million_gross_tonnes),
            crack: first.map(|first| first.crack),
            tip: first.map(|first| first.tip),
            initial_length: first.map(|first| first.length),
            length: last.map(|last| last.length),
            x: last.map(|last| last.place[0]),
            y: last.map(|last| last.place[1]),
            ki_max: first.map(|first| first.ki_max),
            kii_peak: tip.map(|tip| peak(&tip.history.kii)),
            delta_ki: first.map(|first| first.delta_ki),
            delta_kii: first.map(|first| first.delta_kii),
            delta_keq: first.map(|first| first.delta_keq),
            kink_deg: first.and_then(|first| first.kink_deg),
            rate: first.map(|first| first.rate),
            passages: summary.map(|summary| summary.passages),
            warnings: summary.map(|summary| summary.warnings.len()),
            reason: match &row.state {
                RunState::Failed { reason, .. } => Some(reason.clone()),
                _ => None,
            },
            verdict: verdict.map(|verdict| verdict.level.word().to_owned()),
            reasons: verdict.map(Verdict::kinds),
            failure: failure.map(|failure| failure.mode.map_or("none", FailureMode::word).to_owned()),
            failure_mgt: failure.and_then(|failure| failure.mgt),
            failure_crack: failure.and_then(|failure| failure.crack),
        }
    }
}

impl From<&StudyRow> for TimesRow {
    fn from(row: &StudyRow) -> Self {
        let summary = row.summary.as_ref();
        let phases = summary.map(|summary| summary.phases_s);
        Self {
            run: row.number,
            wall_s: summary.map(|summary| summary.wall_s),
            body_s: phases.map(|phases| phases.body),
            contact_s: phases.map(|phases| phases.contact),
            growth_s: phases.map(|phases| phases.growth),
            output_s: phases.map(|phases| phases.output),
            peak_memory_mb: summary.and_then(|summary| summary.peak_memory_mb),
        }
    }
}

/// The numbers of the runs that the table of runs `text` lists as done.
pub(crate) fn listed_as_done(text: &str) -> HashSet<usize> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#')).map(line_fields);
    let header = lines.next().unwrap_or_default();
    let Some(state) = header.iter().position(|name| name == "state") else { return HashSet::new() };
    let is_done = |row: &Vec<String>| row.get(state).is_some_and(|state| state == RunState::Done.name());
    lines.filter(is_done).filter_map(|row| row.first()?.parse().ok()).collect()
}

impl StudyResults {
    pub(crate) fn table(&self, plan: &StudyPlan) -> Result<Vec<u8>, OutputError> {
        let keys = plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.key.as_str());
        let columns = ["run", "folder"].into_iter().chain(keys).chain(column_names::<StudySummaryRow>(&[]));
        let mut rows = Rows::default();
        for (row, run) in self.rows.iter().zip(&plan.runs) {
            rows.count(row.number);
            rows.name(&run.folder);
            plan.values_of(run).for_each(|(_, value)| rows.quoted(value));
            StudySummaryRow::from(row).put(&mut rows);
        }
        let header = header_of(StudySummaryRow::COMMENTS, &columns.collect::<Vec<_>>());
        Ok([header.as_bytes(), rows.text(StudySummaryRow::FILE)?].concat())
    }

    pub(crate) fn times(&self) -> Result<Vec<u8>, OutputError> {
        whole(self.rows.iter().map(TimesRow::from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::files::STUDY_TABLES;

    #[test]
    fn runs_that_are_done_are_found() {
        let text = "# c\nrun,folder,\"a, b\",state,stop\n1,001,\"1, 2\",done,\n2,002,3,missing,\n3,003,3,done,arrest\n";
        assert_eq!(listed_as_done(text), [1, 3].into());
        assert_eq!(listed_as_done("").len(), 0);
        assert_eq!(STUDY_TABLES[..2], [StudySummaryRow::FILE, TimesRow::FILE]);
    }
}

//! `summary.csv` and `times.csv` of a study.

use super::plan::StudyPlan;
use super::results::StudyResults;
use super::state::RunState;
use crate::OutputError;
use crate::csv::{Rows, header};

/// Columns of `summary.csv` of a study behind those of its number, its folder and the keys that vary.
pub const STUDY_COLUMNS: [&str; 21] = [
    "state",
    "stop",
    "steps",
    "load_cycles",
    "million_gross_tonnes",
    "crack",
    "tip",
    "initial_length_mm",
    "length_mm",
    "tip_x_mm",
    "tip_y_mm",
    "ki_max_mpa_sqrt_m",
    "kii_peak_mpa_sqrt_m",
    "delta_ki_mpa_sqrt_m",
    "delta_kii_mpa_sqrt_m",
    "delta_keq_mpa_sqrt_m",
    "kink_angle_deg",
    "rate_mm_per_cycle",
    "passages",
    "warnings",
    "reason",
];

/// Index in these of the first real number of the tip, `initial_length_mm`.
const OF_THE_TIP: usize = 7;

/// Columns of `times.csv`.
pub const TIMES_COLUMNS: [&str; 7] =
    ["run", "wall_s", "body_s", "contact_s", "growth_s", "output_s", "peak_memory_mb"];

impl StudyResults {
    pub(super) fn table(&self, plan: &StudyPlan) -> Result<Vec<u8>, OutputError> {
        let mut columns: Vec<&str> = vec!["run", "folder"];
        let keys: Vec<&str> =
            plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.key.as_str()).collect();
        columns.extend(&keys);
        columns.extend(STUDY_COLUMNS);
        let mut rows = Rows::default();
        for (row, run) in self.rows.iter().zip(&plan.runs) {
            rows.count(row.number);
            rows.name(&run.folder);
            for (_, value) in plan.values_of(run) {
                rows.name(&quoted(value));
            }
            rows.name(row.state.name());
            let summary = row.summary.as_ref();
            rows.name(summary.and_then(|summary| summary.stop.as_deref()).unwrap_or_default());
            let mut number = STUDY_COLUMNS.into_iter().skip(OF_THE_TIP);
            match summary {
                Some(summary) => rows.count(summary.steps),
                None => rows.name(""),
            }
            let real =
                |rows: &mut Rows, column: &'static str, value: Option<f64>| rows.optional(column, value);
            real(&mut rows, "load_cycles", summary.map(|summary| summary.load_cycles));
            real(&mut rows, "million_gross_tonnes", summary.and_then(|summary| summary.million_gross_tonnes));
            let leading = row.leading.as_ref();
            for count in [leading.map(|tip| tip.first.crack), leading.map(|tip| tip.first.tip)] {
                match count {
                    Some(count) => rows.count(count),
                    None => rows.name(""),
                }
            }
            let peak = |values: &[f64]| values.iter().fold(0.0, |peak: f64, k| peak.max(k.abs()));
            for value in [
                leading.map(|tip| tip.first.length),
                leading.map(|tip| tip.last().length),
                leading.map(|tip| tip.last().place[0]),
                leading.map(|tip| tip.last().place[1]),
                leading.map(|tip| tip.first.ki_max),
                leading.map(|tip| peak(&tip.history.kii)),
                leading.map(|tip| tip.first.delta_ki),
                leading.map(|tip| tip.first.delta_kii),
                leading.map(|tip| tip.first.delta_keq),
                leading.and_then(|tip| tip.first.kink_deg),
                leading.map(|tip| tip.first.rate),
            ] {
                real(&mut rows, number.next().unwrap_or_default(), value);
            }
            for count in
                [summary.map(|summary| summary.passages), summary.map(|summary| summary.warnings.len())]
            {
                match count {
                    Some(count) => rows.count(count),
                    None => rows.name(""),
                }
            }
            match &row.state {
                RunState::Failed { reason, .. } => rows.name(&quoted(reason)),
                _ => rows.name(""),
            }
            rows.end();
        }
        let comments = [
            "One row per run of the study, in its order; folder: in runs/; then the keys that vary, as in the case file",
            "state: done, not-converged, cannot-read-or-write (reason: why), unfinished (interrupted, or being computed), missing",
            "stop: why the run ended; steps: increments done; load_cycles: axles at the start of the last finished step",
            "crack, tip: the tip of the crack that grew most (of equals, that with the largest delta_keq); what follows is of this tip",
            "initial_length_mm, length_mm: of its crack at step 0 and at the last finished step; tip_x_mm, tip_y_mm: there, y upwards",
            "ki_max ... rate: step 0, stabilised passage; K: MPa sqrt(m); kii_peak: the largest |K_II|; angle: from straight ahead",
            "empty: not computed, or does not exist. Wall times are in times.csv",
        ];
        with_header(&comments, &columns, &rows, "summary.csv")
    }

    pub(super) fn times(&self) -> Result<Vec<u8>, OutputError> {
        let mut rows = Rows::default();
        for row in &self.rows {
            rows.count(row.number);
            let summary = row.summary.as_ref();
            let phases = summary.map(|summary| summary.phases_s);
            for (column, value) in TIMES_COLUMNS[1..].iter().zip([
                summary.map(|summary| summary.wall_s),
                phases.map(|phases| phases.body),
                phases.map(|phases| phases.contact),
                phases.map(|phases| phases.growth),
                phases.map(|phases| phases.output),
                summary.and_then(|summary| summary.peak_memory_mb),
            ]) {
                rows.optional(column, value);
            }
            rows.end();
        }
        let comments = [
            "Wall time of each run and its resumptions, seconds, by phase; peak_memory_mb: of the process that computed it",
            "Mesh and factor that runs share are computed before them and are in no row",
        ];
        with_header(&comments, &TIMES_COLUMNS, &rows, "times.csv")
    }
}

fn with_header(
    comments: &[&str],
    columns: &[&str],
    rows: &Rows,
    file: &'static str,
) -> Result<Vec<u8>, OutputError> {
    let mut table = header(comments, columns).into_bytes();
    table.extend_from_slice(rows.text(file)?);
    Ok(table)
}

/// A text as a field of CSV (RFC 4180): in quotes where it has commas, quotes or line ends.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r', '#']) {
        format!("\"{}\"", text.replace('"', "\"\"").replace(['\n', '\r'], " "))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn fields_with_commas_are_quoted() {
        assert_eq!(quoted("0.025"), "0.025");
        assert_eq!(quoted("[[0.0, 0.0], [4.0, -1.0]]"), "\"[[0.0, 0.0], [4.0, -1.0]]\"");
        assert_eq!(quoted("a \"b\"\nc"), "\"a \"\"b\"\" c\"");
    }
}

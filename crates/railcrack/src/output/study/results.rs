//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::plan::PlannedRun;
use super::state::{RunState, StudyRow};
use crate::output::csv::{GROWTH_FILE, read_steps};
use crate::output::figures::{History, STUDY_PLOTS, read_histories, study_plots};
use crate::output::folder::{SUMMARY_FILE, read_if_there};
use crate::output::{OutputError, Summary};
use std::path::Path;

/// The results of a study: a row per run, in the order of the runs.
#[derive(Debug, Clone)]
pub struct StudyResults {
    /// The runs.
    pub rows: Vec<StudyRow>,
}

/// The tip that stands for a run: that of the crack that grew most; of equals, the one with the largest ΔK_eq of step 0, then the first.
#[derive(Debug, Clone)]
pub(crate) struct LeadingTip {
    /// From 1.
    pub crack: usize,
    /// From 1 within its crack.
    pub tip: usize,
    /// Its row of step 0.
    pub first: TipRow,
    /// Load cycles and length at every step.
    pub growth: Vec<[f64; 2]>,
    /// Its place in the last step, mm.
    pub place: [f64; 2],
    /// K of step 0.
    pub history: History,
}

/// What `summary.csv` takes over from a row of `growth.csv`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipRow {
    pub length: f64,
    pub ki_max: f64,
    pub delta_ki: f64,
    pub delta_kii: f64,
    pub delta_keq: f64,
    pub kink_deg: Option<f64>,
    pub rate: f64,
}

const GROWTH_COLUMNS: [&str; 13] = [
    "step",
    "crack",
    "tip",
    "load_cycles",
    "length_mm",
    "ki_max_mpa_sqrt_m",
    "delta_ki_mpa_sqrt_m",
    "delta_kii_mpa_sqrt_m",
    "delta_keq_mpa_sqrt_m",
    "kink_angle_deg",
    "rate_mm_per_cycle",
    "tip_x_mm",
    "tip_y_mm",
];

impl StudyFolder {
    /// Builds `summary.csv`, `times.csv` and the overlay plots from the run folders alone, whoever computed them.
    ///
    /// Several processes may do so at once: once the last of them has, the files have every run.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn write_results(&self) -> Result<StudyResults, OutputError> {
        loop {
            let results = self.read_results()?;
            self.put("summary.csv", &results.table(self.plan())?)?;
            self.put("times.csv", &results.times()?)?;
            let plots = study_plots(self.plan(), &results.rows);
            for file in STUDY_PLOTS {
                match plots.iter().find(|(name, _)| *name == file) {
                    Some((_, picture)) => self.put(&format!("plots/{file}"), picture.as_bytes())?,
                    None => self.take_away(&format!("plots/{file}"))?,
                }
            }
            // Another process may have finished the last run, and written all results, while this one was about to: what has just been
            // written would then hide what the other one wrote.
            if results.are_complete() || !self.is_over()? {
                return Ok(results);
            }
        }
    }

    fn read_results(&self) -> Result<StudyResults, OutputError> {
        let rows: Result<_, _> = self.plan().runs.iter().map(|run| self.row(run)).collect();
        Ok(StudyResults { rows: rows? })
    }

    fn row(&self, run: &PlannedRun) -> Result<StudyRow, OutputError> {
        let folder = self.run_folder(run);
        // In this order: a run that ends in between counts as one that has not.
        let outcome = self.outcome(run)?;
        let path = folder.join(SUMMARY_FILE);
        let summary: Option<Summary> = read_if_there(&path)?
            .map(|text| serde_json::from_slice(&text))
            .transpose()
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let summary = summary.filter(|summary| summary.steps_recorded > 0);
        let steps = summary.as_ref().map_or(0, |summary| summary.steps_recorded);
        let leading = if steps > 0 { leading_tip(&folder, steps)? } else { None };
        Ok(StudyRow { number: run.number, state: RunState::of(outcome, steps), summary, leading })
    }

    fn is_over(&self) -> Result<bool, OutputError> {
        for run in &self.plan().runs {
            if self.outcome(run)?.is_none() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl StudyResults {
    fn are_complete(&self) -> bool {
        self.rows.iter().all(|row| row.state.is_over())
    }

    /// Number of runs in a state.
    pub fn count(&self, is_in: impl Fn(&RunState) -> bool) -> usize {
        self.rows.iter().filter(|row| is_in(&row.state)).count()
    }
}

/// One tip through all steps.
struct Tip {
    key: (usize, usize),
    first: TipRow,
    growth: Vec<[f64; 2]>,
    place: [f64; 2],
}

impl Tip {
    fn grown(&self) -> f64 {
        self.growth.last().map_or(0.0, |[_, length]| length - self.first.length)
    }
}

fn leading_tip(folder: &Path, steps: usize) -> Result<Option<LeadingTip>, OutputError> {
    let mut tips: Vec<Tip> = Vec::new();
    read_steps(
        &folder.join(GROWTH_FILE),
        &GROWTH_COLUMNS,
        |step| step < steps,
        |row| {
            let key = (row.count(1)?, row.count(2)?);
            let now = [row.real(3)?, row.real(4)?];
            let place = [row.real(11)?, row.real(12)?];
            match tips.iter_mut().find(|tip| tip.key == key) {
                Some(tip) => {
                    tip.growth.push(now);
                    tip.place = place;
                }
                None => {
                    let first = TipRow {
                        length: now[1],
                        ki_max: row.real(5)?,
                        delta_ki: row.real(6)?,
                        delta_kii: row.real(7)?,
                        delta_keq: row.real(8)?,
                        kink_deg: row.optional(9)?,
                        rate: row.real(10)?,
                    };
                    tips.push(Tip { key, first, growth: vec![now], place });
                }
            }
            Ok(())
        },
    )?;
    let leads = |one: &Tip, other: &Tip| {
        one.grown().total_cmp(&other.grown()).then(one.first.delta_keq.total_cmp(&other.first.delta_keq))
    };
    // Of equals the first: the last one of a maximum from behind.
    let Some(tip) = tips.into_iter().rev().max_by(leads) else { return Ok(None) };
    let (crack, number) = tip.key;
    let histories = read_histories(folder, &[0])?;
    let history = histories.into_iter().find(|history| (history.crack, history.tip) == tip.key);
    Ok(Some(LeadingTip {
        crack,
        tip: number,
        first: tip.first,
        growth: tip.growth,
        place: tip.place,
        history: history.unwrap_or_default(),
    }))
}

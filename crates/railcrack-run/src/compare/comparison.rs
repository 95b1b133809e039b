//! The differences of two runs, in numbers.

use super::align::{Aligned, align};
use super::case_keys::{CaseDifference, case_differences};
use super::notes::notes;
use super::parting::{Parting, parting};
use super::stored::{RunLabel, StoredRun, TipKey};
use super::tables::TipComparison;
use super::tip::{SifDifference, percent};
use crate::error::OutputError;
use crate::summary::CrackSummary;
use std::path::Path;

/// A comparison of two runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The runs.
    pub runs: [RunLabel; 2],
    /// Differences of their cases.
    pub case_differences: Vec<CaseDifference>,
    /// Notes on parts that were not compared or were modified for the comparison, in sentences.
    pub notes: Vec<String>,
    /// Number of steps that both have, the initial geometry counted.
    pub common_steps: usize,
    /// The largest |K_I| or |K_II| of both runs in these steps, MPa √m.
    pub peak: f64,
    /// Every tip that both have, in the order of step, crack, tip.
    pub tips: Vec<TipComparison>,
    /// Where the paths part, if they do.
    pub parting: Option<Parting>,
    /// K at common positions, one for each of `tips`.
    pub aligned: Vec<Aligned>,
    /// Paths of each run.
    pub cracks: [Vec<CrackSummary>; 2],
}

impl Comparison {
    /// Compares the runs in two folders by their stored tables, for the steps and tips that both
    /// have.
    ///
    /// Errors: a folder holds no run; a file of it is damaged; the system refuses.
    pub fn of(first: &Path, second: &Path) -> Result<Self, OutputError> {
        let (first, second) = (StoredRun::read(first)?, StoredRun::read(second)?);
        let runs = [&first, &second];
        let keys: Vec<TipKey> =
            first.growth.keys().filter(|key| second.growth.contains_key(key)).copied().collect();
        let mut tips = Vec::with_capacity(keys.len());
        let mut aligned = Vec::with_capacity(keys.len());
        for &key in &keys {
            let histories = first.history(key)?.zip(second.history(key)?);
            let at_same_positions =
                histories.map_or_else(Aligned::default, |(one, other)| align([one, other]));
            tips.extend(tip_comparison(runs, key, &at_same_positions));
            aligned.push(at_same_positions);
        }
        let peaks: Vec<f64> = tips.iter().map(|tip: &TipComparison| step_peak(runs, tip.step)).collect();
        let peak = peaks.iter().copied().fold(0.0, f64::max);
        let tips: Vec<_> =
            tips.into_iter().zip(peaks).map(|(tip, of_step)| tip.with_peaks(of_step, peak)).collect();
        Ok(Self {
            runs: runs.map(StoredRun::label),
            case_differences: case_differences(
                runs.map(|run| (run.folder.case_text.as_str(), run.folder.path.as_path())),
            )?,
            notes: notes(runs, &tips, &aligned),
            common_steps: first.summary().steps_recorded.min(second.summary().steps_recorded),
            peak,
            parting: parting(runs, &keys),
            tips,
            aligned,
            cracks: [first.folder.summary.cracks, second.folder.summary.cracks],
        })
    }

    /// `k` (MPa √m) in per cent of the largest |K| of the case.
    pub fn percent(&self, k: f64) -> f64 {
        percent(k, self.peak)
    }

    /// Whether no K differs by more than `tolerance` (per cent of the largest |K| of the case);
    /// runs with nothing in common are outside any tolerance.
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.largest_percent().is_some_and(|largest| largest <= tolerance)
    }

    /// The largest difference of K_I or K_II, in per cent of the largest |K| of the case; none
    /// where the runs have nothing in common.
    pub fn largest_percent(&self) -> Option<f64> {
        let all = self.tips.iter().filter_map(TipComparison::sifs);
        all.map(|sifs| self.percent(sifs.ki.largest.max(sifs.kii.largest))).reduce(f64::max)
    }
}

/// The largest |K| of both runs at a step.
fn step_peak(runs: [&StoredRun; 2], step: usize) -> f64 {
    let of_step = |run: &StoredRun| {
        let histories = run.histories.range((step, 0, 0)..(step + 1, 0, 0));
        let all = histories.flat_map(|(_, history)| history.ki.iter().chain(&history.kii));
        all.fold(0.0, |peak: f64, k| peak.max(k.abs()))
    };
    runs.map(of_step).into_iter().fold(0.0, f64::max)
}

/// The tip `key` in both runs, without the peaks.
fn tip_comparison(runs: [&StoredRun; 2], key: TipKey, aligned: &Aligned) -> Option<TipComparison> {
    let (step, crack, tip) = key;
    let [first, second] = runs.map(|run| run.growth.get(&key));
    let rows = [first?, second?];
    let [[x1, y1], [x2, y2]] = rows.map(|row| row.place);
    let [ki, kii] = [&aligned.ki, &aligned.kii].map(|k| difference(aligned, k));
    Some(TipComparison {
        step,
        crack,
        tip,
        positions: aligned.xc_over_a.len(),
        dki: ki.map(|ki| ki.largest),
        dki_of_step: None,
        dki_of_case: None,
        dki_xc_over_a: ki.map(|ki| ki.xc_over_a),
        dki_rms: ki.map(|ki| ki.rms),
        dkii: kii.map(|kii| kii.largest),
        dkii_of_step: None,
        dkii_of_case: None,
        dkii_xc_over_a: kii.map(|kii| kii.xc_over_a),
        dkii_rms: kii.map(|kii| kii.rms),
        step_peak: 0.0,
        first_place: rows[0].place,
        second_place: rows[1].place,
        distance: (x2 - x1).hypot(y2 - y1),
        lengths: rows.map(|row| row.length),
        load_cycles: rows.map(|row| row.load_cycles),
        kink_deg: rows.map(|row| row.kink_deg),
        rival_deg: rows.map(|row| row.rival_deg),
        rival_ratio: rows.map(|row| row.rival_ratio),
        stops: rows.map(|row| row.stop),
    })
}

fn difference(aligned: &Aligned, k: &[Vec<f64>; 2]) -> Option<SifDifference> {
    let differences = || k[0].iter().zip(&k[1]).map(|(one, other)| (other - one).abs());
    let farther = |most: (usize, f64), next: (usize, f64)| if next.1 > most.1 { next } else { most };
    let (place, largest) = differences().enumerate().reduce(farther)?;
    let squares: f64 = differences().map(|difference| difference * difference).sum();
    Some(SifDifference {
        largest,
        xc_over_a: aligned.xc_over_a[place],
        rms: (squares / k[0].len() as f64).sqrt(),
    })
}

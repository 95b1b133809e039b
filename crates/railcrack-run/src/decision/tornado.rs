//! Sensitivity of the answer: lives and verdicts with other values of what is seldom known.

use super::companions::{Companions, PathLives, Speeds};
use super::failure::{Nominal, NominalRun};
use super::reason::VerdictLevel;
use super::verdict::Verdict;
use crate::log::{CompanionKind, RunInfo, RunLog};
use serde::{Deserialize, Serialize};

/// The life with one quantity at another value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TornadoBar {
    /// The quantity.
    pub quantity: String,
    /// Its value, or the change of it.
    pub setting: String,
    /// Million gross tonnes to failure; null where the rail does not fail within the run.
    pub mgt: Option<f64>,
    /// Level of the verdict.
    pub level: VerdictLevel,
}

/// Scatter of ln C from rail to rail that are calibrated.
const CALIBRATED: f64 = 0.3;

/// The bars of `run`, of the steps of `log`, by its `companions`, the widest quantity first; none
/// where nothing was varied.
pub(super) fn tornado(
    info: &RunInfo,
    log: &RunLog,
    run: &NominalRun,
    companions: &Companions<'_>,
) -> Vec<TornadoBar> {
    let bars = |kind: CompanionKind| of_companion(info, companions, kind);
    let mut all: Vec<TornadoBar> = companions.all.iter().filter_map(|one| bars(one.kind)).collect();
    if all.is_empty() {
        return all;
    }
    all.extend(of_coefficient(info, run, &companions.speeds()));
    let nominal = run.nominal.failure.mgt;
    let level = Verdict::of(info, log, run).level;
    all.extend(companions.paths(nominal).into_iter().flat_map(|paths| of_paths(paths, level)));
    let spread = |quantity: &str| {
        let lives = all.iter().filter(|bar| bar.quantity == quantity).map(|bar| bar.mgt);
        let change = |mgt: Option<f64>| match (mgt, nominal) {
            (Some(mgt), Some(nominal)) => (mgt / nominal).ln().abs(),
            (None, None) => 0.0,
            _ => f64::INFINITY,
        };
        lives.map(change).fold(0.0, f64::max)
    };
    let spreads: Vec<f64> = all.iter().map(|bar| spread(&bar.quantity)).collect();
    let mut ordered: Vec<(f64, TornadoBar)> = spreads.into_iter().zip(all).collect();
    ordered.sort_by(|a, b| b.0.total_cmp(&a.0));
    ordered.into_iter().map(|(_, bar)| bar).collect()
}

/// The bar of a companion with another value; none of the others.
fn of_companion(info: &RunInfo, companions: &Companions<'_>, kind: CompanionKind) -> Option<TornadoBar> {
    if !matches!(kind, CompanionKind::Friction(_) | CompanionKind::Varied(_)) {
        return None;
    }
    let (quantity, setting) = kind.in_words();
    let steps = companions.steps_of(kind)?;
    let run = NominalRun::of(steps, companions.question)?;
    let log = RunLog { steps: steps.to_vec(), ..RunLog::default() };
    Some(TornadoBar {
        quantity: quantity.to_owned(),
        setting,
        mgt: run.nominal.failure.mgt,
        level: Verdict::of(info, &log, &run).level,
    })
}

/// The coefficient of the growth law, one standard deviation either way.
fn of_coefficient(info: &RunInfo, run: &NominalRun, speeds: &Speeds) -> Vec<TornadoBar> {
    let usual = if info.calibration.sites.is_some() { CALIBRATED } else { info.calibration.log_std };
    let std = info.scatter.map_or(usual, |scatter| scatter.c_log_std);
    let family = speeds.family(&run.course);
    let bar = |by: f64| {
        let mgt = Nominal::mgt_at_speed(&family, (by * std).exp(), &run.question);
        TornadoBar {
            quantity: "coefficient of the growth law".to_owned(),
            setting: format!("× {:.2}", (by * std).exp()),
            mgt,
            level: if mgt.is_some() { VerdictLevel::Act } else { VerdictLevel::Unknown },
        }
    };
    [-1.0, 1.0].map(bar).to_vec()
}

/// The paths besides that of the run.
fn of_paths(paths: PathLives, level: VerdictLevel) -> [TornadoBar; 2] {
    let lives = [(CompanionKind::Straight, paths.straight), (CompanionKind::Limit, paths.limit)];
    lives.map(|(kind, mgt)| {
        let (quantity, setting) = kind.in_words();
        TornadoBar {
            quantity: quantity.to_owned(),
            setting,
            mgt,
            level: if mgt.is_some() { level.max(VerdictLevel::Act) } else { level },
        }
    })
}

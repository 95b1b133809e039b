//! `plan.json`.

use crate::decision::{FailureMode, Verdict, VerdictLevel};
use railcrack::words::Choice;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

/// How a rail under a grinding plan ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlanOutcome {
    /// The last crack is worn away.
    WornAway,
    /// The rail is worn to the limit at which it is replaced.
    WearLimit,
    /// No crack grows any longer.
    Arrest,
    /// The rail has not failed at the horizon.
    Holds,
    /// The computation ends before the horizon: what follows is not known.
    Unknown,
    /// The rail fails.
    #[serde(untagged)]
    Fails(FailureMode),
}

impl PlanOutcome {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::WornAway => "worn away",
            Self::WearLimit => "wear limit",
            Self::Arrest => "arrest",
            Self::Holds => "holds",
            Self::Unknown => "not known",
            Self::Fails(mode) => mode.words(),
        }
    }

    /// The word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::WornAway => "worn-away",
            Self::WearLimit => "wear-limit",
            Self::Arrest => "arrest",
            Self::Holds => "holds",
            Self::Unknown => "unknown",
            Self::Fails(mode) => mode.word(),
        }
    }

    /// Whether the rail fails.
    #[must_use]
    pub fn is_failure(self) -> bool {
        matches!(self, Self::Fails(_))
    }

    /// Whether the rail does not fail.
    #[must_use]
    pub fn is_safe(self) -> bool {
        !self.is_failure() && self != Self::Unknown
    }
}

/// The rail under one grinding plan.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlannedGrinding {
    /// Depth of each grinding, mm; 0 without grinding.
    pub grinding_mm: f64,
    /// Million gross tonnes between grindings; null without grinding.
    pub grinding_interval_mgt: Option<f64>,
    /// Removal by wear and grinding in the mean, mm per million gross tonnes.
    pub removal_mm_per_mgt: f64,
    /// How it ends.
    pub outcome: PlanOutcome,
    /// Million gross tonnes until then.
    pub mgt: f64,
    /// The same in months, where the case gives the traffic of a year.
    pub months: Option<f64>,
    /// The largest depth of a crack until then, mm.
    pub largest_depth_mm: f64,
    /// Removed until then, mm.
    pub removed_mm: f64,
    /// The level of the verdict on its cracks; `outside` and `stop` suppress everything that would
    /// be concluded from the plan.
    pub level: VerdictLevel,
    /// The probability that the rail fails before the horizon, by the samples; null without
    /// `[scatter]`.
    pub probability_of_failure: Option<f64>,
    /// Share of the samples whose fate before the horizon is not known.
    pub probability_not_known: Option<f64>,
    /// Thickness of the piece of the surface that comes off last, mm; null where none does.
    #[serde(default)]
    pub piece_thickness_mm: Option<f64>,
    /// Whether the rail holds: it does not fail before the horizon and, where the case has scatter,
    /// fails with no larger probability than the target.
    pub holds: bool,
    /// Million gross tonnes until the rail is worn to its limit; null without a limit.
    pub mgt_to_wear_limit: Option<f64>,
    /// The same in months.
    pub months_to_wear_limit: Option<f64>,
}

/// The least grinding that holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LeastGrinding {
    /// Depth of each grinding, mm; 0: the rail holds without grinding.
    pub grinding_mm: f64,
    /// Million gross tonnes between grindings; null without grinding.
    pub grinding_interval_mgt: Option<f64>,
    /// Removal in the mean, mm per million gross tonnes.
    pub removal_mm_per_mgt: f64,
    /// Million gross tonnes and months until the rail is worn to its limit, where there is one.
    pub mgt_to_wear_limit: Option<f64>,
    /// In months.
    pub months_to_wear_limit: Option<f64>,
    /// Day of the replacement, year-month-day, counted from that of the computation; null where
    /// the traffic of a year is not given.
    pub replacement_date: Option<String>,
}

impl LeastGrinding {
    /// The plan `plan`, begun on the day `begin` (days since 1970).
    pub(crate) fn of(plan: &PlannedGrinding, begin: i64) -> Self {
        let after = |months: f64| civil(begin + (months / 12.0 * DAYS_OF_YEAR) as i64);
        Self {
            replacement_date: plan.months_to_wear_limit.map(after),
            grinding_mm: plan.grinding_mm,
            grinding_interval_mgt: plan.grinding_interval_mgt,
            removal_mm_per_mgt: plan.removal_mm_per_mgt,
            mgt_to_wear_limit: plan.mgt_to_wear_limit,
            months_to_wear_limit: plan.months_to_wear_limit,
        }
    }
}

/// The plans in numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlanSummary {
    /// Version of the program.
    pub version: String,
    /// Title of the case.
    pub title: String,
    /// Day on which it was computed, year-month-day (UTC).
    pub date: String,
    /// Checksum of `case.toml` (SHA-256).
    pub case_checksum: String,
    /// The verdict on the rail without grinding.
    pub verdict: Verdict,
    /// How well absolute rates are known: whether the growth law is calibrated to measured sites.
    #[serde(default)]
    pub calibration: String,
    /// Mean load of an axle, t.
    pub axle_load_t: f64,
    /// Traffic of a year, million gross tonnes, where the case gives it.
    pub mgt_per_year: Option<f64>,
    /// Traffic up to which the rail is followed, million gross tonnes.
    pub horizon_mgt: f64,
    /// Wear, mm per million gross tonnes.
    pub wear_mm_per_mgt: f64,
    /// Removal at which the rail is replaced, mm.
    pub wear_limit_mm: Option<f64>,
    /// Probability of failure before the horizon up to which a plan holds, where there are samples.
    pub target_risk: Option<f64>,
    /// Samples of each plan, where there are any, and the seed of their random numbers.
    pub samples: Option<usize>,
    /// Their seed.
    pub seed: Option<usize>,
    /// Million gross tonnes until the first grinding of all plans; null where it follows after an
    /// interval.
    #[serde(default)]
    pub first_grinding_mgt: Option<f64>,
    /// The depths, ascending, mm.
    pub grinding_mm: Vec<f64>,
    /// The intervals, ascending, million gross tonnes.
    pub grinding_interval_mgt: Vec<f64>,
    /// The rail without grinding.
    pub without_grinding: PlannedGrinding,
    /// The plans, by depth and then by interval.
    pub plans: Vec<PlannedGrinding>,
    /// The least grinding of all plans that holds, by its mean removal; null where none holds, and
    /// where the verdict is `stop` or `outside`.
    pub least: Option<LeastGrinding>,
    /// The least depth that holds for each interval; null as above.
    pub least_by_interval: Vec<Option<LeastGrinding>>,
    /// Growth runs that were computed.
    pub runs: usize,
    /// Wall time, s.
    pub wall_s: f64,
    /// The assumptions, a sentence each.
    pub assumptions: Vec<String>,
    /// Warnings on the case and on its cracks without grinding.
    pub warnings: Vec<String>,
    /// Checksum of each table (SHA-256).
    #[serde(default)]
    pub checksums: BTreeMap<String, String>,
}

/// Mean days of a year of the calendar.
const DAYS_OF_YEAR: f64 = 365.2425;

/// The date `days` after 1970-01-01, year-month-day (Hinnant 2013, `civil_from_days`).
pub(crate) fn civil(days: i64) -> String {
    let shifted = days + 719_468;
    let era = shifted.div_euclid(146_097);
    let of_era = shifted.rem_euclid(146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let part = (5 * of_year + 2) / 153;
    let day = of_year - (153 * part + 2) / 5 + 1;
    let month = if part < 10 { part + 3 } else { part - 9 };
    let year = year + era * 400 + i64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

/// Days from 1970-01-01 to today (UTC).
pub(crate) fn today() -> i64 {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    (seconds / 86_400) as i64
}

impl PlanSummary {
    /// Finds the least grinding that holds, begun today, where the verdict allows conclusions.
    pub(crate) fn find_least(&mut self) {
        if self.verdict.level >= VerdictLevel::Stop {
            return;
        }
        let today = today();
        self.least_by_interval =
            (0..self.grinding_interval_mgt.len()).map(|i| self.least_at(i, today)).collect();
        let of_grinding = self.least_by_interval.iter().flatten().cloned();
        let of_grinding =
            of_grinding.reduce(|a, b| if b.removal_mm_per_mgt < a.removal_mm_per_mgt { b } else { a });
        let without = Some(&self.without_grinding).filter(|plan| plan.holds);
        self.least = without.map(|plan| LeastGrinding::of(plan, today)).or(of_grinding);
    }

    /// Whether no plan holds of a rail that the model describes.
    pub(crate) fn lacks_a_plan(&self) -> bool {
        self.verdict.level < VerdictLevel::Outside && self.least.is_none() && !self.plans.is_empty()
    }

    /// The remedy where no plan holds; none where one does, or nothing follows from the case.
    #[must_use]
    pub fn next_step(&self) -> Option<&'static str> {
        let at_once = self.first_grinding_mgt == Some(0.0);
        self.lacks_a_plan().then_some(match at_once {
            true => "none of these plans holds, not even with a grinding at once: try deeper or more frequent grinding (--grinding, --interval), mill the rail, or replace it",
            false => "none of these plans holds: try a grinding at once (first_grinding_mgt = 0), or deeper and more frequent grinding (--grinding, --interval)",
        })
    }

    /// The least depth that holds at interval `i`.
    fn least_at(&self, i: usize, today: i64) -> Option<LeastGrinding> {
        let depths = 0..self.grinding_mm.len();
        // Deeper grinding must hold as well: a rail that one depth saves by chance is not safe.
        let holds = |depth: usize| self.plan(depth, i).is_some_and(|plan| plan.holds);
        let first = depths.clone().find(|depth| (*depth..depths.end).all(holds))?;
        self.plan(first, i).map(|plan| LeastGrinding::of(plan, today))
    }

    /// The plan of a depth and an interval, by their places.
    #[must_use]
    pub fn plan(&self, depth: usize, interval: usize) -> Option<&PlannedGrinding> {
        self.plans.get(depth * self.grinding_interval_mgt.len() + interval)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_dates() {
        for (days, date) in
            [(0, "1970-01-01"), (59, "1970-03-01"), (11_016, "2000-02-29"), (20_782, "2026-11-25")]
        {
            assert_eq!(civil(days), date);
        }
    }
}

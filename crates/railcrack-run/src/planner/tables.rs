//! `plan.csv`.

use super::document::PlannedGrinding;
use crate::csv::table;

table! {
    /// A grinding plan; the first row is the rail without grinding.
    #[derive(Debug, Clone, PartialEq)]
    pub struct PlanRow in "plan.csv", [
        "Grinding plans and what becomes of the rail; empty fields: not given or not known",
        "mgt: million gross tonnes until the outcome; largest_depth_mm: of a crack until then; probability_of_failure: before the horizon",
    ] {
        /// Depth of each grinding, mm; 0 without grinding.
        depth: f64 = "grinding_mm";
        /// Million gross tonnes between grindings; empty without grinding.
        interval: Option<f64> = "grinding_interval_mgt";
        /// Removal by wear and grinding in the mean, mm per million gross tonnes.
        removal: f64 = "removal_mm_per_mgt";
        /// `depth`, `length`, `fracture`, `spall`, `detached`, `worn-away`, `wear-limit`, `arrest`,
        /// `holds` or `unknown`.
        outcome: String = "outcome";
        /// Million gross tonnes until then.
        mgt: f64 = "mgt";
        /// The same in months, with `mgt_per_year`.
        months: Option<f64> = "months";
        /// The largest depth of a crack until then, mm.
        largest_depth: f64 = "largest_depth_mm";
        /// Removed until then, mm.
        removed: f64 = "removed_mm";
        /// Probability of failure before the horizon, with `[scatter]`.
        probability: Option<f64> = "probability_of_failure";
        /// Share of the samples whose fate before the horizon is not known.
        not_known: Option<f64> = "probability_not_known";
        /// Level of the verdict.
        level: String = "level";
        /// 1 where the rail holds.
        holds: usize = "holds";
        /// Million gross tonnes until the rail is worn to its limit.
        wear_limit: Option<f64> = "mgt_to_wear_limit";
        /// The same in months.
        wear_limit_months: Option<f64> = "months_to_wear_limit";
        /// Thickness of the piece of the surface that comes off last, mm; empty where none does.
        piece: Option<f64> = "piece_thickness_mm";
    }
}

impl From<&PlannedGrinding> for PlanRow {
    fn from(plan: &PlannedGrinding) -> Self {
        Self {
            depth: plan.grinding_mm,
            interval: plan.grinding_interval_mgt,
            removal: plan.removal_mm_per_mgt,
            outcome: plan.outcome.word().to_owned(),
            mgt: plan.mgt,
            months: plan.months,
            largest_depth: plan.largest_depth_mm,
            removed: plan.removed_mm,
            probability: plan.probability_of_failure,
            not_known: plan.probability_not_known,
            level: plan.level.word().to_owned(),
            holds: usize::from(plan.holds),
            wear_limit: plan.mgt_to_wear_limit,
            wear_limit_months: plan.months_to_wear_limit,
            piece: plan.piece_thickness_mm,
        }
    }
}

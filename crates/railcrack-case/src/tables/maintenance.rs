//! `[maintenance]`: wear and grinding of the running surface.

use crate::schema::{Report, SectionValues, choice, closed, number, read_by_word, section};
use railcrack::growth::{Grinding, Maintenance, StressMoves};

section! {
    MAINTENANCE "maintenance", Optional,
        "Wear and grinding, which remove the running surface and shorten the cracks from their mouths; requires axle loads.";
    WEAR: f64 = number("wear_mm_per_mgt", "mm/MGT", closed(0.0, 100.0), 0.0,
        "Wear of the running surface in depth, mm per million gross tonnes.");
    GRINDING: f64 = number("grinding_mm", "mm", closed(1e-6, 100.0), 0.2,
        "Depth removed by each grinding; requires grinding_interval_mgt.").optional();
    GRINDING_INTERVAL: f64 = number("grinding_interval_mgt", "MGT", closed(1e-6, 1e6), 20.0,
        "Traffic from one grinding to the next.").optional();
    FIRST_GRINDING: f64 = number("first_grinding_mgt", "MGT", closed(0.0, 1e6), 20.0,
        "Traffic until the first grinding; by default grinding_interval_mgt.").optional();
    WEAR_LIMIT: f64 = number("wear_limit_mm", "mm", closed(1e-3, 100.0), 14.0,
        "Depth removed by wear and grinding at which the rail is replaced; the run ends there.").optional();
    STRESS: StressMoves = choice("stress_moves_with",
        "How residual and plastic stresses move as the surface is worn down.");
}

read_by_word!(StressMoves);

/// Wear and grinding of the running surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaintenancePlan {
    /// Wear, mm per million gross tonnes.
    pub wear: f64,
    /// Depth (mm) and interval (million gross tonnes) of grinding.
    pub grinding: Option<(f64, f64)>,
    /// Traffic until the first grinding, million gross tonnes; `None` for one interval.
    pub first_grinding: Option<f64>,
    /// Removed depth (mm) at which the rail is replaced.
    pub wear_limit: Option<f64>,
    /// Fate of residual and plastic stress.
    pub stress: StressMoves,
}

impl MaintenancePlan {
    /// Removal of the surface in the mean, mm per million gross tonnes.
    #[must_use]
    pub fn removal(&self) -> f64 {
        self.wear + self.grinding.map_or(0.0, |(depth, interval)| depth / interval)
    }

    /// Million gross tonnes after which the rail is worn to its limit: by wear between two
    /// grindings, or at one of them. `None` without a limit or where nothing is removed.
    #[must_use]
    pub fn replacement(&self) -> Option<f64> {
        let limit = self.wear_limit?;
        let by_wear = |ground: f64| (limit - ground).max(0.0) / self.wear;
        let Some((depth, interval)) = self.grinding else {
            return Some(by_wear(0.0)).filter(|mgt| mgt.is_finite());
        };
        let first = self.first_grinding.unwrap_or(interval);
        // The first grinding k after which `first + k interval` of wear and k + 1 grindings reach
        // the limit.
        let short = limit - self.wear * first - depth;
        let k = (short / (self.wear * interval + depth) - LIMIT_ROUNDING).ceil().max(0.0);
        Some(by_wear(k * depth).min(first + k * interval))
    }

    /// The same per axle of `tonnes`.
    #[must_use]
    pub fn per_axle(&self, tonnes: f64) -> Maintenance {
        let axles = |mgt: f64| 1e6 * mgt / tonnes;
        let grinding = self.grinding.map(|(depth, interval)| Grinding {
            depth,
            interval: axles(interval),
            first: axles(self.first_grinding.unwrap_or(interval)),
        });
        let wear = 1e-6 * tonnes * self.wear;
        Maintenance { wear, grinding, stress: self.stress, limit: self.wear_limit }
    }
}

/// Shortfall of the removed depth at a grinding, in removals per interval, that is attributed to
/// rounding.
const LIMIT_ROUNDING: f64 = 1e-9;

/// Wear and grinding; `has_tonnes` says whether axle loads are given.
pub(crate) fn read_maintenance(
    section: &SectionValues,
    has_tonnes: bool,
    report: &mut Report,
) -> Option<MaintenancePlan> {
    super::inspection::needs_tonnes(section, has_tonnes, report)?;
    let grinding = match (section.get(GRINDING), section.get(GRINDING_INTERVAL)) {
        (Some(depth), Some(interval)) => Some((depth, interval)),
        (None, None) => None,
        (depth, _) => {
            let (given, other) =
                if depth.is_some() { (GRINDING, GRINDING_INTERVAL) } else { (GRINDING_INTERVAL, GRINDING) };
            let says = format!("needs {} as well", other.key.name);
            report.add(
                section
                    .fault(given, says)
                    .help("give both the depth of each grinding and the tonnes between grindings"),
            );
            return None;
        }
    };
    let first_grinding = section.get(FIRST_GRINDING);
    if first_grinding.is_some() && grinding.is_none() {
        let help = "give grinding_mm and grinding_interval_mgt as well";
        report.add(section.fault(FIRST_GRINDING, "there is no grinding").help(help));
        return None;
    }
    let (wear, wear_limit) = (section.get(WEAR)?, section.get(WEAR_LIMIT));
    if wear_limit.is_some() && wear == 0.0 && grinding.is_none() {
        let help = "give wear_mm_per_mgt, or grinding_mm and grinding_interval_mgt";
        report.add(section.fault(WEAR_LIMIT, "is never reached: nothing is removed").help(help));
        return None;
    }
    Some(MaintenancePlan { wear, grinding, first_grinding, wear_limit, stress: section.get(STRESS)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The removal step by step: wear up to each grinding, then the grinding.
    fn step_by_step(plan: &MaintenancePlan, limit: f64) -> f64 {
        let (depth, interval) = plan.grinding.unwrap();
        let (mut at, mut removed) = (0.0, 0.0);
        let mut next = plan.first_grinding.unwrap_or(interval);
        loop {
            let worn = removed + plan.wear * (next - at);
            if worn >= limit {
                return at + (limit - removed) / plan.wear;
            }
            (at, removed) = (next, worn + depth);
            if removed >= limit {
                return at;
            }
            next += interval;
        }
    }

    #[test]
    fn the_rail_is_replaced_when_wear_or_a_grinding_reaches_the_limit() {
        let plan = |wear, grinding, first_grinding| MaintenancePlan {
            wear,
            grinding,
            first_grinding,
            wear_limit: Some(14.0),
            stress: StressMoves::WithMetal,
        };
        assert_eq!(plan(0.02, None, None).replacement(), Some(700.0));
        assert_eq!(MaintenancePlan { wear_limit: None, ..plan(0.02, None, None) }.replacement(), None);
        // 70 grindings of 0.2 mm, the last one at the limit.
        assert_eq!(plan(0.0, Some((0.2, 10.0)), None).replacement(), Some(700.0));
        for wear in [0.003, 0.02, 0.3] {
            for grinding in [(0.1, 5.0), (0.5, 20.0), (3.0, 70.0), (20.0, 30.0)] {
                for first in [None, Some(0.0), Some(2.0), Some(60.0)] {
                    let plan = plan(wear, Some(grinding), first);
                    let want = step_by_step(&plan, 14.0);
                    let got = plan.replacement().unwrap();
                    assert!((got - want).abs() < 1e-9 * want.max(1.0), "{plan:?}: {got} {want}");
                }
            }
        }
    }
}

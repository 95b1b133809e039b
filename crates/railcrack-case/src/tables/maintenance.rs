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
    /// Fate of residual and plastic stress.
    pub stress: StressMoves,
}

impl MaintenancePlan {
    /// Removal of the surface in the mean, mm per million gross tonnes.
    #[must_use]
    pub fn removal(&self) -> f64 {
        self.wear + self.grinding.map_or(0.0, |(depth, interval)| depth / interval)
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
        Maintenance { wear: 1e-6 * tonnes * self.wear, grinding, stress: self.stress }
    }
}

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
    Some(MaintenancePlan { wear: section.get(WEAR)?, grinding, first_grinding, stress: section.get(STRESS)? })
}

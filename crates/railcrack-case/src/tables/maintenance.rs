//! `[maintenance]`: wear and grinding of the running surface.

use crate::schema::{Report, SectionValues, choice, closed, number, read_by_word, section};
use railcrack::growth::{Grinding, Mgt, StressMoves, SurfaceRemoval};

section! {
    MAINTENANCE "maintenance", Optional,
        "Wear and grinding, which shorten cracks from their mouths; requires axle loads.";
    WEAR: f64 = number("wear_mm_per_mgt", "mm/MGT", closed(0.0, 100.0), 0.0,
        "Wear depth per million gross tonnes.");
    GRINDING: f64 = number("grinding_mm", "mm", closed(1e-6, 100.0), 0.2,
        "Depth removed by each grinding; requires grinding_interval_mgt.").optional();
    GRINDING_INTERVAL: f64 = number("grinding_interval_mgt", "MGT", closed(1e-6, 1e6), 20.0,
        "Traffic from one grinding to the next.").optional();
    FIRST_GRINDING: f64 = number("first_grinding_mgt", "MGT", closed(0.0, 1e6), 20.0,
        "Traffic until the first grinding; by default grinding_interval_mgt.").optional();
    WEAR_LIMIT: f64 = number("wear_limit_mm", "mm", closed(1e-3, 100.0), 14.0,
        "Total removed depth at which the rail is replaced and the run ends.").optional();
    LEAST_SPALL: f64 = number("least_spall_mm", "mm", closed(0.0, 100.0), 0.3,
        "Thickness from which a spall is a failure; by default the larger of 0.3 and grinding_mm, without flakes cut off by grinding.").optional();
    STRESS: StressMoves = choice("stress_moves_with",
        "How residual and plastic stresses move as the surface wears.");
}

read_by_word!(StressMoves);

/// Wear and grinding; `has_tonnes` says whether axle loads are given.
pub(crate) fn read_maintenance(
    section: &SectionValues,
    has_tonnes: bool,
    report: &mut Report,
) -> Option<SurfaceRemoval<Mgt>> {
    super::inspection::needs_tonnes(section, has_tonnes, report)?;
    let first = section.get(FIRST_GRINDING).map(Mgt);
    let grinding = match (section.get(GRINDING), section.get(GRINDING_INTERVAL)) {
        (Some(depth), Some(interval)) => Some(Grinding { depth, interval: Mgt(interval), first }),
        (None, None) => None,
        (depth, _) => {
            let (given, other) =
                if depth.is_some() { (GRINDING, GRINDING_INTERVAL) } else { (GRINDING_INTERVAL, GRINDING) };
            let says = format!("needs {} as well", other.key.name);
            return report.refuse(
                section
                    .fault(given, says)
                    .help("give both the depth of each grinding and the tonnes between grindings"),
            );
        }
    };
    if first.is_some() && grinding.is_none() {
        let help = "give grinding_mm and grinding_interval_mgt as well";
        return report.refuse(section.fault(FIRST_GRINDING, "there is no grinding").help(help));
    }
    let (wear, limit) = (section.get(WEAR)?, section.get(WEAR_LIMIT));
    if limit.is_some() && wear == 0.0 && grinding.is_none() {
        let help = "give wear_mm_per_mgt, or grinding_mm and grinding_interval_mgt";
        return report.refuse(section.fault(WEAR_LIMIT, "is never reached: nothing is removed").help(help));
    }
    let (stress, least_spall) = (section.get(STRESS)?, section.get(LEAST_SPALL));
    Some(SurfaceRemoval { wear, grinding, limit, stress, least_spall })
}

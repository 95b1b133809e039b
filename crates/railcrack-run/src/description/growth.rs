//! Growth law, path, increments, fracture, inspection, wear and grinding of a case.

use super::row::Row;
use super::wheel::fluid;
use crate::numbers::{formula, short};
use railcrack::fatigue::{ACCEPTANCE_RANGES, ACCEPTED_GROWTH, DirectionCriterion, RailSteel, RateLaw};
use railcrack::growth::{Grinding, Turning};
use railcrack_case::{Case, Inspection};

/// The law of growth, the path, and what ends the growth.
pub(super) fn growth(case: &Case) -> Vec<Row> {
    let growth = &case.growth;
    let law = &growth.law;
    let mut rows = vec![Row::text("increments", increments(case)), Row::text("path", path(case))];
    rows.extend(case.growth_steel.map(|steel| Row::text("steel", steel_text(steel))));
    rows.extend([
        Row::text("law", format!("{} mm/cycle, MPa sqrt(m)", formula(&law.rate.formula()))),
        Row::text("range", formula(&law.equivalent.formula())),
        Row::text("EN 13674-1", acceptance(&law.rate)),
        Row::text("in track", case.calibration.sites.map_or_else(|| IN_TRACK.to_owned(), calibrated_by)),
        Row::number("arrest below", growth.arrest_rate, "mm/cycle"),
        Row::text("direction", direction(growth.criterion)),
        Row::text(
            "load cycles",
            "from the mean of the inverse rates at the start and the end of each increment",
        ),
    ]);
    let threshold = law.shear_threshold();
    rows.extend(threshold.map(|text| Row::text("threshold", format!("{} MPa sqrt(m)", formula(&text)))));
    rows.extend(growth.critical_length.map(|length| Row::number("stops at length", length, "mm")));
    rows.extend(growth.stop_after_cycles.map(|cycles| Row::number("stops after", cycles, "cycles")));
    if !case.is_mix() {
        rows.extend(case.first_wheel().fluid.as_ref().map(fluid));
    }
    if let Some(fracture) = &case.fracture {
        let steel = fracture.steel.map_or(String::new(), |steel| format!(" ({steel})"));
        rows.push(Row::with(
            "breaks at k1",
            &format!("{{k1}}{steel}"),
            [("k1", fracture.at_rail, "MPa sqrt(m)")],
        ));
    }
    rows.extend(case.axle_load.map(|load| Row::number("axle load", load, "t")));
    rows.extend(case.inspection.as_ref().map(inspection));
    if let Some(scatter) = &case.scatter {
        rows.push(Row::with(
            "scatter",
            "{samples} samples, ln C +- {ln C}",
            [("samples", scatter.samples as f64, ""), ("ln C", scatter.c_log_std, "")],
        ));
    }
    rows
}

fn increments(case: &Case) -> String {
    let most = if case.growth.answer.is_some() { "until the answer is known, " } else { "" };
    match (case.growth.steps, case.growth.tolerance) {
        (0, _) => "0: the initial cracks only".into(),
        (steps, Some(tolerance)) => {
            format!(
                "{most}{steps}, at most, chosen for an error of the life of {} %",
                short(100.0 * tolerance)
            )
        }
        (steps, None) => {
            format!("{most}{steps}, each {} % of the length", short(100.0 * case.growth.increment))
        }
    }
}

fn path(case: &Case) -> String {
    match case.growth.turning {
        Turning::Over(length) if case.growth.turns_in_space && length.is_finite() => format!(
            "{}turns about the direction of the mouth over {} mm, or two rows of cells where these are longer",
            straight_to(case.growth.straight_depth),
            short(length)
        ),
        _ if case.space().is_some() => "the front stays in its plane".to_owned(),
        Turning::Kink => "a whole kink in each increment: the path depends on the increment".to_owned(),
        Turning::Over(0.0) => "limit path: at each tip the best kink is zero".to_owned(),
        Turning::Over(f64::INFINITY) => "straight ahead".to_owned(),
        Turning::Over(length) => format!(
            "{}turns towards the best kink over {} mm; kinks of {} degrees and more are made at once",
            straight_to(case.growth.straight_depth),
            short(length),
            short(case.growth.kink_angle.to_degrees())
        ),
    }
}

/// The part of a path up to the `depth` (mm) from which it turns.
fn straight_to(depth: f64) -> String {
    if depth > 0.0 {
        format!("straight ahead to a depth of {} mm, then ", short(depth))
    } else {
        String::new()
    }
}

fn direction(criterion: DirectionCriterion) -> &'static str {
    match criterion {
        DirectionCriterion::MaxRate => "largest growth rate of the kink",
        DirectionCriterion::MaxRateUnclipped => "largest growth rate of the kink, negative k1 counted",
        DirectionCriterion::MaxDeltaK1 => "largest range of k1",
        DirectionCriterion::MaxK1 => "largest k1",
        DirectionCriterion::Coplanar => "straight ahead",
        DirectionCriterion::MaxTangentialStress => "largest tangential stress ahead of the tip",
        DirectionCriterion::MaxDeltaCtd => "largest range of the displacement at the tip of the kink",
    }
}

/// Absolute rates without a calibration.
const IN_TRACK: &str =
    "rates are known to a factor of about ten either way until C is calibrated (docs/validation.md)";

fn calibrated_by(sites: usize) -> String {
    format!("calibrated by {sites} measured {}", if sites == 1 { "site" } else { "sites" })
}

/// The name of a steel, and what its growth is.
fn steel_text(steel: &RailSteel) -> String {
    match steel.typical() {
        Some(typical) => format!(
            "{}: the fastest growth that EN 13674-1 accepts, a limit and not the growth of a rail; typical growth: steel = \"{}\"",
            steel.name, typical.name
        ),
        None => format!("{}: {}", steel.name, steel.source),
    }
}

/// Rates at R = 0.5 and the limits of the standard.
fn acceptance(law: &RateLaw) -> String {
    let of = |(range, limit): (f64, f64)| {
        // Metres in 1e9 cycles.
        format!("{} of {limit} m/Gcycle at \u{394}K = {range}", short(1e6 * law.rate(range, 0.5)))
    };
    let [low, high] = ACCEPTANCE_RANGES;
    format!("{}, {}, R = 0.5", of((low, ACCEPTED_GROWTH[0])), of((high, ACCEPTED_GROWTH[1])))
}

fn inspection(inspection: &Inspection) -> Row {
    let factor = ("factor", inspection.safety_factor, "");
    match (inspection.detectable_depth, inspection.detectable_length) {
        (Some(depth), _) => Row::with(
            "inspection",
            "from a depth of {depth}, safety factor {factor}",
            [("depth", depth, "mm"), factor],
        ),
        (None, Some(length)) => Row::with(
            "inspection",
            "from a length of {length}, safety factor {factor}",
            [("length", length, "mm"), factor],
        ),
        (None, None) => Row::with("inspection", "from the start, safety factor {factor}", [factor]),
    }
}

/// Wear and grinding, and the growth rate that balances them.
pub(super) fn maintenance(case: &Case) -> Vec<Row> {
    let Some(removal) = &case.maintenance else { return Vec::new() };
    let mut rows = vec![Row::number("wear", removal.wear, "mm/MGT")];
    if let Some(Grinding { depth, interval, .. }) = removal.grinding {
        rows.push(Row::with(
            "grinding",
            "{depth} every {interval}",
            [("depth", depth, "mm"), ("interval", interval.0, "MGT")],
        ));
    }
    rows.push(Row::with("removal", "{rate} on average", [("rate", removal.mean_rate(), "mm/MGT")]));
    let first = case.cracks.cracks().first().filter(|crack| crack.is_surface_breaking());
    rows.extend(case.axle_load.zip(first).map(|(tonnes, crack)| {
        let (mouth, next) = crack.segment(0);
        let sine = (mouth.y - next.y) / (next - mouth).length();
        let rate = 1e-6 * tonnes * removal.mean_rate() / sine;
        Row::text(
            "balance",
            format!("the first crack grows deeper if its tip grows by more than {rate:.3e} mm per cycle"),
        )
    }));
    rows.push(Row::line(
        "the running surface is removed, and with it the mouths of the cracks; profile and contact stay",
    ));
    rows
}

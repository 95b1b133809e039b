//! Depth of a crack against traffic, and its growth in depth against that which is measured in
//! track.

use super::curves::curves;
use super::stored::RunFolder;
use super::tiles::shortest;
use crate::chart::{Chart, ChartArea, ChartAxis, ChartRange, Curve, CurveColour, CurveLook};
use crate::numbers::given;
use crate::pages::phrases::{FAST_GROWTH, SLOW_GROWTH};
use crate::row::NamedCrack;
use railcrack::validity::{FASTEST_MEASURED, SLOWEST_MEASURED, fast_growth, measured_growth};
use railcrack_run::decision::{Decision, Quantiles};

/// Traffic over that to the failure, and depth over the critical one, at the end of the axes.
const BEYOND_FAILURE: f64 = 1.15;
/// Depths (mm) over which growth is measured in track (docs/dev/rate-over-depth.md).
const MEASURED_DEPTHS: [f64; 4] = [0.3, 2.3, 5.0, 8.0];

/// Depth of the tips against million gross tonnes, to shortly after the failure; none without
/// growth or without axle loads.
pub(super) fn depth_by_tonnage(run: &RunFolder, named: Option<&[NamedCrack]>) -> Option<Chart> {
    let load = run.case.axle_load.filter(|_| run.summary.steps_recorded > 1)?;
    let own = curves(run, named, |row| [1e-6 * load * row.load_cycles, -row.place[1]]);
    let [x, y] = axes(run, &own);
    let mut others = quantiles(run);
    others.extend(limits(run, x.range));
    Some(Chart {
        id: "depth-mgt".to_owned(),
        caption: format!(
            "Depth of the tip below the running surface against traffic, at {} t per axle.",
            given(load)
        ),
        x,
        y,
        curves: named_beside(own, others),
        ..Chart::default()
    })
}

/// The axes of the curves: to shortly after the failure, and to the critical depth.
fn axes(run: &RunFolder, own: &[Curve]) -> [ChartAxis; 2] {
    let x = ChartAxis::linear("Traffic", "million gross tonnes");
    let decision = run.summary.decision.as_ref();
    let Some(failure) = decision.and_then(shortest) else {
        return [x, ChartAxis::depth()];
    };
    let end = BEYOND_FAILURE * failure;
    let points = own.iter().flat_map(|curve| &curve.points).filter(|point| point[0] <= end);
    let [shallow, deep] =
        points.fold([0.0_f64, 0.0_f64], |[low, high], point| [low.min(point[1]), high.max(point[1])]);
    let deep = run.case.inspection.and_then(|of| of.critical_depth).unwrap_or(deep);
    [
        x.over(ChartRange::Exact([0.0, end])),
        ChartAxis::depth().over(ChartRange::Exact([shallow, BEYOND_FAILURE * deep])),
    ]
}

/// The depths from which the crack is found, and from which it is critical.
fn limits(run: &RunFolder, range: ChartRange) -> Vec<Curve> {
    let Some(inspection) = run.case.inspection else { return Vec::new() };
    let ChartRange::Exact([from, to]) = range else { return Vec::new() };
    let depths = [
        ("detectable depth", inspection.detectable_depth, CurveLook::FineDashed),
        ("critical depth", inspection.critical_depth, CurveLook::DashDotted),
    ];
    let line = |(name, depth, look): (&str, Option<f64>, CurveLook)| {
        let points = vec![[from, depth?], [to, depth?]];
        Some(Curve::line(name, points).with_look(look).with_colour(CurveColour::Ink))
    };
    depths.into_iter().filter_map(line).collect()
}

/// Quantiles of the depth over traffic, where there is scatter.
fn quantiles(run: &RunFolder) -> Vec<Curve> {
    let decision = run.summary.decision.as_ref();
    let Some(scatter) = decision.and_then(|decision| decision.scatter.as_ref()) else { return Vec::new() };
    let of = |name: &str, quantile: fn(&Quantiles) -> Option<f64>| {
        let points = scatter.depth.iter().filter_map(|at| Some([at.mgt, quantile(&at.depth_mm)?]));
        Curve::line(name, points.collect()).with_look(CurveLook::Dashed)
    };
    vec![of(SLOW_GROWTH, |depth| depth.p05), of(FAST_GROWTH, |depth| depth.p95)]
}

/// The `curves` of the run and others: then the curve of a single tip needs a name, too.
fn named_beside(mut curves: Vec<Curve>, others: Vec<Curve>) -> Vec<Curve> {
    if let ([only], false) = (&mut curves[..], others.is_empty())
        && only.name.is_empty()
    {
        only.name = "this run".to_owned();
    }
    curves.extend(others);
    curves
}

/// Growth in depth by depth until the failure, over the band that is measured in track; none
/// without axle loads or growth.
pub(super) fn rate_by_depth(run: &RunFolder) -> Option<Chart> {
    let decision: &Decision = run.summary.decision.as_ref()?;
    let end = shortest(decision).map_or(f64::INFINITY, |mgt| BEYOND_FAILURE * mgt);
    let rows = decision.rows.iter().filter(|row| row.mgt <= end);
    let rates = rows.filter_map(|row| Some([row.depth_mm, row.depth_mm_per_mgt?]));
    let points: Vec<[f64; 2]> = rates.filter(|[depth, rate]| *depth > 0.0 && *rate > 0.0).collect();
    if points.len() < 2 {
        return None;
    }
    let limit = MEASURED_DEPTHS.map(|depth| [depth, fast_growth(depth)]).to_vec();
    Some(Chart {
        id: "rate-depth".to_owned(),
        caption: "Growth in depth against the depth of the tip, in mm per million gross tonnes (MGT). The band is what is measured \
                  in track; growth above the dashed line needs a reason."
            .to_owned(),
        x: ChartAxis::logarithmic("Depth", "mm"),
        y: ChartAxis::logarithmic("Growth in depth", "mm per MGT"),
        areas: vec![measured_band()],
        curves: vec![
            Curve::line("this run", points).with_colour(CurveColour::Category(0)),
            Curve::line("three times the fastest that is measured", limit)
                .with_look(CurveLook::Dashed)
                .with_colour(CurveColour::Quiet),
        ],
        ..Chart::default()
    })
}

/// Growth in depth that is measured in track, by depth.
fn measured_band() -> ChartArea {
    let of = |band| MEASURED_DEPTHS.map(|depth| [depth, measured_growth(band, depth)]);
    let outline = of(SLOWEST_MEASURED).into_iter().chain(of(FASTEST_MEASURED).into_iter().rev());
    ChartArea { name: "measured in track".to_owned(), outline: outline.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_goes_there_and_back() {
        let outline = measured_band().outline;
        assert_eq!(outline.len(), 2 * MEASURED_DEPTHS.len());
        assert_eq!(outline[0], [0.3, 0.04]);
        assert_eq!(outline[7], [0.3, 0.11]);
        assert!(outline.iter().take(4).zip(outline.iter().rev()).all(|(low, high)| low[1] < high[1]));
    }
}

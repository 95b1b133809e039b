//! Both engines on the case of Fig. 13.

use crate::case_run::CrackGrowth;
use crate::results::Results;
use railcrack_report::{Chart, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveLook, CurveWidth};

/// K of both engines and their difference in per cent of the peak; none if a run is missing.
pub(crate) fn engines(results: &Results) -> Option<ChartSheet> {
    let first = results.setup("half-plane, along")?.run("fig13")?.crack();
    let second = results.setup("half-plane xfem, along")?.run("fig13")?.crack();
    let (differences, peak) = (second.sif.minus(&first.sif), first.sif.peak());
    let chart = |y: ChartAxis, heading: &str, curves: Vec<Curve>| Chart {
        heading: heading.to_owned(),
        x: ChartAxis::linear("x_{c}/a", "").over(ChartRange::Tight),
        y: y.over(ChartRange::AroundZero),
        curves,
        ..Chart::default()
    };
    let row = |(mode, symbol): (usize, &str)| {
        let k = |crack: &CrackGrowth| -> Vec<[f64; 2]> {
            let values = if mode == 0 { &crack.sif.ki } else { &crack.sif.kii };
            crack.sif.position.iter().zip(values).map(|(&x, &k)| [x, k]).collect()
        };
        let off = differences.iter().map(|d| [d[0], 100.0 * d[1 + mode] / peak]).collect();
        let headings =
            if mode == 0 { ["Both engines", "Finite elements minus dislocations"] } else { ["", ""] };
        let both = vec![
            Curve::line("distributed dislocations", k(first)).with_width(CurveWidth::Wide),
            Curve::line("finite elements", k(second)).with_look(CurveLook::Dashed),
        ];
        let difference = Curve::line("", off).with_colour(CurveColour::Category(2));
        vec![
            chart(ChartAxis::linear(symbol, "MPa√m"), headings[0], both),
            chart(
                ChartAxis::linear(&format!("Difference of {symbol}"), "% of the peak"),
                headings[1],
                vec![difference],
            ),
        ]
    };
    Some(ChartSheet {
        title: "Two engines on the case of Fig. 13".to_owned(),
        subtitle: "K over the stabilised passage, half-plane".to_owned(),
        rows: [(0, "K_{I}"), (1, "K_{II}")].map(row).into(),
        ..ChartSheet::default()
    })
}

//! K in the last step under every wheel of a mix.

use super::plot::Plot;
use crate::chart::{Chart, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour};
use crate::page_data::UnderWheel;
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;

/// How far from the mouth of the crack wheels are drawn, over the half-width of the first contact.
const REACH: f64 = 8.0;

/// The plot of the fastest tip in the last step; none for one wheel.
pub(super) fn plot(summary: &Summary, model: &str, growth: &[TipRow], all: &[UnderWheel]) -> Option<Plot> {
    let last = growth.last()?.step;
    let of_step = growth.iter().filter(|row| row.step == last);
    let fastest = of_step.max_by(|a, b| a.rate.total_cmp(&b.rate))?;
    let own: Vec<&UnderWheel> =
        all.iter().filter(|under| under.tip == (fastest.crack, fastest.tip)).collect();
    if own.len() < 2 {
        return None;
    }
    let wheels = summary.decision.as_ref().map_or(&[][..], |decision| &decision.wheels);
    let name = |wheel: usize| {
        let named = wheel.checked_sub(1).and_then(|place| wheels.get(place));
        named.map_or_else(|| format!("wheel {wheel}"), |of| of.name.clone())
    };
    let crack = fastest.crack.checked_sub(1).and_then(|place| summary.cracks.get(place));
    let mouth = crack.and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |point| point[0]);
    let reach = REACH * summary.half_width_mm;
    let chart = |id: &str, quantity: &str, mode: usize| {
        let curve = |(place, under): (usize, &&UnderWheel)| {
            let near = under.points.iter().filter(|point| (point[0] - mouth).abs() <= reach);
            let points = near.map(|point| [point[0] - mouth, point[mode]]).collect();
            Curve::line(&name(under.wheel), points).with_colour(CurveColour::of(place, own.len()))
        };
        Chart {
            id: id.to_owned(),
            caption: format!("{quantity} of crack {} under each wheel, step {last}.", fastest.crack),
            x: ChartAxis::linear("Wheel position from the mouth", "mm").over(ChartRange::Tight),
            y: ChartAxis::linear(quantity, "MPa√m").over(ChartRange::AroundZero),
            curves: own.iter().enumerate().map(curve).collect(),
            ..Chart::default()
        }
    };
    let words = format!("K of crack {} under each wheel · {model}", fastest.crack);
    let mut sheet = ChartSheet::of(&summary.title, &words, chart("wheels-ki", "K_{I}", 1));
    sheet.rows.push(vec![chart("wheels-kii", "K_{II}", 2)]);
    Some(Plot::sheet("wheels.svg", sheet))
}

//! Quantile bands for studies with many runs.

use super::styles::StudyRun;
use crate::chart::{Chart, ChartArea, ChartAxis, ChartScale, Curve, CurveColour, CurveLook, CurveWidth};
use crate::figures::sif::Mode;
use crate::figures::{paths, sif};
use railcrack_run::run_folder::{RepresentativeTip, cycles_to};

/// Number of runs above which a study is shown as bands.
pub(crate) const MANY: usize = 50;

/// Quantiles and their names.
const SHARES: [(f64, &str); 5] =
    [(0.05, "5 %"), (0.25, "25 %"), (0.5, "median"), (0.75, "75 %"), (0.95, "95 %")];
/// Number of lengths at which lives are evaluated.
const LENGTHS: usize = 41;

/// K of the initial cracks and growth of `runs`; none if no run has a finished step.
pub(crate) fn band_charts(runs: &[StudyRun]) -> Vec<Chart> {
    let tips: Vec<&RepresentativeTip> = runs.iter().filter_map(StudyRun::tip).collect();
    let mut charts: Vec<Chart> =
        Mode::BOTH.into_iter().filter_map(|mode| over_passage(mode, &tips)).collect();
    charts.extend(lives(&tips));
    charts.extend(rates(&tips));
    charts
}

/// The quantile of `sorted` at `share`; beyond numbers, infinity.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() as f64 - 1.0);
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    let part = place - low as f64;
    if part == 0.0 { sorted[low] } else { (1.0 - part) * sorted[low] + part * sorted[high] }
}

/// The quantiles of `values`, where there are any.
fn quantiles(mut values: Vec<f64>) -> Option<[f64; 5]> {
    values.retain(|value| !value.is_nan());
    values.sort_by(f64::total_cmp);
    (!values.is_empty()).then(|| SHARES.map(|(share, _)| quantile(&values, share)))
}

fn over_passage(mode: Mode, tips: &[&RepresentativeTip]) -> Option<Chart> {
    let all: Vec<Vec<[f64; 2]>> =
        tips.iter().map(|tip| mode.points(&tip.history)).filter(|points| points.len() > 1).collect();
    let grid: Vec<f64> = all.first()?.iter().map(|point| point[0]).collect();
    let rows = grid.iter().filter_map(|&x| {
        let at_x = all.iter().map(|points| between(points, x)).collect();
        Some((x, quantiles(at_x)?))
    });
    let caption = format!("{} of the initial cracks over the passage: quantiles of the runs.", mode.symbol());
    let rows: Vec<(f64, [f64; 5])> = rows.collect();
    let chart = sif::chart(mode.id(), mode.symbol(), caption, Vec::new());
    Some(banded(chart, &rows, |x, y| [x, y]))
}

/// Relative round-off of a coordinate: runs with the same increments end at lengths that differ in
/// their last digits.
const ROUND_OFF: f64 = 1e-12;

/// The value of `points`, which go along x in either direction, at `x`; NaN beyond them, up to
/// round-off.
fn between(points: &[[f64; 2]], x: f64) -> f64 {
    let nearest =
        |one: f64, end: &[f64; 2]| if (one - end[0]).abs() <= ROUND_OFF * one.abs() { end[0] } else { one };
    let x = points.first().into_iter().chain(points.last()).fold(x, nearest);
    let pair = points.windows(2).find(|pair| (pair[0][0] - x) * (pair[1][0] - x) <= 0.0);
    pair.map_or(f64::NAN, |pair| {
        let span = pair[1][0] - pair[0][0];
        if span == 0.0 {
            pair[0][1]
        } else {
            pair[0][1] + (x - pair[0][0]) / span * (pair[1][1] - pair[0][1])
        }
    })
}

/// Lengths from the longest initial one to the longest of all.
fn lengths(tips: &[&RepresentativeTip]) -> Vec<f64> {
    let begin = tips.iter().map(|tip| tip.first.length).fold(f64::MIN, f64::max);
    let end = tips.iter().map(|tip| tip.last().length).fold(f64::MIN, f64::max);
    if end <= begin {
        return Vec::new();
    }
    (1..=LENGTHS).map(|i| begin + (end - begin) * i as f64 / LENGTHS as f64).collect()
}

/// Load cycles to each length; a run that does not reach it counts as infinite life.
fn lives(tips: &[&RepresentativeTip]) -> Option<Chart> {
    let rows: Vec<(f64, [f64; 5])> = lengths(tips)
        .into_iter()
        .filter_map(|length| {
            let life = |tip: &&RepresentativeTip| cycles_to(&tip.rows, length).unwrap_or(f64::INFINITY);
            Some((length, quantiles(tips.iter().map(life).collect())?))
        })
        .collect();
    if rows.is_empty() {
        return None;
    }
    let caption = "Load cycles to reach a crack length: quantiles of all runs; a run that does not reach the length counts as infinite life.";
    let chart = paths::lengths_chart(caption, Vec::new());
    let chart = Chart { x: ChartAxis::logarithmic(&chart.x.label, &chart.x.unit), ..chart };
    Some(banded(chart, &rows, |length, cycles| [cycles, length]))
}

/// Growth rates at each length, for the runs that reach it.
fn rates(tips: &[&RepresentativeTip]) -> Option<Chart> {
    let rows: Vec<(f64, [f64; 5])> = lengths(tips)
        .into_iter()
        .filter_map(|length| {
            let rate = |tip: &&RepresentativeTip| {
                let points: Vec<[f64; 2]> = tip.rows.iter().map(|row| [row.length, row.rate]).collect();
                between(&points, length)
            };
            let rates: Vec<f64> = tips.iter().map(rate).collect();
            // Quantiles of the few longest cracks would not represent the study.
            let reached = rates.iter().filter(|rate| rate.is_finite()).count();
            if 2 * reached < rates.len() {
                return None;
            }
            Some((length, quantiles(rates)?))
        })
        .collect();
    let chart = Chart {
        id: "rate-length".to_owned(),
        caption: "Growth rate against crack length: quantiles of the runs that reach the length, up to the length that half of the runs reach."
            .to_owned(),
        x: ChartAxis::linear("Crack length", "mm"),
        y: ChartAxis::logarithmic("da/dN", "mm/cycle"),
        ..Chart::default()
    };
    (!rows.is_empty()).then(|| banded(chart, &rows, |x, y| [x, y]))
}

/// `chart` with the quantiles of `rows` as curves and the ranges between them as areas; `point`
/// makes a point from the common coordinate and a value.
fn banded(chart: Chart, rows: &[(f64, [f64; 5])], point: impl Fn(f64, f64) -> [f64; 2]) -> Chart {
    let is_logarithmic = [&chart.x, &chart.y].iter().any(|axis| axis.scale == ChartScale::Logarithmic);
    let is_shown = |value: f64| value.is_finite() && (!is_logarithmic || value > 0.0);
    let curve = |i: usize| -> Vec<[f64; 2]> {
        let own = rows.iter().filter(|(_, values)| is_shown(values[i]));
        own.map(|(at, values)| point(*at, values[i])).collect()
    };
    let area = |name: &str, low: usize, high: usize| {
        // The area extends as far as both of its bounds are known.
        let both = || rows.iter().filter(|(_, values)| is_shown(values[low]) && is_shown(values[high]));
        let there = both().map(|(at, values)| point(*at, values[low]));
        let back = both().rev().map(|(at, values)| point(*at, values[high]));
        let outline = there.chain(back).collect();
        ChartArea { name: name.to_owned(), outline }
    };
    let looks =
        [CurveLook::FineDashed, CurveLook::Dashed, CurveLook::Line, CurveLook::Dashed, CurveLook::FineDashed];
    let curves = SHARES.iter().zip(looks).enumerate().map(|(i, ((_, name), look))| {
        let width = if i == 2 { CurveWidth::Wide } else { CurveWidth::Usual };
        Curve::line(name, curve(i)).with_look(look).with_width(width).with_colour(CurveColour::Category(0))
    });
    Chart {
        curves: curves.filter(|curve| !curve.points.is_empty()).collect(),
        areas: vec![area("5 % to 95 %", 0, 4), area("25 % to 75 %", 1, 3)],
        ..chart
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_values() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(quantiles(values), Some([5.0, 25.0, 50.0, 75.0, 95.0]));
        let with_more = quantiles(vec![1.0, f64::INFINITY, 2.0, f64::INFINITY, f64::NAN]).unwrap();
        assert!(with_more[1].is_finite() && with_more[3] == f64::INFINITY);
        assert_eq!(between(&[[2.0, 5.0], [0.0, 1.0]], 0.5), 2.0);
        assert!(between(&[[2.0, 5.0], [0.0, 1.0]], 3.0).is_nan());
        assert_eq!(between(&[[0.0, 1.0], [2.0, 5.0]], 2.0_f64.next_up()), 5.0);
    }
}

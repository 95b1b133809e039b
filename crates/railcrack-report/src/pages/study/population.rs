//! Samples interpolated between the runs of a study.

use crate::chart::{Chart, ChartAxis, ChartRange, Curve, CurveLook};
use crate::numbers::{fixed, significant, tonnage};
use crate::page::Block;
use crate::pages::phrases::{FAST_GROWTH, SLOW_GROWTH, detectable_to_critical};
use crate::table::Table;
use railcrack_run::decision::{DepthQuantiles, Quantiles, ScatterSummary};
use railcrack_run::study::Population;

/// The first blocks of the page of a study, with the results of its samples; none without samples.
pub(super) fn blocks(populations: &[Population]) -> Vec<Block> {
    let mut blocks = Vec::new();
    for (place, population) in populations.iter().enumerate() {
        let heading = match population.choice.as_str() {
            "" => "Decision".to_owned(),
            choice => format!("Decision, {choice}"),
        };
        blocks.push(Block::Heading(heading));
        match (&population.scatter, &population.reason) {
            (Some(scatter), _) => blocks.extend(of(place, population, scatter)),
            (None, reason) => {
                let reason = reason.as_deref().unwrap_or("no run is finished");
                blocks.push(Block::Text(format!("No samples were interpolated between the runs: {reason}.")));
            }
        }
    }
    blocks
}

fn of(place: usize, population: &Population, scatter: &ScatterSummary) -> Vec<Block> {
    let mut sentences: Vec<String> = detectable_to_critical(scatter).into_iter().collect();
    if let Some(interval) = population.interval_mgt {
        let mgt = tonnage(interval);
        sentences.push(format!("With all keys at their means, the inspection interval is {mgt} MGT."));
    }
    let left_out = match population.left_out {
        0 => String::new(),
        count => format!("; {count} runs without growth are excluded"),
    };
    let error = population.error.map_or_else(String::new, |error| {
        format!(
            " The interpolation error is {} % (root mean square; at most {} %), from {} runs that were left out one by one or \
             not used for interpolation.",
            significant(error.rms_percent),
            significant(error.worst_percent),
            error.runs
        )
    });
    sentences.push(format!("Results are interpolated between {} runs{left_out}.{error}", population.runs));
    let mut blocks = vec![Block::List(sentences)];
    blocks.extend(depths(place, &scatter.depth).map(Block::Chart));
    // All of them are zero where no sample becomes critical.
    if scatter.sensitivities.iter().any(|sensitivity| sensitivity.share > 0.0) {
        let mut table = Table::new(["Quantity", "Share of the scatter (%)"]);
        table.caption = "Squared correlation of each quantity with the logarithm of the traffic from the \
                         detectable to the critical crack"
            .to_owned();
        for sensitivity in &scatter.sensitivities {
            table.row([sensitivity.key.clone(), fixed(100.0 * sensitivity.share, 1)]);
        }
        blocks.push(Block::Table(table));
    }
    blocks
}

/// Median, 5 % and 95 % quantiles of the depth against traffic.
fn depths(place: usize, depths: &[DepthQuantiles]) -> Option<Chart> {
    type OfShare = fn(&Quantiles) -> Option<f64>;
    let shares: [(&str, OfShare, CurveLook); 3] = [
        ("median", |quantiles| quantiles.p50, CurveLook::Line),
        (SLOW_GROWTH, |quantiles| quantiles.p05, CurveLook::Dashed),
        (FAST_GROWTH, |quantiles| quantiles.p95, CurveLook::Dashed),
    ];
    let curve = |(name, of, look): (&str, OfShare, CurveLook)| {
        let points: Vec<[f64; 2]> =
            depths.iter().filter_map(|at| Some([at.mgt, of(&at.depth_mm)?])).collect();
        (points.len() > 1).then(|| Curve::line(name, points).with_look(look))
    };
    let curves: Vec<Curve> = shares.into_iter().filter_map(curve).collect();
    (!curves.is_empty()).then(|| Chart {
        id: format!("population-{}", place + 1),
        caption:
            "Depth of the crack against traffic: median of the samples, and the 5 % that grow fastest and slowest, as far as \
                  the computed runs extend."
                .to_owned(),
        x: ChartAxis::linear("Million gross tonnes", "").over(ChartRange::AroundZero),
        y: ChartAxis::depth(),
        curves,
        ..Chart::default()
    })
}

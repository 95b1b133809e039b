//! The wheels of a mix over the fronts: which lateral places grow which part.

use super::stored::RunFolder;
use crate::figures::{Plot, charts, has_closed_front};
use crate::numbers::fixed;
use crate::page::Block;
use crate::table::Table;
use railcrack_run::csv::TipRow;

/// A part of a front, by the parametric angle (degrees) of its points.
struct FrontPart {
    name: &'static str,
    contains: fn(f64) -> bool,
}

/// The ends and the deepest part share a half-turn in equal parts; the sides of the strip of a
/// folded crack belong to the ends.
const OPEN: [FrontPart; 3] = [
    FrontPart { name: "End at φ < 60°", contains: |phi| phi < 60.0 },
    DEEPEST,
    FrontPart { name: "End at φ > 120°", contains: |phi| phi > 120.0 },
];

/// A closed front has an upper part as well.
const CLOSED: [FrontPart; 4] = [
    FrontPart { name: "End at φ < 60°", contains: |phi| !(60.0..=300.0).contains(&phi) },
    DEEPEST,
    FrontPart { name: "End at φ > 120°", contains: |phi| phi > 120.0 && phi < 240.0 },
    FrontPart { name: "Upper, 240° to 300°", contains: |phi| (240.0..=300.0).contains(&phi) },
];

const DEEPEST: FrontPart =
    FrontPart { name: "Deepest, 60° to 120°", contains: |phi| (60.0..=120.0).contains(&phi) };

/// The shares of the wheels in the growth of a part of a front during the run.
struct PartGrowth {
    /// Mean lateral position of its points in the first step, mm.
    lateral: f64,
    /// By wheel; without any growth those of the rates in the first step.
    shares: Vec<f64>,
}

/// The table of wheels and parts of the fronts, and a sentence for each front; none of a run with a
/// single wheel.
pub(super) fn wheels(run: &RunFolder) -> Vec<Block> {
    let (mix, patches) = (&run.case.wheels, &run.patches);
    let count = run.growth.first().map_or(0, |row| row.shares.values().len());
    if mix.len() < 2 || count != mix.len() || patches.len() != count {
        return Vec::new();
    }
    let parts = if has_closed_front(run.growth.iter()) { &CLOSED[..] } else { &OPEN[..] };
    let headings = ["Crack", "Wheel", "z of its contact (mm)", "Axles (%)"].into_iter();
    let mut table = Table::new(headings.chain(parts.iter().map(|part| part.name)).collect::<Vec<_>>());
    table.caption =
        "Shares of the wheels in the growth of the parts of the front over the run (%); φ = 0 is the end of \
                     larger z, without a strike"
            .to_owned();
    let mut lines = Vec::new();
    for crack in 1..=run.summary.cracks.len() {
        let grown: Vec<PartGrowth> = parts.iter().map(|part| grown(&run.growth, crack, part)).collect();
        for (number, (mixed, wheel)) in mix.iter().zip(patches).enumerate() {
            let share = |of: &PartGrowth| fixed(100.0 * of.shares.get(number).copied().unwrap_or(0.0), 1);
            let axles = fixed(100.0 * mixed.share, 1);
            let start = [crack.to_string(), mixed.name.clone(), fixed(wheel.outline().lateral, 2), axles];
            table.row(start.into_iter().chain(grown.iter().map(share)).collect::<Vec<_>>());
        }
        let most = |of: &PartGrowth| {
            let ahead = |a: &(usize, &f64), b: &(usize, &f64)| a.1.total_cmp(b.1).then(b.0.cmp(&a.0));
            let (number, share) = of.shares.iter().enumerate().max_by(ahead)?;
            let (mixed, wheel) = (mix.get(number)?, patches.get(number)?);
            Some(format!(
                "around z = {} mm by {} at z = {} mm ({} % of the growth)",
                fixed(of.lateral, 1),
                mixed.name,
                fixed(wheel.outline().lateral, 1),
                fixed(100.0 * share, 0)
            ))
        };
        let sentences: Vec<String> =
            grown.iter().filter(|of| of.shares.iter().sum::<f64>() > 0.0).filter_map(most).collect();
        if !sentences.is_empty() {
            let which =
                if run.summary.cracks.len() == 1 { "The front".to_owned() } else { format!("Front {crack}") };
            lines.push(format!("{which} is grown most {}.", sentences.join(", ")));
        }
    }
    let sentences = (!lines.is_empty()).then(|| Block::Text(lines.join(" ")));
    sentences.into_iter().chain([Block::Table(table)]).collect()
}

/// The chart of the shares along the fronts; none of a run with a single wheel.
pub(super) fn drawn(run: &RunFolder, plots: &[Plot]) -> Option<Block> {
    let mixed = run.growth.first().is_some_and(|row| row.shares.values().len() > 1);
    mixed.then(|| charts(plots, &["wheels-along-front"]))
}

/// The growth of a part of the front of `crack`, from 1.
fn grown(growth: &[TipRow], crack: usize, part: &FrontPart) -> PartGrowth {
    let is_of_part =
        |row: &&TipRow| row.crack == crack && row.phi_deg.is_some_and(|phi| (part.contains)(phi));
    let rows: Vec<&TipRow> = growth.iter().filter(is_of_part).collect();
    let first = || rows.iter().filter(|row| row.step == 0);
    let wheels = growth.first().map_or(0, |row| row.shares.values().len());
    let weighted = |weight: &dyn Fn(&TipRow) -> f64| {
        let mut shares = vec![0.0; wheels];
        let mut sum = 0.0;
        for row in &rows {
            let weight = weight(row);
            sum += weight;
            shares.iter_mut().zip(row.shares.values()).for_each(|(sum, share)| *sum += weight * share);
        }
        (sum > 0.0).then(|| shares.into_iter().map(|share| share / sum).collect::<Vec<f64>>())
    };
    let shares = weighted(&|row| row.increment.max(0.0))
        .or_else(|| weighted(&|row| if row.step == 0 { row.rate } else { 0.0 }))
        .unwrap_or_else(|| vec![0.0; wheels]);
    let lateral = first().filter_map(|row| row.lateral).sum::<f64>() / (first().count().max(1) as f64);
    PartGrowth { lateral, shares }
}

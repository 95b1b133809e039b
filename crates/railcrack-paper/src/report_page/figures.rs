//! The figures, from their tables.

use super::{look, symbols};
use crate::document::{PaperRecord, SetupRecord};
use crate::figure::{FIGURES, Figure};
use crate::figures::{DIGITISED, Distance, FigureTable, Quantity, TableCurve, distances, kept, page_chart};
use railcrack_report::{Block, Cell, Chart, Curve, CurveLook, Table, significant};
use railcrack_run::OutputError;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Maximum number of points on the page, of 14 bytes each. Main set-ups come first, then variants.
const POINTS: usize = 180_000;

/// The figures one below the other, then their files.
///
/// Errors: a table is damaged; the system refuses.
pub(super) fn blocks(folder: &Path, record: &PaperRecord) -> Result<Vec<Block>, OutputError> {
    let (mut charts, mut overlays) = (Vec::new(), Vec::new());
    let recomputed = |figure: &&Figure| record.figures.iter().any(|other| other.number == figure.number);
    for figure in FIGURES.iter().filter(recomputed) {
        let path = folder.join("figures").join(format!("{}.csv", figure.file_stem()));
        let damaged = |reason| OutputError::damaged(&path, reason);
        let text = std::fs::read_to_string(&path).map_err(OutputError::io("read", &path))?;
        let table = FigureTable::parse(&text).map_err(damaged)?;
        for &quantity in Quantity::of(figure) {
            let curves = quantity.curves(&table);
            let curves = curves.map_err(|text| damaged(format!("\"{text}\" is not a number")))?;
            let mut curves = curves.unwrap_or_default();
            let digitised = kept(folder, figure, quantity)?;
            overlays.extend(distances(quantity, &curves, &digitised).into_iter().map(|d| (figure.number, d)));
            curves.extend(digitised);
            let styled = |table: &TableCurve, curve| styled(&record.setups, table, curve);
            charts.push((figure.number, page_chart(figure, quantity, &curves, styled)));
        }
    }
    let mut blocks = Vec::new();
    if leave_out(charts.iter_mut().map(|(_, chart)| chart)) == Whole::No {
        let text = "The charts on this page omit some variants; the tables have all.";
        blocks.push(Block::Text(text.to_owned()));
    }
    let mut files = Table::new(["Figure", "Shows", "Picture", "Numbers"]);
    for figure in &record.figures {
        blocks.push(Block::Heading(format!("Fig. {}: {}", figure.number, symbols(&figure.title))));
        let own = charts.iter().filter(|(number, _)| *number == figure.number);
        blocks.push(Block::charts(own.map(|(_, chart)| chart.clone())));
        let own: Vec<&Distance> =
            overlays.iter().filter(|(number, _)| *number == figure.number).map(|(_, d)| d).collect();
        if !own.is_empty() {
            blocks.push(Block::Table(distance_table(&own)));
        }
        let [picture, numbers] =
            ["svg", "csv"].map(|ending| format!("figures/fig{}.{ending}", figure.number));
        files.row([
            Cell::from(format!("Fig. {}", figure.number)),
            symbols(&figure.title).into(),
            Cell::linked("SVG", &picture),
            Cell::linked("CSV", &numbers),
        ]);
    }
    if folder.join("figures").join("engines.svg").is_file() {
        files.row([
            Cell::from("Fig. 13"),
            "Both engines on the case of this figure, with their difference".into(),
            Cell::linked("SVG", "figures/engines.svg"),
            "".into(),
        ]);
    }
    blocks.push(Block::Heading("Files".to_owned()));
    let cases = "The folder cases/ contains every case file, ready to run or modify.";
    blocks.push(Block::Text(cases.to_owned()));
    blocks.push(Block::Table(files));
    Ok(blocks)
}

/// How far the curves of each set-up are from the digitised ones.
fn distance_table(distances: &[&Distance]) -> Table {
    let mut table =
        Table::new(["Digitised curve", "Crack", "Quantity", "Set-up", "Points", "Largest", "Mean", "Unit"]);
    table.caption =
        "Distance from the digitised curves: to the nearest point for paths, otherwise at the same position"
            .to_owned();
    for d in distances {
        table.row([
            d.curve.clone(),
            d.crack.clone(),
            d.quantity.symbol().to_owned(),
            d.setup.clone(),
            d.points.to_string(),
            significant(d.largest),
            significant(d.mean),
            d.quantity.unit_of_distance().to_owned(),
        ]);
    }
    table
}

/// `curve` with the line, the name and the switch of its set-up.
fn styled(setups: &[SetupRecord], table: &TableCurve, curve: Curve) -> Curve {
    let at = setups.iter().position(|setup| setup.name == table.setup);
    Curve {
        look: match at {
            Some(at) => look(setups, at),
            None if table.setup == DIGITISED => CurveLook::Dots,
            None => CurveLook::Line,
        },
        note: table.setup.clone(),
        choices: at.into_iter().collect(),
        ..curve
    }
}

/// Whether all curves are on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Whole {
    Yes,
    No,
}

/// Omits curves that exceed the limit of the page. Set-ups are kept in their order, on all charts.
fn leave_out<'a>(charts: impl Iterator<Item = &'a mut Chart>) -> Whole {
    let mut charts: Vec<&mut Chart> = charts.collect();
    let mut sizes: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for curve in charts.iter().flat_map(|chart| &chart.curves) {
        *sizes.entry(curve.choices.clone()).or_default() += curve.points.len();
    }
    let mut taken = 0;
    let mut shown = BTreeSet::new();
    for (setup, size) in sizes {
        taken += size;
        // The first set-up is kept regardless of its size.
        if taken > POINTS && !shown.is_empty() {
            break;
        }
        shown.insert(setup);
    }
    let mut whole = Whole::Yes;
    for chart in &mut charts {
        let before = chart.curves.len();
        chart.curves.retain(|curve| shown.contains(&curve.choices));
        if chart.curves.len() < before {
            whole = Whole::No;
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_are_left_out_before_main_set_ups_on_all_charts() {
        let chart = |setups: &[usize], points: usize| Chart {
            curves: setups
                .iter()
                .map(|&setup| Curve::line("", vec![[0.0, 0.0]; points]).with_choices(vec![setup]))
                .collect(),
            ..Chart::default()
        };
        let shown = |charts: &[Chart]| -> Vec<Vec<usize>> {
            charts.iter().map(|chart| chart.curves.iter().map(|curve| curve.choices[0]).collect()).collect()
        };
        let mut charts = [chart(&[0, 1, 2], POINTS / 4), chart(&[0, 2], POINTS / 4)];
        assert_eq!(leave_out(charts.iter_mut()), Whole::No);
        assert_eq!(shown(&charts), [vec![0, 1], vec![0]]);
        let mut charts = [chart(&[0, 1, 2], 10)];
        assert_eq!(leave_out(charts.iter_mut()), Whole::Yes);
        assert_eq!(shown(&charts), [vec![0, 1, 2]]);
        // The first set-up is kept regardless of its size.
        let mut charts = [chart(&[0, 1], 2 * POINTS)];
        leave_out(charts.iter_mut());
        assert_eq!(shown(&charts), [vec![0]]);
    }
}

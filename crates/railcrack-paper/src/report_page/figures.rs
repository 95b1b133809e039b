//! The figures, from their tables.

use super::tables::FigureTable;
use super::{look, symbols};
use crate::document::{FigureRecord, PaperRecord};
use railcrack_report::{Block, Cell, ChartAspect, ChartAxis, ChartScale, Curve, CurveLook, LineChart, Table};
use railcrack_run::OutputError;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The most points in the page: 14 bytes each. Main set-ups go first, variants while there is room.
const POINTS: usize = 180_000;
/// Quantities of the tables: name, columns of x and y, id, titles, scale.
const QUANTITIES: [Quantity; 4] = [
    Quantity {
        id: "ki",
        words: "K_{I} over the passage",
        columns: ["xc_over_a", "ki_mpa_sqrt_m"],
        titles: ["x_{c}/a, along the travel", "K_{I} (MPa√m)"],
        scale: ChartScale::Linear,
        aspect: ChartAspect::Free,
    },
    Quantity {
        id: "kii",
        words: "K_{II} over the passage",
        columns: ["xc_over_a", "kii_mpa_sqrt_m"],
        titles: ["x_{c}/a, along the travel", "K_{II} (MPa√m)"],
        scale: ChartScale::Linear,
        aspect: ChartAspect::Free,
    },
    Quantity {
        id: "paths",
        words: "Paths to scale",
        columns: ["x_mm", "depth_mm"],
        titles: ["x (mm), along the travel", "Depth (mm)"],
        scale: ChartScale::Depth,
        aspect: ChartAspect::Equal,
    },
    Quantity {
        id: "profile",
        words: "Stress by depth",
        columns: ["sxx_mpa", "depth_mm"],
        titles: ["σ_{xx} (MPa)", "Depth (mm)"],
        scale: ChartScale::Depth,
        aspect: ChartAspect::Free,
    },
];

struct Quantity {
    id: &'static str,
    words: &'static str,
    columns: [&'static str; 2],
    titles: [&'static str; 2],
    scale: ChartScale,
    aspect: ChartAspect,
}

/// The figures one below the other, then their files.
///
/// Errors: a table is damaged; the system refuses.
pub(super) fn blocks(folder: &Path, record: &PaperRecord) -> Result<Vec<Block>, OutputError> {
    let mut charts = Vec::new();
    for figure in &record.figures {
        let path = folder.join("figures").join(format!("fig{}.csv", figure.number));
        let table = FigureTable::read(&path)?;
        for quantity in &QUANTITIES {
            if let Some(curves) = curves(&path, &table, quantity, record)? {
                charts.push((figure.number, chart(figure, quantity, curves)));
            }
        }
    }
    let mut blocks = Vec::new();
    if leave_out(charts.iter_mut().map(|(_, chart)| chart)) == Whole::No {
        let text = "Not all variants are on the charts of this page; the tables have them.";
        blocks.push(Block::Text(text.to_owned()));
    }
    let mut files = Table::new(["Figure", "Shows", "Picture", "Numbers"]);
    for figure in &record.figures {
        blocks.push(Block::Heading(format!("Fig. {}: {}", figure.number, symbols(&figure.title))));
        let own = charts.iter().filter(|(number, _)| *number == figure.number);
        blocks.push(Block::charts(own.map(|(_, chart)| chart.clone())));
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
            "Both engines on its case, and their difference".into(),
            Cell::linked("SVG", "figures/engines.svg"),
            "".into(),
        ]);
    }
    blocks.push(Block::Heading("Files".to_owned()));
    let cases = "Every case that was run is in the folder cases/ and can be run and changed.";
    blocks.push(Block::Text(cases.to_owned()));
    blocks.push(Block::Table(files));
    Ok(blocks)
}

fn chart(figure: &FigureRecord, quantity: &Quantity, curves: Vec<Curve>) -> LineChart {
    LineChart {
        id: format!("fig{}-{}", figure.number, quantity.id),
        caption: format!("Fig. {}: {}.", figure.number, quantity.words),
        x: ChartAxis::linear(quantity.titles[0]),
        y: ChartAxis { scale: quantity.scale, ..ChartAxis::linear(quantity.titles[1]) },
        curves,
        aspect: quantity.aspect,
        ..LineChart::default()
    }
}

/// The curves of `quantity` in a table; none where the table has no such columns.
fn curves(
    path: &Path,
    table: &FigureTable,
    quantity: &Quantity,
    record: &PaperRecord,
) -> Result<Option<Vec<Curve>>, OutputError> {
    let [Some(x), Some(y)] = quantity.columns.map(|name| table.column(name)) else { return Ok(None) };
    let texts = ["setup", "curve", "crack", "profile"].map(|name| table.column(name));
    let mut curves: Vec<([String; 4], Curve)> = Vec::new();
    // The order in which curve and crack first appear gives the colour, in all set-ups alike.
    let mut seen: Vec<[String; 3]> = Vec::new();
    let has_several = table.rows().any(|row| texts[2].is_some_and(|crack| row[crack] != "1"));
    for row in table.rows() {
        let number = |at: usize| {
            let value = row[at].parse().ok().filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| OutputError::damaged(path, format!("\"{}\" is no number", row[at])))
        };
        let key = texts.map(|place| place.map_or_else(String::new, |place| row[place].clone()));
        let point = [number(x)?, number(y)?];
        if let Some((_, curve)) = curves.last_mut().filter(|(last, _)| *last == key) {
            curve.points.push(point);
            continue;
        }
        let [setup, name, crack, profile] = &key;
        let own = [name.clone(), crack.clone(), profile.clone()];
        let place = seen.iter().position(|other| *other == own).unwrap_or_else(|| {
            seen.push(own);
            seen.len() - 1
        });
        let legend =
            record.curves.iter().find(|curve| curve.name == *name).map(|curve| curve.legend.as_str());
        let words = match (legend, has_several) {
            (Some(legend), true) => format!("{legend}, crack {crack}"),
            (Some(legend), false) => legend.to_owned(),
            (None, _) => format!("{name}{profile}"),
        };
        let at = record.setups.iter().position(|other| other.name == *setup);
        let look = at.map_or(CurveLook::Line, |at| look(&record.setups, at));
        let mut curve = Curve::line(&words, vec![point]).with_look(look).with_colour(place);
        curve.note = setup.clone();
        curve.choices = at.into_iter().collect();
        curves.push((key, curve));
    }
    Ok(Some(curves.into_iter().map(|(_, curve)| curve).collect()))
}

/// Whether all curves are on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Whole {
    Yes,
    No,
}

/// Leaves out the curves that find no room on the page: those of the first set-ups go first, on all charts.
fn leave_out<'a>(charts: impl Iterator<Item = &'a mut LineChart>) -> Whole {
    let mut charts: Vec<&mut LineChart> = charts.collect();
    let mut sizes: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for curve in charts.iter().flat_map(|chart| &chart.curves) {
        *sizes.entry(curve.choices.clone()).or_default() += curve.points.len();
    }
    let mut taken = 0;
    let mut shown = BTreeSet::new();
    for (setup, size) in sizes {
        taken += size;
        // The first ones are there whatever they take.
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
        let chart = |setups: &[usize], points: usize| LineChart {
            curves: setups
                .iter()
                .map(|&setup| Curve::line("", vec![[0.0, 0.0]; points]).with_choices(vec![setup]))
                .collect(),
            ..LineChart::default()
        };
        let shown = |charts: &[LineChart]| -> Vec<Vec<usize>> {
            charts.iter().map(|chart| chart.curves.iter().map(|curve| curve.choices[0]).collect()).collect()
        };
        let mut charts = [chart(&[0, 1, 2], POINTS / 4), chart(&[0, 2], POINTS / 4)];
        assert_eq!(leave_out(charts.iter_mut()), Whole::No);
        assert_eq!(shown(&charts), [vec![0, 1], vec![0]]);
        let mut charts = [chart(&[0, 1, 2], 10)];
        assert_eq!(leave_out(charts.iter_mut()), Whole::Yes);
        assert_eq!(shown(&charts), [vec![0, 1, 2]]);
        // The first set-up is there whatever it takes.
        let mut charts = [chart(&[0, 1], 2 * POINTS)];
        leave_out(charts.iter_mut());
        assert_eq!(shown(&charts), [vec![0]]);
    }
}

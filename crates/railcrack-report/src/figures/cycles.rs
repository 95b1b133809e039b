//! Crack length against load cycles.

use super::many::bundle;
use super::plot::Plot;
use crate::chart::{Chart, ChartAxis, ChartSheet, Curve, CurveColour, CurveDots};
use crate::row::NamedCrack;
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;

/// A chart of lengths.
pub(super) fn chart(caption: &str, curves: Vec<Curve>) -> Chart {
    Chart {
        id: "length-cycles".to_owned(),
        caption: caption.to_owned(),
        x: ChartAxis::linear("Load cycles", "axles"),
        y: ChartAxis::linear("Crack length", "mm"),
        curves,
        ..Chart::default()
    }
}

/// The lengths in a run on the model `model`; for many cracks the `named` ones are highlighted.
pub(super) fn plot(summary: &Summary, growth: &[TipRow], named: Option<&[NamedCrack]>, model: &str) -> Plot {
    // Both tips of a buried crack have the same length, so the first represents the crack.
    let cracks: Vec<usize> =
        growth.iter().filter(|row| row.step == 0 && row.tip == 1).map(|row| row.crack).collect();
    let curve = |(place, &crack): (usize, &usize)| {
        let rows = growth.iter().filter(|row| row.crack == crack && row.tip == 1);
        let name = if cracks.len() > 1 { format!("crack {crack}") } else { String::new() };
        Curve::line(&name, rows.map(|row| [row.load_cycles, row.length]).collect())
            .with_dots(CurveDots::All)
            .with_colour(CurveColour::of(place, cracks.len()))
    };
    let curves: Vec<Curve> = cracks.iter().enumerate().map(curve).collect();
    let curves = match named {
        Some(named) => bundle(named, cracks.into_iter().zip(curves).collect()),
        None => curves,
    };
    let caption = "Crack length against load cycles (axles); dots mark the growth steps.";
    let subtitle = format!("Crack length, dots mark the growth steps · {model}");
    Plot::sheet("length-cycles.svg", ChartSheet::of(&summary.title, &subtitle, chart(caption, curves)))
}

//! Curves of the tips of a run.

use super::stored::RunFolder;
use crate::chart::{Curve, CurveColour, CurveDots};
use crate::figures::bundle;
use crate::row::NamedCrack;
use railcrack_run::csv::TipRow;

/// A curve for each tip, unnamed for a single tip, which needs no legend. For many cracks only the
/// `named` ones are named.
pub(super) fn curves(
    run: &RunFolder,
    named: Option<&[NamedCrack]>,
    point: impl Fn(&TipRow) -> [f64; 2],
) -> Vec<Curve> {
    let tips = run.tips();
    let has_two = tips.iter().any(|&(_, tip)| tip > 1);
    let curve = |(place, &(crack, tip)): (usize, &(usize, usize))| {
        let name = match (tips.len(), has_two) {
            (1, _) => String::new(),
            (_, false) => format!("crack {crack}"),
            (_, true) => format!("crack {crack}, tip {tip}"),
        };
        Curve::line(&name, run.history(crack, tip).map(&point).collect())
            .with_dots(CurveDots::All)
            .with_colour(CurveColour::of(place, tips.len()))
    };
    let curves: Vec<Curve> = tips.iter().enumerate().map(curve).collect();
    match named {
        Some(named) => bundle(named, tips.iter().map(|&(crack, _)| crack).zip(curves).collect()),
        None => curves,
    }
}

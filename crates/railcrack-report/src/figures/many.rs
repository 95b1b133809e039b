//! Charts of many cracks: all in grey, with a few highlighted cracks above them.

use crate::chart::{Curve, CurveColour, CurveDots, CurveLook, CurveWidth, LegendEntry};
use crate::row::NamedCrack;

/// Maximum number of grey curves; of more, evenly spaced ones are chosen.
const BUNDLE: usize = 150;
/// Name of the grey curves in a legend.
const OTHERS: &str = "other cracks";
/// Steps of a colour bar.
const BAR: usize = 5;

/// The `curves` of cracks by number, named after their crack or tip: the `named` cracks in colour,
/// above the others, which are thin and grey. The note of a curve is its crack.
pub(crate) fn bundle(named: &[NamedCrack], curves: Vec<(usize, Curve)>) -> Vec<Curve> {
    let (told, others): (Vec<_>, Vec<_>) =
        curves.into_iter().partition(|(crack, _)| named.iter().any(|named| named.crack == *crack));
    let every = others.len().div_ceil(BUNDLE).max(1);
    let quiet = others.into_iter().step_by(every).map(|(_, curve)| Curve {
        note: curve.name,
        name: OTHERS.to_owned(),
        colour: Some(CurveColour::Quiet),
        width: CurveWidth::Fine,
        dots: CurveDots::None,
        look: CurveLook::Line,
        ..curve
    });
    let mut drawn: Vec<Curve> = quiet.collect();
    for (place, named) in named.iter().enumerate() {
        let own = told.iter().filter(|(crack, _)| *crack == named.crack).map(|(_, curve)| Curve {
            note: curve.name.clone(),
            name: named.title(),
            colour: Some(CurveColour::Category(place)),
            ..curve.clone()
        });
        drawn.extend(own);
    }
    drawn
}

/// A legend of colours from 0 to `most` of a quantity, with round values, the largest first.
pub(super) fn colour_bar(heading: &str, most: f64) -> Vec<LegendEntry> {
    let step = crate::svg::round_step(most, BAR);
    let decimals = crate::svg::decimals_of(step);
    let count = (most / step + 1e-9).floor() as usize;
    let entry = |k: usize| {
        let value = k as f64 * step;
        let look = CurveLook::Line;
        LegendEntry::curve(&format!("{value:.decimals$}"), look, CurveColour::Along(value / most))
    };
    let mut entries = vec![LegendEntry::heading(heading)];
    entries.extend((0..=count).rev().map(entry));
    entries
}

//! The figures of the paper and their curves.

use crate::curve::CURVES;
use thiserror::Error;

/// A figure of the paper.
pub struct Figure {
    /// Its number.
    pub number: u8,
    /// Its title.
    pub title: &'static str,
    /// How it is drawn.
    pub(super) kind: Kind,
    /// The curves that it shows.
    pub(super) curves: &'static [&'static str],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// K_I and K_II against the wheel position.
    Sif,
    /// Paths to scale.
    Paths,
    /// Stress against depth.
    Profile,
}

const fn figure(number: u8, kind: Kind, title: &'static str, curves: &'static [&'static str]) -> Figure {
    Figure { number, title, kind, curves }
}

/// The figures with results: 13 to 25 and 27 to 30.
#[rustfmt::skip]
pub static FIGURES: &[Figure] = &[
    figure(13, Kind::Sif, "K under strong braking with low crack-face friction", &["fig13"]),
    figure(14, Kind::Sif, "K for positive wheel–rail friction", &["reference", "wheel+0.1", "wheel+0.4"]),
    figure(15, Kind::Sif, "K for negative wheel–rail friction", &["wheel-0.025", "wheel-0.1", "wheel-0.4"]),
    figure(16, Kind::Paths, "Crack paths for wheel–rail friction", &["reference", "wheel+0.1", "wheel+0.4", "wheel-0.025", "wheel-0.1", "wheel-0.4"]),
    figure(17, Kind::Sif, "K for crack-face friction", &["faces-0.1", "faces-0.2", "reference", "faces-0.8"]),
    figure(18, Kind::Paths, "Crack paths for crack-face friction", &["faces-0.1", "faces-0.2", "reference", "faces-0.8"]),
    figure(19, Kind::Sif, "K for the inclination of the crack", &["reference", "angle-30", "angle-45", "angle-60", "angle-75"]),
    figure(20, Kind::Paths, "Crack paths for the inclination of the crack", &["reference", "angle-30", "angle-45", "angle-60", "angle-75"]),
    figure(21, Kind::Profile, "Residual stress by depth", &[]),
    figure(22, Kind::Sif, "K with the residual stress of Fig. 21", &["reference", "stress"]),
    figure(23, Kind::Paths, "Crack paths with the residual stress of Fig. 21", &["reference", "stress"]),
    figure(24, Kind::Sif, "K of two cracks", &["reference", "crack-2-alone", "pair"]),
    figure(25, Kind::Paths, "Crack paths of two cracks", &["reference", "crack-2-alone", "pair"]),
    figure(27, Kind::Sif, "K of nine cracks", &["nine", "wheel+0.1"]),
    figure(28, Kind::Paths, "Crack paths of nine cracks", &["nine"]),
    figure(29, Kind::Sif, "K of nine cracks with the residual stress of Fig. 21", &["nine-stress", "one-stress"]),
    figure(30, Kind::Paths, "Crack paths of nine cracks with the residual stress of Fig. 21", &["nine", "nine-stress"]),
];

impl Figure {
    /// `fig13`, the name of its files.
    pub fn file_stem(&self) -> String {
        format!("fig{}", self.number)
    }

    /// The words of the curve or profile `name` in its legend: the reference case is called by the
    /// value that the figure varies.
    pub(super) fn words<'a>(&self, name: &'a str) -> &'a str {
        match (self.number, name) {
            (14..=16, "reference") => "wheel–rail friction 0.025",
            (17 | 18, "reference") => "crack-face friction 0.5",
            (19 | 20, "reference") => "15\u{b0}",
            (22 | 23, "reference") => "without residual stress",
            (24 | 25, "reference") => "crack 1 alone",
            (27 | 29, "wheel+0.1" | "one-stress") => "one crack",
            _ => CURVES.iter().find(|curve| curve.name == name).map_or(name, |curve| curve.legend),
        }
    }

    /// Whether cracks grow in it.
    pub(super) fn is_path(number: u8) -> bool {
        FIGURES.iter().any(|figure| figure.number == number && figure.kind == Kind::Paths)
    }
}

/// A figure that the paper does not have, or that shows no results.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{given}` is not a figure with results: must be one of {accepted}")]
pub struct UnknownFigure {
    /// The name given.
    pub given: String,
    /// The numbers accepted.
    pub accepted: String,
}

/// The numbers of the figures called `names`, `13` or `fig13`, each once and in order; all where
/// there are none.
///
/// Errors: a name that is no figure with results.
pub fn parse_figures(names: &[String]) -> Result<Vec<u8>, UnknownFigure> {
    if names.is_empty() {
        return Ok(FIGURES.iter().map(|figure| figure.number).collect());
    }
    let number = |name: &String| {
        let lower = name.to_lowercase();
        let digits = lower.strip_prefix("fig").unwrap_or(&lower);
        let number =
            digits.parse().ok().filter(|number| FIGURES.iter().any(|figure| figure.number == *number));
        number.ok_or_else(|| UnknownFigure {
            given: name.clone(),
            accepted: FIGURES.iter().map(|figure| figure.number.to_string()).collect::<Vec<_>>().join(", "),
        })
    };
    let mut numbers = names.iter().map(number).collect::<Result<Vec<u8>, _>>()?;
    numbers.sort_unstable();
    numbers.dedup();
    Ok(numbers)
}

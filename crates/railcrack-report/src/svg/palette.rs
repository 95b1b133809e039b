//! Colours distinguishable with any colour vision.

/// Text and frames.
pub(crate) const INK: &str = "#222222";
/// Secondary text.
pub(crate) const GREY: &str = "#666666";
/// Grid lines and quiet areas.
pub(crate) const LIGHT: &str = "#e4e4e4";
/// The line of zero among grid lines.
pub(crate) const ZERO: &str = "#b0b0b0";
/// Areas, and the rail.
pub(crate) const AREA: &str = "#fbe8c6";
pub(crate) const RAIL: &str = "#f6f5f2";
/// Blue of [`CATEGORIES`].
pub(crate) const BLUE: &str = "#0072b2";
/// Orange of [`CATEGORIES`].
pub(crate) const ORANGE: &str = "#e69f00";

/// Categorical colours: those of Okabe and Ito (2008) without yellow, which is too
/// light on white, with violet and brown.
pub(crate) const CATEGORIES: [&str; 9] =
    [BLUE, "#d55e00", "#009e73", "#cc79a7", ORANGE, "#56b4e9", "#000000", "#6f43cf", "#8a4b2f"];

/// Anchors of viridis (Smith and van der Walt 2015), dark to light; the lightest tenth is left out
/// on white.
const VIRIDIS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 40.0, 120.0],
    [62.0, 73.0, 137.0],
    [49.0, 104.0, 142.0],
    [38.0, 130.0, 142.0],
    [31.0, 158.0, 137.0],
    [53.0, 183.0, 121.0],
    [110.0, 206.0, 88.0],
    [181.0, 222.0, 43.0],
];

/// The colour at `place` (0 dark to 1 light) of an ordered scale, as `#rrggbb`.
pub(crate) fn sequence(place: f64) -> String {
    let along = place.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let from = (along as usize).min(VIRIDIS.len() - 2);
    let part = along - from as f64;
    let [r, g, b] = [0, 1, 2]
        .map(|c| (VIRIDIS[from][c] + (VIRIDIS[from + 1][c] - VIRIDIS[from][c]) * part).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

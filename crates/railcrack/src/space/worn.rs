//! Cracks in space cut by wear and grinding.

use super::free_front;
use super::shape::CHORD;
use crate::growth::{FrontShape, FrontTurns, least_length, spent_ligament};

/// Least length of a strip relative to the semi-axis of the half-ellipse below it; that of the
/// half-ellipse relative to the strip is the same.
pub const LEAST_STRIP: f64 = 0.05;

/// State of a crack after the surface above it has been removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Worn {
    /// The crack remains.
    Left,
    /// A buried crack that only a spent ligament separates from the surface.
    BrokenOut,
    /// The crack is worn away; only a stub remains, since the body still contains it.
    Away,
}

/// A crack of `shape` after `depth` (mm) of the surface has been removed. `longest` (mm) is its
/// greatest length so far, `resolution` (mm) the length that the engine resolves.
///
/// The new surface cuts the plane of the crack at the distance s = depth / sin(dip) down the dip.
/// The remaining part is less than half of the ellipse. It is replaced by the half-ellipse with the
/// same deepest point and the same chord: l' = l − s and c' = c √(1 − s²/l²), whose area is larger
/// by 1.1 % for s = 0.04 l and by 7.7 % for s = l/3. Many small cuts shorten the chord less than
/// one cut of the same depth, since each begins from a front that is normal to the surface. A free
/// front keeps its part below the surface.
///
/// A strip is shortened. Where less than [`LEAST_STRIP`] of it remains, the half-ellipse reaches
/// the surface and is cut from then on. A crack that turns loses the beginning of its way.
pub(super) fn worn(shape: &FrontShape, depth: f64, longest: f64, resolution: f64) -> (FrontShape, Worn) {
    if shape.strip.is_some() || shape.turns.is_some() {
        return worn_way(shape, depth, longest, resolution);
    }
    let s = depth / shape.dip.sin();
    let [x, lateral, _] = shape.frame().position(s, 0.0);
    // The trace of the plane in the new surface is the new origin.
    let lowered = FrontShape { middle: [shape.middle[0] + x, shape.middle[1] + lateral], ..*shape };
    let least = least_length(longest, resolution);
    let (left, fate) = match shape.buried {
        None => {
            let left = match &shape.deviation {
                Some(deviation) if s < shape.length => free_front::cut(&lowered, deviation, s),
                _ => {
                    let length = (shape.length - s).max(0.0);
                    let chord = (1.0 - (s / shape.length).min(1.0).powi(2)).sqrt();
                    FrontShape { length, half_length: shape.half_length * chord, ..lowered }
                }
            };
            (left, Worn::Left)
        }
        Some(centre) => {
            let ligament = spent_ligament(shape.length, resolution);
            let (upper, lower) = (centre - s - shape.length, centre - s + shape.length);
            if upper >= ligament {
                (FrontShape { buried: Some(centre - s), ..lowered }, Worn::Left)
            } else {
                let length = (0.5 * (lower - ligament)).max(0.0);
                (FrontShape { length, buried: Some(ligament + length), ..lowered }, Worn::BrokenOut)
            }
        }
    };
    if left.length > least {
        return (left, fate);
    }
    let aspect = shape.half_length / shape.length;
    let buried = left.buried.map(|_| 2.0 * least);
    (FrontShape { length: least, half_length: aspect * least, buried, ..lowered }, Worn::Away)
}

/// The same of a crack that turns, or has a strip.
fn worn_way(shape: &FrontShape, depth: f64, longest: f64, resolution: f64) -> (FrontShape, Worn) {
    let way = shape.way();
    let cut = way.to_depth(depth).min(shape.path_length());
    let [out, _] = way.at(cut).place;
    let (aside, ahead) = shape.strike.sin_cos();
    let [x, lateral] = shape.middle;
    let lowered = FrontShape { middle: [x + out * ahead, lateral + out * aside], ..*shape };
    let left_of = |strip: f64| Some(strip - cut).filter(|left| *left >= LEAST_STRIP * shape.length);
    if let Some(strip) = shape.strip.and_then(left_of) {
        let (dip, turns) = turned_from(shape, cut, strip);
        return (FrontShape { dip, turns, strip: Some(strip), ..lowered }, Worn::Left);
    }
    // What is left of the strip is added to the half-ellipse.
    let above = shape.strip.map_or(0.0, |strip| (strip - cut).max(0.0));
    let into = shape.strip.map_or(cut, |strip| (cut - strip).max(0.0));
    let (dip, turns) = turned_from(shape, cut, CHORD * (shape.length + above - into));
    // A plane that is left keeps its deepest point; its cut moves the middle to the new mouth.
    let [end, bottom] = way.at(shape.path_length()).place;
    let (length, mouth) = match turns {
        Some(_) => (shape.length + above, out - into * dip.cos()),
        None => {
            let left = (bottom - depth).max(0.0) / dip.sin();
            (left + into, end - (left + into) * dip.cos())
        }
    };
    let middle = [x + mouth * ahead, lateral + mouth * aside];
    let planar = FrontShape { dip, turns: None, strip: None, length, middle, ..*shape };
    let (left, fate) = worn(&planar, into * dip.sin(), longest, resolution);
    (FrontShape { turns: turns.filter(|_| fate != Worn::Away), ..left }, fate)
}

/// The dip at the mouth and the turns of `shape` without its first `cut` (mm), straight for at
/// least `least` (mm).
fn turned_from(shape: &FrontShape, cut: f64, least: f64) -> (f64, Option<FrontTurns>) {
    shape.turns.map_or((shape.dip, None), |turns| turns.cut(shape.dip, cut, least))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_6;

    const CRACK: FrontShape = FrontShape {
        dip: FRAC_PI_6,
        strike: 0.0,
        length: 6.0,
        half_length: 9.0,
        middle: [1.0, 2.0],
        buried: None,
        strip: None,
        turns: None,
        deviation: None,
    };

    #[test]
    fn the_deepest_point_stays_in_the_steel_and_the_chord_is_that_of_the_ellipse() {
        let (left, fate) = worn(&CRACK, 1.0, 6.0, 0.1);
        assert_eq!(fate, Worn::Left);
        // s = 2 mm down the dip.
        assert!((left.length - 4.0).abs() < 1e-12, "{left:?}");
        let on_ellipse = (left.half_length / 9.0f64).powi(2) + (2.0f64 / 6.0).powi(2);
        assert!((on_ellipse - 1.0).abs() < 1e-12, "{left:?}");
        let deepest = |shape: &FrontShape| {
            let [x, _, depth] = shape.frame().position(shape.length, 0.0);
            [shape.middle[0] + x, depth]
        };
        let (before, after) = (deepest(&CRACK), deepest(&left));
        assert!((before[0] - after[0]).abs() < 1e-12 && (before[1] - after[1] - 1.0).abs() < 1e-12);
        // In two cuts the length is the same; the chord shrinks less, since a half-ellipse replaces
        // the crack after the first cut.
        let half = worn(&CRACK, 0.5, 6.0, 0.1).0;
        let twice = worn(&half, 0.5, 6.0, 0.1).0;
        assert!((twice.length - left.length).abs() < 1e-12 && twice.half_length > left.half_length);
    }

    #[test]
    fn a_crack_under_the_new_surface_only_in_its_last_twentieth_is_worn_away() {
        assert_eq!(worn(&CRACK, 2.84, 6.0, 0.1).1, Worn::Left);
        let (stub, fate) = worn(&CRACK, 2.86, 6.0, 0.1);
        assert_eq!(fate, Worn::Away);
        assert!((stub.length - 0.3).abs() < 1e-12, "{stub:?}");
    }

    #[test]
    fn the_surface_comes_down_to_a_buried_crack() {
        let buried = FrontShape { length: 2.0, buried: Some(5.0), ..CRACK };
        let (left, fate) = worn(&buried, 1.0, 2.0, 0.05);
        assert_eq!((fate, left.buried), (Worn::Left, Some(3.0)), "{left:?}");
        let (left, fate) = worn(&buried, 1.6, 2.0, 0.05);
        // The lower end keeps its place in the steel.
        let lower = left.buried.unwrap() + left.length;
        assert!(fate == Worn::BrokenOut && (lower - (7.0 - 3.2)).abs() < 1e-12, "{left:?}");
    }

    #[test]
    fn the_strip_of_a_folded_crack_is_worn_first() {
        let turns = Some(FrontTurns::fold(4.0, 1.2 - FRAC_PI_6));
        let crack = FrontShape { strip: Some(4.0), turns, ..CRACK };
        let place = |shape: &FrontShape, removed: f64| {
            let deepest = shape.deepest();
            [deepest.x, deepest.y - removed]
        };
        let want = place(&crack, 0.0);
        let stays = |shape: &FrontShape, removed: f64| {
            let found = place(shape, removed);
            (found[0] - want[0]).hypot(found[1] - want[1]) < 1e-12
        };
        // 2 mm along the strip.
        let (left, fate) = worn(&crack, 1.0, 10.0, 0.1);
        assert_eq!((fate, left.length, left.half_length), (Worn::Left, 6.0, 9.0));
        assert!((left.strip.unwrap() - 2.0).abs() < 1e-12 && stays(&left, 1.0), "{left:?}");
        // Down to 0.02 mm above the fold: that little is left to the branch.
        let (left, _) = worn(&crack, 1.98, 10.0, 0.1);
        assert!(left.strip.is_none() && left.turns.is_none() && stays(&left, 1.98), "{left:?}");
        assert!((left.length - 6.0 - 0.02 / 1.2f64.sin()).abs() < 1e-12 && left.half_length == 9.0);
        // Below the fold the branch is cut as a planar crack.
        let (left, _) = worn(&crack, 2.5, 10.0, 0.1);
        let middle = [1.0 + 4.0 * FRAC_PI_6.cos(), 2.0];
        let planar = FrontShape { dip: 1.2, strip: None, turns: None, middle, ..crack };
        let (want, _) = worn(&planar, 0.5, 10.0, 0.1);
        assert!((left.length - want.length).abs() < 1e-12 && stays(&left, 2.5), "{left:?}");
        assert!((left.half_length - want.half_length).abs() < 1e-12, "{left:?}");
    }
}

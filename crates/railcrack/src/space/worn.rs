//! Cracks in space cut by wear and grinding.

use crate::growth::{FrontShape, least_length, spent_ligament};

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
/// one cut of the same depth, since each begins from a front that is normal to the surface.
pub(super) fn worn(shape: &FrontShape, depth: f64, longest: f64, resolution: f64) -> (FrontShape, Worn) {
    let s = depth / shape.dip.sin();
    let [x, lateral, _] = shape.frame().position(s, 0.0);
    // The trace of the plane in the new surface is the new origin.
    let lowered = FrontShape { middle: [shape.middle[0] + x, shape.middle[1] + lateral], ..*shape };
    let least = least_length(longest, resolution);
    let (left, fate) = match shape.buried {
        None => {
            let length = (shape.length - s).max(0.0);
            let chord = (1.0 - (s / shape.length).min(1.0).powi(2)).sqrt();
            (FrontShape { length, half_length: shape.half_length * chord, ..lowered }, Worn::Left)
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
}

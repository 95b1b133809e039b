//! Symmetric cracks have symmetric stress intensity factors, with the signs of the tip frames.

use crate::common::{Of, buried_crack, close, default_elements, open_sifs, surface_crack};
use railcrack::math::{Stress, Vec2};

const ROUND_OFF: f64 = 1e-10;

/// Two tips of a shallow horizontal crack: the mirror reverses x2 of a tip frame, so that K_II
/// changes sign.
#[test]
fn both_tips_of_a_shallow_crack() {
    let crack = buried_crack(Vec2::new(1.0, -2.0), 3.0, 0.0);
    let k = open_sifs(&[crack], default_elements(), |_| Stress { yy: 1.0, ..Stress::ZERO });
    close(k[0], k[2], Of(ROUND_OFF, k[0]), "mirrored tips");
    close(k[1], -k[3], Of(ROUND_OFF, k[0]), "mirrored tips: K_II changes sign");
    assert!(k[0] > 0.0 && k[1].abs() > 0.1 * k[0], "the surface is near: {k:?}");
}

/// Two cracks that lean towards each other.
#[test]
fn mirrored_pair() {
    let pair = [surface_crack(-5.0, 4.0, 40.0), surface_crack(5.0, 4.0, 140.0)];
    let k = open_sifs(&pair, default_elements(), |_| Stress { xx: 1.0, ..Stress::ZERO });
    close(k[0], k[2], Of(ROUND_OFF, k[0]), "mirrored cracks");
    close(k[1], -k[3], Of(ROUND_OFF, k[0]), "mirrored cracks: K_II changes sign");
    assert!(k[1] > 0.0, "the crack that leans to the right has K_II > 0 in tension: {k:?}");
}

/// Neither the order in which cracks are given nor their place along the rail has an effect.
#[test]
fn order_and_place() {
    let (one, other) = (surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 4.0, 120.0));
    let stress = |_| Stress { xx: 1.0, ..Stress::ZERO };
    let k = open_sifs(&[one.clone(), other.clone()], default_elements(), stress);
    let moved = open_sifs(&[other.moved(64.0), one.moved(64.0)], default_elements(), stress);
    for (a, b) in [(0, 2), (1, 3), (2, 0), (3, 1)] {
        close(moved[b], k[a], Of(1e-10, k[0]), "round-off of coordinates 64 mm away");
    }
}

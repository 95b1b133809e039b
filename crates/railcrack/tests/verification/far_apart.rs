//! Two cracks a thousand lengths apart do not interact, and at twenty lengths hardly.

use crate::common::{Of, TENSION, close, default_elements, open_sifs, surface_crack};

#[test]
fn equal_the_single_crack() {
    for degrees in [15.0, 45.0, 90.0, 165.0] {
        let crack = surface_crack(0.0, 6.0, degrees);
        let single = open_sifs(std::slice::from_ref(&crack), default_elements(), |_| TENSION);
        let pair = open_sifs(&[crack.clone(), crack.moved(6000.0)], default_elements(), |_| TENSION);
        for k in pair.chunks_exact(2) {
            let reason = "the interaction decays with the square of the distance; 2.5e-6 at 90°";
            close(k[0], single[0], Of(1e-5, single[0]), reason);
            close(k[1], single[1], Of(1e-5, single[0]), reason);
        }
    }
}

/// Effect on K of a crack 20 lengths away, relative to K_I.
#[test]
fn twenty_lengths_away() {
    for degrees in [15.0, 45.0, 90.0, 165.0] {
        let crack = surface_crack(0.0, 6.0, degrees);
        let single = open_sifs(std::slice::from_ref(&crack), default_elements(), |_| TENSION);
        let pair = open_sifs(&[crack.clone(), crack.moved(120.0)], default_elements(), |_| TENSION);
        for k in pair.chunks_exact(2) {
            let off = (k[0] - single[0]).abs().max((k[1] - single[1]).abs());
            close(off, 0.0, Of(1e-2, single[0]), "a dipole at twenty lengths; 0.6 % at 90°");
            assert!(off > 0.0, "{degrees}°: the other crack has no effect at all");
        }
    }
}

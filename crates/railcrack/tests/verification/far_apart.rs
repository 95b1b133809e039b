//! Two cracks a thousand lengths apart do not know of each other.

use crate::common::{Of, TENSION, close, default_elements, open_sifs, surface_crack};

#[test]
fn equal_the_single_crack() {
    for degrees in [15.0, 45.0, 90.0, 165.0] {
        let crack = surface_crack(0.0, 6.0, degrees);
        let single = open_sifs(std::slice::from_ref(&crack), default_elements(), |_| TENSION);
        let pair = open_sifs(&[crack.clone(), crack.moved(6000.0)], default_elements(), |_| TENSION);
        for (tip, k) in pair.chunks_exact(2).enumerate() {
            println!(
                "{degrees} {tip}: {:.1e} {:.1e}",
                k[0] / single[0] - 1.0,
                (k[1] - single[1]) / single[0]
            );
            let reason = "interaction falls with the square of the distance";
            close(k[0], single[0], Of(1e-5, single[0]), reason);
            close(k[1], single[1], Of(1e-5, single[0]), reason);
        }
    }
}

//! Kinked cracks: short kinks against the kink functions, long ones against finer meshes.

use crate::common::{
    Absolute, TENSION, buried_crack, close, default_elements, largest, open_sifs, order, surface_crack,
};
use railcrack::crack::End;
use railcrack::fatigue::KinkFunctions;
use railcrack::fracture::Sif;
use railcrack::math::{Stress, Vec2};

const HALF: f64 = 3.0;

/// K at the tip of a kink of length `kink` (over the half-length) at `degrees`, over that of the
/// straight crack.
fn short_kink(stress: Stress, degrees: f64, kink: f64, elements: usize) -> Sif {
    let straight = buried_crack(Vec2::new(0.0, -3000.0), HALF, 0.0);
    let kinked = straight.extended(End::Last, kink * HALF, degrees.to_radians()).unwrap();
    let k = open_sifs(&[kinked], elements, |_| stress);
    let scale = (std::f64::consts::PI * HALF).sqrt();
    Sif { ki: k[2] / scale, kii: k[3] / scale }
}

/// The limit of an infinitesimal kink. Without stress along the crack the first correction is
/// linear in its length.
fn infinitesimal(stress: Stress, degrees: f64, elements: usize) -> Sif {
    let (short, long) =
        (short_kink(stress, degrees, 2e-3, elements), short_kink(stress, degrees, 4e-3, elements));
    short * 2.0 + long * -1.0
}

const SHEAR: Stress = Stress { xy: 1.0, ..Stress::ZERO };
/// Equal stress along and across the crack: the T-stress vanishes.
const PRESSURE: Stress = Stress { xx: 1.0, yy: 1.0, ..Stress::ZERO };

/// Error of K at a kink of a thousandth of the crack, measured 4e-4 at −100°.
const SHORT_KINK: f64 = 6e-4;

#[test]
fn kink_functions_from_a_real_kink() {
    for degrees in [-100.0, -76.6, -60.0, -30.0, -10.0, 20.0, 45.0, 70.0, 90.0_f64] {
        let functions = KinkFunctions::at(degrees.to_radians());
        for (stress, sif) in [(PRESSURE, Sif { ki: 1.0, kii: 0.0 }), (SHEAR, Sif { ki: 0.0, kii: 1.0 })] {
            let want = functions.kinked(sif);
            let got = infinitesimal(stress, degrees, default_elements());
            close(got.ki, want.k1, Absolute(SHORT_KINK), "default elements");
            close(got.kii, want.k2, Absolute(SHORT_KINK), "default elements");
        }
    }
}

/// For K_II > 0 the largest k1 is 1.2316 K_II, at −76.6°.
#[test]
fn largest_opening_of_a_kink_in_shear() {
    let k1 = |degrees| infinitesimal(SHEAR, degrees, default_elements()).ki;
    close(k1(-76.6), 1.2316, Absolute(SHORT_KINK), "default elements");
    // The vertex of the parabola through three angles; the curvature there is 1e-4 per square
    // degree.
    let (left, middle, right) = (k1(-86.6), k1(-76.6), k1(-66.6));
    let top = -76.6 + 5.0 * (left - right) / (left - 2.0 * middle + right);
    close(
        top,
        -76.6,
        Absolute(1.0),
        "the third derivative shifts the vertex of the parabola by half a degree",
    );
    assert!(k1(76.6) < -1.0, "a kink to the other side closes: {}", k1(76.6));
}

/// Kinks of a third of the crack, one of which rises to a tip 0.5 mm below the surface: second
/// order.
#[test]
fn finer_meshes() {
    for (degrees, allowed) in [(30.0_f64, 2e-3), (-30.0, 2e-4), (-60.0, 1e-4)] {
        let kinked = surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, degrees.to_radians()).unwrap();
        let at = |elements| open_sifs(std::slice::from_ref(&kinked), elements, |_| TENSION);
        let fine = at(320);
        let scale = largest(fine.iter().copied());
        let error = |elements| largest(at(elements).iter().zip(&fine).map(|(k, fine)| k - fine)) / scale;
        close(error(default_elements()), 0.0, Absolute(allowed), "the ligament above a rising kink is thin");
        let errors = [20, 40, 80].map(error);
        assert!(
            errors.windows(2).all(|pair| order(pair[0], pair[1]) > 1.8),
            "orders of convergence: {errors:?}"
        );
    }
}

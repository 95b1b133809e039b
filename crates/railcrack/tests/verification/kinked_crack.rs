//! Kinked cracks: short kinks against the kink functions, long ones against finer meshes.

use crate::common::{Of, TENSION, buried_crack, close, default_elements, largest, open_sifs, surface_crack};
use railcrack::crack::End;
use railcrack::fatigue::KinkFunctions;
use railcrack::fracture::Sif;
use railcrack::math::{Stress, Vec2};

const HALF: f64 = 3.0;

/// K at the tip of a kink of length `kink` (over the half-length) at `degrees`, over that of the straight crack.
fn short_kink(stress: Stress, degrees: f64, kink: f64, elements: usize) -> Sif {
    let straight = buried_crack(Vec2::new(0.0, -3000.0), HALF, 0.0);
    let kinked = straight.extended(End::Last, kink * HALF, degrees.to_radians()).unwrap();
    let k = open_sifs(&[kinked], elements, |_| stress);
    let scale = (std::f64::consts::PI * HALF).sqrt();
    Sif { k1: k[2] / scale, k2: k[3] / scale }
}

/// The limit of an infinitesimal kink. Without stress along the crack the first correction is linear in its length.
fn infinitesimal(stress: Stress, degrees: f64, elements: usize) -> Sif {
    let (short, long) =
        (short_kink(stress, degrees, 2e-3, elements), short_kink(stress, degrees, 4e-3, elements));
    short * 2.0 + long * -1.0
}

const SHEAR: Stress = Stress { xy: 1.0, ..Stress::ZERO };
/// Equal stress along and across the crack: the T-stress vanishes.
const PRESSURE: Stress = Stress { xx: 1.0, yy: 1.0, ..Stress::ZERO };

#[test]
fn kink_functions_from_a_real_kink() {
    for degrees in [-100.0, -76.6, -60.0, -30.0, -10.0, 20.0, 45.0, 70.0, 90.0_f64] {
        let functions = KinkFunctions::at(degrees.to_radians());
        for (stress, sif) in [(PRESSURE, Sif { k1: 1.0, k2: 0.0 }), (SHEAR, Sif { k1: 0.0, k2: 1.0 })] {
            let want = functions.kinked(sif);
            let got = infinitesimal(stress, degrees, default_elements());
            println!("{degrees} {sif:?}: {:.1e} {:.1e}", got.k1 - want.k1, got.k2 - want.k2);
        }
    }
}

#[test]
fn mesh() {
    for degrees in [60.0, 30.0, -30.0, -60.0, 90.0_f64] {
        let kinked = surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, degrees.to_radians());
        let Ok(kinked) = kinked else { continue };
        let at = |elements| open_sifs(std::slice::from_ref(&kinked), elements, |_| TENSION);
        let fine = at(320);
        for n in [10, 20, 40, 80, 160] {
            let k = at(n);
            println!(
                "{degrees} {n}: {:.2e} {:.2e}",
                (k[0] - fine[0]) / largest(fine.clone()),
                (k[1] - fine[1]) / largest(fine.clone())
            );
        }
    }
    let _ = (Of(0.0, 0.0), close);
}

//! The contact pressure along the faces does not oscillate, at the defaults.

use super::super::contact_pressure::roughness;
use crate::common::{Meshed, Of, Rolling, RollingEngine, close, surface_crack};
use railcrack::crack::{Crack, End};

/// Largest amplitude of neighbouring deviations of opposite sign, relative to the peak pressure.
const OSCILLATION: f64 = 5e-3;
/// The same at small kinks, where sliding faces press on a blunt corner.
const OSCILLATION_AT_SMALL_KINKS: f64 = 2.2e-2;

fn oscillation(crack: Crack, friction: f64, wheel: f64) -> f64 {
    let mut rolling = Rolling::over(vec![crack], friction, wheel);
    rolling.engine = RollingEngine::Xfem(Meshed::still());
    let (bend, oscillation) = roughness(&rolling.solve().faces);
    println!("{:?}, friction {friction}: {oscillation:.1e}, bend {bend:.1e}", rolling.cracks[0].points());
    oscillation
}

fn kinked(turn: f64) -> Crack {
    surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, turn).unwrap()
}

#[test]
fn no_oscillation_under_the_wheel() {
    let cases = [
        (surface_crack(0.0, 6.0, 15.0), 0.5, 0.025),
        (surface_crack(0.0, 6.0, 15.0), 0.1, 0.4),
        (surface_crack(0.0, 6.0, 45.0), 0.8, -0.4),
        (surface_crack(0.0, 6.0, 165.0), 0.5, 0.1),
        (kinked(-1.0), 0.5, 0.1),
    ];
    for (crack, friction, wheel) in cases {
        close(
            oscillation(crack, friction, wheel),
            0.0,
            Of(OSCILLATION, 1.0),
            "turning points of a steep slope",
        );
    }
}

#[test]
fn small_kinks() {
    for turn in [0.1, -0.3] {
        close(oscillation(kinked(turn), 0.5, 0.1), 0.0, Of(OSCILLATION_AT_SMALL_KINKS, 1.0), "a small kink");
    }
}

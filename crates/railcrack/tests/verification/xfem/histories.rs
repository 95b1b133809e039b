//! SIF histories under the passing wheel against independent collocation codes, with the default
//! settings of users.

use crate::common::{
    Meshed, Rolling, RollingEngine, histories, largest, measured, measured_as, misfit, surface_crack,
};
use railcrack::contact::FaceStatus;
use railcrack::crack::{Crack, End};
use railcrack::field::DepthProfile;
use railcrack::fracture::Sif;
use railcrack::growth::StabilisedPassage;

/// Accuracy of the finite-element engine as promised to users, relative to the largest |K| of the
/// case.
const PROMISED: f64 = 0.01;
/// The same for kinks and networks.
const PROMISED_OF_KINKS: f64 = 0.02;
/// K_I of a closed tip over the peak of |K_II|.
const CLOSED: f64 = 5e-3;
/// Interpenetration over the largest opening.
const OVERLAP: f64 = 1e-4;

/// The largest K_I at positions where the face point next to the tip is closed, relative to the
/// peak of |K_II|.
fn opening_mode_of_closed_tips(result: &StabilisedPassage) -> f64 {
    let passage = &result.passages[result.passages.len() - 1];
    let peak = largest(passage.sifs.iter().flatten().map(|k| k.kii));
    let next_to = |crack: usize| result.faces.points.iter().rposition(|p| p.crack == crack).unwrap();
    let closed = |crack: usize, sifs: &[Sif]| {
        let tip = next_to(crack);
        largest(
            (sifs.iter().zip(&result.faces.states))
                .filter(|(_, states)| states[tip].status != FaceStatus::Open)
                .map(|(k, _)| k.ki),
        )
    };
    largest(passage.sifs.iter().enumerate().map(|(crack, sifs)| closed(crack, sifs))) / peak
}

fn overlap(result: &StabilisedPassage) -> f64 {
    let openings = || result.faces.states.iter().flatten().map(|state| state.opening);
    let (low, high) = openings().fold((0.0f64, 0.0f64), |(low, high), w| (low.min(w), high.max(w)));
    if high > 0.0 { low.abs() / high } else { 0.0 }
}

#[track_caller]
fn agrees(file: &str, rolling: &Rolling, allowed: f64) {
    let result = rolling.solve();
    let (error, place) = misfit(&result, &histories(file));
    let (closed, overlap) = (opening_mode_of_closed_tips(&result), overlap(&result));
    println!(
        "{file}: {:.3} % of the peak, {place}; K_I closed {closed:.1e}, overlap {overlap:.1e}",
        100.0 * error
    );
    measured(error, allowed, "promised to users, of the peak");
    measured_as("closed tip", closed, CLOSED, "noise there would show an unstable pair of spaces");
    measured_as("overlap", overlap, OVERLAP, "exact at the face points");
    assert!(error < allowed, "{file}: {:.3} % of the peak, {place}", 100.0 * error);
    assert!(closed < CLOSED, "{file}: K_I of a closed tip {closed:.1e} of the peak of K_II");
    assert!(overlap < OVERLAP, "{file}: faces overlap by {overlap:.1e} of the largest opening");
}

/// Settings of a run that computes the initial cracks only: a mesh without room for growth.
fn rolling(cracks: Vec<Crack>, crack_friction: f64, wheel_friction: f64) -> Rolling<'static> {
    let engine = RollingEngine::Xfem(Meshed::still());
    Rolling { engine, ..Rolling::over(cracks, crack_friction, wheel_friction) }
}

fn straight(degrees: f64, crack_friction: f64, wheel_friction: f64) -> Rolling<'static> {
    rolling(vec![surface_crack(0.0, 6.0, degrees)], crack_friction, wheel_friction)
}

#[test]
fn reference_cases() {
    let crack = || vec![surface_crack(0.0, 6.0, 15.0)];
    // With room for 25 increments of 4 %.
    agrees("table1", &Rolling::meshed(crack(), 0.5, 0.025), PROMISED);
    agrees("table1", &rolling(crack(), 0.5, 0.025), PROMISED);
    agrees("fig13", &rolling(crack(), 0.1, 0.4), PROMISED);
}

#[test]
fn angles() {
    agrees("th30_c0.5_w0.025", &straight(30.0, 0.5, 0.025), PROMISED);
    agrees("th60_c0.5_w0.025", &straight(60.0, 0.5, 0.025), PROMISED);
    agrees("th75_c0.5_w0.025", &straight(75.0, 0.5, 0.025), PROMISED);
    agrees("th90_c0.5_w0.025", &straight(90.0, 0.5, 0.025), PROMISED);
    agrees("th165_c0.5_w0.025", &straight(165.0, 0.5, 0.025), PROMISED);
}

#[test]
fn crack_face_friction() {
    agrees("th15_c0_w0.025", &straight(15.0, 0.0, 0.025), PROMISED);
    agrees("th15_c0.2_w0.025", &straight(15.0, 0.2, 0.025), PROMISED);
    agrees("th15_c0.8_w0.025", &straight(15.0, 0.8, 0.025), PROMISED);
    agrees("th45_c0.3_w0.3", &straight(45.0, 0.3, 0.3), PROMISED);
}

#[test]
fn wheel_rail_friction() {
    agrees("th15_c0.5_w-0.4", &straight(15.0, 0.5, -0.4), PROMISED);
    agrees("th15_c0.5_w0.4", &straight(15.0, 0.5, 0.4), PROMISED);
    agrees("th45_c0.8_w-0.4", &straight(45.0, 0.8, -0.4), PROMISED);
    agrees("th165_c0.1_w0.4", &straight(165.0, 0.1, 0.4), PROMISED);
}

fn kinked(degrees: f64, kink: f64, beta: f64) -> Crack {
    surface_crack(0.0, 4.0, degrees).extended(End::Last, kink, beta.to_radians()).unwrap()
}

#[test]
fn kinks_of_a_third_of_the_crack() {
    for (file, beta) in [("kink15_4_2_b+30", 30.0), ("kink15_4_2_b-30", -30.0), ("kink15_4_2_b-60", -60.0)] {
        agrees(file, &rolling(vec![kinked(15.0, 2.0, beta)], 0.5, 0.1), PROMISED_OF_KINKS);
    }
}

#[test]
fn short_kinks() {
    for (file, beta) in [("kink30_4_0.3_b+60", 60.0), ("kink30_4_0.3_b-60", -60.0)] {
        agrees(file, &rolling(vec![kinked(30.0, 0.3, beta)], 0.5, 0.1), PROMISED_OF_KINKS);
    }
}

#[test]
fn residual_profile() {
    let by_depth = [
        (0.0, 25.0),
        (0.3, 25.0),
        (0.8, -110.0),
        (2.0, -110.0),
        (3.0, 50.0),
        (4.5, 50.0),
        (6.0, -50.0),
        (14.0, -50.0),
        (20.0, 0.0),
    ];
    let profile = DepthProfile::new(by_depth.map(|(depth, xx)| (depth, xx, 0.0)).to_vec()).unwrap();
    let mut straight = straight(15.0, 0.5, 0.025);
    straight.residual = Some(&profile);
    agrees("table1_res", &straight, PROMISED);
}

#[test]
fn pair() {
    let cracks = || vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)];
    agrees("pair_c0.01", &rolling(cracks(), 0.01, 0.025), PROMISED_OF_KINKS);
    agrees("pair_c0.5", &rolling(cracks(), 0.5, 0.025), PROMISED_OF_KINKS);
}

//! SIF histories under the passing wheel against independent collocation codes, with the default
//! settings of users.

use crate::common::{Rolling, histories, measured, misfit, surface_crack};
use railcrack::crack::End;
use railcrack::field::DepthProfile;

/// Accuracy of the dislocation engine as promised to users, relative to the largest |K| of the
/// case.
const PROMISED: f64 = 0.005;
/// The same for networks.
const PROMISED_IN_NETWORKS: f64 = 0.02;

#[track_caller]
fn agrees(file: &str, rolling: &Rolling, allowed: f64) {
    let (error, place) = misfit(&rolling.solve(), &histories(file));
    println!("{file}: {:.3} % of the peak, {place}", 100.0 * error);
    measured(error, allowed, "promised to users, of the peak");
    assert!(error < allowed, "{file}: {:.3} % of the peak, {place}", 100.0 * error);
}

fn straight(degrees: f64, crack_friction: f64, wheel_friction: f64) -> Rolling<'static> {
    Rolling::over(vec![surface_crack(0.0, 6.0, degrees)], crack_friction, wheel_friction)
}

#[test]
fn reference_cases() {
    agrees("table1", &straight(15.0, 0.5, 0.025), PROMISED);
    agrees("fig13", &straight(15.0, 0.1, 0.4), PROMISED);
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

fn kinked(degrees: f64, kink: f64, beta: f64) -> Rolling<'static> {
    let crack = surface_crack(0.0, 4.0, degrees).extended(End::Last, kink, beta.to_radians()).unwrap();
    Rolling::over(vec![crack], 0.5, 0.1)
}

#[test]
fn kinks_of_a_third_of_the_crack() {
    agrees("kink15_4_2_b+30", &kinked(15.0, 2.0, 30.0), PROMISED);
    agrees("kink15_4_2_b-30", &kinked(15.0, 2.0, -30.0), PROMISED);
    agrees("kink15_4_2_b-60", &kinked(15.0, 2.0, -60.0), PROMISED);
}

#[test]
fn short_kinks() {
    agrees("kink30_4_0.3_b+60", &kinked(30.0, 0.3, 60.0), PROMISED);
    agrees("kink30_4_0.3_b-60", &kinked(30.0, 0.3, -60.0), PROMISED);
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
    let mut rolling = straight(15.0, 0.5, 0.025);
    rolling.residual = Some(&profile);
    agrees("table1_res", &rolling, PROMISED);
}

#[test]
fn pair() {
    let cracks = || vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)];
    agrees("pair_c0.01", &Rolling::over(cracks(), 0.01, 0.025), PROMISED_IN_NETWORKS);
    agrees("pair_c0.5", &Rolling::over(cracks(), 0.5, 0.025), PROMISED_IN_NETWORKS);
}

#[test]
fn network_of_nine() {
    let cracks = (0..9).map(|i| surface_crack(3.375 * f64::from(i), 6.0, 15.0)).collect();
    agrees("network_nine", &Rolling::over(cracks, 0.5, 0.1), PROMISED_IN_NETWORKS);
}

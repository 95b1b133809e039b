//! States on both sides of first yield and of the limits of elastic shakedown, and the residual
//! stress at the limit.

use super::{YIELD, peak, rail, stabilised};
use railcrack::shakedown::{RailState, StabilisedRail, shakedown_limit_ratio};

/// k, MPa.
fn k() -> f64 {
    YIELD / 3f64.sqrt()
}

fn at_ratio(ratio: f64, friction: f64) -> StabilisedRail {
    stabilised(&rail(ratio * k(), friction, 20e3))
}

/// The published limits have four digits: the states half a per cent on either side are
/// distinguished.
const SIDE: f64 = 0.005;

/// p0/k at first yield, ν = 0.3 (von Mises): Johnson, Contact Mechanics, 4.4 and 7.1, by Tresca.
#[test]
fn first_yield() {
    for (friction, ratio) in [(0.0, 3.107), (0.1, 3.063), (0.3, 2.598)] {
        let below = at_ratio(ratio * (1.0 - SIDE), friction);
        assert_eq!((below.state, peak(&below)), (RailState::Elastic, 0.0), "{friction}");
        let above = at_ratio(ratio * (1.0 + SIDE), friction);
        assert_eq!(above.state, RailState::ElasticShakedown, "{friction}");
        assert!(peak(&above) > 0.0, "{friction}");
    }
}

/// p0/k at the limit of elastic shakedown (Ponter, Hearle & Johnson 1985), and the depth of
/// alternating plasticity beyond it.
#[test]
fn shakedown_limits() {
    for (friction, ratio, depth) in [(0.0, 4.000, 0.50), (0.1, 3.987, 0.50), (0.3, 3.150, 0.0)] {
        let below = at_ratio(ratio * (1.0 - SIDE), friction);
        assert_eq!((below.state, below.alternating), (RailState::ElasticShakedown, None), "{friction}");
        let above = at_ratio(ratio * (1.0 + SIDE), friction);
        assert_eq!(above.state, RailState::PlasticShakedown, "{friction}");
        let zone = above.alternating.unwrap();
        let a = 6.75;
        // The zone has just begun: it contains the critical depth, to within a layer (a/32).
        assert!(
            zone.from <= (depth + 0.04) * a && zone.to >= (depth - 0.04) * a && zone.to - zone.from < 0.3 * a,
            "{friction}: {zone:?}"
        );
    }
}

/// The accumulated plastic strain per passage in plastic shakedown grows with the load, and
/// vanishes below the limit.
#[test]
fn plastic_strain_per_passage() {
    let per_pass = |ratio: f64| {
        let result = at_ratio(ratio, 0.1);
        result.profile.iter().map(|layer| layer.plastic_per_pass).fold(0.0, f64::max)
    };
    let (below, just_above, above) = (per_pass(3.8), per_pass(4.2), per_pass(4.5));
    // The remaining plastic strain in the last passage before elastic shakedown.
    assert!(below < 2e-6 && just_above > 1e-4 && above > 2.0 * just_above, "{below} {just_above} {above}");
}

/// At the frictionless limit only one residual stress prevents the rail from yielding in every
/// passage: σ_xx = −0.134 p0, σ_zz = −0.213 p0 at 0.5 a for vanishing hardening (−s of the residual
/// stress is then the centre of the smallest ball around the deviatoric path).
///
/// The test is just above the limit: below it, by a fraction g, the centre may move by √(2 g) of
/// the radius before the path leaves the ball, and 7 % of the radius is half of σ_xx for g = 0.25
/// %.
#[test]
fn residual_stress_at_the_limit() {
    let pressure = 1.004 * shakedown_limit_ratio(0.0, 0.3).ratio * k();
    let result = stabilised(&rail(pressure, 0.0, 200.0));
    assert_eq!(result.state, RailState::PlasticShakedown);
    let stress = result.residual_stress(0.5 * 6.75);
    // Three digits of the reference, and the excess over the limit.
    assert!((stress.xx / pressure + 0.134).abs() < 0.004, "{}", stress.xx / pressure);
    assert!((stress.zz / pressure + 0.213).abs() < 0.004, "{}", stress.zz / pressure);
}

/// The residual stress of a rolled half-plane: σ_xx = −E′ (ε_xx + ν ε_zz), σ_zz = −E′ (ε_zz + ν
/// ε_xx), nothing else; and incompressible plastic strain.
#[test]
fn residual_stress_follows_from_the_plastic_strain() {
    let result = at_ratio(4.3, 0.2);
    let modulus = 210e3 / (1.0 - 0.09);
    for layer in &result.profile {
        let (e, s) = (layer.strain, layer.stress);
        assert!((s.xx + modulus * (e.xx + 0.3 * e.zz)).abs() < 1e-9); // round-off
        assert!((s.zz + modulus * (e.zz + 0.3 * e.xx)).abs() < 1e-9);
        assert_eq!((s.yy, s.xy), (0.0, 0.0));
        assert!((e.xx + e.yy + e.zz).abs() < 1e-15);
    }
}

/// A distinct end: too few passages give the state `NotStabilised`.
#[test]
fn too_few_passages() {
    let settings = railcrack::shakedown::Stabilisation { max_passes: 3, ..Default::default() };
    let mut told = Vec::new();
    let result =
        railcrack::shakedown::stabilise(&rail(1100.0, 0.1, 20e3), &settings, |pass| told.push(*pass))
            .unwrap();
    assert_eq!((result.state, result.passes.len()), (RailState::NotStabilised, 3));
    assert_eq!(told, result.passes);
}

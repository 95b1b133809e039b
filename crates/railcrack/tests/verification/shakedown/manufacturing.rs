//! A rail with an initial residual stress.

use super::{YIELD, rail, stabilised};
use railcrack::field::DepthProfile;
use railcrack::shakedown::{RailState, RolledRail, ShakedownError, Stabilisation, stabilise};

fn with_profile(rail: RolledRail, rows: Vec<(f64, f64, f64)>) -> RolledRail {
    RolledRail { initial: Some(DepthProfile::new(rows).unwrap()), ..rail }
}

/// An elastic passage leaves it unchanged.
#[test]
fn stays_where_nothing_yields() {
    let rail = with_profile(rail(600.0, 0.1, 20e3), vec![(0.0, 80.0, 60.0), (20.0, -20.0, -10.0)]);
    let result = stabilised(&rail);
    assert_eq!(result.state, RailState::Elastic);
    for layer in &result.profile {
        assert_eq!(layer.stress, rail.initial_stress(layer.depth));
    }
}

/// A tension of half the yield stress makes a rail yield that otherwise would not.
#[test]
fn makes_the_rail_yield_earlier() {
    let bare = rail(850.0, 0.0, 20e3);
    assert_eq!(stabilised(&bare).state, RailState::Elastic);
    let pulled = with_profile(bare, vec![(0.0, 0.5 * YIELD, 0.0), (20.0, 0.5 * YIELD, 0.0)]);
    assert_eq!(stabilised(&pulled).state, RailState::ElasticShakedown);
}

/// The limit of elastic shakedown is that of the rail without initial stress (Melan: a constant
/// stress has no effect), and the stress left by a heavy load is determined by the load: rolling
/// replaces the initial residual stress.
#[test]
fn does_not_change_the_shakedown_limit() {
    let profile = vec![(0.0, 100.0, 50.0), (6.0, -60.0, -30.0), (20.0, 0.0, 0.0)];
    for (pressure, state) in [(1130.0, RailState::ElasticShakedown), (1170.0, RailState::PlasticShakedown)] {
        assert_eq!(stabilised(&rail(pressure, 0.1, 20e3)).state, state);
        assert_eq!(stabilised(&with_profile(rail(pressure, 0.1, 20e3), profile.clone())).state, state);
    }
}

/// A profile that makes the rail yield everywhere and without a wheel is refused instead of
/// iterated for ever.
#[test]
fn beyond_yield_is_refused() {
    let rail = with_profile(rail(900.0, 0.1, 20e3), vec![(0.0, 700.0, 0.0), (500.0, 700.0, 0.0)]);
    let error = stabilise(&rail, &Stabilisation::default(), |_| ()).unwrap_err();
    assert!(matches!(error, ShakedownError::Initial { .. }), "{error}");
}

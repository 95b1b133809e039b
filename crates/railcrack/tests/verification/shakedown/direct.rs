//! The direct method: cheap, admissible, and a different state.

use super::{direct, peak, rail, stabilised};
use railcrack::shakedown::RailState;

/// Largest violation of the yield condition, |s − X| over the radius of the yield surface less one:
/// ten times the tolerance of the direct iteration.
const ADMISSIBLE: f64 = 1e-4;

#[test]
fn admissible_at_a_third_of_the_cost() {
    for (pressure, friction, modulus) in
        [(1100.0, 0.1, 20e3), (1300.0, 0.05, 20e3), (1000.0, 0.3, 20e3), (1200.0, -0.2, 5e3)]
    {
        let rail = rail(pressure, friction, modulus);
        let (direct, passes) = (direct(&rail), stabilised(&rail));
        assert_eq!(direct.state, passes.state);
        assert!(direct.admissibility.overshoot < ADMISSIBLE, "{:?}", direct.admissibility);
        // Periodic: the strain that leaves is the one that enters.
        assert!(direct.admissibility.drift < 1e-6, "{:?}", direct.admissibility);
        let (cost, whole) = (direct.iterations(), passes.iterations());
        assert!(3 * cost <= whole, "{pressure}, {friction}: {cost} of {whole}");
        println!(
            "{pressure} {friction}: {cost} of {whole}, {:.1} MPa apart",
            direct.stress_difference(&passes)
        );
    }
}

/// An elastic-shakedown state is not unique: the direct one differs from that of the passages by
/// far more than the error of either.
#[test]
fn differs_from_the_state_of_passages() {
    let rail = rail(1100.0, 0.1, 20e3);
    let (direct, passes) = (direct(&rail), stabilised(&rail));
    assert_eq!((direct.state, passes.state), (RailState::ElasticShakedown, RailState::ElasticShakedown));
    assert!(direct.stress_difference(&passes) > 0.05 * peak(&passes));
}

#[test]
fn an_elastic_rail_takes_one_redistribution() {
    let result = direct(&rail(800.0, 0.1, 20e3));
    assert_eq!((result.state, result.iterations()), (RailState::Elastic, 1));
}

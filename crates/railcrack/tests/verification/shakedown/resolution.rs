//! Effect of columns, layers and period, and equilibrium and yield condition of the discrete
//! fields.

use super::{peak, rail, stabilised};
use railcrack::shakedown::{Resolution, RolledRail, Stabilisation, StabilisedRail, stabilise};

fn at(rail: &RolledRail, per_half_width: u32, period: u32, passes: usize) -> StabilisedRail {
    let resolution = Resolution { per_half_width, period };
    let settings = Stabilisation { resolution, max_passes: passes, ..Stabilisation::default() };
    stabilise(rail, &settings, |_| ()).unwrap()
}

/// Largest and mean difference of the residual stress over the peak, below 0.06 a.
fn difference(coarse: &StabilisedRail, fine: &StabilisedRail) -> (f64, f64) {
    let mut differences = Vec::new();
    for layer in coarse.profile.iter().filter(|layer| layer.depth > 0.06 * 6.75) {
        let there = fine.residual_stress(layer.depth);
        differences.extend([layer.stress.xx - there.xx, layer.stress.zz - there.zz]);
    }
    let largest = differences.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    let mean = (differences.iter().map(|d| d * d).sum::<f64>() / differences.len() as f64).sqrt();
    (largest / peak(fine), mean / peak(fine))
}

/// After three passages, which make most of the change: the default against half as many and twice
/// as many columns and layers. At the edge of the plastic zone the stress changes within a layer:
/// the largest difference occurs there, and decreases with first order.
#[test]
fn columns_and_layers() {
    for (pressure, friction) in [(1100.0, 0.1), (1000.0, 0.3)] {
        let rail = rail(pressure, friction, 20e3);
        let fine = at(&rail, 64, 16, 3);
        let (coarse, default) =
            (difference(&at(&rail, 16, 16, 3), &fine), difference(&at(&rail, 32, 16, 3), &fine));
        println!("{pressure} {friction}: {coarse:.4?} {default:.4?}");
        assert!(default.0 < 0.02 && default.1 < 0.005, "{default:?}");
        assert!(default.1 < 0.6 * coarse.1, "{coarse:?} {default:?}");
    }
}

/// The period of the waves is not critical: four times as long a period changes at most two
/// thousandths of the peak, and doubling it leaves an eighth of that.
#[test]
fn period() {
    let rail = rail(1100.0, 0.1, 20e3);
    let [default, twice, four] = [16, 32, 64].map(|period| at(&rail, 16, period, 2));
    let (first, second) = (difference(&default, &four), difference(&twice, &four));
    println!("{first:.6?} {second:.6?}");
    assert!(first.0 < 2e-3 && second.0 < 0.3 * first.0, "{first:?} {second:?}");
}

/// Forces balance on every layer to 1e-8 of the yield stress, and nowhere in the cycle is the yield
/// condition violated.
#[test]
fn equilibrium_and_yield() {
    for (pressure, friction) in [(1100.0, 0.1), (1300.0, 0.3)] {
        let result = stabilised(&rail(pressure, friction, 20e3));
        assert!(result.admissibility.imbalance < 1e-8, "{:?}", result.admissibility);
        assert!(result.admissibility.overshoot < 1e-4, "{:?}", result.admissibility);
    }
    // The first passage has the strongest redistribution: all of its plastic strain is new.
    let first = at(&rail(1300.0, 0.3, 20e3), 32, 16, 1);
    assert!(first.admissibility.imbalance < 1e-8, "{:?}", first.admissibility);
}

/// Plastic strain varies along the rail inside the contact and is constant beyond it.
#[test]
fn strain_follows_the_wheel() {
    let result = at(&rail(1100.0, 0.1, 20e3), 32, 16, 1);
    let layers = result.profile.len();
    let j = result.profile.partition_point(|layer| layer.depth < 4.0);
    let strain: Vec<f64> = result.cycle.strain.iter().skip(j).step_by(layers).map(|e| e.zz).collect();
    let (first, last) = (strain[0], strain[strain.len() - 1]);
    assert_eq!(first, 0.0);
    assert!(last > 1e-4);
    let partly = strain.iter().filter(|&&e| e > 0.05 * last && e < 0.95 * last).count();
    assert!(partly > 5, "{partly}");
}

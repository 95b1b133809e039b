//! Times of the stabilised plastic state, against time marching of the same material on a fixed
//! mesh.

#[path = "../tests/verification/shakedown/brute_force.rs"]
mod brute_force;

use brute_force::{March, march};
use divan::{Bencher, black_box};
use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{Method, RolledRail, Stabilisation, Travel, stabilise};

fn main() {
    divan::main();
}

/// The case of `verification/shakedown-half-plane`, and one beyond the shakedown limit.
const LOADS: [f64; 2] = [1100.0, 1300.0];

fn rail(peak_pressure: f64) -> RolledRail {
    RolledRail {
        steel: IsotropicElastic::new(210e3, 0.3).unwrap(),
        hardening: KinematicHardening::new(500.0, 20e3).unwrap(),
        contact: HertzianContact { peak_pressure, half_width: 6.75, friction: 0.1 }.into(),
        travel: Travel::Forward,
        initial: None,
    }
}

fn steady(bencher: Bencher, pressure: f64, settings: Stabilisation) {
    let rail = rail(pressure);
    bencher.bench_local(|| stabilise(black_box(&rail), &settings, |_| ()).unwrap().passes.len());
}

#[divan::bench(args = LOADS, sample_count = 3, sample_size = 1)]
fn pass_by_pass(bencher: Bencher, pressure: f64) {
    steady(bencher, pressure, Stabilisation::default());
}

#[divan::bench(args = LOADS, sample_count = 3, sample_size = 1)]
fn direct(bencher: Bencher, pressure: f64) {
    steady(bencher, pressure, Stabilisation { method: Method::Direct, ..Stabilisation::default() });
}

/// One passage of the steady solver: what a passage of [`time_marching_one_pass`] is to be compared
/// with.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn one_pass(bencher: Bencher) {
    steady(bencher, LOADS[0], Stabilisation { max_passes: 1, ..Stabilisation::default() });
}

/// One passage with elements of a/8 and steps of a/16: still 3.6 % of the peak off in the mean.
#[divan::bench(sample_count = 1, sample_size = 1)]
fn time_marching_one_pass(bencher: Bencher) {
    let rail = rail(LOADS[0]);
    let mesh = March { per_half_width: 8.0, steps: 16.0, run: 6.0, fine_depth: 2.0 };
    bencher.bench_local(|| {
        let marched = march(black_box(&rail), mesh, 1);
        (marched.solutions, marched.profiles.len())
    });
}

//! The tables of `docs/dev/shakedown.md`: what columns, layers and period change, and what the
//! direct method costs and misses.
//!
//! `cargo run --release --example shakedown_studies`

use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{
    Method, Resolution, RolledRail, Stabilisation, StabilisedRail, Travel, stabilise,
};
use railcrack::words::Choice;
use std::time::Instant;

/// Peak pressure (MPa), friction and hardening modulus (MPa) for σ_y = 500 MPa.
const CASES: [(f64, f64, f64); 4] =
    [(1100.0, 0.1, 20e3), (1000.0, 0.3, 20e3), (1300.0, 0.05, 20e3), (1200.0, -0.2, 5e3)];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "after three passages, against per_half_width 128 and period 32: largest and mean difference, % of peak"
    );
    for case in CASES {
        let fine = solve(case, Resolution { per_half_width: 128, period: 32 }, Method::PassByPass, 3)?.0;
        for (per_half_width, period) in [(16, 16), (32, 16), (32, 32), (64, 16), (128, 16)] {
            let resolution = Resolution { per_half_width, period };
            let (result, seconds) = solve(case, resolution, Method::PassByPass, 3)?;
            let (largest, mean) = difference(&result, &fine);
            println!("{case:?} {per_half_width:>3} {period:>3}: {largest:.2} {mean:.2}, {seconds:.2} s");
        }
    }
    println!("all passages by default, and the direct method");
    for case in CASES {
        let (passes, seconds) = solve(case, Resolution::default(), Method::PassByPass, 500)?;
        let (direct, less) = solve(case, Resolution::default(), Method::Direct, 500)?;
        println!(
            "{case:?} {}: {} passages, {} redistributions, {seconds:.2} s; direct {}, {less:.2} s, {:.0} of {:.0} MPa apart",
            passes.state.word(),
            passes.passes.len(),
            passes.iterations(),
            direct.iterations(),
            direct.stress_difference(&passes),
            peak(&passes)
        );
    }
    Ok(())
}

fn solve(
    (peak_pressure, friction, modulus): (f64, f64, f64),
    resolution: Resolution,
    method: Method,
    max_passes: usize,
) -> Result<(StabilisedRail, f64), Box<dyn std::error::Error>> {
    let rail = RolledRail {
        steel: IsotropicElastic::new(210e3, 0.3)?,
        hardening: KinematicHardening::new(500.0, modulus)?,
        contact: HertzianContact { peak_pressure, half_width: 6.75, friction }.into(),
        travel: Travel::Forward,
        initial: None,
    };
    let settings = Stabilisation { method, resolution, max_passes, ..Stabilisation::default() };
    let started = Instant::now();
    let result = stabilise(&rail, &settings, |_| ())?;
    Ok((result, started.elapsed().as_secs_f64()))
}

fn peak(result: &StabilisedRail) -> f64 {
    result.profile.iter().map(|layer| layer.stress.xx.abs().max(layer.stress.zz.abs())).fold(0.0, f64::max)
}

/// Below 0.06 a.
fn difference(result: &StabilisedRail, fine: &StabilisedRail) -> (f64, f64) {
    let layers = result.profile.iter().filter(|layer| layer.depth > 0.06 * 6.75);
    let differences: Vec<f64> = layers
        .flat_map(|layer| {
            let there = fine.residual_stress(layer.depth);
            [layer.stress.xx - there.xx, layer.stress.zz - there.zz]
        })
        .collect();
    let mean = (differences.iter().map(|d| d * d).sum::<f64>() / differences.len() as f64).sqrt();
    let largest = differences.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    (100.0 * largest / peak(fine), 100.0 * mean / peak(fine))
}

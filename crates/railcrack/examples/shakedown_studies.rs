//! Prints the stabilised state of a rolled rail: `cargo run --release --example shakedown_studies -- p0 mu C [per_half_width period]`.

use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{Method, Resolution, RolledRail, Stabilisation, Travel, stabilise};

fn main() {
    let numbers: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let or = |i: usize, default: f64| numbers.get(i).copied().unwrap_or(default);
    let direct = std::env::args().any(|a| a == "direct");
    let quiet = std::env::args().any(|a| a == "quiet");
    let rail = RolledRail {
        steel: IsotropicElastic::new(210e3, 0.3).unwrap(),
        hardening: KinematicHardening::new(500.0, or(2, 20e3)).unwrap(),
        contact: HertzianContact { peak_pressure: or(0, 1100.0), half_width: 6.75, friction: or(1, 0.1) },
        travel: Travel::Forward,
        initial: None,
    };
    let settings = Stabilisation {
        method: if direct { Method::Direct } else { Method::PassByPass },
        resolution: Resolution { per_half_width: or(3, 32.0) as u32, period: or(4, 16.0) as u32 },
        ..Stabilisation::default()
    };
    let start = std::time::Instant::now();
    let result = stabilise(&rail, &settings, |p| {
        if !quiet {
            println!(
                "# pass {} it {} dstress {:.4e} dstrain {:.3e} path {:.3e}",
                p.pass, p.iterations, p.stress_change, p.strain_change, p.plastic_path
            );
        }
    })
    .unwrap();
    println!(
        "# {} passes {} iterations {} time {:?} alternating {:?} {:?}",
        result.state.name(),
        result.passes.len(),
        result.iterations(),
        start.elapsed(),
        result.alternating,
        result.admissibility
    );
    for layer in &result.profile {
        println!("{} {} {} {:e}", layer.depth, layer.stress.xx, layer.stress.zz, layer.plastic_per_pass);
    }
}

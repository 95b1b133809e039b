//! A growth step of the finite-element engine against one factorisation of its system, phase by
//! phase, in one run.
//!
//! `cargo bench --bench growth_step`, and `-- 0.2` for another element size in mm. Times are
//! medians of what is repeated; the ratios are what counts.

use railcrack::body::BodyEngine;
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::field::HertzWheel;
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::linear::SparseCholesky;
use railcrack::load::HertzianContact;
use railcrack::material::IsotropicElastic;
use railcrack::math::RailBox;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack::xfem::{MeshSettings, RailEnd, RefinedRegion, XfemEngine, XfemSettings, cracked_body};
use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

/// Growth steps of the reference case.
const STEPS: usize = 25;
/// Times that a phase outside of the steps is repeated.
const REPEATED: usize = 5;

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

fn main() -> Result<(), Box<dyn Error>> {
    let size = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(0.1);
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let wheel = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.025 };
    let mut crack = Crack::surface_breaking(0.0, 6.0, 15f64.to_radians())?;
    let settings = MeshSettings { element_size: size, expected_growth: 1.04f64.powi(STEPS as i32) };
    let first: CrackNetwork = crack.clone().into();
    let refined = RefinedRegion::new(&first, settings);
    let outline = RailBox { width: 6000.0, depth: 3000.0, centre: 0.0 };

    let (mesh_ms, mesh) = timed(|| refined.mesh(outline));
    let mesh = mesh?;
    let (rail_ms, rail) = timed(|| BulkRail::new(mesh.clone(), &steel, Boundary::HalfPlane));
    let rail = Arc::new(rail?);
    let order = mesh.nested_dissection().into_iter().flat_map(|node| rail.unknowns(node)).flatten().collect();
    let (analysis_ms, analysis) = timed(|| SparseCholesky::analyse(&rail.stiffness(), order));
    let analysis = analysis?;
    let factor_ms = median((0..REPEATED).map(|_| timed(|| analysis.factor(&rail.stiffness())).0).collect());
    let cold_ms = median(
        (0..REPEATED).map(|_| timed(|| cracked_body(&rail, &first, XfemSettings::default())).0).collect(),
    );

    let mut engine =
        XfemEngine::new(&first, steel, settings, RailEnd::HalfPlane { centre: 0.0 }, XfemSettings::default());
    let passage = PassageSettings::default();
    let load = RailLoad { wheel: &HertzWheel::new(&wheel, &steel).unwrap(), residual: None };
    engine.body(&first)?;
    let (mut bodies, mut passages, mut steps) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..STEPS {
        crack = crack.extended(End::Last, 0.04 * crack.length(), -0.002)?;
        let network: CrackNetwork = crack.clone().into();
        let (body_ms, body) = timed(|| engine.body(&network));
        let body = body?;
        let faces = FaceProblem::new(&body, &[0.5]).unwrap();
        let (passage_ms, result) =
            timed(|| stabilised_passage(&faces, &Newton::default(), load, &passage, &Unobserved));
        result?;
        bodies.push(body_ms);
        passages.push(passage_ms);
        steps.push(body_ms + passage_ms);
    }
    let (body_ms, passage_ms, step_ms) = (median(bodies), median(passages), median(steps));

    println!(
        "element size {size} mm: {} x {} elements, {} unknowns, {} entries of the factor",
        mesh.columns(),
        mesh.rows(),
        rail.order(),
        rail.factor().unwrap().entries()
    );
    println!("{:<46} {:>10} {:>16}", "phase", "ms", "factorisations");
    let rows = [
        ("mesh", mesh_ms),
        ("assembly, analysis and factorisation", rail_ms),
        ("analysis alone", analysis_ms),
        ("one numeric factorisation (median)", factor_ms),
        ("border and condensation, nothing known", cold_ms),
        ("border and condensation in a growth step", body_ms),
        ("passages of a growth step", passage_ms),
        ("growth step (median of 25)", step_ms),
    ];
    for (phase, ms) in rows {
        println!("{phase:<46} {ms:>10.2} {:>16.2}", ms / factor_ms);
    }
    Ok(())
}

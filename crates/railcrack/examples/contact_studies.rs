//! The studies behind the defaults of the contact solvers.
//! `cargo run --release --example contact_studies -- latin` prints the table of
//! `docs/dev/latin.md`: iterations per contact solution against LATIN's search direction,
//! stabilisation, relaxation and extrapolation. `-- steps` prints that of
//! `docs/dev/step-control.md`: error of K against the step tolerance and against fixed steps.

use railcrack::contact::{ContactSolver, FaceProblem, Latin, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::dislocation::{FaceResolution, cracked_body};
use railcrack::field::HertzWheel;
use railcrack::growth::{PassageSettings, StabilisedPassage, Unobserved};
use railcrack::load::{HertzianContact, Passage};
use railcrack::material::IsotropicElastic;
use railcrack::plane::{RailLoad, stabilised_passage};
use std::error::Error;

struct Case {
    name: &'static str,
    cracks: Vec<Crack>,
    crack_friction: f64,
    wheel_friction: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let straight = |degrees: f64| Crack::surface_breaking(0.0, 6.0, degrees.to_radians());
    let kinked = Crack::surface_breaking(0.0, 4.0, 15f64.to_radians())?.extended(End::Last, 2.0, -1.0)?;
    let pair = vec![straight(15.0)?, Crack::surface_breaking(-1.0, 6.0, 165f64.to_radians())?];
    let case =
        |name, cracks, crack_friction, wheel_friction| Case { name, cracks, crack_friction, wheel_friction };
    let cases = [
        case("15°, μ_c 0.5, μ_w 0.025", vec![straight(15.0)?], 0.5, 0.025),
        case("15°, μ_c 0.1, μ_w 0.4", vec![straight(15.0)?], 0.1, 0.4),
        case("45°, μ_c 0.8, μ_w −0.4", vec![straight(45.0)?], 0.8, -0.4),
        case("90°, μ_c 0.5, μ_w 0.025", vec![straight(90.0)?], 0.5, 0.025),
        case("kinked, μ_c 0.5, μ_w 0.1", vec![kinked], 0.5, 0.1),
        case("pair, μ_c 0.5, μ_w 0.025", pair, 0.5, 0.025),
    ];
    let names: Vec<&str> = cases.iter().map(|case| case.name).collect();
    let title = format!("| | {} |\n|---|{}", names.join(" | "), "---|".repeat(cases.len()));
    match std::env::args().nth(1).as_deref() {
        Some("latin") => latin_sweep(&cases, &title),
        Some("steps") => step_control(&cases, &title)?,
        _ => eprintln!("contact_studies latin | steps"),
    }
    Ok(())
}

fn latin_sweep(cases: &[Case], title: &str) {
    let base = Latin::default();
    let mut rows: Vec<(String, Latin)> = Vec::new();
    for direction in [0.3, 1.0, 2.0, 3.0, 5.0, 10.0, 30.0] {
        rows.push((format!("k C_jj = {direction}"), Latin { direction, ..base }));
    }
    for stabilisation in [0.25, 1.0] {
        rows.push((format!("ξ k = {stabilisation}"), Latin { stabilisation, ..base }));
    }
    for relaxation in [0.5, 0.65, 1.0] {
        rows.push((format!("relaxation {relaxation}"), Latin { relaxation, ..base }));
    }
    for history in [0, 5, 10, 30] {
        rows.push((format!("history {history}"), Latin { history, ..base }));
    }
    println!("{title}");
    for (name, latin) in &rows {
        let cells: Vec<String> = cases.iter().map(|case| iterations(case, latin)).collect();
        println!("| {name} | {} |", cells.join(" | "));
    }
    let newton: Vec<String> = cases.iter().map(|case| iterations(case, &Newton::default())).collect();
    println!("| Newton | {} |", newton.join(" | "));
}

/// Step tolerance of the solutions that count as exact.
const EXACT: f64 = 2e-5;
/// A step tolerance that never cuts a step.
const NEVER: f64 = 1e12;
/// Output positions.
const POSITIONS: usize = 241;

fn step_control(cases: &[Case], title: &str) -> Result<(), Box<dyn Error>> {
    let newton = Newton::default();
    let exact: Vec<StabilisedPassage> =
        cases.iter().map(|case| passage(case, &newton, 1, EXACT)).collect::<Result<_, _>>()?;
    let row = |name: String, refinement: usize, tolerance: f64| -> Result<(), Box<dyn Error>> {
        let mut cells = Vec::new();
        for (case, exact) in cases.iter().zip(&exact) {
            let result = passage(case, &newton, refinement, tolerance)?;
            let solves = result.counts.solves;
            cells.push(format!("{:.3} % ({solves})", 100.0 * error(&result, exact, refinement)));
        }
        println!("| {name} | {} |", cells.join(" | "));
        Ok(())
    };
    println!("{title}");
    for tolerance in [8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4] {
        row(format!("tolerance {tolerance:e}"), 1, tolerance)?;
    }
    for refinement in [1, 5, 20] {
        row(format!("fixed steps {} a", 0.05 / refinement as f64), refinement, NEVER)?;
    }
    Ok(())
}

/// The largest difference of K at any tip and output position, relative to the largest |K|.
fn error(result: &StabilisedPassage, exact: &StabilisedPassage, refinement: usize) -> f64 {
    let (mut difference, mut peak) = (0.0f64, 0.0f64);
    if let (Some(got), Some(want)) = (result.passages.last(), exact.passages.last()) {
        for (got, want) in got.sifs.iter().zip(&want.sifs) {
            for (got, want) in got.iter().step_by(refinement).zip(want) {
                difference = difference.max((got.ki - want.ki).abs()).max((got.kii - want.kii).abs());
                peak = peak.max(want.ki.abs()).max(want.kii.abs());
            }
        }
    }
    difference / peak
}

/// Mean and largest number of iterations per solution.
fn iterations(case: &Case, solver: &dyn ContactSolver) -> String {
    match passage(case, solver, 1, 2e-3) {
        Ok(result) => {
            let counts = result.counts;
            format!("{:.1} ({})", counts.iterations as f64 / counts.solves as f64, counts.iterations_max)
        }
        Err(_) => "no convergence".into(),
    }
}

fn passage(
    case: &Case,
    solver: &dyn ContactSolver,
    refinement: usize,
    step_tolerance: f64,
) -> Result<StabilisedPassage, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let network = CrackNetwork::new(case.cracks.clone())?;
    let body = cracked_body(&network, &steel, FaceResolution::for_cracks(case.cracks.len()))?;
    let problem = FaceProblem::new(&body, &vec![case.crack_friction; case.cracks.len()])?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: case.wheel_friction };
    let settings = PassageSettings {
        passage: Passage { from: -40.5, to: 40.5, positions: (POSITIONS - 1) * refinement + 1 },
        max_passages: 3,
        passage_tolerance: 1e-3,
        step_tolerance,
        ..PassageSettings::default()
    };
    let load = RailLoad { wheel: &HertzWheel::new(&contact, &steel)?, residual: None };
    Ok(stabilised_passage(&problem, solver, load, &settings, &Unobserved)?)
}

//! How time and memory of a growth step grow: with the unknowns of the mesh, the number of cracks,
//! the load steps, the threads.
//!
//! `cargo bench --bench scaling > scaling.csv` prints a table, and exponents (least squares in
//! logarithms) as comments at its end. Every row is a process of its own, so that its peak of
//! memory is its own; what counts are ratios within one table.

use railcrack::body::BodyEngine;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::field::HertzWheel;
use railcrack::growth::{PassageSettings, RailLoad, Unobserved, stabilised_passage};
use railcrack::load::HertzianContact;
use railcrack::material::IsotropicElastic;
use railcrack::xfem::{MeshSettings, RailEnd, XfemEngine, XfemSettings};
use rayon::ThreadPoolBuilder;
use std::error::Error;
use std::process::Command;
use std::time::Instant;

/// Growth steps after the first body; medians of these are told.
const STEPS: usize = 5;
/// From here on one growth step is enough: it takes minutes.
const MANY_CRACKS: usize = 32;
/// Distance between cracks, mm.
const SPACING: f64 = 3.375;

/// The varied quantity.
#[derive(Debug, Clone, Copy)]
struct Point {
    study: &'static str,
    element_mm: f64,
    cracks: usize,
    threads: usize,
    step_tolerance: f64,
}

const PLAIN: Point =
    Point { study: "unknowns", element_mm: 0.2, cracks: 1, threads: 1, step_tolerance: 2e-3 };

fn points() -> Vec<Point> {
    let sizes = [0.7, 0.35, 0.18, 0.1, 0.07, 0.05, 0.035, 0.025, 0.018];
    let unknowns = sizes.map(|element_mm| Point { element_mm, ..PLAIN });
    let cracks = [1, 2, 4, 8, 16, 32].map(|cracks| Point { study: "cracks", cracks, ..PLAIN });
    let tolerances = [2e-2, 5e-3, 2e-3, 5e-4, 1e-4];
    let load_steps = tolerances.map(|step_tolerance| Point { study: "load steps", step_tolerance, ..PLAIN });
    let threads = [1, 2].map(|threads| Point { study: "threads", element_mm: 0.1, threads, ..PLAIN });
    let of_nine = [1, 2].map(|threads| Point { study: "threads, 9 cracks", cracks: 9, threads, ..PLAIN });
    [&unknowns[..], &cracks, &load_steps, &threads, &of_nine].concat()
}

/// Cost of a point.
struct Cost {
    unknowns: usize,
    face_points: usize,
    solves: usize,
    body_ms: f64,
    contact_ms: f64,
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn measure(point: Point) -> Result<Cost, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let wheel = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.1 };
    let at = |k: usize| SPACING * (k as f64 - 0.5 * (point.cracks as f64 - 1.0));
    let mut cracks: Vec<Crack> = (0..point.cracks)
        .map(|k| Crack::surface_breaking(at(k), 6.0, 15f64.to_radians()))
        .collect::<Result<_, _>>()?;
    let mesh = MeshSettings { element_size: point.element_mm, expected_growth: 1.04f64.powi(STEPS as i32) };
    let end = RailEnd::HalfPlane { centre: 0.0 };
    let mut engine =
        XfemEngine::new(&CrackNetwork::new(cracks.clone())?, steel, mesh, end, XfemSettings::default());
    let passage = PassageSettings { step_tolerance: point.step_tolerance, ..PassageSettings::default() };
    let load = RailLoad { wheel: &HertzWheel::new(&wheel, &steel).unwrap(), residual: None };
    let (mut bodies, mut contacts) = (Vec::new(), Vec::new());
    let mut cost = Cost { unknowns: 0, face_points: 0, solves: 0, body_ms: 0.0, contact_ms: 0.0 };
    let steps = if point.cracks < MANY_CRACKS { STEPS } else { 1 };
    for step in 0..=steps {
        let network = CrackNetwork::new(cracks.clone())?;
        let begun = Instant::now();
        let body = engine.body(&network)?;
        let made = Instant::now();
        let faces = FaceProblem::new(&body, &vec![0.5; point.cracks]).unwrap();
        let result = stabilised_passage(&faces, &Newton::default(), load, &passage, &Unobserved)?;
        // The first body factors the mesh.
        if step > 0 {
            bodies.push((made - begun).as_secs_f64() * 1e3);
            contacts.push(made.elapsed().as_secs_f64() * 1e3);
        }
        (cost.unknowns, cost.face_points, cost.solves) = (body.dofs, faces.points(), result.counts.solves);
        cracks = cracks
            .iter()
            .map(|crack| crack.extended(End::Last, 0.04 * crack.length(), -0.002))
            .collect::<Result<_, _>>()?;
    }
    Ok(Cost { body_ms: median(bodies), contact_ms: median(contacts), ..cost })
}

/// The largest resident memory of this process so far, MB.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}

/// The slope of ln y over ln x.
fn exponent(pairs: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = pairs.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let mean = logs.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let sum = |f: &dyn Fn(f64, f64) -> f64| logs.iter().map(|p| f(p.0 - mean.0, p.1 - mean.1)).sum::<f64>();
    sum(&|x, y| x * y) / sum(&|x, _| x * x)
}

fn main() -> Result<(), Box<dyn Error>> {
    let points = points();
    let own = std::env::args().skip_while(|argument| argument != "--point").nth(1);
    if let Some(index) = own {
        let point = points[index.parse::<usize>()?];
        let pool = ThreadPoolBuilder::new().num_threads(point.threads).build()?;
        let cost = pool.install(|| measure(point).map_err(|reason| reason.to_string()))?;
        let Cost { unknowns, face_points, solves, body_ms, contact_ms } = cost;
        let memory = peak_memory_mb().map_or(String::new(), |mb| format!("{mb:.0}"));
        println!("{unknowns},{face_points},{solves},{body_ms:.1},{contact_ms:.1},{memory}");
        return Ok(());
    }
    println!(
        "study,element_mm,cracks,threads,step_tolerance,unknowns,face_points,contact_solves,body_ms,contact_ms,peak_memory_mb"
    );
    let mut table: Vec<(Point, Vec<f64>)> = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let output = Command::new(std::env::current_exe()?).args(["--point", &index.to_string()]).output()?;
        if !output.status.success() {
            return Err(format!("{point:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
        }
        let text = String::from_utf8(output.stdout)?;
        let Point { study, element_mm, cracks, threads, step_tolerance } = point;
        println!("\"{study}\",{element_mm},{cracks},{threads},{step_tolerance},{}", text.trim());
        table.push((*point, text.trim().split(',').filter_map(|value| value.parse().ok()).collect()));
    }
    let slope = |study: &str, x: &dyn Fn(&Point, &[f64]) -> f64, y: &dyn Fn(&[f64]) -> f64| {
        let rows = table.iter().filter(|(point, _)| point.study == study);
        exponent(&rows.map(|(point, row)| (x(point, row), y(row))).collect::<Vec<_>>())
    };
    let step = |row: &[f64]| row[3] + row[4];
    let unknowns = |_: &Point, row: &[f64]| row[0];
    println!("# growth step over unknowns: exponent {:.2}", slope("unknowns", &unknowns, &step));
    println!("# of it the body: {:.2}", slope("unknowns", &unknowns, &|row| row[3]));
    println!("# memory over unknowns: {:.2}", slope("unknowns", &unknowns, &|row| row[5]));
    let cracks = |point: &Point, _: &[f64]| point.cracks as f64;
    println!("# growth step over cracks: {:.2}", slope("cracks", &cracks, &step));
    println!("# of it the body: {:.2}", slope("cracks", &cracks, &|row| row[3]));
    println!("# memory over cracks: {:.2}", slope("cracks", &cracks, &|row| row[5]));
    let solves = |_: &Point, row: &[f64]| row[2];
    println!("# contact over its solutions: {:.2}", slope("load steps", &solves, &|row| row[4]));
    Ok(())
}

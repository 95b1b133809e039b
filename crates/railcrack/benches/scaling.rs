//! How time and memory of a growth step grow: with the unknowns of the mesh, the number of cracks,
//! together and in groups, the load steps, the threads.
//!
//! `cargo bench --bench scaling > scaling.csv` prints a table, and exponents (least squares in
//! logarithms) as comments at its end. Every row is a process of its own, so that its peak of
//! memory is its own; what counts are ratios within one table. Of rows in groups, times are those
//! of the first growth step, and K is compared with that of all cracks together where these are
//! not too many. With an argument, `cargo bench --bench scaling -- groups`, only studies whose
//! names contain it are made.

mod common;

use common::{exponent, peak_memory_mb};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::field::HertzWheel;
use railcrack::growth::{PassageSettings, StabilisedPassage, Unobserved};
use railcrack::interruption::Interruption;
use railcrack::load::{HertzianContact, Passage};
use railcrack::material::IsotropicElastic;
use railcrack::plane::{RailLoad, stabilised_passage};
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

/// The most cracks of which K in groups is compared with that of all together.
const COMPARED: usize = 32;
/// Of the load steps of both there.
const COMPARED_STEPS: f64 = 2e-4;
/// Half-width of the contact, and the reach of the passage beyond the row, mm.
const HALF_WIDTH: f64 = 6.75;
const BEYOND: f64 = 6.0 * HALF_WIDTH;
/// Output positions of rows in groups.
const POSITIONS: usize = 121;

/// The study of rows in groups.
const GROUPS: &str = "groups, dislocations";

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
    let numbers = [8, 16, 32, 64, 128];
    let groups = numbers.map(|cracks| Point { study: GROUPS, cracks, ..PLAIN });
    [&unknowns[..], &cracks, &load_steps, &threads, &of_nine, &groups].concat()
}

/// Cost of a point.
struct Cost {
    unknowns: usize,
    face_points: usize,
    solves: usize,
    body_ms: f64,
    contact_ms: f64,
    /// The largest difference of K from that of all cracks together, % of the peak at its tip.
    off: Option<f64>,
}

/// A row in groups.
fn measure_groups(point: Point) -> Result<Cost, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let contact = HertzianContact { peak_pressure: 845.0, half_width: HALF_WIDTH, friction: 0.1 };
    let wheel = HertzWheel::new(&contact, &steel)?;
    let crack = |k: usize| Crack::surface_breaking(SPACING * k as f64, 6.0, 15f64.to_radians());
    let network = CrackNetwork::new((0..point.cracks).map(crack).collect::<Result<_, _>>()?)?;
    let mut engine = DislocationEngine { steel, resolution: FaceResolution::for_cracks(point.cracks) };
    let passage = |body: &CrackedBody, step_tolerance: f64| -> Result<StabilisedPassage, Box<dyn Error>> {
        let to = network.rightmost_mouth() + BEYOND;
        let settings = PassageSettings {
            passage: Passage { from: -BEYOND, to, positions: POSITIONS },
            step_tolerance,
            ..PassageSettings::default()
        };
        let faces = FaceProblem::new(body, &vec![0.5; point.cracks])?;
        let load = RailLoad { wheel: &wheel, residual: None };
        Ok(stabilised_passage(&faces, &Newton::default(), load, &settings, &Unobserved)?)
    };
    let begun = Instant::now();
    let body = engine.body_by_groups(Interruption::NEVER, &network)?.ok_or("no body by groups")?;
    let body_ms = begun.elapsed().as_secs_f64() * 1e3;
    let made = Instant::now();
    let solves = passage(&body, point.step_tolerance)?.counts.solves;
    let contact_ms = made.elapsed().as_secs_f64() * 1e3;
    let off = if std::env::args().any(|argument| argument == "--compare") && point.cracks <= COMPARED {
        let whole = passage(&engine.body(&network)?, COMPARED_STEPS)?;
        Some(100.0 * largest_difference(&whole, &passage(&body, COMPARED_STEPS)?))
    } else {
        None
    };
    Ok(Cost { unknowns: body.dofs, face_points: body.faces.points.len(), solves, body_ms, contact_ms, off })
}

/// The largest difference of K at any position over the peak of K at its tip.
fn largest_difference(whole: &StabilisedPassage, groups: &StabilisedPassage) -> f64 {
    let last = |passage: &StabilisedPassage| passage.passages[passage.passages.len() - 1].sifs.clone();
    let tips = last(whole).into_iter().zip(last(groups));
    let of_tip = tips.map(|(one, other)| {
        let peak = one.iter().fold(0.0f64, |peak, k| peak.max(k.ki.abs()).max(k.kii.abs()));
        let off = one.iter().zip(other).map(|(a, b)| (a.ki - b.ki).abs().max((a.kii - b.kii).abs()));
        off.fold(0.0, f64::max) / peak
    });
    of_tip.fold(0.0, f64::max)
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
    let mut cost = Cost { unknowns: 0, face_points: 0, solves: 0, body_ms: 0.0, contact_ms: 0.0, off: None };
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

fn main() -> Result<(), Box<dyn Error>> {
    let points = points();
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(place) = arguments.iter().position(|argument| argument == "--point") {
        let point = points[arguments[place + 1].parse::<usize>()?];
        let pool = ThreadPoolBuilder::new().num_threads(point.threads).build()?;
        let measure = if point.study == GROUPS { measure_groups } else { measure };
        let cost = pool.install(|| measure(point).map_err(|reason| reason.to_string()))?;
        let Cost { unknowns, face_points, solves, body_ms, contact_ms, off } = cost;
        let memory = peak_memory_mb().map_or(String::new(), |mb| format!("{mb:.0}"));
        let off = off.map_or(String::new(), |off| format!("{off:.3}"));
        println!("{unknowns},{face_points},{solves},{body_ms:.1},{contact_ms:.1},{memory},{off}");
        return Ok(());
    }
    let wanted = arguments.iter().find(|argument| !argument.starts_with('-'));
    println!(
        "study,element_mm,cracks,threads,step_tolerance,unknowns,face_points,contact_solves,body_ms,contact_ms,peak_memory_mb,k_off_percent"
    );
    let mut table: Vec<(Point, Vec<f64>)> = Vec::new();
    let is_wanted = |point: &Point| wanted.is_none_or(|wanted| point.study.contains(wanted.as_str()));
    for (index, point) in points.iter().enumerate().filter(|(_, point)| is_wanted(point)) {
        let index = index.to_string();
        let told = |further: &[&str]| -> Result<String, Box<dyn Error>> {
            let all = [&["--point", &index], further].concat();
            let output = Command::new(std::env::current_exe()?).args(all).output()?;
            if !output.status.success() {
                return Err(format!("{point:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
            }
            Ok(String::from_utf8(output.stdout)?.trim().to_owned())
        };
        let mut text = told(&[])?;
        if point.study == GROUPS && point.cracks <= COMPARED {
            // Another process, whose memory is not that of the groups.
            let compared = told(&["--compare"])?;
            text.push_str(compared.rsplit(',').next().unwrap_or_default());
        }
        let Point { study, element_mm, cracks, threads, step_tolerance } = point;
        println!("\"{study}\",{element_mm},{cracks},{threads},{step_tolerance},{text}");
        table.push((*point, text.split(',').filter_map(|value| value.parse().ok()).collect()));
    }
    let slope = |study: &str, x: &dyn Fn(&Point, &[f64]) -> f64, y: &dyn Fn(&[f64]) -> f64| {
        let rows = table.iter().filter(|(point, _)| point.study == study);
        exponent(&rows.map(|(point, row)| (x(point, row), y(row))).collect::<Vec<_>>())
    };
    let step = |row: &[f64]| row[3] + row[4];
    let unknowns = |_: &Point, row: &[f64]| row[0];
    let cracks = |point: &Point, _: &[f64]| point.cracks as f64;
    if table.iter().any(|(point, _)| point.study == GROUPS) {
        println!("# {GROUPS}: growth step over cracks: {:.2}", slope(GROUPS, &cracks, &step));
        println!("# {GROUPS}: of it the body: {:.2}", slope(GROUPS, &cracks, &|row| row[3]));
        println!("# {GROUPS}: memory over cracks: {:.2}", slope(GROUPS, &cracks, &|row| row[5]));
    }
    if wanted.is_some() {
        return Ok(());
    }
    println!("# growth step over unknowns: exponent {:.2}", slope("unknowns", &unknowns, &step));
    println!("# of it the body: {:.2}", slope("unknowns", &unknowns, &|row| row[3]));
    println!("# memory over unknowns: {:.2}", slope("unknowns", &unknowns, &|row| row[5]));
    println!("# growth step over cracks: {:.2}", slope("cracks", &cracks, &step));
    println!("# of it the body: {:.2}", slope("cracks", &cracks, &|row| row[3]));
    println!("# memory over cracks: {:.2}", slope("cracks", &cracks, &|row| row[5]));
    let solves = |_: &Point, row: &[f64]| row[2];
    println!("# contact over its solutions: {:.2}", slope("load steps", &solves, &|row| row[4]));
    Ok(())
}

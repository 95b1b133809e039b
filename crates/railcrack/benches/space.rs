//! How time and memory of a crack in space grow with its elements.
//!
//! `cargo bench --bench space > space.csv` prints a table, and exponents (least squares in
//! logarithms) as comments at its end. Every row is a process of its own, so that its peak of
//! memory is its own. `-- --elements 600 --dip 15` measures one crack. With the wheel in the middle
//! of the crack one half of the faces is solved for; `--lateral 1e-3` moves it aside (mm), so that
//! whole faces are.

mod common;

use common::{exponent, peak_memory_mb};
use railcrack::growth::{PassageSettings, Unobserved};
use railcrack::interruption::Interruption;
use railcrack::load::Passage;
use railcrack::material::IsotropicElastic;
use railcrack::space::{
    EllipticWheel, PatchOnRail, SpaceBody, SpaceContact, SpaceCrack, SpaceKernel, SpaceLoad,
    SpacePassageSettings, SpacePassages, SpaceResolution, WheelPatch,
};
use rayon::ThreadPoolBuilder;
use std::error::Error;
use std::process::Command;
use std::time::Instant;

const THREADS: usize = 2;
/// The semi-axes of the crack and of the contact, mm.
const DEPTH: f64 = 4.0;
const HALF_LENGTH: f64 = 6.0;
const CONTACT: f64 = 6.0;

/// Cells from the middle of the block to its side and in the ring: 24 to 8064 elements.
const CELLS: [[usize; 2]; 9] =
    [[2, 2], [3, 3], [4, 4], [6, 6], [8, 8], [10, 10], [14, 14], [18, 19], [36, 38]];
/// Dips, and the most elements at each.
const DIPS: [(f64, usize); 2] = [(30.0, 2016), (15.0, 600)];

fn elements([block, ring]: [usize; 2]) -> usize {
    2 * block * block + 4 * block * ring
}

/// Seconds of each part, and what they were spent on.
struct Cost {
    points: usize,
    table_s: f64,
    body_s: f64,
    forces_s: f64,
    coarse_s: f64,
    passage_s: f64,
    steps: usize,
    iterations: usize,
    peak: f64,
}

fn measure([block, ring]: [usize; 2], dip: f64, lateral: f64) -> Result<Cost, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let crack = SpaceCrack::surface_breaking(dip.to_radians(), HALF_LENGTH, DEPTH)?;
    let begun = Instant::now();
    let kernel = SpaceKernel::new(&[crack.dip], steel.poisson());
    let table_s = begun.elapsed().as_secs_f64();

    let begun = Instant::now();
    let resolution = SpaceResolution::new(block, ring);
    let body = SpaceBody::with_kernel(&[crack], &steel, Some(&kernel), resolution, Interruption::NEVER)?;
    let body_s = begun.elapsed().as_secs_f64();

    let wheel = EllipticWheel {
        peak_pressure: 1000.0,
        half_width: CONTACT,
        lateral_half_width: CONTACT,
        lateral,
        friction: 0.1,
        lateral_friction: 0.0,
    };
    let contact = SpaceContact { body: &body, friction: &[0.3] };
    let patch = WheelPatch::Ellipse(wheel);
    let over = PatchOnRail { patch: &patch, poisson: steel.poisson() };
    let load = SpaceLoad { wheel: &over, bending: None, constant: None, fluid: None };
    let settings = PassageSettings::default();
    let passage = Passage { from: -6.0 * CONTACT, to: 6.0 * CONTACT, ..settings.passage };
    let begun = Instant::now();
    let passages = SpacePassages::new(&contact, &load, passage, &Unobserved)?;
    let forces_s = begun.elapsed().as_secs_f64();

    let begun = Instant::now();
    let whole = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let peak = passages.pass(&whole, &mut contact.virgin())?.peak();
    let coarse_s = begun.elapsed().as_secs_f64();
    let begun = Instant::now();
    let settings = SpacePassageSettings { tolerance: settings.step_tolerance * peak, halvings: 8 };
    let history = passages.pass(&settings, &mut contact.virgin())?;
    let passage_s = begun.elapsed().as_secs_f64();
    Ok(Cost {
        points: body.points().len(),
        table_s,
        body_s,
        forces_s,
        coarse_s,
        passage_s,
        steps: history.steps,
        iterations: history.iterations,
        peak: history.peak(),
    })
}

fn option(name: &str) -> Option<String> {
    std::env::args().skip_while(|argument| argument != name).nth(1)
}

fn row(cells: [usize; 2], dip: f64, lateral: f64) -> Result<String, Box<dyn Error>> {
    let pool = ThreadPoolBuilder::new().num_threads(THREADS).build()?;
    let cost = pool.install(|| measure(cells, dip, lateral).map_err(|reason| reason.to_string()))?;
    let Cost { points, table_s, body_s, forces_s, coarse_s, passage_s, steps, iterations, peak } = cost;
    let memory = peak_memory_mb().map_or(String::new(), |mb| format!("{mb:.0}"));
    Ok(format!(
        "{dip},{},{points},{table_s:.3},{body_s:.3},{forces_s:.3},{coarse_s:.3},{passage_s:.3},{steps},{iterations},{peak:.3},{memory}",
        elements(cells)
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    let wanted = option("--elements").map(|text| text.parse::<usize>()).transpose()?;
    let dip = option("--dip").map(|text| text.parse::<f64>()).transpose()?;
    let lateral = option("--lateral").map_or(Ok(0.0), |text| text.parse::<f64>())?;
    if let (Some(count), Some(dip)) = (wanted, dip) {
        let cells = CELLS.into_iter().find(|cells| elements(*cells) >= count).unwrap_or(CELLS[0]);
        println!("{}", row(cells, dip, lateral)?);
        return Ok(());
    }
    println!(
        "dip_deg,elements,points,table_s,body_s,forces_s,first_passage_s,passage_s,steps,iterations,peak_k,peak_memory_mb"
    );
    let mut table: Vec<Vec<f64>> = Vec::new();
    for (dip, most) in DIPS {
        for cells in CELLS.into_iter().filter(|cells| elements(*cells) <= most) {
            let [elements, dip, lateral] =
                [elements(cells) as f64, dip, lateral].map(|value| value.to_string());
            let arguments = ["--elements", &elements, "--dip", &dip, "--lateral", &lateral];
            let output = Command::new(std::env::current_exe()?).args(arguments).output()?;
            if !output.status.success() {
                return Err(format!("{arguments:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
            }
            let text = String::from_utf8(output.stdout)?;
            println!("{}", text.trim());
            table.push(text.trim().split(',').filter_map(|value| value.parse().ok()).collect());
        }
    }
    for (column, name) in [(4, "body"), (5, "forces"), (7, "passage"), (11, "memory")] {
        for (dip, _) in DIPS {
            let rows = table.iter().filter(|row| row[0] == dip && row[1] >= 200.0);
            let pairs: Vec<(f64, f64)> = rows.map(|row| (row[1], row[column])).collect();
            println!("# {name} over elements from 200 on, {dip} degrees: exponent {:.2}", exponent(&pairs));
        }
    }
    Ok(())
}

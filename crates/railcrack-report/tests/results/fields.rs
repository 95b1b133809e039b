//! The fields of a run with the finite-element engine: wheel, contact and crack together.

use railcrack::body::Face;
use railcrack::growth::{FieldRecord, StepRecord, Unobserved};
use railcrack::math::Vec2;
use railcrack_case::Case;
use railcrack_run::setup::PreparedRun;
use std::path::Path;

const PEAK_PRESSURE: f64 = 845.0;
const HALF_WIDTH: f64 = 6.75;
const WHEEL_FRICTION: f64 = 0.1;
const ANGLE: f64 = 15.0;
const LENGTH: f64 = 6.0;

/// The first step of a crack after Table 1 with few elements.
fn step(sections: &str) -> StepRecord {
    step_under("", sections)
}

/// The same with more keys of the `contact`.
fn step_under(contact: &str, sections: &str) -> StepRecord {
    let text = format!(
        "[contact]\npeak_pressure_mpa = {PEAK_PRESSURE}\nhalf_width_mm = {HALF_WIDTH}\nfriction = {WHEEL_FRICTION}\n{contact}\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = {LENGTH}\nangle_deg = {ANGLE}\nfriction = 0.1\n\
         [passage]\npositions = 25\n[growth]\nsteps = 0\n[mesh]\nelement_size_mm = 0.2\n[solver]\nengine = \"xfem\"\n{sections}"
    );
    let case = Case::parse(&text, "case.toml", Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    PreparedRun::new(&case, None).unwrap().growth(None).next_step(&Unobserved).unwrap().unwrap()
}

fn fields(record: &StepRecord) -> &FieldRecord {
    record.fields.as_ref().unwrap()
}

#[test]
fn the_running_surface_carries_the_wheel() {
    // Of the peak pressure: the stress of the cracked body is extrapolated to the surface; measured
    // 5e-4.
    const TOLERANCE: f64 = 2e-3;
    let record = step("[output]\nfields_over_a = [-1.1, 0.0, 0.9]\n");
    let fields = fields(&record);
    let positions: Vec<usize> = fields.snapshots.iter().map(|snapshot| snapshot.position).collect();
    // Output positions are half a half-width apart.
    assert_eq!(positions, [10, 12, 14]);
    let (mut worst, mut count) = (0.0f64, 0);
    for snapshot in &fields.snapshots {
        for (point, stress) in fields.grid.points.iter().zip(&snapshot.stress) {
            let u = (point.x - snapshot.xc) / HALF_WIDTH;
            // Near the mouth the flap ends in a corner of 15 degrees.
            if point.y == 0.0 && point.x.abs() > 0.05 * LENGTH {
                let pressure = PEAK_PRESSURE * f64::max(1.0 - u * u, 0.0).sqrt();
                worst = worst
                    .max((stress.yy + pressure).abs())
                    .max((stress.xy - WHEEL_FRICTION * pressure).abs());
                count += 1;
            }
        }
    }
    println!("largest error of the traction on the surface: {} of p0", worst / PEAK_PRESSURE);
    assert!(count > 100 && worst < TOLERANCE * PEAK_PRESSURE, "{worst} MPa at {count} points");
}

#[test]
fn the_running_surface_carries_a_wheel_that_feels_the_crack() {
    // Root mean square over p0, of points beyond a tenth of the length from the mouth: the stress
    // of the cracked body is extrapolated to the surface; measured 3e-5.
    const TOLERANCE: f64 = 2e-4;
    let record = step_under("coupled = true\n", "[output]\nfields_over_a = [0.0, 0.5]\n");
    let (mut squares, mut count, mut felt) = (0.0, 0.0, 0.0f64);
    for snapshot in &fields(&record).snapshots {
        let nodes = &record.faces.surface[snapshot.position];
        for (point, stress) in fields(&record).grid.points.iter().zip(&snapshot.stress) {
            if point.y == 0.0 && point.x.abs() > 0.1 * LENGTH {
                let after = nodes.partition_point(|node| node.x <= point.x);
                let (from, to) = (&nodes[after - 1], &nodes[after]);
                let share = (point.x - from.x) / (to.x - from.x);
                let pressure = from.pressure + share * (to.pressure - from.pressure);
                let u = (point.x - snapshot.xc) / HALF_WIDTH;
                felt = felt.max((pressure - PEAK_PRESSURE * f64::max(1.0 - u * u, 0.0).sqrt()).abs());
                squares += (stress.yy + pressure).powi(2) + (stress.xy - WHEEL_FRICTION * pressure).powi(2);
                count += 1.0;
            }
        }
    }
    let error = f64::sqrt(squares / count) / PEAK_PRESSURE;
    println!("traction on the surface: {error} of p0; from Hertz it differs by {} p0", felt / PEAK_PRESSURE);
    assert!(error < TOLERANCE && felt > 0.05 * PEAK_PRESSURE, "{error}, {felt} MPa");
}

#[test]
fn closed_faces_carry_their_contact_traction() {
    carry_their_contact_traction(&step("[output]\nfields_over_a = [0.0]\n"));
}

#[test]
fn closed_faces_under_a_wheel_that_feels_them_do_so_too() {
    carry_their_contact_traction(&step_under("coupled = true\n", "[output]\nfields_over_a = [0.0]\n"));
}

fn carry_their_contact_traction(record: &StepRecord) {
    // Of the largest traction, between the mean around a face point and the stress at the ends of
    // cells; measured 1e-3.
    const TOLERANCE: f64 = 3e-3;
    let fields = fields(record);
    let snapshot = &fields.snapshots[0];
    let tangent = Vec2::unit(-ANGLE.to_radians());
    let (mut squares, mut count, mut largest, mut closed) = (0.0, 0.0, 0.0f64, 0.0f64);
    for line in &fields.grid.lines {
        // The normal that leaves the body.
        let outwards = match line.face {
            Face::Plus => -tangent.left(),
            Face::Minus => tangent.left(),
        };
        for end in line.ends {
            let traction = snapshot.traction[end];
            largest = largest.max(traction.length());
            closed = closed.min(traction.dot(outwards));
            if (0.1..=0.9).contains(&(fields.grid.points[end].length() / LENGTH)) {
                squares += (snapshot.stress[end].traction(outwards) - traction).length().powi(2);
                count += 1.0;
            }
        }
    }
    let mean = f64::sqrt(squares / count);
    println!("mean difference of stress and contact traction: {} of {largest} MPa", mean / largest);
    assert!(closed < -0.5 * PEAK_PRESSURE, "the crack is closed under the wheel: {closed} MPa");
    assert!(mean < TOLERANCE * largest, "{mean} of {largest} MPa");
}

/// The largest opening at the points of the grid, mm.
fn opening(record: &StepRecord) -> f64 {
    let fields = fields(record);
    let normal = Vec2::unit(-ANGLE.to_radians()).left();
    let pairs = fields.grid.lines.chunks_exact(2);
    let snapshot = &fields.snapshots[0];
    let at = |pair: &[railcrack::body::FieldLine]| {
        assert_eq!((pair[0].face, pair[1].face), (Face::Plus, Face::Minus));
        (snapshot.displacement[pair[0].ends[0]] - snapshot.displacement[pair[1].ends[0]]).dot(normal)
    };
    pairs.map(at).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn a_crack_in_a_block_is_open_when_the_wheel_has_passed() {
    let block = "[rail]\nboundary = \"block\"\n";
    let away = opening(&step(&format!("{block}[output]\nfields_over_a = [6.0]\n")));
    let under = opening(&step(&format!("{block}[output]\nfields_over_a = [0.3]\n")));
    println!("opening {away} mm when the wheel has passed, {under} mm under it");
    assert!(away > 2e-4 && under < 0.1 * away);
}

#[test]
fn fields_come_in_the_steps_and_by_the_engine_that_have_them() {
    assert!(step("[output]\nfields_every = 0\n").fields.is_none());
    assert!(step("[output]\nfields_over_a = []\n").fields.is_none());
    let text = "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.1\n[[crack]]\nmouth_mm = 0\n\
                length_mm = 6\nangle_deg = 15\nfriction = 0\n[growth]\nsteps = 0\n[solver]\nengine = \"dislocation\"\n";
    let case = Case::parse(text, "case.toml", Path::new("")).unwrap();
    assert!(
        PreparedRun::new(&case, None)
            .unwrap()
            .growth(None)
            .next_step(&Unobserved)
            .unwrap()
            .unwrap()
            .fields
            .is_none()
    );
}

//! K does not depend on the position of the mesh lines.

use crate::common::{Meshed, Of, TENSION, buried_crack, close, largest, sifs_under, steel, surface_crack};
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::crack::{Crack, CrackNetwork, End};
use railcrack::math::RailBox;
use railcrack::math::{Stress, Vec2};
use railcrack::mesh::QuadMesh;
use railcrack::xfem::{MeshSettings, RefinedRegion, XfemSettings, cracked_body};
use std::sync::Arc;

/// Difference of K from that on the first mesh, relative to the largest K.
const DIFFERENCE: f64 = 5e-3;
/// Distance of a line from the tip or the mouth, in elements.
const SHIFTS: [f64; 8] = [0.0, 0.1, 0.25, 0.5, 1e-6, -1e-6, 1e-9, -1e-9];

fn nearest(lines: &[f64], at: f64) -> f64 {
    *lines.iter().min_by(|a, b| (*a - at).abs().total_cmp(&(*b - at).abs())).unwrap()
}

/// Lines shifted so that one passes at `at` + `shift`; the ends and the surface stay.
fn moved(lines: &[f64], at: f64, shift: f64) -> Vec<f64> {
    let (old, last) = (nearest(lines, at), lines.len() - 1);
    let by = at + shift - old;
    let mut lines = lines.to_vec();
    for line in &mut lines[1..last] {
        *line = if *line == old { at + shift } else { *line + by };
    }
    lines
}

/// Ordinates stretched away from the surface so that one passes at `at` + `shift`.
fn stretched(lines: &[f64], at: f64, shift: f64) -> Vec<f64> {
    let old = nearest(lines, at);
    let by = (at + shift) / old;
    lines.iter().map(|&line| if line == old { at + shift } else { line * by }).collect()
}

/// K with a vertical line by `shift.x` and a horizontal one by `shift.y` elements from `at`.
fn sifs(crack: &Crack, at: Vec2, shift: Vec2, stress: Stress) -> Vec<f64> {
    let network = CrackNetwork::from(crack.clone());
    let size = Meshed::default().size(std::slice::from_ref(crack));
    let refined = RefinedRegion::new(&network, MeshSettings { element_size: size, expected_growth: 1.0 });
    let mesh = refined.mesh(RailBox { width: 2000.0, depth: 1000.0, centre: 0.0 }).unwrap();
    let x = moved(mesh.x_lines(), at.x, shift.x * size);
    let y =
        if at.y == 0.0 { mesh.y_lines().to_vec() } else { stretched(mesh.y_lines(), at.y, shift.y * size) };
    let rail = Arc::new(BulkRail::new(QuadMesh::new(x, y).unwrap(), &steel(), Boundary::HalfPlane).unwrap());
    sifs_under(&cracked_body(&rail, &network, XfemSettings::default()).unwrap(), |_| stress)
}

fn spread(name: &str, crack: &Crack, at: Vec2, stress: Stress) {
    // Both shifts together, and separately.
    let along = SHIFTS.map(|s| Vec2::new(s, 0.37));
    let across = SHIFTS.map(|s| Vec2::new(0.37, s));
    let both = SHIFTS.map(|s| Vec2::new(s, s));
    let shifts: Vec<Vec2> = if at.y == 0.0 { along.to_vec() } else { [along, across, both].concat() };
    let all: Vec<Vec<f64>> = shifts.iter().map(|&shift| sifs(crack, at, shift, stress)).collect();
    let peak = largest(all[0].iter().copied());
    let difference = largest(all.iter().flat_map(|k| k.iter().zip(&all[0]).map(|(a, b)| a - b))) / peak;
    println!("{name}: {:.4} %", 100.0 * difference);
    close(difference, 0.0, Of(DIFFERENCE, 1.0), name);
}

fn surface_breaking(degrees: f64) {
    let crack = surface_crack(0.0, 6.0, degrees);
    spread(&format!("{degrees}°, at the mouth"), &crack, Vec2::default(), TENSION);
    spread(&format!("{degrees}°, at the tip"), &crack, crack.tip(End::Last), TENSION);
}

#[test]
fn by_fractions_of_an_element() {
    surface_breaking(15.0);
}

#[test]
#[ignore = "extra: a minute; steep, kinked and buried cracks"]
fn by_fractions_of_an_element_in_full() {
    surface_breaking(45.0);
    surface_breaking(90.0);
    let kinked = surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, -1.0).unwrap();
    spread("kinked, at the kink", &kinked, kinked.points()[1], TENSION);
    let buried = buried_crack(Vec2::new(0.0, -20.0), 3.0, 0.0);
    spread(
        "buried along a line, at a tip",
        &buried,
        buried.tip(End::First),
        Stress { yy: 1.0, ..Stress::ZERO },
    );
}

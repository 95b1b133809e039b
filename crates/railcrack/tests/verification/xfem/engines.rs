//! Both engines on the same cracks: C and S by their effect on three smooth tractions.

use crate::common::{Meshed, Of, body, close, largest, surface_crack};
use railcrack::body::CrackedBody;
use railcrack::crack::{Crack, CrackCurve, CrackNetwork, End};
use railcrack::math::{Stress, Vec2};

/// Elements of the dislocation engine: its own error is then below 1e-4.
const ELEMENTS: usize = 120;
/// Difference of jumps relative to the largest, and of K relative to the largest.
const DIFFERENCE: f64 = 5e-3;

/// A named stress of the uncracked rail.
type Loading = (&'static str, fn(Vec2) -> Stress);

fn tractions() -> [Loading; 3] {
    [
        ("tension", |_| Stress { xx: 1.0, ..Stress::ZERO }),
        ("shear and pressure", |_| Stress { yy: 1.0, xy: -0.6, ..Stress::ZERO }),
        ("waves", |p| Stress { xx: (0.8 * p.x).sin(), yy: (1.3 * p.y).cos(), xy: 0.3 * p.x, ..Stress::ZERO }),
    ]
}

/// Parameter g of the curve and slip and opening at the face points of a crack, with the tip.
fn jumps(body: &CrackedBody, curve: &CrackCurve, forces: &[f64]) -> Vec<(f64, [f64; 2])> {
    let jumps = body.compliance.times(forces);
    let at = |(j, point): (usize, &railcrack::body::FacePoint)| {
        (curve.g(point.s), [jumps[2 * j], jumps[2 * j + 1]])
    };
    let mut all: Vec<(f64, [f64; 2])> = body.faces.points.iter().enumerate().map(at).collect();
    all.push((curve.range().1, [0.0; 2]));
    all
}

/// Linear in g between face points, as jumps are.
fn interpolated(jumps: &[(f64, [f64; 2])], g: f64) -> [f64; 2] {
    let i = jumps.partition_point(|jump| jump.0 <= g).clamp(1, jumps.len() - 1);
    let ((a, from), (b, to)) = (jumps[i - 1], jumps[i]);
    let share = (g - a) / (b - a);
    [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

fn compare(name: &str, crack: Crack) {
    let meshed = Meshed::default().body(std::slice::from_ref(&crack));
    let dislocated = body(std::slice::from_ref(&crack), ELEMENTS);
    let curve = CrackCurve::new(&CrackNetwork::from(crack).cracks()[0]);
    for (load, stress) in tractions() {
        let forces = [&meshed.faces, &dislocated.faces].map(|faces| faces.nodal_forces(stress));
        let (own, other) = (jumps(&meshed, &curve, &forces[0]), jumps(&dislocated, &curve, &forces[1]));
        let peak = largest(other.iter().flat_map(|jump| jump.1));
        let jump = largest(own.iter().flat_map(|&(g, w)| {
            let want = interpolated(&other, g);
            [w[0] - want[0], w[1] - want[1]]
        })) / peak;
        let (k, want) = (meshed.sif_influence.times(&forces[0]), dislocated.sif_influence.times(&forces[1]));
        let sif = largest(k.iter().zip(&want).map(|(a, b)| a - b)) / largest(want.iter().copied());
        println!("{name}, {load}: jumps {:.3} %, K {:.3} %", 100.0 * jump, 100.0 * sif);
        close(jump, 0.0, Of(DIFFERENCE, 1.0), "jumps");
        close(sif, 0.0, Of(DIFFERENCE, 1.0), "K");
    }
}

#[test]
fn same_response() {
    for degrees in [15.0, 60.0, 90.0, 135.0] {
        compare(&format!("{degrees}°"), surface_crack(0.0, 6.0, degrees));
    }
    let kinked = surface_crack(0.0, 4.0, 15.0).extended(End::Last, 2.0, f64::to_radians(-60.0)).unwrap();
    compare("kinked", kinked);
}

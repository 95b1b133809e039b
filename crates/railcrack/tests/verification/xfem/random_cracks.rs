//! Random cracks, many of them in awkward positions relative to the mesh, on one mesh: K against
//! the dislocation engine, and the condition of C.

use crate::common::{Of, Random, close, condition, largest, measured_as, sifs_under, steel};
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{self, FaceResolution};
use railcrack::math::{Stress, Vec2};
use railcrack::mesh::QuadMesh;
use railcrack::xfem::{XfemSettings, cracked_body};
use rayon::prelude::*;
use std::sync::Arc;

/// Size of the elements, mm: a power of two, so that nodes lie exactly at integer multiples of it.
const H: f64 = 0.25;
/// Half width and depth of the fine part, mm.
const FINE: (f64, f64) = (8.0, 8.0);
/// Growth of the elements outside.
const GROWTH: f64 = 1.3;
/// Half width and depth of the mesh, mm.
const FAR: f64 = 800.0;

/// Lines from 0 outwards.
fn outwards(fine: f64) -> Vec<f64> {
    let mut lines: Vec<f64> = (0..=(fine / H) as usize).map(|i| i as f64 * H).collect();
    let mut step = H;
    while lines[lines.len() - 1] < FAR {
        step *= GROWTH;
        lines.push(lines[lines.len() - 1] + step);
    }
    lines
}

fn rail() -> Arc<BulkRail> {
    let (x, y) = (outwards(FINE.0), outwards(FINE.1));
    let mirrored = |lines: &[f64]| lines.iter().rev().map(|v| -v).collect::<Vec<f64>>();
    let columns = mirrored(&x).into_iter().chain(x[1..].iter().copied()).collect();
    Arc::new(
        BulkRail::new(QuadMesh::new(columns, mirrored(&y)).unwrap(), &steel(), Boundary::HalfPlane).unwrap(),
    )
}

/// Random cracks for this mesh.
struct Awkward(Random);

impl Awkward {
    /// The point moved to an awkward position relative to the mesh, or left unchanged.
    fn awkward(&mut self, p: Vec2) -> Vec2 {
        let sliver = self.0.pick(&[0.0, 0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3]) * H;
        let (x, y) = ((p.x / H).round() * H, (p.y / H).round() * H);
        match self.0.pick(&[0, 0, 1, 2, 3, 4]) {
            1 => Vec2::new(x + sliver, y),
            2 => Vec2::new(x, y + sliver),
            3 => Vec2::new(x + sliver, p.y),
            4 => Vec2::new(p.x, y + sliver),
            _ => p,
        }
    }

    /// Straight or kinked, from the surface or buried; often through nodes and along lines of the
    /// mesh.
    fn crack(&mut self) -> Option<Crack> {
        let buried = self.0.between(0.0, 1.0) < 0.25;
        let mut points = vec![if buried {
            Vec2::new(self.0.between(-3.0, 3.0), self.0.between(-5.0, -2.5))
        } else {
            Vec2::new(self.0.between(-2.0, 2.0), 0.0)
        }];
        if buried {
            points[0] = self.awkward(points[0]);
        } else {
            points[0].x = self.awkward(points[0]).x;
        }
        let mut angle = -self.0.between(10.0, 170.0);
        if self.0.between(0.0, 1.0) < 0.1 {
            angle = self.0.pick(&[-45.0, -90.0, -135.0]);
        }
        if buried && self.0.between(0.0, 1.0) < 0.3 {
            angle = self.0.pick(&[0.0, 180.0]);
        }
        let segments = self.0.pick(&[1, 1, 2, 3]);
        for segment in 0..segments {
            let last = points[points.len() - 1];
            let length = if segment == 0 { self.0.between(4.0, 6.0) } else { self.0.between(1.0, 2.0) };
            points.push(last + Vec2::unit(f64::to_radians(angle)) * length);
            let end = points.len() - 1;
            points[end] = self.awkward(points[end]);
            angle += self.0.between(-60.0, 60.0);
        }
        let deep =
            points[1..].iter().all(|p| p.y <= -MIN_DEPTH && p.x.abs() < FINE.0 - 1.0 && p.y > 1.0 - FINE.1);
        deep.then(|| Crack::polyline(points).ok()).flatten()
    }
}

/// Least depth of kinks and tips, mm: thin ligaments need smaller elements.
const MIN_DEPTH: f64 = 0.8;
const CRACKS: usize = 1000;
/// Difference of K between the engines, over |K|, with a twentieth of the crack per element.
const ERROR: f64 = 5e-3;
/// Condition number of C scaled to a unit diagonal: 7e3 without kinks, 1e4 with them. Twenty times
/// that would show face points that crowd where no function can follow.
const CONDITION: f64 = 1e5;

/// Opens cracks of every direction.
const STRESS: Stress = Stress { xx: 1.0, yy: 0.8, ..Stress::ZERO };

struct Outcome {
    crack: Crack,
    error: f64,
    /// Condition number of C, infinite where it is not symmetric positive definite.
    condition: f64,
}

fn outcome(rail: &Arc<BulkRail>, crack: Crack) -> Outcome {
    let network = CrackNetwork::from(crack.clone());
    let Ok(body) = cracked_body(rail, &network, XfemSettings::default()).inspect_err(|e| println!("{e}"))
    else {
        return Outcome { crack, error: f64::INFINITY, condition: f64::INFINITY };
    };
    let k = sifs_under(&body, |_| STRESS);
    let reference = dislocation::cracked_body(&network, &steel(), FaceResolution { elements: 48 }).unwrap();
    let want = sifs_under(&reference, |_| STRESS);
    let error = (0..want.len() / 2)
        .map(|tip| {
            let size = want[2 * tip].hypot(want[2 * tip + 1]);
            let scale = size.max(0.3 * largest(want.iter().copied()));
            (k[2 * tip] - want[2 * tip]).hypot(k[2 * tip + 1] - want[2 * tip + 1]) / scale
        })
        .fold(0.0, f64::max);
    Outcome { crack, error, condition: condition(&body.compliance).unwrap_or(f64::INFINITY) }
}

#[test]
fn agree_with_dislocations() {
    let rail = rail();
    println!("{} unknowns", rail.order());
    let mut random = Awkward(Random(1));
    let mut cracks = Vec::new();
    while cracks.len() < CRACKS {
        cracks.extend(random.crack());
    }
    let mut outcomes: Vec<Outcome> = cracks.into_par_iter().map(|crack| outcome(&rail, crack)).collect();
    outcomes.sort_by(|a, b| b.error.total_cmp(&a.error));
    let worst = outcomes.iter().max_by(|a, b| a.condition.total_cmp(&b.condition)).unwrap();
    println!(
        "{CRACKS} cracks: largest error {:.3} %, median {:.3} %, condition number up to {:.1e}",
        100.0 * outcomes[0].error,
        100.0 * outcomes[CRACKS / 2].error,
        worst.condition
    );
    println!("largest error {:?}, condition {:?}", outcomes[0].crack.points(), worst.crack.points());
    close(outcomes[0].error, 0.0, Of(ERROR, 1.0), "a twentieth of the crack per element");
    measured_as("condition", worst.condition, CONDITION, "ten times what was measured; eleven digits remain");
    assert!(worst.condition < CONDITION, "condition number {:.1e}", worst.condition);
}

/// Straight through nodes, where the elements beside the crack are touched at one point; and one
/// bit off a line of the mesh.
#[test]
fn through_nodes_and_along_lines() {
    let rail = rail();
    let cracks = [
        vec![(0.0, 0.0), (4.0, -3.0)],
        vec![(0.0, 0.0), (4.0, -4.0)],
        vec![(0.0, 0.0), (4.1, -4.1)],
        vec![(1.75, 0.0), (-3.75, -1.0)],
        vec![(2.5, -3.25), (-2.5, -3.25)],
        vec![(1.75, 0.0), (1.75, -5.0)],
        vec![(1.75, 0.0), (1.75f64.next_up(), -5.06123711559883), (1.3014017646120795, -6.568187683247835)],
        vec![(1.75, 0.0), (1.75f64.next_down(), -5.06123711559883), (1.3014017646120795, -6.568187683247835)],
        vec![(1.75, 0.0), (1.75f64.next_up(), -5.0)],
        vec![(1.75f64.next_up(), 0.0), (1.75, -5.0)],
    ];
    for points in cracks {
        let points = points.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
        let outcome = outcome(&rail, Crack::polyline(points).unwrap());
        println!("{:.3} %, condition number {:.1e}", 100.0 * outcome.error, outcome.condition);
        close(outcome.error, 0.0, Of(ERROR, 1.0), "a twentieth of the crack per element");
        assert!(outcome.condition < CONDITION, "condition number {:.1e}", outcome.condition);
    }
}

//! Random networks under the wheel, kinked and buried cracks among them: K of both engines at their
//! defaults.

use crate::common::{Meshed, Random, Rolling, StepControl, largest};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, segment_distance};
use railcrack::math::Vec2;

/// Least distance between two cracks, and least depth of kinks and tips, mm.
const APART: f64 = 0.5;
/// Output positions: a property of the initial step, not of its history in detail.
const POSITIONS: usize = 61;

/// A network and what the engines make of it.
pub struct Outcome {
    pub number: u64,
    pub points: Vec<Vec<(f64, f64)>>,
    pub friction: f64,
    pub wheel: f64,
    /// Largest difference of K at any tip and position, over the largest K.
    pub error: f64,
    /// The lowest K_I of the finite elements, over the largest K.
    pub lowest: f64,
    /// What the engines say of their accuracy.
    pub remarks: Vec<String>,
}

/// A crack of up to three segments, from the surface or buried.
fn crack(random: &mut Random) -> Option<Crack> {
    let buried = random.between(0.0, 1.0) < 0.3;
    let mut points = vec![if buried {
        Vec2::new(random.between(-8.0, 8.0), -random.between(1.0, 4.0))
    } else {
        Vec2::new(random.between(-8.0, 8.0), 0.0)
    }];
    let mut angle = -random.between(12.0, 168.0);
    let segments = random.pick(&[1, 1, 2, 3]);
    for segment in 0..segments {
        let length = if segment == 0 { random.between(2.0, 6.0) } else { random.between(0.5, 2.0) };
        points.push(points[segment] + Vec2::unit(f64::to_radians(angle)) * length);
        angle += random.between(5.0, 40.0) * random.pick(&[-1.0, 1.0]);
    }
    let deep = points[1..].iter().all(|p| p.y <= -APART);
    deep.then(|| Crack::polyline(points).ok()).flatten()
}

fn distance(one: &Crack, other: &Crack) -> f64 {
    let segments = |crack: &Crack| crack.points().windows(2).map(|p| (p[0], p[1])).collect::<Vec<_>>();
    let mut nearest = f64::INFINITY;
    for (a, b) in segments(one) {
        for (c, d) in segments(other) {
            nearest = nearest.min(segment_distance(a, b, c, d));
        }
    }
    nearest
}

/// Network number `number`: one to four cracks.
pub fn outcome(number: u64) -> Outcome {
    let mut random = Random(number << 20);
    let count = random.pick(&[1, 2, 3, 4]);
    let mut cracks: Vec<Crack> = Vec::new();
    while cracks.len() < count {
        if let Some(crack) = crack(&mut random)
            && cracks.iter().all(|other| distance(other, &crack) > APART)
        {
            cracks.push(crack);
        }
    }
    let friction = random.pick(&[0.01, 0.1, 0.3, 0.5]);
    let wheel = random.between(-0.3, 0.3);
    let mut rolling = Rolling::over(cracks.clone(), friction, wheel);
    rolling.steps = StepControl { positions: POSITIONS, ..StepControl::default() };
    let histories = |body: &CrackedBody| -> Vec<f64> {
        let problem = FaceProblem::new(body, &vec![friction; count]);
        let result = rolling.on(&problem, &Newton::default());
        let passage = &result.passages[result.passages.len() - 1];
        passage.sifs.iter().flatten().flat_map(|k| [k.ki, k.kii]).collect()
    };
    let network = CrackNetwork::new(cracks.clone()).unwrap();
    let one = Meshed::default().engine_of(&network).body(&network).unwrap();
    let other = rolling.body();
    let (k, want) = (histories(&one), histories(&other));
    let off = largest(k.iter().zip(&want).map(|(a, b)| a - b));
    let points = cracks.iter().map(|crack| crack.points().iter().map(|p| (p.x, p.y)).collect()).collect();
    let remarks = one.remarks.iter().chain(&other.remarks).cloned().collect();
    let lowest = k.iter().step_by(2).fold(0.0f64, |m, k| m.min(*k)) / largest(k.iter().copied());
    Outcome { lowest, number, points, friction, wheel, error: off / largest(want), remarks }
}

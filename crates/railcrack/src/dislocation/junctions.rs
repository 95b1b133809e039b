//! Compatibility of the jumps at junctions of cracks.
//!
//! With the jumps w_k of the arms that end at a junction, those that run towards it counted
//! positive and those that run away from it negative (σ_k = ±1), the displacement is single-valued
//! around the junction if Σ σ_k w_k = 0: only then is the energy finite. n arms have n contact
//! conditions but n − 1 free jumps at the junction, so no set of face points at the junction itself
//! can be dual to them. Instead the last face point of each arm lies at the edge of a small core,
//! and the jump in the core follows from these: constant down to a tenth of its radius, from there
//! linear to p_k = w_k − σ_k (Σ σ_j w_j)/n at the junction, the nearest jumps without a net Burgers
//! vector.

use crate::body::{FaceElement, FaceMesh, FacePoint, FaceSample};
use crate::crack::{CrackCurve, CrackNetwork, End};
use std::sync::Arc;

/// Fraction of the radius of a core over which the jumps of the arms are made compatible. The
/// contact conditions at the edge of the core contain a sixth of this of the tractions of the other
/// arms.
const INNER: f64 = 0.1;
/// Largest radius of a core, over the regular element there.
const CORE: f64 = 0.03;
/// Largest radius of a core, over the distance to the next vertex.
const VERTEX_SHARE: f64 = 0.2;

/// An arm of a junction: one crack on one side of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arm {
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Index of the junction among the points of the crack, from 0.
    pub vertex: usize,
    /// Direction of the crack relative to the junction.
    pub direction: ArmDirection,
}

/// Direction in which the crack traverses an arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArmDirection {
    /// Towards the junction.
    Towards,
    /// Away from it.
    Away,
}

impl ArmDirection {
    fn sign(self) -> f64 {
        match self {
            Self::Towards => 1.0,
            Self::Away => -1.0,
        }
    }
}

/// A junction with its core, in which the jumps follow from those at its edge.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Core {
    /// Arc length from the junction to the last face point of each arm, mm.
    pub radius: f64,
    /// The arms.
    pub arms: Vec<Arm>,
}

impl Core {
    /// Arc length from the junction to the point at which the jumps begin to change, mm.
    pub(crate) fn inner(&self) -> f64 {
        INNER * self.radius
    }

    /// Whether this core lies on `crack` at its point `vertex`.
    pub(crate) fn is_at(&self, crack: usize, vertex: usize) -> bool {
        self.arms.iter().any(|arm| arm.crack == crack && arm.vertex == vertex)
    }
}

/// The cores of all junctions, where elements away from them are `element(crack, g)` (mm) long.
pub(super) fn cores(
    network: &CrackNetwork,
    curves: &[CrackCurve],
    element: impl Fn(usize, f64) -> f64,
) -> Vec<Core> {
    let core = |point: &crate::crack::JunctionPoint| {
        let mut arms = Vec::new();
        for end in &point.ends {
            let (vertex, direction) = match end.end {
                End::First => (0, ArmDirection::Away),
                End::Last => (curves[end.crack].segments(), ArmDirection::Towards),
            };
            arms.push(Arm { crack: end.crack, vertex, direction });
        }
        if let Some(passing) = point.through {
            let arm = |direction| Arm { crack: passing.crack, vertex: passing.vertex, direction };
            arms.extend([arm(ArmDirection::Towards), arm(ArmDirection::Away)]);
        }
        let largest = |arm: &Arm| {
            let curve = &curves[arm.crack];
            let next = match arm.direction {
                ArmDirection::Towards => arm.vertex - 1,
                ArmDirection::Away => arm.vertex + 1,
            };
            let segment = (curve.arc_length_at(arm.vertex) - curve.arc_length_at(next)).abs();
            (CORE * element(arm.crack, curve.vertices()[arm.vertex])).min(VERTEX_SHARE * segment)
        };
        let radius = arms.iter().map(largest).fold(f64::INFINITY, f64::min);
        Core { radius, arms }
    };
    network.junction_points().iter().map(core).collect()
}

/// Nodal jumps of a mesh without compatibility at junctions, in terms of the free jumps at the face
/// points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ties {
    /// For each node the face points on which it depends, with the factors of their jumps in the
    /// common frame.
    follows: Vec<Vec<(usize, f64)>>,
    /// For each node the face point of its own arm.
    own: Vec<usize>,
}

impl Ties {
    /// The face points on which node `node` depends, with their factors.
    pub(crate) fn of(&self, node: usize) -> &[(usize, f64)] {
        &self.follows[node]
    }

    /// The ties of `cores` between the nodes of `elements`, which are the points of `faces`; and
    /// the points that remain free, which carry the tractions of the others.
    pub(crate) fn new(
        cores: &[Core],
        curves: &[CrackCurve],
        elements: &[FaceElement],
        faces: &FaceMesh,
    ) -> (Self, FaceMesh) {
        let count = faces.points.len();
        let mut follows: Vec<Vec<(usize, f64)>> = (0..count).map(|i| vec![(i, 1.0)]).collect();
        let mut own: Vec<usize> = (0..count).collect();
        for core in cores {
            let nodes: Vec<ArmNodes> =
                core.arms.iter().map(|arm| ArmNodes::of(arm, curves, elements)).collect();
            let share = 1.0 / core.arms.len() as f64;
            for (arm, &ArmNodes { edge, inner, junction }) in core.arms.iter().zip(&nodes) {
                follows[inner] = vec![(edge, 1.0)];
                let factor = |(other, nodes): (&Arm, &ArmNodes)| {
                    let own = if other == arm { 1.0 } else { 0.0 };
                    (nodes.edge, own - arm.direction.sign() * other.direction.sign() * share)
                };
                follows[junction] = core.arms.iter().zip(&nodes).map(factor).collect();
                own[inner] = edge;
                own[junction] = edge;
            }
        }
        let free: Vec<usize> = (0..count).filter(|&i| own[i] == i).collect();
        let number = |old: usize| free.binary_search(&old).expect("a free point");
        for (node, _) in follows.iter_mut().flatten() {
            *node = number(*node);
        }
        for node in &mut own {
            *node = number(*node);
        }
        let ties = Self { follows, own };
        let points = free.iter().map(|&i| FacePoint { weight: 0.0, ..faces.points[i] }).collect();
        let reduced = ties.reduced(points, faces);
        (ties, reduced)
    }

    fn reduced(&self, mut points: Vec<FacePoint>, faces: &FaceMesh) -> FaceMesh {
        // The length of a point covers its own arm only, because the shares from other arms have
        // other directions.
        for (&own, point) in self.own.iter().zip(&faces.points) {
            points[own].weight += point.weight;
        }
        let (samples, graded) = (self.shared(&faces.samples), self.shared(&faces.graded));
        FaceMesh { points, samples, graded, lines: Arc::clone(&faces.lines) }
    }

    /// `of_nodes` with the shares of face points instead of those of nodes.
    fn shared(&self, of_nodes: &[FaceSample]) -> Vec<FaceSample> {
        let mut samples = Vec::new();
        for sample in of_nodes {
            let mut shares: Vec<(usize, f64)> = Vec::new();
            for (node, length) in sample.shares.into_iter().filter(|(_, length)| *length != 0.0) {
                for &(point, factor) in self.of(node) {
                    match shares.iter_mut().find(|share| share.0 == point) {
                        Some(share) => share.1 += factor * length,
                        None => shares.push((point, factor * length)),
                    }
                }
            }
            // A sample has two shares; further shares need another sample at the same position.
            for pair in shares.chunks(2) {
                let shares = [pair[0], pair.get(1).copied().unwrap_or((0, 0.0))];
                samples.push(FaceSample { shares, ..*sample });
            }
        }
        samples
    }
}

/// The nodes of one arm in a core: at its edge, at its inner edge, where the jump begins to change,
/// and at the junction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ArmNodes {
    edge: usize,
    inner: usize,
    junction: usize,
}

impl ArmNodes {
    fn of(arm: &Arm, curves: &[CrackCurve], elements: &[FaceElement]) -> Self {
        let g = curves[arm.crack].vertices()[arm.vertex];
        let own: Vec<&FaceElement> = elements.iter().filter(|element| element.crack == arm.crack).collect();
        let (nearest, next, near, far) = match arm.direction {
            ArmDirection::Towards => {
                let after = own.partition_point(|element| element.range.1 <= g);
                (own[after - 1], own[after - 2], 1, 0)
            }
            ArmDirection::Away => {
                let before = own.partition_point(|element| element.range.0 < g);
                (own[before], own[before + 1], 0, 1)
            }
        };
        let node = |element: &FaceElement, end: usize| element.ends[end].expect("a core holds no tip");
        Self { edge: node(next, far), inner: node(nearest, far), junction: node(nearest, near) }
    }
}

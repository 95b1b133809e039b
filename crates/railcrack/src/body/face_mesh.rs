//! Face points, the elements between them, and flaps that are too thin.

use crate::crack::{Crack, CrackCurve, CrackNetwork, End};
use crate::field::{CrackLine, PlaceOnCrack};
use crate::math::{Stress, Vec2, gauss_legendre};
use std::sync::Arc;

/// A face point: where the contact conditions hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Index of its crack in the network, from 0.
    pub crack: usize,
    /// Index of the straight segment of the crack, from 0.
    pub segment: usize,
    /// Arc length from the crack's first point, mm.
    pub s: f64,
    /// Position, mm.
    pub position: Vec2,
    /// x1, along the curve; x2 is x1 turned by +90°.
    pub tangent: Vec2,
    /// Length of face that belongs to the point, mm: nodal force / weight = traction.
    pub weight: f64,
}

/// A quadrature point of the faces, for the nodal forces of a stress field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceSample {
    /// Position, mm.
    pub point: Vec2,
    /// Index of its crack in the network of the whole body, from 0.
    pub crack: usize,
    /// Arc length from the crack's first point, mm.
    pub s: f64,
    /// x2 of the face at this point; the traction is σ·x2.
    pub normal: Vec2,
    /// Face points that share the traction, each with its share (mm of face length); 0 for a point
    /// without a share.
    pub shares: [(usize, f64); 2],
}

/// The face points and the quadrature between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaceMesh {
    /// The face points, crack by crack along the curve.
    pub points: Vec<FacePoint>,
    /// The quadrature points.
    pub samples: Vec<FaceSample>,
    /// Quadrature points for tractions that vary over lengths comparable to the depth: the same
    /// shape functions, integrated over parts that are no longer than their depth. Empty in a body
    /// made by groups.
    pub graded: Vec<FaceSample>,
    /// The cracks of the whole body.
    pub lines: Arc<[CrackLine]>,
}

impl FaceSample {
    /// Its place on its crack.
    #[must_use]
    pub fn place(&self) -> PlaceOnCrack {
        PlaceOnCrack { point: self.point, crack: self.crack, s: self.s }
    }
}

impl FaceMesh {
    /// Nodal forces on the + faces, N/mm, that remove a transmitted stress σ: ∫ φ_j σ·x2 ds in the
    /// frame of point j, `[2 j]` along x1, `[2 j + 1]` along x2. `stress` gives σ (MPa) at a point
    /// (mm).
    #[must_use]
    pub fn nodal_forces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_of_samples(|_, point| stress(point))
    }

    /// [`FaceMesh::nodal_forces`] of a stress that is known by the index of the sample, from 0.
    #[must_use]
    pub fn nodal_forces_of_samples(&self, stress: impl Fn(usize, Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_on(&self.samples, stress)
    }

    /// [`FaceMesh::nodal_forces`] of a stress that varies over lengths comparable to the depth.
    pub(crate) fn graded_nodal_forces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_on(&self.graded, |_, point| stress(point))
    }

    fn nodal_forces_on(&self, samples: &[FaceSample], stress: impl Fn(usize, Vec2) -> Stress) -> Vec<f64> {
        // Summed in x and y first, because a point has one frame for all of its shares.
        let mut forces = vec![0.0; 2 * self.points.len()];
        for (k, sample) in samples.iter().enumerate() {
            let traction = stress(k, sample.point).traction(sample.normal);
            for (point, length) in sample.shares {
                forces[2 * point] += length * traction.x;
                forces[2 * point + 1] += length * traction.y;
            }
        }
        for (force, point) in forces.as_chunks_mut::<2>().0.iter_mut().zip(&self.points) {
            let sum = Vec2::new(force[0], force[1]);
            *force = [sum.dot(point.tangent), sum.dot(point.tangent.left())];
        }
        forces
    }
}

/// A straight part of an element, between two nodes or kinks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacePiece {
    /// Index of its crack in the network, from 0.
    pub crack: usize,
    /// Index of the straight segment of the crack, from 0.
    pub segment: usize,
    /// Range of the parameter g.
    pub range: (f64, f64),
    /// Ends, mm.
    pub ends: (Vec2, Vec2),
}

/// An element of the faces between two neighbouring nodes, on which jumps are linear in g. `ends`
/// are its face points; there is none at a tip.
#[derive(Debug, Clone)]
pub(crate) struct FaceElement {
    /// Index of its crack in the network, from 0.
    pub crack: usize,
    /// Range of the parameter g of its crack's [`CrackCurve`].
    pub range: (f64, f64),
    /// Face points at its two ends.
    pub ends: [Option<usize>; 2],
    /// Its straight parts.
    pub pieces: Vec<FacePiece>,
}

/// The elements of all cracks and their face points, which are all nodes except the tips. `nodes`
/// are the values of g, ends included, for each curve; a repeated value is a vertex at which the
/// jump may change abruptly, with a face point on each side.
pub(crate) fn discretise(curves: &[CrackCurve], nodes: &[Vec<f64>]) -> (Vec<FaceElement>, FaceMesh) {
    let mut elements = Vec::new();
    let line = |curve: &CrackCurve| CrackLine {
        points: curve.points().to_vec(),
        tips: [End::First, End::Last].map(|end| curve.has_tip(end)),
        width: f64::INFINITY,
    };
    let mut faces = FaceMesh { lines: curves.iter().map(line).collect(), ..FaceMesh::default() };
    for (crack, (curve, nodes)) in curves.iter().zip(nodes).enumerate() {
        let vertices = curve.vertices();
        let last = nodes.len() - 1;
        let has_point =
            |i: usize| !(i == 0 && curve.has_tip(End::First) || i == last && curve.has_tip(End::Last));
        let mut previous = None;
        for (i, &g) in nodes.iter().enumerate() {
            let breaks = i > 0 && nodes[i - 1] == g;
            let point = has_point(i).then(|| {
                let segment = curve.segment_at(g, &vertices) + usize::from(breaks);
                let tangent = curve.tangent(segment);
                // The mouth is taken from the crack, to keep it free of round-off.
                let (s, position) = if i == 0 {
                    (0.0, curve.first_point())
                } else {
                    (curve.s(g), curve.position(segment, g))
                };
                faces.points.push(FacePoint { crack, segment, s, position, tangent, weight: 0.0 });
                faces.points.len() - 1
            });
            if i > 0 && !breaks {
                let range = (nodes[i - 1], g);
                let pieces = pieces(curve, crack, range, &vertices);
                elements.push(FaceElement { crack, range, ends: [previous, point], pieces });
            }
            previous = point;
        }
    }
    sample_faces(curves, &elements, &mut faces);
    smooth_tangents(curves, &elements, &mut faces);
    (elements, faces)
}

/// Kinks below this angle (radians) are smooth for the jump: their corner exponent is within 1e-3
/// of one.
pub(crate) const SMALL_KINK: f64 = 0.05;

/// Turns the frames of face points to the mean direction of the faces over their elements, as far
/// as these turn smoothly: a polyline of slight kinks stands for a curve, and the frames of its
/// segments would depend on where its points lie between the nodes.
fn smooth_tangents(curves: &[CrackCurve], elements: &[FaceElement], faces: &mut FaceMesh) {
    let mut sums = vec![Vec2::new(0.0, 0.0); faces.points.len()];
    for element in elements {
        let curve = &curves[element.crack];
        let width = element.range.1 - element.range.0;
        for (end, point) in element.ends.iter().enumerate() {
            let Some(point) = *point else { continue };
            let own = faces.points[point].segment;
            for piece in &element.pieces {
                let (low, high) = (own.min(piece.segment), own.max(piece.segment));
                if (low + 1..=high).any(|vertex| curve.turn(vertex) > SMALL_KINK) {
                    continue;
                }
                // The integral of the shape function, which is linear in g, over the arc.
                let middle = 0.5 * (piece.range.0 + piece.range.1);
                let towards_end = (middle - element.range.0) / width;
                let share = if end == 0 { 1.0 - towards_end } else { towards_end };
                let length = (piece.ends.1 - piece.ends.0).length();
                sums[point] = sums[point] + curve.tangent(piece.segment) * (share * length);
            }
        }
    }
    for (point, sum) in faces.points.iter_mut().zip(sums) {
        let turn = point.tangent.cross(sum).abs();
        if turn > 1e-9 * sum.length() {
            point.tangent = sum.normalised();
        }
    }
}

fn pieces(curve: &CrackCurve, crack: usize, range: (f64, f64), vertices: &[f64]) -> Vec<FacePiece> {
    let mut cuts = vec![range.0];
    cuts.extend(vertices.iter().copied().filter(|&v| v > range.0 && v < range.1));
    cuts.push(range.1);
    cuts.windows(2)
        .map(|cut| {
            let segment = curve.segment_at(0.5 * (cut[0] + cut[1]), vertices);
            let ends = (curve.position(segment, cut[0]), curve.position(segment, cut[1]));
            FacePiece { crack, segment, range: (cut[0], cut[1]), ends }
        })
        .collect()
}

/// Gauss points per piece for the nodal forces of a field; ds/dg and the shape functions are
/// polynomials.
const FACE_POINTS: usize = 3;
/// Gauss points on each part of a piece near the running surface. A part is no longer than its
/// depth, so that the error for a traction that is singular on the surface is below 1e-5 of it.
const GRADED_POINTS: usize = 4;
/// Number of bisections after which a part is as short as it gets, 1e-4 of a piece.
const MOST_BISECTIONS: u32 = 13;

fn sample_faces(curves: &[CrackCurve], elements: &[FaceElement], faces: &mut FaceMesh) {
    let rule = gauss_legendre(FACE_POINTS);
    let graded_rule = gauss_legendre(GRADED_POINTS);
    for element in elements {
        let curve = &curves[element.crack];
        for piece in &element.pieces {
            for sample in samples(curve, element, piece, piece.range, &rule) {
                for (point, length) in sample.shares {
                    faces.points[point].weight += length;
                }
                faces.samples.push(sample);
            }
            for part in graded(curve, piece, piece.range, 0) {
                faces.graded.extend(samples(curve, element, piece, part, &graded_rule));
            }
        }
    }
}

/// Quadrature points of `rule` on the `range` of g, which is part of a piece of `element`.
fn samples<'a>(
    curve: &'a CrackCurve,
    element: &'a FaceElement,
    piece: &'a FacePiece,
    range: (f64, f64),
    rule: &'a [(f64, f64)],
) -> impl Iterator<Item = FaceSample> + 'a {
    let width = range.1 - range.0;
    rule.iter().map(move |&(t, w)| {
        let g = range.0 + t * width;
        let length = w * width * curve.ds(g);
        let towards_end = (g - element.range.0) / (element.range.1 - element.range.0);
        let shares = [(element.ends[0], 1.0 - towards_end), (element.ends[1], towards_end)];
        let shares = shares.map(|(point, share)| (point.unwrap_or(0), point.map_or(0.0, |_| share * length)));
        let normal = curve.tangent(piece.segment).left();
        FaceSample {
            point: curve.position(piece.segment, g),
            crack: piece.crack,
            s: curve.s(g),
            normal,
            shares,
        }
    })
}

/// The `range` of g on `piece`, bisected until no part is longer than its depth.
fn graded(curve: &CrackCurve, piece: &FacePiece, range: (f64, f64), bisections: u32) -> Vec<(f64, f64)> {
    let depth = |g: f64| -curve.position(piece.segment, g).y;
    let length = curve.s(range.1) - curve.s(range.0);
    if bisections == MOST_BISECTIONS || length <= depth(range.0).min(depth(range.1)) {
        return vec![range];
    }
    let middle = 0.5 * (range.0 + range.1);
    let mut parts = graded(curve, piece, (range.0, middle), bisections + 1);
    parts.extend(graded(curve, piece, (middle, range.1), bisections + 1));
    parts
}

/// Depth of a surface-breaking crack over its length below which the flap above it is too thin to
/// be resolved: that of 1.5°.
const THIN: f64 = 0.026;

/// Remarks on the cracks of `network` below such flaps. `per_cent` is the error of K of the engine
/// at 1°, in % of the peak; `remedy` names the change that resolves the flap.
pub(crate) fn thin_flaps(network: &CrackNetwork, per_cent: u32, remedy: &str) -> Vec<String> {
    let cracks = network.cracks().iter().enumerate();
    let thin = cracks.filter(|(_, c)| c.is_surface_breaking() && c.depth() < THIN * c.length());
    let remark = |(i, crack): (usize, &Crack)| {
        format!(
            "crack {}: over its length of {:.3} mm it is nowhere deeper than {:.3} mm; the thin flap above it bends, and its K is known to {per_cent} % \
             of the peak at 1°, less well below; {remedy} resolve it",
            i + 1,
            crack.length(),
            crack.depth()
        )
    };
    thin.map(remark).collect()
}

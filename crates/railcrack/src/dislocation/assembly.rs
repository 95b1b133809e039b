//! The elastic energy of jumps that are linear in g between the nodes.

use super::integrals::{Piece, Rules, pair_integral};
use super::kernel::Interaction;
use super::walk::Walk;
use crate::body::{FaceMesh, FaceSample, MeshPoint};
use crate::math::{Matrix, gauss_legendre};
use rayon::prelude::*;

/// An element between two neighbouring nodes; `ends` are its face points, none at a tip.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub crack: usize,
    pub range: (f64, f64),
    pub ends: [Option<usize>; 2],
    pub pieces: Vec<Piece>,
}

/// The elements of all cracks and their face points: every node but the tips.
pub(super) fn discretise(walks: &[Walk], nodes: &[Vec<f64>]) -> (Vec<Element>, FaceMesh) {
    let mut elements = Vec::new();
    let mut faces = FaceMesh::default();
    for (crack, (walk, nodes)) in walks.iter().zip(nodes).enumerate() {
        let vertices = walk.vertices();
        let last = nodes.len() - 1;
        let has_point = |i: usize| i != last && (i != 0 || walk.is_surface_breaking());
        let mut previous = None;
        for (i, &g) in nodes.iter().enumerate() {
            let point = has_point(i).then(|| {
                let segment = walk.segment_at(g, &vertices);
                let tangent = walk.tangent(segment);
                // The mouth is where the crack says, free of round-off.
                let (s, position) =
                    if i == 0 { (0.0, walk.first_point()) } else { (walk.s(g), walk.position(segment, g)) };
                faces.points.push(MeshPoint { crack, segment, s, position, tangent, weight: 0.0 });
                faces.points.len() - 1
            });
            if i > 0 {
                let range = (nodes[i - 1], g);
                let pieces = pieces(walk, crack, range, &vertices);
                elements.push(Element { crack, range, ends: [previous, point], pieces });
            }
            previous = point;
        }
    }
    sample_faces(walks, &elements, &mut faces);
    (elements, faces)
}

fn pieces(walk: &Walk, crack: usize, range: (f64, f64), vertices: &[f64]) -> Vec<Piece> {
    let mut cuts = vec![range.0];
    cuts.extend(vertices.iter().copied().filter(|&v| v > range.0 && v < range.1));
    cuts.push(range.1);
    cuts.windows(2)
        .map(|cut| {
            let segment = walk.segment_at(0.5 * (cut[0] + cut[1]), vertices);
            let ends = (walk.position(segment, cut[0]), walk.position(segment, cut[1]));
            Piece { crack, segment, range: (cut[0], cut[1]), ends }
        })
        .collect()
}

/// Gauss points per piece for the nodal forces of a field; ds/dg and the shape functions are polynomials.
const FACE_POINTS: usize = 3;

fn sample_faces(walks: &[Walk], elements: &[Element], faces: &mut FaceMesh) {
    let rule = gauss_legendre(FACE_POINTS);
    for element in elements {
        let walk = &walks[element.crack];
        for piece in &element.pieces {
            let width = piece.range.1 - piece.range.0;
            for &(t, w) in &rule {
                let g = piece.range.0 + t * width;
                let length = w * width * walk.ds(g);
                let towards_end = (g - element.range.0) / (element.range.1 - element.range.0);
                let shares = [(element.ends[0], 1.0 - towards_end), (element.ends[1], towards_end)];
                let shares =
                    shares.map(|(point, share)| (point.unwrap_or(0), point.map_or(0.0, |_| share * length)));
                for (point, length) in shares {
                    faces.points[point].weight += length;
                }
                let normal = walk.tangent(piece.segment).left();
                faces.samples.push(FaceSample { point: walk.position(piece.segment, g), normal, shares });
            }
        }
    }
}

/// A: the energy ½ wᵀ A w of the nodal jumps w (slip and opening, mm), N/mm per mm, for E′ = `modulus` MPa.
///
/// A_jk = E′/(8π) ∬ φ_j′ E(z, z′) φ_k′ dg dg′ with the hat functions φ: weakly singular because jumps are continuous
/// and dislocations on the surface do nothing, so that the mouth needs no care.
pub(super) fn stiffness(walks: &[Walk], elements: &[Element], faces: &FaceMesh, modulus: f64) -> Matrix {
    let rules = Rules::new();
    let blocks: Vec<Vec<Interaction>> = (0..elements.len())
        .into_par_iter()
        .map(|i| (0..=i).map(|j| element_integral(walks, &elements[i], &elements[j], &rules)).collect())
        .collect();
    let points = faces.points.len();
    let mut global = Matrix::zeros(2 * points, 2 * points);
    for (i, row) in blocks.iter().enumerate() {
        for (j, block) in row.iter().enumerate() {
            scatter(&mut global, &elements[i], &elements[j], *block);
            if i != j {
                scatter(&mut global, &elements[j], &elements[i], [block[0], block[2], block[1], block[3]]);
            }
        }
    }
    let scale = modulus / (8.0 * std::f64::consts::PI);
    in_face_frames(&global, faces, scale)
}

fn element_integral(walks: &[Walk], a: &Element, b: &Element, rules: &Rules) -> Interaction {
    let mut sum = [0.0; 4];
    for piece in &a.pieces {
        for other in &b.pieces {
            let pair = pair_integral(walks, piece, other, rules);
            for k in 0..4 {
                sum[k] += pair[k];
            }
        }
    }
    let slopes = 1.0 / ((a.range.1 - a.range.0) * (b.range.1 - b.range.0));
    sum.map(|e| e * slopes)
}

fn scatter(global: &mut Matrix, a: &Element, b: &Element, block: Interaction) {
    for (p, sign_p) in a.ends.iter().zip([-1.0, 1.0]) {
        for (q, sign_q) in b.ends.iter().zip([-1.0, 1.0]) {
            if let (Some(p), Some(q)) = (p, q) {
                let sign = sign_p * sign_q;
                for k in 0..4 {
                    global[(2 * p + k / 2, 2 * q + k % 2)] += sign * block[k];
                }
            }
        }
    }
}

/// Rotates x and y components to slip and opening at each face point, and symmetrises to round-off.
fn in_face_frames(global: &Matrix, faces: &FaceMesh, scale: f64) -> Matrix {
    let points = faces.points.len();
    let mut local = Matrix::zeros(2 * points, 2 * points);
    for p in 0..points {
        let frame = [faces.points[p].tangent, faces.points[p].tangent.left()];
        for q in 0..=p {
            let other = [faces.points[q].tangent, faces.points[q].tangent.left()];
            for (a, e) in frame.iter().enumerate() {
                for (b, f) in other.iter().enumerate() {
                    let g = |i: usize, j: usize| global[(2 * p + i, 2 * q + j)];
                    let value = scale
                        * (e.x * (g(0, 0) * f.x + g(0, 1) * f.y) + e.y * (g(1, 0) * f.x + g(1, 1) * f.y));
                    local[(2 * p + a, 2 * q + b)] = value;
                    local[(2 * q + b, 2 * p + a)] = value;
                }
            }
        }
    }
    local
}

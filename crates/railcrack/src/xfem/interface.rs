//! Face points of the finite-element engine, and traces of the enriched functions on the faces.

use super::cuts::{CrackPiece, Cuts, SHARP_KINK};
use super::path::{junctions_on, leave_junctions};
use crate::body::{FaceElement, FaceMesh, discretise};
use crate::crack::{CrackCurve, CrackNetwork, End};
use crate::math::{Matrix, Vec2, axpy, gauss_legendre, quantiles};
use crate::mesh::QuadMesh;

/// The face points of a network, with quadrature points that refer to the cells at both faces.
#[derive(Debug, Clone)]
pub(super) struct Interface {
    pub faces: FaceMesh,
    pub stations: Vec<Station>,
    elements: Vec<FaceElement>,
    curves: Vec<CrackCurve>,
}

/// Face points at the ends of an element, and their weights.
type Shares = [(usize, f64); 2];

/// A quadrature point of the faces. Jumps are ⟦w⟧ = Σ ψ_j w_j with ψ linear in g and zero at a tip;
/// tractions are Σ λ_j τ_j with λ = ψ, except in the element at a tip, where the traction is
/// constant at its value at the other end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Station {
    /// Index of the piece of crack.
    pub piece: usize,
    pub point: Vec2,
    /// Length of face, mm.
    pub length: f64,
    /// (face point, ψ).
    pub jumps: Shares,
    /// (face point, λ).
    pub tractions: Shares,
}

/// Distance between face points, over the length of crack in an element: quadratic jumps support
/// two points per element, and with one the pressures do not oscillate.
const SPACING: f64 = 1.0;
/// Step of √r next to a tip, over the root of the length of crack in the element there: points at
/// 0.16, 0.64, 1.44 of an element. With steps of a third, K at a locked tip changes by up to 3 % of
/// its peak as the last part of the crack begins to slip; with a quarter, pressures oscillate.
const TIP_STEP: f64 = 0.4;
/// Length of the element across a kink, over the regular one.
const KINK_SPACING: f64 = 0.15;
/// Length of the element across a kink without √r functions, over the regular one.
const SMALL_KINK_SPACING: f64 = 0.5;
/// Distance of a small kink from the next one or the end of the crack, over the regular element,
/// beyond which it has points of its own. Pressures oscillate on points that are denser than the
/// jump functions: at half an element from the tip the error of K was 7 to 30 %.
const KINK_ROOM: f64 = 3.0;
/// Growth of the distance of face points away from a kink: length per distance.
const KINK_GRADING: f64 = 0.5;
/// Length of the element next to a junction, over the regular one.
const JUNCTION_SPACING: f64 = 0.5;
/// Kinks below this angle (radians) are smooth for the jump.
const SMALL_KINK: f64 = 0.05;
/// Gauss points on each intersection of face element and cut element: jumps are of degree 5 in g,
/// times ψ and ds/dg.
const GAUSS: usize = 6;

impl Interface {
    /// Face points at a distance `spacing` (mm), or as dense as the elements for `None`.
    pub(super) fn new(mesh: &QuadMesh, network: &CrackNetwork, cuts: &Cuts, spacing: Option<f64>) -> Self {
        let curves = network.curves();
        let joined: Vec<Vec<usize>> = (0..curves.len()).map(|crack| junctions_on(network, crack)).collect();
        let nodes: Vec<Vec<f64>> =
            curves.iter().zip(&joined).map(|(curve, joined)| nodes(mesh, curve, joined, spacing)).collect();
        let (mut elements, mut faces) = discretise(&curves, &nodes);
        leave_junctions(&curves, &joined, &mut elements, &mut faces);
        let mut interface = Self { faces, stations: Vec::new(), elements, curves };
        interface.stations = interface.stations_of(cuts);
        interface
    }

    fn stations_of(&self, cuts: &Cuts) -> Vec<Station> {
        let rule = gauss_legendre(GAUSS);
        let mut stations = Vec::new();
        self.common_pieces(cuts, |common| {
            let curve = &self.curves[common.element.crack];
            for &(t, weight) in &rule {
                let g = common.g.0 + t * (common.g.1 - common.g.0);
                let length = weight * (common.g.1 - common.g.0) * curve.ds(g);
                let point = point_on(&cuts.pieces[common.piece], curve.s(g));
                let (jumps, tractions) = shares(common.element, g);
                stations.push(Station { piece: common.piece, point, length, jumps, tractions });
            }
        });
        stations
    }

    /// The faces as straight lines between face points and the ends of the pieces.
    pub(super) fn lines(&self, cuts: &Cuts) -> Vec<StraightLine> {
        let mut lines = Vec::new();
        self.common_pieces(cuts, |CommonPiece { element, piece, g }| {
            let curve = &self.curves[element.crack];
            let ends = [g.0, g.1].map(|g| point_on(&cuts.pieces[piece], curve.s(g)));
            let tractions = [g.0, g.1].map(|g| shares(element, g).1);
            lines.push(StraightLine { piece, ends, tractions });
        });
        lines
    }

    /// Visits the intersections of face elements and pieces of crack, along the curves.
    fn common_pieces<'a>(&'a self, cuts: &Cuts, mut visit: impl FnMut(CommonPiece<'a>)) {
        for (crack, curve) in self.curves.iter().enumerate() {
            let first = cuts.pieces.partition_point(|piece| piece.crack < crack);
            let last = cuts.pieces.partition_point(|piece| piece.crack <= crack);
            let mut piece = first;
            for element in self.elements.iter().filter(|element| element.crack == crack) {
                let (from, to) = (curve.s(element.range.0), curve.s(element.range.1));
                while piece > first && cuts.pieces[piece].s.0 > from {
                    piece -= 1;
                }
                while piece < last && cuts.pieces[piece].s.0 < to {
                    let part = &cuts.pieces[piece];
                    if part.s.1 > from {
                        let at = |s: f64, end: f64, own: f64| if s == own { end } else { curve.g(s) };
                        let g = (
                            at(part.s.0.max(from), element.range.0, from),
                            at(part.s.1.min(to), element.range.1, to),
                        );
                        visit(CommonPiece { element, piece, g });
                    }
                    piece += 1;
                }
                piece = piece.min(last).max(first + 1) - 1;
            }
        }
    }

    /// G with G_jk = ∫ λ_j ψ_k ds and the frames of the faces.
    pub(super) fn duality(&self) -> Duality {
        let points = &self.faces.points;
        let mut bands = vec![[0.0; 3]; points.len()];
        for station in &self.stations {
            for (j, lambda) in station.tractions {
                for (k, psi) in station.jumps {
                    if lambda != 0.0 && psi != 0.0 {
                        bands[j][k + 1 - j] += station.length * lambda * psi;
                    }
                }
            }
        }
        for i in 1..points.len() {
            bands[i][0] /= bands[i - 1][1];
            bands[i][1] -= bands[i][0] * bands[i - 1][2];
        }
        Duality { bands, tangents: points.iter().map(|point| point.tangent).collect() }
    }
}

/// Maps integrals over the faces to jumps at face points, and nodal forces at face points to
/// tractions.
#[derive(Debug, Clone)]
pub(super) struct Duality {
    /// The factors of the tridiagonal G: per row the entry of the lower factor, the pivot, and the
    /// superdiagonal entry.
    bands: Vec<[f64; 3]>,
    /// x1 of each face point.
    tangents: Vec<Vec2>,
}

impl Duality {
    /// G⁻¹ b in the frames of the faces: slip and opening at the face points from b_j = ∫ λ_j ⟦w⟧
    /// ds along x and y. `b[j]` may be a row of any length.
    pub(super) fn nodal_jumps(&self, mut b: Matrix) -> Matrix {
        let points = self.bands.len();
        for i in 1..points {
            let factor = self.bands[i][0];
            if factor != 0.0 {
                for axis in 0..2 {
                    let (above, row) = b.row_pair(2 * (i - 1) + axis, 2 * i + axis);
                    axpy(-factor, above, row);
                }
            }
        }
        for i in (0..points).rev() {
            for axis in 0..2 {
                if i + 1 < points && self.bands[i][2] != 0.0 {
                    let (below, row) = b.row_pair(2 * (i + 1) + axis, 2 * i + axis);
                    axpy(-self.bands[i][2], below, row);
                }
                let pivot = self.bands[i][1];
                b.row_mut(2 * i + axis).iter_mut().for_each(|value| *value /= pivot);
            }
        }
        for (i, x1) in self.tangents.iter().enumerate() {
            let x2 = x1.left();
            let (x, y) = b.row_pair(2 * i, 2 * i + 1);
            // Row y is written last, because both rows are read.
            let turned: Vec<f64> = x.iter().zip(&*y).map(|(x, y)| x1.x * x + x1.y * y).collect();
            y.iter_mut().zip(x).for_each(|(y, x)| *y = x2.x * x + x2.y * *y);
            b.row_mut(2 * i).copy_from_slice(&turned);
        }
        b
    }

    /// The coefficients τ_j (x and y, MPa) of the tractions Σ λ_j τ_j equivalent to nodal `forces`
    /// (N/mm, in the frames of the faces): the transpose of [`Duality::nodal_jumps`].
    pub(super) fn tractions(&self, forces: &[f64]) -> Vec<f64> {
        let points = self.bands.len();
        let mut tractions = vec![0.0; 2 * points];
        for (i, x1) in self.tangents.iter().enumerate() {
            let force = *x1 * forces[2 * i] + x1.left() * forces[2 * i + 1];
            [tractions[2 * i], tractions[2 * i + 1]] = [force.x, force.y];
        }
        for i in 0..points {
            for axis in 0..2 {
                if i > 0 {
                    tractions[2 * i + axis] -= self.bands[i - 1][2] * tractions[2 * (i - 1) + axis];
                }
                tractions[2 * i + axis] /= self.bands[i][1];
            }
        }
        for i in (0..points.saturating_sub(1)).rev() {
            for axis in 0..2 {
                tractions[2 * i + axis] -= self.bands[i + 1][0] * tractions[2 * (i + 1) + axis];
            }
        }
        tractions
    }
}

/// The intersection of a face element and a piece of crack.
struct CommonPiece<'a> {
    element: &'a FaceElement,
    /// Index of the piece.
    piece: usize,
    /// Range of the parameter of the curve.
    g: (f64, f64),
}

/// A straight part of the faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StraightLine {
    /// Index of the piece of crack.
    pub piece: usize,
    /// Ends along the curve, mm.
    pub ends: [Vec2; 2],
    /// (face point, λ) at each end.
    pub tractions: [Shares; 2],
}

/// The point (mm) of a piece of crack at arc length `s` (mm).
fn point_on(piece: &CrackPiece, s: f64) -> Vec2 {
    let share = (s - piece.s.0) / (piece.s.1 - piece.s.0);
    piece.ends.0 + (piece.ends.1 - piece.ends.0) * share.clamp(0.0, 1.0)
}

/// ψ and λ of a face element at g.
fn shares(element: &FaceElement, g: f64) -> (Shares, Shares) {
    let share = (g - element.range.0) / (element.range.1 - element.range.0);
    let ends = [(element.ends[0], 1.0 - share), (element.ends[1], share)];
    let jumps = ends.map(|(point, psi)| (point.unwrap_or(0), point.map_or(0.0, |_| psi)));
    let tractions = match element.ends {
        [Some(a), Some(b)] => [(a, 1.0 - share), (b, share)],
        [Some(a), None] | [None, Some(a)] => [(a, 1.0), (0, 0.0)],
        [None, None] => [(0, 0.0); 2],
    };
    (jumps, tractions)
}

/// A point of a crack curve that has nodes of its own and shorter elements around it.
struct RefinedPoint {
    /// Arc length, mm.
    s: f64,
    /// Length of an element there, mm; infinite for the regular length.
    element: f64,
    /// The nodes in g, in order.
    nodes: Vec<f64>,
}

/// The nodes of one curve in g, ends included; those at the points `joined`, where cracks meet,
/// twice.
fn nodes(mesh: &QuadMesh, curve: &CrackCurve, joined: &[usize], spacing: Option<f64>) -> Vec<f64> {
    let (start, end) = curve.range();
    let vertices = curve.vertices();
    let segments = curve.segments();
    let chord = |g: f64| {
        let segment = curve.segment_at(g, &vertices);
        let chord = SPACING * chord_at(mesh, curve.position(segment, g), curve.tangent(segment));
        spacing.map_or(chord, |spacing| chord.min(spacing))
    };
    let tip_step = [(End::First, start), (End::Last, end)]
        .into_iter()
        .filter(|(which, _)| curve.has_tip(*which))
        .map(|(_, g)| TIP_STEP * curve.root_slope() * chord(g).sqrt())
        .fold(f64::INFINITY, f64::min);
    let place = |i: usize| {
        let s = curve.arc_length_at(i);
        let before = if i > 0 { s - curve.arc_length_at(i - 1) } else { f64::INFINITY };
        let after = if i < segments { curve.arc_length_at(i + 1) - s } else { f64::INFINITY };
        let gap = before.min(after);
        let g = vertices[i];
        if joined.contains(&i) {
            let element = (JUNCTION_SPACING * chord(g)).min(0.3 * gap);
            let mut nodes = Vec::new();
            if i > 0 {
                nodes.extend([curve.g(s - element), g]);
            }
            if i < segments {
                nodes.extend([g, curve.g(s + element)]);
            }
            return Some(RefinedPoint { s, element, nodes });
        }
        if i == 0 || i == segments {
            return Some(RefinedPoint { s, element: f64::INFINITY, nodes: vec![g] });
        }
        // An element across each kink, so that every node has one tangent. Points are dense only
        // where the jump functions are dense enough. A small kink that is too near another one or
        // an end therefore has no points of its own; the element there runs across it.
        let sharp = curve.turn(i) > SHARP_KINK;
        (sharp || (curve.turn(i) > SMALL_KINK && gap >= KINK_ROOM * chord(g))).then(|| {
            let (spacing, room) =
                if sharp { (KINK_SPACING, kink_room(curve, joined, i)) } else { (SMALL_KINK_SPACING, gap) };
            let element = (spacing * chord(g)).min(0.5 * room);
            RefinedPoint { s, element, nodes: vec![curve.g(s - 0.5 * element), curve.g(s + 0.5 * element)] }
        })
    };
    let places: Vec<RefinedPoint> = (0..=segments).filter_map(place).collect();
    let density = |g: f64| {
        let near = |place: &RefinedPoint| place.element + KINK_GRADING * (curve.s(g) - place.s).abs();
        curve.ds(g) / places.iter().map(near).fold(chord(g), f64::min)
    };
    let mut nodes = places[0].nodes.clone();
    for next in &places[1..] {
        let (from, to) = (nodes[nodes.len() - 1], next.nodes[0]);
        nodes.extend(quantiles(from, to, |g| density(g).max(1.0 / tip_step)));
        nodes.extend(&next.nodes);
    }
    nodes
}

/// Distance (mm) along the curve from its vertex `i` to the nearest end, junction or other kink.
/// Vertices at which the path hardly turns do not count: short increments before a kink would make
/// the points around it denser than the jump functions.
fn kink_room(curve: &CrackCurve, joined: &[usize], i: usize) -> f64 {
    let ends = [0, curve.segments()];
    let counts = |j: &usize| ends.contains(j) || joined.contains(j) || curve.turn(*j) > SMALL_KINK;
    let others = [(0..i).rev().find(counts), (i + 1..=curve.segments()).find(counts)];
    let s = curve.arc_length_at(i);
    others.into_iter().flatten().map(|j| (curve.arc_length_at(j) - s).abs()).fold(f64::INFINITY, f64::min)
}

/// Length (mm) of crack in an element crossed through its centre.
fn chord_at(mesh: &QuadMesh, point: Vec2, tangent: Vec2) -> f64 {
    let element = mesh.locate(point).unwrap_or(0);
    let size = mesh.element(element).size();
    (size.x / tangent.x.abs()).min(size.y / tangent.y.abs())
}

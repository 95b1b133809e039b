//! Elastic balance of a plastic stress on the mesh of the rail.

use super::plastic::PlasticField;
use crate::bulk::{BulkError, BulkRail, gauss_lines};
use crate::field::StressField;
use crate::math::{RailBox, Stress, Vec2, gauss_legendre};
use crate::mesh::{Element, NODES, shape_functions};
use rayon::prelude::*;

/// The residual stress σ = 𝕂ε(u) − 𝕂ε_p due to a plastic stress in the uncracked rail, where u
/// solves ∫ 𝕂ε(u) : ε(v) = ∫ 𝕂ε_p : ε(v) for every admissible displacement v.
///
/// The plastic stress is evaluated at the nodes of the mesh and interpolated by its shape
/// functions. The stress is computed at the 2 × 2 Gauss points of the elements, where the common
/// part of the two terms cancels, and is bilinear between them.
///
/// Source: Trollé et al. 2014, section 2.4 and eq. (28).
#[derive(Debug, Clone, PartialEq)]
pub struct BalancedStress {
    /// Abscissae and ordinates of the lines of Gauss points, increasing, mm.
    along_x: Vec<f64>,
    along_y: Vec<f64>,
    /// `stresses[row * along_x.len() + column]`, MPa.
    stresses: Vec<Stress>,
    /// Depths of the corners of the elements, for `residual.csv`, downwards, mm.
    depths: Vec<f64>,
}

/// Loss of accuracy of a plastic stress in its representation on the mesh, over a part of the rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectionLoss {
    /// L2 norm of the field on the part, √∫ p:p dA, MPa mm.
    pub norm: f64,
    /// Norm of its interpolation on the mesh, over `norm`.
    pub norm_ratio: f64,
    /// Norm of the difference, over `norm`.
    pub difference: f64,
}

/// Numbers of quadrature points for the generalised forces of quadratic elements and for the
/// losses.
const RULE: usize = 3;

/// Values of the plastic stress at the nodes of the elements.
fn at_nodes(rail: &BulkRail, plastic: impl Fn(Vec2) -> Stress + Sync) -> Vec<Stress> {
    let mesh = rail.mesh();
    (0..mesh.node_count()).into_par_iter().map(|node| plastic(mesh.node_position(node))).collect()
}

/// The plastic stress at (ξ, η) of an element.
fn interpolated(element: &Element, nodal: &[Stress], shapes: &[[f64; 3]; NODES]) -> Stress {
    element.nodes.iter().zip(shapes).fold(Stress::ZERO, |sum, (&node, n)| sum + nodal[node] * n[0])
}

impl BalancedStress {
    /// Balances `plastic`, the plastic stress (MPa) at a point (mm), on `rail`.
    ///
    /// Errors: those of the linear algebra.
    pub fn new(rail: &BulkRail, plastic: impl Fn(Vec2) -> Stress + Sync) -> Result<Self, BulkError> {
        let nodal = at_nodes(rail, plastic);
        let mut forces = generalised_forces(rail, &nodal);
        rail.factor()?.solve(&mut forces)?;
        let displacements = rail.at_nodes(&forces, |_| Vec2::default());
        let mesh = rail.mesh();
        let (along_x, along_y) = (gauss_lines(mesh.x_lines()), gauss_lines(mesh.y_lines()));
        let columns = along_x.len();
        let stresses = (0..columns * along_y.len())
            .into_par_iter()
            .map(|k| {
                let (row, column) = (k / columns, k % columns);
                let element = mesh.element((row / 2) * mesh.columns() + column / 2);
                let (xi, eta) = element.reference(Vec2::new(along_x[column], along_y[row]));
                let shapes = shape_functions(xi, eta);
                let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
                let scale = Vec2::new(2.0 / element.size().x, 2.0 / element.size().y);
                for (&node, n) in element.nodes.iter().zip(&shapes) {
                    let u = displacements[node];
                    xx += scale.x * n[1] * u.x;
                    yy += scale.y * n[2] * u.y;
                    xy += scale.y * n[2] * u.x + scale.x * n[1] * u.y;
                }
                rail.steel().plane_strain_stress(xx, yy, xy) - interpolated(&element, &nodal, &shapes)
            })
            .collect();
        let depths = mesh.y_lines().iter().rev().map(|y| y.abs()).collect();
        Ok(Self { along_x, along_y, stresses, depths })
    }

    /// Depths of the lines of the mesh, from the surface downwards, mm.
    pub fn depths(&self) -> &[f64] {
        &self.depths
    }

    fn at(&self, row: usize, column: usize) -> Stress {
        self.stresses[row * self.along_x.len() + column]
    }
}

impl StressField for BalancedStress {
    fn stress(&self, point: Vec2) -> Stress {
        let ((i, s), (j, t)) = (between(&self.along_x, point.x), between(&self.along_y, point.y));
        let along = |row: usize| self.at(row, i) * (1.0 - s) + self.at(row, i + 1) * s;
        along(j) * (1.0 - t) + along(j + 1) * t
    }
}

/// ∫ 𝕂ε_p : ε(φ) (N/mm) for every unknown of the rail, with 𝕂ε_p given at its nodes (eq. 28).
fn generalised_forces(rail: &BulkRail, nodal: &[Stress]) -> Vec<f64> {
    let mesh = rail.mesh();
    let mut forces = vec![0.0; rail.order()];
    let rule = gauss_legendre(RULE);
    for e in 0..mesh.element_count() {
        let element = mesh.element(e);
        if element.nodes.iter().all(|&node| nodal[node] == Stress::ZERO) {
            continue;
        }
        let unknowns = rail.element_unknowns(e);
        let size = element.size();
        for (&(s, v), &(t, w)) in rule.iter().flat_map(|s| rule.iter().map(move |t| (s, t))) {
            let shapes = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
            let p = interpolated(&element, nodal, &shapes) * (v * w * size.x * size.y);
            for (i, n) in shapes.iter().enumerate() {
                let slope = Vec2::new(2.0 / size.x * n[1], 2.0 / size.y * n[2]);
                let force = p.traction(slope);
                for (unknown, part) in unknowns[2 * i..2 * i + 2].iter().zip([force.x, force.y]) {
                    if let Some(unknown) = *unknown {
                        forces[unknown] += part;
                    }
                }
            }
        }
    }
    forces
}

/// The part of `plastic` lost by interpolation on the mesh of `rail`, over the elements whose
/// centre lies in `part`.
pub fn projection_loss(rail: &BulkRail, plastic: &PlasticField, part: RailBox) -> ProjectionLoss {
    let mesh = rail.mesh();
    let nodal = at_nodes(rail, |point| plastic.plastic_stress(point));
    let rule = gauss_legendre(RULE);
    let (mut given, mut projected, mut difference) = (0.0, 0.0, 0.0);
    for e in 0..mesh.element_count() {
        let element = mesh.element(e);
        let [lower, _, upper, _] = element.corners();
        let middle = (lower + upper) * 0.5;
        if (middle.x - part.centre).abs() > 0.5 * part.width || middle.y < -part.depth {
            continue;
        }
        let size = element.size();
        for (&(s, v), &(t, w)) in rule.iter().flat_map(|s| rule.iter().map(move |t| (s, t))) {
            let shapes = shape_functions(2.0 * s - 1.0, 2.0 * t - 1.0);
            let here = interpolated(&element, &nodal, &shapes);
            let there = plastic.plastic_stress(lower + Vec2::new(s * size.x, t * size.y));
            let weight = v * w * size.x * size.y;
            given += weight * there.squared();
            projected += weight * here.squared();
            difference += weight * (here - there).squared();
        }
    }
    let norm: f64 = f64::sqrt(given);
    let over = |square: f64| if norm > 0.0 { square.sqrt() / norm } else { 0.0 };
    ProjectionLoss { norm, norm_ratio: over(projected), difference: over(difference) }
}

/// The interval of `lines` that contains `x`, or the nearest one, and the local coordinate.
fn between(lines: &[f64], x: f64) -> (usize, f64) {
    let i = lines.partition_point(|&line| line <= x).clamp(1, lines.len() - 1) - 1;
    // Within the first and the last element the stress is extrapolated beyond the Gauss points.
    let t = (x - lines[i]) / (lines[i + 1] - lines[i]);
    (i, t.clamp(-1.0, 2.0))
}

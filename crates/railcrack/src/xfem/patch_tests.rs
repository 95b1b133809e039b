//! Williams fields on a patch, and superposition compared with one dense system of all unknowns.

use super::basis::{CellBasis, Elasticity, Function, MODES};
use super::body::Discretisation;
use super::border::{Border, face_jumps};
use super::cuts::{CellPlace, CutElement, along_side};
use super::interface::Interface;
use super::sif::{SifContext, SifDomain, SifFunctional};
use crate::bulk::{BottomSupport, Boundary, BulkRail, RectangleStiffness, SideSupport};
use crate::crack::{Crack, CrackNetwork};
use crate::fracture::WilliamsField;
use crate::interruption::Interruption;
use crate::linear::{SparseColumn, SpdFactor};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, Stress, Vec2, gauss_legendre};
use crate::mesh::{Edge, QuadMesh};
use crate::xfem::{XfemSettings, cracked_body};
use std::sync::Arc;

/// x of K x = b.
fn solved(matrix: &Matrix, right: Vec<f64>) -> Vec<f64> {
    let lower = |i: usize, row: &mut [f64]| row.copy_from_slice(&matrix.row(i)[..=i]);
    let factor = SpdFactor::new(matrix.rows(), lower).unwrap();
    let right = Matrix::from_fn(1, right.len(), |_, i| right[i]);
    let mut solution = factor.half_solve_rows(right, Interruption::NEVER).unwrap().row(0).to_vec();
    factor.back_solve(&mut solution).unwrap();
    solution
}

pub(super) fn steel() -> IsotropicElastic {
    IsotropicElastic::new(210e3, 0.3).unwrap()
}

/// 15 × 8 elements of 0.2 mm, a crack from the surface whose tip lies inside.
fn patch() -> (QuadMesh, CrackNetwork) {
    let lines = |from: f64, n: usize| (0..=n).map(|i| from + 0.2 * i as f64).collect();
    let mesh = QuadMesh::new(lines(-1.5, 15), lines(-2.0, 10)).unwrap();
    let crack = Crack::surface_breaking(-0.63, 1.17, 0.9).unwrap();
    // The last grid line is the surface, up to round-off.
    let y: Vec<f64> = mesh.y_lines().iter().map(|y| if y.abs() < 1e-9 { 0.0 } else { *y }).collect();
    (QuadMesh::new(mesh.x_lines().to_vec(), y).unwrap(), crack.into())
}

/// All unknowns of the patch: the standard ones (2 node + axis), then the enriched ones.
pub(super) struct Dense {
    pub mesh: QuadMesh,
    pub parts: Discretisation,
    elasticity: Elasticity,
    pub matrix: Matrix,
    pub standard: usize,
}

impl Dense {
    pub(crate) fn new(mesh: &QuadMesh, network: &CrackNetwork) -> Self {
        let parts = Discretisation::new(mesh, network, &XfemSettings::default()).unwrap();
        let elasticity = Elasticity::new(steel());
        let border =
            Border::new(&parts.cuts, &parts.space, &elasticity, Interruption::NEVER).unwrap().entries();
        let standard = 2 * mesh.node_count();
        let mut matrix = Matrix::zeros(standard + parts.space.unknowns(), standard + parts.space.unknowns());
        let stiffness = RectangleStiffness::new(&steel());
        for e in 0..mesh.element_count() {
            let element = mesh.element(e);
            let block = stiffness.matrix(element.size());
            for i in 0..16 {
                for j in 0..16 {
                    matrix[(2 * element.nodes[i / 2] + i % 2, 2 * element.nodes[j / 2] + j % 2)] +=
                        block[(i, j)];
                }
            }
        }
        for (k, column) in border.columns.iter().enumerate() {
            for &(unknown, value) in column {
                matrix[(unknown, standard + k)] += value;
                matrix[(standard + k, unknown)] += value;
            }
        }
        for i in 0..parts.space.unknowns() {
            for &(j, value) in &border.square[i] {
                matrix[(standard + i, standard + j)] += value;
                if i != j {
                    matrix[(standard + j, standard + i)] += value;
                }
            }
        }
        Self { mesh: mesh.clone(), parts, elasticity, matrix, standard }
    }

    fn functionals(&self) -> [SifFunctional; 2] {
        let defaults = XfemSettings::default();
        let size = self.parts.sizes[0];
        let context = SifContext {
            mesh: &self.mesh,
            cuts: &self.parts.cuts,
            space: &self.parts.space,
            interface: &self.parts.interface,
            elasticity: &self.elasticity,
        };
        let (inner, outer) = (defaults.domain_inner * size, defaults.domain_outer * size);
        context.functionals(0, SifDomain { inner, outer })
    }

    /// K of displacements without tractions on the faces.
    pub(crate) fn sifs(&self, u: &[f64]) -> [f64; 2] {
        self.functionals().map(|functional| {
            let standard: f64 = functional.standard.iter().map(|&(i, v)| v * u[i]).sum();
            standard + functional.enriched.iter().map(|&(i, v)| v * u[self.standard + i]).sum::<f64>()
        })
    }

    /// The solution under `forces` with the `held` unknowns at zero.
    pub(crate) fn solve(&self, forces: &[f64], held: impl Fn(usize) -> bool) -> Vec<f64> {
        let n = forces.len();
        // Functions without stiffness, or linearly dependent on the others, are suppressed.
        let scale: Vec<f64> =
            (0..n)
                .map(|i| {
                    if held(i) || self.matrix[(i, i)] <= 0.0 { 0.0 } else { 1.0 / self.matrix[(i, i)].sqrt() }
                })
                .collect();
        let scaled = Matrix::from_fn(n, n, |i, j| {
            let own = if scale[i] > 0.0 { 1e-14 } else { 1.0 };
            self.matrix[(i, j)] * scale[i] * scale[j] + if i == j { own } else { 0.0 }
        });
        let right = (0..n).map(|i| forces[i] * scale[i]).collect();
        let solved = solved(&scaled, right);
        (0..n).map(|i| solved[i] * scale[i]).collect()
    }

    /// Nodal forces of tractions on the outline of the patch, with the outward normal.
    fn outline(&self, traction: impl Fn(Vec2, Vec2, &CutElement, usize) -> Vec2) -> Vec<f64> {
        let mut forces = vec![0.0; self.matrix.rows()];
        let rule = gauss_legendre(8);
        let mut functions: Vec<Function> = Vec::new();
        let normals = [Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0)];
        for e in 0..self.mesh.element_count() {
            let whole = CutElement::whole(self.mesh.element(e));
            let cut = self.parts.cuts.elements.get(&e).unwrap_or(&whole);
            for piece in cut.sides.iter().filter(|piece| self.mesh.neighbour(e, piece.side).is_none()) {
                let place = CellPlace { element: e, cell: piece.cell };
                let basis = CellBasis::new(&self.parts.cuts, &self.parts.space, cut, place, &steel());
                let corner = cut.element.corners()[piece.side as usize];
                for &(t, weight) in &rule {
                    let along = piece.from + t * (piece.to - piece.from);
                    let point = match piece.side {
                        Edge::Bottom | Edge::Top => Vec2::new(along, corner.y),
                        Edge::Left | Edge::Right => Vec2::new(corner.x, along),
                    };
                    debug_assert_eq!(along_side(piece.side, point), along);
                    let force = traction(point, normals[piece.side as usize], cut, piece.cell)
                        * (weight * (piece.to - piece.from));
                    basis.at(point, &mut functions);
                    for (target, function) in basis.targets.iter().zip(&functions) {
                        let value = force.dot(function.value);
                        if let Some(i) = target.standard {
                            forces[i] += value;
                        }
                        if let Some(i) = target.enriched {
                            forces[self.standard + i] += value;
                        }
                    }
                }
            }
        }
        forces
    }
}

/// Tolerance of K_I = 1 and K_II = 0, and vice versa: default enrichment and domain, eleven
/// elements to the nearest side.
const PATCH: f64 = 1e-3;

/// The outline of a patch carries the tractions of a Williams field, so that this field is the
/// solution. Three unknowns on the bottom suppress the rigid motions; their reactions vanish, since
/// the tractions are balanced.
#[test]
fn williams_field_on_a_patch() {
    let (mesh, network) = patch();
    let dense = Dense::new(&mesh, &network);
    let path = &dense.parts.cuts.tips[0];
    let held = [2 * mesh.node_at(0, 0), 2 * mesh.node_at(0, 0) + 1, 2 * mesh.node_at(30, 0) + 1];
    for (mode, name) in MODES.into_iter().zip(["K_I", "K_II"]) {
        let field = WilliamsField::of(mode, &steel());
        let forces = dense.outline(|point, normal, cut, cell| {
            let sheet = path.sheet(&cut.arrangement.polygon(cell));
            let theta = path.angle_near(point, sheet.0, sheet.1);
            let r = (point - path.position()).length();
            field.at(r, theta, steel().poisson()).stress.rotated(path.ahead).traction(normal)
        });
        let k = dense.sifs(&dense.solve(&forces, |i| held.contains(&i)));
        println!("{name} = 1: K_I {:.6}, K_II {:.6}", k[0], k[1]);
        assert!((k[0] - mode.ki).abs() < PATCH && (k[1] - mode.kii).abs() < PATCH, "{name}: {k:?}");
    }
}

/// Round-off of systems of two thousand unknowns.
const SAME: f64 = 1e-10;

/// A loaded block with a crack: all unknowns at once, compared with the uncracked block and the
/// crack under the forces −K_es u0 that the field of the uncracked block exerts on the enriched
/// functions.
#[test]
fn superposition_of_a_discrete_field() {
    let (mesh, network) = patch();
    let dense = Dense::new(&mesh, &network);
    let boundary = Boundary::Block { bottom: BottomSupport::Clamped, sides: SideSupport::Free };
    let rail = BulkRail::new(mesh.clone(), &steel(), boundary).unwrap();
    let (standard, n) = (dense.standard, dense.matrix.rows());
    // Tension and shear on the right side, outside the support of all enrichments.
    let forces =
        dense.outline(|_, normal, _, _| if normal.x > 0.0 { Vec2::new(50.0, 30.0) } else { Vec2::default() });
    assert!(forces[standard..].iter().all(|f| *f == 0.0));
    let held = |i: usize| i < standard && rail.unknowns(i / 2)[i % 2].is_none();
    let at_once = dense.solve(&forces, held);

    let free: Vec<usize> = (0..standard).filter(|&i| !held(i)).collect();
    let unknown = |i: usize| rail.unknowns(i / 2)[i % 2].unwrap();
    let mut u0 = vec![0.0; free.len()];
    free.iter().for_each(|&i| u0[unknown(i)] = forces[i]);
    rail.factor().unwrap().solve(&mut u0).unwrap();
    let column = |k: usize| SparseColumn {
        entries: free
            .iter()
            .map(|&i| (unknown(i), dense.matrix[(i, standard + k)]))
            .filter(|entry| entry.1 != 0.0)
            .collect(),
    };
    let enriched = n - standard;
    let columns: Vec<SparseColumn> = (0..enriched).map(column).collect();
    let panels: Vec<_> = rail
        .factor()
        .unwrap()
        .forward(&columns, Interruption::NEVER)
        .unwrap()
        .into_iter()
        .map(Arc::new)
        .collect();
    let products = crate::linear::gram(&panels, 0, Interruption::NEVER).unwrap();
    let scale: Vec<f64> = (0..enriched)
        .map(|i| dense.matrix[(standard + i, standard + i)])
        .map(|own| if own > 0.0 { 1.0 / own.sqrt() } else { 0.0 })
        .collect();
    let condensed = Matrix::from_fn(enriched, enriched, |i, j| {
        let own = if scale[i] > 0.0 { 1e-14 } else { 1.0 };
        (dense.matrix[(standard + i, standard + j)] - products[i.max(j)][i.min(j)]) * scale[i] * scale[j]
            + if i == j { own } else { 0.0 }
    });
    let pull = |i: usize| -scale[i] * columns[i].entries.iter().map(|&(k, v)| v * u0[k]).sum::<f64>();
    let right = (0..enriched).map(pull).collect();
    let solved = solved(&condensed, right);
    let ue: Vec<f64> = (0..enriched).map(|i| solved[i] * scale[i]).collect();
    let mut v = vec![0.0; free.len()];
    for (column, ue) in columns.iter().zip(&ue) {
        column.entries.iter().for_each(|&(k, value)| v[k] -= value * ue);
    }
    rail.factor().unwrap().solve(&mut v).unwrap();
    let mut sum = vec![0.0; n];
    free.iter().for_each(|&i| sum[i] = u0[unknown(i)] + v[unknown(i)]);
    sum[standard..].copy_from_slice(&ue);

    let jumps = |u: &[f64]| -> Vec<f64> {
        let Discretisation { cuts, space, interface, .. } = &dense.parts;
        let b = nodal_jumps(&rail, cuts, space, interface);
        b.times(&u[standard..])
    };
    let (one, other) = (jumps(&at_once), jumps(&sum));
    let peak = one.iter().fold(0.0f64, |m, w| m.max(w.abs()));
    let jump = one.iter().zip(&other).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / peak;
    let (k, m) = (dense.sifs(&at_once), dense.sifs(&sum));
    let sif = (k[0] - m[0]).abs().max((k[1] - m[1]).abs()) / k[0].abs();
    println!("jump {jump:.1e}, K {sif:.1e}");
    assert!(jump < SAME && sif < SAME, "jump {jump:.1e}, K {sif:.1e}");

    // The body under the tractions of the same field, sampled: no longer the same discrete problem.
    let body = cracked_body(&std::sync::Arc::new(rail.clone()), &network, XfemSettings::default()).unwrap();
    let points: Vec<Vec2> = body.faces.samples.iter().map(|sample| sample.point).collect();
    let mut at_nodes = vec![Vec2::default(); mesh.node_count()];
    for &i in &free {
        let node = &mut at_nodes[i / 2];
        *(if i % 2 == 0 { &mut node.x } else { &mut node.y }) = u0[unknown(i)];
    }
    let stresses: Vec<Stress> = crate::bulk::StressAtPoints::new(&rail, &points).unwrap().stress(&at_nodes);
    let forces = body.faces.nodal_forces_of_samples(|k, _| stresses[k]);
    let sampled = body.sif_influence.times(&forces);
    let error = (sampled[0] - k[0]).abs().max((sampled[1] - k[1]).abs()) / k[0].abs();
    println!("K of the sampled field {error:.1e}");
    assert!(error < SAMPLED, "K of the sampled field {error:.1e}");
}

/// Error of K from sampling the stress of elements of a sixth of the crack, smoothed from their
/// Gauss points.
const SAMPLED: f64 = 2e-2;

fn nodal_jumps(
    rail: &BulkRail,
    cuts: &super::cuts::Cuts,
    space: &super::space::Space,
    interface: &Interface,
) -> Matrix {
    let mut b = Matrix::zeros(2 * interface.faces.points.len(), space.unknowns());
    for (i, row) in face_jumps(rail, cuts, space, interface).iter().enumerate() {
        row.iter().for_each(|&(unknown, value)| b[(i, unknown)] = value);
    }
    interface.duality().nodal_jumps(b)
}

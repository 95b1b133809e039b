//! K of a cracked body with plastic strain by two routes: the plastic stress as generalised forces
//! on all functions, enriched ones included, with the eigenstrain term in the interaction integral;
//! and the balance of the uncracked body, whose stress then loads the faces.

use super::basis::{CellBasis, Function, MODES, Rules};
use super::cuts::{CellPlace, CutElement};
use super::patch_tests::{Dense, steel};
use super::settings::XfemSettings;
use crate::bulk::{BottomSupport, Boundary, BulkRail, SideSupport};
use crate::crack::{Crack, CrackNetwork};
use crate::field::StressField;
use crate::fracture::WilliamsField;
use crate::math::{Stress, Vec2};
use crate::mesh::QuadMesh;
use crate::residual::BalancedStress;
use crate::xfem::cracked_body;
use std::sync::Arc;

/// 3 × 2 mm, a crack of 1.17 mm from the surface; `per_mm` elements per mm.
fn patch(per_mm: usize) -> (QuadMesh, CrackNetwork) {
    let lines = |from: f64, length: usize| {
        (0..=length * per_mm).map(|i| from + i as f64 / per_mm as f64).collect::<Vec<f64>>()
    };
    let crack = Crack::surface_breaking(-0.63, 1.17, 0.9).unwrap();
    (QuadMesh::new(lines(-1.5, 3), lines(-2.0, 2)).unwrap(), crack.into())
}

/// A plastic stress that varies along the rail and with depth, and opens the crack.
fn plastic_stress(p: Vec2) -> Stress {
    let (x, d) = (p.x, -p.y);
    Stress {
        xx: -100.0 - 60.0 * d + 25.0 * d * d + 30.0 * x,
        yy: 40.0 - 20.0 * x * d,
        zz: 60.0,
        xy: 15.0 * x - 10.0 * d,
    }
}

/// Calls `visit` at the integration points of every cell of the patch, with the functions of the
/// cell there.
fn integrate(dense: &Dense, mut visit: impl FnMut(&CutElement, usize, &CellBasis, &[Function], Vec2, f64)) {
    let rules = Rules::new();
    let mut functions: Vec<Function> = Vec::new();
    let tip = dense.parts.cuts.tips[0].position();
    for e in 0..dense.mesh.element_count() {
        let whole = CutElement::whole(dense.mesh.element(e));
        let cut = dense.parts.cuts.elements.get(&e).unwrap_or(&whole);
        for cell in 0..cut.arrangement.cells.len() {
            let place = CellPlace { element: e, cell };
            let basis = CellBasis::new(&dense.parts.cuts, &dense.parts.space, cut, place, &steel());
            for (point, weight) in rules.on_cell(cut, cell, &[tip]) {
                basis.at(point, &mut functions);
                visit(cut, cell, &basis, &functions, point, weight);
            }
        }
    }
}

/// ∫ 𝕂ε_p : ε(φ) for every function φ (eq. 28).
fn generalised_forces(dense: &Dense) -> Vec<f64> {
    let mut forces = vec![0.0; dense.matrix.rows()];
    integrate(dense, |_, _, basis, functions, point, weight| {
        let p = plastic_stress(point);
        for (target, function) in basis.targets.iter().zip(functions) {
            let [xx, yy, shear] = function.strain();
            let value = weight * (p.xx * xx + p.yy * yy + p.xy * shear);
            if let Some(i) = target.standard {
                forces[i] += value;
            }
            if let Some(i) = target.enriched {
                forces[dense.standard + i] += value;
            }
        }
    });
    forces
}

/// Contribution of the plastic strain to K: (E′/2) ∫ 𝕂ε_p : ∇(q v), with q the weight of the domain
/// and v the dual field of the mode.
fn eigenstrain_term(dense: &Dense) -> [f64; 2] {
    let (cuts, steel) = (&dense.parts.cuts, steel());
    let path = &cuts.tips[0];
    let settings = XfemSettings::default();
    let size = dense.parts.sizes[0];
    let (inner, outer) = (settings.domain_inner * size, settings.domain_outer * size);
    let corner_weight =
        |p: Vec2| ((outer - (p - path.position()).length()) / (outer - inner)).clamp(0.0, 1.0);
    let mut terms = [0.0; 2];
    integrate(dense, |cut, cell, _, _, point, weight| {
        let q = cut.element.corners().map(corner_weight);
        let (s, t) = {
            let size = cut.element.size();
            let from = point - cut.element.corners()[0];
            (from.x / size.x, from.y / size.y)
        };
        let value = (1.0 - t) * ((1.0 - s) * q[0] + s * q[1]) + t * ((1.0 - s) * q[3] + s * q[2]);
        let size = cut.element.size();
        let slope = Vec2::new(
            ((1.0 - t) * (q[1] - q[0]) + t * (q[2] - q[3])) / size.x,
            ((1.0 - s) * (q[3] - q[0]) + s * (q[2] - q[1])) / size.y,
        );
        if value == 0.0 && slope == Vec2::default() {
            return;
        }
        let p = plastic_stress(point);
        let sheet = path.sheet(&cut.arrangement.polygon(cell));
        let theta = path.angle_near(point, sheet.0, sheet.1);
        let r = (point - path.position()).length();
        for (term, mode) in terms.iter_mut().zip(MODES) {
            let dual = WilliamsField::dual(mode, &steel).at(r, theta, steel.poisson());
            let displacement = path.to_global(dual.displacement);
            let stress = dual.stress.rotated(path.ahead);
            // Hooke's law in plane strain, inverted.
            let (g, nu) = (steel.shear_modulus(), steel.poisson());
            let mean = nu * (stress.xx + stress.yy);
            let (xx, yy, xy) =
                ((stress.xx - mean) / (2.0 * g), (stress.yy - mean) / (2.0 * g), stress.xy / (2.0 * g));
            let strained = p.xx * xx + p.yy * yy + 2.0 * p.xy * xy;
            *term += weight * (p.traction(slope).dot(displacement) + value * strained);
        }
    });
    terms.map(|term| 0.5 * steel.plane_strain_modulus() * term)
}

/// K by both routes with `per_mm` elements per mm.
fn both(per_mm: usize) -> [[f64; 2]; 2] {
    let (mesh, network) = patch(per_mm);
    let boundary = Boundary::Block { bottom: BottomSupport::Clamped, sides: SideSupport::Rollers };
    let rail = BulkRail::new(mesh.clone(), &steel(), boundary).unwrap();
    let dense = Dense::new(&mesh, &network);
    let held = |i: usize| i < dense.standard && rail.unknowns(i / 2)[i % 2].is_none();
    let displacements = dense.solve(&generalised_forces(&dense), held);
    let (k, plastic) = (dense.sifs(&displacements), eigenstrain_term(&dense));
    let direct = [k[0] + plastic[0], k[1] + plastic[1]];

    let balanced = BalancedStress::new(&rail, plastic_stress).unwrap();
    let body = cracked_body(&Arc::new(rail), &network, XfemSettings::default()).unwrap();
    let forces = body.faces.nodal_forces(|point| balanced.stress(point));
    let superposed = body.sif_influence.times(&forces);
    [direct, [superposed[0], superposed[1]]]
}

/// Difference between the routes with twelve elements along the crack.
const FINE: f64 = 5e-3;

#[test]
fn generalised_forces_and_face_tractions_give_the_same_k() {
    let differences: Vec<f64> = [5, 10]
        .into_iter()
        .map(|per_mm| {
            let [direct, superposed] = both(per_mm);
            println!("{per_mm} per mm: generalised forces {direct:?}, face tractions {superposed:?}");
            let difference = (direct[0] - superposed[0]).abs().max((direct[1] - superposed[1]).abs());
            difference / direct[0].hypot(direct[1])
        })
        .collect();
    println!("{differences:?}");
    assert!(differences[1] < FINE, "{differences:?}");
    let order = (differences[0] / differences[1]).log2();
    assert!(order > 1.0, "order {order}: {differences:?}");
}

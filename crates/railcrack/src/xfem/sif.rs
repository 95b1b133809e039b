//! Stress intensity factors by reciprocity with the dual fields of a tip, over a domain around it.

use super::basis::{CellBasis, Elasticity, Function, MODES, Rules};
use super::border::merge;
use super::cuts::{CellPlace, CutElement, Cuts, SHARP_KINK};
use super::interface::Interface;
use super::settings::XfemSettings;
use super::space::Space;
use crate::crack::point_to_segment;
use crate::fracture::WilliamsField;
use crate::math::{Stress, Vec2, gauss_legendre};
use crate::mesh::{Edge, QuadMesh};

/// An integration domain, whose weight q is 1 up to `inner` (mm) from the tip and decreases to 0 at
/// `outer` (mm).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SifDomain {
    /// Inner radius, mm.
    pub inner: f64,
    /// Outer radius, mm.
    pub outer: f64,
}

/// K of one mode of one tip as a linear functional of the solution:
/// K = standard · u_s + enriched · u_e + tractions · τ.
#[derive(Debug, Clone, Default)]
pub(super) struct SifFunctional {
    /// (unknown of the mesh, factor), increasing.
    pub standard: Vec<(usize, f64)>,
    /// (enriched unknown, factor), increasing.
    pub enriched: Vec<(usize, f64)>,
    /// Per face point and axis, the coefficient of the traction τ on the + face.
    pub tractions: Vec<f64>,
}

/// The data of the functionals.
pub(super) struct SifContext<'a> {
    pub mesh: &'a QuadMesh,
    pub cuts: &'a Cuts,
    pub space: &'a Space,
    pub interface: &'a Interface,
    pub elasticity: &'a Elasticity,
}

/// Gauss points per piece of the running surface.
const SURFACE_POINTS: usize = 6;

/// The dual fields of K_I and K_II at a point, in x and y components.
struct Dual<'a> {
    context: &'a SifContext<'a>,
    tip: usize,
    fields: [WilliamsField; 2],
    /// K = `scale` × the integral: E′/2.
    scale: f64,
}

#[derive(Clone, Copy)]
struct DualValue {
    displacement: Vec2,
    stress: Stress,
}

impl SifContext<'_> {
    /// K_I and K_II of tip `tip`.
    ///
    /// With q the weight of the domain, v a dual field and t⁺ = −t⁻ the tractions on the faces,
    /// Betti's theorem gives
    ///
    /// (2/E′) K = −∫ (σ(u)·v − σ(v)·u)·∇q dA + ∫ q t⁺·⟦v⟧ ds − ∫ q (t(v)⁺·u⁺ + t(v)⁻·u⁻)
    /// ds − ∫_surface q t(v)·u ds,
    ///
    /// which is the interaction integral with v = −∂u_aux/∂x1 and the actual faces: t(v) vanishes
    /// on the last segment but not behind a kink, on other cracks or on the running surface.
    pub(super) fn functionals(&self, tip: usize, domain: SifDomain) -> [SifFunctional; 2] {
        let at = self.cuts.tips[tip].position();
        let weight = |node: usize| {
            let r = (self.mesh.node_position(node) - at).length();
            ((domain.outer - r) / (domain.outer - domain.inner)).clamp(0.0, 1.0)
        };
        let steel = &self.elasticity.steel;
        let dual = Dual {
            context: self,
            tip,
            fields: MODES.map(|mode| WilliamsField::dual(mode, steel)),
            scale: 0.5 * steel.plane_strain_modulus(),
        };
        let points = self.interface.faces.points.len();
        let mut functionals =
            [(); 2].map(|()| SifFunctional { tractions: vec![0.0; 2 * points], ..SifFunctional::default() });
        let reach = Vec2::new(domain.outer, domain.outer);
        let (columns, rows) = self.mesh.places_meeting(at - reach, at + reach);
        let rules = Rules::new();
        for row in rows {
            for column in columns.clone() {
                let e = row * self.mesh.columns() + column;
                let element = self.mesh.element(e);
                let q = [0, 1, 2, 3].map(|corner| weight(element.nodes[corner]));
                if q.iter().all(|&q| q == 0.0) {
                    continue;
                }
                let whole;
                let cut = match self.cuts.elements.get(&e) {
                    Some(cut) => cut,
                    None => {
                        whole = CutElement::whole(element);
                        &whole
                    }
                };
                if q.iter().any(|&value| value != q[0]) {
                    dual.ring(e, cut, q, &rules, &mut functionals);
                }
                if self.mesh.neighbour(e, Edge::Top).is_none() {
                    dual.surface(e, cut, q, &mut functionals);
                }
            }
        }
        dual.faces(&weight, &mut functionals);
        for functional in &mut functionals {
            merge(&mut functional.standard);
            merge(&mut functional.enriched);
        }
        functionals
    }
}

/// Bilinear weight from its corner values, with its gradient, at a point of the element.
fn weight_at(cut: &CutElement, q: [f64; 4], point: Vec2) -> (f64, Vec2) {
    let (xi, eta) = cut.element.reference(point);
    let size = cut.element.size();
    let (s, t) = (0.5 * (1.0 + xi), 0.5 * (1.0 + eta));
    let value = (1.0 - t) * ((1.0 - s) * q[0] + s * q[1]) + t * ((1.0 - s) * q[3] + s * q[2]);
    let dx = ((1.0 - t) * (q[1] - q[0]) + t * (q[2] - q[3])) / size.x;
    let dy = ((1.0 - s) * (q[3] - q[0]) + s * (q[2] - q[1])) / size.y;
    (value, Vec2::new(dx, dy))
}

impl Dual<'_> {
    /// The sheet of a cell.
    fn sheet(&self, cut: &CutElement, cell: usize) -> (Vec2, f64) {
        self.context.cuts.tips[self.tip].sheet(&cut.arrangement.polygon(cell))
    }

    /// Both fields at a point of the cell on `sheet`.
    fn at(&self, point: Vec2, sheet: (Vec2, f64)) -> [DualValue; 2] {
        let path = &self.context.cuts.tips[self.tip];
        let theta = path.angle_near(point, sheet.0, sheet.1);
        let r = (point - path.position()).length();
        let nu = self.context.elasticity.steel.poisson();
        let powers = self.fields[0].powers(r, theta);
        self.fields.map(|field| {
            let field = field.of_powers(&powers, nu);
            DualValue {
                displacement: path.to_global(field.displacement),
                stress: field.stress.rotated(path.ahead),
            }
        })
    }

    fn basis(&self, e: usize, cut: &CutElement, cell: usize) -> CellBasis<'_> {
        let context = self.context;
        let place = CellPlace { element: e, cell };
        CellBasis::new(context.cuts, context.space, cut, place, &context.elasticity.steel)
    }

    fn add(&self, basis: &CellBasis, k: usize, value: f64, functional: &mut SifFunctional) {
        let target = basis.targets[k];
        if value != 0.0 {
            functional.standard.extend(target.standard.map(|unknown| (unknown, value)));
            functional.enriched.extend(target.enriched.map(|unknown| (unknown, value)));
        }
    }

    /// −∫ (σ(u)·v − σ(v)·u)·∇q dA over one element.
    fn ring(&self, e: usize, cut: &CutElement, q: [f64; 4], rules: &Rules, sums: &mut [SifFunctional; 2]) {
        let tip = self.context.cuts.tips[self.tip].position();
        let mut functions: Vec<Function> = Vec::new();
        for cell in 0..cut.arrangement.cells.len() {
            let basis = self.basis(e, cut, cell);
            let sheet = self.sheet(cut, cell);
            let mut values = vec![[0.0; 2]; basis.targets.len()];
            for (point, weight) in rules.on_cell(cut, cell, &[tip]) {
                let duals = self.at(point, sheet);
                let (_, slope) = weight_at(cut, q, point);
                basis.at(point, &mut functions);
                let tractions = duals.map(|dual| dual.stress.traction(slope));
                for (value, function) in values.iter_mut().zip(&functions) {
                    let own = self.context.elasticity.full_stress(function.strain()).traction(slope);
                    for mode in 0..2 {
                        value[mode] -= weight
                            * (own.dot(duals[mode].displacement) - tractions[mode].dot(function.value));
                    }
                }
            }
            for (k, value) in values.iter().enumerate() {
                for mode in 0..2 {
                    self.add(&basis, k, self.scale * value[mode], &mut sums[mode]);
                }
            }
        }
    }

    /// −∫ q t(v)·u ds over the running surface of one element.
    fn surface(&self, e: usize, cut: &CutElement, q: [f64; 4], sums: &mut [SifFunctional; 2]) {
        let rule = gauss_legendre(SURFACE_POINTS);
        let mut functions: Vec<Function> = Vec::new();
        for side in cut.sides.iter().filter(|side| side.side == Edge::Top) {
            let basis = self.basis(e, cut, side.cell);
            let sheet = self.sheet(cut, side.cell);
            for &(t, weight) in &rule {
                let point = Vec2::new(side.from + t * (side.to - side.from), cut.element.upper.y);
                let (q, _) = weight_at(cut, q, point);
                let length = weight * (side.to - side.from);
                basis.at(point, &mut functions);
                let duals = self.at(point, sheet);
                for (k, function) in functions.iter().enumerate() {
                    for mode in 0..2 {
                        let traction = duals[mode].stress.traction(Vec2::new(0.0, 1.0));
                        let value = -self.scale * q * length * traction.dot(function.value);
                        self.add(&basis, k, value, &mut sums[mode]);
                    }
                }
            }
        }
    }

    /// ∫ q t⁺·⟦v⟧ ds − ∫ q (t(v)⁺·u⁺ + t(v)⁻·u⁻) ds over the faces of all cracks.
    fn faces(&self, weight: &dyn Fn(usize) -> f64, sums: &mut [SifFunctional; 2]) {
        let SifContext { mesh, cuts, interface, .. } = *self.context;
        let path = &cuts.tips[self.tip];
        let mut functions: Vec<Function> = Vec::new();
        for station in &interface.stations {
            let piece = &cuts.pieces[station.piece];
            let nodes = mesh.element(piece.plus.element).nodes;
            let q = [0, 1, 2, 3].map(|corner| weight(nodes[corner]));
            if q.iter().all(|&q| q == 0.0) {
                continue;
            }
            let (q, _) = weight_at(&cuts.elements[&piece.plus.element], q, station.point);
            let length = self.scale * q * station.length;
            let (from, to) = cuts.paths[piece.crack].segment(piece.segment);
            let own_segment = piece.crack == path.crack && {
                let (a, b) = path.last_segment();
                (a, b) == (from, to) || (a, b) == (to, from)
            };
            let mut jump = [Vec2::default(); 2];
            for (place, sign) in [(piece.plus, 1.0), (piece.minus, -1.0)] {
                let cut = &cuts.elements[&place.element];
                let duals = self.at(station.point, self.sheet(cut, place.cell));
                for (jump, dual) in jump.iter_mut().zip(&duals) {
                    *jump = *jump + dual.displacement * sign;
                }
                if own_segment {
                    continue;
                }
                // The outward normal of the body points to − on the + face.
                let outwards = (to - from).normalised().left() * -sign;
                let basis = self.basis(place.element, cut, place.cell);
                basis.at(station.point, &mut functions);
                for (k, function) in functions.iter().enumerate() {
                    for mode in 0..2 {
                        let traction = duals[mode].stress.traction(outwards);
                        self.add(&basis, k, -length * traction.dot(function.value), &mut sums[mode]);
                    }
                }
            }
            for (point, lambda) in station.tractions {
                for mode in 0..2 {
                    sums[mode].tractions[2 * point] += length * lambda * jump[mode].x;
                    sums[mode].tractions[2 * point + 1] += length * lambda * jump[mode].y;
                }
            }
        }
    }
}

/// Smallest ratio of the outer to the inner radius of a domain: with an inner radius of 1.5
/// elements, more than an element lies between them. A smaller inner radius extends into the
/// elements at the tip and costs 0.9 % of K.
const SMALLEST: f64 = 2.0;

/// Distance, in elements, between a tip and its neighbour below which K is unreliable, since both
/// lie in one element. Measured against fine elements of the other engine: within 0.1 % of the
/// largest K down to 1.4 elements, 0.8 % at 0.6, 6 % at 0.4.
const TRUSTED: f64 = 1.0;

/// The inner radius over the outer one where the domain ends at the bottom or a side of a block:
/// the weight must be 1 in the element of the tip.
const NARROWEST: f64 = 0.75;

/// The same from the bottom or a side of a block, at which the domain ends: nearer, its weight
/// falls within the element of the tip. Measured on tips above the bottom: 0.01 % of the largest K
/// at 3.2 elements, 15 % at 2.1.
const TRUSTED_AT_END: f64 = 3.0;

/// The nearest neighbour of a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Neighbour {
    Crack(usize),
    Surface,
}

/// The domain of tip `tip`, around which elements have the size `size` (mm): as in `settings`, but
/// extending no farther than the nearest other crack or the running surface, down to [`SMALLEST`],
/// and never beyond the bottom or the sides of the mesh, whose tractions are not known. Neighbours
/// inside the smallest domain contribute to its integral through their faces. The remark reports a
/// neighbour, or an end of the mesh, that is too near.
pub(super) fn domain_of(
    mesh: &QuadMesh,
    cuts: &Cuts,
    tip: usize,
    size: f64,
    settings: &XfemSettings,
) -> (SifDomain, Option<String>) {
    let inner = settings.domain_inner * size;
    let wanted = settings.domain_outer * size;
    let (distance, neighbour) = nearest(cuts, tip);
    let end = distance_to_end(mesh, cuts.tips[tip].position());
    let outer = wanted.min(distance.max(SMALLEST * inner)).min(end);
    let domain = SifDomain { inner: inner.min(NARROWEST * outer), outer };
    let too_near = |distance: f64, near: &str| {
        let path = &cuts.tips[tip];
        let at = path.position();
        format!(
            "crack {}: its tip at ({:.3}, {:.3}) mm is {distance:.3} mm from {near}, {:.2} of an element: its K cannot be trusted; smaller \
             elements (element_size_mm) resolve it",
            path.crack + 1,
            at.x,
            at.y,
            distance / size
        )
    };
    let remark = if distance < TRUSTED * size {
        Some(match neighbour {
            Neighbour::Crack(crack) => too_near(distance, &format!("crack {}", crack + 1)),
            Neighbour::Surface => too_near(distance, "the running surface"),
        })
    } else {
        (end < TRUSTED_AT_END * size).then(|| too_near(end, "the bottom or a side of the block"))
    };
    (domain, remark)
}

/// Distance (mm) from `point` to the bottom or the nearer side of `mesh`.
fn distance_to_end(mesh: &QuadMesh, point: Vec2) -> f64 {
    let (x, y) = (mesh.x_lines(), mesh.y_lines());
    (point.x - x[0]).min(x[x.len() - 1] - point.x).min(point.y - y[0])
}

/// Distance, in elements, between a tip and the last sharp kink of its crack below which K is
/// unreliable, since crack-face friction around the corner is not resolved. Measured against fine
/// elements of the other engine, kinks of 40° and 70° to either side: up to 15 % of the largest K
/// at a quarter of an element, 8 % at one, 6 % at 1.6, 4 % at 2.4.
const TRUSTED_PART: f64 = 1.25;

/// A remark on a last segment after a sharp kink that is too short for elements of `size` (mm).
pub(super) fn short_part(cuts: &Cuts, tip: usize, size: f64) -> Option<String> {
    let path = &cuts.tips[tip];
    let (from, to) = path.last_segment();
    let length = (to - from).length();
    let turn = path.last_turn().filter(|&turn| turn > SHARP_KINK && length < TRUSTED_PART * size)?;
    Some(format!(
        "crack {}: its tip at ({:.3}, {:.3}) mm is {length:.3} mm behind a kink of {:.0}°, {:.2} of an element: its K under friction cannot be \
         trusted; larger increments, or smaller elements (element_size_mm), resolve it",
        path.crack + 1,
        to.x,
        to.y,
        turn.to_degrees(),
        length / size
    ))
}

/// Distance (mm) from a tip to the nearest other crack or the surface.
fn nearest(cuts: &Cuts, tip: usize) -> (f64, Neighbour) {
    let path = &cuts.tips[tip];
    let at: Vec2 = path.position();
    let others = cuts.paths.iter().enumerate().filter(|(crack, _)| *crack != path.crack);
    let cracks = others.map(|(crack, other)| {
        let distances = other.points.windows(2).map(|pair| point_to_segment(at, pair[0], pair[1]));
        (distances.fold(f64::INFINITY, f64::min), Neighbour::Crack(crack))
    });
    cracks.fold((-at.y, Neighbour::Surface), |best, one| if one.0 < best.0 { one } else { best })
}

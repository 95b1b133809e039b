//! Displacement functions of one cell and their derivatives, and quadrature over cells.

use super::cuts::{CellPlace, CutElement, Cuts};
use super::path::TipPath;
use super::space::Space;
use crate::fracture::{Sif, WilliamsField};
use crate::material::IsotropicElastic;
use crate::math::{Orientation, Stress, Vec2, gauss_legendre, orientation};
use crate::mesh::{Element, NODES, shape_functions};

/// A displacement function at a point: its value and derivatives, x and y components.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Function {
    pub value: Vec2,
    pub dx: Vec2,
    pub dy: Vec2,
}

impl Function {
    /// ε_xx, ε_yy, γ_xy.
    pub(super) fn strain(&self) -> [f64; 3] {
        [self.dx.x, self.dy.y, self.dx.y + self.dy.x]
    }
}

/// The unknowns to which a function of a cell belongs: the standard one and the enriched one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Target {
    pub standard: Option<usize>,
    pub enriched: Option<usize>,
}

/// Plane-strain elasticity: stress from ε_xx, ε_yy, γ_xy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Elasticity {
    pub steel: IsotropicElastic,
}

impl Elasticity {
    pub(super) fn new(steel: IsotropicElastic) -> Self {
        Self { steel }
    }

    /// σ_xx, σ_yy, σ_xy.
    pub(super) fn stress(&self, strain: [f64; 3]) -> [f64; 3] {
        let stress = self.full_stress(strain);
        [stress.xx, stress.yy, stress.xy]
    }

    /// The four components of plane strain.
    pub(super) fn full_stress(&self, [xx, yy, xy]: [f64; 3]) -> Stress {
        self.steel.plane_strain_stress(xx, yy, xy)
    }
}

/// The functions on one cell: two standard ones per node of the element, the same two with the
/// unknowns of the part of its support, then two per node with the enrichment functions of a tip or
/// kink.
pub(super) struct CellBasis<'a> {
    element: Element,
    tips: Vec<TipBasis<'a>>,
    pub targets: Vec<Target>,
}

struct TipBasis<'a> {
    path: &'a TipPath,
    nodes: [Option<usize>; NODES],
    /// A point of the cell and its angle at the tip, which select the sheet of the cell.
    sheet: (Vec2, f64),
    modes: [WilliamsField; 2],
}

/// K_I alone and K_II alone, 1 MPa √mm.
pub(super) const MODES: [Sif; 2] = [Sif { ki: 1.0, kii: 0.0 }, Sif { ki: 0.0, kii: 1.0 }];

impl<'a> CellBasis<'a> {
    /// The first functions, those of the nodes.
    pub(super) const NODAL: usize = 2 * NODES;

    pub(super) fn new(
        cuts: &'a Cuts,
        space: &Space,
        cut: &CutElement,
        place: CellPlace,
        steel: &IsotropicElastic,
    ) -> Self {
        let mut targets = Vec::with_capacity(2 * NODES + 8);
        for (node, part) in cut.element.nodes.into_iter().zip(space.parts_in(cuts, place)) {
            for direction in 0..2 {
                targets.push(Target {
                    standard: Some(2 * node + direction),
                    enriched: part.map(|part| 2 * part + direction),
                });
            }
        }
        let polygon = cut.arrangement.polygon(place.cell);
        let mut tips = Vec::new();
        for &(tip, nodes) in space.tips_in(place.element) {
            let path = &cuts.poles[tip];
            for enrichment in nodes.into_iter().flatten() {
                for mode in 0..2 {
                    targets.push(Target { standard: None, enriched: Some(2 * enrichment + mode) });
                }
            }
            let modes = MODES.map(|mode| WilliamsField::of(mode, steel));
            tips.push(TipBasis { path, nodes, sheet: path.sheet(&polygon), modes });
        }
        Self { element: cut.element, tips, targets }
    }

    /// All functions at a point (mm) of the cell, in the order of the targets.
    pub(super) fn at(&self, point: Vec2, functions: &mut Vec<Function>) {
        functions.clear();
        let (xi, eta) = self.element.reference(point);
        let size = self.element.size();
        let slopes = (2.0 / size.x, 2.0 / size.y);
        let shapes = shape_functions(xi, eta);
        for [n, d_xi, d_eta] in shapes {
            let (dx, dy) = (d_xi * slopes.0, d_eta * slopes.1);
            let along = |v: f64| Vec2::new(v, 0.0);
            let up = |v: f64| Vec2::new(0.0, v);
            functions.push(Function { value: along(n), dx: along(dx), dy: along(dy) });
            functions.push(Function { value: up(n), dx: up(dx), dy: up(dy) });
        }
        for tip in &self.tips {
            let fields = tip.fields(point);
            for (_, [n, d_xi, d_eta]) in tip.nodes.iter().zip(shapes).filter(|(node, _)| node.is_some()) {
                let (dx, dy) = (d_xi * slopes.0, d_eta * slopes.1);
                for field in &fields {
                    functions.push(Function {
                        value: field.value * n,
                        dx: field.dx * n + field.value * dx,
                        dy: field.dy * n + field.value * dy,
                    });
                }
            }
        }
    }
}

impl TipBasis<'_> {
    fn fields(&self, point: Vec2) -> [Function; 2] {
        let r = (point - self.path.position()).length();
        if r == 0.0 {
            return [Function::default(); 2];
        }
        let theta = self.path.angle_near(point, self.sheet.0, self.sheet.1);
        let ahead = self.path.ahead;
        let powers = self.modes[0].powers(r, theta);
        self.modes.map(|mode| {
            let field = mode.of_powers(&powers, 0.0);
            let (along, across) = (self.path.to_global(field.along), self.path.to_global(field.across));
            Function {
                value: self.path.to_global(field.displacement),
                dx: along * ahead.x + across * ahead.left().x,
                dy: along * ahead.y + across * ahead.left().y,
            }
        })
    }
}

/// A point (mm) with its weight (mm²).
pub(super) type WeightedPoint = (Vec2, f64);

/// Gauss rules by number of points.
#[derive(Debug, Clone)]
pub(super) struct Rules {
    rules: Vec<Vec<(f64, f64)>>,
}

/// Points per direction for products of derivatives of eight-node shape functions: of degree 4
/// together, and 5 with the mapping of a square to a triangle.
const POLYNOMIAL: usize = 3;
/// Points per direction and triangle at the tip, where r = t² makes the integrand smooth.
const AT_TIP: usize = 8;

impl Rules {
    pub(super) fn new() -> Self {
        Self { rules: (0..=12).map(gauss_legendre).collect() }
    }

    /// The quadrature points of a cell. `singular` are the tips whose √r functions act in the
    /// element.
    pub(super) fn on_cell(&self, cut: &CutElement, cell: usize, singular: &[Vec2]) -> Vec<WeightedPoint> {
        let polygon = cut.arrangement.polygon(cell);
        let size = cut.element.size();
        let reach = size.x.max(size.y);
        let nearest = singular
            .iter()
            .map(|&tip| (distance(&polygon, tip) / reach, tip))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let whole = cut.arrangement.cells.len() == 1;
        match nearest {
            Some((ratio, tip)) if ratio < NEAR => self.around(&polygon, tip, AT_TIP, Radial::Squared),
            Some((ratio, tip)) => {
                // Gauss quadrature of r^(−1) at this distance converges like ρ^(−2n).
                let points = if ratio < 1.5 { 7 } else { 5 };
                if whole {
                    self.rectangle(cut, points)
                } else {
                    self.around(&polygon, tip, points, Radial::Linear)
                }
            }
            None if whole => self.rectangle(cut, 3),
            None => self.fan(&polygon, POLYNOMIAL),
        }
    }

    fn rectangle(&self, cut: &CutElement, points: usize) -> Vec<WeightedPoint> {
        let (lower, size) = (cut.element.lower, cut.element.size());
        let rule = &self.rules[points];
        let area = size.x * size.y;
        rule.iter()
            .flat_map(|&(s, v)| {
                rule.iter()
                    .map(move |&(t, w)| (Vec2::new(lower.x + s * size.x, lower.y + t * size.y), v * w * area))
            })
            .collect()
    }

    /// Points in the triangles from the first corner of a convex polygon, each a collapsed square,
    /// for integrands that this rule integrates exactly.
    fn fan(&self, polygon: &[Vec2], points: usize) -> Vec<WeightedPoint> {
        let mut all = Vec::new();
        for i in 1..polygon.len() - 1 {
            self.triangle(polygon[0], polygon[i], polygon[i + 1], points, Radial::Linear, &mut all);
        }
        all
    }

    /// Points in the triangles from the point of the polygon nearest to the tip, which is the tip
    /// itself if it is a corner. Mirrored polygons have mirrored triangles.
    fn around(&self, polygon: &[Vec2], tip: Vec2, points: usize, radial: Radial) -> Vec<WeightedPoint> {
        let apex = nearest_point(polygon, tip);
        let mut all = Vec::new();
        for i in 0..polygon.len() {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            self.triangle(apex, a, b, points, radial, &mut all);
        }
        all
    }

    fn triangle(
        &self,
        apex: Vec2,
        a: Vec2,
        b: Vec2,
        points: usize,
        radial: Radial,
        all: &mut Vec<WeightedPoint>,
    ) {
        let twice_area = (a - apex).cross(b - apex);
        if twice_area <= 0.0 {
            return;
        }
        let rule = &self.rules[points];
        for &(s, v) in rule {
            // The fraction of the distance from the apex, and its weight times that fraction.
            let (share, weight) = match radial {
                Radial::Linear => (s, v * s),
                Radial::Squared => (s * s, 2.0 * v * s * s * s),
            };
            for &(t, w) in rule {
                let point = apex + ((a - apex) * (1.0 - t) + (b - apex) * t) * share;
                all.push((point, weight * w * twice_area));
            }
        }
    }
}

/// Distribution of the points from the apex of a triangle.
#[derive(Clone, Copy)]
enum Radial {
    /// Uniform in the distance.
    Linear,
    /// Proportional to t², for integrands like r^(−1).
    Squared,
}

/// Distance from a tip, over the size of the element, below which a cell is integrated from its
/// point nearest to the tip.
const NEAR: f64 = 0.6;

/// Distance (mm) of a point from a convex polygon, 0 inside.
fn distance(polygon: &[Vec2], point: Vec2) -> f64 {
    (nearest_point(polygon, point) - point).length()
}

fn nearest_point(polygon: &[Vec2], point: Vec2) -> Vec2 {
    if polygon.contains(&point) {
        return point;
    }
    let sides = (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    if sides.clone().all(|(a, b)| orientation(a, b, point) != Orientation::Right) {
        return point;
    }
    sides
        .map(|(a, b)| {
            let along = b - a;
            let squared = along.dot(along);
            let t = if squared > 0.0 { ((point - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
            a + along * t
        })
        .min_by(|p, q| (*p - point).length().total_cmp(&(*q - point).length()))
        .expect("a polygon has sides")
}

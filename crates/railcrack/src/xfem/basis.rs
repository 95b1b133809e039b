//! Displacement functions of one cell and their derivatives.

use super::cuts::{CellPlace, CutElement, Cuts};
use super::path::TipPath;
use super::space::Space;
use crate::fracture::{Sif, WilliamsField};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
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

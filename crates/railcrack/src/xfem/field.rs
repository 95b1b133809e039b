//! Displacement and stress fields of cracked bodies.

use super::basis::{CellBasis, Elasticity, Function};
use super::condense::{Elimination, Unknowns};
use super::cuts::{CellPlace, CutElement, Cuts};
use super::error::XfemError;
use super::interface::{Duality, Interface};
use super::space::Space;
use crate::body::{BodyError, BodyFields, Face, FieldGrid, FieldLine, FieldLoad, FieldSolver, PointField};
use crate::bulk::{BlockCorrection, Boundary, BulkRail};
use crate::math::{Stress, Vec2};
use crate::mesh::{CORNERS, Element, NODES, QuadMesh, shape_functions};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// The data from which the unknowns of a body follow.
#[derive(Debug, Clone)]
pub(super) struct Inside {
    pub rail: Arc<BulkRail>,
    pub cuts: Cuts,
    pub space: Space,
    pub interface: Interface,
    pub duality: Duality,
    pub elimination: Elimination,
}

/// Distance from the bounding box of the cracks, over the length of the longest one, up to which
/// fields are given.
const MARGIN: f64 = 0.25;

/// The displacements under one load.
struct Displacements {
    /// Displacements of the nodes of the mesh, mm; complete only at the nodes on which the grid
    /// depends.
    nodes: Vec<Vec2>,
    enriched: Vec<f64>,
}

impl FieldSolver for Inside {
    fn fields(&self, loads: &[FieldLoad]) -> Result<BodyFields, BodyError> {
        let lengths = self.cuts.paths.iter().map(|path| path.s[path.segments()]);
        self.fields_within(MARGIN * lengths.fold(0.0, f64::max), loads)
            .map_err(|reason| BodyError { reason: Box::new(reason) })
    }
}

impl Inside {
    /// The fields under `loads` up to `margin` (mm) from the box of the cracks.
    pub(super) fn fields_within(&self, margin: f64, loads: &[FieldLoad]) -> Result<BodyFields, XfemError> {
        let layout = Layout::new(self.rail.mesh(), &self.cuts, &self.interface, margin);
        let unknowns = self.unknowns(&layout, loads)?;
        let fields = unknowns.iter().map(|unknowns| self.on(&layout, unknowns)).collect();
        Ok(BodyFields { grid: layout.grid, loads: fields })
    }

    fn unknowns(&self, layout: &Layout, loads: &[FieldLoad]) -> Result<Vec<Displacements>, XfemError> {
        let tractions: Vec<Vec<f64>> = loads.iter().map(|load| self.duality.tractions(load.forces)).collect();
        let nodes = layout.mesh_nodes(self.rail.mesh());
        let Unknowns { standard, enriched } = self.elimination.unknowns(&self.rail, &tractions, nodes)?;
        let is_block = self.rail.boundary() != Boundary::HalfPlane;
        let under = |(k, (load, enriched)): (usize, (&FieldLoad, Vec<f64>))| {
            let standard = standard.row(k);
            let of_node = |node: usize| {
                let [x, y] =
                    self.rail.unknowns(node).map(|unknown| unknown.map_or(0.0, |free| standard[free]));
                Vec2::new(x, y)
            };
            let mut nodes: Vec<Vec2> = (0..self.rail.mesh().node_count()).map(of_node).collect();
            if let (Some((wheel, xc)), true) = (load.wheel, is_block) {
                // A single position needs one solution and no interpolation.
                let displacements = BlockCorrection::new(&self.rail, wheel, xc..=xc)?.displacements(xc)?;
                nodes.iter_mut().zip(displacements).for_each(|(node, u)| *node = *node + u);
            }
            Ok(Displacements { nodes, enriched })
        };
        loads.iter().zip(enriched).enumerate().map(under).collect()
    }

    fn on(&self, layout: &Layout, unknowns: &Displacements) -> PointField {
        let points = layout.grid.points.len();
        let elasticity = Elasticity::new(*self.rail.steel());
        let mut field =
            PointField { displacement: vec![Vec2::default(); points], stress: vec![Stress::ZERO; points] };
        let mut elements = vec![0.0; layout.nodes.len()];
        for (&e, places) in layout.whole.iter().zip(&layout.grid.quads) {
            let element = self.rail.mesh().element(e);
            let stresses = nodal_stresses(&element, &unknowns.nodes, &elasticity);
            for (&place, stress) in places.iter().zip(stresses) {
                field.stress[place] = field.stress[place] + stress;
                elements[place] += 1.0;
            }
        }
        for (&node, &place) in &layout.nodes {
            field.displacement[place] = unknowns.nodes[node];
            field.stress[place] = field.stress[place] * (1.0 / elements[place]);
        }
        let of_cell = |(place, points): &(CellPlace, Range<usize>)| {
            self.in_cell(*place, points.clone(), layout, unknowns, &elasticity)
        };
        let cells: Vec<Vec<(Vec2, Stress)>> = layout.cells.par_iter().map(of_cell).collect();
        for ((_, points), values) in layout.cells.iter().zip(cells) {
            for (point, (displacement, stress)) in points.clone().zip(values) {
                field.displacement[point] = displacement;
                field.stress[point] = stress;
            }
        }
        field
    }

    /// Displacement and stress at the `points` of a cell from all its functions.
    fn in_cell(
        &self,
        place: CellPlace,
        points: Range<usize>,
        layout: &Layout,
        unknowns: &Displacements,
        elasticity: &Elasticity,
    ) -> Vec<(Vec2, Stress)> {
        let cut = &self.cuts.elements[&place.element];
        let basis = CellBasis::new(&self.cuts, &self.space, cut, place, &elasticity.steel);
        let values: Vec<f64> = basis
            .targets
            .iter()
            .map(|target| {
                let standard = target.standard.map_or(0.0, |unknown| {
                    let node = unknowns.nodes[unknown / 2];
                    if unknown.is_multiple_of(2) { node.x } else { node.y }
                });
                standard + target.enriched.map_or(0.0, |unknown| unknowns.enriched[unknown])
            })
            .collect();
        let mut functions: Vec<Function> = Vec::new();
        points
            .map(|point| {
                basis.at(layout.grid.points[point], &mut functions);
                let displacement =
                    functions.iter().zip(&values).fold(Vec2::default(), |sum, (f, v)| sum + f.value * *v);
                basis.at(layout.grid.inside[point], &mut functions);
                let mut strain = [0.0; 3];
                for (function, value) in functions.iter().zip(&values) {
                    strain.iter_mut().zip(function.strain()).for_each(|(sum, part)| *sum += value * part);
                }
                (displacement, elasticity.full_stress(strain))
            })
            .collect()
    }
}

/// The stress (MPa) at the nodes of an element without enrichment, extrapolated bilinearly from its
/// 2 × 2 Gauss points, where it is superconvergent (Barlow, Int. J. Numer. Meth. Engng 10, 1976).
fn nodal_stresses(element: &Element, nodes: &[Vec2], elasticity: &Elasticity) -> [Stress; NODES] {
    let gauss = 1.0 / 3.0f64.sqrt();
    let size = element.size();
    let at_gauss = CORNERS.map(|[a, b]| {
        let shapes = shape_functions(a * gauss, b * gauss);
        let mut strain = [0.0; 3];
        for (node, [_, d_xi, d_eta]) in element.nodes.into_iter().zip(shapes) {
            let (u, dx, dy) = (nodes[node], d_xi * 2.0 / size.x, d_eta * 2.0 / size.y);
            strain[0] += dx * u.x;
            strain[1] += dy * u.y;
            strain[2] += dy * u.x + dx * u.y;
        }
        elasticity.full_stress(strain)
    });
    let middles = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
    std::array::from_fn(|k| {
        let [xi, eta] = if k < CORNERS.len() { CORNERS[k] } else { middles[k - CORNERS.len()] };
        CORNERS.iter().zip(&at_gauss).fold(Stress::ZERO, |sum, ([a, b], stress)| {
            sum + *stress * (0.25 * (1.0 + a * xi / gauss) * (1.0 + b * eta / gauss))
        })
    })
}

/// A grid, and the elements and cells from which its points come.
pub(super) struct Layout {
    pub grid: FieldGrid,
    /// Elements that no crack and no enrichment touches.
    pub whole: Vec<usize>,
    /// Points at the nodes of these elements.
    pub nodes: BTreeMap<usize, usize>,
    /// Cells of all other elements, with their points; the points of the faces come last.
    pub cells: Vec<(CellPlace, Range<usize>)>,
}

/// Fraction of the distance to the centre of the cell at which the stress of a point at a tip or a
/// kink is evaluated, since it is infinite at the point itself.
const INSIDE: f64 = 0.1;
/// Distance from a tip or a kink, relative to the element, below which a corner counts as lying at
/// it.
const AT_POLE: f64 = 1e-9;

impl Layout {
    /// The elements that meet the bounding box of the cracks widened by `margin` (mm).
    pub(super) fn new(mesh: &QuadMesh, cuts: &Cuts, interface: &Interface, margin: f64) -> Self {
        let mut layout =
            Self { grid: FieldGrid::default(), whole: Vec::new(), nodes: BTreeMap::new(), cells: Vec::new() };
        let points = || cuts.paths.iter().flat_map(|path| path.points.iter().copied());
        let infinite = Vec2::new(f64::INFINITY, f64::INFINITY);
        let lower = points().fold(infinite, |low, p| Vec2::new(low.x.min(p.x), low.y.min(p.y)));
        let upper = points().fold(-infinite, |high, p| Vec2::new(high.x.max(p.x), high.y.max(p.y)));
        let margin = Vec2::new(margin, margin);
        let (columns, rows) = mesh.places_meeting(lower - margin, upper + margin);
        let elements: Vec<usize> =
            rows.flat_map(|row| columns.clone().map(move |column| row * mesh.columns() + column)).collect();
        layout.add_whole(mesh, elements.iter().copied().filter(|e| !cuts.elements.contains_key(e)));
        for e in elements {
            if let Some(cut) = cuts.elements.get(&e) {
                layout.add_cells(mesh, cuts, e, cut);
            }
        }
        layout.add_faces(cuts, interface);
        layout
    }

    /// The nodes of all its elements, with repetitions.
    pub(super) fn mesh_nodes(&self, mesh: &QuadMesh) -> impl Iterator<Item = usize> {
        let others = self.cells.iter().flat_map(|(place, _)| mesh.element(place.element).nodes);
        self.nodes.keys().copied().chain(others)
    }

    fn add_whole(&mut self, mesh: &QuadMesh, elements: impl Iterator<Item = usize>) {
        self.whole = elements.collect();
        for node in self.whole.iter().flat_map(|&e| mesh.element(e).nodes) {
            self.nodes.insert(node, 0);
        }
        for (point, (&node, place)) in self.nodes.iter_mut().enumerate() {
            *place = point;
            self.grid.points.push(mesh.node_position(node));
        }
        self.grid.inside = self.grid.points.clone();
        for &e in &self.whole {
            self.grid.quads.push(mesh.element(e).nodes.map(|node| self.nodes[&node]));
        }
    }

    fn add_cells(&mut self, mesh: &QuadMesh, cuts: &Cuts, element: usize, cut: &CutElement) {
        let cells = cut.arrangement.cells.len();
        for cell in 0..cells {
            let place = CellPlace { element, cell };
            let first = self.grid.points.len();
            if cells == 1 {
                let corners: [Vec2; NODES] = cut.element.nodes.map(|node| mesh.node_position(node));
                self.add_points(cuts, cut, place, &corners);
                self.grid.quads.push(std::array::from_fn(|k| first + k));
                continue;
            }
            let polygon = cut.arrangement.polygon(cell);
            self.add_points(cuts, cut, place, &polygon);
            self.grid.triangles.extend((1..polygon.len() - 1).map(|k| [first, first + k, first + k + 1]));
        }
    }

    fn add_faces(&mut self, cuts: &Cuts, interface: &Interface) {
        for line in interface.lines(cuts) {
            let piece = &cuts.pieces[line.piece];
            for (face, place) in [(Face::Plus, piece.plus), (Face::Minus, piece.minus)] {
                let first = self.grid.points.len();
                self.add_points(cuts, &cuts.elements[&place.element], place, &line.ends);
                self.grid.lines.push(FieldLine { face, ends: [first, first + 1], tractions: line.tractions });
            }
        }
    }

    fn add_points(&mut self, cuts: &Cuts, cut: &CutElement, place: CellPlace, points: &[Vec2]) {
        let first = self.grid.points.len();
        let polygon = cut.arrangement.polygon(place.cell);
        let middle = polygon.iter().fold(Vec2::default(), |sum, &v| sum + v) * (1.0 / polygon.len() as f64);
        let size = cut.element.size();
        let at_pole = |point: Vec2| {
            let near = AT_POLE * size.x.max(size.y);
            cuts.poles.iter().any(|pole| (pole.position() - point).length() <= near)
        };
        for &point in points {
            self.grid.points.push(point);
            self.grid.inside.push(if at_pole(point) { point + (middle - point) * INSIDE } else { point });
        }
        self.cells.push((place, first..self.grid.points.len()));
    }
}

#[cfg(test)]
#[path = "field_tests.rs"]
mod tests;

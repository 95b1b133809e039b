//! Output grid of the field of a cracked body.

use super::cuts::{CellPlace, CutElement, Cuts};
use super::interface::Interface;
use crate::body::{Face, FieldGrid, FieldLine};
use crate::math::Vec2;
use crate::mesh::{NODES, QuadMesh};
use std::collections::BTreeMap;
use std::ops::Range;

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

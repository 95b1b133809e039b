//! Arrangements of lines that divide a rectangle into convex cells.

use crate::math::{Orientation, Vec2, orientation};
use crate::mesh::{Edge, Element};
use std::collections::HashMap;

/// A line through two points that cuts the whole element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CutLine {
    pub from: Vec2,
    pub to: Vec2,
}

/// The line on which an edge of a cell lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EdgeLine {
    /// A side of the element.
    Side(Edge),
    /// A cutting line, by index.
    Line(usize),
}

/// A convex cell, counter-clockwise; `edge_lines[k]` is the line of the edge from vertex k to the
/// next one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    pub vertices: Vec<usize>,
    pub edge_lines: Vec<EdgeLine>,
}

/// The cells of an element: an arrangement of whole lines, so that each inner edge lies between
/// exactly two cells that share both its ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Arrangement {
    pub vertices: Vec<Vec2>,
    pub cells: Vec<Cell>,
}

impl Arrangement {
    /// The undivided element.
    pub(super) fn whole(element: &Element) -> Self {
        let cell = Cell {
            vertices: vec![0, 1, 2, 3],
            edge_lines: Edge::ALL.into_iter().map(EdgeLine::Side).collect(),
        };
        Self { vertices: element.corners().to_vec(), cells: vec![cell] }
    }

    /// The element cut by `lines`.
    ///
    /// Orientations are decided exactly; a point constructed on a line lies on it by construction,
    /// so that round-off in its coordinates cannot contradict the order of the cells.
    pub(super) fn new(element: &Element, lines: &[CutLine]) -> Self {
        let mut cut = Self::whole(element);
        // The lines through each vertex.
        let mut on: Vec<Vec<EdgeLine>> = vec![Vec::new(); 4];
        for (index, line) in lines.iter().enumerate() {
            let label = EdgeLine::Line(index);
            let side = cut.sides(line, label, &mut on);
            let mut made: HashMap<(usize, usize), usize> = HashMap::new();
            let mut cells = Vec::with_capacity(cut.cells.len() + 2);
            for cell in std::mem::take(&mut cut.cells) {
                let has = |wanted| cell.vertices.iter().any(|&v| side[v] == wanted);
                if !(has(Orientation::Left) && has(Orientation::Right)) {
                    cells.push(cell);
                    continue;
                }
                let mut halves = [Ring::default(), Ring::default()];
                let n = cell.vertices.len();
                for k in 0..n {
                    let (a, b) = (cell.vertices[k], cell.vertices[(k + 1) % n]);
                    let border = cell.edge_lines[k];
                    let crosses = matches!(
                        (side[a], side[b]),
                        (Orientation::Left, Orientation::Right) | (Orientation::Right, Orientation::Left)
                    );
                    let middle = crosses.then(|| {
                        *made.entry((a.min(b), a.max(b))).or_insert_with(|| {
                            let ends = (cut.vertices[a], cut.vertices[b]);
                            cut.vertices.push(crossing(element, lines, border, index, ends));
                            on.push(vec![border, label]);
                            cut.vertices.len() - 1
                        })
                    });
                    match side[a] {
                        Orientation::Left => halves[0].push(a, border),
                        Orientation::Right => halves[1].push(a, border),
                        Orientation::On => {
                            // The cell leaves the line on the side of b, and the other half closes
                            // along the line.
                            let (own, other) = if side[b] == Orientation::Left { (0, 1) } else { (1, 0) };
                            halves[own].push(a, border);
                            halves[other].push(a, label);
                        }
                    }
                    if let Some(middle) = middle {
                        let (own, other) = if side[a] == Orientation::Left { (0, 1) } else { (1, 0) };
                        halves[own].push(middle, label);
                        halves[other].push(middle, border);
                    }
                }
                cells
                    .extend(halves.map(|ring| Cell { vertices: ring.vertices, edge_lines: ring.edge_lines }));
            }
            cut.cells = cells;
        }
        cut
    }

    /// The sides of `line` on which the vertices lie, and its `label` among the lines `on` each.
    fn sides(&self, line: &CutLine, label: EdgeLine, on: &mut [Vec<EdgeLine>]) -> Vec<Orientation> {
        let side = |(&v, on): (&Vec2, &mut Vec<EdgeLine>)| {
            if on.contains(&label) {
                return Orientation::On;
            }
            let side = orientation(line.from, line.to, v);
            if side == Orientation::On {
                on.push(label);
            }
            side
        };
        self.vertices.iter().zip(on).map(side).collect()
    }

    /// The corners of a cell, counter-clockwise, mm.
    pub(super) fn polygon(&self, cell: usize) -> Vec<Vec2> {
        self.cells[cell].vertices.iter().map(|&v| self.vertices[v]).collect()
    }
}

#[derive(Default)]
struct Ring {
    vertices: Vec<usize>,
    edge_lines: Vec<EdgeLine>,
}

impl Ring {
    fn push(&mut self, vertex: usize, border: EdgeLine) {
        self.vertices.push(vertex);
        self.edge_lines.push(border);
    }
}

/// The intersection of line `index` with an edge of a cell that lies on `border`. On a side of the
/// element the point depends on the side and the line alone, so that both elements at the side get
/// the same bits.
fn crossing(
    element: &Element,
    lines: &[CutLine],
    border: EdgeLine,
    index: usize,
    ends: (Vec2, Vec2),
) -> Vec2 {
    let line = lines[index];
    match border {
        EdgeLine::Side(side @ (Edge::Bottom | Edge::Top)) => {
            let y = if side == Edge::Bottom { element.lower.y } else { element.upper.y };
            let x = level((line.from.y, line.from.x), (line.to.y, line.to.x), y);
            Vec2::new(x.clamp(ends.0.x.min(ends.1.x), ends.0.x.max(ends.1.x)), y)
        }
        EdgeLine::Side(side @ (Edge::Left | Edge::Right)) => {
            let x = if side == Edge::Left { element.lower.x } else { element.upper.x };
            let y = level((line.from.x, line.from.y), (line.to.x, line.to.y), x);
            Vec2::new(x, y.clamp(ends.0.y.min(ends.1.y), ends.0.y.max(ends.1.y)))
        }
        EdgeLine::Line(other) => {
            let other = lines[other];
            for point in [line.from, line.to] {
                if point == other.from || point == other.to {
                    return point;
                }
            }
            let (along, across) = (other.to - other.from, line.to - line.from);
            let t = (line.from - other.from).cross(across) / along.cross(across);
            other.from + along * t
        }
    }
}

/// The second coordinate at which the line through two points has the first coordinate `at`.
fn level(from: (f64, f64), to: (f64, f64), at: f64) -> f64 {
    if from.0 == at {
        from.1
    } else if to.0 == at {
        to.1
    } else {
        from.1 + (to.1 - from.1) * ((at - from.0) / (to.0 - from.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::QuadMesh;

    fn unit() -> Element {
        QuadMesh::new(vec![0.0, 1.0], vec![-1.0, 0.0]).unwrap().element(0)
    }

    fn area(cut: &Arrangement, cell: usize) -> f64 {
        let p = cut.polygon(cell);
        0.5 * (0..p.len()).map(|i| p[i].cross(p[(i + 1) % p.len()])).sum::<f64>()
    }

    fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> CutLine {
        CutLine { from: Vec2::new(x0, y0), to: Vec2::new(x1, y1) }
    }

    /// Every inner edge is shared by two cells, and the cells fill the element.
    fn conforms(cut: &Arrangement) {
        let total: f64 = (0..cut.cells.len()).map(|c| area(cut, c)).sum();
        assert!((total - 1.0).abs() < 1e-14, "area {total}");
        for cell in &cut.cells {
            let n = cell.vertices.len();
            for k in 0..n {
                let EdgeLine::Line(_) = cell.edge_lines[k] else { continue };
                let (a, b) = (cell.vertices[k], cell.vertices[(k + 1) % n]);
                let twins = cut.cells.iter().filter(|other| {
                    let m = other.vertices.len();
                    (0..m).any(|j| other.vertices[j] == b && other.vertices[(j + 1) % m] == a)
                });
                assert_eq!(twins.count(), 1);
            }
        }
    }

    #[test]
    fn two_lines_make_four_conforming_cells() {
        let cut = Arrangement::new(&unit(), &[line(0.1, -0.9, 0.8, -0.2), line(0.0, -0.3, 1.0, -0.6)]);
        assert_eq!(cut.cells.len(), 4);
        conforms(&cut);
        assert!((0..4).all(|c| area(&cut, c) > 0.0));
    }

    #[test]
    fn lines_through_corners_along_sides_and_leaving_slivers() {
        let diagonal = Arrangement::new(&unit(), &[line(0.0, -1.0, 1.0, 0.0)]);
        assert_eq!(diagonal.cells.len(), 2);
        conforms(&diagonal);
        let along = Arrangement::new(&unit(), &[line(-1.0, 0.0, 2.0, 0.0)]);
        assert_eq!(along.cells.len(), 1);
        let sliver = Arrangement::new(&unit(), &[line(0.0, -1e-9, 1e-9, 0.0), line(0.0, -1.0, 1.0, 0.0)]);
        conforms(&sliver);
        assert!(sliver.cells.len() >= 3);
    }

    #[test]
    fn a_kink_is_exactly_a_vertex() {
        let kink = Vec2::new(0.3, -0.37);
        let lines = [
            CutLine { from: Vec2::new(-0.2, 0.1), to: kink },
            CutLine { from: kink, to: Vec2::new(1.3, -0.4) },
        ];
        let cut = Arrangement::new(&unit(), &lines);
        conforms(&cut);
        assert!(cut.vertices.contains(&kink));
    }
}

//! A grid of eight-node rectangles between two sets of grid lines, and their shape functions.

use crate::math::Vec2;
use thiserror::Error;

/// Grid lines that do not define a mesh.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshError {
    /// Fewer than two grid lines in one direction.
    #[error("a mesh needs at least two grid lines along {axis}, {count} given")]
    TooFewLines {
        /// `x` or `y`.
        axis: char,
        /// Number of given lines.
        count: usize,
    },
    /// Too many unknowns.
    #[error("its {unknowns:.3e} unknowns exceed the limit of {most:e}; larger elements reduce them")]
    TooManyUnknowns {
        /// Displacement unknowns of the requested mesh.
        unknowns: f64,
        /// Largest accepted number.
        most: f64,
    },
    /// Grid lines that are not in increasing order.
    #[error("grid line {index} along {axis} at {value} mm does not lie beyond the line before it")]
    NotIncreasing {
        /// `x` or `y`.
        axis: char,
        /// Index of the line, from 0.
        index: usize,
        /// Its coordinate, mm.
        value: f64,
    },
}

/// A mesh of rectangles: each pair of neighbouring grid lines along x and along y bounds one
/// element.
///
/// Elements are numbered row by row from the lower left, `e = row × columns + column`. Nodes lie on
/// the lattice of the grid lines and the midlines between them, except at the centres of the
/// elements: lattice point (c, r) is a node unless c and r are both odd. Nodes are numbered lattice
/// row by lattice row.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadMesh {
    x: Vec<f64>,
    y: Vec<f64>,
}

/// One rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    /// Its nodes, in the order of the shape functions.
    pub nodes: [usize; NODES],
    /// Lower left corner, mm.
    pub lower: Vec2,
    /// Upper right corner, mm.
    pub upper: Vec2,
}

impl Element {
    /// Reference coordinates (ξ, η) of a point (mm).
    pub(crate) fn reference(&self, point: Vec2) -> (f64, f64) {
        let size = self.size();
        (
            (2.0 * point.x - self.lower.x - self.upper.x) / size.x,
            (2.0 * point.y - self.lower.y - self.upper.y) / size.y,
        )
    }

    /// Width and height, mm.
    pub(crate) fn size(&self) -> Vec2 {
        self.upper - self.lower
    }

    /// The four corners counter-clockwise from the lower left, mm.
    pub(crate) fn corners(&self) -> [Vec2; 4] {
        [self.lower, Vec2::new(self.upper.x, self.lower.y), self.upper, Vec2::new(self.lower.x, self.upper.y)]
    }
}

impl QuadMesh {
    /// The mesh between the grid lines at the abscissae `x` and the ordinates `y` (mm), both
    /// increasing.
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Result<Self, MeshError> {
        for (axis, lines) in [('x', &x), ('y', &y)] {
            if lines.len() < 2 {
                return Err(MeshError::TooFewLines { axis, count: lines.len() });
            }
            let increases = |pair: &[f64]| pair[1] > pair[0] && pair[1].is_finite() && pair[0].is_finite();
            if let Some(i) = lines.windows(2).position(|pair| !increases(pair)) {
                return Err(MeshError::NotIncreasing { axis, index: i + 1, value: lines[i + 1] });
            }
        }
        Ok(Self { x, y })
    }

    /// Abscissae of the grid lines, mm.
    pub fn x_lines(&self) -> &[f64] {
        &self.x
    }

    /// Ordinates of the grid lines, mm.
    pub fn y_lines(&self) -> &[f64] {
        &self.y
    }

    /// Elements along x.
    pub fn columns(&self) -> usize {
        self.x.len() - 1
    }

    /// Elements along y.
    pub fn rows(&self) -> usize {
        self.y.len() - 1
    }

    /// Number of elements.
    pub(crate) fn element_count(&self) -> usize {
        self.columns() * self.rows()
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        let (columns, rows) = (self.columns(), self.rows());
        (rows + 1) * (2 * columns + 1) + rows * (columns + 1)
    }

    /// Column and row of element `e`.
    pub(crate) fn grid_place(&self, e: usize) -> (usize, usize) {
        (e % self.columns(), e / self.columns())
    }

    /// The node at lattice point (c, r), `c` from 0 to 2 columns, `r` from 0 to 2 rows, not both
    /// odd.
    pub(crate) fn node_at(&self, c: usize, r: usize) -> usize {
        let columns = self.columns();
        let before = (r / 2) * (3 * columns + 2);
        if r.is_multiple_of(2) { before + c } else { before + 2 * columns + 1 + c / 2 }
    }

    /// The lattice point of a node.
    pub(crate) fn lattice_point(&self, node: usize) -> (usize, usize) {
        let columns = self.columns();
        let (pair, rest) = (node / (3 * columns + 2), node % (3 * columns + 2));
        if rest <= 2 * columns { (rest, 2 * pair) } else { (2 * (rest - 2 * columns - 1), 2 * pair + 1) }
    }

    /// Position of a node, mm.
    pub(crate) fn node_position(&self, node: usize) -> Vec2 {
        let (c, r) = self.lattice_point(node);
        let at = |lines: &[f64], i: usize| {
            if i.is_multiple_of(2) { lines[i / 2] } else { 0.5 * (lines[i / 2] + lines[i / 2 + 1]) }
        };
        Vec2::new(at(&self.x, c), at(&self.y, r))
    }

    /// Element `e`.
    pub(crate) fn element(&self, e: usize) -> Element {
        let (column, row) = self.grid_place(e);
        let (c, r) = (2 * column, 2 * row);
        let offsets = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)];
        Element {
            nodes: offsets.map(|(dc, dr)| self.node_at(c + dc, r + dr)),
            lower: Vec2::new(self.x[column], self.y[row]),
            upper: Vec2::new(self.x[column + 1], self.y[row + 1]),
        }
    }

    /// The elements that share a node, in increasing order.
    pub(crate) fn elements_of(&self, node: usize) -> Vec<usize> {
        let (c, r) = self.lattice_point(node);
        // A lattice index on a grid line touches the cells on both sides, one between lines only
        // its own.
        let span = |i: usize, cells: usize| {
            let first = if i.is_multiple_of(2) { (i / 2).saturating_sub(1) } else { i / 2 };
            first..(i / 2 + 1).min(cells)
        };
        let columns = span(c, self.columns());
        span(r, self.rows())
            .flat_map(|row| columns.clone().map(move |column| (column, row)))
            .map(|(column, row)| row * self.columns() + column)
            .collect()
    }

    /// The element across a side of `e`; none at the outer boundary.
    pub(crate) fn neighbour(&self, e: usize, side: Edge) -> Option<usize> {
        let (column, row) = self.grid_place(e);
        let (columns, rows) = (self.columns(), self.rows());
        match side {
            Edge::Bottom => (row > 0).then(|| e - columns),
            Edge::Right => (column + 1 < columns).then_some(e + 1),
            Edge::Top => (row + 1 < rows).then_some(e + columns),
            Edge::Left => (column > 0).then(|| e - 1),
        }
    }

    /// Columns and rows of the elements whose closure meets the box between `lower` and `upper`
    /// (mm).
    pub(crate) fn places_meeting(
        &self,
        lower: Vec2,
        upper: Vec2,
    ) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        let range = |lines: &[f64], from: f64, to: f64| {
            let first = lines[1..].partition_point(|&line| line < from);
            let last = lines[..lines.len() - 1].partition_point(|&line| line <= to);
            first..last.max(first)
        };
        (range(&self.x, lower.x, upper.x), range(&self.y, lower.y, upper.y))
    }

    /// The element that contains `point` (mm): of several that touch it, the one to the upper
    /// right. None outside the mesh.
    pub(crate) fn locate(&self, point: Vec2) -> Option<usize> {
        let find = |lines: &[f64], at: f64| {
            let cells = lines.len() - 1;
            (at >= lines[0] && at <= lines[cells])
                .then(|| lines.partition_point(|&line| line <= at).saturating_sub(1).min(cells - 1))
        };
        Some(find(&self.y, point.y)? * self.columns() + find(&self.x, point.x)?)
    }
}

/// Nodes of an element: corners 0 to 3 counter-clockwise from the lower left, then the midpoints of
/// the bottom, right, top and left side.
pub(crate) const NODES: usize = 8;

/// Reference coordinates of the four corners.
pub(crate) const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// A side of an element, in the order of its midside nodes 4 to 7.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Edge {
    /// y smallest.
    Bottom,
    /// x largest.
    Right,
    /// y largest.
    Top,
    /// x smallest.
    Left,
}

impl Edge {
    /// The four sides.
    pub const ALL: [Self; 4] = [Self::Bottom, Self::Right, Self::Top, Self::Left];

    /// The three nodes on the side: its two corners and its midside node.
    pub(crate) fn nodes(self) -> [usize; 3] {
        let i = self as usize;
        [i, (i + 1) % 4, 4 + i]
    }
}

/// Values, ∂/∂ξ and ∂/∂η of the eight shape functions at (ξ, η) in [−1, 1]² (Zienkiewicz & Taylor,
/// serendipity family).
pub(crate) fn shape_functions(xi: f64, eta: f64) -> [[f64; 3]; NODES] {
    let mut values = [[0.0; 3]; NODES];
    for (value, [a, b]) in values.iter_mut().zip(CORNERS) {
        let (p, q) = (1.0 + a * xi, 1.0 + b * eta);
        let r = a * xi + b * eta - 1.0;
        *value = [0.25 * p * q * r, 0.25 * a * q * (r + p), 0.25 * b * p * (r + q)];
    }
    for (node, b) in [(4, -1.0), (6, 1.0)] {
        let (p, q) = (1.0 - xi * xi, 1.0 + b * eta);
        values[node] = [0.5 * p * q, -xi * q, 0.5 * b * p];
    }
    for (node, a) in [(5, 1.0), (7, -1.0)] {
        let (p, q) = (1.0 + a * xi, 1.0 - eta * eta);
        values[node] = [0.5 * p * q, 0.5 * a * q, -eta * p];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small() -> QuadMesh {
        QuadMesh::new(vec![0.0, 1.0, 3.0, 4.0], vec![-5.0, -1.0, 0.0]).unwrap()
    }

    #[test]
    fn nodes_and_lattice_points_correspond() {
        let mesh = small();
        assert_eq!(mesh.node_count(), 3 * 7 + 2 * 4);
        for node in 0..mesh.node_count() {
            let (c, r) = mesh.lattice_point(node);
            assert_eq!(mesh.node_at(c, r), node);
            for e in mesh.elements_of(node) {
                assert!(mesh.element(e).nodes.contains(&node), "element {e}, node {node}");
            }
        }
        let shared: usize = (0..mesh.node_count()).map(|node| mesh.elements_of(node).len()).sum();
        assert_eq!(shared, NODES * mesh.element_count());
    }

    #[test]
    fn elements_hold_their_nodes_and_points() {
        let mesh = small();
        for e in 0..mesh.element_count() {
            let element = mesh.element(e);
            for (corner, node) in element.corners().into_iter().zip(element.nodes) {
                assert_eq!(mesh.node_position(node), corner);
            }
            let middle = (element.lower + element.upper) * 0.5;
            assert_eq!(mesh.locate(middle), Some(e));
            assert_eq!(element.reference(middle), (0.0, 0.0));
            for side in Edge::ALL {
                let Some(other) = mesh.neighbour(e, side) else { continue };
                let own = side.nodes().map(|n| element.nodes[n]);
                assert!(own.iter().all(|n| mesh.element(other).nodes.contains(n)), "{e} {side:?}");
            }
        }
        assert_eq!(mesh.locate(Vec2::new(4.0, 0.0)), Some(5));
        assert_eq!(mesh.locate(Vec2::new(4.1, -1.0)), None);
        assert_eq!(mesh.places_meeting(Vec2::new(1.0, -1.0), Vec2::new(1.0, -0.5)), (0..2, 0..2));
    }

    #[test]
    fn refuses_lines_that_do_not_increase() {
        let error = QuadMesh::new(vec![0.0, 1.0, 1.0], vec![0.0, 1.0]);
        assert_eq!(error, Err(MeshError::NotIncreasing { axis: 'x', index: 2, value: 1.0 }));
        assert!(QuadMesh::new(vec![0.0], vec![0.0, 1.0]).is_err());
    }

    const MIDDLES: [[f64; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];

    #[test]
    fn are_one_at_their_own_node_and_zero_at_the_others() {
        for (i, [xi, eta]) in CORNERS.into_iter().chain(MIDDLES).enumerate() {
            for (j, value) in shape_functions(xi, eta).into_iter().enumerate() {
                assert_eq!(value[0], f64::from(i == j), "function {j} at node {i}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_values() {
        const STEP: f64 = 1e-6;
        let (xi, eta) = (0.3, -0.7);
        let at = shape_functions(xi, eta);
        let (right, left) = (shape_functions(xi + STEP, eta), shape_functions(xi - STEP, eta));
        let (up, down) = (shape_functions(xi, eta + STEP), shape_functions(xi, eta - STEP));
        for j in 0..NODES {
            assert!((at[j][1] - (right[j][0] - left[j][0]) / (2.0 * STEP)).abs() < 1e-9, "d/dxi of {j}");
            assert!((at[j][2] - (up[j][0] - down[j][0]) / (2.0 * STEP)).abs() < 1e-9, "d/deta of {j}");
        }
        assert!((at.iter().map(|v| v[0]).sum::<f64>() - 1.0).abs() < 1e-15);
    }
}

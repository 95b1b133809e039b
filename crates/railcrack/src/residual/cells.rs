//! Point location and shape functions on unstructured meshes of plane cells.

use super::shape::{PlaneShape, Shapes};
use crate::math::Vec2;
use thiserror::Error;

/// One cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PlaneCell {
    pub shape: PlaneShape,
    pub nodes: Vec<usize>,
}

/// An unstructured mesh of plane cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CellMesh {
    pub points: Vec<Vec2>,
    pub cells: Vec<PlaneCell>,
    buckets: Buckets,
}

/// Square buckets of the plane and the cells that overlap each.
#[derive(Debug, Clone, PartialEq)]
struct Buckets {
    lower: Vec2,
    upper: Vec2,
    columns: usize,
    rows: usize,
    /// `cells[row * columns + column]`, increasing.
    cells: Vec<Vec<usize>>,
}

/// Distance in reference coordinates up to which a point outside a cell counts as inside, because
/// rounded coordinates in a file leave gaps between cells.
const INSIDE: f64 = 1e-6;
/// Largest average number of buckets per cell; a mesh without overlaps has a few.
const MOST_BUCKETS: usize = 32;
/// Largest area of all cells together over that of the extent of the mesh. Without overlaps they
/// fill at most the extent, beyond which curved sides reach by less than a quarter.
const MOST_FILLED: f64 = 1.5;
/// Largest area of the boxes around the cells together over that of the extent: on average, so many
/// cells are candidates for a point. Slanted cells of aspect ratio 100 have 50.
const MOST_BOXED: f64 = 100.0;
/// Newton iterations for the reference coordinates; straight cells need three.
const NEWTON_STEPS: usize = 20;

impl CellMesh {
    /// Cells of `points`; nodes are indices of points.
    ///
    /// Errors: no cell; a cell that is folded or has no area.
    pub(crate) fn new(points: Vec<Vec2>, cells: Vec<PlaneCell>) -> Result<Self, PlasticFieldError> {
        if cells.is_empty() {
            return Err(PlasticFieldError::NoCells);
        }
        let buckets = Buckets::new(&points, &cells);
        let mesh = Self { points, cells, buckets };
        for (index, cell) in mesh.cells.iter().enumerate() {
            let turns: Vec<f64> =
                cell.shape.rule().iter().map(|(at, _)| mesh.jacobian(index, *at).determinant()).collect();
            let one_sign = turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0);
            if !one_sign {
                let at = mesh.points[cell.nodes[0]];
                return Err(PlasticFieldError::Folded { cell: index, x: at.x, y: at.y });
            }
        }
        mesh.check_overlaps()?;
        Ok(mesh)
    }

    /// Refuses cells that lie on top of one another: which one holds a point would be arbitrary,
    /// and finding it would take a look at each.
    fn check_overlaps(&self) -> Result<(), PlasticFieldError> {
        let (lower, upper) = self.extent();
        let extent = (upper.x - lower.x) * (upper.y - lower.y);
        let filled: f64 =
            (0..self.cells.len()).flat_map(|cell| self.quadrature(cell)).map(|(_, weight)| weight).sum();
        let boxed: f64 = self
            .cells
            .iter()
            .map(|cell| {
                let (from, to) = bounds(cell.nodes.iter().map(|&node| self.points[node]));
                (to.x - from.x) * (to.y - from.y)
            })
            .sum();
        if filled > MOST_FILLED * extent || boxed > MOST_BOXED * extent {
            return Err(PlasticFieldError::Overlap { cells: self.cells.len(), filled, extent });
        }
        Ok(())
    }

    /// Smallest and largest coordinates.
    pub(crate) fn extent(&self) -> (Vec2, Vec2) {
        (self.buckets.lower, self.buckets.upper)
    }

    /// The cell that contains `point` and the shape functions there; none outside.
    pub(crate) fn locate(&self, point: Vec2) -> Option<(usize, Shapes)> {
        self.buckets.near(point).iter().find_map(|&cell| {
            let at = self.reference(cell, point)?;
            Some((cell, self.cells[cell].shape.functions(at)))
        })
    }

    /// Integration points of a cell: the shape functions there and the weight, mm².
    pub(crate) fn quadrature(&self, cell: usize) -> impl Iterator<Item = (Shapes, f64)> {
        let shape = self.cells[cell].shape;
        shape.rule().into_iter().map(move |(at, weight)| {
            (shape.functions(at), weight * self.jacobian(cell, at).determinant().abs())
        })
    }

    /// The centroid of a cell, mm, where linear fields equal their mean.
    pub(crate) fn centroid(&self, cell: usize) -> Vec2 {
        let nodes = &self.cells[cell].nodes;
        let (mut sum, mut area) = (Vec2::default(), 0.0);
        for (shapes, weight) in self.quadrature(cell) {
            sum = nodes
                .iter()
                .zip(shapes)
                .fold(sum, |sum, (&node, n)| sum + self.points[node] * (n[0] * weight));
            area += weight;
        }
        sum * (1.0 / area)
    }

    fn position(&self, cell: usize, at: Vec2) -> Vec2 {
        let PlaneCell { shape, nodes } = &self.cells[cell];
        let shapes = shape.functions(at);
        nodes.iter().zip(shapes).fold(Vec2::default(), |sum, (&node, n)| sum + self.points[node] * n[0])
    }

    fn jacobian(&self, cell: usize, at: Vec2) -> Jacobian {
        let PlaneCell { shape, nodes } = &self.cells[cell];
        let shapes = shape.functions(at);
        let slope = |axis: usize| {
            nodes
                .iter()
                .zip(shapes)
                .fold(Vec2::default(), |sum, (&node, n)| sum + self.points[node] * n[axis])
        };
        Jacobian { along_xi: slope(1), along_eta: slope(2) }
    }

    /// Reference coordinates of `point` in `cell`; none if it lies outside.
    fn reference(&self, cell: usize, point: Vec2) -> Option<Vec2> {
        let shape = self.cells[cell].shape;
        let mut at = shape.centre();
        for _ in 0..NEWTON_STEPS {
            let step = self.jacobian(cell, at).solve(point - self.position(cell, at))?;
            at = at + step;
            if step.x.abs().max(step.y.abs()) < 1e-12 {
                break;
            }
            // Far outside, the map may fold back into the cell.
            if at.x.abs().max(at.y.abs()) > 10.0 {
                return None;
            }
        }
        let inside = if shape.is_triangle() {
            at.x.min(at.y) >= -INSIDE && at.x + at.y <= 1.0 + INSIDE
        } else {
            at.x.abs().max(at.y.abs()) <= 1.0 + INSIDE
        };
        inside.then_some(at)
    }
}

/// ∂(x, y)/∂(ξ, η).
struct Jacobian {
    along_xi: Vec2,
    along_eta: Vec2,
}

impl Jacobian {
    fn determinant(&self) -> f64 {
        self.along_xi.x * self.along_eta.y - self.along_xi.y * self.along_eta.x
    }

    /// The step in (ξ, η) that corresponds to `step`.
    fn solve(&self, step: Vec2) -> Option<Vec2> {
        let determinant = self.determinant();
        let scaled = Vec2::new(
            (step.x * self.along_eta.y - step.y * self.along_eta.x) / determinant,
            (step.y * self.along_xi.x - step.x * self.along_xi.y) / determinant,
        );
        (scaled.x.is_finite() && scaled.y.is_finite()).then_some(scaled)
    }
}

impl Buckets {
    fn new(points: &[Vec2], cells: &[PlaneCell]) -> Self {
        let used = || cells.iter().flat_map(|cell| cell.nodes.iter().map(|&node| points[node]));
        let (lower, upper) = bounds(used());
        // About one cell per bucket, with square buckets if the extent allows it.
        let size = upper - lower;
        let count = cells.len() as f64;
        let columns =
            (count * size.x / size.y.max(f64::MIN_POSITIVE)).sqrt().clamp(1.0, count).ceil() as usize;
        let rows = (cells.len() / columns).max(1);
        let boxes: Vec<(Vec2, Vec2)> = cells
            .iter()
            .map(|cell| {
                let (from, to) = bounds(cell.nodes.iter().map(|&node| points[node]));
                // Curved sides extend beyond their nodes by less than a quarter of the extent.
                let curved = cell.nodes.len() > cell.shape.corners();
                let margin = (to - from) * if curved { 0.25 } else { INSIDE };
                (from - margin, to + margin)
            })
            .collect();
        let mut buckets = Self { lower, upper, columns, rows, cells: Vec::new() };
        // Cells that lie on top of one another each overlap every bucket.
        while buckets.columns * buckets.rows > 1
            && boxes.iter().map(|of| buckets.reached(*of)).sum::<usize>() > MOST_BUCKETS * cells.len()
        {
            buckets.columns = buckets.columns.div_ceil(2);
            buckets.rows = buckets.rows.div_ceil(2);
        }
        buckets.cells = vec![Vec::new(); buckets.columns * buckets.rows];
        for (index, (from, to)) in boxes.into_iter().enumerate() {
            let (first, last) = (buckets.place(from), buckets.place(to));
            for row in first.1..=last.1 {
                for column in first.0..=last.0 {
                    buckets.cells[row * buckets.columns + column].push(index);
                }
            }
        }
        buckets
    }

    /// Number of buckets that a box overlaps.
    fn reached(&self, (from, to): (Vec2, Vec2)) -> usize {
        let (first, last) = (self.place(from), self.place(to));
        (last.0 - first.0 + 1) * (last.1 - first.1 + 1)
    }

    /// Column and row of a point, or of the nearest bucket.
    fn place(&self, point: Vec2) -> (usize, usize) {
        let (size, from) = (self.upper - self.lower, point - self.lower);
        let index = |t: f64, count: usize| ((t * count as f64).max(0.0) as usize).min(count - 1);
        (index(from.x / size.x, self.columns), index(from.y / size.y, self.rows))
    }

    fn near(&self, point: Vec2) -> &[usize] {
        let (column, row) = self.place(point);
        &self.cells[row * self.columns + column]
    }
}

fn bounds(points: impl Iterator<Item = Vec2>) -> (Vec2, Vec2) {
    let start = (Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    points.fold(start, |(low, high), p| {
        (Vec2::new(low.x.min(p.x), low.y.min(p.y)), Vec2::new(high.x.max(p.x), high.y.max(p.y)))
    })
}

/// An invalid plastic stress.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlasticFieldError {
    /// No array with the required name.
    #[error(
        "no array `{wanted}` on points or cells (there: {there}): it holds the plastic stress 2 G eps_p in MPa, 6 components XX, YY, \
         ZZ, XY, YZ, XZ or the first 4 of them"
    )]
    NoArray {
        /// Its name.
        wanted: &'static str,
        /// The arrays present.
        there: String,
    },
    /// An array that does not hold a stress.
    #[error("{reason}")]
    Array {
        /// The fault.
        reason: String,
    },
    /// No triangles or quadrilaterals.
    #[error("no triangles and no quadrilaterals: the plastic stress must be given on a mesh")]
    NoCells,
    /// A cell of an unsupported type.
    #[error("cell {cell} (from 0) is {found}: triangles and quadrilaterals are read, straight or quadratic")]
    Cell {
        /// Its number, from 0.
        cell: usize,
        /// The type found.
        found: String,
    },
    /// A cell that is folded, or has no area.
    #[error("cell {cell} (from 0) at ({x}, {y}) mm is folded or has no area")]
    Folded {
        /// Its number among triangles and quadrilaterals, from 0.
        cell: usize,
        /// Abscissa of its first node, mm.
        x: f64,
        /// Ordinate of its first node, mm.
        y: f64,
    },
    /// Cells on top of one another.
    #[error(
        "the {cells} cells lie on top of one another: together they have {filled:.3e} mm^2, in an extent of {extent:.3e} mm^2"
    )]
    Overlap {
        /// Number of triangles and quadrilaterals.
        cells: usize,
        /// Area of all of them together, mm².
        filled: f64,
        /// Area of the rectangle around the mesh, mm².
        extent: f64,
    },
    /// A mesh outside the rail.
    #[error(
        "the mesh reaches from y = {from} to {to} mm: the rail lies at y <= 0, with its running surface at y = 0"
    )]
    NotInRail {
        /// Smallest ordinate, mm.
        from: f64,
        /// Largest ordinate, mm.
        to: f64,
    },
    /// An implausibly large stress.
    #[error("{largest} MPa exceeds {limit} MPa, the largest plausible plastic stress of steel")]
    TooLarge {
        /// Largest component, MPa.
        largest: f64,
        /// The largest accepted value, MPa.
        limit: f64,
    },
}

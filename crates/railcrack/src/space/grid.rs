//! Grid of cells on a crack.
//!
//! A block of cells about the middle, whose rows are parallel to the mouth, and a ring of cells
//! from the block to the front, whose columns end at the front. Along a column the distance to the
//! front is the square of the parameter, so that bilinear hats are linear in the square root of the
//! distance. The grid has no pole at the mouth or in the middle.

use super::division::CellDivision;
use super::shape::SpaceCrack;
use std::f64::consts::PI;

/// The end of a column of the ring at the front.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrontColumn {
    /// The parametric angle of the front.
    pub phi: f64,
    /// Whether K counts in growth.
    pub counts: bool,
    /// The vertices on the column in the first and second row from the front.
    pub vertices: [usize; 2],
    /// Their parameters η: the distance to the front goes with η².
    pub parameters: [f64; 2],
    /// Unit normal of the front in its plane, away from the crack: (s, ζ).
    pub normal: [f64; 2],
    /// Distance to the front over η², near the front, mm.
    pub distance: f64,
}

impl FrontColumn {
    /// The end of column `t` of the ring of `crack`, with its `vertices` in the first two rows.
    fn new(crack: &SpaceCrack, division: &CellDivision, t: f64, vertices: [usize; 2]) -> Self {
        let disc = Disc(division);
        let phi = 0.25 * PI * division.turn(t);
        let h = 1e-4;
        let on_front = |t: f64| crack.point(disc.ring(t, division.parameter(0.0).powi(2)));
        let (ahead, behind) = (on_front(t + h), on_front(t - h));
        let tangent = [ahead[0] - behind[0], ahead[1] - behind[1]];
        let length = tangent[0].hypot(tangent[1]);
        // φ grows from ζ = c towards s = l: the outward normal is the tangent turned.
        let normal = [-tangent[1] / length, tangent[0] / length];
        let [near, beyond] = [h, -h].map(|w| crack.point(disc.ring(t, w)));
        let inward = (beyond[0] - near[0]) * normal[0] + (beyond[1] - near[1]) * normal[1];
        Self {
            phi,
            vertices,
            parameters: [1.0, 2.0].map(|row| division.parameter(row)),
            counts: division.counts(phi),
            normal,
            distance: inward / (2.0 * h),
        }
    }
}

/// The cells of a crack.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    pub cells: Vec<Cell>,
    /// Cells with an edge on the mouth, and the corners of that edge.
    pub mouth: Vec<(usize, [usize; 2])>,
    /// Positions (s, ζ) of the vertices, mm. Those on the front come last.
    pub vertices: Vec<[f64; 2]>,
    /// Number of vertices that are not on the front.
    pub free: usize,
    pub front: Vec<FrontColumn>,
    /// Whether rows become narrower towards the mouth.
    pub is_graded: bool,
}

/// Roundness of the block: 0 for a square, 1 for a disc.
const ROUNDNESS: f64 = 0.5;

/// The unit disc, or its half, divided into cells.
struct Disc<'a>(&'a CellDivision);

impl Disc<'_> {
    /// The point of the block at these columns and rows from its middle.
    fn block(&self, steps: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.0.place(steps);
        let round = |a: f64, b: f64| a * (1.0 - ROUNDNESS + ROUNDNESS * (1.0 - 0.5 * b * b).sqrt());
        let [along, down] = self.0.sides;
        [along * round(x, y), down * round(y, x)]
    }

    /// The point on column `t` of the ring at the square of the parameter η: 0 on the front, 1 on
    /// the block.
    fn ring(&self, t: f64, w: f64) -> [f64; 2] {
        let turn = self.0.turn(t);
        let (sin, cos) = (0.25 * PI * turn).sin_cos();
        // The mouth lies exactly at zero.
        let sin = if turn == 0.0 || turn == 4.0 { 0.0 } else { sin };
        let inner = self.block(self.0.outline(t));
        [cos + w * (inner[0] - cos), sin + w * (inner[1] - sin)]
    }
}

impl Grid {
    /// The cells of `crack`, which has no strip, in the plane into which it unrolls.
    pub fn new(crack: &SpaceCrack, division: &CellDivision) -> Self {
        let (k, rows) = (division.columns as i64, division.ring);
        let (first, last) = (division.first_row(), division.rows as i64);
        let closed = first < 0;
        let on_block = |i: i64, j: i64| ((j - first) * (2 * k + 1) + i + k) as usize;
        let block_count = division.block_points();
        let around = division.ends_of_columns();
        let columns = if closed { around } else { around - 1 };
        let free = division.points_of_ellipse();
        // Row 0 of a column lies on the front, the last on the block.
        let vertex = |t: usize, row: usize| match row {
            0 => free + t % around,
            row if row == rows => {
                let [i, j] = division.outline(t as f64);
                on_block(i as i64, j as i64)
            }
            row => block_count + (row - 1) * around + t % around,
        };
        let disc = Disc(division);
        let block_point = |i: f64, j: f64| crack.point(disc.block([i, j]));
        let ring_point = |t: f64, row: f64| crack.point(disc.ring(t, division.parameter(row).powi(2)));

        let mut vertices = vec![[0.0; 2]; free + around];
        let (mut cells, mut mouth) = (Vec::new(), Vec::new());
        for j in first..last {
            for i in -k..k {
                let corners =
                    [on_block(i, j), on_block(i + 1, j), on_block(i + 1, j + 1), on_block(i, j + 1)];
                if !closed && j == 0 {
                    mouth.push((cells.len(), [0, 1]));
                }
                cells.push(Cell::new(corners, |u, v| block_point(i as f64 + u, j as f64 + v)));
            }
        }
        for t in 0..columns {
            for row in 0..rows {
                let corners =
                    [vertex(t, row), vertex(t + 1, row), vertex(t + 1, row + 1), vertex(t, row + 1)];
                if !closed && t == 0 {
                    mouth.push((cells.len(), [0, 3]));
                }
                if !closed && t + 1 == columns {
                    mouth.push((cells.len(), [1, 2]));
                }
                cells.push(Cell::new(corners, |u, v| ring_point(t as f64 + u, row as f64 + v)));
            }
        }
        for cell in &cells {
            for (corner, [u, v]) in cell.vertices.iter().zip(CORNERS) {
                vertices[*corner] = cell.at(u, v).position;
            }
        }
        for (cell, corners) in &mouth {
            for corner in corners {
                vertices[cells[*cell].vertices[*corner]][0] = 0.0;
            }
        }
        let front = (0..around)
            .map(|t| FrontColumn::new(crack, division, t as f64, [vertex(t, 1), vertex(t, 2)]))
            .collect();
        Self { cells, mouth, vertices, free, front, is_graded: division.is_graded() }
    }
}

/// Hat functions of the first cell, components, hat functions of the second, components.
pub(super) type Block = [[[[f64; 3]; 4]; 3]; 4];
pub(super) const EMPTY: Block = [[[[0.0; 3]; 4]; 3]; 4];

/// A block `count` times; none for a count of zero, for which it is not computed.
pub(super) fn counted(count: f64, block: impl FnOnce() -> Block) -> Option<Block> {
    (count > 0.0).then(|| times(count, block()))
}

/// A block times a factor.
pub(super) fn times(factor: f64, mut block: Block) -> Block {
    block.iter_mut().flatten().flatten().flatten().for_each(|value| *value *= factor);
    block
}

/// Degree of the polynomials in each direction that describe a cell.
const DEGREE: usize = 4;
const TERMS: usize = DEGREE + 1;

/// A cell: the image of the unit square (u, v) in the plane (s, ζ) by polynomials of degree 4 in
/// each direction, with one bilinear hat at each corner. Corners in the order (0, 0), (1, 0),
/// (1, 1), (0, 1).
#[derive(Debug, Clone)]
pub(super) struct Cell {
    /// Vertices at the corners.
    pub vertices: [usize; 4],
    /// Coefficients of u^i v^j of s and ζ.
    terms: [[[f64; 2]; TERMS]; TERMS],
}

/// A point of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellPoint {
    /// s and ζ, mm.
    pub position: [f64; 2],
    /// The hats.
    pub hats: [f64; 4],
    /// The gradients of the hats (∂_s, ∂_ζ) times the area per unit square, mm.
    pub gradients: [[f64; 2]; 4],
    /// Area per unit square, mm².
    pub area: f64,
}

pub(super) const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

impl Cell {
    /// The cell whose point (u, v) is `position(u, v)`.
    pub fn new(vertices: [usize; 4], position: impl Fn(f64, f64) -> [f64; 2]) -> Self {
        let at = |k: usize| k as f64 / DEGREE as f64;
        let inverse = monomials();
        let mut terms = [[[0.0; 2]; TERMS]; TERMS];
        for a in 0..TERMS {
            for b in 0..TERMS {
                let value = position(at(a), at(b));
                for i in 0..TERMS {
                    for j in 0..TERMS {
                        for c in 0..2 {
                            terms[i][j][c] += inverse[a][i] * inverse[b][j] * value[c];
                        }
                    }
                }
            }
        }
        Self { vertices, terms }
    }

    /// The same cell with other numbers of its vertices.
    pub fn renumbered(&self, number: impl Fn(usize) -> usize) -> Self {
        Self { vertices: self.vertices.map(number), ..self.clone() }
    }

    /// The derivative of (s, ζ) at (u, v) in the direction `along` of the unit square.
    pub fn slope(&self, u: f64, v: f64, along: [f64; 2]) -> [f64; 2] {
        let (_, pu, pv) = self.map(u, v);
        std::array::from_fn(|c| along[0] * pu[c] + along[1] * pv[c])
    }

    /// Position and its derivatives in u and v.
    fn map(&self, u: f64, v: f64) -> ([f64; 2], [f64; 2], [f64; 2]) {
        let (mut p, mut pu, mut pv) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for row in self.terms.iter().rev() {
            let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
            for term in row.iter().rev() {
                for c in 0..2 {
                    slope[c] = slope[c] * v + value[c];
                    value[c] = value[c] * v + term[c];
                }
            }
            for c in 0..2 {
                pu[c] = pu[c] * u + p[c];
                p[c] = p[c] * u + value[c];
                pv[c] = pv[c] * u + slope[c];
            }
        }
        (p, pu, pv)
    }

    /// The point (u, v).
    pub fn at(&self, u: f64, v: f64) -> CellPoint {
        let (p, pu, pv) = self.map(u, v);
        let determinant = pu[0] * pv[1] - pu[1] * pv[0];
        let sign = determinant.signum();
        let hats = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
        let du = [-(1.0 - v), 1.0 - v, v, -v];
        let dv = [-(1.0 - u), -u, u, 1.0 - u];
        let gradients = std::array::from_fn(|a| {
            [sign * (du[a] * pv[1] - dv[a] * pu[1]), sign * (dv[a] * pu[0] - du[a] * pv[0])]
        });
        CellPoint { position: p, hats, gradients, area: determinant.abs() }
    }
}

/// Row a: the coefficients of the Lagrange polynomial of the point a/4.
fn monomials() -> [[f64; TERMS]; TERMS] {
    std::array::from_fn(|a| {
        let mut coefficients = [0.0; TERMS];
        coefficients[0] = 1.0;
        let mut degree = 0;
        for b in (0..TERMS).filter(|&b| b != a) {
            let (xa, xb) = (a as f64 / DEGREE as f64, b as f64 / DEGREE as f64);
            degree += 1;
            for i in (0..=degree).rev() {
                let lower = if i > 0 { coefficients[i - 1] } else { 0.0 };
                coefficients[i] = (lower - xb * coefficients[i]) / (xa - xb);
            }
        }
        coefficients
    })
}

#[cfg(test)]
mod tests {
    use super::super::division::SpaceResolution;
    use super::*;

    #[test]
    fn cells_cover_the_crack() {
        for (crack, share, surface) in [
            (SpaceCrack::surface_breaking(0.6, 3.0, 2.0).unwrap(), 0.5),
            (SpaceCrack::surface_breaking(0.2, 3.0, 2.0).unwrap(), 0.5),
            (SpaceCrack::buried(0.2, 3.0, 2.0, 5.0).unwrap(), 1.0),
        ]
        .into_iter()
        .flat_map(|(crack, share)| [0, 2].map(|surface| (crack.clone(), share, surface)))
        {
            let division = CellDivision::of(&crack, SpaceResolution { block: 5, ring: 3, surface });
            let grid = Grid::new(&crack, &division);
            assert_eq!((grid.cells.len(), grid.free), (division.cells(), division.face_points()));
            let rule = crate::math::gauss_legendre(6);
            let mut area = 0.0;
            for cell in &grid.cells {
                for (u, wu) in &rule {
                    area += rule.iter().map(|(v, wv)| wu * wv * cell.at(*u, *v).area).sum::<f64>();
                }
            }
            assert!((area / (share * PI * 6.0) - 1.0).abs() < 1e-6, "{area}");
            assert_eq!(grid.front.len(), division.front_points());
            let deepest = &grid.front[division.columns + division.rows];
            assert!((deepest.normal[0] - 1.0).abs() < 1e-6 && (deepest.phi - 0.5 * PI).abs() < 1e-12);
            assert!(
                (deepest.distance - 2.0 * (1.0 - division.sides[1])).abs() < 1e-3,
                "{}",
                deepest.distance
            );
            for (cell, [from, to]) in &grid.mouth {
                for corner in [from, to] {
                    assert_eq!(grid.vertices[grid.cells[*cell].vertices[*corner]][0], 0.0);
                }
            }
        }
    }

    #[test]
    fn positions_and_gradients_of_a_curved_cell() {
        let exact = |u: f64, v: f64| [1.0 + u + 0.1 * v * v, 2.0 * v + 0.3 * u * v + 0.05 * u.powi(3)];
        let cell = Cell::new([0, 1, 2, 3], exact);
        let (u, v, h) = (0.3, 0.6, 1e-6);
        let point = cell.at(u, v);
        for c in 0..2 {
            assert!((point.position[c] - exact(u, v)[c]).abs() < 1e-13);
        }
        // ∇N · ∂x/∂u = ∂N/∂u.
        let (e, w) = (exact(u + h, v), exact(u - h, v));
        let du = [(e[0] - w[0]) / (2.0 * h), (e[1] - w[1]) / (2.0 * h)];
        let slope = (point.gradients[2][0] * du[0] + point.gradients[2][1] * du[1]) / point.area;
        assert!((slope - v).abs() < 1e-8, "{slope}");
    }
}

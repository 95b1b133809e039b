//! Grid of cells on a crack.
//!
//! A block of cells about the middle, whose rows are parallel to the mouth, and a ring of cells
//! from the block to the front, whose columns end at the front. Along a column the distance to the
//! front is the square of the parameter, so that bilinear hats are linear in the square root of the
//! distance. The grid has no pole at the mouth or in the middle.

use super::cell::Cell;
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
    pub fn new(crack: &SpaceCrack, division: &CellDivision) -> Self {
        let (k, rows) = (division.columns as i64, division.ring);
        let (first, last) = (division.first_row(), division.rows as i64);
        let closed = first < 0;
        let on_block = |i: i64, j: i64| ((j - first) * (2 * k + 1) + i + k) as usize;
        let block_count = division.block_points();
        let around = division.front_points();
        let columns = if closed { around } else { around - 1 };
        let free = division.face_points();
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
            for (corner, [u, v]) in cell.vertices.iter().zip(super::cell::CORNERS) {
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
}

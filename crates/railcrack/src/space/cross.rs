//! Stiffness between two cracks.
//!
//! The cracks are disjoint, so that the integrals of the traction of one on the other are regular.
//! Mouths need no special treatment, since the image of a point of one crack is never closer to the
//! other crack than the point itself.

use super::curls::Stress;
use super::grid::{Block, EMPTY, Grid, counted};
use super::mirror_image::MirroredPair;
use super::plane::Surroundings;
use super::sheet::Sheet;
use super::tractions::{Fineness, Reach, Tractions, turn};
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, dot3};
use rayon::prelude::*;

/// A crack at its place in the rail.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed<'a> {
    pub grid: &'a Grid,
    pub sheet: &'a Sheet,
}

impl Placed<'_> {
    /// The directions of the components at its free points: normal, dip, trace.
    pub fn directions(&self) -> Vec<[[f64; 3]; 3]> {
        let free = &self.grid.vertices[..self.grid.free];
        free.iter().map(|[s, _]| self.sheet.frame(*s).directions()).collect()
    }

    /// Whether the crack is its own mirror image about the vertical plane along the rail through
    /// its middle.
    fn is_across(&self) -> bool {
        self.sheet.frame(0.0).normal()[1] == 0.0
    }
}

/// Fineness of the integrals between cracks of bodies. Cells of a graded grid are narrow.
fn fineness(cracks: [&Placed; 2]) -> Fineness {
    let more_points = usize::from(cracks.iter().any(|crack| crack.grid.is_graded));
    Fineness { more_points, nearer: 1.0 }
}

/// The integrals over two cracks.
struct Cross<'a> {
    cracks: [Placed<'a>; 2],
    stress: Stress,
    tractions: Tractions<'a>,
}

/// The stiffness between two disjoint cracks in units of the shear modulus (mm): component i of the
/// free vertex a of the first is row 3a + i, the columns are numbered likewise for the second. An
/// `interruption` ends the computation.
pub(super) fn cross_stiffness(
    cracks: [Placed; 2],
    surroundings: Surroundings,
    poisson: f64,
    interruption: Interruption<'_>,
) -> Result<Matrix, Interrupted> {
    let fineness = fineness(cracks.each_ref());
    Cross::new(cracks, surroundings, poisson, fineness).stiffness_unless(interruption)
}

impl<'a> Cross<'a> {
    fn new(cracks: [Placed<'a>; 2], surroundings: Surroundings, poisson: f64, fineness: Fineness) -> Self {
        let stress = match surroundings {
            Surroundings::FullSpace => Stress::Kelvin,
            Surroundings::HalfSpace => Stress::HalfSpace,
        };
        let tractions = Tractions::new(cracks.map(|crack| crack.sheet), poisson, fineness);
        Self { cracks, stress, tractions }
    }

    fn stiffness_unless(&self, interruption: Interruption<'_>) -> Result<Matrix, Interrupted> {
        let [rows, columns] = self.cracks.map(|crack| crack.grid);
        let lateral = self.cracks.map(|crack| crack.sheet.place([0.0; 2])[1]);
        let is_symmetric = lateral[0] == lateral[1] && self.cracks.iter().all(Placed::is_across);
        let mirrored = if is_symmetric { MirroredPair::of([rows, columns]) } else { None };
        let count = |pair| mirrored.as_ref().map_or(1.0, |mirrored| mirrored.count(pair));
        let mut stiffness = Matrix::zeros(3 * rows.free, 3 * columns.free);
        let blocks: Vec<Vec<(usize, Block)>> = (0..rows.cells.len())
            .into_par_iter()
            .map(|i| {
                interruption.check()?;
                let block = |j| Some((j, counted(count([i, j]), || self.pair(i, j))?));
                Ok((0..columns.cells.len()).filter_map(block).collect())
            })
            .collect::<Result<_, Interrupted>>()?;
        // The order of summation does not depend on the number of threads.
        for (one, row) in rows.cells.iter().zip(&blocks) {
            for (j, block) in row {
                let other = &columns.cells[*j];
                for (a, &va) in one.vertices.iter().enumerate().filter(|(_, v)| **v < rows.free) {
                    for (b, &vb) in other.vertices.iter().enumerate().filter(|(_, v)| **v < columns.free) {
                        for c in 0..3 {
                            for d in 0..3 {
                                stiffness[(3 * va + c, 3 * vb + d)] += block[a][c][b][d];
                            }
                        }
                    }
                }
            }
        }
        let [first, second] = self.cracks.map(|crack| crack.directions());
        turn(&mut stiffness, &first, &second);
        Ok(match mirrored {
            Some(mirrored) => mirrored.averaged(&stiffness),
            None => stiffness,
        })
    }

    /// The block of the cells i and j, along the axes of the rail.
    fn pair(&self, i: usize, j: usize) -> Block {
        let mut block = EMPTY;
        let cells = [&self.cracks[0].grid.cells[i], &self.cracks[1].grid.cells[j]];
        self.tractions.add(self.stress, cells, &|one, other| self.gap(one, other), &mut block);
        block
    }

    /// A lower bound on the distance of two patches; of planar cracks that of discs in their
    /// planes.
    fn gap(&self, one: &Reach, other: &Reach) -> f64 {
        let [Some(first), Some(second)] = self.cracks.map(|crack| crack.sheet.plane()) else {
            return one.gap(other);
        };
        let [first, second] = [first.normal(), second.normal()];
        let between: [f64; 3] = std::array::from_fn(|i| other.centre[i] - one.centre[i]);
        let square = dot3(between, between);
        let sine = (1.0 - dot3(first, second).powi(2)).max(0.0).sqrt();
        let from = |normal: [f64; 3], turned: &Reach| {
            let across = dot3(between, normal);
            let along = (square - across * across).max(0.0).sqrt() - one.radius - other.radius;
            (across.abs() - sine * turned.radius).max(0.0).hypot(along.max(0.0))
        };
        from(first, other).max(from(second, one))
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::SpaceBody;
    use super::super::division::{CellDivision, SpaceResolution};
    use super::super::galerkin::{Galerkin, ImagePart};
    use super::super::image_table::ImageTable;
    use super::super::shape::{LEAST_DISTANCE, SpaceCrack};
    use super::*;
    use crate::material::IsotropicElastic;
    use std::sync::Arc;

    const NU: f64 = 0.3;
    const CELLS: SpaceResolution = SpaceResolution::new(2, 2);

    /// Two hat functions of one crack that do not touch: the strong form is an independent formula
    /// for the result of the weakly singular integrals of the crack, including those of the image.
    #[test]
    fn hats_apart_by_the_weakly_singular_form() {
        // The weak form is the less accurate one, since its image is close where the dip is small.
        for (degrees, surroundings, allowed) in [
            (40.0f64, Surroundings::FullSpace, 5e-5),
            (90.0, Surroundings::HalfSpace, 1e-4),
            (30.0, Surroundings::HalfSpace, 1e-3),
        ] {
            let dip = degrees.to_radians();
            let crack = match surroundings {
                Surroundings::FullSpace => SpaceCrack::buried(dip, 6.0, 4.0, 50.0),
                Surroundings::HalfSpace => SpaceCrack::surface_breaking(dip, 6.0, 4.0),
            };
            let crack = crack.unwrap();
            let grid = Grid::new(&crack, &CellDivision::of(&crack, CELLS));
            let image = (surroundings == Surroundings::HalfSpace)
                .then(|| ImagePart { table: Arc::new(ImageTable::new(crack.dip, NU)), dip: crack.dip });
            let weak =
                Galerkin::new(&grid, NU, image.as_ref()).stiffness_unless(Interruption::NEVER).unwrap();
            let weak = weak.to_matrix();
            let sheet = Sheet::of(&crack);
            let pair = [Placed { grid: &grid, sheet: &sheet }; 2];
            let strong = Cross::new(pair, surroundings, NU, fineness(pair.each_ref()));
            let corners = |cell: usize| &grid.cells[cell].vertices;
            let touch = |i: usize, j: usize| corners(i).iter().any(|v| corners(j).contains(v));
            let count = grid.cells.len();
            let mut summed = Matrix::zeros(3 * grid.vertices.len(), 3 * grid.vertices.len());
            let mut is_apart = vec![vec![true; grid.vertices.len()]; grid.vertices.len()];
            for i in 0..count {
                for j in 0..count {
                    let block = if touch(i, j) { EMPTY } else { strong.pair(i, j) };
                    for (a, &va) in corners(i).iter().enumerate() {
                        for (b, &vb) in corners(j).iter().enumerate() {
                            is_apart[va][vb] &= !touch(i, j);
                            for c in 0..3 {
                                (0..3).for_each(|d| summed[(3 * va + c, 3 * vb + d)] += block[a][c][b][d]);
                            }
                        }
                    }
                }
            }
            let directions = vec![crack.frame().directions(); grid.vertices.len()];
            turn(&mut summed, &directions, &directions);
            let (mut compared, mut worst) = (0, 0.0f64);
            for row in 0..weak.rows() {
                for column in (0..weak.rows()).filter(|column| is_apart[row / 3][column / 3]) {
                    let size = (weak[(row, row)] * weak[(column, column)]).sqrt();
                    worst = worst.max((weak[(row, column)] - summed[(row, column)]).abs() / size);
                    compared += 1;
                }
            }
            println!("{degrees} {surroundings:?}: {compared} entries, {worst:.2e}");
            assert!(compared > 500 && worst < allowed, "{degrees} {surroundings:?}: {compared} {worst}");
        }
    }

    #[test]
    fn near_cracks_by_finer_rules_and_exchanged() {
        let steel = IsotropicElastic::new(2.0 * (1.0 + NU), NU).unwrap();
        let half = |degrees: f64, x: f64| SpaceCrack {
            middle: [x, 0.5],
            ..SpaceCrack::surface_breaking(degrees.to_radians(), 6.0, 4.0).unwrap()
        };
        let smallest = 1.001 * LEAST_DISTANCE * 4.0 / 15f64.to_radians().sin();
        for pair in [
            [half(15.0, 0.0), half(15.0, 3.4)],
            [half(15.0, 0.0), half(15.0, smallest)],
            [half(30.0, 0.0), half(120.0, 9.0)],
        ] {
            let own = pair.each_ref().map(|crack| {
                SpaceBody::new(std::slice::from_ref(crack), &steel, Surroundings::HalfSpace, CELLS).unwrap()
            });
            let grids = pair.each_ref().map(|crack| Grid::new(crack, &CellDivision::of(crack, CELLS)));
            let sheets = pair.each_ref().map(Sheet::of);
            let [one, other] = [0, 1].map(|k| Placed { grid: &grids[k], sheet: &sheets[k] });
            let of = |pair, fineness| Cross::new(pair, Surroundings::HalfSpace, NU, fineness);
            let usual = of([one, other], fineness([&one, &other]));
            let finer = of([one, other], Fineness { more_points: 3, nearer: 1.3 });
            let back = of([other, one], fineness([&one, &other]));
            let (mut error, mut asymmetry) = (0.0f64, 0.0f64);
            // Cells of each kind (at the mouth, inside, at the front) against all cells.
            for i in [1, 5, 12, grids[0].cells.len() - 1] {
                for j in 0..grids[1].cells.len() {
                    let blocks = [usual.pair(i, j), finer.pair(i, j), back.pair(j, i)];
                    let corners = [&grids[0].cells[i].vertices, &grids[1].cells[j].vertices];
                    for (a, &va) in corners[0].iter().enumerate().filter(|(_, v)| **v < grids[0].free) {
                        for (b, &vb) in corners[1].iter().enumerate().filter(|(_, v)| **v < grids[1].free) {
                            for (c, d) in (0..9).map(|k| (k / 3, k % 3)) {
                                let (row, column) = (3 * va + c, 3 * vb + d);
                                let [first, second] = [own[0].stiffness(), own[1].stiffness()];
                                let size = (first.entry(row, row) * second.entry(column, column)).sqrt();
                                let got = blocks[0][a][c][b][d];
                                error = error.max((got - blocks[1][a][c][b][d]).abs() / size);
                                asymmetry = asymmetry.max((got - blocks[2][b][d][a][c]).abs() / size);
                            }
                        }
                    }
                }
            }
            println!("{:?}: error {error:.2e}, asymmetry {asymmetry:.2e}", pair[1].middle);
            assert!(error < 1e-4 && asymmetry < 1e-4, "{pair:?}: {error} {asymmetry}");
            assert!(error > 0.0, "the finer rules are the same");
        }
    }
}

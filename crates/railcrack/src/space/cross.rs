//! Stiffness between two cracks.
//!
//! A jump of one crack acts as a sheet of double forces, whose stress loads the other crack. With n
//! and n′ the normals of the two cracks,
//!
//!   A = −∬ w_i n_k σ_kl[moment of (w′_j, n′)] dS dS′.
//!
//! The cracks are disjoint, so that nothing is singular, but they may be close: patches of cells
//! are divided until Gauss product rules resolve 1/r³ at their distance. Mouths need no special
//! treatment, since the image of a point of one crack is never closer to the other crack than the
//! point itself.

use super::grid::{Block, Cell, EMPTY, Grid, counted};
use super::mirror_image::MirroredPair;
use super::patch::Patch;
use super::plane::{PlaneFrame, Surroundings, Symmetric, image_matrix, kelvin_stress, moment};
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, dot3, gauss_legendre};
use rayon::prelude::*;

/// Distance of two patches, relative to the diameter of the larger one, and the number of points
/// per direction that it requires; closer patches are divided.
const ORDERS: [(f64, usize); 5] = [(4.0, 2), (2.0, 3), (1.0, 4), (0.6, 5), (0.4, 6)];
/// Largest number of divisions of the patches of a pair of cells.
const DIVISIONS: usize = 24;

/// A crack at its place in the rail.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed<'a> {
    pub grid: &'a Grid,
    pub frame: PlaneFrame,
    /// x and lateral position of the middle of the trace of its plane, mm.
    pub middle: [f64; 2],
}

impl Placed<'_> {
    /// x, lateral and depth (mm) of the point (s, ζ).
    pub fn place(&self, [s, zeta]: [f64; 2]) -> [f64; 3] {
        let [x, lateral, depth] = self.frame.position(s.max(0.0), zeta);
        [x + self.middle[0], lateral + self.middle[1], depth]
    }

    fn disc(&self, cell: &Cell, patch: &Patch) -> Disc {
        let cover = patch.cover(cell);
        Disc { centre: self.place(cover.centre), radius: cover.radius }
    }

    fn samples(&self, cell: &Cell, patch: &Patch, rule: &[(f64, f64)]) -> Vec<Sample> {
        let sample = |(point, weight): (super::grid::CellPoint, f64)| Sample {
            position: self.place(point.position),
            hats: point.hats.map(|hat| hat * point.area * weight),
        };
        patch.points(cell, rule).into_iter().map(sample).collect()
    }
}

/// A disc that contains a patch.
#[derive(Debug, Clone, Copy)]
struct Disc {
    centre: [f64; 3],
    radius: f64,
}

/// A point of a crack, with its hat functions times its area (mm²).
#[derive(Debug, Clone, Copy)]
struct Sample {
    position: [f64; 3],
    hats: [f64; 4],
}

/// Undivided cells of a crack, evaluated at the points of all rules.
struct Sampled<'a> {
    crack: Placed<'a>,
    discs: Vec<Disc>,
    samples: Vec<Vec<Vec<Sample>>>,
}

impl<'a> Sampled<'a> {
    fn new(crack: Placed<'a>, rules: &[Vec<(f64, f64)>]) -> Self {
        let cells = &crack.grid.cells;
        let of_cell = |cell| rules.iter().map(|rule| crack.samples(cell, &Patch::WHOLE, rule)).collect();
        Self {
            crack,
            discs: cells.iter().map(|cell| crack.disc(cell, &Patch::WHOLE)).collect(),
            samples: cells.iter().map(of_cell).collect(),
        }
    }
}

/// Tractions on one crack due to the jumps of another.
#[derive(Debug, Clone)]
struct Influence {
    surroundings: Surroundings,
    poisson: f64,
    /// Minus the traction on the first crack of each component of stress: [jump][component].
    tractions: [[f64; 6]; 3],
    /// Double-force moments of unit jumps of the second crack.
    moments: [Symmetric; 3],
}

impl Influence {
    fn new(first: &PlaneFrame, second: &PlaneFrame, surroundings: Surroundings, poisson: f64) -> Self {
        let unit = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let by_component: [[f64; 3]; 6] = std::array::from_fn(|k| first.traction(&unit(k)));
        Self {
            surroundings,
            poisson,
            tractions: std::array::from_fn(|i| std::array::from_fn(|k| -by_component[k][i])),
            moments: second.directions().map(|jump| moment(jump, second.normal(), poisson)),
        }
    }

    /// The stiffness that couples jump component j at `source` to component i at `point`, in units
    /// of the shear modulus and per mm³.
    fn between(&self, point: [f64; 3], source: [f64; 3]) -> [[f64; 3]; 3] {
        let d = std::array::from_fn(|i| point[i] - source[i]);
        let mut stresses = self.moments.map(|m| kelvin_stress(d, &m, self.poisson));
        if self.surroundings == Surroundings::HalfSpace {
            let image = image_matrix(point, source, self.poisson);
            for (stress, m) in stresses.iter_mut().zip(&self.moments) {
                for (value, row) in stress.iter_mut().zip(&image) {
                    *value += row.iter().zip(m).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
        self.tractions.map(|row| stresses.map(|stress| row.iter().zip(&stress).map(|(a, b)| a * b).sum()))
    }
}

/// Fineness of the integration.
#[derive(Debug, Clone, Copy)]
struct Fineness {
    /// Additional points per direction.
    more_points: usize,
    /// Factor by which distances of patches are reduced when a rule is chosen.
    nearer: f64,
}

impl Fineness {
    /// That for bodies. Cells of a graded grid are narrow.
    fn of(cracks: [&Placed; 2]) -> Self {
        let more_points = usize::from(cracks.iter().any(|crack| crack.grid.is_graded));
        Self { more_points, nearer: 1.0 }
    }
}

/// The integrals over two cracks.
struct Cross<'a> {
    cracks: [Sampled<'a>; 2],
    influence: Influence,
    rules: Vec<Vec<(f64, f64)>>,
    fineness: Fineness,
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
    let fineness = Fineness::of(cracks.each_ref());
    Cross::new(cracks, surroundings, poisson, fineness).stiffness_unless(interruption)
}

impl<'a> Cross<'a> {
    fn new(cracks: [Placed<'a>; 2], surroundings: Surroundings, poisson: f64, fineness: Fineness) -> Self {
        let [first, second] = cracks.map(|crack| crack.frame);
        let rule = |&(_, order): &(f64, usize)| gauss_legendre(order + fineness.more_points);
        let rules: Vec<_> = ORDERS.iter().map(rule).collect();
        Self {
            cracks: cracks.map(|crack| Sampled::new(crack, &rules)),
            influence: Influence::new(&first, &second, surroundings, poisson),
            rules,
            fineness,
        }
    }

    fn stiffness_unless(&self, interruption: Interruption<'_>) -> Result<Matrix, Interrupted> {
        let placed = self.cracks.each_ref().map(|crack| crack.crack);
        let [rows, columns] = placed.map(|crack| crack.grid);
        let is_across = |crack: &Placed| crack.frame.normal()[1] == 0.0;
        let is_symmetric = placed[0].middle[1] == placed[1].middle[1] && placed.iter().all(is_across);
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
        Ok(match mirrored {
            Some(mirrored) => mirrored.averaged(&stiffness),
            None => stiffness,
        })
    }

    /// The block of the cells i and j.
    fn pair(&self, i: usize, j: usize) -> Block {
        let mut block = EMPTY;
        let [first, second] = &self.cracks;
        match self.place(&first.discs[i], &second.discs[j]) {
            Some(place) => self.add(&first.samples[i][place], &second.samples[j][place], &mut block),
            None => self.divided([i, j], [Patch::WHOLE; 2], 0, &mut block),
        }
        block
    }

    /// Index of the rule that suffices for two patches.
    fn place(&self, one: &Disc, other: &Disc) -> Option<usize> {
        let ratio = self.gap(one, other) / (2.0 * self.fineness.nearer * one.radius.max(other.radius));
        ORDERS.iter().position(|&(limit, _)| ratio > limit)
    }

    /// A lower bound on the distance of two discs in the planes of the cracks.
    fn gap(&self, one: &Disc, other: &Disc) -> f64 {
        let [first, second] = [&self.cracks[0], &self.cracks[1]].map(|crack| crack.crack.frame.normal());
        let between: [f64; 3] = std::array::from_fn(|i| other.centre[i] - one.centre[i]);
        let square = dot3(between, between);
        let sine = (1.0 - dot3(first, second).powi(2)).max(0.0).sqrt();
        let from = |normal: [f64; 3], turned: &Disc| {
            let across = dot3(between, normal);
            let along = (square - across * across).max(0.0).sqrt() - one.radius - other.radius;
            (across.abs() - sine * turned.radius).max(0.0).hypot(along.max(0.0))
        };
        from(first, other).max(from(second, one))
    }

    fn divided(&self, cells: [usize; 2], patches: [Patch; 2], level: usize, block: &mut Block) {
        let cell = |k: usize| &self.cracks[k].crack.grid.cells[cells[k]];
        let discs = [0, 1].map(|k| self.cracks[k].crack.disc(cell(k), &patches[k]));
        let place = self.place(&discs[0], &discs[1]);
        if place.is_some() || level == DIVISIONS {
            let rule = &self.rules[place.unwrap_or(ORDERS.len() - 1)];
            let [one, other] = [0, 1].map(|k| self.cracks[k].crack.samples(cell(k), &patches[k], rule));
            return self.add(&one, &other, block);
        }
        let larger = if discs[0].radius >= discs[1].radius { 0 } else { 1 };
        let [p, q] = patches[larger].lengths(cell(larger));
        for half in if p > q { patches[larger].along_halves() } else { patches[larger].across_halves() } {
            let mut halves = patches;
            halves[larger] = half;
            self.divided(cells, halves, level + 1, block);
        }
    }

    /// Adds the products of points of two patches.
    fn add(&self, one: &[Sample], other: &[Sample], block: &mut Block) {
        for x in one {
            let mut felt = [[[0.0; 3]; 4]; 3];
            for y in other {
                let kernel = self.influence.between(x.position, y.position);
                for i in 0..3 {
                    for b in 0..4 {
                        (0..3).for_each(|j| felt[i][b][j] += y.hats[b] * kernel[i][j]);
                    }
                }
            }
            for a in 0..4 {
                for i in 0..3 {
                    for b in 0..4 {
                        (0..3).for_each(|j| block[a][i][b][j] += x.hats[a] * felt[i][b][j]);
                    }
                }
            }
        }
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

    fn placed<'a>(crack: &SpaceCrack, grid: &'a Grid) -> Placed<'a> {
        Placed { grid, frame: crack.frame(), middle: crack.middle }
    }

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
            let pair = [placed(&crack, &grid), placed(&crack, &grid)];
            let strong = Cross::new(pair, surroundings, NU, Fineness::of(pair.each_ref()));
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
            let [one, other] = [placed(&pair[0], &grids[0]), placed(&pair[1], &grids[1])];
            let of = |pair, fineness| Cross::new(pair, Surroundings::HalfSpace, NU, fineness);
            let usual = of([one, other], Fineness::of([&one, &other]));
            let finer = of([one, other], Fineness { more_points: 3, nearer: 1.3 });
            let back = of([other, one], Fineness::of([&one, &other]));
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

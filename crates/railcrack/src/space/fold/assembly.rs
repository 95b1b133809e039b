//! Stiffness of a folded crack by Galerkin's method.
//!
//! Hats of mouth and strip vanish on the fold, so that the strip alone is a planar crack with its
//! image in the surface (see `galerkin`). Hats of fold and branch vanish at the mouth: with each
//! other and with those of the strip they have the weakly singular form of the full space over both
//! planes, and the image is regular. With hats on the mouth, which do not vanish at the edge of the
//! surface, they do not touch, and the traction of the one on the other is integrated as it is.

use super::super::duffy::DuffyRules;
use super::super::face_matrix::{FaceMatrix, FaceSum};
use super::super::galerkin::{Galerkin, ImagePart};
use super::super::grid::{Block, CORNERS, Cell, CellPoint, EMPTY, times};
use super::super::mirror_image::MirroredCells;
use super::super::patch::{ApartRules, CellPair, Cover, Patch};
use super::super::plane::PlaneFrame;
use super::grid::{FoldedGrid, Part};
use super::kernel::{NO_SUMS, Stress, SurfacePoint, add_strong, add_sums, add_weak};
use super::shape::FoldedCrack;
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, dot3, gauss_legendre};
use rayon::prelude::*;

/// Points per direction where cells touch.
const DUFFY_ORDER: usize = 5;
/// For the traction of a jump, which varies as 1/r³: the distance of two patches relative to the
/// diameter of the larger one, and the number of points per direction that it requires; closer
/// patches are divided (as between two cracks, see `cross`).
const STRONG_ORDERS: [(f64, usize); 5] = [(4.0, 2), (2.0, 3), (1.0, 4), (0.6, 5), (0.4, 6)];
/// Largest number of divisions of the patches of a pair of cells.
const STRONG_DIVISIONS: usize = 24;
/// Number of cells whose blocks are held at a time.
const STRIP: usize = 32;

/// Fineness of the integration: points per direction beyond those for bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct MorePoints(pub usize);

/// The integrals of a folded crack over pairs of cells.
pub(super) struct Assembly<'a> {
    crack: &'a FoldedCrack,
    grid: &'a FoldedGrid,
    planes: [PlaneFrame; 2],
    poisson: f64,
    touching: DuffyRules,
    weak: ApartRules,
    strong: Vec<Vec<(f64, f64)>>,
}

/// The blocks of two cells: for hats that vanish at the mouth, and with a hat on the mouth.
struct Pair {
    inside: Block,
    with_mouth: Block,
}

impl Pair {
    fn times(self, count: f64) -> Self {
        let Self { inside, with_mouth } = self;
        Self { inside: times(count, inside), with_mouth: times(count, with_mouth) }
    }
}

/// Whether a pair of hats is left to the integrals of the strip alone.
fn is_of_strip(a: Part, b: Part) -> bool {
    let above = |part: Part| matches!(part, Part::Mouth | Part::Strip);
    above(a) && above(b)
}

impl<'a> Assembly<'a> {
    pub fn new(
        crack: &'a FoldedCrack,
        grid: &'a FoldedGrid,
        poisson: f64,
        MorePoints(more): MorePoints,
    ) -> Self {
        Self {
            crack,
            grid,
            planes: crack.planes(),
            poisson,
            touching: DuffyRules::new(DUFFY_ORDER + more),
            weak: ApartRules::new(more),
            strong: STRONG_ORDERS.iter().map(|&(_, order)| gauss_legendre(order + more)).collect(),
        }
    }

    /// The stiffness in units of the shear modulus (mm). Component i of the free vertex a has the
    /// row 3a + i; components are along normal, dip and trace of the plane of the vertex. `image`
    /// is that of the plane of the strip. An `interruption` ends the computation.
    pub fn stiffness_unless(
        &self,
        image: &ImagePart,
        interruption: Interruption<'_>,
    ) -> Result<FaceMatrix, Interrupted> {
        let free = self.grid.free;
        let count = self.grid.cells.len();
        let mut stiffness = Matrix::zeros(3 * free, 3 * free);
        let mirrored = MirroredCells::of_cells(&self.grid.cells, &self.grid.vertices);
        let counted = |i: usize, j: usize| match mirrored.as_ref().map_or(1.0, |cells| cells.count([i, j])) {
            0.0 => None,
            count => Some((j, self.pair(i, j)?.times(count))),
        };
        for start in (0..count).step_by(STRIP) {
            let strip = start..(start + STRIP).min(count);
            let blocks: Vec<Vec<(usize, Pair)>> = strip
                .clone()
                .into_par_iter()
                .map(|i| {
                    interruption.check()?;
                    Ok((i..count).filter_map(|j| counted(i, j)).collect())
                })
                .collect::<Result<_, Interrupted>>()?;
            // The order of summation does not depend on the number of threads.
            for (i, row) in strip.zip(&blocks) {
                row.iter().for_each(|(j, pair)| self.scatter(&mut stiffness, [i, *j], pair));
            }
        }
        self.turn(&mut stiffness);
        let strip =
            Galerkin::new(&self.grid.strip, self.poisson, Some(image)).stiffness_unless(interruption)?;
        for i in 0..strip.order() {
            stiffness.row_mut(i)[..strip.order()].copy_from_slice(&strip.row(i));
        }
        let mut sum = FaceSum::over(&self.grid.vertices[..free]);
        for i in 0..3 * free {
            stiffness.row(i).iter().enumerate().for_each(|(j, value)| sum.add([i, j], 0.5 * value));
        }
        Ok(sum.with_transpose())
    }

    /// The plane of a part; on the fold that of the strip.
    fn plane(&self, part: Part) -> &PlaneFrame {
        &self.planes[part.plane()]
    }

    fn parts(&self, cell: usize) -> impl Iterator<Item = (usize, usize, Part)> + '_ {
        let corners = self.grid.cells[cell].vertices.into_iter().enumerate();
        let free = corners.filter(|(_, v)| *v < self.grid.free);
        free.map(|(corner, v)| (corner, v, self.grid.part_of_vertex[v]))
    }

    fn scatter(&self, stiffness: &mut Matrix, [i, j]: [usize; 2], pair: &Pair) {
        for (a, va, part) in self.parts(i) {
            for (b, vb, other) in self.parts(j).filter(|(_, _, other)| !is_of_strip(part, *other)) {
                let mouth = part == Part::Mouth || other == Part::Mouth;
                let block = if mouth { &pair.with_mouth } else { &pair.inside };
                for c in 0..3 {
                    for d in 0..3 {
                        let value = block[a][c][b][d];
                        stiffness[(3 * va + c, 3 * vb + d)] += value;
                        if i != j {
                            stiffness[(3 * vb + d, 3 * va + c)] += value;
                        }
                    }
                }
            }
        }
    }

    /// From the axes of the rail to the components of each vertex.
    fn turn(&self, stiffness: &mut Matrix) {
        let directions: Vec<[[f64; 3]; 3]> =
            self.grid.part_of_vertex.iter().map(|part| self.plane(*part).directions()).collect();
        for (a, rows) in directions.iter().enumerate() {
            for (b, columns) in directions.iter().enumerate() {
                let block: [[f64; 3]; 3] =
                    std::array::from_fn(|i| std::array::from_fn(|j| stiffness[(3 * a + i, 3 * b + j)]));
                let half: [[f64; 3]; 3] =
                    std::array::from_fn(|i| std::array::from_fn(|d| dot3(block[i], columns[d])));
                for c in 0..3 {
                    for d in 0..3 {
                        stiffness[(3 * a + c, 3 * b + d)] = (0..3).map(|i| rows[c][i] * half[i][d]).sum();
                    }
                }
            }
        }
    }

    /// The blocks of the cells i and j; none where all their hats belong to the strip.
    fn pair(&self, i: usize, j: usize) -> Option<Pair> {
        let is_below = |cell: usize| self.parts(cell).any(|(_, _, part)| !is_of_strip(part, Part::Mouth));
        let has_mouth = |cell: usize| self.parts(cell).any(|(_, _, part)| part == Part::Mouth);
        let (below, mouth) = ([i, j].map(is_below), [i, j].map(has_mouth));
        if !below.contains(&true) {
            return None;
        }
        let mut image = EMPTY;
        self.apart([i, j], Stress::Image, &mut image);
        let mut inside = image;
        self.direct([i, j], &mut inside);
        let mut with_mouth = EMPTY;
        if (below[0] && mouth[1]) || (below[1] && mouth[0]) {
            with_mouth = image;
            self.apart([i, j], Stress::Kelvin, &mut with_mouth);
        }
        Some(Pair { inside, with_mouth })
    }

    /// Adds the weakly singular form of the full space.
    fn direct(&self, [i, j]: [usize; 2], block: &mut Block) {
        let cells = [&self.grid.cells[i], &self.grid.cells[j]];
        let parts = [self.grid.part_of_cell[i], self.grid.part_of_cell[j]];
        let gap = |one: &Cover, other: &Cover| self.gap(one, other);
        let pair = CellPair { cells, touching: &self.touching, apart: &self.weak, gap: &gap };
        let corners = (0..4).flat_map(|a| (0..4).map(move |b| (a, b)));
        let shared: Vec<_> = corners.filter(|&(a, b)| cells[0].vertices[a] == cells[1].vertices[b]).collect();
        let mut sums = NO_SUMS;
        let mut add = |x: &CellPoint, second: &[(CellPoint, f64)]| {
            let second: Vec<_> = second.iter().map(|(y, weight)| self.point(parts[1], y, *weight)).collect();
            add_weak(&self.point(parts[0], x, 1.0), &second, &mut sums);
        };
        match shared[..] {
            [] => pair.apart([Patch::WHOLE; 2], 0, &mut add),
            [(a, b)] => pair.corner([Patch::around(a), Patch::around(b)], &mut add),
            [(a, b), (c, d)] => pair.edge([Patch::along(a, c), Patch::along(b, d)], &mut add),
            _ => pair.same(Patch::WHOLE, &mut add),
        }
        add_sums(&sums, parts.map(|part| self.plane(part)), self.poisson, block);
    }

    /// Adds a part of the traction between cells that are apart in it.
    fn apart(&self, cells: [usize; 2], stress: Stress, block: &mut Block) {
        self.divided(cells, [Patch::WHOLE; 2], 0, stress, block);
    }

    /// Divides patches until a rule suffices for their distance.
    fn divided(
        &self,
        pair: [usize; 2],
        patches: [Patch; 2],
        level: usize,
        stress: Stress,
        block: &mut Block,
    ) {
        let cell = |k: usize| &self.grid.cells[pair[k]];
        let reaches = [0, 1].map(|k| Reach::of(cell(k), &patches[k]));
        let [one, other] = &reaches;
        let gap = match stress {
            Stress::Kelvin => self.gap(&one.cover, &other.cover).max(self.rows_between(one, other)),
            Stress::Image => self.image_gap(one, other),
        };
        let ratio = gap / (2.0 * one.cover.radius.max(other.cover.radius));
        let place = STRONG_ORDERS.iter().position(|&(limit, _)| ratio > limit);
        if place.is_some() || level == STRONG_DIVISIONS {
            let rule = &self.strong[place.unwrap_or(STRONG_ORDERS.len() - 1)];
            let [first, second] = [0, 1].map(|k| {
                let part = self.grid.part_of_cell[pair[k]];
                let points = patches[k].points(cell(k), rule);
                points.iter().map(|(x, weight)| self.point(part, x, *weight)).collect::<Vec<_>>()
            });
            first.iter().for_each(|x| add_strong(stress, x, &second, self.poisson, block));
            return;
        }
        let larger = usize::from(one.cover.radius < other.cover.radius);
        let [p, q] = patches[larger].lengths(cell(larger));
        for half in if p > q { patches[larger].along_halves() } else { patches[larger].across_halves() } {
            let mut halves = patches;
            halves[larger] = half;
            self.divided(pair, halves, level + 1, stress, block);
        }
    }

    /// A point of a cell of `part` with its weight.
    fn point(&self, part: Part, point: &CellPoint, weight: f64) -> SurfacePoint {
        SurfacePoint {
            position: self.crack.place(&self.planes, point.position),
            normal: self.plane(part).normal(),
            hats: point.hats.map(|hat| hat * point.area * weight),
            gradients: point.gradients.map(|[s, zeta]| [weight * s, weight * zeta]),
        }
    }

    /// A lower bound on the distance of two discs.
    fn gap(&self, one: &Cover, other: &Cover) -> f64 {
        let (p, q) =
            (self.crack.place(&self.planes, one.centre), self.crack.place(&self.planes, other.centre));
        let d: [f64; 3] = std::array::from_fn(|c| p[c] - q[c]);
        dot3(d, d).sqrt() - one.radius - other.radius
    }

    /// A lower bound on the distance of patches whose rows do not overlap: a chord over the fold is
    /// shorter than the way by the cosine of half its angle at most.
    fn rows_between(&self, one: &Reach, other: &Reach) -> f64 {
        let apart = (one.rows[0] - other.rows[1]).max(other.rows[0] - one.rows[1]);
        apart * (0.5 * (self.crack.branch_dip - self.crack.mouth_dip)).cos()
    }

    /// A lower bound on the distance of a patch and the image of the other.
    fn image_gap(&self, one: &Reach, other: &Reach) -> f64 {
        let depth = |reach: &Reach| self.crack.place(&self.planes, [reach.rows[0], 0.0])[2];
        let [p, q] = [one, other].map(|reach| self.crack.place(&self.planes, reach.cover.centre));
        let along = ((p[0] - q[0]).hypot(p[1] - q[1]) - one.cover.radius - other.cover.radius).max(0.0);
        along.hypot(depth(one) + depth(other))
    }
}

/// Where a patch lies.
struct Reach {
    cover: Cover,
    /// The smallest and the largest distance of its corners from the mouth, mm.
    rows: [f64; 2],
}

impl Reach {
    fn of(cell: &Cell, patch: &Patch) -> Self {
        let rows = CORNERS.map(|corner| {
            let [u, v] = patch.at(corner);
            cell.at(u, v).position[0]
        });
        let least = rows.into_iter().fold(f64::INFINITY, f64::min);
        Self { cover: patch.cover(cell), rows: [least, rows.into_iter().fold(least, f64::max)] }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::division::SpaceResolution;
    use super::super::super::grid::Grid;
    use super::super::super::image_table::ImageTable;
    use super::super::grid::FoldedResolution;
    use super::*;
    use std::sync::Arc;

    const NU: f64 = 0.3;
    const CELLS: FoldedResolution = FoldedResolution { strip: 3, branch: SpaceResolution::new(1, 2) };

    fn crack(mouth: f64, branch: f64) -> FoldedCrack {
        FoldedCrack {
            mouth_dip: mouth.to_radians(),
            branch_dip: branch.to_radians(),
            fold: 3.0,
            half_length: 2.0,
            branch: 2.0,
            middle: [0.0; 2],
            deviation: None,
        }
    }

    fn image(crack: &FoldedCrack) -> ImagePart {
        ImagePart { table: Arc::new(ImageTable::new(crack.mouth_dip, NU)), dip: crack.mouth_dip }
    }

    /// The largest difference of two matrices among `chosen` entries, relative to the diagonal.
    fn apart(one: &Matrix, other: &Matrix, chosen: impl Fn(usize, usize) -> bool) -> f64 {
        let entries = (0..one.rows()).flat_map(|i| (0..one.columns()).map(move |j| (i, j)));
        let gap =
            |(i, j): (usize, usize)| (one[(i, j)] - other[(i, j)]).abs() / (one[(i, i)] * one[(j, j)]).sqrt();
        entries.filter(|&(i, j)| chosen(i, j)).map(gap).fold(0.0, f64::max)
    }

    /// Without a fold the crack lies in one plane, and its stiffness has another form there. Both
    /// forms have the error of five points per direction where cells touch: two more reduce the
    /// difference to 2.4e-4, and without pairs of cells that touch it is 3e-6.
    #[test]
    fn a_fold_of_zero_is_the_plane_crack() {
        for degrees in [90.0, 30.0] {
            let crack = crack(degrees, degrees);
            let grid = FoldedGrid::new(&crack, CELLS).unwrap();
            let image = image(&crack);
            let assembly = Assembly::new(&crack, &grid, NU, MorePoints(0));
            let folded = assembly.stiffness_unless(&image, Interruption::NEVER).unwrap().to_matrix();
            let plane = Grid {
                cells: grid.cells.clone(),
                mouth: grid.strip.mouth.clone(),
                vertices: grid.vertices.clone(),
                free: grid.free,
                front: Vec::new(),
                is_graded: false,
            };
            let galerkin = Galerkin::new(&plane, NU, Some(&image));
            let flat = galerkin.stiffness_unless(Interruption::NEVER).unwrap().to_matrix();
            let part = |i: usize| grid.part_of_vertex[i / 3];
            let mouth = |i: usize, j: usize| part(i) == Part::Mouth || part(j) == Part::Mouth;
            let (near, with_mouth) = (apart(&flat, &folded, |_, _| true), apart(&flat, &folded, mouth));
            assert!(near < 1e-3, "{degrees}: {near:e}");
            assert!(with_mouth < 1e-5, "{degrees}, hats on the mouth: {with_mouth:e}");
        }
    }
}

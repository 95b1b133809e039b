//! Stiffness of a planar crack by Galerkin's method.
//!
//! The energy of jumps is a double integral over the crack. In the full space, with r the distance
//! and k = μ / (4π (1 − ν)), integration by parts leaves (Nedelec 1982; Li, Mear & Xiao 1998)
//!
//!   k ∬ ∇w_n·∇′w_n′/r for opening, k ∬ [(1 − ν) ∇w_a·∇′w_a′ + ν div w div′w′]/r for the two slips.
//!
//! In the half-space the image is added with the help of the reflection within the plane (see
//! `image_table`): the full space of the jump continued evenly across the mouth, and ∬ ∂_s w_i Q_ij
//! ∂_s′w_j′ + ∬ ∂_s w_i Q_ij(s, 0) w_j′(0) + its transpose, the last two over the crack and its
//! mouth. Integrating ∂_s w_s ∂_ζ′w_ζ′ by parts leaves one more such term at the mouth. All kernels
//! grow as 1/r at most, so that the integrals are as accurate as their quadrature rules, with Duffy
//! coordinates where cells touch.

use super::duffy::DuffyRules;
use super::face_matrix::{FaceMatrix, FaceSum};
use super::grid::{Block, Cell, CellPoint, EMPTY, Grid, counted};
use super::image_table::ImageTable;
use super::mirror_image::MirroredCells;
use super::patch::{ApartRules, CellPair, Cover, LinePoint, MouthPair, Patch, weighted};
use crate::interruption::{Interrupted, Interruption};
use crate::math::gauss_legendre;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Points per direction where cells touch.
const DUFFY_ORDER: usize = 5;
/// The same where a cell touches its image, at 90° and per reciprocal sine of the dip, since the
/// image of a shallow crack is close.
const IMAGE_ORDER: f64 = 4.0;
const SHALLOW_ORDER: f64 = 1.5;
/// Additional points per direction for separate cells of a graded grid: those at the mouth of a
/// shallow crack are narrow, and the energy of its flap is a small difference of large numbers.
const GRADED_MORE: usize = 1;
/// Share of the distance to an image that counts, since the image varies faster than 1/r.
const IMAGE_GAP: f64 = 0.5;
/// Additional points per direction for a cell and a separate part of the mouth, compared with two
/// cells: the kernel varies faster than 1/r, and jumps are largest at the mouth.
const MOUTH_MORE: usize = 2;
/// Points per direction on the mouth.
const MOUTH_ORDER: usize = 8;

/// The image in the surface for the plane of a crack.
#[derive(Debug, Clone)]
pub(super) struct ImagePart {
    /// The twice integrated kernel.
    pub table: Arc<ImageTable>,
    /// The dip angle, radians.
    pub dip: f64,
}

/// The integrals over a grid.
pub(super) struct Galerkin<'a> {
    grid: &'a Grid,
    poisson: f64,
    image: Option<&'a ImagePart>,
    near: DuffyRules,
    mouth: DuffyRules,
    apart: ApartRules,
    apart_mouth: ApartRules,
    logarithmic: Vec<(f64, f64)>,
    /// Cells at the points of the rules of the whole cell.
    points: Vec<Vec<Vec<(CellPoint, f64)>>>,
    covers: Vec<Cover>,
    mirrored: Option<MirroredCells>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Half {
    Direct,
    Image,
}

impl<'a> Galerkin<'a> {
    pub fn new(grid: &'a Grid, poisson: f64, image: Option<&'a ImagePart>) -> Self {
        Self::with_more_points(grid, poisson, image, 0)
    }

    /// The integrals with `more` points per direction where cells are separate from each other or
    /// from the mouth.
    pub fn with_more_points(grid: &'a Grid, poisson: f64, image: Option<&'a ImagePart>, more: usize) -> Self {
        let more = more + if grid.is_graded { GRADED_MORE } else { 0 };
        let (apart, apart_mouth) = (ApartRules::new(more), ApartRules::new(MOUTH_MORE + more));
        let of_cell = |cell| apart.all().iter().map(|rule| Patch::WHOLE.points(cell, rule)).collect();
        let points = grid.cells.iter().map(of_cell).collect();
        let covers = grid.cells.iter().map(|cell| Patch::WHOLE.cover(cell)).collect();
        let order = image.map_or(1.0, |image| IMAGE_ORDER + SHALLOW_ORDER / image.dip.sin());
        let (near, mouth) = (DuffyRules::new(DUFFY_ORDER), DuffyRules::new(order.round() as usize));
        let logarithmic = gauss_legendre(MOUTH_ORDER);
        let mirrored = MirroredCells::of(grid);
        Self { grid, poisson, image, near, mouth, apart, apart_mouth, logarithmic, points, covers, mirrored }
    }

    /// The stiffness in units of the shear modulus (mm), over the free vertices; averaged with its
    /// mirror image where the grid has one, since the quadrature takes the cells in an order that
    /// has none. An `interruption` ends the computation.
    pub fn stiffness_unless(&self, interruption: Interruption<'_>) -> Result<FaceMatrix, Interrupted> {
        let cells = &self.grid.cells;
        let mut stiffness = FaceSum::over(&self.grid.vertices[..self.grid.free]);
        // Cells are processed in strips, so that the order of summation does not depend on the
        // number of threads.
        for start in (0..cells.len()).step_by(STRIP) {
            let strip = start..(start + STRIP).min(cells.len());
            let blocks: Vec<Vec<(usize, Block)>> = strip
                .clone()
                .into_par_iter()
                .map(|i| {
                    interruption.check()?;
                    let count = |j| self.mirrored.as_ref().map_or(1.0, |mirrored| mirrored.count([i, j]));
                    let block = |j| Some((j, counted(count(j), || self.pair(i, j))?));
                    Ok((i..cells.len()).filter_map(block).collect())
                })
                .collect::<Result<_, Interrupted>>()?;
            for (i, row) in strip.zip(&blocks) {
                for (j, block) in row {
                    self.scatter(&mut stiffness, [i, *j], block, if i == *j { 0.5 } else { 1.0 });
                }
            }
        }
        if self.image.is_some() {
            let edges = &self.grid.mouth;
            let lines: Vec<Vec<(usize, Block)>> = (0..cells.len())
                .into_par_iter()
                .map(|i| {
                    interruption.check()?;
                    let count =
                        |e| self.mirrored.as_ref().map_or(1.0, |mirrored| mirrored.count_with_edge([i, e]));
                    let block = |e: usize| Some((edges[e].0, counted(count(e), || self.line(i, e))?));
                    Ok((0..edges.len()).filter_map(block).collect())
                })
                .collect::<Result<_, Interrupted>>()?;
            for (i, row) in lines.iter().enumerate() {
                for (j, block) in row {
                    self.scatter(&mut stiffness, [i, *j], block, 1.0);
                }
            }
            for (one, (i, _)) in edges.iter().enumerate() {
                for (other, (j, _)) in edges.iter().enumerate() {
                    self.scatter(&mut stiffness, [*i, *j], &self.lines(one, other), 1.0);
                    if one == other {
                        self.scatter(&mut stiffness, [*i, *i], &self.own_line(one), 0.5);
                    }
                }
            }
        }
        Ok(stiffness.with_transpose())
    }

    /// Adds a `share` of the block of the cells i and j; the stiffness contains its transpose, too.
    fn scatter(&self, stiffness: &mut FaceSum, [i, j]: [usize; 2], block: &Block, share: f64) {
        let free = self.grid.free;
        for (a, &va) in self.grid.cells[i].vertices.iter().enumerate().filter(|(_, v)| **v < free) {
            for (b, &vb) in self.grid.cells[j].vertices.iter().enumerate().filter(|(_, v)| **v < free) {
                for c in 0..3 {
                    for d in 0..3 {
                        stiffness.add([3 * va + c, 3 * vb + d], share * block[a][c][b][d]);
                    }
                }
            }
        }
    }

    /// The block of the cells i and j.
    fn pair(&self, i: usize, j: usize) -> Block {
        let mut block = EMPTY;
        let cells = [&self.grid.cells[i], &self.grid.cells[j]];
        let corners = (0..4).flat_map(|a| (0..4).map(move |b| (a, b)));
        let shared: Vec<_> = corners.filter(|&(a, b)| cells[0].vertices[a] == cells[1].vertices[b]).collect();
        self.half(i, j, Half::Direct, &shared, &mut block);
        if self.image.is_some() {
            // A cell touches the image of another where both touch the mouth.
            let on_mouth = |(a, _): &(usize, usize)| self.grid.vertices[cells[0].vertices[*a]][0] == 0.0;
            let shared: Vec<_> = shared.into_iter().filter(on_mouth).collect();
            self.half(i, j, Half::Image, &shared, &mut block);
        }
        block
    }

    fn half(&self, i: usize, j: usize, half: Half, shared: &[(usize, usize)], block: &mut Block) {
        let cells = [&self.grid.cells[i], &self.grid.cells[j]];
        let touching = if half == Half::Direct { &self.near } else { &self.mouth };
        let gap = |one: &Cover, other: &Cover| self.gap(one, other, half);
        let pair = CellPair { cells, touching, apart: &self.apart, gap: &gap };
        let mut add = |x: &CellPoint, second: &[(CellPoint, f64)]| self.add(half, x, second, block);
        match *shared {
            [] => {
                let covers = [&self.covers[i], &self.covers[j]];
                match ApartRules::place(gap(covers[0], covers[1]), covers[0], covers[1]) {
                    Some(place) => {
                        for (x, weight) in &self.points[i][place] {
                            add(&weighted(x, *weight), &self.points[j][place]);
                        }
                    }
                    None => pair.apart([Patch::WHOLE; 2], 0, &mut add),
                }
            }
            [(a, b)] => pair.corner([Patch::around(a), Patch::around(b)], &mut add),
            [(a, b), (c, d)] => pair.edge([Patch::along(a, c), Patch::along(b, d)], &mut add),
            _ => pair.same(Patch::WHOLE, &mut add),
        }
    }

    /// The distance of two discs, the second one reflected in the surface where it is an image: its
    /// plane then rises where the other descends.
    fn gap(&self, one: &Cover, other: &Cover, half: Half) -> f64 {
        let radii = one.radius + other.radius;
        let (ds, tau) = (one.centre[0] - other.centre[0], one.centre[1] - other.centre[1]);
        match (half, self.image) {
            (Half::Image, Some(image)) => {
                let (sin, cos) = image.dip.sin_cos();
                let depth = |cover: &Cover| (cover.centre[0] - cover.radius).max(0.0) * sin;
                let along = ((ds * cos).hypot(tau) - radii).max(0.0);
                IMAGE_GAP * along.hypot(depth(one) + depth(other))
            }
            _ => ds.hypot(tau) - radii,
        }
    }

    /// Adds the products of the point `x` with the points of another cell and their weights.
    fn add(&self, half: Half, x: &CellPoint, second: &[(CellPoint, f64)], block: &mut Block) {
        match (half, self.image) {
            (Half::Direct, _) => self.add_direct(x, second, block),
            (Half::Image, Some(image)) => self.add_image(image, x, second, block),
            (Half::Image, None) => {}
        }
    }

    fn add_direct(&self, x: &CellPoint, second: &[(CellPoint, f64)], block: &mut Block) {
        let nu = self.poisson;
        let k = 1.0 / (4.0 * PI * (1.0 - nu));
        let mut potential = [[0.0; 2]; 4];
        for (y, weight) in second {
            let (ds, dz) = (x.position[0] - y.position[0], x.position[1] - y.position[1]);
            let w = k * weight / (ds * ds + dz * dz).sqrt();
            for b in 0..4 {
                potential[b][0] += w * y.gradients[b][0];
                potential[b][1] += w * y.gradients[b][1];
            }
        }
        for a in 0..4 {
            let g = x.gradients[a];
            for b in 0..4 {
                let (ss, zz) = (g[0] * potential[b][0], g[1] * potential[b][1]);
                let both = ss + zz;
                block[a][0][b][0] += both;
                block[a][1][b][1] += (1.0 - nu) * both + nu * ss;
                block[a][2][b][2] += (1.0 - nu) * both + nu * zz;
                block[a][1][b][2] += nu * g[0] * potential[b][1];
                block[a][2][b][1] += nu * g[1] * potential[b][0];
            }
        }
    }

    fn add_image(&self, image: &ImagePart, x: &CellPoint, second: &[(CellPoint, f64)], block: &mut Block) {
        let nu = self.poisson;
        let k = 1.0 / (4.0 * PI * (1.0 - nu));
        let s = x.position[0].max(0.0);
        let mut dip = [[[0.0; 3]; 3]; 4];
        let mut trace = [0.0; 4];
        for (y, weight) in second {
            let (other, tau) = (y.position[0].max(0.0), x.position[1] - y.position[1]);
            let mut q = image.table.kernel(s, other, tau);
            // The reflection within the plane.
            let reflected = k / ((s + other) * (s + other) + tau * tau).sqrt();
            q[0][0] -= reflected;
            q[1][1] -= reflected;
            q[2][2] -= (1.0 - nu) * reflected;
            for b in 0..4 {
                let g = weight * y.gradients[b][0];
                for i in 0..3 {
                    for j in 0..3 {
                        dip[b][i][j] += g * q[i][j];
                    }
                }
                trace[b] += weight * reflected * y.gradients[b][1];
            }
        }
        for a in 0..4 {
            let g = x.gradients[a];
            for b in 0..4 {
                let zz = g[1] * trace[b];
                for i in 0..3 {
                    for j in 0..3 {
                        block[a][i][b][j] += g[0] * dip[b][i][j];
                    }
                }
                block[a][0][b][0] += zz;
                block[a][1][b][1] += (1.0 - nu) * zz;
                block[a][2][b][2] += zz;
            }
        }
    }

    /// The block of cell i with the mouth edge `edge`: jumps on the mouth.
    fn line(&self, i: usize, edge: usize) -> Block {
        let mut block = EMPTY;
        let Some(image) = self.image else { return block };
        let (j, [from, to]) = self.grid.mouth[edge];
        let cells = [&self.grid.cells[i], &self.grid.cells[j]];
        let corner = |end: usize| cells[0].vertices.iter().position(|&v| v == cells[1].vertices[end]);
        let pair = MouthPair { cells, touching: &self.mouth, apart: &self.apart_mouth };
        let mut add = |x: &CellPoint, line: &LinePoint, weight: f64| {
            self.add_line(image, x, line, weight, &mut block);
        };
        match (corner(from), corner(to)) {
            (Some(a), Some(b)) => pair.own([Patch::along(a, b), Patch::along(from, to)], &mut add),
            (Some(a), None) => pair.corner([Patch::around(a), Patch::along(from, to)], &mut add),
            (None, Some(b)) => pair.corner([Patch::around(b), Patch::along(to, from)], &mut add),
            (None, None) => pair.apart([Patch::WHOLE, Patch::along(from, to)], 0, &mut add),
        }
        block
    }

    /// ∫ w_i P_ij w_j dζ along a mouth edge, P the concentrated part of Q(0, 0, τ).
    fn own_line(&self, edge: usize) -> Block {
        let mut block = EMPTY;
        let Some(image) = self.image else { return block };
        let concentrated = image.table.concentrated();
        let (j, [from, to]) = self.grid.mouth[edge];
        let frame = Patch::along(from, to);
        for (x, weight) in &self.logarithmic {
            let [u, v] = frame.at([*x, 0.0]);
            let cell = self.grid.cells[j].at(u, v);
            let line = LinePoint::new(&self.grid.cells[j], &frame, *x);
            for a in [from, to] {
                for b in [from, to] {
                    for c in 0..3 {
                        for d in 0..3 {
                            block[a][c][b][d] += weight * line.hats[a] * cell.hats[b] * concentrated[c][d];
                        }
                    }
                }
            }
        }
        block
    }

    /// The block of two mouth edges: the contribution of Q(0, 0, τ), which is concentrated at τ = 0
    /// in some components and equals c_ij/τ in others; integration by parts turns the latter into
    /// −c_ij ∂_ζ w_i ln|τ| w_j′.
    fn lines(&self, one: usize, other: usize) -> Block {
        let mut block = EMPTY;
        let Some(image) = self.image else { return block };
        let c = image.table.kernel(0.0, 0.0, 1.0);
        let edge = |e: usize| {
            let (cell, corners) = self.grid.mouth[e];
            (&self.grid.cells[cell], corners)
        };
        let ((first, [a, b]), (second, [c0, c1])) = (edge(one), edge(other));
        let at =
            |cell: &Cell, from: usize, to: usize, p: f64| LinePoint::new(cell, &Patch::along(from, to), p);
        let mut add = |p: f64, q: f64, weight: f64| {
            let (x, y) = (at(first, a, b, p), at(second, c0, c1, q));
            let value = -weight * (x.zeta - y.zeta).abs().ln();
            // d N/d p over the edge: −1 and 1 at its ends, on the side to which ζ grows.
            for (corner, slope) in [(a, -x.sense), (b, x.sense)] {
                for d in [c0, c1] {
                    for i in 0..2 {
                        block[corner][i][d][2] += c[i][2] * slope * y.hats[d] * value;
                    }
                }
            }
        };
        let ends = [first.vertices[a], first.vertices[b]];
        let others = [second.vertices[c0], second.vertices[c1]];
        let rule = &self.logarithmic;
        // At the common point of two edges, if any, the logarithm is singular; the cubes of the
        // Gauss points cluster there.
        let common = (0..2).flat_map(|i| (0..2).map(move |j| (i, j))).find(|&(i, j)| ends[i] == others[j]);
        let from = |end: usize, t: f64| if end == 0 { t } else { 1.0 - t };
        for (x, wx) in rule {
            let (t, wt) = (x.powi(3), 3.0 * x * x * wx);
            for (y, wy) in rule {
                if one == other {
                    let start = (1.0 - t) * y;
                    let weight = wt * wy * (1.0 - t);
                    add(start, start + t, weight);
                    add(start + t, start, weight);
                } else if let Some((i, j)) = common {
                    add(from(i, t), from(j, t * y), wt * wy * t);
                    add(from(i, t * y), from(j, t), wt * wy * t);
                } else {
                    add(*x, *y, wx * wy);
                }
            }
        }
        block
    }

    /// ∂_s w_i Q_ij(s, 0, τ) w_j′, and for the full space ν ∂_ζ w_ζ w_s′/r.
    fn add_line(&self, image: &ImagePart, x: &CellPoint, line: &LinePoint, weight: f64, block: &mut Block) {
        let nu = self.poisson;
        let k = 1.0 / (4.0 * PI * (1.0 - nu));
        let (s, tau) = (x.position[0].max(0.0), x.position[1] - line.zeta);
        let q = image.table.kernel(s, 0.0, tau);
        let full = nu * k / s.hypot(tau);
        for a in 0..4 {
            let g = x.gradients[a];
            for b in 0..4 {
                let hat = weight * line.hats[b];
                for i in 0..3 {
                    for j in 0..3 {
                        block[a][i][b][j] += hat * g[0] * q[i][j];
                    }
                }
                block[a][2][b][1] += hat * g[1] * full;
            }
        }
    }
}

/// Number of cells whose blocks are held at a time.
const STRIP: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{CellDivision, SpaceCrack, SpaceKernel, SpaceResolution};

    #[test]
    fn one_of_two_mirrored_products_is_enough() {
        let crack = SpaceCrack::surface_breaking(0.5, 3.0, 2.0).unwrap();
        let grid = Grid::new(&crack, &CellDivision::of(&crack, SpaceResolution::new(2, 2)));
        let image = SpaceKernel::new(&[crack.dip], 0.3).image(crack.dip);
        let half = Galerkin::new(&grid, 0.3, Some(&image));
        assert!(half.mirrored.is_some());
        let pairs = (0..grid.cells.len()).flat_map(|i| (i..grid.cells.len()).map(move |j| [i, j]));
        let count = |pair| half.mirrored.as_ref().map_or(1.0, |mirrored| mirrored.count(pair));
        let left_out = pairs.clone().filter(|&pair| count(pair) == 0.0).count();
        assert!(5 * left_out > 2 * pairs.count(), "{left_out} of all products");
        let whole = Galerkin { mirrored: None, ..Galerkin::new(&grid, 0.3, Some(&image)) };
        let of = |all: Galerkin| all.stiffness_unless(Interruption::NEVER).unwrap().to_matrix();
        let [half, whole] = [half, whole].map(of);
        let largest = (0..whole.rows()).fold(0.0f64, |most, i| most.max(whole[(i, i)]));
        let entries = half.entries().iter().zip(whole.entries());
        let off = entries.fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / largest;
        // The divisions of the quadrature are not mirrored.
        assert!(off < 1e-6, "{off:e}");
    }
}

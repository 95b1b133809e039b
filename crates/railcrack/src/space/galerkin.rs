//! Stiffness of a planar crack by Galerkin's method.
//!
//! The energy of jumps is a double integral over the crack. In the full space, with r the distance
//! and k = μ / (4π (1 − ν)), integration by parts leaves (Nedelec 1982; Li, Mear & Xiao 1998)
//!
//!   k ∬ ∇w_n·∇′w_n′/r for opening, k ∬ [(1 − ν) ∇w_a·∇′w_a′ + ν div w div′w′]/r for the two slips.
//!
//! In the half-space the image is added with the help of the reflection within the plane
//! (see `image_table`): the full space of the jump continued evenly across the mouth, and
//! ∬ ∂_s w_i Q_ij ∂_s′w_j′ + ∬ ∂_s w_i Q_ij(s, 0) w_j′(0) + its transpose, the last two over the
//! crack and its mouth. Where the mouth ends the integral by parts of ∂_s w_s ∂_ζ′w_ζ′, it leaves
//! one more such term. All kernels grow as 1/r at most: the integrals are taken to the accuracy of
//! their quadrature rules, by coordinates of Duffy where cells touch.

use super::cell::{Cell, CellPoint};
use super::duffy::{DuffyRules, LocalFrame, PairPoint};
use super::grid::Grid;
use super::image_table::ImageTable;
use crate::math::{Matrix, gauss_legendre};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Points per direction where cells touch.
const DUFFY_ORDER: usize = 5;
/// Points per direction where a cell touches its image.
const IMAGE_ORDER: usize = 6;
/// Distance over size of two cells, and the points per direction that it takes; closer cells are
/// divided.
const ORDERS: [(f64, usize); 4] = [(3.0, 2), (1.2, 3), (0.5, 4), (0.25, 6)];
/// Divisions of a cell, at most.
const DIVISIONS: usize = 8;

/// A block of two cells: hats of the first, components, hats of the second, components.
type Block = [[[[f64; 3]; 4]; 3]; 4];
const EMPTY: Block = [[[[0.0; 3]; 4]; 3]; 4];

/// A part of the unit square.
#[derive(Debug, Clone, Copy)]
struct Part {
    corner: [f64; 2],
    size: [f64; 2],
}

const WHOLE: Part = Part { corner: [0.0; 2], size: [1.0; 2] };

impl Part {
    fn at(&self, x: f64, y: f64) -> [f64; 2] {
        [self.corner[0] + self.size[0] * x, self.corner[1] + self.size[1] * y]
    }

    fn quarters(&self) -> [Part; 4] {
        let size = self.size.map(|s| 0.5 * s);
        [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]].map(|[x, y]| Part { corner: self.at(x, y), size })
    }
}

/// A disc that holds a part of a cell.
#[derive(Debug, Clone, Copy)]
struct Cover {
    centre: [f64; 2],
    radius: f64,
}

impl Cover {
    fn new(cell: &Cell, part: &Part) -> Self {
        let at = |x: f64, y: f64| {
            let [u, v] = part.at(x, y);
            cell.at(u, v).position
        };
        let centre = at(0.5, 0.5);
        let away = |p: [f64; 2]| (p[0] - centre[0]).hypot(p[1] - centre[1]);
        let edge = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]];
        Self { centre, radius: edge.map(|[x, y]| away(at(x, y))).into_iter().fold(0.0, f64::max) }
    }
}

/// The half-space seen from the plane of a crack.
#[derive(Debug, Clone)]
pub(super) struct ImagePart {
    /// Twice integrated kernel.
    pub table: ImageTable,
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
    rules: Vec<Vec<(f64, f64)>>,
    logarithmic: Vec<(f64, f64)>,
    /// Cells at the points of the rules of the whole cell.
    points: Vec<Vec<Vec<(CellPoint, f64)>>>,
    covers: Vec<Cover>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Half {
    Direct,
    Image,
}

impl<'a> Galerkin<'a> {
    pub fn new(grid: &'a Grid, poisson: f64, image: Option<&'a ImagePart>) -> Self {
        let rules: Vec<_> = ORDERS.iter().map(|&(_, order)| gauss_legendre(order)).collect();
        let points = grid
            .cells
            .iter()
            .map(|cell| rules.iter().map(|rule| rule_points(cell, &WHOLE, rule)).collect())
            .collect();
        let covers = grid.cells.iter().map(|cell| Cover::new(cell, &WHOLE)).collect();
        let (near, mouth) = (DuffyRules::new(DUFFY_ORDER), DuffyRules::new(IMAGE_ORDER));
        let logarithmic = gauss_legendre(8);
        Self { grid, poisson, image, near, mouth, rules, logarithmic, points, covers }
    }

    /// The stiffness in units of the shear modulus (mm): component i of the free vertex a is row
    /// 3a + i; symmetric.
    pub fn stiffness(&self) -> Matrix {
        let free = self.grid.free;
        let cells = &self.grid.cells;
        let mut stiffness = Matrix::zeros(3 * free, 3 * free);
        // Strips of some cells at a time: the sums are made in the same order by any number of threads.
        for start in (0..cells.len()).step_by(STRIP) {
            let strip = start..(start + STRIP).min(cells.len());
            let blocks: Vec<Vec<Block>> = strip
                .clone()
                .into_par_iter()
                .map(|i| (i..cells.len()).map(|j| self.pair(i, j)).collect())
                .collect();
            for (i, row) in strip.zip(&blocks) {
                for (j, block) in (i..).zip(row) {
                    self.scatter(&mut stiffness, i, j, block, i != j);
                }
            }
        }
        if self.image.is_some() {
            let edges = &self.grid.mouth;
            let lines: Vec<Vec<Block>> = (0..cells.len())
                .into_par_iter()
                .map(|i| (0..edges.len()).map(|e| self.line(i, e)).collect())
                .collect();
            for (i, row) in lines.iter().enumerate() {
                for (block, (j, _)) in row.iter().zip(edges) {
                    self.scatter(&mut stiffness, i, *j, block, true);
                }
            }
            for (one, (i, _)) in edges.iter().enumerate() {
                for (other, (j, _)) in edges.iter().enumerate() {
                    self.scatter(&mut stiffness, *i, *j, &self.lines(one, other), true);
                    if one == other {
                        self.scatter(&mut stiffness, *i, *i, &self.own_line(one), false);
                    }
                }
            }
        }
        for i in 0..3 * free {
            for j in 0..i {
                let mean = 0.5 * (stiffness[(i, j)] + stiffness[(j, i)]);
                stiffness[(i, j)] = mean;
                stiffness[(j, i)] = mean;
            }
        }
        stiffness
    }

    fn scatter(&self, stiffness: &mut Matrix, i: usize, j: usize, block: &Block, and_transposed: bool) {
        let free = self.grid.free;
        for (a, &va) in self.grid.cells[i].vertices.iter().enumerate().filter(|(_, v)| **v < free) {
            for (b, &vb) in self.grid.cells[j].vertices.iter().enumerate().filter(|(_, v)| **v < free) {
                for c in 0..3 {
                    for d in 0..3 {
                        let value = block[a][c][b][d];
                        stiffness[(3 * va + c, 3 * vb + d)] += value;
                        if and_transposed {
                            stiffness[(3 * vb + d, 3 * va + c)] += value;
                        }
                    }
                }
            }
        }
    }

    /// The block of the cells i and j.
    pub fn pair(&self, i: usize, j: usize) -> Block {
        let mut block = EMPTY;
        let (first, second) = (&self.grid.cells[i], &self.grid.cells[j]);
        let shared: Vec<(usize, usize)> = (0..4)
            .flat_map(|a| (0..4).map(move |b| (a, b)))
            .filter(|&(a, b)| first.vertices[a] == second.vertices[b])
            .collect();
        match shared[..] {
            [] => self.apart(i, j, Half::Direct, &mut block),
            [(a, b)] => {
                let frames = [LocalFrame::around(a), LocalFrame::around(b)];
                self.touching(&self.near.corner, [first, second], frames, Half::Direct, &mut block);
            }
            [(a, b), (c, d)] => {
                let frames = [LocalFrame::along(a, c), LocalFrame::along(b, d)];
                self.touching(&self.near.edge, [first, second], frames, Half::Direct, &mut block);
            }
            _ => {
                let frames = [LocalFrame::along(0, 1); 2];
                self.touching(&self.near.same, [first, second], frames, Half::Direct, &mut block);
            }
        }
        if self.image.is_some() {
            let on_mouth = |&(a, _): &(usize, usize)| self.grid.vertices[first.vertices[a]][0] == 0.0;
            let shared: Vec<_> = shared.into_iter().filter(on_mouth).filter(|&(a, b)| i != j || a == b).collect();
            match shared[..] {
                [] => self.apart(i, j, Half::Image, &mut block),
                [(a, b)] => {
                    let frames = [LocalFrame::around(a), LocalFrame::around(b)];
                    self.touching(&self.mouth.corner, [first, second], frames, Half::Image, &mut block);
                }
                [(a, b), (c, d), ..] => {
                    let frames = [LocalFrame::along(a, c), LocalFrame::along(b, d)];
                    self.touching(&self.mouth.edge, [first, second], frames, Half::Image, &mut block);
                }
            }
        }
        block
    }

    fn touching(
        &self,
        rule: &[PairPoint],
        [first, second]: [&Cell; 2],
        [one, other]: [LocalFrame; 2],
        half: Half,
        block: &mut Block,
    ) {
        for pair in rule {
            let ([u, v], [p, q]) = (one.at(pair.first), other.at(pair.second));
            let (x, y) = (first.at(u, v), second.at(p, q));
            self.add(half, &x, &[(y, pair.weight)], block);
        }
    }

    fn apart(&self, i: usize, j: usize, half: Half, block: &mut Block) {
        let covers = [self.covers[i], self.covers[j]];
        match self.order(covers, half) {
            Some(order) => {
                let (first, second) = (&self.points[i][order], &self.points[j][order]);
                for (x, weight) in first {
                    self.add_weighted(half, x, *weight, second, block);
                }
            }
            None => {
                let cells = [&self.grid.cells[i], &self.grid.cells[j]];
                self.divided(cells, [WHOLE; 2], covers, half, 0, block);
            }
        }
    }

    /// The rule for two parts at some distance, if one is enough.
    fn order(&self, [one, other]: [Cover; 2], half: Half) -> Option<usize> {
        let tau = one.centre[1] - other.centre[1];
        let between = match (half, self.image) {
            (Half::Image, Some(image)) => {
                let (s, t) = (one.centre[0], other.centre[0]);
                (s * s + t * t - 2.0 * s * t * (2.0 * image.dip).cos() + tau * tau).max(0.0).sqrt()
            }
            _ => (one.centre[0] - other.centre[0]).hypot(tau),
        };
        let ratio = (between - one.radius - other.radius) / (2.0 * one.radius.max(other.radius));
        ORDERS.iter().position(|&(limit, _)| ratio > limit)
    }

    fn divided(
        &self,
        cells: [&Cell; 2],
        parts: [Part; 2],
        covers: [Cover; 2],
        half: Half,
        level: usize,
        block: &mut Block,
    ) {
        let order = self.order(covers, half);
        if order.is_some() || level == DIVISIONS {
            let rule = &self.rules[order.unwrap_or(ORDERS.len() - 1)];
            let second = rule_points(cells[1], &parts[1], rule);
            for (x, weight) in rule_points(cells[0], &parts[0], rule) {
                self.add_weighted(half, &x, weight, &second, block);
            }
        } else if covers[0].radius >= covers[1].radius {
            for part in parts[0].quarters() {
                let covers = [Cover::new(cells[0], &part), covers[1]];
                self.divided(cells, [part, parts[1]], covers, half, level + 1, block);
            }
        } else {
            for part in parts[1].quarters() {
                let covers = [covers[0], Cover::new(cells[1], &part)];
                self.divided(cells, [parts[0], part], covers, half, level + 1, block);
            }
        }
    }

    fn add_weighted(&self, half: Half, x: &CellPoint, weight: f64, second: &[(CellPoint, f64)], block: &mut Block) {
        let gradients = x.gradients.map(|g| g.map(|v| v * weight));
        self.add(half, &CellPoint { gradients, ..*x }, second, block);
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
        let cell = &self.grid.cells[i];
        let (j, [from, to]) = self.grid.mouth[edge];
        let other = &self.grid.cells[j];
        let ends = [other.vertices[from], other.vertices[to]];
        let corner = |end: usize| cell.vertices.iter().position(|&v| v == ends[end]);
        let mut add = |[u, v]: [f64; 2], frame: &LocalFrame, q: f64, weight: f64| {
            let [p, r] = frame.at([q, 0.0]);
            self.add_line(image, &cell.at(u, v), line_point(other, p, r, from, to), weight, &mut block);
        };
        match (corner(0), corner(1)) {
            (Some(a), Some(b)) => {
                let (own, line) = (LocalFrame::along(a, b), LocalFrame::along(from, to));
                for pair in &self.mouth.own_line {
                    add(own.at(pair.first), &line, pair.second[0], pair.weight);
                }
            }
            (Some(a), None) | (None, Some(a)) => {
                let starts = cell.vertices[a] == ends[0];
                let line = if starts { LocalFrame::along(from, to) } else { LocalFrame::along(to, from) };
                let own = LocalFrame::around(a);
                for pair in &self.mouth.corner_line {
                    add(own.at(pair.first), &line, pair.second[0], pair.weight);
                }
            }
            (None, None) => {
                let line = LocalFrame::along(from, to);
                let (start, end) = (self.grid.vertices[ends[0]], self.grid.vertices[ends[1]]);
                let half = 0.5 * (end[1] - start[1]).abs();
                let cover = Cover { centre: [0.0, 0.5 * (start[1] + end[1])], radius: half };
                self.line_apart(cell, WHOLE, cover, 0, &mut |point, rule| {
                    for (q, weight) in rule {
                        add(point.0, &line, *q, weight * point.1);
                    }
                });
            }
        }
        block
    }

    /// ∫ w_i P_ij w_j dζ along a mouth edge, P the concentrated part of Q(0, 0, τ).
    fn own_line(&self, edge: usize) -> Block {
        let mut block = EMPTY;
        let Some(image) = self.image else { return block };
        let concentrated = image.table.concentrated();
        let (j, [from, to]) = self.grid.mouth[edge];
        let frame = LocalFrame::along(from, to);
        for (x, weight) in &self.logarithmic {
            let [u, v] = frame.at([*x, 0.0]);
            let cell = self.grid.cells[j].at(u, v);
            let line = line_point(&self.grid.cells[j], u, v, from, to);
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

    /// The block of two mouth edges: what Q(0, 0, τ) leaves, which is concentrated at τ = 0 in some
    /// components and c_ij/τ in others, one integration by parts away from −c_ij ∂_ζ w_i ln|τ| w_j′.
    fn lines(&self, one: usize, other: usize) -> Block {
        let mut block = EMPTY;
        let Some(image) = self.image else { return block };
        let c = image.table.kernel(0.0, 0.0, 1.0);
        let edge = |e: usize| {
            let (cell, corners) = self.grid.mouth[e];
            (&self.grid.cells[cell], corners)
        };
        let ((first, [a, b]), (second, [c0, c1])) = (edge(one), edge(other));
        let at = |cell: &Cell, from: usize, to: usize, p: f64| {
            let [u, v] = LocalFrame::along(from, to).at([p, 0.0]);
            line_point(cell, u, v, from, to)
        };
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
        // The common point of two edges, if any, is where the logarithm is singular: cubes of the
        // points of Gauss' rule cluster there.
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

    fn line_apart(
        &self,
        cell: &Cell,
        part: Part,
        line: Cover,
        level: usize,
        visit: &mut impl FnMut(([f64; 2], f64), &[(f64, f64)]),
    ) {
        let own = Cover::new(cell, &part);
        let order = self.order([own, line], Half::Direct);
        if order.is_none() && level < DIVISIONS && own.radius >= 0.5 * line.radius {
            part.quarters().into_iter().for_each(|part| self.line_apart(cell, part, line, level + 1, visit));
            return;
        }
        let rule = &self.rules[order.unwrap_or(ORDERS.len() - 1)];
        for (x, wx) in rule {
            for (y, wy) in rule {
                visit((part.at(*x, *y), wx * wy * part.size[0] * part.size[1]), rule);
            }
        }
    }

    /// ∂_s w_i Q_ij(s, 0, τ) w_j′, and of the full space ν ∂_ζ w_ζ w_s′/r.
    fn add_line(&self, image: &ImagePart, x: &CellPoint, line: LinePoint, weight: f64, block: &mut Block) {
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

/// Cells of which blocks are kept at a time.
const STRIP: usize = 32;

/// A point of the mouth.
#[derive(Debug, Clone, Copy)]
struct LinePoint {
    zeta: f64,
    /// Hats times the length per unit of the edge, mm.
    hats: [f64; 4],
    /// Whether ζ grows (1) or falls (−1) along the edge.
    sense: f64,
}

fn line_point(cell: &Cell, u: f64, v: f64, from: usize, to: usize) -> LinePoint {
    let point = cell.at(u, v);
    let (a, b) = (super::cell::CORNERS[from], super::cell::CORNERS[to]);
    let length = cell.slope(u, v, [b[0] - a[0], b[1] - a[1]])[1];
    let hats = point.hats.map(|h| h * length.abs());
    LinePoint { zeta: point.position[1], hats, sense: length.signum() }
}

/// The points of a rule on a part of a cell, and their weights.
fn rule_points(cell: &Cell, part: &Part, rule: &[(f64, f64)]) -> Vec<(CellPoint, f64)> {
    let area = part.size[0] * part.size[1];
    rule.iter()
        .flat_map(|(x, wx)| {
            rule.iter().map(move |(y, wy)| {
                let [u, v] = part.at(*x, *y);
                (cell.at(u, v), wx * wy * area)
            })
        })
        .collect()
}

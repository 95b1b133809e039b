//! Integrals of the traction that the jumps of one surface produce on another.
//!
//! A jump acts as a sheet of double forces, whose stress loads the other surface. With n and n′ the
//! normals of the two,
//!
//!   A = −∬ w_i n_k σ_kl[moment of (w′_j, n′)] dS dS′.
//!
//! The hats do not touch, so that nothing is singular, but they may be close: patches of cells are
//! divided until Gauss product rules resolve 1/r³ at their distance.

use super::curls::{MomentPoint, Stress, add_strong};
use super::grid::{Block, CORNERS, Cell};
use super::patch::Patch;
use super::sheet::Sheet;
use crate::math::{Matrix, dot3, gauss_legendre};

/// Distance of two patches, relative to the diameter of the larger one, and the number of points
/// per direction that it requires; closer patches are divided.
const ORDERS: [(f64, usize); 5] = [(4.0, 2), (2.0, 3), (1.0, 4), (0.6, 5), (0.4, 6)];
/// Largest number of divisions of the patches of a pair of cells.
const DIVISIONS: usize = 24;

/// Fineness of the integration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fineness {
    /// Additional points per direction.
    pub more_points: usize,
    /// Factor by which distances of patches are reduced when a rule is chosen.
    pub nearer: f64,
}

/// Where a patch lies: a disc, or what a disc becomes on a surface that unrolls into a plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// x, lateral, depth, mm.
    pub centre: [f64; 3],
    pub radius: f64,
    /// The smallest and the largest distance of its corners from the mouth, mm.
    pub rows: [f64; 2],
}

impl Reach {
    fn of(sheet: &Sheet, cell: &Cell, patch: &Patch) -> Self {
        let cover = patch.cover(cell);
        let rows = CORNERS.map(|corner| {
            let [u, v] = patch.at(corner);
            cell.at(u, v).position[0]
        });
        let least = rows.into_iter().fold(f64::INFINITY, f64::min);
        let most = rows.into_iter().fold(least, f64::max);
        Self { centre: sheet.place(cover.centre), radius: cover.radius, rows: [least, most] }
    }

    /// A lower bound on the distance from another patch.
    pub fn gap(&self, other: &Self) -> f64 {
        let d: [f64; 3] = std::array::from_fn(|c| self.centre[c] - other.centre[c]);
        dot3(d, d).sqrt() - self.radius - other.radius
    }
}

/// The integrals between two surfaces.
pub(super) struct Tractions<'a> {
    sheets: [&'a Sheet; 2],
    poisson: f64,
    nearer: f64,
    rules: Vec<Vec<(f64, f64)>>,
}

impl<'a> Tractions<'a> {
    pub fn new(sheets: [&'a Sheet; 2], poisson: f64, fineness: Fineness) -> Self {
        let rule = |&(_, order): &(f64, usize)| gauss_legendre(order + fineness.more_points);
        Self { sheets, poisson, nearer: fineness.nearer, rules: ORDERS.iter().map(rule).collect() }
    }

    /// Adds the products of the hats of two cells, in units of the shear modulus; `gap` is a lower
    /// bound on the distance of two patches in the `stress`. Components are along the axes of the
    /// rail.
    pub fn add(
        &self,
        stress: Stress,
        cells: [&Cell; 2],
        gap: &dyn Fn(&Reach, &Reach) -> f64,
        block: &mut Block,
    ) {
        let pair = Pair { tractions: self, stress, cells, gap };
        pair.add([Patch::WHOLE; 2], 0, block);
    }
}

/// Two cells whose products are integrated.
struct Pair<'a, 'p> {
    tractions: &'p Tractions<'a>,
    stress: Stress,
    cells: [&'p Cell; 2],
    gap: &'p dyn Fn(&Reach, &Reach) -> f64,
}

impl Pair<'_, '_> {
    /// Divides patches until a rule suffices for their distance.
    fn add(&self, patches: [Patch; 2], level: usize, block: &mut Block) {
        let Tractions { sheets, poisson, nearer, rules } = self.tractions;
        let [one, other] = [0, 1].map(|k| Reach::of(sheets[k], self.cells[k], &patches[k]));
        let ratio = (self.gap)(&one, &other) / (2.0 * nearer * one.radius.max(other.radius));
        let place = ORDERS.iter().position(|&(limit, _)| ratio > limit);
        if place.is_some() || level == DIVISIONS {
            let rule = &rules[place.unwrap_or(ORDERS.len() - 1)];
            let [first, second] = [0, 1].map(|k| {
                let points = patches[k].points(self.cells[k], rule).into_iter();
                let point = |(x, weight): (super::grid::CellPoint, f64)| {
                    MomentPoint::new(&sheets[k].at(x.position), &x, weight, *poisson)
                };
                points.map(point).collect::<Vec<_>>()
            });
            first.iter().for_each(|x| add_strong(self.stress, x, &second, *poisson, block));
            return;
        }
        let larger = usize::from(one.radius < other.radius);
        let [p, q] = patches[larger].lengths(self.cells[larger]);
        for half in if p > q { patches[larger].along_halves() } else { patches[larger].across_halves() } {
            let mut halves = patches;
            halves[larger] = half;
            self.add(halves, level + 1, block);
        }
    }
}

/// From the axes of the rail to components at each point: rows along `one`, columns along `other`,
/// the directions of their points.
pub(super) fn turn(stiffness: &mut Matrix, one: &[[[f64; 3]; 3]], other: &[[[f64; 3]; 3]]) {
    for (a, rows) in one.iter().enumerate() {
        for (b, columns) in other.iter().enumerate() {
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

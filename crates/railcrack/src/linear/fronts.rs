//! The numbers of a sparse Cholesky factor, from the leaves of the elimination tree to its root: the multifrontal method (Duff and Reid 1983; Liu
//! 1992). The front of a supernode is the dense matrix of its columns and the rows below them; what its elimination leaves of it is added to
//! the front of its parent.

use super::cholesky::Tiles;
use super::dense::eliminate;
use super::lanes::ROWS;
use super::structure::{Structure, Supernode};
use super::{LinearError, SparseSymmetric};
use crate::math::axpy;
use rayon::prelude::*;
use std::collections::HashMap;

/// A branch of the tree that one thread eliminates has at most this share of all operations.
const BRANCH_SHARE: f64 = 1.0 / 24.0;

/// L in tiles, supernode by supernode.
///
/// Errors: a matrix that is not positive definite (the unknown is named); too many entries for their indices.
pub(super) fn eliminated(structure: &Structure, matrix: &SparseSymmetric) -> Result<Vec<Tiles>, LinearError> {
    let order = structure.order.len();
    let fronts = Fronts { structure, matrix: Sides::new(matrix)?, children: children(structure) };
    let not_definite =
        |place: usize| LinearError::NotPositiveDefinite { order, pivot: structure.order[place] };
    let (branches, trunk) = branches(structure);
    let mut results: Vec<(Eliminated, Remainders)> =
        branches.into_par_iter().map(|branch| fronts.branch(&branch, Remainders::new())).collect();
    if let Some(place) = results.iter().filter_map(|(result, _)| result.failed_at).min() {
        return Err(not_definite(place));
    }
    let left = results.iter_mut().flat_map(|(_, left)| left.drain()).collect();
    let (root, _) = fronts.branch(&trunk, left);
    if let Some(place) = root.failed_at {
        return Err(not_definite(place));
    }
    let mut tiles = vec![Tiles::new(); structure.supernodes.len()];
    for (s, own) in results.into_iter().flat_map(|(result, _)| result.tiles).chain(root.tiles) {
        tiles[s] = own;
    }
    Ok(tiles)
}

/// What some supernodes came to.
#[derive(Default)]
struct Eliminated {
    tiles: Vec<(usize, Tiles)>,
    /// The place that had no positive pivot.
    failed_at: Option<usize>,
}

/// Branches that are eliminated independently of each other, and the trunk that they grow from; supernodes in elimination order.
fn branches(structure: &Structure) -> (Vec<Vec<usize>>, Vec<usize>) {
    let count = structure.supernodes.len();
    let mut work: Vec<f64> = structure
        .supernodes
        .iter()
        .map(|node| node.columns as f64 * ((node.columns + node.below) as f64).powi(2))
        .collect();
    let total: f64 = work.iter().sum();
    for s in 0..count {
        if let Some(parent) = structure.parent(s) {
            work[parent] += work[s];
        }
    }
    let mut branches: Vec<Vec<usize>> = Vec::new();
    let mut trunk = Vec::new();
    let mut branch_of: Vec<Option<usize>> = vec![None; count];
    for s in (0..count).rev() {
        if work[s] > BRANCH_SHARE * total {
            trunk.push(s);
            continue;
        }
        let of_parent = structure.parent(s).and_then(|parent| branch_of[parent]);
        let branch = of_parent.unwrap_or_else(|| {
            branches.push(Vec::new());
            branches.len() - 1
        });
        branch_of[s] = Some(branch);
        branches[branch].push(s);
    }
    branches.iter_mut().chain([&mut trunk]).for_each(|list| list.reverse());
    (branches, trunk)
}

/// The children of every supernode, in elimination order.
fn children(structure: &Structure) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); structure.supernodes.len()];
    for s in 0..structure.supernodes.len() {
        if let Some(parent) = structure.parent(s) {
            children[parent].push(s);
        }
    }
    children
}

/// A symmetric matrix with both halves of each row at hand.
struct Sides<'a> {
    matrix: &'a SparseSymmetric,
    /// Where each row has its entries left of the diagonal; one more at the end.
    starts: Vec<u32>,
    /// Column, and place among the values of the matrix.
    left: Vec<(u32, u32)>,
}

impl<'a> Sides<'a> {
    fn new(matrix: &'a SparseSymmetric) -> Result<Self, LinearError> {
        let pattern = matrix.pattern();
        let order = pattern.order();
        if u32::try_from(pattern.entries().max(order)).is_err() {
            return Err(LinearError::TooLarge { order });
        }
        let mut starts = vec![0u32; order + 1];
        for j in 0..order {
            pattern.rows()[pattern.starts()[j] + 1..pattern.starts()[j + 1]]
                .iter()
                .for_each(|&row| starts[row + 1] += 1);
        }
        for row in 0..order {
            starts[row + 1] += starts[row];
        }
        let mut left = vec![(0, 0); starts[order] as usize];
        let mut next = starts.clone();
        for j in 0..order {
            for at in pattern.starts()[j] + 1..pattern.starts()[j + 1] {
                let row = pattern.rows()[at];
                left[next[row] as usize] = (j as u32, at as u32);
                next[row] += 1;
            }
        }
        Ok(Self { matrix, starts, left })
    }

    /// All entries of the row of an unknown: (other unknown, value).
    fn row(&self, unknown: usize) -> impl Iterator<Item = (usize, f64)> {
        let (pattern, values) = (self.matrix.pattern(), self.matrix.values());
        let right = pattern.starts()[unknown]..pattern.starts()[unknown + 1];
        let left = &self.left[self.starts[unknown] as usize..self.starts[unknown + 1] as usize];
        let right = right.map(move |at| (pattern.rows()[at], values[at]));
        right.chain(left.iter().map(move |&(column, at)| (column as usize, values[at as usize])))
    }
}

/// What is left of the fronts of some supernodes, where their parents wait for it: the lower triangle, column by column.
type Remainders = HashMap<usize, Vec<f64>>;

struct Fronts<'a> {
    structure: &'a Structure,
    matrix: Sides<'a>,
    children: Vec<Vec<usize>>,
}

impl Fronts<'_> {
    /// Eliminates `supernodes`, given what those before have left, by supernode; with what all of these have left for others.
    fn branch(&self, supernodes: &[usize], mut left: Remainders) -> (Eliminated, Remainders) {
        let mut result = Eliminated::default();
        let mut front = Vec::new();
        for &s in supernodes {
            let node = self.structure.supernodes[s];
            let size = node.columns + node.below;
            self.assemble(s, &mut left, &mut front);
            if let Err(pivot) = eliminate(&mut front, size, node.columns) {
                result.failed_at = Some(node.start + pivot);
                break;
            }
            result.tiles.push((s, tiles(&node, &front)));
            left.insert(s, remainder(&front, size, node.columns));
        }
        (result, left)
    }

    /// The front of a supernode: row j holds column j from the diagonal on.
    fn assemble(&self, s: usize, left: &mut Remainders, front: &mut Vec<f64>) {
        let node = &self.structure.supernodes[s];
        let below = self.structure.rows_below(node);
        let size = node.columns + node.below;
        front.clear();
        front.resize(size * size, 0.0);
        for (j, column) in front.chunks_exact_mut(size).take(node.columns).enumerate() {
            for (other, value) in self.matrix.row(self.structure.order[node.start + j]) {
                let place = self.structure.place[other];
                if place < node.start + j {
                    continue;
                }
                column[place_in(node, below, place)] += value;
            }
        }
        for child in &self.children[s] {
            let Some(remainder) = left.remove(child) else { continue };
            let rows = self.structure.rows_below(&self.structure.supernodes[*child]);
            let at: Vec<usize> = rows.iter().map(|&row| place_in(node, below, row)).collect();
            let mut values = remainder.as_slice();
            for (j, &column) in at.iter().enumerate() {
                let (own, others) = values.split_at(at.len() - j);
                values = others;
                add_at(&at[j..], own, &mut front[column * size..][..size]);
            }
        }
    }
}

/// Adds values to a column, at increasing places.
fn add_at(at: &[usize], values: &[f64], column: &mut [f64]) {
    match at {
        // Side by side, as most are.
        &[first, .., last] if last - first == at.len() - 1 => axpy(1.0, values, &mut column[first..=last]),
        _ => at.iter().zip(values).for_each(|(&i, value)| column[i] += value),
    }
}

/// Where a row, a place in the elimination order, stands in the front of a supernode with the rows `below` it.
fn place_in(node: &Supernode, below: &[usize], row: usize) -> usize {
    if row < node.start + node.columns {
        row - node.start
    } else {
        node.columns + below.partition_point(|&other| other < row)
    }
}

/// What a front is after the elimination of its first columns.
fn remainder(front: &[f64], size: usize, columns: usize) -> Vec<f64> {
    let below = size - columns;
    let mut remainder = Vec::with_capacity(below * (below + 1) / 2);
    (columns..size).for_each(|j| remainder.extend_from_slice(&front[j * size + j..(j + 1) * size]));
    remainder
}

/// The columns of a supernode from its front.
fn tiles(node: &Supernode, front: &[f64]) -> Tiles {
    let size = node.columns + node.below;
    let blocks_below = node.below.div_ceil(ROWS);
    let mut tiles = Tiles::with_capacity(node.triangle(node.blocks()) + blocks_below * node.columns);
    for first in (0..node.columns).step_by(ROWS) {
        tiles.extend((0..first + ROWS).map(|j| {
            std::array::from_fn(|r| match first + r {
                i if i >= node.columns || j > i => 0.0,
                i if i == j => 1.0 / front[i * size + i],
                i => front[j * size + i],
            })
        }));
    }
    for first in (node.columns..size).step_by(ROWS) {
        let columns = front.chunks_exact(size).take(node.columns).map(|column| &column[first..]);
        tiles.extend(columns.map(|column| std::array::from_fn(|r| column.get(r).copied().unwrap_or(0.0))));
    }
    tiles
}

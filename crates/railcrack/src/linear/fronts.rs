//! Multifrontal factorisation, from the leaves of the elimination tree to its root (Duff and Reid
//! 1983; Liu 1992). The front of a supernode is the dense matrix of its columns and the rows below
//! them; the Schur complement that its elimination leaves is added to the front of its parent.

use super::dense::eliminate;
use super::elements::{Structure, Supernode};
use super::lanes::{ROWS, Tile};
use super::{ElementSum, LinearError};
use crate::interruption::Interruption;
use crate::math::axpy;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Largest share of all operations in one branch of the tree, which one thread eliminates.
const BRANCH_SHARE: f64 = 1.0 / 24.0;

/// L in tiles, supernode by supernode.
///
/// Errors: a different number of unknowns; an element that does not fit its unknowns or the
/// structure; a matrix that is not positive definite (the error gives the unknown); an
/// interruption.
pub(super) fn eliminated(
    structure: &Structure,
    matrix: &impl ElementSum,
    interruption: Interruption<'_>,
) -> Result<Vec<Tile>, LinearError> {
    let elements = ElementsBySupernode::new(structure, matrix)?;
    let fronts = Fronts { structure, matrix, elements, children: children(structure), interruption };
    let mut tiles = vec![[0.0; ROWS]; structure.supernodes.iter().map(Supernode::tiles).sum()];
    let (branches, trunk) = branches(structure);
    let mut places = TileStorage::new(structure, &mut tiles);
    let branches: Vec<Vec<SupernodeTiles>> = branches.iter().map(|branch| places.take(branch)).collect();
    let results: Vec<(Option<Failure>, Remainders)> =
        branches.into_par_iter().map(|branch| fronts.branch(branch, Remainders::new())).collect();
    let (failures, left): (Vec<Option<Failure>>, Vec<Remainders>) = results.into_iter().unzip();
    if let Some(failure) = failures.into_iter().flatten().min_by_key(|failure| failure.place) {
        return Err(failure.reason);
    }
    let left = left.into_iter().flatten().collect();
    match fronts.branch(places.take(&trunk), left) {
        (Some(failure), _) => Err(failure.reason),
        (None, _) => Ok(tiles),
    }
}

/// A supernode, and its tiles.
type SupernodeTiles<'a> = (usize, &'a mut [Tile]);

/// The tiles that have not been handed out yet.
struct TileStorage<'a>(Vec<Option<&'a mut [Tile]>>);

impl<'a> TileStorage<'a> {
    fn new(structure: &Structure, mut tiles: &'a mut [Tile]) -> Self {
        let place = |node: &Supernode| {
            let (own, rest) = std::mem::take(&mut tiles).split_at_mut(node.tiles());
            tiles = rest;
            Some(own)
        };
        Self(structure.supernodes.iter().map(place).collect())
    }

    /// The tiles of `supernodes`; each supernode is handed out once.
    fn take(&mut self, supernodes: &[usize]) -> Vec<SupernodeTiles<'a>> {
        supernodes.iter().map(|&s| (s, self.0[s].take().unwrap_or_default())).collect()
    }
}

/// The reason for the end of the elimination, and the place in the elimination order.
struct Failure {
    place: usize,
    reason: LinearError,
}

/// Branches that are eliminated independently of each other, and the trunk on which they grow;
/// supernodes in elimination order.
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

/// The elements that begin in the front of each supernode: where the first of their unknowns is
/// eliminated.
struct ElementsBySupernode {
    /// Supernode s has its elements at `starts[s]..starts[s + 1]`.
    starts: Vec<usize>,
    /// In increasing order.
    elements: Vec<usize>,
}

impl ElementsBySupernode {
    fn new(structure: &Structure, matrix: &impl ElementSum) -> Result<Self, LinearError> {
        let order = structure.unknowns();
        if matrix.order() != order {
            let quantity = "unknowns of a matrix to factor";
            return Err(LinearError::WrongLength { quantity, given: matrix.order(), expected: order });
        }
        let first = |element: usize| -> Result<Option<usize>, LinearError> {
            let unknowns = matrix.unknowns(element).into_iter().flatten();
            let places: Vec<usize> =
                unknowns.map(|unknown| structure.place_of(unknown)).collect::<Result<_, _>>()?;
            Ok(places.into_iter().min().map(|place| structure.supernode_at(place)))
        };
        let owners: Vec<Option<usize>> = (0..matrix.count()).map(first).collect::<Result<_, _>>()?;
        let mut starts = vec![0; structure.supernodes.len() + 1];
        owners.iter().flatten().for_each(|&s| starts[s + 1] += 1);
        for s in 0..structure.supernodes.len() {
            starts[s + 1] += starts[s];
        }
        let mut elements = vec![0; starts[structure.supernodes.len()]];
        let mut next = starts.clone();
        for (element, owner) in owners.iter().enumerate() {
            if let Some(s) = *owner {
                elements[next[s]] = element;
                next[s] += 1;
            }
        }
        Ok(Self { starts, elements })
    }

    fn of(&self, s: usize) -> &[usize] {
        &self.elements[self.starts[s]..self.starts[s + 1]]
    }
}

/// Schur complements of the fronts of some supernodes that their parents have not yet assembled:
/// the lower triangle, column by column.
type Remainders = HashMap<usize, Vec<f64>>;

struct Fronts<'a, M> {
    structure: &'a Structure,
    matrix: &'a M,
    elements: ElementsBySupernode,
    children: Vec<Vec<usize>>,
    interruption: Interruption<'a>,
}

impl<M: ElementSum> Fronts<'_, M> {
    /// Eliminates supernodes, given the Schur complements of previous supernodes; returns those
    /// that remain for later supernodes.
    fn branch(&self, places: Vec<SupernodeTiles>, mut left: Remainders) -> (Option<Failure>, Remainders) {
        let mut front = Vec::new();
        for (s, place) in places {
            let node = self.structure.supernodes[s];
            if let Err(failure) = self.eliminate(s, &mut left, &mut front) {
                return (Some(failure), left);
            }
            write_tiles(&node, &front, place);
            left.insert(s, remainder(&front, node.size(), node.columns));
        }
        (None, left)
    }

    /// The front of a supernode, its columns eliminated: row j holds column j from the diagonal on.
    fn eliminate(&self, s: usize, left: &mut Remainders, front: &mut Vec<f64>) -> Result<(), Failure> {
        let node = &self.structure.supernodes[s];
        front.clear();
        front.resize(node.size() * node.size(), 0.0);
        self.add_elements(s, front).map_err(|reason| Failure { place: node.start, reason })?;
        self.add_remainders(s, left, front);
        eliminate(front, node.size(), node.columns, self.interruption).map_err(|end| {
            let unknown = |pivot| self.structure.unknown_at(node.start + pivot);
            Failure { place: node.start, reason: end.of(self.structure.unknowns(), unknown) }
        })
    }

    /// Adds the elements that begin with a supernode to its front.
    fn add_elements(&self, s: usize, front: &mut [f64]) -> Result<(), LinearError> {
        let node = &self.structure.supernodes[s];
        let size = node.size();
        for &element in self.elements.of(s) {
            let (unknowns, matrix) = (self.matrix.unknowns(element), self.matrix.matrix(element));
            let expected = unknowns.len();
            if matrix.rows() != expected || matrix.columns() != expected {
                let (quantity, given) = ("rows of the matrix of an element", matrix.rows());
                return Err(LinearError::WrongLength { quantity, given, expected });
            }
            let at: Vec<Option<usize>> = unknowns
                .iter()
                .map(|unknown| unknown.map(|unknown| self.place_of(node, unknown)).transpose())
                .collect::<Result<_, _>>()?;
            for (i, row) in at.iter().enumerate() {
                let Some(row) = *row else { continue };
                for (column, value) in at[..=i].iter().zip(matrix.row(i)) {
                    let Some(column) = *column else { continue };
                    front[row.min(column) * size + row.max(column)] += value;
                }
            }
        }
        Ok(())
    }

    /// The position of an unknown in the front of a supernode.
    fn place_of(&self, node: &Supernode, unknown: usize) -> Result<usize, LinearError> {
        let below = self.structure.rows_below(node);
        let place = self.structure.place_of(unknown)?;
        let at = place_in(node, below, place);
        let there = at < node.columns || below.get(at - node.columns) == Some(&(place as u32));
        let outside =
            LinearError::OutsidePattern { row: unknown, column: self.structure.unknown_at(node.start) };
        if there { Ok(at) } else { Err(outside) }
    }

    /// Adds the Schur complements of the children of a supernode to its front.
    fn add_remainders(&self, s: usize, left: &mut Remainders, front: &mut [f64]) {
        let node = &self.structure.supernodes[s];
        let below = self.structure.rows_below(node);
        let size = node.size();
        for child in &self.children[s] {
            let Some(remainder) = left.remove(child) else { continue };
            let rows = self.structure.rows_below(&self.structure.supernodes[*child]);
            let at: Vec<usize> = rows.iter().map(|&row| place_in(node, below, row as usize)).collect();
            let mut values = remainder.as_slice();
            for (j, &column) in at.iter().enumerate() {
                let (own, others) = values.split_at(at.len() - j);
                values = others;
                add_at(&at[j..], own, &mut front[column * size..][..size]);
            }
        }
    }
}

/// Adds values to a column at increasing row positions.
fn add_at(at: &[usize], values: &[f64], column: &mut [f64]) {
    match at {
        // Most of them are contiguous.
        &[first, .., last] if last - first == at.len() - 1 => axpy(1.0, values, &mut column[first..=last]),
        _ => at.iter().zip(values).for_each(|(&i, value)| column[i] += value),
    }
}

/// The position of a row, given by its place in the elimination order, in the front of a supernode
/// with the rows `below` it.
fn place_in(node: &Supernode, below: &[u32], row: usize) -> usize {
    if row < node.start + node.columns {
        row - node.start
    } else {
        node.columns + below.partition_point(|&other| (other as usize) < row)
    }
}

/// The Schur complement in a front after the elimination of its first columns.
fn remainder(front: &[f64], size: usize, columns: usize) -> Vec<f64> {
    let below = size - columns;
    let mut remainder = Vec::with_capacity(below * (below + 1) / 2);
    (columns..size).for_each(|j| remainder.extend_from_slice(&front[j * size + j..(j + 1) * size]));
    remainder
}

/// Writes the columns of a supernode from its front.
fn write_tiles(node: &Supernode, front: &[f64], tiles: &mut [Tile]) {
    let size = node.size();
    let (triangle, below) = tiles.split_at_mut(node.triangle(node.blocks()));
    for (b, first) in (0..node.columns).step_by(ROWS).enumerate() {
        for (j, tile) in triangle[node.triangle(b)..node.triangle(b + 1)].iter_mut().enumerate() {
            *tile = std::array::from_fn(|r| match first + r {
                i if i >= node.columns || j > i => 0.0,
                i if i == j => 1.0 / front[i * size + i],
                i => front[j * size + i],
            });
        }
    }
    for (block, first) in below.chunks_exact_mut(node.columns).zip((node.columns..size).step_by(ROWS)) {
        for (tile, column) in block.iter_mut().zip(front.chunks_exact(size)) {
            *tile = std::array::from_fn(|r| column.get(first + r).copied().unwrap_or(0.0));
        }
    }
}

/// The structure of the factor P K Pᵀ = L Lᵀ of all matrices whose elements couple the same
/// unknowns, with the unknowns in a given order.
#[derive(Debug)]
pub struct SparseCholesky {
    structure: Arc<Structure>,
}

impl SparseCholesky {
    /// Analyses `matrix` for the elimination order `order`, which contains every unknown once. The
    /// order decides the size of the factor ([`crate::mesh::QuadMesh::nested_dissection`]).
    ///
    /// Errors: an order that is not a permutation of the unknowns; an element with an unknown out
    /// of range.
    pub fn analyse(matrix: &impl ElementSum, order: Vec<usize>) -> Result<Self, LinearError> {
        Self::analyse_unless(Interruption::NEVER, matrix, order)
    }

    /// [`SparseCholesky::analyse`] that stops on an `interruption`.
    pub(crate) fn analyse_unless(
        interruption: Interruption<'_>,
        matrix: &impl ElementSum,
        order: Vec<usize>,
    ) -> Result<Self, LinearError> {
        Ok(Self { structure: Arc::new(Structure::new(matrix, order, interruption)?) })
    }

    /// Factors `matrix`, whose elements must couple only unknowns that are coupled in the analysed
    /// matrix. The factorisation proceeds front by front, with branches of the elimination tree in
    /// parallel, and near its root the blocks of a front in parallel. The bits do not depend on the
    /// number of threads.
    ///
    /// Errors: a different number of unknowns, or entries outside the structure; an element whose
    /// matrix does not fit its unknowns; a matrix that is not positive definite (the error gives
    /// the unknown).
    pub fn factor(&self, matrix: &impl ElementSum) -> Result<SparseFactor, LinearError> {
        self.factor_unless(Interruption::NEVER, matrix)
    }

    /// [`SparseCholesky::factor`] that stops on an `interruption`.
    pub(crate) fn factor_unless(
        &self,
        interruption: Interruption<'_>,
        matrix: &impl ElementSum,
    ) -> Result<SparseFactor, LinearError> {
        let tiles = eliminated(&self.structure, matrix, interruption)?;
        Ok(SparseFactor { structure: Arc::clone(&self.structure), tiles })
    }
}

/// A Cholesky factor P K Pᵀ = L Lᵀ. Columns of L with the same rows below them form supernodes,
/// which are dense blocks.
#[derive(Debug, Clone)]
pub struct SparseFactor {
    pub(super) structure: Arc<Structure>,
    /// L in tiles, supernode by supernode.
    tiles: Vec<Tile>,
}

impl SparseFactor {
    /// The tiles of a supernode.
    pub(super) fn tiles(&self, s: usize) -> &[Tile] {
        let node = &self.structure.supernodes[s];
        &self.tiles[node.first_tile..][..node.tiles()]
    }

    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.structure.unknowns()
    }

    /// Entries of L, including the zeros that make supernodes dense.
    pub fn entries(&self) -> usize {
        self.structure.supernodes.iter().map(|s| s.entries()).sum()
    }

    /// Memory in bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.tiles) + self.structure.memory_bytes()
    }
}

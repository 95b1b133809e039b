//! Scalar products of reached columns: Schur complements.

use super::lanes::{LANES, ROWS, Row, add_tile};
use super::reach::ReachedColumn;
use crate::math::Matrix;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// Rows of the matrix of scalar products that are computed together: enough to fetch the packed panels seldom, few enough to keep
/// all threads busy.
const STRIP: usize = 24 * ROWS;

impl ReachedColumn {
    /// W_aᵀ W_b = b_aᵀ K⁻¹ b_b: over the supernodes that both reach, one after the other, each summed in the order of its rows. The
    /// same bits as in [`gram`].
    pub fn dot(&self, other: &Self) -> f64 {
        Arch::new().dispatch(Dot { a: self, b: other })
    }
}

struct Dot<'a> {
    a: &'a ReachedColumn,
    b: &'a ReachedColumn,
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let mut others = self.b.parts().peekable();
        let mut total = 0.0;
        for (s, a) in self.a.parts() {
            while others.next_if(|(t, _)| *t < s).is_some() {}
            let Some((_, b)) = others.next_if(|(t, _)| *t == s) else { continue };
            total += a.iter().zip(b).fold(0.0, |sum, (x, y)| f64::mul_add(*x, *y, sum));
        }
        total
    }
}

/// All scalar products W_iᵀ W_j of the columns `a` (rows i) with the columns `b` (columns j): a.len() × b.len(). Each is the same
/// bits in any company, in any order and on any number of threads: those of [`ReachedColumn::dot`].
pub fn gram(a: &[&ReachedColumn], b: &[&ReachedColumn]) -> Matrix {
    products(a, b, |_| 0)
}

/// All scalar products of columns with each other, [`gram`] of `columns` with themselves in half the time: symmetric.
pub fn gram_of(columns: &[&ReachedColumn]) -> Matrix {
    let half = products(columns, columns, |row| row);
    Matrix::from_fn(columns.len(), columns.len(), |i, j| half[(i.min(j), i.max(j))])
}

/// The products of row i with the columns from `first(i)` on; others may be missing.
fn products(a: &[&ReachedColumn], b: &[&ReachedColumn], first: impl Fn(usize) -> usize + Sync) -> Matrix {
    let packed = Packed::new(b);
    let strips: Vec<Vec<f64>> = (0..a.len().div_ceil(STRIP))
        .into_par_iter()
        .map(|strip| {
            let from = strip * STRIP;
            let rows = &a[from..(from + STRIP).min(a.len())];
            let mut products = vec![0.0; rows.len() * b.len()];
            let strip = Strip { rows, packed: &packed, first: first(from), products: &mut products };
            Arch::new().dispatch(strip);
            products
        })
        .collect();
    Matrix::from_fn(a.len(), b.len(), |i, j| strips[i / STRIP][(i % STRIP) * b.len() + j])
}

/// Columns side by side, supernode by supernode.
struct Packed {
    columns: usize,
    /// The panels of each supernode that is reached, at its number.
    panels: Vec<Vec<PackedPanel>>,
}

struct PackedPanel {
    /// The columns in the lanes, increasing.
    columns: Vec<usize>,
    rows: Vec<Row>,
}

/// Supernodes that one thread packs at a time.
const PACKED: u32 = 64;

impl Packed {
    fn new(columns: &[&ReachedColumn]) -> Self {
        let supernodes = columns.iter().filter_map(|column| column.last()).max().map_or(0, |last| last + 1);
        let panels: Vec<Vec<Vec<PackedPanel>>> = (0..supernodes.div_ceil(PACKED))
            .into_par_iter()
            .map(|k| panels_of(columns, k * PACKED..((k + 1) * PACKED).min(supernodes)))
            .collect();
        Self { columns: columns.len(), panels: panels.into_iter().flatten().collect() }
    }
}

/// The panels of each of some supernodes.
fn panels_of(columns: &[&ReachedColumn], supernodes: Range<u32>) -> Vec<Vec<PackedPanel>> {
    let mut panels: Vec<Vec<PackedPanel>> = supernodes.clone().map(|_| Vec::new()).collect();
    for (j, column) in columns.iter().enumerate() {
        for (s, values) in column.parts_on(supernodes.clone()) {
            let panels = &mut panels[s - supernodes.start as usize];
            if panels.last().is_none_or(|panel| panel.columns.len() == LANES) {
                panels.push(PackedPanel { columns: Vec::new(), rows: vec![Row::ZERO; values.len()] });
            }
            let Some(panel) = panels.last_mut() else { continue };
            let lane = panel.columns.len();
            panel.columns.push(j);
            panel.rows.iter_mut().zip(values).for_each(|(row, value)| row.0[lane] = *value);
        }
    }
    panels
}

struct Strip<'a> {
    rows: &'a [&'a ReachedColumn],
    packed: &'a Packed,
    /// Panels without a column from here on are left out.
    first: usize,
    products: &'a mut [f64],
}

impl WithSimd for Strip<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut parts: Vec<_> = self.rows.iter().map(|column| column.parts().peekable()).collect();
        let mut tile: Vec<[f64; ROWS]> = Vec::new();
        for (s, panels) in self.packed.panels.iter().enumerate() {
            // The rows of the strip that reach this supernode.
            let mut reached = Vec::with_capacity(STRIP);
            for (i, parts) in parts.iter_mut().enumerate() {
                while parts.next_if(|(t, _)| *t < s).is_some() {}
                if let Some((_, values)) = parts.next_if(|(t, _)| *t == s) {
                    reached.push((i, values));
                }
            }
            if panels.is_empty() {
                continue;
            }
            for rows in reached.chunks(ROWS) {
                let length = rows[0].1.len();
                tile.clear();
                tile.resize(length, [0.0; ROWS]);
                for (r, (_, values)) in rows.iter().enumerate() {
                    tile.iter_mut().zip(*values).for_each(|(entry, value)| entry[r] = *value);
                }
                for panel in panels {
                    if panel.columns.last().is_none_or(|&last| last < self.first) {
                        continue;
                    }
                    let mut sums = [Row::ZERO; ROWS];
                    add_tile(simd, &tile, &panel.rows, &mut sums);
                    for ((i, _), sum) in rows.iter().zip(&sums) {
                        let products = &mut self.products[i * self.packed.columns..][..self.packed.columns];
                        if let &[first, .., last] = panel.columns.as_slice()
                            && last - first == LANES - 1
                            && panel.columns.len() == LANES
                        {
                            // Side by side, as most are.
                            products[first..][..LANES].iter_mut().zip(&sum.0).for_each(|(p, v)| *p += v);
                            continue;
                        }
                        for (&j, value) in panel.columns.iter().zip(&sum.0) {
                            products[j] += value;
                        }
                    }
                }
            }
        }
    }
}

//! Gram matrices of half-solved columns.

use super::lanes::{LANES, LaneRow, add_outer};
use super::reach::ReachedPanel;
use crate::interruption::{Interrupted, Interruption};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::sync::Arc;

/// Number of panels whose products with all others one thread computes together: large enough to
/// load the other panels seldom, small enough to keep all threads busy.
const STRIP: usize = 3;
/// Number of panel rows that are multiplied at once; those of two panels fit into the first-level
/// cache.
const DEPTH: usize = 96;

/// The products of the columns of one panel with those of another: row r holds those of its column
/// r.
type PanelProduct = [LaneRow; LANES];

/// W_iᵀ W_j = b_iᵀ K⁻¹ b_j of every column i of the panels from `first` on with all columns j up to
/// itself, row by row. The bits of each product are independent of the other products and of the
/// number of threads.
///
/// Errors: an interruption.
pub fn gram(
    panels: &[Arc<ReachedPanel>],
    first: usize,
    interruption: Interruption<'_>,
) -> Result<Vec<Vec<f64>>, Interrupted> {
    let numbers: Vec<usize> = (first..panels.len()).collect();
    let strips = numbers.par_chunks(STRIP).map(|strip| {
        interruption.check()?;
        let mut blocks: Vec<Vec<PanelProduct>> =
            strip.iter().map(|&i| vec![[LaneRow::ZERO; LANES]; i + 1]).collect();
        Arch::new().dispatch(Strip { panels, first: strip[0], blocks: &mut blocks });
        Ok(strip.iter().zip(&blocks).flat_map(|(&i, blocks)| rows(panels, i, blocks)).collect::<Vec<_>>())
    });
    let strips: Result<Vec<Vec<Vec<f64>>>, Interrupted> = strips.collect();
    Ok(strips?.into_iter().flatten().collect())
}

/// The rows of panel `i` from its blocks.
fn rows(panels: &[Arc<ReachedPanel>], i: usize, blocks: &[PanelProduct]) -> Vec<Vec<f64>> {
    let row = |r: usize| {
        let mut row = Vec::new();
        for (panel, block) in panels[..i].iter().zip(blocks) {
            row.extend_from_slice(&block[r].0[..panel.columns()]);
        }
        row.extend_from_slice(&blocks[i][r].0[..=r]);
        row
    };
    (0..panels[i].columns()).map(row).collect()
}

/// Some panels, and the products of each with all panels up to itself.
struct Strip<'a> {
    panels: &'a [Arc<ReachedPanel>],
    first: usize,
    blocks: &'a mut [Vec<PanelProduct>],
}

impl WithSimd for Strip<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let own = &self.panels[self.first..self.first + self.blocks.len()];
        let mut supernodes: Vec<u32> = own.iter().flat_map(|panel| panel.supernodes()).copied().collect();
        supernodes.sort_unstable();
        supernodes.dedup();
        for s in supernodes {
            let others: Vec<&[LaneRow]> =
                self.panels[..self.first + own.len()].iter().map(|panel| panel.rows_of(s)).collect();
            let height = others.iter().map(|rows| rows.len()).max().unwrap_or(0);
            for from in (0..height).step_by(DEPTH) {
                let part = from..(from + DEPTH).min(height);
                for (i, blocks) in (self.first..).zip(&mut *self.blocks) {
                    let Some(own) = others[i].get(part.clone()) else { continue };
                    for (block, other) in blocks.iter_mut().zip(&others) {
                        if let Some(other) = other.get(part.clone()) {
                            add_outer(simd, own, other, block);
                        }
                    }
                }
            }
        }
    }
}

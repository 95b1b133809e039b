//! The stress of a wheel's patches by depth, spread along the front and place of the wheel: a table
//! that is filled where cracks ask for it, and that all cracks under the wheel share.
//!
//! The stress at a depth z, spread over the reach ρ with (1 + β q) e^(−q), is F + β G with F and G
//! of z, ρ and the place of the wheel. Both vary over a share of z and of ρ, down to a share of the
//! patch: places of the table are even in asinh(z/s) and asinh(ρ/s), and a stress is interpolated
//! between six in each direction, which is within 4e-3 of the largest one next to the surface, and
//! within 5e-4 deeper than a quarter of the patch.

use super::patch_directions::{PatchDirections, Spread};
use crate::math::Stress;
use std::sync::OnceLock;

/// s over the smallest semi-axis of the patches.
const SCALE: f64 = 0.1;
/// Distance of places, as a difference of asinh.
const STEP: f64 = 0.35;
/// Places of depth, and of reach: up to 400 times the smallest semi-axis.
const PLACES: usize = 26;
/// Places between which a stress is interpolated.
const POINTS: usize = 6;

/// F and G at the places of the wheel.
type Column = Box<[[Stress; 2]]>;

/// The table of one wheel.
#[derive(Debug)]
pub(super) struct PatchTable {
    scale: f64,
    /// x (mm) from the wheel's centre of the points of each column.
    along: Vec<f64>,
    /// `[depth][reach]`
    columns: Vec<OnceLock<Column>>,
}

impl PatchTable {
    /// An empty table for patches of which the smallest semi-axis is `smallest` (mm), at points
    /// `along` (mm from the wheel's centre) the rail.
    pub fn new(smallest: f64, along: Vec<f64>) -> Self {
        let columns = std::iter::repeat_with(OnceLock::new).take(PLACES * PLACES).collect();
        Self { scale: SCALE * smallest, along, columns }
    }

    /// The stress (MPa) of `patches` at `depth` (mm), averaged along the front with `spread`, at
    /// each place along the rail. None too deep for the table.
    pub fn stresses(&self, patches: &[PatchDirections], depth: f64, spread: Spread) -> Option<Vec<Stress>> {
        let (first_depth, by_depth) = self.between(depth)?;
        let (first_reach, by_reach) = self.between(spread.reach)?;
        let mut sum = vec![Stress::ZERO; self.along.len()];
        for (i, of_depth) in by_depth.iter().enumerate() {
            for (j, of_reach) in by_reach.iter().enumerate() {
                let weight = spread.share * of_depth * of_reach;
                if weight == 0.0 {
                    continue;
                }
                let column = self.column(patches, first_depth + i, first_reach + j);
                for (sum, [even, odd]) in sum.iter_mut().zip(column) {
                    *sum = *sum + (*even + *odd * spread.beta) * weight;
                }
            }
        }
        Some(sum)
    }

    fn column(&self, patches: &[PatchDirections], depth: usize, reach: usize) -> &[[Stress; 2]] {
        let place = |index: usize| self.scale * (STEP * index as f64).sinh();
        self.columns[depth * PLACES + reach].get_or_init(|| {
            let at = |x: &f64| {
                patches.iter().fold([Stress::ZERO; 2], |sum, patch| {
                    let own = patch.parts(*x, place(depth), place(reach));
                    [sum[0] + own[0], sum[1] + own[1]]
                })
            };
            self.along.iter().map(at).collect()
        })
    }

    /// The first of the places between which `length` (mm) lies, and their weights; none beyond the
    /// last.
    fn between(&self, length: f64) -> Option<(usize, [f64; POINTS])> {
        let place = (length / self.scale).asinh() / STEP;
        let first = (place.floor() as usize + 1).saturating_sub(POINTS / 2);
        (first + POINTS <= PLACES).then(|| (first, weights(place - first as f64)))
    }
}

/// Weights of the values at 0, 1, … in the curve of the lowest degree through all of them.
fn weights(x: f64) -> [f64; POINTS] {
    std::array::from_fn(|i| {
        let others = (0..POINTS).filter(|j| *j != i);
        others.map(|j| (x - j as f64) / (i as f64 - j as f64)).product()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::PatchLoad;
    use crate::load::HertzEllipse;

    #[test]
    fn between_its_places_it_is_the_stress_of_the_patch() {
        let ellipse = HertzEllipse { peak_pressure: 1000.0, along: 6.0, across: 4.0 };
        let load = PatchLoad::sliding(&ellipse, [0.0, 1.0], [0.3, 0.1]);
        let patches = [PatchDirections::new(&load, 0.3, 1)];
        let along: Vec<f64> = (-40..=40).map(|i| 0.37 * f64::from(i)).collect();
        let table = PatchTable::new(4.0, along.clone());
        for (depth, reach) in [
            (0.0, 0.8),
            (0.05, 0.3),
            (0.3, 0.9),
            (0.7, 0.02),
            (1.9, 2.3),
            (4.4, 0.0),
            (11.0, 7.0),
            (35.0, 60.0),
        ] {
            let spread = Spread { share: 0.9, reach, beta: 1.2 };
            let exact: Vec<Stress> = along.iter().map(|x| patches[0].stress(*x, depth, spread)).collect();
            let found = table.stresses(&patches, depth, spread).unwrap();
            let parts = |stress: &Stress| [stress.xx, stress.yy, stress.xy];
            let largest = exact.iter().flat_map(parts).fold(0.0, |most: f64, own| most.max(own.abs()));
            let off = found.iter().zip(&exact).flat_map(|(found, exact)| {
                let (found, exact) = (parts(found), parts(exact));
                [0, 1, 2].map(|i| (found[i] - exact[i]).abs())
            });
            let off = off.fold(0.0, f64::max) / largest;
            let accepted = if depth > 1.0 { 5e-4 } else { 4e-3 };
            assert!(off < accepted, "{depth} mm deep, spread over {reach} mm: {off}");
        }
        let deep = Spread { share: 1.0, reach: 1.0, beta: 0.0 };
        assert!(table.stresses(&patches, 5000.0, deep).is_none());
    }
}

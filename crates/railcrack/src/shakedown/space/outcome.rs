//! The state that passages in space have left.

use super::super::stabilise::alternating_streamlines;
use super::super::state::{Admissibility, RailState};
use super::super::streamline::{Field, SteadyPassage};
use super::bounds::longest;
use super::eigenstress::SpaceEigenstress;
use super::grid::{Image, SpaceGrid};
use super::passes::{SpacePasses, mirrored};
use super::rail::{RailInSpace, RolledPatch};
use super::state::{SpaceCycle, SpaceLayer, StabilisedSpace};
use crate::load::Travel;
use crate::math::{Tensor, smallest_ball};
use rayon::prelude::*;
use std::array::from_fn;

impl SpacePasses<'_> {
    pub(super) fn finish(self) -> StabilisedSpace {
        let (radius, streamlines) = (self.rail.hardening.yield_radius(), self.grid.streamlines());
        let melan: Vec<[f64; 2]> = (0..streamlines).into_par_iter().map(|j| self.utilisations(j)).collect();
        let state = self.state(&melan);
        let travel = self.travel();
        let Self { rail, grid, backgrounds, records, passages, lasts, .. } = self;
        let leaving = passages.entering.clone();
        let (problem, last) = passages.into_last();
        let round = Round::of(rail, lasts, last, records.len());
        let mut elasticity = problem.elasticity;
        let residual = elasticity.section_stress(&leaving);
        let (mut cycles, mut overshoot, mut imbalance) = (Vec::new(), f64::NEG_INFINITY, 0.0_f64);
        for (patch, passage) in &round.passages {
            let (cycle, excess) = cycle(rail, *patch, &grid, &mut elasticity, &backgrounds[*patch], passage);
            cycles.push(cycle);
            overshoot = overshoot.max(excess);
            imbalance = imbalance.max(elasticity.imbalance(passage) / radius);
        }
        cycles.sort_by_key(|own| own.patch);
        let path = round.path();
        let kept = |j: usize| {
            let change: [f64; 5] = from_fn(|c| leaving[j][c] - round.entering[j][c]);
            Tensor::from_deviator(change).equivalent()
        };
        let drift = (0..streamlines).map(kept).fold(0.0, f64::max);
        let alternates = match state {
            RailState::PlasticShakedown => alternating_streamlines(&path, kept),
            _ => vec![false; streamlines],
        };
        let layers = section(rail, travel, &grid, &residual, |j| SpaceLayer {
            strain: Tensor::from_deviator(leaving[j]),
            plastic_per_pass: path[j],
            yield_utilisation: melan[j][0],
            shakedown_utilisation: melan[j][1],
            alternates: alternates[j],
            ..SpaceLayer::default()
        });
        StabilisedSpace {
            state,
            passes: records,
            layers: grid.layers.clone(),
            laterals: (0..grid.rows).map(|row| grid.lateral(row)).collect(),
            section: layers,
            cycles,
            admissibility: Admissibility { overshoot, drift, imbalance },
        }
    }

    /// The direction of travel of the wheel that passed last.
    fn travel(&self) -> Travel {
        let patches = &self.rail.patches;
        patches[self.records.len().saturating_sub(1) % patches.len()].travel
    }

    /// The largest deviator of the elastic paths of streamline `j`, and the radius of the smallest
    /// ball around them, over the radius of the yield surface.
    fn utilisations(&self, j: usize) -> [f64; 2] {
        let (radius, streamlines) = (self.rail.hardening.yield_radius(), self.grid.streamlines());
        let of = |(background, patch): (&Field<5>, &RolledPatch)| -> Vec<[f64; 5]> {
            let columns = background[0].len() / streamlines;
            let at = |i: usize| from_fn(|c| background[c][i * streamlines + j]);
            // All in the axes of the rail.
            let turned = |own: [f64; 5]| if patch.travel == Travel::Backward { mirrored(own) } else { own };
            (0..columns).map(at).map(turned).collect()
        };
        let path: Vec<[f64; 5]> = self.backgrounds.iter().zip(&self.rail.patches).flat_map(of).collect();
        [longest(&path) / radius, smallest_ball(&path).radius / radius]
    }

    /// As in the plane, once the passages repeat, the loads alone distinguish the states. With
    /// several patches the paths of all of them must fit into the same yield surface.
    fn state(&self, melan: &[[f64; 2]]) -> RailState {
        let largest = |which: usize| melan.iter().map(|own| own[which]).fold(0.0, f64::max);
        let shear_yield = self.rail.hardening.shear_yield_stress();
        let limit =
            |patch: &RolledPatch| patch.peak_pressure / shear_yield / patch.bounds().shakedown_limit().ratio;
        let of_limit = match &self.rail.patches[..] {
            [one] => limit(one),
            _ => largest(1),
        };
        if !self.is_stabilised {
            RailState::NotStabilised
        } else if largest(0) <= 1.0 && self.records.iter().all(|pass| pass.plastic_path == 0.0) {
            RailState::Elastic
        } else if of_limit <= 1.0 {
            RailState::ElasticShakedown
        } else {
            RailState::PlasticShakedown
        }
    }
}

/// The last passage of each wheel, in their order.
struct Round {
    /// Number of the patch, and its passage.
    passages: Vec<(usize, SteadyPassage<5>)>,
    /// The strain that entered the first of them, in the axes of the last one.
    entering: Vec<[f64; 5]>,
}

impl Round {
    /// The last round of `count` passages: the `lasts` of several patches, or the `last` of one.
    fn of(
        rail: &RailInSpace,
        mut lasts: Vec<Option<SteadyPassage<5>>>,
        last: SteadyPassage<5>,
        count: usize,
    ) -> Self {
        let patches = lasts.len();
        if patches == 1 || count == 0 {
            return Self { entering: last.entering.clone(), passages: vec![(0, last)] };
        }
        let numbers = (count.saturating_sub(patches)..count).map(|pass| pass % patches);
        let passages: Vec<(usize, SteadyPassage<5>)> =
            numbers.filter_map(|patch| Some((patch, lasts[patch].take()?))).collect();
        let travel = |own: &(usize, SteadyPassage<5>)| rail.patches[own.0].travel;
        let (first, end) = (&passages[0], &passages[passages.len() - 1]);
        let mut entering = first.1.entering.clone();
        if travel(first) != travel(end) {
            entering.iter_mut().for_each(|strain| *strain = mirrored(*strain));
        }
        Self { passages, entering }
    }

    /// √(2/3) ∫ |dε_p| of each streamline.
    fn path(&self) -> Vec<f64> {
        let mut sum = vec![0.0; self.entering.len()];
        for (_, passage) in &self.passages {
            for (sum, own) in sum.iter_mut().zip(&passage.path) {
                *sum += own;
            }
        }
        sum
    }
}

/// All rows and layers of the section: the stress of `residual` and of manufacturing, the rest by
/// streamline.
fn section(
    rail: &RailInSpace,
    travel: Travel,
    grid: &SpaceGrid,
    residual: &[Tensor],
    of: impl Fn(usize) -> SpaceLayer,
) -> Vec<SpaceLayer> {
    let (layers, depths) = (grid.layers.count(), grid.layers.middles());
    let is_backward = travel == Travel::Backward;
    let turned = |own: Tensor| if is_backward { own.mirrored() } else { own };
    let elastic = |at: usize| SpaceLayer {
        depth: depths[at % layers],
        lateral: grid.lateral(at / layers),
        stress: turned(residual[at]) + rail.initial_stress(depths[at % layers]),
        ..SpaceLayer::default()
    };
    let mut section: Vec<SpaceLayer> = (0..grid.rows * layers).map(elastic).collect();
    for (row, m) in grid.active.clone().enumerate() {
        for l in 0..layers {
            let own = of(row * layers + l);
            for (m, image) in grid.images(m) {
                let SpaceLayer { depth, lateral, stress, .. } = section[m * layers + l];
                let strain = turned(if image == Image::Mirrored { own.strain.across() } else { own.strain });
                section[m * layers + l] = SpaceLayer { depth, lateral, stress, strain, ..own };
            }
        }
    }
    section
}

/// Stress and strain of the `passage` of a patch by its number, and the largest excess of the yield
/// condition over R.
fn cycle(
    rail: &RailInSpace,
    number: usize,
    grid: &SpaceGrid,
    elasticity: &mut SpaceEigenstress,
    background: &Field<5>,
    passage: &SteadyPassage<5>,
) -> (SpaceCycle, f64) {
    elasticity.redistribute_for(passage);
    let (depths, streamlines) = (grid.layers.middles(), grid.streamlines());
    let (radius, back) = (rail.hardening.yield_radius(), rail.hardening.back_stress_modulus());
    let patch = &rail.patches[number];
    let is_backward = patch.travel == Travel::Backward;
    let stress = &elasticity.stress;
    let column = |i: usize| -> (Vec<Tensor>, f64) {
        let (mut own, mut overshoot) = (Vec::with_capacity(streamlines), f64::NEG_INFINITY);
        for (row, m) in grid.active.clone().enumerate() {
            for (l, &depth) in depths.iter().enumerate() {
                let j = row * depths.len() + l;
                let at = i * streamlines + j;
                let residual = Tensor::of(from_fn(|c| stress[c][at]));
                let s = residual.deviator();
                let xi: [f64; 5] = from_fn(|c| s[c] + background[c][at] - back * passage.strain[c][at]);
                overshoot = overshoot.max(longest(&[xi]) / radius - 1.0);
                let wheel = patch.forward_stress(grid.abscissa(i), grid.lateral(m), depth);
                let total = residual + wheel + rail.initial_stress(depth);
                own.push(if is_backward { total.mirrored() } else { total });
            }
        }
        (own, overshoot)
    };
    let columns: Vec<(Vec<Tensor>, f64)> = (0..grid.columns).into_par_iter().rev().map(column).collect();
    let strain_at = |at: usize| {
        let strain = Tensor::from_deviator(from_fn(|c| passage.strain[c][at]));
        if is_backward { strain.mirrored() } else { strain }
    };
    let column = |i: usize| i * streamlines..(i + 1) * streamlines;
    let strain = (0..grid.columns).rev().flat_map(column).map(strain_at).collect();
    let overshoot = columns.iter().map(|own| own.1).fold(f64::NEG_INFINITY, f64::max);
    let side = if is_backward { -1.0 } else { 1.0 };
    let cycle = SpaceCycle {
        patch: number,
        abscissae: (0..grid.columns).rev().map(|i| side * grid.abscissa(i)).collect(),
        rows: grid.active.clone(),
        stress: columns.into_iter().flat_map(|own| own.0).collect(),
        strain,
    };
    (cycle, overshoot)
}

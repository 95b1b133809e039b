//! Passages in space, one after the other and one wheel after the other.

use super::super::fourier::active_columns;
use super::super::passages::Passages;
use super::super::rail::ShakedownError;
use super::super::stabilise::{MOST_ITERATIONS, STRAIN_TOLERANCE, TOLERANCE};
use super::super::state::PassRecord;
use super::super::streamline::{Field, FlowLaw, SteadyPassage, SteadyProblem, Upstream};
use super::choice::{Reached, Zone};
use super::eigenstress::SpaceEigenstress;
use super::grid::{Across, SpaceGrid};
use super::rail::{RailInSpace, RolledPatch, Symmetry};
use super::settings::SpaceStabilisation;
use crate::interruption::Interruption;
use crate::math::Tensor;
use rayon::prelude::*;
use std::array::from_fn;

/// The iteration over passages on one grid.
pub(super) struct SpacePasses<'a> {
    pub rail: &'a RailInSpace,
    settings: &'a SpaceStabilisation,
    pub grid: SpaceGrid,
    zone: Zone,
    /// Deviators of the stress of each patch and of manufacturing, in axes of which x points in the
    /// direction of travel of the wheel.
    pub backgrounds: Vec<Field<5>>,
    /// In the axes of the wheel that passed last.
    pub passages: Passages<SpaceEigenstress, 5>,
    /// Of several patches, the last passage of each.
    pub lasts: Vec<Option<SteadyPassage<5>>>,
    pub records: Vec<PassRecord>,
    pub is_stabilised: bool,
}

impl<'a> SpacePasses<'a> {
    pub(super) fn new(
        rail: &'a RailInSpace,
        settings: &'a SpaceStabilisation,
        grid: SpaceGrid,
        zone: Zone,
    ) -> Self {
        let of = |patch: &RolledPatch| elastic_deviators(rail, patch, &grid);
        let backgrounds: Vec<Field<5>> = rail.patches.iter().map(of).collect();
        let half_width = rail.patches.iter().map(|patch| patch.half_width).fold(0.0, f64::max);
        let problem = SteadyProblem {
            elasticity: SpaceEigenstress::new(&rail.steel, grid.clone()),
            law: FlowLaw::new(&rail.steel, &rail.hardening),
            background: backgrounds.first().cloned().unwrap_or_default(),
            active: active_columns(half_width, grid.spacing, grid.columns),
            strain_scale: 2.0 * rail.steel.shear_modulus() / rail.hardening.yield_radius(),
            tolerance: TOLERANCE,
            max_iterations: MOST_ITERATIONS,
        };
        let passages = Passages::new(problem, grid.streamlines());
        let lasts = vec![None; backgrounds.len()];
        let (records, is_stabilised) = (Vec::new(), false);
        Self { rail, settings, grid, zone, backgrounds, passages, lasts, records, is_stabilised }
    }

    /// Computes all passages and returns the borders of the zone that flow has reached, at which it
    /// ends early.
    pub(super) fn all(
        &mut self,
        interruption: Interruption<'_>,
        watch: &mut impl FnMut(&PassRecord),
    ) -> Result<Reached, ShakedownError> {
        let yield_strain = self.rail.hardening.yield_stress() / self.rail.steel.young();
        let in_turn = self.backgrounds.len();
        let mut unchanged = 0;
        while !self.is_stabilised && self.records.len() < self.settings.max_passes.max(1) {
            let patch = self.records.len() % in_turn;
            self.pass(patch, interruption)?;
            let reached = self.reached();
            if reached != Reached::default() {
                return Ok(reached);
            }
            let record = self.record();
            let is_unchanged = record.stress_change <= self.settings.pass_tolerance * record.left_stress
                && record.strain_change <= STRAIN_TOLERANCE * yield_strain;
            unchanged = if is_unchanged { unchanged + 1 } else { 0 };
            watch(&record);
            self.records.push(record);
            // The first wheel passes last.
            self.is_stabilised = unchanged >= in_turn && patch == 0;
        }
        Ok(Reached::default())
    }

    /// The next passage, of the wheel with the patch of this number.
    fn pass(&mut self, patch: usize, interruption: Interruption<'_>) -> Result<(), ShakedownError> {
        let in_turn = self.backgrounds.len();
        if in_turn == 1 {
            let start = self.passages.guess();
            self.passages.advance(start, Upstream::Given, interruption)?;
            return Ok(());
        }
        let travel = |patch: usize| self.rail.patches[patch].travel;
        let before = (patch + in_turn - 1) % in_turn;
        if !self.records.is_empty() && travel(before) != travel(patch) {
            self.passages.entering.iter_mut().for_each(|strain| *strain = mirrored(*strain));
        }
        self.passages.problem.background.clone_from(&self.backgrounds[patch]);
        let start = self.passages.guess_like(self.lasts[patch].as_ref());
        let passage = self.passages.advance(start, Upstream::Given, interruption)?;
        self.lasts[patch] = Some(passage.clone());
        Ok(())
    }

    /// The borders of the zone that flow has reached.
    fn reached(&self) -> Reached {
        let Some(last) = &self.passages.last else { return Reached::default() };
        let layers = self.grid.layers.count();
        let interfaces = self.grid.layers.interfaces();
        let flows = |row: usize, layer: usize| last.path[row * layers + layer] > 0.0;
        let rows = self.grid.active.len();
        let below = (0..layers).filter(|&layer| interfaces[layer + 1] > self.zone.depth);
        let outer = match self.grid.symmetry {
            Symmetry::Mirrored => vec![rows - 1],
            Symmetry::None => vec![0, rows - 1],
        };
        Reached {
            bottom: below.into_iter().any(|layer| (0..rows).any(|row| flows(row, layer))),
            sides: self.grid.across == Across::Confined
                && outer.iter().any(|&row| (0..layers).any(|layer| flows(row, layer))),
        }
    }

    /// The change by the last passage.
    fn record(&self) -> PassRecord {
        let leaving = &self.passages.entering;
        let none = vec![[0.0; 5]; leaving.len()];
        let last = self.passages.last.as_ref();
        let came = last.map_or(&none, |last| &last.entering);
        let changes: Vec<[f64; 5]> =
            leaving.iter().zip(came).map(|(a, b)| from_fn(|c| a[c] - b[c])).collect();
        let elasticity = &self.passages.problem.elasticity;
        let largest = |strain: &[[f64; 5]]| {
            let stress = elasticity.section_stress(strain);
            stress.iter().map(|own| own.xx.abs().max(own.yy.abs())).fold(0.0, f64::max)
        };
        let strain = |strains: &[[f64; 5]]| {
            strains.iter().map(|own| Tensor::from_deviator(*own).equivalent()).fold(0.0, f64::max)
        };
        PassRecord {
            pass: self.records.len() + 1,
            iterations: last.map_or(0, |last| last.iterations),
            stress_change: largest(&changes),
            strain_change: strain(&changes),
            largest_strain: strain(leaving),
            plastic_path: last.map_or(0.0, |last| last.path.iter().copied().fold(0.0, f64::max)),
            left_stress: largest(leaving),
        }
    }
}

/// The mirror image in a plane x = constant of a deviator by its coordinates
/// ([`Tensor::deviator`]).
pub(super) fn mirrored([difference, across, xz, xy, yz]: [f64; 5]) -> [f64; 5] {
    [difference, across, -xz, -xy, yz]
}

/// Deviators of the stress of `patch` and of manufacturing on the columns of `grid`.
fn elastic_deviators(rail: &RailInSpace, patch: &RolledPatch, grid: &SpaceGrid) -> Field<5> {
    let (depths, streamlines) = (grid.layers.middles(), grid.streamlines());
    let column = |i: usize| -> Vec<[f64; 5]> {
        let mut own = Vec::with_capacity(streamlines);
        for row in grid.active.clone() {
            for &depth in &depths {
                let wheel = patch.forward_stress(grid.abscissa(i), grid.lateral(row), depth);
                own.push((wheel + rail.initial_stress(depth)).deviator());
            }
        }
        own
    };
    let columns: Vec<Vec<[f64; 5]>> = (0..grid.columns).into_par_iter().map(column).collect();
    from_fn(|c| columns.iter().flatten().map(|own| own[c]).collect())
}

//! Passages of a wheel over many cracks in space, group by group, in sweeps until the groups agree.

use super::body::{FrontSif, SpaceBody};
use super::contact::SpaceContactError;
use super::fluid::FluidUnderWheel;
use super::followed::{FollowedFaces, HalfWithFluid};
use super::groups::{CrackGroup, OutsideForces, Passing};
use super::load::{ForcesByPosition, SpaceLoad, WheelOverFaces};
use super::mirror::{MirroredHalf, MirroredPoints};
use super::stabilised::Passages;
use super::states::{SpaceFaces, SpaceHistory, SpacePassageSettings, SpaceStatus};
use crate::growth::{
    GroupsError, Observer, PassageSettings, SweepError, SweepProgress, WithoutProgress, output_positions,
};
use crate::interruption::{Interrupted, Interruption};
use crate::linear::LinearError;
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// The ratio of the changes of K in successive sweeps is assumed to be at least this large: the
/// first sweep is compared with a trial of longer load steps, which differs by more than its error.
const LEAST_CONTRACTION: f64 = 0.05;

/// The tolerance of the load steps of a group over that of all cracks together: each group chooses
/// its own steps, and a crack feels the errors of its neighbours.
const SHARE_OF_TOLERANCE: f64 = 0.5;

/// A group with what its contact needs besides its body.
struct GroupInPassage<'a> {
    of: &'a CrackGroup,
    friction: Vec<f64>,
    half: Option<HalfWithFluid>,
}

/// Results of a group in a passage, for its own crack.
struct OwnResults {
    history: SpaceHistory,
    jumps: Passing,
    end: SpaceFaces,
}

/// Passages of one wheel over groups of cracks.
pub(super) struct GroupedPassages<'a> {
    body: &'a SpaceBody,
    over: WheelOverFaces<'a>,
    settings: &'a PassageSettings,
    observer: &'a dyn Observer,
    groups: Vec<GroupInPassage<'a>>,
    constant: Vec<f64>,
    positions: Vec<f64>,
    /// Nodal forces on each crack due to the wheel, by the bits of its position.
    forces: Vec<Mutex<HashMap<u64, Arc<[f64]>>>>,
    /// Jumps of each crack in the last sweep; empty before the first one.
    jumps: Vec<Passing>,
    /// K of the last sweep, by crack and position.
    last: Vec<Vec<Vec<FrontSif>>>,
    /// The largest |K| of each crack so far.
    peaks: Vec<f64>,
    error: SweepError,
}

impl<'a> GroupedPassages<'a> {
    /// Passages of the wheel of `load` over `groups` of the cracks of `body`, with the crack-face
    /// friction coefficient of each crack.
    ///
    /// Errors: an interruption.
    pub fn new(
        (body, groups): (&'a SpaceBody, &'a [CrackGroup]),
        friction: &[f64],
        load: &'a SpaceLoad<'a>,
        settings: &'a PassageSettings,
        observer: &'a dyn Observer,
    ) -> Result<Self, Interrupted> {
        let constant = load.constant_forces(body);
        let positions = output_positions(&settings.passage, load.bending, &body.places());
        let fluid =
            load.fluid.map(|load| FluidUnderWheel { faces: load.fluid.in_space(body), over: load.over });
        let is_symmetric = |points: &MirroredPoints| {
            points.is_symmetric(&constant) && load.is_mirrored(body, points, &positions)
        };
        let mirrored = MirroredPoints::of(body).filter(is_symmetric);
        let in_passage = |of: &'a CrackGroup| {
            let of_points = |k: usize| friction[of.members[of.body.crack_of(k)]];
            let friction: Vec<f64> = (0..of.body.points().len()).map(of_points).collect();
            let points = mirrored.as_ref().and_then(|_| MirroredPoints::of(&of.body));
            let half = points.and_then(|points| MirroredHalf::of(&of.body, points, &friction));
            GroupInPassage { of, friction, half: half.map(|half| (half, Vec::new())) }
        };
        let mut groups: Vec<GroupInPassage> = groups.par_iter().map(in_passage).collect();
        let mirrored = mirrored.filter(|_| groups.iter().all(|group| group.half.is_some()));
        if mirrored.is_none() {
            groups.iter_mut().for_each(|group| group.half = None);
        }
        let asked = || observer.interrupted();
        let interruption = Interruption::when(&asked);
        let over = load.over((body, mirrored), fluid, &positions, interruption)?;
        let count = groups.len();
        let passages = Self {
            body,
            over,
            settings,
            observer,
            groups,
            constant,
            positions,
            forces: (0..count).map(|_| Mutex::default()).collect(),
            jumps: Vec::new(),
            last: Vec::new(),
            peaks: vec![0.0; count],
            error: SweepError::new(LEAST_CONTRACTION),
        };
        // Forces do not depend on the contact: those needed in every passage are computed at once.
        passages.positions.par_iter().try_for_each(|&position| {
            (0..count).for_each(|crack| drop(passages.wheel_forces(crack, position)));
            interruption.check()
        })?;
        Ok(passages)
    }

    /// Nodal forces (N) on a crack with the wheel at `position` (mm), computed once
    /// ([`WheelOverFaces::forces_on`]).
    fn wheel_forces(&self, crack: usize, position: f64) -> Arc<[f64]> {
        let known = || self.forces[crack].lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(forces) = known().get(&position.to_bits()) {
            return Arc::clone(forces);
        }
        let forces: Arc<[f64]> = self.over.forces_on(crack, position).into();
        known().insert(position.to_bits(), Arc::clone(&forces));
        forces
    }

    /// Values (3p) of the members of a group, from those of all cracks.
    fn of_members(&self, group: &CrackGroup, values: &[f64]) -> Vec<f64> {
        let of = |&crack: &usize| {
            let points = &self.body.cracks()[crack].points;
            &values[3 * points.start..3 * points.end]
        };
        group.members.iter().flat_map(of).copied().collect()
    }

    /// Whether every group holds all cracks, so that none is outside.
    fn are_whole(&self) -> bool {
        self.groups.iter().all(|group| group.of.members.len() == self.groups.len())
    }

    /// Keeps K and the jumps of a sweep for the next one.
    fn keep(&mut self, runs: &[OwnResults]) {
        self.last = runs.iter().map(|run| run.history.sifs.clone()).collect();
        self.jumps = runs.iter().map(|run| run.jumps.clone()).collect();
    }

    /// The largest change of K since the last sweep, relative to the peak of its crack; 1 in the
    /// first sweep.
    fn change(&mut self, runs: &[OwnResults]) -> f64 {
        for (peak, OwnResults { history, .. }) in self.peaks.iter_mut().zip(runs) {
            *peak = peak.max(history.peak());
        }
        let mut largest = 0.0f64;
        for (k, OwnResults { history, .. }) in runs.iter().enumerate() {
            let Some(last) = self.last.get(k) else { return 1.0 };
            let pairs = history.sifs.iter().flatten().zip(last.iter().flatten());
            let by = pairs.map(|(now, last)| now.difference(last)).fold(0.0, f64::max);
            if by > 0.0 {
                largest = largest.max(by / self.peaks[k]);
            }
        }
        largest
    }

    /// All groups over the faces `faces`, under the jumps of the last sweep.
    fn sweep(
        &self,
        settings: &SpacePassageSettings,
        faces: &SpaceFaces,
        number: usize,
    ) -> Result<Vec<OwnResults>, SpaceContactError> {
        let progress = SweepProgress::new(self.observer, number, self.groups.len());
        let run = |group: &GroupInPassage<'_>| {
            let run = self.run(settings, faces, group);
            progress.group_done();
            run
        };
        self.groups.par_iter().map(run).collect()
    }

    /// A group over the faces `faces` of all cracks.
    fn run(
        &self,
        settings: &SpacePassageSettings,
        faces: &SpaceFaces,
        group: &GroupInPassage<'_>,
    ) -> Result<OwnResults, SpaceContactError> {
        let GroupInPassage { of, friction, half } = group;
        let own = of.body.cracks()[of.own].points.clone();
        let outside = OutsideForces::on(self.body, of, &self.jumps)?;
        let constant = self.of_members(of, &self.constant);
        let unloaded = [0, 1].map(|end| {
            let mut forces = constant.clone();
            outside.add_unloaded(end, &mut forces);
            forces
        });
        let points = half.as_ref().map(|(half, _)| &half.points);
        let known = ForcesByPosition::default();
        let computed = |position: f64| {
            let of = of.members.iter().map(|&crack| self.wheel_forces(crack, position));
            let mut forces: Vec<f64> = of.flat_map(|forces| forces.to_vec()).collect();
            if let Some(points) = points {
                forces = points.with_mirrored_forces(forces);
            }
            forces.iter_mut().zip(&constant).for_each(|(force, constant)| *force += constant);
            outside.add(position, &mut forces);
            forces
        };
        let front = of.body.cracks()[of.own].front.clone();
        let quiet = WithoutProgress(self.observer);
        let followed = FollowedFaces {
            body: &of.body,
            friction,
            fluid: None,
            half: half.as_ref(),
            positions: &self.positions,
            unloaded: [&unloaded[0], &unloaded[1]],
            forces: &|position| known.at(position, computed),
            observer: &quiet,
        };
        let mut faces = self.faces_of(of, faces);
        let mut samples: Vec<(f64, Vec<f64>)> = Vec::new();
        let history = followed.pass(settings, &mut faces, &mut |instant| {
            samples.push((instant.position, instant.faces.jumps[3 * own.start..3 * own.end].to_vec()));
        })?;
        let (_, before) = samples.remove(0);
        let end = part(&faces, &own);
        let jumps = Passing::of(before, &samples, end.jumps.clone());
        let history = SpaceHistory {
            sifs: history.sifs.iter().map(|sifs| sifs[front.clone()].to_vec()).collect(),
            before: history.before[front.clone()].to_vec(),
            faces: history.faces.iter().map(|faces| part(faces, &own)).collect(),
            ..history
        };
        Ok(OwnResults { history, jumps, end })
    }

    /// The faces of the members of a group.
    fn faces_of(&self, group: &CrackGroup, faces: &SpaceFaces) -> SpaceFaces {
        joined(group.members.iter().map(|&crack| part(faces, &self.body.cracks()[crack].points)))
    }

    /// The results of all cracks.
    fn together(&self, runs: &[OwnResults]) -> SpaceHistory {
        let histories = || runs.iter().map(|run| &run.history);
        let at = |k: usize| joined(histories().map(|history| history.faces[k].clone()));
        let faces: Vec<SpaceFaces> = (0..self.positions.len()).map(at).collect();
        let fluid = |(position, faces): (&f64, &SpaceFaces)| {
            let cracks = 0..runs.len();
            let FluidUnderWheel { faces: fluid, over } = self.over.fluid.as_ref()?;
            Some(cracks.map(|crack| fluid.state_of(crack, *position, *over, faces)).collect())
        };
        SpaceHistory {
            sifs: (0..self.positions.len())
                .map(|k| histories().flat_map(|history| history.sifs[k].iter().copied()).collect())
                .collect(),
            before: histories().flat_map(|history| history.before.iter().copied()).collect(),
            fluid: self.positions.iter().zip(&faces).filter_map(fluid).collect(),
            faces,
            positions: self.positions.clone(),
            steps: 0,
            iterations: 0,
            iterations_max: 0,
            violation: histories().map(|history| history.violation).fold(0.0, f64::max),
            step_error: histories().map(|history| history.step_error).fold(0.0, f64::max),
        }
    }
}

impl Passages for GroupedPassages<'_> {
    fn trial(&mut self, settings: &SpacePassageSettings) -> Result<f64, SpaceContactError> {
        let runs = self.sweep(settings, &SpaceFaces::virgin(self.body.points().len()), 1)?;
        self.change(&runs);
        self.keep(&runs);
        Ok(self.peaks.iter().fold(0.0, |most, peak| most.max(*peak)))
    }

    fn pass(
        &mut self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        let share = if self.are_whole() { 1.0 } else { SHARE_OF_TOLERANCE };
        let settings = &SpacePassageSettings { tolerance: share * settings.tolerance, ..*settings };
        let (mut steps, mut iterations, mut most) = (0, 0, 0);
        let mut sweep = self.error.begin();
        loop {
            let runs = self.sweep(settings, faces, sweep)?;
            for OwnResults { history, .. } in &runs {
                steps += history.steps;
                iterations += history.iterations;
                most = most.max(history.iterations_max);
            }
            let change = self.change(&runs);
            self.keep(&runs);
            // Groups of all cracks do not depend on each other.
            let change = if self.are_whole() { 0.0 } else { change };
            let Some(next) = self.error.next(change, self.settings) else {
                *faces = joined(runs.iter().map(|run| run.end.clone()));
                let history = self.together(&runs);
                return Ok(SpaceHistory { steps, iterations, iterations_max: most, ..history });
            };
            sweep = next;
        }
    }

    /// Jumps are interpolated linearly, so that with half of the positions the error is four times
    /// as large; its effect is that on free faces.
    fn error(&self) -> Result<Option<GroupsError>, LinearError> {
        let halved: Vec<Passing> = self.jumps.iter().map(Passing::halved).collect();
        let of_group = |group: &GroupInPassage<'_>| {
            let CrackGroup { body, own, .. } = group.of;
            let [all, half] =
                [&self.jumps, &halved].map(|jumps| OutsideForces::on(self.body, group.of, jumps));
            let (all, half) = (all?.at(&self.positions), half?.at(&self.positions));
            let influence = body.sif_influence();
            let front = body.cracks()[*own].front.clone();
            let mut largest = 0.0f64;
            for k in 0..self.positions.len() {
                let by: Vec<f64> = all.row(k).iter().zip(half.row(k)).map(|(a, b)| (a - b) / 3.0).collect();
                for row in 3 * front.start..3 * front.end {
                    let k: f64 = influence.row(row).iter().zip(&by).map(|(s, f)| s * f).sum();
                    largest = largest.max(k.abs());
                }
            }
            let peak = self.peaks[group.of.members[*own]];
            Ok(if largest > 0.0 { largest / peak } else { 0.0 })
        };
        let of_groups = self.groups.par_iter().map(of_group).collect::<Result<Vec<f64>, LinearError>>()?;
        let interpolation = of_groups.into_iter().fold(0.0, f64::max);
        Ok(Some(GroupsError { sweeps: self.error.largest, interpolation, far: 0.0 }))
    }
}

/// The faces of the points `points`.
fn part(faces: &SpaceFaces, points: &Range<usize>) -> SpaceFaces {
    let values = 3 * points.start..3 * points.end;
    SpaceFaces {
        jumps: faces.jumps[values.clone()].to_vec(),
        reactions: faces.reactions[values].to_vec(),
        status: faces.status[points.clone()].to_vec(),
        fluid: Vec::new(),
    }
}

/// The faces of several cracks as one.
fn joined(parts: impl Iterator<Item = SpaceFaces>) -> SpaceFaces {
    let mut all =
        SpaceFaces { jumps: Vec::new(), reactions: Vec::new(), status: Vec::new(), fluid: Vec::new() };
    for SpaceFaces { jumps, reactions, status, .. } in parts {
        all.jumps.extend(jumps);
        all.reactions.extend(reactions);
        all.status.extend::<Vec<SpaceStatus>>(status);
    }
    all
}

//! Load steps under a wheel whose shear is not proportional to its pressure.

use super::{FaceProblem, FaceScale, LoadPath};

/// Forces of the uneven shear (N/mm, 2p) in the middle and at the end of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct ShearInStep {
    pub middle: Vec<f64>,
    pub end: Vec<f64>,
}

/// The uneven shear along a path. Its forces follow from the pressures, and these from its forces:
/// a step is repeated with those that follow from it until they agree. They are small beyond the
/// uncracked rail, and two or three repetitions suffice.
#[derive(Debug, Clone, Default)]
pub(super) struct ShearAlongPath {
    /// Forces in the current load; empty while the wheel is not coupled.
    pub now: Vec<f64>,
    /// Their rate over the last step, per path coordinate.
    rate: Vec<f64>,
    /// Those of the step that is being tried; none where the shear is even.
    pub assumed: Option<ShearInStep>,
    /// Those that follow from the pressures of that step.
    pub found: ShearInStep,
}

/// Largest number of repetitions of a step.
pub(super) const REPETITIONS: usize = 12;
/// Change of the forces, over the tolerance of K times the largest force, at which a step is not
/// repeated.
const SETTLED: f64 = 0.02;

impl ShearAlongPath {
    /// No shear yet on `points` points.
    pub(super) fn none(points: usize) -> Self {
        Self { now: vec![0.0; 2 * points], rate: vec![0.0; 2 * points], ..Self::default() }
    }

    /// The forces that continue as in the last step, over `length` of the path coordinate.
    pub(super) fn ahead(&self, length: f64) -> ShearInStep {
        let after =
            |length: f64| self.now.iter().zip(&self.rate).map(|(f, rate)| f + length * rate).collect();
        ShearInStep { middle: after(0.5 * length), end: after(length) }
    }

    /// Notes the forces that follow from the jumps `middle` and `end` of all components with the
    /// wheel at `xc` (mm), in the middle and at the end of the step; returns whether they agree
    /// with the assumed ones.
    pub(super) fn agrees(
        &mut self,
        problem: &FaceProblem,
        (middle, end): (Option<&[f64]>, &[f64]),
        xc: [f64; 2],
        (tolerance, largest): (f64, FaceScale),
    ) -> bool {
        let (Some(assumed), Some(wheel)) = (&self.assumed, problem.wheel()) else { return true };
        let forces = |jump: &[f64], xc: f64| wheel.uneven_forces(jump, xc).unwrap_or_default();
        let end = forces(end, xc[1]);
        let middle = match middle {
            Some(jump) => forces(jump, xc[0]),
            None => self.now.iter().zip(&end).map(|(start, end)| 0.5 * (start + end)).collect(),
        };
        let apart = |one: &[f64], other: &[f64]| {
            one.iter().zip(other).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
        };
        let error = apart(&middle, &assumed.middle).max(apart(&end, &assumed.end));
        self.found = ShearInStep { middle, end };
        error <= SETTLED * tolerance * largest.force
    }

    /// Continues from the end of a step of `length`, whose assumed forces are part of its load.
    pub(super) fn advance(&mut self, length: f64) {
        let Some(ShearInStep { end, .. }) = self.assumed.take() else { return };
        if length != 0.0 {
            self.rate = end.iter().zip(&self.now).map(|(end, start)| (end - start) / length).collect();
        }
        self.now = end;
    }
}

/// A path with the uneven shear of a step from `from` to `to`.
pub(super) struct WithShear<'p> {
    pub path: &'p dyn LoadPath,
    pub range: [f64; 2],
    pub start: &'p [f64],
    pub step: &'p ShearInStep,
}

impl LoadPath for WithShear<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let [from, to] = self.range;
        let share = if to == from { 1.0 } else { (at - from) / (to - from) };
        // The parabola through start, middle and end.
        let weights =
            [(1.0 - share) * (1.0 - 2.0 * share), 4.0 * share * (1.0 - share), share * (2.0 * share - 1.0)];
        let mut forces = self.path.nodal_forces(at);
        for (part, weight) in [self.start, &self.step.middle, &self.step.end].into_iter().zip(weights) {
            forces.iter_mut().zip(part).for_each(|(force, part)| *force += weight * part);
        }
        forces
    }

    fn over_mouths(&self, at: f64) -> Vec<f64> {
        self.path.over_mouths(at)
    }
}

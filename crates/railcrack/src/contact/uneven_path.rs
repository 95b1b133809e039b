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
    /// The last step, which ended with them.
    last: Option<LastStep>,
    /// Those of the step that is being tried; none where the shear is even.
    pub assumed: Option<ShearInStep>,
    /// Those that follow from the pressures of that step.
    pub found: ShearInStep,
}

/// Forces of the uneven shear (N/mm, 2p) at the start and in the middle of the last step, and its
/// length.
#[derive(Debug, Clone)]
struct LastStep {
    length: f64,
    start: Vec<f64>,
    middle: Vec<f64>,
}

/// Largest number of repetitions of a step.
pub(super) const REPETITIONS: usize = 12;
/// Largest number of corrections of the forces at the end of a step.
pub(super) const CORRECTIONS: usize = 4;
/// Error of the forces within a step, over the tolerance of K times the largest force, at which the
/// step is not repeated: that of the slip at which a point may be held.
const TRACED: f64 = 0.2;
/// Error of the forces at the end of a step on the same scale.
const SETTLED: f64 = 0.02;

/// Whether the forces that follow from the pressures of a step are the assumed ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Agreement {
    /// They are.
    Full,
    /// The step is accurate enough, but not yet its end.
    Within,
    /// They are not.
    None,
}

impl ShearAlongPath {
    /// No shear yet on `points` points.
    pub(super) fn none(points: usize) -> Self {
        Self { now: vec![0.0; 2 * points], ..Self::default() }
    }

    /// The forces that continue the parabola of the last step, over `length` of the path
    /// coordinate.
    pub(super) fn ahead(&self, length: f64) -> ShearInStep {
        let after = |length: f64| match &self.last {
            None => self.now.clone(),
            Some(last) => {
                let share = 1.0 + length / last.length;
                let [of_start, of_middle, of_end] = parabola(share);
                let values = last.start.iter().zip(&last.middle).zip(&self.now);
                values.map(|((s, m), e)| of_start * s + of_middle * m + of_end * e).collect()
            }
        };
        ShearInStep { middle: after(0.5 * length), end: after(length) }
    }

    /// Notes the forces that follow from the jumps `middle` and `end` of all components with the
    /// wheel at `xc` (mm), in the middle and at the end of the step, and compares them with the
    /// assumed ones.
    pub(super) fn agrees(
        &mut self,
        problem: &FaceProblem,
        (middle, end): (Option<&[f64]>, &[f64]),
        xc: [f64; 2],
        (tolerance, largest): (f64, FaceScale),
    ) -> Agreement {
        let (Some(assumed), Some(wheel)) = (&self.assumed, problem.wheel()) else { return Agreement::Full };
        let forces = |jump: &[f64], xc: f64| wheel.uneven_forces(jump, xc).unwrap_or_default();
        let end = forces(end, xc[1]);
        let (middle, is_traced) = match middle {
            Some(jump) => (forces(jump, xc[0]), true),
            None => (self.now.iter().zip(&end).map(|(start, end)| 0.5 * (start + end)).collect(), false),
        };
        let apart = |one: &[f64], other: &[f64]| {
            let most = one.iter().zip(other).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
            most / (tolerance * largest.force)
        };
        let at_end = apart(&end, &assumed.end);
        let within = if is_traced { at_end.max(apart(&middle, &assumed.middle)) } else { at_end };
        self.found = ShearInStep { middle, end };
        match (within <= TRACED, at_end <= SETTLED) {
            (true, true) => Agreement::Full,
            (true, false) => Agreement::Within,
            (false, _) => Agreement::None,
        }
    }

    /// Makes the forces at the end of the step those that follow from its pressures; returns the
    /// change (N/mm, 2p).
    pub(super) fn correct_end(&mut self) -> Vec<f64> {
        let Some(assumed) = &mut self.assumed else { return Vec::new() };
        let change =
            self.found.end.iter().zip(&assumed.end).map(|(found, assumed)| found - assumed).collect();
        assumed.end.clone_from(&self.found.end);
        change
    }

    /// Continues from the end of a step of `length`, whose assumed forces are part of its load.
    pub(super) fn advance(&mut self, length: f64) {
        let Some(ShearInStep { middle, end }) = self.assumed.take() else { return };
        let start = std::mem::replace(&mut self.now, end);
        if length != 0.0 {
            self.last = Some(LastStep { length, start, middle });
        }
    }
}

/// The weights of the values at the start, in the middle and at the end of a step for a `share` of
/// it.
fn parabola(share: f64) -> [f64; 3] {
    [(1.0 - share) * (1.0 - 2.0 * share), 4.0 * share * (1.0 - share), share * (2.0 * share - 1.0)]
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
        let mut forces = self.path.nodal_forces(at);
        let parts = [self.start, &self.step.middle, &self.step.end];
        for (part, weight) in parts.into_iter().zip(parabola(share)) {
            forces.iter_mut().zip(part).for_each(|(force, part)| *force += weight * part);
        }
        forces
    }

    fn over_mouths(&self, at: f64) -> Vec<f64> {
        self.path.over_mouths(at)
    }
}

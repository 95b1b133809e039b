//! LATIN method condensed to the faces.

use super::latin_wheel::ReducedWheel;
use super::pressure::{PocketRows, demanded, with_pockets};
use super::problem::ROUND_OFF;
use super::tableau::FaceRate;
use super::{
    ContactSolver, FaceProblem, FaceResponse, FaceScale, FaceSolution, LoadStep, NotConverged, Pocket,
    PointStatus, StepSolver,
};
use crate::linear::spd_inverse;
use crate::math::{Anderson, Matrix, dot};

/// The LATIN method of Trollé et al. 2014 (eqs 17 and 25) with the displacements condensed to the
/// faces.
///
/// Local stage, point by point on the contact conditions, search direction f̂ − f = k (ŵ − w);
/// global stage, equilibrium A w = f + f_load, search direction f − f̂ = −k⁻ (w − ŵ) with 1/k⁻ =
/// 1/k + ξ, where ξ is the stabilisation of eq. (17): condensed, it amounts to a softer global
/// direction. Both are set a priori, k_j = `direction` / C_jj with the compliance C_jj of each
/// point, and never change, so that the global stage is one product with a fixed inverse. The
/// fixed-point iteration is relaxed and extrapolated (Anderson 1965). See `docs/dev/latin.md` for
/// the parameter study behind the defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Latin {
    /// k_j C_jj.
    pub direction: f64,
    /// ξ k: 0 for conjugate directions.
    pub stabilisation: f64,
    /// Share of the new iterate, in (0, 1].
    pub relaxation: f64,
    /// Number of iterates kept for extrapolation; 0 for no extrapolation.
    pub history: usize,
    /// Tolerance of the LATIN indicator, the distance between the local and the global solution, in
    /// forces, jumps and K, relative to the largest of each.
    pub tolerance: f64,
    /// Largest number of iterations in a step.
    pub max_iterations: usize,
}

impl Default for Latin {
    fn default() -> Self {
        Self {
            direction: 2.0,
            stabilisation: 0.0,
            relaxation: 0.8,
            history: 20,
            tolerance: 1e-9,
            max_iterations: 3000,
        }
    }
}

impl ContactSolver for Latin {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a> {
        Box::new(LatinSteps::new(problem, *self))
    }
}

struct LatinSteps<'a> {
    problem: &'a FaceProblem<'a>,
    settings: Latin,
    /// k_j per component.
    direction: Vec<f64>,
    /// k⁻ per component.
    global_direction: Vec<f64>,
    /// (A + k⁻)⁻¹.
    global: Option<Matrix>,
    /// z = f̂ + k⁻ ŵ, the state of the iteration.
    combined: Vec<f64>,
    solution: FaceSolution,
    kept: Vec<f64>,
    /// Largest jump, force and K so far.
    scale: [f64; 3],
    /// Jumps of the global stage for a unit pressure of each pocket of fluid.
    units: Vec<FaceRate>,
    /// The faces under a coupled wheel with the last surface nodes in contact.
    reduced: Option<ReducedWheel>,
}

impl<'a> LatinSteps<'a> {
    fn new(problem: &'a FaceProblem<'a>, settings: Latin) -> Self {
        let compliance = &problem.body().compliance;
        let points = problem.points();
        let direction: Vec<f64> = (0..2 * points)
            .map(|i| {
                // Both components of a point have the same k, from the mean of its compliances.
                let j = 2 * (i / 2);
                2.0 * settings.direction / (compliance[(j, j)] + compliance[(j + 1, j + 1)])
            })
            .collect();
        let global_direction: Vec<f64> =
            direction.iter().map(|k| k / (1.0 + settings.stabilisation)).collect();
        let stiffness = problem.stiffness();
        let shifted = Matrix::from_fn(2 * points, 2 * points, |i, j| {
            stiffness[(i, j)] + if i == j { global_direction[i] } else { 0.0 }
        });
        let solution = FaceSolution::virgin_of(problem);
        let global = spd_inverse(&shifted).ok();
        let unit = |pocket: &Pocket| FaceRate {
            jump: global.as_ref().map_or_else(Vec::new, |global| global.times(&pocket.unit[..2 * points])),
            contact: vec![0.0; 2 * points],
        };
        Self {
            units: problem.pockets().iter().map(unit).collect(),
            problem,
            settings,
            direction,
            global_direction,
            global,
            combined: vec![0.0; 2 * points],
            kept: vec![0.0; 2 * points],
            solution,
            scale: [0.0; 3],
            reduced: None,
        }
    }

    /// Solves the contact law at `point` with −f̂ + k ŵ = `target` (shear, normal) for ŵ, f̂ and
    /// the status.
    fn local_stage(&mut self, point: usize, target: (f64, f64), reference: f64) {
        let (t, n) = (2 * point, 2 * point + 1);
        let k = self.direction[t];
        let mu = self.problem.friction(point);
        let solution = &mut self.solution;
        if target.1 > 0.0 {
            (solution.jump[n], solution.contact[n]) = (target.1 / k, 0.0);
            (solution.jump[t], solution.contact[t]) = (target.0 / k, 0.0);
            solution.status[point] = PointStatus::Open;
            return;
        }
        let pressure = -target.1;
        (solution.jump[n], solution.contact[n]) = (0.0, pressure);
        let sticking = k * reference - target.0;
        if mu > 0.0 && sticking.abs() <= mu * pressure {
            (solution.jump[t], solution.contact[t]) = (reference, sticking);
            solution.status[point] = PointStatus::Stick;
        } else {
            let shear = mu * pressure * sticking.signum();
            (solution.jump[t], solution.contact[t]) = ((target.0 + shear) / k, shear);
            solution.status[point] =
                if sticking < 0.0 { PointStatus::SlipForward } else { PointStatus::SlipBackward };
        }
    }
}

impl<'a> StepSolver<'a> for LatinSteps<'a> {
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        if faces.solution().loaded.is_empty() {
            return self.solve_faces(step, faces);
        }
        let tolerance = self.settings.tolerance;
        let failure = |iterations| NotConverged { iterations, indicator: f64::INFINITY, tolerance };
        let problem = self.problem;
        let Some(wheel) = problem.wheel() else { return Err(failure(0)) };
        let mut iterations = 0;
        for _ in 0..MOST_SETS {
            let loaded = faces.solution().loaded.clone();
            let known = self.reduced.take().filter(|reduced| reduced.loaded == loaded);
            let reduced = match known {
                Some(reduced) => reduced,
                None => {
                    let fluid = (&self.global_direction[..], problem.pockets());
                    ReducedWheel::new(wheel, problem.stiffness(), loaded, fluid)
                        .ok_or_else(|| failure(iterations))?
                }
            };
            let solved = self.solve_reduced(step, faces, &reduced);
            let changes = reduced.demanded(wheel, &self.solution);
            self.reduced = Some(reduced);
            iterations += solved?;
            if changes.is_empty() {
                return Ok(iterations);
            }
            for (node, loaded) in changes {
                faces.set_loaded(node, loaded);
            }
        }
        Err(failure(iterations))
    }

    fn keep(&mut self) {
        self.kept.clone_from(&self.combined);
    }

    fn restore(&mut self) {
        self.combined.clone_from(&self.kept);
    }
}

/// Largest number of sets of surface nodes in contact within a step.
const MOST_SETS: usize = 60;

impl<'a> LatinSteps<'a> {
    /// [`StepSolver::solve`] under a coupled wheel, with the surface nodes in contact of `reduced`.
    fn solve_reduced(
        &mut self,
        step: LoadStep,
        faces: &mut FaceResponse<'a>,
        reduced: &ReducedWheel,
    ) -> Result<usize, NotConverged> {
        let forces = reduced.forces(step.forces);
        let global = self.global.replace(reduced.global.clone());
        let units = std::mem::replace(&mut self.units, reduced.units.clone());
        let solved = self.iterate(LoadStep { forces: &forces, ..step }, faces);
        (self.global, self.units) = (global, units);
        let iterations = solved?;
        reduced.complete(step.forces, &mut self.solution);
        faces.adopt(&self.solution);
        Ok(iterations)
    }

    /// [`StepSolver::solve`] without a coupled wheel.
    fn solve_faces(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        let faces_only = &step.forces[..2 * self.problem.points()];
        self.solution.loaded.clear();
        let iterations = self.iterate(LoadStep { forces: faces_only, ..step }, faces)?;
        self.solution.jump[2 * self.problem.points()..].fill(0.0);
        self.solution.contact[2 * self.problem.points()..].fill(0.0);
        faces.adopt(&self.solution);
        Ok(iterations)
    }

    /// The iterations under the nodal forces of `step` (2p); leaves the result in the solution.
    fn iterate(&mut self, step: LoadStep, faces: &FaceResponse<'a>) -> Result<usize, NotConverged> {
        let Latin { tolerance, max_iterations, .. } = self.settings;
        let failure = |iterations, indicator| NotConverged { iterations, indicator, tolerance };
        let n = 2 * self.problem.points();
        let influence = &self.problem.body().sif_influence;
        let mut extrapolation = Anderson::new(self.settings.history);
        let mut jump = vec![0.0; n];
        let mut force = vec![0.0; n];
        let mut right = vec![0.0; n];
        let mut residual = vec![0.0; n];
        let mut indicator = f64::INFINITY;
        self.solution.fluid.clone_from(&faces.solution().fluid);
        let mut no_force = vec![0.0; n];
        for iteration in 1..=max_iterations {
            let Some(global) = &self.global else { return Err(failure(0, indicator)) };
            for i in 0..n {
                right[i] = step.forces[i] + self.combined[i];
            }
            for i in 0..n {
                jump[i] = dot(global.row(i), &right);
            }
            if !self.units.is_empty() {
                let problem = self.problem;
                let rows = PocketRows {
                    pockets: problem.pockets(),
                    free: &problem.free_volumes,
                    bulk: problem.bulk_modulus(),
                    units: &self.units,
                };
                let fluid = &mut self.solution.fluid;
                let pressed = rows.press(fluid, |_| true, step.outside, &mut jump, &mut no_force);
                pressed.map_err(|_| failure(iteration, indicator))?;
            }
            for i in 0..n {
                force[i] = self.combined[i] - self.global_direction[i] * jump[i];
            }
            for point in 0..n / 2 {
                let target = |i: usize| self.direction[i] * jump[i] - force[i];
                let target = (target(2 * point), target(2 * point + 1));
                self.local_stage(point, target, step.reference_slip[point]);
            }
            indicator = self.indicator(&jump, &force, step.forces, influence);
            if indicator <= tolerance && !self.follow_pockets(step) {
                return Ok(iteration);
            }
            for i in 0..n {
                let new = self.solution.contact[i] + self.global_direction[i] * self.solution.jump[i];
                residual[i] = self.settings.relaxation * (new - self.combined[i]);
            }
            extrapolation.advance(&mut self.combined, &residual);
        }
        Err(failure(max_iterations, indicator))
    }

    /// Gives every pocket the status required by its conditions; returns whether any status has
    /// changed.
    fn follow_pockets(&mut self, step: LoadStep) -> bool {
        let mut changed = false;
        let [jump, force, _] = self.scale;
        // The tolerance of the iteration serves as round-off here.
        let loose = self.settings.tolerance / ROUND_OFF;
        let scale = FaceScale { jump: loose * jump, force: loose * force };
        for k in 0..step.outside.len() {
            if let Some(status) = demanded(self.problem, &self.solution, scale, k) {
                self.solution.fluid[k].status = status;
                changed = true;
            }
        }
        changed
    }

    /// The largest difference between the local and the global solution in forces, jumps and the K
    /// of the forces, each relative to its largest value so far; infinite if one is NaN.
    fn indicator(&mut self, jump: &[f64], force: &[f64], load: &[f64], influence: &Matrix) -> f64 {
        if jump.iter().chain(force).any(|value| !value.is_finite()) {
            return f64::INFINITY;
        }
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0f64, |m, v| m.max(v.abs()));
        let local = &self.solution;
        let gap: Vec<f64> = local.contact.iter().zip(force).map(|(a, b)| a - b).collect();
        let pressed = with_pockets(self.problem, &self.solution, load);
        let total: Vec<f64> = force.iter().zip(&*pressed).map(|(a, b)| a + b).collect();
        let sif = largest(&mut (0..influence.rows()).map(|i| dot(influence.row(i), &total)));
        self.scale[0] = self.scale[0].max(largest(&mut jump.iter().copied()));
        self.scale[1] = self.scale[1].max(largest(&mut load.iter().copied()));
        self.scale[2] = self.scale[2].max(sif);
        let jumps = largest(&mut local.jump.iter().zip(jump).map(|(a, b)| a - b));
        let forces = largest(&mut gap.iter().copied());
        let sifs = largest(&mut (0..influence.rows()).map(|i| dot(influence.row(i), &gap)));
        let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
        relative(jumps, self.scale[0]).max(relative(forces, self.scale[1])).max(relative(sifs, self.scale[2]))
    }
}

//! Semismooth Newton method (primal–dual active set) for the contact conditions.

use super::pressure::demanded as demanded_pocket;
use super::problem::ROUND_OFF;
use super::wheel_surface::SURFACE_ROUND_OFF;
use super::{
    ContactSolver, FaceProblem, FaceResponse, FaceScale, FaceSolution, LoadStep, NotConverged, PocketState,
    PointStatus, StepSolver,
};

/// Semismooth Newton: every point that violates the conditions of its status changes its status,
/// until no point does; the contact conditions then hold exactly. The iteration starts from the
/// statuses of the previous step, so that most steps take one or two solutions of small updated
/// systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Newton {
    /// Largest number of iterations in a step.
    pub max_iterations: usize,
}

impl Default for Newton {
    fn default() -> Self {
        Self { max_iterations: 200 }
    }
}

impl ContactSolver for Newton {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a> {
        Box::new(NewtonSteps { problem, max_iterations: self.max_iterations, scale: FaceScale::NONE })
    }
}

/// Number of iterations in which all points change at once; after these the worst point is changed
/// alone, which breaks cycles.
const SIMULTANEOUS: usize = 12;
/// Number of iterations in which pockets of fluid change their status; after these the contact is
/// solved with fixed pocket statuses, and the next load step continues from there.
const FOLLOWING_POCKETS: usize = 24;

struct NewtonSteps<'a> {
    problem: &'a FaceProblem<'a>,
    max_iterations: usize,
    /// Largest jump and force of the solutions so far, for round-off.
    scale: FaceScale,
}

/// The status that the contact conditions require of `point`, and the violation of its present
/// status relative to round-off.
fn demanded(
    problem: &FaceProblem,
    faces: &FaceResponse,
    scale: FaceScale,
    point: usize,
    reference: f64,
) -> Option<(PointStatus, f64)> {
    let solution = faces.solution();
    let (tangential, normal) = (solution.contact[2 * point], solution.contact[2 * point + 1]);
    let (slip, opening) = (solution.jump[2 * point], solution.jump[2 * point + 1]);
    let mu = problem.friction(point);
    let FaceScale { jump: jump_scale, force: force_scale } = scale;
    let status = solution.status[point];
    if status == PointStatus::Open {
        let after = PointStatus::of_touching(slip - reference, -opening, mu);
        return (opening < -ROUND_OFF * jump_scale).then(|| (after, -opening / jump_scale));
    }
    if normal < -ROUND_OFF * force_scale {
        return Some((PointStatus::Open, -normal / force_scale));
    }
    if status == PointStatus::Stick {
        let excess = tangential.abs() - mu * normal;
        // Friction opposes slip: a force on the + face towards −x1 means slip towards +x1.
        let slipping = if tangential < 0.0 { PointStatus::SlipForward } else { PointStatus::SlipBackward };
        return (excess > ROUND_OFF * force_scale || mu == 0.0).then(|| (slipping, excess / force_scale));
    }
    let against = -(slip - reference) * status.direction();
    (mu > 0.0 && against > ROUND_OFF * jump_scale).then(|| (PointStatus::Stick, against / jump_scale))
}

/// The surface nodes of a coupled wheel whose contact conditions require another status, that
/// status (pressed against the wheel or not), and the violation of the present one relative to the
/// pressures and gaps of the wheel.
fn demanded_nodes(problem: &FaceProblem, solution: &FaceSolution) -> Vec<(usize, bool, f64)> {
    let Some(wheel) = problem.wheel() else { return Vec::new() };
    let (pressure, gap) = wheel.scales();
    let demand = |(node, &loaded): (usize, &bool)| {
        let i = wheel.component(node);
        let by = match loaded {
            true => -solution.jump[i] / pressure,
            false => -solution.contact[i] / gap,
        };
        (by > SURFACE_ROUND_OFF).then_some((node, !loaded, by))
    };
    solution.loaded.iter().enumerate().filter_map(demand).collect()
}

impl<'a> StepSolver<'a> for NewtonSteps<'a> {
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        let points = self.problem.points();
        // If no held slip changes, the predicted jumps are those of the first iteration.
        let mut in_equilibrium = true;
        for (point, &reference) in step.reference_slip.iter().enumerate() {
            let held = faces.solution().status[point] == PointStatus::Stick;
            if held && faces.solution().jump[2 * point] != reference {
                faces.set_status(point, PointStatus::Stick, reference);
                in_equilibrium = false;
            }
        }
        let mut worst = f64::INFINITY;
        for iteration in 1..=self.max_iterations {
            if !in_equilibrium && faces.equilibrate_again().is_err() {
                return Err(NotConverged { iterations: iteration, indicator: worst, tolerance: ROUND_OFF });
            }
            let scale = self.scale.including(faces.solution(), step.forces);
            let demands: Vec<(usize, PointStatus, f64)> = (0..points)
                .filter_map(|j| {
                    demanded(self.problem, faces, scale, j, step.reference_slip[j])
                        .map(|(status, by)| (j, status, by))
                })
                .collect();
            let pockets_change = iteration <= FOLLOWING_POCKETS && self.follow_pockets(step, faces, scale);
            let nodes = demanded_nodes(self.problem, faces.solution());
            if !pockets_change && demands.is_empty() && nodes.is_empty() {
                self.scale = scale;
                return Ok(iteration);
            }
            worst = demands.iter().fold(0.0, |w, d| w.max(d.2));
            let worst_node = nodes.iter().fold(0.0f64, |w, node| w.max(node.2));
            if iteration > SIMULTANEOUS && worst_node > worst {
                worst = worst_node;
                if let Some(&(node, loaded, _)) = nodes.iter().find(|node| node.2 == worst_node) {
                    faces.set_loaded(node, loaded);
                }
                in_equilibrium = false;
                continue;
            }
            if iteration <= SIMULTANEOUS {
                nodes.iter().for_each(|&(node, loaded, _)| faces.set_loaded(node, loaded));
            }
            if iteration > SIMULTANEOUS
                && let Some(&(point, status, _)) = demands.iter().find(|demand| demand.2 == worst)
            {
                in_equilibrium = self.settle(step, faces, scale, (point, status)) && !pockets_change;
            } else {
                for (point, status, _) in demands {
                    faces.set_status(point, status, step.reference_slip[point]);
                }
                in_equilibrium = false;
            }
        }
        Err(NotConverged { iterations: self.max_iterations, indicator: worst, tolerance: ROUND_OFF })
    }

    fn keep(&mut self) {}

    fn restore(&mut self) {}
}

impl<'a> NewtonSteps<'a> {
    /// Gives every pocket the status required by its conditions; returns whether any status has
    /// changed.
    fn follow_pockets(&self, step: LoadStep, faces: &mut FaceResponse<'a>, scale: FaceScale) -> bool {
        let mut changed = false;
        for k in 0..step.outside.len() {
            let solution = faces.solution();
            let state = solution.fluid[k];
            let Some(status) = demanded_pocket(self.problem, solution, scale, k) else { continue };
            faces.set_pocket(k, PocketState { status, ..state });
            changed = true;
        }
        changed
    }

    /// Gives `point` the status that fulfils its contact conditions while all other points keep
    /// theirs, or `wanted` if there is none; returns whether `faces` are then in equilibrium.
    ///
    /// The status that the conditions require next may violate them: where friction closes a point
    /// by more than its pressure opens it, the point may penetrate when it is open and be pulled
    /// when it slips, and has to stick.
    fn settle(
        &self,
        step: LoadStep,
        faces: &mut FaceResponse<'a>,
        scale: FaceScale,
        (point, wanted): (usize, PointStatus),
    ) -> bool {
        use PointStatus::{Open, SlipBackward, SlipForward, Stick};
        let before = faces.solution().status[point];
        let reference = step.reference_slip[point];
        let others = [Stick, SlipForward, SlipBackward, Open].into_iter();
        for status in [wanted].into_iter().chain(others.filter(|&s| s != wanted && s != before)) {
            faces.set_status(point, status, reference);
            let solved = faces.equilibrate_again().is_ok();
            if solved && demanded(self.problem, faces, scale, point, reference).is_none() {
                return true;
            }
        }
        faces.set_status(point, wanted, reference);
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::fixtures::one_point;

    #[test]
    fn a_point_that_can_neither_open_nor_slip_sticks() {
        // Slip forward with friction 2 opens the point by 2 · 0.9 times what its pressure opens it:
        // more pressure closes it.
        let body = one_point(1.0, 0.9);
        let problem = FaceProblem::new(&body, &[2.0]).unwrap();
        // The free jumps (3, −1): the point has slipped beyond the place where it touches, and
        // penetrates.
        let forces = body.stiffness.times(&[3.0, -1.0]);
        let mut faces = FaceResponse::virgin(&problem);
        faces.set_status(0, PointStatus::Open, 0.0);
        faces.load(&forces);
        faces.equilibrate().unwrap();
        let step = LoadStep { forces: &forces, reference_slip: &[0.0], outside: &[] };
        Newton::default().prepare(&problem).solve(step, &mut faces).unwrap();
        let solution = faces.solution();
        assert_eq!(solution.status, [PointStatus::Stick]);
        assert_eq!(solution.jump, [0.0, 0.0]);
        assert!((solution.contact[0] + 3.9 / 0.19).abs() < 1e-12);
        assert!((solution.contact[1] - 3.7 / 0.19).abs() < 1e-12);
    }
}

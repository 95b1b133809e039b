//! A coupled wheel eliminated from the equations of the faces, for the LATIN method.

use super::tableau::FaceRate;
use super::wheel_surface::{SURFACE_ROUND_OFF, SurfaceSystem};
use super::{FaceSolution, Pocket};
use crate::linear::general_inverse;
use crate::math::{Matrix, dot};

/// The faces under a coupled wheel for a fixed set of surface nodes in contact: their pressures
/// are linear in the jumps, q = q0 − G w, so that the faces see A + P G and the load L + P q0.
pub(super) struct ReducedWheel {
    /// Whether each node is in contact.
    pub loaded: Vec<bool>,
    /// (A + P G + k⁻)⁻¹.
    pub global: Matrix,
    /// Jumps of the global stage for a unit pressure of each pocket of fluid.
    pub units: Vec<FaceRate>,
    /// Components of the nodes in contact and of the approach.
    components: Vec<usize>,
    /// Inverse of their equations.
    inverse: Matrix,
    /// Matrix of all components of the wheel (rows) and all components (columns).
    rows: Matrix,
    /// P: forces on the faces (rows) of the components in contact.
    forces: Matrix,
    faces: usize,
}

/// Multiple of the round-off of pressures and gaps at which a node changes its status; the jumps
/// are those of an iteration.
const TOLERANT: f64 = 1e3;

impl ReducedWheel {
    /// The faces of the `stiffness` A with the nodes `loaded` of `wheel` in contact; `direction`
    /// is k⁻, and fluid is in the `pockets`. `None` for conditions that do not determine the
    /// pressures.
    pub(super) fn new(
        wheel: &SurfaceSystem,
        stiffness: &Matrix,
        loaded: Vec<bool>,
        (direction, pockets): (&[f64], &[Pocket]),
    ) -> Option<Self> {
        let faces = stiffness.rows();
        let columns = &wheel.columns;
        let in_contact = (0..wheel.nodes()).filter(|&node| loaded[node]).map(|node| wheel.component(node));
        let components: Vec<usize> = in_contact.chain([wheel.approach()]).collect();
        let k = components.len();
        let own = Matrix::from_fn(k, k, |i, j| columns[(components[j], components[i])]);
        let inverse = general_inverse(&own).ok()?;
        let rows = Matrix::from_fn(columns.rows() - faces, columns.rows(), |i, j| columns[(j, faces + i)]);
        let forces = Matrix::from_fn(faces, k, |i, j| columns[(components[j], i)]);
        // G, by columns: pressures for a unit of each jump.
        let measured = Matrix::from_fn(faces, k, |j, i| columns[(j, components[i])]);
        let mut effective = Matrix::zeros(faces, faces);
        for j in 0..faces {
            let pressures = inverse.times(measured.row(j));
            for i in 0..faces {
                effective[(i, j)] = stiffness[(i, j)] - dot(forces.row(i), &pressures);
            }
            effective[(j, j)] += direction[j];
        }
        let global = general_inverse(&effective).ok()?;
        let unit = |pocket: &Pocket| FaceRate {
            jump: global.times(&pocket.unit[..faces]),
            contact: vec![0.0; faces],
        };
        let units = pockets.iter().map(unit).collect();
        Some(Self { loaded, global, units, components, inverse, rows, forces, faces })
    }

    /// Values of the components in contact under `load` with the jumps `jump` (mm, 2p).
    fn values(&self, load: &[f64], jump: &[f64]) -> Vec<f64> {
        let right: Vec<f64> = self
            .components
            .iter()
            .map(|&i| load[i] - dot(&self.rows.row(i - self.faces)[..self.faces], jump))
            .collect();
        self.inverse.times(&right)
    }

    /// The nodal forces on the faces (N/mm, 2p) in `load` with those of the pressures at zero
    /// jumps.
    pub(super) fn forces(&self, load: &[f64]) -> Vec<f64> {
        let values = self.values(load, &vec![0.0; self.faces]);
        (0..self.faces).map(|i| load[i] - dot(self.forces.row(i), &values)).collect()
    }

    /// Adds the pressures, the gaps and the approach to `solution`, which has the jumps under
    /// `load`.
    pub(super) fn complete(&self, load: &[f64], solution: &mut FaceSolution) {
        let values = self.values(load, &solution.jump[..self.faces]);
        solution.jump[self.faces..].fill(0.0);
        for (&component, value) in self.components.iter().zip(values) {
            solution.jump[component] = value;
        }
        for i in self.faces..solution.contact.len() {
            solution.contact[i] = dot(self.rows.row(i - self.faces), &solution.jump) - load[i];
        }
        for &component in &self.components {
            solution.contact[component] = 0.0;
        }
        solution.loaded.clone_from(&self.loaded);
    }

    /// The nodes whose contact conditions `solution` violates, with their next status.
    pub(super) fn demanded(&self, wheel: &SurfaceSystem, solution: &FaceSolution) -> Vec<(usize, bool)> {
        let (pressure, gap) = wheel.scales();
        let small = TOLERANT * SURFACE_ROUND_OFF;
        let demand = |(node, &loaded): (usize, &bool)| {
            let i = wheel.component(node);
            let wrong = match loaded {
                true => solution.jump[i] < -small * pressure,
                false => solution.contact[i] < -small * gap,
            };
            wrong.then_some((node, !loaded))
        };
        self.loaded.iter().enumerate().filter_map(demand).collect()
    }
}

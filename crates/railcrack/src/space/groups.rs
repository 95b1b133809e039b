//! Cracks in space in groups, each crack with those to which it is strongly coupled, and the forces
//! between groups.

use super::body::SpaceBody;
use super::shape::SpaceError;
use crate::growth::KEPT;
use crate::interruption::Interruption;
use crate::linear::{LinearError, coupling, product, spd_inverse_unless};
use crate::math::{Matrix, Track};
use rayon::prelude::*;

/// Coupling above which two cracks are solved for together, as the root of the sum of squared
/// correlations of their jumps.
const STRONG: f64 = 0.3;

/// A crack together with those to which it is strongly coupled.
#[derive(Debug, Clone)]
pub(super) struct CrackGroup {
    /// The cracks (from 0), in their order.
    pub members: Vec<usize>,
    /// The place among them of the crack whose results count.
    pub own: usize,
    /// The members alone.
    pub body: SpaceBody,
}

/// Groups around every crack of `body`.
///
/// Errors: cracks whose A is not positive definite; the interruption.
pub(super) fn groups(
    body: &SpaceBody,
    interruption: Interruption<'_>,
) -> Result<Vec<CrackGroup>, SpaceError> {
    let count = body.cracks().len();
    let alone = |k: usize| {
        spd_inverse_unless(interruption, &body.stiffness_between([k, k])).map_err(|error| match error {
            LinearError::NotPositiveDefinite { .. } => {
                SpaceError::TooCoarse { crack: k, shape: Box::new(body.cracks()[k].shape.clone()) }
            }
            error => error.into(),
        })
    };
    let alone: Vec<Matrix> = (0..count).into_par_iter().map(alone).collect::<Result<_, _>>()?;
    let pairs: Vec<[usize; 2]> = (0..count).flat_map(|k| (0..k).map(move |l| [l, k])).collect();
    let is_strong = |&[l, k]: &[usize; 2]| -> Result<bool, SpaceError> {
        interruption.check()?;
        let coupling = coupling(&alone[l], &body.stiffness_between([l, k]), &alone[k])?;
        Ok(coupling >= STRONG)
    };
    let strong: Vec<bool> = pairs.par_iter().map(is_strong).collect::<Result<_, _>>()?;
    let group = |k: usize| {
        let coupled = |[one, other]: [usize; 2]| match k {
            _ if k == one => Some(other),
            _ if k == other => Some(one),
            _ => None,
        };
        let mut members: Vec<usize> = pairs
            .iter()
            .zip(&strong)
            .filter(|(_, strong)| **strong)
            .filter_map(|(pair, _)| coupled(*pair))
            .collect();
        members.push(k);
        members.sort_unstable();
        let own = members.iter().position(|&member| member == k).unwrap_or(0);
        Ok(CrackGroup { own, body: body.part(&members, interruption)?, members })
    };
    (0..count).into_par_iter().map(group).collect()
}

/// Values at the points of cracks during a passage: without the wheel, before and after it, and by
/// position of the wheel.
#[derive(Debug, Clone)]
pub(super) struct Passing {
    pub unloaded: [Vec<f64>; 2],
    pub over: Track,
}

impl Passing {
    /// Few of the jumps (mm, 3p) before the passage, at each position (mm) and after the passage.
    pub fn of(before: Vec<f64>, samples: &[(f64, Vec<f64>)], after: Vec<f64>) -> Self {
        let largest = samples.iter().flat_map(|(_, jumps)| jumps).fold(0.0f64, |most, w| most.max(w.abs()));
        Self { unloaded: [before, after], over: Track::thinned(samples, KEPT * largest) }
    }

    /// The same with every second position.
    pub fn halved(&self) -> Self {
        Self { over: self.over.halved(), ..self.clone() }
    }
}

/// Nodal forces on the members of a group by all other cracks.
pub(super) struct OutsideForces {
    by_crack: Vec<Passing>,
    unknowns: usize,
}

impl OutsideForces {
    /// The forces on `group` of `body` by the jumps of all cracks in a passage.
    ///
    /// Errors: matrices whose shapes do not match.
    pub fn on(body: &SpaceBody, group: &CrackGroup, jumps: &[Passing]) -> Result<Self, LinearError> {
        let outside = (0..jumps.len()).filter(|crack| !group.members.contains(crack));
        let of = |crack: usize| {
            let block = body.stiffness_towards(crack, &group.members);
            let forces = |jumps: &Matrix| {
                let mut forces = product(jumps, &block)?;
                forces.entries_mut().iter_mut().for_each(|force| *force = -*force);
                Ok::<_, LinearError>(forces)
            };
            let Passing { unloaded: [before, after], over } = &jumps[crack];
            let rows = Matrix::from_fn(2, before.len(), |i, c| [before, after][i][c]);
            let unloaded = forces(&rows)?;
            let over = Track::new(over.at().to_vec(), forces(over.values())?);
            Ok(Passing { unloaded: [0, 1].map(|i| unloaded.row(i).to_vec()), over })
        };
        let unknowns = 3 * group.body.points().len();
        Ok(Self { by_crack: outside.map(of).collect::<Result<_, LinearError>>()?, unknowns })
    }

    /// Adds the forces (N) before (0) or after (1) the passage.
    pub fn add_unloaded(&self, end: usize, forces: &mut [f64]) {
        for passing in &self.by_crack {
            forces.iter_mut().zip(&passing.unloaded[end]).for_each(|(sum, force)| *sum += force);
        }
    }

    /// Adds the forces (N) with the wheel at `position` (mm).
    pub fn add(&self, position: f64, forces: &mut [f64]) {
        self.by_crack.iter().for_each(|passing| passing.over.add(position, forces));
    }

    /// The forces (N) at each of `positions` (mm), a row for each.
    pub fn at(&self, positions: &[f64]) -> Matrix {
        let mut forces = Matrix::zeros(positions.len(), self.unknowns);
        for (k, &position) in positions.iter().enumerate() {
            self.add(position, forces.row_mut(k));
        }
        forces
    }
}

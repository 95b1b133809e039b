//! Forces between cracks that are followed in separate groups.

use super::face_load::LoadPhase;
use super::groups::Group;
use crate::body::BlockStiffness;
use crate::linear::{LinearError, add_product, product};
use crate::math::{Matrix, Track};
use rayon::prelude::*;

/// The jumps of the faces of a unit (mm) in each phase of the load path.
pub(super) type History = Vec<(LoadPhase, Track)>;

/// The jumps of all units during a leg, and the forces of the distant ones.
pub(super) struct Exchange<'a> {
    blocks: &'a BlockStiffness,
    groups: &'a [Group],
    histories: &'a [History],
    /// Forces (N/mm) on each unit from all units that are not near it.
    far: Vec<History>,
}

impl<'a> Exchange<'a> {
    /// The exchange between units with these `histories`; far forces are given at the coordinates
    /// `nodes(unit)` of each phase.
    ///
    /// Errors: matrices whose shapes do not match.
    pub fn new(
        blocks: &'a BlockStiffness,
        groups: &'a [Group],
        histories: &'a [History],
        nodes: &(dyn Fn(usize) -> Vec<Vec<f64>> + Sync),
    ) -> Result<Self, LinearError> {
        let amplitudes: Vec<History> = histories
            .par_iter()
            .zip(&blocks.far.moments)
            .map(|(history, moments)| {
                let amplitude = |(part, track): &(LoadPhase, Track)| {
                    Ok((*part, Track::new(track.at().to_vec(), product(track.values(), moments)?)))
                };
                history.iter().map(amplitude).collect()
            })
            .collect::<Result<_, LinearError>>()?;
        let far = |k: usize| far_forces(blocks, &amplitudes, k, &nodes(k));
        let far = (0..groups.len()).into_par_iter().map(far).collect::<Result<_, _>>()?;
        Ok(Self { blocks, groups, histories, far })
    }

    /// The forces (N/mm) on group `k` due to the jumps of all units that are not its members, at
    /// the coordinates `nodes` of each phase and at those at which the nearest of these units store
    /// their jumps.
    ///
    /// Errors: matrices whose shapes do not match.
    pub fn forces_on(&self, k: usize, nodes: Vec<Vec<f64>>) -> Result<History, LinearError> {
        let nodes = self.with_kept(k, nodes);
        forces_on(self.blocks, &self.groups[k], (self.histories, &self.far), &nodes)
    }

    /// The forces of distant units on group `k` at the coordinates `nodes` of each phase.
    pub fn far_forces_on(&self, k: usize, nodes: &[Vec<f64>]) -> Vec<Matrix> {
        let members = &self.groups[k].members;
        let on_part = |(i, nodes): (usize, &Vec<f64>)| {
            side_by_side(members.iter().map(|&m| self.far[m][i].1.resampled(nodes)).collect())
        };
        nodes.iter().enumerate().map(on_part).collect()
    }

    /// The coordinates `nodes`, together with those at which units coupled to members of group `k`
    /// store their jumps.
    fn with_kept(&self, k: usize, mut nodes: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let members = &self.groups[k].members;
        let leaning = members.iter().flat_map(|&m| self.groups[m].members.iter().copied());
        let mut givers: Vec<usize> = leaning.filter(|l| !members.contains(l)).collect();
        givers.sort_unstable();
        givers.dedup();
        for (i, nodes) in nodes.iter_mut().enumerate() {
            let travel = nodes[nodes.len() - 1] - nodes[0];
            givers.iter().for_each(|&l| nodes.extend(self.histories[l][i].1.at()));
            nodes.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
            nodes.dedup();
        }
        nodes
    }
}

/// The forces on unit `k` from all units that are not near it.
fn far_forces(
    blocks: &BlockStiffness,
    amplitudes: &[History],
    k: usize,
    nodes: &[Vec<f64>],
) -> Result<History, LinearError> {
    let moments = &blocks.far.moments[k];
    let outwards = moments.transposed();
    let on_part = |(i, (part, _)): (usize, &(LoadPhase, Track))| {
        let mut sum = Matrix::zeros(nodes[i].len(), moments.columns());
        for (l, between) in &blocks.far.between[k] {
            add_product(-1.0, &amplitudes[*l][i].1.resampled(&nodes[i]), &between.transposed(), &mut sum)?;
        }
        Ok((*part, Track::new(nodes[i].clone(), product(&sum, &outwards)?)))
    };
    amplitudes[k].iter().enumerate().map(on_part).collect()
}

fn forces_on(
    blocks: &BlockStiffness,
    group: &Group,
    (histories, far): (&[History], &[History]),
    nodes: &[Vec<f64>],
) -> Result<History, LinearError> {
    let parts = nodes.iter().enumerate().map(|(i, nodes)| {
        let on_member = |&m: &usize| {
            let mut forces = far[m][i].1.resampled(nodes);
            for (l, _) in blocks.near[m].iter().filter(|(l, _)| !group.members.contains(l)) {
                if let Some(block) = blocks.near_block(*l, m) {
                    add_product(-1.0, &histories[*l][i].1.resampled(nodes), block, &mut forces)?;
                }
            }
            Ok(forces)
        };
        let of_members = group.members.iter().map(on_member).collect::<Result<_, LinearError>>()?;
        Ok((histories[group.members[0]][i].0, Track::new(nodes.clone(), side_by_side(of_members))))
    });
    parts.collect()
}

/// The columns of all `parts`, which have the same number of rows.
fn side_by_side(parts: Vec<Matrix>) -> Matrix {
    let rows = parts.first().map_or(0, Matrix::rows);
    let mut all = Matrix::zeros(rows, parts.iter().map(Matrix::columns).sum());
    let mut first = 0;
    for part in parts {
        for row in 0..rows {
            all.row_mut(row)[first..first + part.columns()].copy_from_slice(part.row(row));
        }
        first += part.columns();
    }
    all
}

//! Cracks that are followed in groups, and the forces between the groups.

use super::face_load::LoadPhase;
use crate::body::{BlockStiffness, CrackedBody, RowPart, TipGain};
use crate::contact::{FaceFluid, FaceProblem, Pocket, PocketMouth};
use crate::linear::{LinearError, add_product, coupling, product, spd_inverse};
use crate::math::{Matrix, Track};
use rayon::prelude::*;
use std::ops::Range;

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

/// Coupling above which two units are followed together, as the root of the sum of squared
/// correlations of their jumps.
const STRONG: f64 = 0.5;

/// A unit of a row together with those to which it is strongly coupled.
pub(super) struct Group {
    /// The units, in their order along the row.
    pub members: Vec<usize>,
    pub body: CrackedBody,
    /// Friction of its cracks.
    pub friction: Vec<f64>,
    /// Fluid in its cracks, if there is any in the row.
    pub fluid: Option<FaceFluid>,
    /// Points in the body that belong to the group's own unit, whose results count.
    pub own_points: Range<usize>,
    /// Tips of that unit: their numbers in the row and in the body.
    pub own_tips: Vec<(usize, usize)>,
    /// Ends of the faces of all members along the rail, mm.
    pub extent: (f64, f64),
}

/// Groups around every unit of `blocks`.
///
/// Errors: cracks whose A is not positive definite.
pub(super) fn groups(problem: &FaceProblem, blocks: &BlockStiffness) -> Result<Vec<Group>, LinearError> {
    let count = blocks.units.len();
    let alone = |k: usize| match blocks.near_block(k, k) {
        Some(own) => spd_inverse(own),
        None => Ok(Matrix::zeros(0, 0)),
    };
    let alone: Vec<Matrix> = (0..count).into_par_iter().map(alone).collect::<Result<_, _>>()?;
    let members = |k: usize| -> Result<Vec<usize>, LinearError> {
        let mut members = Vec::new();
        for (l, block) in &blocks.near[k] {
            if *l == k || coupling(&alone[k], block, &alone[*l])? >= STRONG {
                members.push(*l);
            }
        }
        Ok(members)
    };
    let group = |k: usize| group(problem, blocks, k, members(k)?);
    (0..count).into_par_iter().map(group).collect()
}

fn group(
    problem: &FaceProblem,
    blocks: &BlockStiffness,
    own: usize,
    members: Vec<usize>,
) -> Result<Group, LinearError> {
    let row = problem.body();
    let part = blocks.part(&row.faces, &row.tips, &members);
    let RowPart { faces, tips, gains, stiffness, points, cracks, tip_numbers } = part;
    let compliance = spd_inverse(&stiffness)?;
    let before: usize = members.iter().take_while(|&&k| k != own).map(|&k| blocks.units[k].len()).sum();
    let own_points = before..before + blocks.units[own].len();
    let on_own = |crack: usize| faces.points[own_points.clone()].iter().any(|point| point.crack == crack);
    let is_own = |(tip, _): &(usize, usize)| on_own(tips[*tip].crack);
    let numbers = tip_numbers.iter().copied().enumerate();
    let own_tips = numbers.filter(is_own).map(|(tip, number)| (number, tip)).collect();
    let friction = |&crack: &usize| {
        let point = points.iter().find(|&&p| row.faces.points[p].crack == crack);
        point.map_or(0.0, |&p| problem.friction(p))
    };
    let friction = cracks.iter().map(friction).collect();
    let fluid = problem.fluid().map(|fluid| FaceFluid {
        model: fluid.model,
        pockets: fluid.pockets.iter().filter_map(|pocket| in_part(pocket, &points, &cracks)).collect(),
    });
    let ends = members.iter().map(|&k| blocks.extents[k]);
    let extent = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |all, e| (all.0.min(e.0), all.1.max(e.1)));
    let influence = TipGain::sif_influence(&gains, &compliance);
    let body = CrackedBody::new(faces, tips, [compliance, stiffness, influence]);
    Ok(Group { members, body, friction, fluid, own_points, own_tips, extent })
}

/// `pocket` on the face points `points` of a part with `cracks`; none where the pocket is not in
/// the part. A unit holds all cracks that are connected, so that a pocket is in it or not.
fn in_part(pocket: &Pocket, points: &[usize], cracks: &[usize]) -> Option<Pocket> {
    let local = |point: usize| points.iter().position(|&own| own == point);
    let forces = |whole: &[f64]| points.iter().flat_map(|&p| [whole[2 * p], whole[2 * p + 1]]).collect();
    let crack = |crack: &usize| cracks.iter().position(|own| own == crack);
    let mouth = match pocket.mouth {
        Some(mouth) => Some(PocketMouth { point: local(mouth.point)?, ..mouth }),
        None => None,
    };
    let pairs = pocket.neighbours.iter().map(|&(one, other)| Some((local(one)?, local(other)?)));
    Some(Pocket {
        cracks: pocket.cracks.iter().map(crack).collect::<Option<_>>()?,
        unit: forces(&pocket.unit),
        profile: forces(&pocket.profile),
        mouth,
        points: pocket.points.iter().map(|&point| local(point)).collect::<Option<_>>()?,
        neighbours: pairs.collect::<Option<_>>()?,
    })
}

/// Distance of the wheel from a group, relative to a, up to which the group is followed in short
/// steps and to every output position.
const REACH: f64 = 4.0;
/// Length of these steps, relative to a. With twice this length, the error of K in rows at random
/// spacing is 0.2 to 0.5 % instead of 0.06 %.
const STEP: f64 = 0.03;
/// Beyond that distance, steps grow by this share of the distance.
const GRADING: f64 = 0.07;
/// Positions closer than this share of a step are merged.
const CLOSE: f64 = 0.2;

/// Positions (mm) between the first and the last of `outputs` for faces from `extent.0` to
/// `extent.1` under a contact of `half_width`, in the order of travel: first those at which forces
/// are exchanged, including `edges`, then all positions.
pub(super) fn stations(
    outputs: &[f64],
    edges: &[f64],
    extent: (f64, f64),
    half_width: f64,
) -> (Vec<f64>, Vec<f64>) {
    let (first, last) = (outputs[0], outputs[outputs.len() - 1]);
    let travel = (last - first).signum();
    let beyond = |x: f64| (extent.0 - x).max(x - extent.1) - REACH * half_width;
    let step = |x: f64| STEP * half_width + GRADING * beyond(x).max(0.0);
    let mut nodes = vec![first];
    loop {
        let x = nodes[nodes.len() - 1];
        let next = x + travel * step(x);
        if (last - next) * travel <= 0.5 * step(next) {
            break;
        }
        nodes.push(next);
    }
    if last != first {
        nodes.push(last);
    }
    nodes.extend(edges.iter().filter(|x| (**x - first) * travel > 0.0 && (last - **x) * travel > 0.0));
    nodes.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
    nodes.dedup();
    let ends = [0, outputs.len() - 1];
    let near = outputs.iter().enumerate().filter(|(i, x)| ends.contains(i) || beyond(**x) <= 0.0);
    let mut all: Vec<f64> = near.map(|(_, x)| *x).collect();
    let close = CLOSE * STEP * half_width;
    let apart = |x: &&f64| edges.contains(x) || all.iter().all(|output| (output - **x).abs() > close);
    let added: Vec<f64> = nodes.iter().filter(apart).copied().collect();
    all.extend(added);
    all.sort_by(|a, b| (a * travel).total_cmp(&(b * travel)));
    all.dedup();
    (nodes, all)
}

/// Interpolation weights of the values at `stations` for the position `x`: a cubic through the four
/// stations around it, or the single station at `x`.
pub(super) fn weights(stations: &[f64], x: f64) -> Vec<(usize, f64)> {
    if let Some(hit) = stations.iter().position(|&station| station == x) {
        return vec![(hit, 1.0)];
    }
    let count = stations.len();
    let travel = stations[count - 1] - stations[0];
    let after = stations.partition_point(|station| (station - x) * travel < 0.0);
    let first = after.saturating_sub(2).min(count.saturating_sub(4));
    let chosen = first..(first + 4).min(count);
    let weight = |i: usize| {
        let others = chosen.clone().filter(|&j| j != i);
        others.map(|j| (x - stations[j]) / (stations[i] - stations[j])).product()
    };
    chosen.clone().map(|i| (i, weight(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_dense_around_the_faces_and_end_where_the_passage_does() {
        let there: Vec<f64> = (0..=100).map(|i| -50.0 + 5.0 * f64::from(i)).collect();
        let back: Vec<f64> = there.iter().rev().copied().collect();
        for outputs in [there, back] {
            let (nodes, all) = stations(&outputs, &[103.0], (100.0, 110.0), 6.0);
            for list in [&nodes, &all] {
                assert_eq!((list[0], list[list.len() - 1]), (outputs[0], outputs[100]));
            }
            let gaps = |list: &[f64], near: f64| {
                let pairs = list.windows(2).filter(|p| p.iter().all(|x| (x - 105.0).abs() < near));
                pairs.map(|p| (p[1] - p[0]).abs()).fold(0.0, f64::max)
            };
            assert!(gaps(&nodes, 29.0) < 0.181 && gaps(&all, 29.0) < 0.3);
            assert!(nodes.contains(&103.0) && all.contains(&103.0));
            assert!(nodes.len() < 480, "{}", nodes.len());
            assert!(outputs.iter().filter(|x| (**x - 105.0).abs() < 29.0).all(|x| all.contains(x)));
        }
    }

    #[test]
    fn a_cubic_is_interpolated_exactly() {
        let stations = [0.0, 1.0, 1.5, 3.0, 7.0];
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (0.5 - 0.1 * x));
        for x in [-0.5, 0.3, 1.2, 1.5, 2.0, 5.0] {
            let value: f64 = weights(&stations, x).iter().map(|(i, w)| w * cubic(stations[*i])).sum();
            assert!((value - cubic(x)).abs() < 1e-12, "{x}: {value}");
        }
    }
}

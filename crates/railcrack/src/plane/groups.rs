//! Groups of cracks that are followed together: each crack with those to which it is strongly
//! coupled.

use crate::body::{BlockStiffness, CrackedBody, RowPart, TipGain};
use crate::contact::{FaceFluid, FaceProblem, Pocket, PocketMouth};
use crate::linear::{LinearError, coupling, spd_inverse};
use crate::math::Matrix;
use rayon::prelude::*;
use std::ops::Range;

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

//! Cracks and loads that are symmetric about a plane along the rail.
//!
//! Where every crack is its own mirror image and the load is, too, the jumps at mirrored points
//! agree but for the sign of the slip along the trace. With P the map from the jumps of one half to
//! those of all points, the half has the stiffness PᵀAP and the nodal forces Pᵀf. The forces
//! between the faces are then the sums over both points of a pair; the contact conditions of a
//! point are homogeneous in its forces and hold for the sum as for each of the two. On the plane of
//! symmetry there is no slip along the trace.

use super::body::SpaceBody;
use super::face_matrix::FaceMatrix;
use super::linearised::FaceProblem;
use super::mirror_image::{SIGNS, images};
use super::plane::Symmetric;
use super::states::{SpaceFaces, SpaceStatus};
use crate::interruption::Interruption;
use crate::math::Matrix;

/// Difference of mirrored values, relative to the largest one, up to which they count as symmetric:
/// the residual of a converged contact step.
const SYMMETRIC: f64 = 1e-9;

/// Points at which symmetry of a load is tested, at every position of the wheel.
const PROBES: usize = 16;
/// Signs of the components of the mirrored stress.
const STRESS_SIGNS: Symmetric = [1.0, 1.0, 1.0, -1.0, 1.0, -1.0];

/// Whether all pairs of values at mirrored places agree; the second of each pair is mirrored
/// already.
pub(super) fn agree(pairs: &[[f64; 2]]) -> bool {
    let largest = pairs.iter().flatten().fold(0.0f64, |most, value| most.max(value.abs()));
    pairs.iter().all(|[one, other]| (one - other).abs() <= SYMMETRIC * largest)
}

/// A stress and the mirrored stress at the mirror image of its place, as pairs of values.
pub(super) fn mirrored_stresses(one: &Symmetric, image: &Symmetric) -> [[f64; 2]; 6] {
    std::array::from_fn(|k| [one[k], STRESS_SIGNS[k] * image[k]])
}

/// The points of cracks that are symmetric about a plane.
#[derive(Debug, Clone)]
pub(super) struct MirroredPoints {
    /// Lateral position of the plane of symmetry, mm.
    middle: f64,
    /// The points of one half, and the mirror image of each, which on the plane is itself.
    pairs: Vec<[usize; 2]>,
    /// Number of all points.
    points: usize,
}

/// One half of symmetric faces.
#[derive(Debug, Clone)]
pub(super) struct MirroredHalf {
    /// The points of the faces.
    pub points: MirroredPoints,
    stiffness: FaceMatrix,
    compliance: FaceMatrix,
    friction: Vec<f64>,
}

impl MirroredPoints {
    /// The points of `body`; none if a crack is not its own mirror image.
    pub fn of(body: &SpaceBody) -> Option<Self> {
        let (middle, pairs) = pairs(body)?;
        Some(Self { middle, pairs, points: body.points().len() })
    }

    /// Whether a place (x, lateral, depth) lies on that side of the plane whose forces give those
    /// of both by [`Self::with_mirrored_forces`].
    pub fn is_beyond(&self, [_, lateral, _]: [f64; 3]) -> bool {
        lateral > self.middle
    }

    /// The mirror image of a point: x, lateral and depth, mm.
    pub fn image(&self, [x, lateral, depth]: [f64; 3]) -> [f64; 3] {
        [x, 2.0 * self.middle - lateral, depth]
    }

    /// Points (mm) of the half at which symmetry of a load is tested. On the plane of symmetry the
    /// shear stress across it vanishes only to within the quadrature of the wheel's stress.
    pub fn probes(&self, body: &SpaceBody) -> Vec<[f64; 3]> {
        let apart: Vec<usize> =
            self.pairs.iter().filter(|[one, other]| one != other).map(|pair| pair[0]).collect();
        let every = apart.len().div_ceil(PROBES).max(1);
        apart.iter().step_by(every).map(|&point| body.points()[point]).collect()
    }

    /// Whether values (3p) are symmetric.
    pub fn is_symmetric(&self, values: &[f64]) -> bool {
        let of = |&[one, other]: &[usize; 2]| {
            std::array::from_fn::<_, 3, _>(|c| [values[3 * one + c], SIGNS[c] * values[3 * other + c]])
        };
        agree(&self.pairs.iter().flat_map(of).collect::<Vec<_>>())
    }

    /// All nodal forces (N, 3p), from those of the loads at one side of the plane alone.
    pub fn with_mirrored_forces(&self, mut forces: Vec<f64>) -> Vec<f64> {
        for &[one, other] in &self.pairs {
            for (c, sign) in SIGNS.into_iter().enumerate() {
                let (i, j) = (3 * one + c, 3 * other + c);
                let sum = forces[i] + sign * forces[j];
                (forces[i], forces[j]) = (sum, sign * sum);
            }
        }
        forces
    }
}

impl MirroredHalf {
    /// The half of the faces of `body` with the friction coefficient `friction` of each point; none
    /// if it cannot be inverted.
    pub fn of(body: &SpaceBody, points: MirroredPoints, friction: &[f64]) -> Option<Self> {
        let (stiffness, compliance) =
            even_parts(body, &points.pairs).or_else(|| half_matrices(body, &points.pairs))?;
        let friction = points.pairs.iter().map(|&[point, _]| friction[point]).collect();
        Some(Self { points, stiffness, compliance, friction })
    }

    /// The contact problem of the half.
    pub fn problem(&self) -> FaceProblem<'_> {
        FaceProblem { stiffness: &self.stiffness, compliance: &self.compliance, friction: &self.friction }
    }

    /// The jumps (mm) of the half, from all `jumps` (3p).
    pub fn jumps(&self, jumps: &[f64]) -> Vec<f64> {
        let of = |&[one, other]: &[usize; 2]| {
            std::array::from_fn::<_, 3, _>(|c| 0.5 * (jumps[3 * one + c] + SIGNS[c] * jumps[3 * other + c]))
        };
        self.points.pairs.iter().flat_map(of).collect()
    }

    /// The nodal forces (N) of the half, from all `forces` (3p).
    pub fn forces(&self, forces: &[f64]) -> Vec<f64> {
        let of = |&[one, other]: &[usize; 2]| {
            let both = if one == other { 0.5 } else { 1.0 };
            std::array::from_fn::<_, 3, _>(|c| {
                both * (forces[3 * one + c] + SIGNS[c] * forces[3 * other + c])
            })
        };
        self.points.pairs.iter().flat_map(of).collect()
    }

    /// All faces, from those of the half.
    pub fn whole(&self, half: SpaceFaces) -> SpaceFaces {
        let SpaceFaces { jumps, reactions, status, fluid } = half;
        let mut whole = SpaceFaces {
            jumps: vec![0.0; 3 * self.points.points],
            reactions: vec![0.0; 3 * self.points.points],
            status: vec![SpaceStatus::Stick; self.points.points],
            fluid,
        };
        for (k, &[one, other]) in self.points.pairs.iter().enumerate() {
            let share = if one == other { 1.0 } else { 0.5 };
            for (c, sign) in SIGNS.into_iter().enumerate() {
                let (jump, force) = (jumps[3 * k + c], share * reactions[3 * k + c]);
                (whole.jumps[3 * other + c], whole.reactions[3 * other + c]) = (sign * jump, sign * force);
                (whole.jumps[3 * one + c], whole.reactions[3 * one + c]) = (jump, force);
            }
            whole.status[other] = mirrored(status[k]);
            whole.status[one] = status[k];
        }
        whole
    }
}

fn mirrored(status: SpaceStatus) -> SpaceStatus {
    match status {
        SpaceStatus::Slip { direction: [dip, trace] } => SpaceStatus::Slip { direction: [dip, -trace] },
        other => other,
    }
}

/// The lateral position of the plane of symmetry, and the points of one half with their mirror
/// images in the same crack.
fn pairs(body: &SpaceBody) -> Option<(f64, Vec<[usize; 2]>)> {
    let middle = body.cracks().first()?.shape.middle[1];
    let mut pairs = Vec::with_capacity(body.points().len().div_ceil(2));
    for part in body.cracks() {
        let shape = &part.shape;
        if shape.strike != 0.0 || shape.middle[1] != middle {
            return None;
        }
        let first = part.points.start;
        let own: Vec<_> = part.points.clone().map(|point| part.coordinates(body.points()[point])).collect();
        let images = images(&own)?.into_iter().enumerate();
        pairs.extend(images.filter(|(one, other)| one <= other).map(|(i, j)| [first + i, first + j]));
    }
    Some((middle, pairs))
}

/// A and C of the half, of a single crack; none of several ones.
fn even_parts(body: &SpaceBody, pairs: &[[usize; 2]]) -> Option<(FaceMatrix, FaceMatrix)> {
    let [a, c] = [body.stiffness(), body.compliance()];
    // Forces of the half are sums over pairs.
    let stiffness = a.even_part(pairs, |weight| 1.0 / weight, |i| a.entry(i, i))?;
    let compliance = c.even_part(pairs, |weight| weight, |i| 1.0 / a.entry(i, i))?;
    Some((stiffness, compliance))
}

/// A and C of the half; none if A cannot be inverted.
fn half_matrices(body: &SpaceBody, pairs: &[[usize; 2]]) -> Option<(FaceMatrix, FaceMatrix)> {
    let stiffness = FaceMatrix::from(half_stiffness(body.stiffness(), pairs));
    let compliance = stiffness.inverse_unless(Interruption::NEVER).ok()?;
    Some((stiffness, compliance))
}

/// PᵀAP; slip along the trace on the plane of symmetry is kept apart, with its own stiffness.
fn half_stiffness(stiffness: &FaceMatrix, pairs: &[[usize; 2]]) -> Matrix {
    let order = 3 * pairs.len();
    let vanishes = |i: usize| i % 3 == 2 && pairs[i / 3][0] == pairs[i / 3][1];
    Matrix::from_fn(order, order, |i, j| {
        let ([a, image], [b, other]) = (pairs[i / 3], pairs[j / 3]);
        let (c, d) = (i % 3, j % 3);
        if vanishes(i) || vanishes(j) {
            return if i == j { stiffness.entry(3 * a + c, 3 * a + c) } else { 0.0 };
        }
        let mut sum = stiffness.entry(3 * a + c, 3 * b + d);
        if image != a {
            sum += SIGNS[c] * stiffness.entry(3 * image + c, 3 * b + d);
        }
        if other != b {
            sum += SIGNS[d] * stiffness.entry(3 * a + c, 3 * other + d);
        }
        if image != a && other != b {
            sum += SIGNS[c] * SIGNS[d] * stiffness.entry(3 * image + c, 3 * other + d);
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::IsotropicElastic;
    use crate::space::{SpaceCrack, SpaceResolution, Surroundings};

    #[test]
    fn the_half_is_the_even_part() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let crack = SpaceCrack::surface_breaking(0.4, 3.0, 2.0).unwrap();
        let of = |cracks: &[SpaceCrack]| {
            SpaceBody::new(cracks, &steel, Surroundings::HalfSpace, SpaceResolution::new(2, 3)).unwrap()
        };
        let body = of(std::slice::from_ref(&crack));
        let points = MirroredPoints::of(&body).unwrap();
        assert!(points.pairs.iter().any(|[one, other]| one == other));
        let (a, c) = even_parts(&body, &points.pairs).unwrap();
        let (stiffness, compliance) = half_matrices(&body, &points.pairs).unwrap();
        for (part, half) in [(a, stiffness), (c, compliance)] {
            let (part, half) = (part.to_matrix(), half.to_matrix());
            let largest = half.entries().iter().fold(0.0f64, |most, entry| most.max(entry.abs()));
            for (one, other) in part.entries().iter().zip(half.entries()) {
                assert!((one - other).abs() < 1e-13 * largest, "{one} {other}");
            }
        }
        let apart = of(&[crack.clone(), SpaceCrack { middle: [15.0, 0.0], ..crack }]);
        assert!(even_parts(&apart, &MirroredPoints::of(&apart).unwrap().pairs).is_none());
    }
}

//! A wheel over a rail: the search for their contacts.

use super::kik_piotrowski::{Gap, PatchPressure, ProfileContact};
use super::profile::{CurvePoint, Profile, RAIL_HEAD_DEPTH, Side, heights};
use crate::material::IsotropicElastic;
use crate::math::OutOfRange;
use thiserror::Error;

/// The place of a wheel over a rail.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelPosition {
    /// y of the origin of the wheel's profile in the frame of the rail's, mm.
    pub shift: f64,
    /// Angle of attack, rad: positive turns the travel +x towards +y.
    pub yaw: f64,
    /// Rotation about x, about the origin of the wheel's profile, rad: positive lowers +y.
    pub roll: f64,
}

/// Profiles of a wheel and a rail.
#[derive(Debug, Clone, Copy)]
pub struct ProfilePair<'a> {
    /// The rail.
    pub rail: &'a Profile,
    /// The wheel.
    pub wheel: &'a Profile,
    /// Rolling radius at z = 0 of the wheel's profile, mm.
    pub radius: f64,
    /// Place of the wheel.
    pub position: WheelPosition,
    /// Elasticity of both.
    pub steel: &'a IsotropicElastic,
}

/// Contacts that cannot be found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SearchError {
    /// The wheel is not above the rail.
    #[error(
        "the wheel is not above the rail head: with the shift its profile reaches from y = {from:.1} to {to:.1} mm, the head from {rail_from:.1} to {rail_to:.1} mm"
    )]
    Apart {
        /// mm.
        from: f64,
        /// mm.
        to: f64,
        /// mm.
        rail_from: f64,
        /// mm.
        rail_to: f64,
    },
    /// A contact at the end of a profile.
    #[error(
        "the wheel touches the rail at y = {y:.2} mm, at the end of one of the profiles: the profile must reach farther"
    )]
    AtEnd {
        /// On the rail, mm.
        y: f64,
    },
    /// A force or radius out of range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// More force than patches can carry.
    #[error(
        "no approach up to {most} mm carries the normal force of {normal:.0} N: the surfaces do not conform to contact patches"
    )]
    NoApproach {
        /// mm.
        most: f64,
        /// N.
        normal: f64,
    },
}

/// Distance of the places of the search, mm.
const STEP: f64 = 0.05;
/// Extent to either side of a contact point over which its gap is computed, mm.
const REACH: f64 = 20.0;
/// Largest approach, mm.
const MOST: f64 = 1.0;
/// Forces whose logarithms differ by less are the same.
const SAME_FORCE: f64 = 1e-9;
/// Parts of a profile steeper than this (cosine of the angle, 85°) touch nothing from above.
const STEEPEST: f64 = 0.087;
/// Largest slope of the wheel's radius times the yaw.
const LARGEST_TILT: f64 = 0.9;

/// A place where the gap has a minimum.
struct Candidate {
    /// Index of the place, and by how much it is farther from the wheel than the first contact, mm.
    place: usize,
    behind: f64,
    gap: Gap,
    contact: [f64; 4],
}

impl ProfilePair<'_> {
    /// The contacts under the normal force `normal` (N), the sum over all patches, from smaller to
    /// larger y.
    ///
    /// The wheel is a surface of revolution. With a yaw ψ its lowest contour over the rail has,
    /// from a point of the profile with radius R and R′ = dR/dy,
    ///
    /// x = −R R′ tan ψ,  y = y_w cos ψ − R R′ tan ψ sin ψ,  z = R √(1 − R′² tan² ψ),
    ///
    /// where the surface is parallel to the rail. Contact begins where its distance to the rail is
    /// least. Each patch lies in the tangent plane there; its gap is measured normal to this plane
    /// and its pressure follows from `PatchPressure`. All patches share the approach of the
    /// wheel, downwards, which the normal force fixes. When a patch spreads to another contact the
    /// force jumps; of a force within the jump, the patches are those of the side that is nearer to
    /// it, with their pressures scaled.
    ///
    /// Errors: no contact; a contact at the end of a profile; a force or radius out of range.
    pub fn contacts(&self, normal: f64) -> Result<Vec<ProfileContact>, SearchError> {
        OutOfRange::unless_positive("normal force (N)", normal)?;
        OutOfRange::unless_positive("wheel radius (mm)", self.radius)?;
        let (rail, wheel) = (self.rail_head(), self.lowest_contour());
        let candidates = self.candidates(&rail, &wheel)?;
        let (mut low, mut high) = (0.0, MOST);
        let total = |approach: f64| -> f64 {
            self.pressed(&candidates, approach).iter().map(|(_, own)| own.normal_force).sum()
        };
        if total(high) < normal {
            return Err(SearchError::NoApproach { most: MOST, normal });
        }
        // 50 halvings of a millimetre are round-off.
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if total(middle) < normal { low = middle } else { high = middle }
        }
        let contact = |(candidate, pressure): (&Candidate, PatchPressure)| {
            let [y, z, angle, ahead] = candidate.contact;
            pressure.contact([y, z], angle, ahead)
        };
        // Where a patch spreads the force jumps, and no approach carries a force within the jump:
        // then the patches of the nearer side carry it, their pressures scaled.
        let off = |total: f64| (total / normal).ln().abs();
        let carried = [total(low), total(high)];
        let (approach, carried) =
            if off(carried[0]) < off(carried[1]) { (low, carried[0]) } else { (high, carried[1]) };
        let mut contacts: Vec<ProfileContact> =
            self.pressed(&candidates, approach).into_iter().map(contact).collect();
        if off(carried) > SAME_FORCE {
            for own in &mut contacts {
                own.normal_force *= normal / carried;
                own.ellipse.peak_pressure *= normal / carried;
            }
        }
        contacts.sort_by(|a, b| a.y.total_cmp(&b.y));
        Ok(contacts)
    }

    fn rail_head(&self) -> Vec<CurvePoint> {
        let deepest = self.rail.top() + RAIL_HEAD_DEPTH;
        let head = self.rail.points().iter().filter(|point| point.at[1] < deepest);
        head.map(|point| CurvePoint { at: point.at, ahead: 0.0, radius: 0.0 }).collect()
    }

    /// The lowest contour of the wheel in the frame of the rail, its origin at z = 0.
    fn lowest_contour(&self) -> Vec<CurvePoint> {
        let WheelPosition { shift, yaw, roll } = self.position;
        let (tan, (sin, cos)) = (yaw.tan(), yaw.sin_cos());
        let (aside, upright) = roll.sin_cos();
        let of = |point: &super::profile::ProfilePoint| {
            let [dy, dz] = point.tangent;
            let size = dy.hypot(dz);
            if dy.abs() < STEEPEST * size {
                return None;
            }
            let tilt = dz / dy * tan;
            if tilt.abs() > LARGEST_TILT {
                return None;
            }
            let radius = self.radius + point.at[1];
            let ahead = -radius * tilt;
            let (y, z) = (point.at[0] * cos + ahead * sin, radius * (1.0 - tilt * tilt).sqrt() - self.radius);
            Some(CurvePoint { at: [shift + y * upright - z * aside, y * aside + z * upright], ahead, radius })
        };
        self.wheel.points().iter().filter_map(of).collect()
    }

    /// The places where the wheel may touch the rail.
    fn candidates(&self, rail: &[CurvePoint], wheel: &[CurvePoint]) -> Result<Vec<Candidate>, SearchError> {
        let ends = |points: &[CurvePoint]| {
            let wider =
                |(low, high): (f64, f64), point: &CurvePoint| (low.min(point.at[0]), high.max(point.at[0]));
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), wider)
        };
        let ((rail_from, rail_to), (wheel_from, wheel_to)) = (ends(rail), ends(wheel));
        let (from, to) = (rail_from.max(wheel_from), rail_to.min(wheel_to));
        let apart = SearchError::Apart { from: wheel_from, to: wheel_to, rail_from, rail_to };
        if to.partial_cmp(&(from + 1.0)) != Some(std::cmp::Ordering::Greater) {
            return Err(apart);
        }
        let count = ((to - from) / STEP).floor() as usize + 1;
        let under = heights(rail, from, STEP, count, Side::Upper);
        let over = heights(wheel, from, STEP, count, Side::Lower);
        let distance: Vec<f64> =
            under.iter().zip(&over).map(|(under, over)| under.at[1] - over.at[1]).collect();
        let known = |i: usize| distance.get(i).copied().filter(|own| own.is_finite());
        let least = distance.iter().copied().filter(|own| own.is_finite()).fold(f64::INFINITY, f64::min);
        if !least.is_finite() {
            return Err(apart);
        }
        let mut candidates = Vec::new();
        for i in 0..count {
            let Some(own) = known(i).filter(|own| own - least < MOST) else { continue };
            let before = i.checked_sub(1).and_then(known);
            let is_least =
                before.is_none_or(|other| own < other) && known(i + 1).is_none_or(|other| own <= other);
            if !is_least {
                continue;
            }
            let (Some(_), Some(_)) = (before, known(i + 1)) else {
                // The first contact at an end means that the profiles are too short; others are
                // none.
                if own == least {
                    return Err(SearchError::AtEnd { y: under[i].at[0] });
                }
                continue;
            };
            let slope = (under[i + 1].at[1] - under[i - 1].at[1]) / (2.0 * STEP);
            let angle = slope.atan();
            let gap = Gap::normal(rail, wheel, [under[i].at, over[i].at], angle);
            let curvature = angle.cos() / over[i].radius;
            let contact = [under[i].at[0], under[i].at[1], angle, over[i].ahead];
            candidates.push(Candidate {
                place: i,
                behind: own - least,
                gap: gap.with_curvature(curvature),
                contact,
            });
        }
        // Between two contacts, the height of the pass between them decides whether they are one.
        for i in 1..candidates.len() {
            let between = candidates[i - 1].place..=candidates[i].place;
            let pass = between.filter_map(known).fold(f64::NEG_INFINITY, f64::max) - least;
            candidates[i].gap.pass_before = pass;
        }
        Ok(candidates)
    }

    /// The patches at an approach (mm) of the wheel, downwards.
    fn pressed<'a>(&self, candidates: &'a [Candidate], approach: f64) -> Vec<(&'a Candidate, PatchPressure)> {
        // Where the undeformed surfaces overlap without interruption there is a single patch, and
        // the first contact stands for all of its candidates.
        let mut groups: Vec<&Candidate> = Vec::new();
        for (i, candidate) in candidates.iter().enumerate().filter(|(_, own)| own.behind < approach) {
            let joined = i > 0 && candidate.gap.pass_before < approach;
            match groups.last_mut() {
                Some(last) if joined => {
                    if candidate.behind < last.behind {
                        *last = candidate;
                    }
                }
                _ => groups.push(candidate),
            }
        }
        let of = |candidate: &'a Candidate| {
            let own = (approach - candidate.behind) * candidate.contact[2].cos();
            Some((candidate, candidate.gap.pressed(own, self.steel)?))
        };
        groups.into_iter().filter_map(of).collect()
    }
}

impl Gap {
    /// The gap normal to the plane at `angle` through the contact point, whose rail and wheel
    /// points are `touching`.
    fn normal(rail: &[CurvePoint], wheel: &[CurvePoint], touching: [[f64; 2]; 2], angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turned = |points: &[CurvePoint], [y0, z0]: [f64; 2]| -> Vec<CurvePoint> {
            let turn = |point: &CurvePoint| {
                let (y, z) = (point.at[0] - y0, point.at[1] - z0);
                CurvePoint { at: [y * cos + z * sin, z * cos - y * sin], ..*point }
            };
            points.iter().map(turn).collect()
        };
        let count = (2.0 * REACH / STEP).round() as usize + 1;
        let over = |points: &[CurvePoint], side: Side| heights(points, -REACH, STEP, count, side);
        let under = over(&turned(rail, touching[0]), Side::Upper);
        let above = over(&turned(wheel, touching[1]), Side::Lower);
        let mut values: Vec<f64> =
            under.iter().zip(&above).map(|(under, above)| under.at[1] - above.at[1]).collect();
        // Around the contact point the rounding of the grid may make it negative.
        let middle = count / 2;
        let near = values[middle - 4..=middle + 4].iter().copied().fold(f64::INFINITY, f64::min);
        let least = if near.is_finite() { near } else { 0.0 };
        values.iter_mut().for_each(|value| {
            *value = if value.is_nan() { f64::INFINITY } else { (*value - least).max(0.0) }
        });
        Self { from: -REACH, step: STEP, values, curvature: 0.0, pass_before: f64::INFINITY }
    }

    fn with_curvature(self, curvature: f64) -> Self {
        Self { curvature, ..self }
    }
}

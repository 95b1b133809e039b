//! The patches of wheels as loads of the half-space.

use railcrack::load::{HertzEllipse, Travel};
use railcrack::rolling::{PlacedPatch, RollingPatch, StripPoint};
use railcrack::space::{BilinearPatch, EllipticWheel, StripTraction, WheelPatch};
use railcrack_case::{Case, ContactOrigin, GivenWheel};
use std::sync::Arc;

/// Intervals along each strip.
const INTERVALS: usize = 160;

/// The whole patches of the wheels of `case`, in its order; none in the plane.
#[must_use]
pub fn wheel_patches(case: &Case) -> Vec<WheelPatch> {
    (0..case.wheels.len()).filter_map(|number| wheel_patch(case, number)).collect()
}

/// The whole patch of the wheel `number` (from 0) of `case`; none in the plane.
pub(super) fn wheel_patch(case: &Case, number: usize) -> Option<WheelPatch> {
    case.space.as_ref()?;
    let of_table = || {
        let table = case.wheel_table.as_ref()?;
        let place = number.checked_sub(table.first)?;
        let row = match &table.groups {
            Some(groups) => *groups.representatives.get(place)?,
            None => place,
        };
        placed_patches(&table.wheels.get(row)?.wheel.over(0.0), table.travel)
    };
    of_table().or_else(|| patch(&case.wheels.get(number)?.wheel))
}

/// The patch of a wheel that is no row of a table.
fn patch(wheel: &GivenWheel) -> Option<WheelPatch> {
    let given = wheel.given()?;
    let (ellipse, lateral, lateral_friction) = match &given.origin {
        ContactOrigin::Rolling { patch, lateral, travel } => {
            return Some(rolling_patch(patch, -lateral, *travel));
        }
        ContactOrigin::Profiles(own) => return placed_patches(&own.placed, own.travel),
        ContactOrigin::Ellipse { ellipse, lateral, lateral_friction, .. }
        | ContactOrigin::GivenEllipse { ellipse, lateral, lateral_friction } => {
            (ellipse, *lateral, *lateral_friction)
        }
        ContactOrigin::Given | ContactOrigin::LineLoad { .. } | ContactOrigin::Table(_) => return None,
    };
    let wheel = EllipticWheel {
        peak_pressure: ellipse.peak_pressure,
        half_width: ellipse.along,
        lateral_half_width: ellipse.across,
        lateral,
        friction: given.contact.sliding()?.friction,
        lateral_friction,
    };
    Some(wheel.into())
}

/// The whole `patch` of a wheel that runs towards `travel`, its y = 0 at `lateral` (mm).
fn rolling_patch(patch: &RollingPatch, lateral: f64, travel: Travel) -> WheelPatch {
    let HertzEllipse { peak_pressure, along, .. } = patch.ellipse;
    let [from, to] = patch.ends();
    let middle = 0.5 * (from + to);
    let outline = EllipticWheel {
        peak_pressure,
        half_width: along,
        lateral_half_width: 0.5 * (to - from),
        lateral: lateral + middle,
        friction: 0.0,
        lateral_friction: 0.0,
    };
    // Strips run from their leading edge backwards; a wheel that runs towards −x has the mirror
    // image.
    let towards = |sign: f64| {
        move |point: &StripPoint| StripTraction {
            x: sign * point.x,
            traction: [point.pressure, sign * point.shear[0], point.shear[1]],
        }
    };
    let strip = |y: f64| {
        let Ok(strip) = patch.strip(middle + y, INTERVALS) else { return Vec::new() };
        match travel {
            Travel::Forward => strip.points.iter().rev().map(towards(1.0)).collect(),
            Travel::Backward => strip.points.iter().map(towards(-1.0)).collect(),
        }
    };
    WheelPatch::Bilinear(Arc::new(BilinearPatch::new(outline, strip)))
}

/// All `patches` of a wheel that runs towards `travel`, the place of each at z = 0: the heaviest
/// first.
fn placed_patches(patches: &[PlacedPatch], travel: Travel) -> Option<WheelPatch> {
    let mut order: Vec<&PlacedPatch> = patches.iter().collect();
    order.sort_by(|a, b| b.patch.normal_force().total_cmp(&a.patch.normal_force()));
    let sign = if travel == Travel::Forward { 1.0 } else { -1.0 };
    let placed = |own: &&PlacedPatch| (sign * own.x, rolling_patch(&own.patch, -own.y, travel));
    match order[..] {
        [] => None,
        // The centre of the wheel is the middle of its only patch.
        [one] => Some(rolling_patch(&one.patch, -one.y, travel)),
        _ => Some(WheelPatch::Several(order.iter().map(placed).collect())),
    }
}

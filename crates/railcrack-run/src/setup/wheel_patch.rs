//! The patches of wheels, as loads of the half-space and of cracks in the plane.

use railcrack::field::{PatchLoad, StripTraction};
use railcrack::load::{CarterContact, Contact, HertzEllipse, Travel};
use railcrack::math::Tensor;
use railcrack::rolling::{PlacedPatch, RollingPatch, StripPoint};
use railcrack::shakedown::space::{RolledPatch, Symmetry};
use railcrack::space::{BilinearPatch, EllipticWheel, WheelPatch};
use railcrack_case::{Case, ContactOrigin, GivenContact};
use std::sync::Arc;

/// Intervals along each strip.
const INTERVALS: usize = 160;

/// A patch of a wheel of a case.
struct GivenPatch {
    /// x from the wheel's centre and lateral place of its middle, mm.
    middle: [f64; 2],
    /// Peak pressure and semi-axes.
    ellipse: HertzEllipse,
    tractions: Tractions,
}

enum Tractions {
    /// Full sliding: shear over pressure, along and across.
    Sliding([f64; 2]),
    /// At a lateral place (mm) from its middle, by increasing x.
    Strips(Box<dyn Fn(f64) -> Vec<StripTraction>>),
}

/// The whole patches of the wheels of `case`, in its order; none in the plane.
#[must_use]
pub fn wheel_patches(case: &Case) -> Vec<WheelPatch> {
    (0..case.wheels.len()).filter_map(|number| wheel_patch(case, number)).collect()
}

/// The whole patch of the wheel `number` (from 0) of `case`; none in the plane.
pub(super) fn wheel_patch(case: &Case, number: usize) -> Option<WheelPatch> {
    case.space()?;
    let mut patches: Vec<(f64, WheelPatch)> =
        given_patches(case, number)?.into_iter().map(GivenPatch::in_space).collect();
    Some(match patches.len() {
        1 => patches.remove(0).1,
        _ => WheelPatch::Several(patches.into()),
    })
}

/// The whole patches under which the wheel `number` (from 0) of `case` rolls the rail, in the plane
/// too, with lateral places relative to the cracks; none of a line contact.
pub(super) fn rolled_patch(case: &Case, number: usize) -> Option<RolledPatch> {
    let patches = given_patches(case, number)?;
    let over = |of: &dyn Fn(&GivenPatch) -> f64, pick: fn(f64, f64) -> f64| {
        patches.iter().map(of).reduce(pick).unwrap_or(0.0)
    };
    let from = over(&|own| own.middle[1] - own.ellipse.across, f64::min);
    let to = over(&|own| own.middle[1] + own.ellipse.across, f64::max);
    let half_width = over(&|own| own.middle[0].abs() + own.ellipse.along, f64::max);
    let peak_pressure = over(&|own| own.ellipse.peak_pressure, f64::max);
    let symmetry = match &patches[..] {
        [one] if one.is_mirrored() => Symmetry::Mirrored,
        _ => Symmetry::None,
    };
    let loads: Vec<(f64, WheelPatch)> = patches.into_iter().map(GivenPatch::in_space).collect();
    let poisson = case.steel.poisson();
    let stress = move |x: f64, y: f64, depth: f64| {
        let of =
            |(ahead, patch): &(f64, WheelPatch)| Tensor::of(patch.stress(*ahead, [x, y, depth], poisson));
        loads.iter().map(of).fold(Tensor::ZERO, |sum, own| sum + own)
    };
    Some(RolledPatch {
        peak_pressure,
        half_width,
        lateral_half_width: 0.5 * (to - from),
        lateral: 0.5 * (from + to),
        symmetry,
        travel: case.wheels[number].passages.passage.travel(),
        stress: Arc::new(stress),
    })
}

/// The heaviest patch of the wheel `number` (from 0) of `case` as a Hertz ellipse that slides along
/// the rail with its shear over normal force; none of a line contact.
pub(super) fn sliding_ellipse(case: &Case, number: usize) -> Option<EllipticWheel> {
    let patch = given_patches(case, number)?.into_iter().next()?;
    let friction = match patch.tractions {
        Tractions::Sliding([along, across]) => along.hypot(across),
        Tractions::Strips(_) => case.wheels[number].wheel.contact()?.adhesion(),
    };
    Some(sliding(&patch.ellipse, 0.0, [friction.abs(), 0.0]))
}

/// `ellipse` at a `lateral` place (mm) in full sliding, with its shear over pressure along and
/// across.
fn sliding(ellipse: &HertzEllipse, lateral: f64, [friction, lateral_friction]: [f64; 2]) -> EllipticWheel {
    let HertzEllipse { peak_pressure, along, across } = *ellipse;
    EllipticWheel {
        peak_pressure,
        half_width: along,
        lateral_half_width: across,
        lateral,
        friction,
        lateral_friction,
    }
}

/// The patches by which the wheel `number` (from 0) of `case` loads cracks in the plane; none of a
/// line contact.
pub(super) fn patches_in_plane(case: &Case, number: usize) -> Option<Vec<PatchLoad>> {
    Some(given_patches(case, number)?.into_iter().map(GivenPatch::in_plane).collect())
}

/// Distance from cracks in the plane of the nearest patch of the wheel `number` (from 0) of `case`,
/// over its lateral semi-axis; none of a line contact, and none in space.
#[must_use]
pub fn patch_beside(case: &Case, number: usize) -> Option<f64> {
    case.plane()?;
    let patches = given_patches(case, number)?;
    patches.iter().map(|own| own.middle[1].abs() / own.ellipse.across).reduce(f64::min)
}

/// Whether a wheel of `case` loads cracks in the plane by its patches.
#[must_use]
pub fn rolls_on_patches(case: &Case) -> bool {
    let is_patch = |number: usize| given_patches(case, number).is_some();
    case.plane().is_some() && (0..case.wheels.len()).any(is_patch)
}

/// The patches of a wheel, the heaviest first, with lateral places relative to cracks in the plane
/// or to the middle of those in space; none of a line contact.
fn given_patches(case: &Case, number: usize) -> Option<Vec<GivenPatch>> {
    let of_table = || {
        let table = case.wheel_table.as_ref().filter(|table| table.is_whole)?;
        let place = number.checked_sub(table.first)?;
        let row = match &table.groups {
            Some(groups) => *groups.representatives.get(place)?,
            None => place,
        };
        let lateral = if case.space().is_some() { 0.0 } else { table.lateral };
        placed_patches(&table.wheels.get(row)?.wheel.over(lateral), table.travel)
    };
    of_table().or_else(|| own_patches(case.wheels.get(number)?.wheel.given()?))
}

/// The patches of a wheel that is no row of a table.
fn own_patches(given: &GivenContact) -> Option<Vec<GivenPatch>> {
    if !given.is_patch() {
        return None;
    }
    match &given.origin {
        ContactOrigin::Rolling { patch, lateral, travel } => {
            Some(vec![rolling_patch(patch, [0.0, -lateral], *travel)])
        }
        ContactOrigin::Profiles(own) => placed_patches(&own.placed, own.travel),
        ContactOrigin::Ellipse { ellipse, lateral, lateral_friction, .. }
        | ContactOrigin::GivenEllipse { ellipse, lateral, lateral_friction } => {
            let tractions = match &given.contact {
                Contact::Hertz(contact) => Tractions::Sliding([contact.friction, *lateral_friction]),
                Contact::Carter(contact) => Tractions::Strips(carter_strips(*contact, *ellipse)),
                Contact::Table(_) => return None,
            };
            Some(vec![GivenPatch { middle: [0.0, *lateral], ellipse: *ellipse, tractions }])
        }
        ContactOrigin::Given | ContactOrigin::LineLoad { .. } | ContactOrigin::Table(_) => None,
    }
}

/// The strips of `ellipse`, each in partial slip with the traction of `middle`, the one in its
/// middle.
fn carter_strips(middle: CarterContact, ellipse: HertzEllipse) -> Box<dyn Fn(f64) -> Vec<StripTraction>> {
    Box::new(move |y| {
        let Ok(own) = ellipse.strip(y, middle.friction) else { return Vec::new() };
        let strip = CarterContact { peak_pressure: own.peak_pressure, half_width: own.half_width, ..middle };
        let point = |i: usize| {
            let x = -own.half_width * (std::f64::consts::PI * i as f64 / INTERVALS as f64).cos();
            StripTraction { x, traction: [strip.pressure(x), strip.shear(x), 0.0] }
        };
        (0..=INTERVALS).map(point).collect()
    })
}

/// `patch` of a wheel that runs towards `travel`, its y = 0 at `place`: x and lateral (mm).
fn rolling_patch(patch: &RollingPatch, place: [f64; 2], travel: Travel) -> GivenPatch {
    let HertzEllipse { peak_pressure, along, .. } = patch.ellipse;
    let [from, to] = patch.ends();
    let middle = 0.5 * (from + to);
    let ellipse = HertzEllipse { peak_pressure, along, across: 0.5 * (to - from) };
    // Strips run from their leading edge backwards; a wheel that runs towards −x has the mirror
    // image.
    let towards = |sign: f64| {
        move |point: &StripPoint| StripTraction {
            x: sign * point.x,
            traction: [point.pressure, sign * point.shear[0], point.shear[1]],
        }
    };
    let patch = *patch;
    let strip = move |y: f64| {
        let Ok(strip) = patch.strip(middle + y, INTERVALS) else { return Vec::new() };
        match travel {
            Travel::Forward => strip.points.iter().rev().map(towards(1.0)).collect(),
            Travel::Backward => strip.points.iter().map(towards(-1.0)).collect(),
        }
    };
    GivenPatch {
        middle: [place[0], place[1] + middle],
        ellipse,
        tractions: Tractions::Strips(Box::new(strip)),
    }
}

/// All `patches` of a wheel that runs towards `travel`, the place of the crack in each at z = 0:
/// the heaviest first.
fn placed_patches(patches: &[PlacedPatch], travel: Travel) -> Option<Vec<GivenPatch>> {
    let mut order: Vec<&PlacedPatch> = patches.iter().collect();
    order.sort_by(|a, b| b.patch.normal_force().total_cmp(&a.patch.normal_force()));
    let sign = if travel == Travel::Forward { 1.0 } else { -1.0 };
    let placed = |x: f64, own: &PlacedPatch| rolling_patch(&own.patch, [sign * x, -own.y], travel);
    match order[..] {
        [] => None,
        // The centre of the wheel is the middle of its only patch.
        [one] => Some(vec![placed(0.0, one)]),
        _ => Some(order.iter().map(|own| placed(own.x, own)).collect()),
    }
}

impl GivenPatch {
    /// Whether it is its own mirror image in the vertical plane along the rail through its middle.
    fn is_mirrored(&self) -> bool {
        matches!(self.tractions, Tractions::Sliding([_, across]) if across == 0.0)
    }

    fn in_plane(self) -> PatchLoad {
        let half = [self.ellipse.along, self.ellipse.across];
        match self.tractions {
            Tractions::Sliding(frictions) => PatchLoad::sliding(&self.ellipse, self.middle, frictions),
            Tractions::Strips(strip) => PatchLoad::sampled(self.middle, half, strip),
        }
    }

    /// x of its middle from the wheel's centre (mm), and the patch.
    fn in_space(self) -> (f64, WheelPatch) {
        let [ahead, lateral] = self.middle;
        let outline = |frictions: [f64; 2]| sliding(&self.ellipse, lateral, frictions);
        let patch = match self.tractions {
            Tractions::Sliding(frictions) => outline(frictions).into(),
            Tractions::Strips(strip) => {
                WheelPatch::Bilinear(Arc::new(BilinearPatch::new(outline([0.0; 2]), strip)))
            }
        };
        (ahead, patch)
    }
}

//! First yield and shakedown limits of the rail under the wheel.

use crate::field::{HertzField, Wheel};
use crate::load::{Contact, HertzianContact};
use crate::math::{Stress, Ties, Vec2, golden_section, smallest_ball};

/// First yield under a Hertzian contact in full sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstYield {
    /// p0 / k, with the yield stress in shear k = σ_y / √3 (von Mises).
    pub ratio: f64,
    /// Abscissa from the centre of the contact over its half-width.
    pub x_over_a: f64,
    /// Depth over the half-width of the contact.
    pub depth_over_a: f64,
}

/// The limit of elastic shakedown of a kinematically hardening rail under repeated passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShakedownLimit {
    /// p0 / k, with the yield stress in shear k = σ_y / √3 (von Mises).
    pub ratio: f64,
    /// Critical depth, over the half-width of the contact.
    pub depth_over_a: f64,
}

/// First yield and shakedown limit at one depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthBounds {
    /// Depth over the half-width of the contact.
    pub depth_over_a: f64,
    /// p0 / k at first yield there; infinite where there is no stress.
    pub first_yield: f64,
    /// p0 / k up to which it can shake down elastically.
    pub shakedown: f64,
}

/// Largest depth of the search, over a. The maximum lies at 0.5 to 0.8; below it the stress path
/// shrinks with depth.
const DEEPEST: f64 = 2.0;
/// Number of intervals of the coarse search in depth; the maximum is refined between its
/// neighbours.
const DEPTH_INTERVALS: u32 = 80;
/// Intervals of the stress path under each half of the contact, and on each side of it. The
/// coordinate is that of confocal ellipses, dense at the edges, where the surface stress has a
/// kink. Doubling them changes the limits by less than 1e-4.
const PATH_INTERVALS: i32 = 100;
/// Length of the path on each side: x/a = cosh 3 = 10. Beyond it the path is straight and ends at
/// zero, which is added as a point.
const PATH_END: f64 = 3.0;

/// p0/k at first yield: 1 / max √J2 over the half-plane, for p0 = 1. `friction` is the wheel–rail
/// friction coefficient μ, `poisson` ν.
///
/// Source of the condition: von Mises; values in Johnson, Contact Mechanics, 4.4 and 7.1 (by
/// Tresca).
pub(crate) fn first_yield_ratio(friction: f64, poisson: f64) -> FirstYield {
    let field = unit_contact(friction, poisson);
    first_yield(&|x, depth| field.stress(Vec2::new(x, -depth), 0.0))
}

/// p0/k at the limit of elastic shakedown for kinematic hardening: at every depth the deviatoric
/// stress path of the elastic passage must fit into the yield surface, a ball of radius √2 k
/// (Frobenius norm) with any centre; so p0/k = √2 / max over depth of the radius of the smallest
/// ball around the path, for p0 = 1. `friction` is the wheel–rail friction coefficient μ, `poisson`
/// ν.
///
/// Source: Melan 1938, Prager 1956 (the theorem); Ponter, Hearle & Johnson 1985, J. Mech. Phys.
/// Solids 33, 339–362.
pub fn shakedown_limit_ratio(friction: f64, poisson: f64) -> ShakedownLimit {
    let field = unit_contact(friction, poisson);
    shakedown_limit(&|x, depth| field.stress(Vec2::new(x, -depth), 0.0))
}

/// First yield and limit of elastic shakedown at each of `depths_over_a`, whose minima over depth
/// are the ratio of first yield and [`shakedown_limit_ratio`].
pub fn bounds_by_depth(friction: f64, poisson: f64, depths_over_a: &[f64]) -> Vec<DepthBounds> {
    let field = unit_contact(friction, poisson);
    bounds_at(&|x, depth| field.stress(Vec2::new(x, -depth), 0.0), depths_over_a)
}

/// First yield and limit of elastic shakedown under any contact: ratios are p0/k with its largest
/// pressure p0, lengths over its half-width a.
pub struct ContactBounds<'a> {
    wheel: &'a dyn Wheel,
    peak_pressure: f64,
    half_width: f64,
    middle: f64,
}

impl<'a> ContactBounds<'a> {
    /// The bounds of `contact`, whose field is `wheel`.
    pub fn new(contact: &Contact, wheel: &'a dyn Wheel) -> Self {
        let (peak_pressure, half_width) = (contact.peak_pressure(), contact.half_width());
        Self { wheel, peak_pressure, half_width, middle: contact.middle() }
    }

    /// p0/k at first yield: 1 / max √J2 over the half-plane, for p0 = 1.
    pub fn first_yield(&self) -> FirstYield {
        first_yield(&|x, depth| self.stress(x, depth))
    }

    /// p0/k at the limit of elastic shakedown, as [`shakedown_limit_ratio`].
    pub fn shakedown_limit(&self) -> ShakedownLimit {
        shakedown_limit(&|x, depth| self.stress(x, depth))
    }

    /// First yield and limit of elastic shakedown by depth, as [`bounds_by_depth`].
    pub fn by_depth(&self, depths_over_a: &[f64]) -> Vec<DepthBounds> {
        bounds_at(&|x, depth| self.stress(x, depth), depths_over_a)
    }

    fn stress(&self, x: f64, depth: f64) -> Stress {
        let point = Vec2::new(self.middle + x * self.half_width, -depth * self.half_width);
        self.wheel.stress(point, 0.0) * (1.0 / self.peak_pressure)
    }
}

/// σ/p0 at x/a and depth/a.
type UnitField<'a> = &'a dyn Fn(f64, f64) -> Stress;

fn first_yield(field: UnitField) -> FirstYield {
    let path = path_abscissae();
    let at_depth = |depth: f64| {
        let path = path.iter().map(|&x| (x, shear_intensity(field, x, depth)));
        path.fold((0.0, 0.0), |best, here| if here.1 > best.1 { here } else { best })
    };
    let (depth_over_a, _) = maximum_over_depth(|depth| at_depth(depth).1);
    let (x, top) = at_depth(depth_over_a);
    FirstYield { ratio: 1.0 / top, x_over_a: x, depth_over_a }
}

fn shakedown_limit(field: UnitField) -> ShakedownLimit {
    let path = path_abscissae();
    let radius = |depth: f64| smallest_ball(&deviators(field, &path, depth)).radius;
    let (depth_over_a, largest) = maximum_over_depth(radius);
    ShakedownLimit { ratio: std::f64::consts::SQRT_2 / largest, depth_over_a }
}

fn bounds_at(field: UnitField, depths_over_a: &[f64]) -> Vec<DepthBounds> {
    let path = path_abscissae();
    let at = |&depth_over_a: &f64| {
        let deviators = deviators(field, &path, depth_over_a);
        let largest = deviators.iter().map(|s| s.iter().map(|c| c * c).sum::<f64>()).fold(0.0, f64::max);
        DepthBounds {
            depth_over_a,
            first_yield: std::f64::consts::SQRT_2 / largest.sqrt(),
            shakedown: std::f64::consts::SQRT_2 / smallest_ball(&deviators).radius,
        }
    };
    depths_over_a.iter().map(at).collect()
}

/// First yield and limit of elastic shakedown for one friction coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPoint {
    /// Wheel–rail friction coefficient |μ|.
    pub friction: f64,
    /// p0 / k at first yield.
    pub first_yield: f64,
    /// p0 / k at the limit of elastic shakedown.
    pub shakedown: f64,
}

/// The shakedown map: `points` friction coefficients evenly spaced from 0 to `most` (Johnson,
/// Contact Mechanics, fig. 9.7).
pub fn shakedown_map(most: f64, points: usize, poisson: f64) -> Vec<MapPoint> {
    let last = points.saturating_sub(1).max(1) as f64;
    let at = |i: usize| {
        let friction = most * i as f64 / last;
        let first_yield = first_yield_ratio(friction, poisson).ratio;
        MapPoint { friction, first_yield, shakedown: shakedown_limit_ratio(friction, poisson).ratio }
    };
    (0..points).map(at).collect()
}

/// Depth and value of the largest √(3/2) |s + s0| over σ_y of the elastic passage of a contact of
/// half-width `a` (mm), whose `field` is a function of x and depth (mm), with s0 the deviator of
/// the initial stress at a depth (mm): the rail yields where it exceeds 1. Searched down to
/// `DEEPEST` half-widths.
pub(super) fn utilisation(
    field: UnitField,
    a: f64,
    yield_radius: f64,
    initial: impl Fn(f64) -> [f64; 3],
) -> (f64, f64) {
    let path = path_abscissae();
    let (depth, largest) = maximum_over_depth(|depth| {
        let offset = initial(depth * a);
        let size = |x: f64| {
            let wheel = field(x * a, depth * a).deviator();
            [0, 1, 2].map(|c| wheel[c] + offset[c]).iter().map(|c| c * c).sum::<f64>()
        };
        let unloaded = offset.iter().map(|c| c * c).sum();
        path.iter().map(|&x| size(x)).fold(unloaded, f64::max).sqrt()
    });
    (depth * a, largest / yield_radius)
}

/// The deviators of the elastic passage at a depth, the unloaded state included.
fn deviators(field: UnitField, path: &[f64], depth: f64) -> Vec<[f64; 3]> {
    let mut deviators: Vec<[f64; 3]> = path.iter().map(|&x| field(x, depth).deviator()).collect();
    deviators.push(Stress::ZERO.deviator());
    deviators
}

/// Peak pressure and half-width 1: abscissae are x/a, stresses σ/p0.
fn unit_contact(friction: f64, poisson: f64) -> HertzField {
    HertzField::new(&HertzianContact { peak_pressure: 1.0, half_width: 1.0, friction }, poisson)
}

/// √J2 = |s| / √2.
fn shear_intensity(field: UnitField, x: f64, depth: f64) -> f64 {
    let [a, b, c] = field(x, depth).deviator();
    (0.5 * (a * a + b * b + c * c)).sqrt()
}

/// x/a from −cosh 3 to cosh 3, including both edges of the contact and its middle.
pub(super) fn path_abscissae() -> Vec<f64> {
    let t = |i: i32| f64::from(i) / f64::from(PATH_INTERVALS);
    let inside = (-PATH_INTERVALS..=PATH_INTERVALS).map(|i| (std::f64::consts::FRAC_PI_2 * t(i)).sin());
    let outside = (1..=PATH_INTERVALS).map(|i| (PATH_END * t(i)).cosh());
    inside.chain(outside.flat_map(|x| [x, -x])).collect()
}

/// The depth/a in [0, DEEPEST] at which `value` is largest, and its value: found on a grid that
/// includes the surface, and by golden section around its best depth.
fn maximum_over_depth(value: impl Fn(f64) -> f64) -> (f64, f64) {
    // 2 · DEEPEST / DEPTH_INTERVALS · 0.618^20 = 3e-6 a: the value is then flat to 1e-11.
    const SECTIONS: usize = 20;
    let spacing = DEEPEST / f64::from(DEPTH_INTERVALS);
    let grid = (0..=DEPTH_INTERVALS).map(|i| spacing * f64::from(i)).map(|depth| (depth, value(depth)));
    let best = grid.fold((0.0, 0.0), |best, here| if here.1 > best.1 { here } else { best });
    let around = [f64::max(0.0, best.0 - spacing), best.0 + spacing];
    let middle = golden_section(around, SECTIONS, Ties::First, &value);
    let refined = (middle, value(middle));
    if refined.1 > best.1 { refined } else { best }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a unit of the last digit of the published values, relative.
    const DIGITS: f64 = 2e-4;
    /// Two digits of depth, as the maximum is flat.
    const DEPTH: f64 = 0.01;

    fn close(value: f64, want: f64) -> bool {
        (value / want - 1.0).abs() < DIGITS
    }

    #[test]
    fn first_yield_of_line_contacts() {
        for (friction, ratio, depth) in [(0.0, 3.107, 0.71), (0.1, 3.063, 0.67), (0.3, 2.598, 0.0)] {
            let got = first_yield_ratio(friction, 0.3);
            assert!(
                close(got.ratio, ratio) && (got.depth_over_a - depth).abs() < DEPTH,
                "{friction}: {got:?}"
            );
        }
    }

    #[test]
    fn kinematic_shakedown_limit_of_line_contacts() {
        for (friction, ratio, depth) in [(0.0, 4.000, 0.50), (0.1, 3.987, 0.5), (0.3, 3.150, 0.0)] {
            let got = shakedown_limit_ratio(friction, 0.3);
            assert!(
                close(got.ratio, ratio) && (got.depth_over_a - depth).abs() < DEPTH,
                "{friction}: {got:?}"
            );
        }
    }

    #[test]
    fn sign_of_the_friction_has_no_effect() {
        assert_eq!(shakedown_limit_ratio(0.2, 0.3).ratio, shakedown_limit_ratio(-0.2, 0.3).ratio);
        let (one, other) = (first_yield_ratio(0.2, 0.3), first_yield_ratio(-0.2, 0.3));
        assert_eq!((one.ratio, one.x_over_a), (other.ratio, -other.x_over_a));
    }
}

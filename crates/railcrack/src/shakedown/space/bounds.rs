//! First yield and shakedown limits of the rail under a patch.

use super::super::bounds::{DepthBounds, path_abscissae};
use super::rail::{RolledPatch, Symmetry};
use crate::math::{Tensor, Ties, golden_section, smallest_ball};
use rayon::prelude::*;

/// A bound p0/k, with k = σ_y/√3 (von Mises), and the place that decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceBound {
    /// p0 / k.
    pub ratio: f64,
    /// Lateral place from the middle of the contact, over its lateral half-width.
    pub y_over_b: f64,
    /// Depth over the half-width of the contact along the rail.
    pub depth_over_a: f64,
}

/// First yield and limit of elastic shakedown under a patch: ratios are p0/k with its largest
/// pressure p0, depths over its half-width a along the rail, lateral places over b.
pub struct PatchBounds<'a>(&'a RolledPatch);

/// Largest depth of the search, over the smaller half-width; the maximum lies at 0.5 to 0.8.
const DEEPEST: f64 = 2.0;
/// Intervals of the coarse search in depth and from the middle to the edge of the contact.
const DEPTH_INTERVALS: u32 = 32;
const LATERAL_INTERVALS: i32 = 8;
/// Steps of the golden section: 2 · (DEEPEST/DEPTH_INTERVALS) 0.618^16 = 6e-5, where the value is
/// flat to 1e-8.
const SECTIONS: usize = 16;
/// Every so many-th place of the path is taken in the coarse search.
const COARSE: usize = 4;

impl RolledPatch {
    /// Its bounds on a rail.
    #[must_use]
    pub fn bounds(&self) -> PatchBounds<'_> {
        PatchBounds(self)
    }
}

impl PatchBounds<'_> {
    /// p0/k at first yield: 1 / max √J2 over the half-space, for p0 = 1.
    #[must_use]
    pub fn first_yield(&self) -> PlaceBound {
        self.bound(&self.laterals(), longest)
    }

    /// p0/k at the limit of elastic shakedown for kinematic hardening: at every place of the
    /// section the deviatoric stress path of the elastic passage must fit into the yield surface, a
    /// ball of radius √2 k in five dimensions with any centre (Melan 1938).
    #[must_use]
    pub fn shakedown_limit(&self) -> PlaceBound {
        self.bound(&self.laterals(), |deviators| smallest_ball(deviators).radius)
    }

    /// First yield and the limit of elastic shakedown in the vertical plane along the rail through
    /// the middle of the contact. Both decide there for a Hertz ellipse that slides along the rail.
    #[must_use]
    pub fn in_the_middle(&self) -> [PlaceBound; 2] {
        [self.bound(&[0.0], longest), self.bound(&[0.0], |deviators| smallest_ball(deviators).radius)]
    }

    /// Both at each of `depths_over_a`, at the lateral place `y_over_b`.
    #[must_use]
    pub fn by_depth(&self, y_over_b: f64, depths_over_a: &[f64]) -> Vec<DepthBounds> {
        let at = |&depth_over_a: &f64| {
            let deviators = self.deviators(y_over_b, depth_over_a, 1);
            DepthBounds {
                depth_over_a,
                first_yield: std::f64::consts::SQRT_2 / longest(&deviators),
                shakedown: std::f64::consts::SQRT_2 / smallest_ball(&deviators).radius,
            }
        };
        depths_over_a.par_iter().map(at).collect()
    }

    /// Lateral places of the coarse search, over b.
    fn laterals(&self) -> Vec<f64> {
        let first = match self.0.symmetry {
            Symmetry::Mirrored => 0,
            Symmetry::None => -LATERAL_INTERVALS,
        };
        (first..=LATERAL_INTERVALS).map(|m| f64::from(m) / f64::from(LATERAL_INTERVALS)).collect()
    }

    /// √2 over the largest `radius` of the elastic paths at the lateral places `laterals`.
    fn bound(&self, laterals: &[f64], radius: impl Fn(&[[f64; 5]]) -> f64 + Sync) -> PlaceBound {
        let patch = self.0;
        let deepest = DEEPEST * patch.half_width.min(patch.lateral_half_width) / patch.half_width;
        let (down, beside) = (deepest / f64::from(DEPTH_INTERVALS), 1.0 / f64::from(LATERAL_INTERVALS));
        let depths = |y: f64| (0..=DEPTH_INTERVALS).map(move |n| [y, down * f64::from(n)]);
        let places: Vec<[f64; 2]> = laterals.iter().flat_map(|y| depths(*y)).collect();
        let values: Vec<f64> =
            places.par_iter().map(|&[y, depth]| radius(&self.deviators(y, depth, COARSE))).collect();
        let larger = |best: usize, at: usize| if values[at] > values[best] { at } else { best };
        let [y, depth] = places[(0..places.len()).reduce(larger).unwrap_or(0)];
        let value = |y: f64, depth: f64| radius(&self.deviators(y, depth, 1));
        let within = |depth: f64| [f64::max(0.0, depth - down), depth + down];
        let mut best = [y, golden_section(within(depth), SECTIONS, Ties::First, |depth| value(y, depth))];
        if laterals.len() > 1 && (patch.symmetry == Symmetry::None || y > 0.0) {
            let around = [y - beside, y + beside];
            best[0] = golden_section(around, SECTIONS, Ties::First, |y| value(y, best[1]));
            best[1] = golden_section(within(best[1]), SECTIONS, Ties::First, |depth| value(best[0], depth));
        }
        let candidates = [[y, depth], best].map(|[y, depth]| (value(y, depth), y, depth));
        let (largest, y_over_b, depth_over_a) =
            if candidates[1].0 > candidates[0].0 { candidates[1] } else { candidates[0] };
        PlaceBound { ratio: std::f64::consts::SQRT_2 / largest, y_over_b, depth_over_a }
    }

    /// The deviators of the elastic passage of p0 = 1, the unloaded state included: every `step`-th
    /// place of the path, dense at the ends of the chord of the contact.
    fn deviators(&self, y_over_b: f64, depth_over_a: f64, step: usize) -> Vec<[f64; 5]> {
        let patch = self.0;
        let chord = if y_over_b.abs() < 1.0 { (1.0 - y_over_b * y_over_b).sqrt() } else { 1.0 };
        let (y, depth) =
            (patch.lateral + y_over_b * patch.lateral_half_width, depth_over_a * patch.half_width);
        let at = |x: f64| {
            let stress = patch.stress.stress(x * chord * patch.half_width, y, depth);
            (stress * (1.0 / patch.peak_pressure)).deviator()
        };
        let path = path_abscissae().into_iter().step_by(step);
        path.map(at).chain([Tensor::ZERO.deviator()]).collect()
    }
}

/// The largest norm.
pub(super) fn longest(deviators: &[[f64; 5]]) -> f64 {
    deviators.iter().map(|s| s.iter().map(|c| c * c).sum::<f64>()).fold(0.0, f64::max).sqrt()
}

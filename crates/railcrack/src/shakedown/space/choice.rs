//! Choice of columns, rows and layers around the zone that yields.

use super::super::fourier::Layers;
use super::grid::{Across, SpaceGrid};
use super::rail::{RailInSpace, RolledPatch, Symmetry};
use rayon::prelude::*;

/// Resolution of stress and strain around the contact in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpaceResolution {
    /// Columns per half-width of the contact along the rail.
    pub columns_per_half_width: u32,
    /// Rows per half-width of the contact across the rail.
    pub rows_per_half_width: u32,
    /// Layers per smaller half-width, where the rail may yield.
    pub layers_per_half_width: u32,
    /// Least period of the waves along the rail, in half-widths along it.
    pub period: u32,
    /// Least period of the waves across the rail, in half-widths across it.
    pub lateral_period: u32,
}

impl Default for SpaceResolution {
    /// The resolution measured in `docs/dev/shakedown.md`: doubling grids changes the residual
    /// stress by 0.2 % of its peak in the mean and by 1.8 % at most.
    fn default() -> Self {
        Self {
            columns_per_half_width: 16,
            rows_per_half_width: 12,
            layers_per_half_width: 24,
            period: 8,
            lateral_period: 5,
        }
    }
}

/// The part of the section that may yield.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Zone {
    /// mm.
    pub depth: f64,
    /// Lateral places between which it lies, mm.
    pub from: f64,
    pub to: f64,
}

/// Factor by which the plastic zone is larger than the zone of the elastic passage above yield,
/// because the yielded part sheds load, …
const SPREAD: f64 = 1.35;
/// … and what is added to its depth, over the smaller half-width, and to each side, over the
/// lateral one.
const ADDED_DEPTH: f64 = 0.1;
const ADDED_SIDE: f64 = 0.15;
/// Smallest depth and half-width of the zone, over the smaller half-width and the lateral one.
const LEAST_DEPTH: f64 = 1.0;
const LEAST_SIDE: f64 = 1.25;
/// Least periods along and across over the depth of the zone.
const PERIOD_OVER_DEPTH: f64 = 4.5;
/// Least period along over that across, below which the waves along are felt from the next period.
const PERIOD_OVER_WIDTH: f64 = 0.5;
/// Least period across over the width of the zone.
const WIDTH_OVER_ZONE: f64 = 1.7;
/// Depth of all layers over that of the even ones: flow in the lower layers shows that more even
/// layers are needed.
const MARGIN: f64 = 2.5;
/// Steps of the search of the zone over the smaller half-width and the lateral one, and its end
/// beside the contact.
const DEPTH_STEP: f64 = 0.1;
const LATERAL_STEP: f64 = 0.1;
const LATERAL_END: i32 = 20;
/// Abscissae of the search over a: within two half-widths.
const PATH_STEP: f64 = 0.1;
const PATH_END: i32 = 20;

impl Zone {
    /// A zone slightly larger than that in which the elastic passages over `rail` yield.
    pub(super) fn of(rail: &RailInSpace) -> Self {
        rail.patches.iter().map(|patch| Self::under(rail, patch)).reduce(Self::with).unwrap_or(Self {
            depth: 0.0,
            from: 0.0,
            to: 0.0,
        })
    }

    /// Both zones and what lies between them.
    fn with(self, other: Self) -> Self {
        Self {
            depth: self.depth.max(other.depth),
            from: self.from.min(other.from),
            to: self.to.max(other.to),
        }
    }

    fn under(rail: &RailInSpace, patch: &RolledPatch) -> Self {
        let (a, b) = (patch.half_width, patch.lateral_half_width);
        let smaller = a.min(b);
        // Below a depth d the stress of the patch is at most 3 P/2π d², P = 2π a b p0/3.
        let ratio = patch.peak_pressure / rail.hardening.yield_stress();
        let deepest = (ratio * a * b).sqrt().max(ratio * smaller).min(4.0 * a.max(b));
        let yields = |&(m, n): &(i32, usize)| {
            let (y, depth) = (f64::from(m) * LATERAL_STEP * b, DEPTH_STEP * n as f64 * smaller);
            let offset = rail.initial_stress(depth);
            let limit = rail.hardening.yield_radius().powi(2);
            (-PATH_END..=PATH_END).any(|i| {
                let x = f64::from(i) * PATH_STEP * a;
                let s = (patch.forward_stress(x, patch.lateral + y, depth) + offset).deviator();
                s.iter().map(|c| c * c).sum::<f64>() > limit
            })
        };
        let count = (deepest / (DEPTH_STEP * smaller)).ceil() as usize;
        let places: Vec<(i32, usize)> =
            (-LATERAL_END..=LATERAL_END).flat_map(|m| (0..=count).map(move |n| (m, n))).collect();
        let yielding: Vec<(i32, usize)> = places.into_par_iter().filter(yields).collect();
        let deep = yielding.iter().map(|own| own.1).max().unwrap_or(0) as f64 * DEPTH_STEP * smaller;
        let side = |sign: i32| {
            let far = yielding.iter().map(|own| sign * own.0).max().unwrap_or(0);
            let spread = SPREAD * f64::from(far.max(0)) * LATERAL_STEP + ADDED_SIDE;
            f64::from(sign) * spread.max(LEAST_SIDE) * b
        };
        Self {
            depth: SPREAD * deep.max(LEAST_DEPTH * smaller) + ADDED_DEPTH * smaller,
            from: patch.lateral + side(-1),
            to: patch.lateral + side(1),
        }
    }

    /// A zone that is enlarged where flow has reached its border.
    pub(super) fn enlarged(self, reached: Reached) -> Self {
        const MORE: f64 = 0.25;
        let Self { depth, from, to } = self;
        let more = MORE * (to - from);
        Self {
            depth: if reached.bottom { (1.0 + MORE) * depth } else { depth },
            from: if reached.sides { from - more } else { from },
            to: if reached.sides { to + more } else { to },
        }
    }
}

/// The borders of a zone that flow has reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Reached {
    pub bottom: bool,
    pub sides: bool,
}

impl SpaceGrid {
    /// The grid for `rail` with even layers and active rows in `zone`.
    pub(super) fn around(rail: &RailInSpace, resolution: SpaceResolution, zone: Zone) -> Self {
        let over = |of: fn(&RolledPatch) -> f64, pick: fn(f64, f64) -> f64| {
            rail.patches.iter().map(of).reduce(pick).unwrap_or(1.0)
        };
        let (a, longest) =
            (over(|patch| patch.half_width, f64::min), over(|patch| patch.half_width, f64::max));
        let (b, widest) = (
            over(|patch| patch.lateral_half_width, f64::min),
            over(|patch| patch.lateral_half_width, f64::max),
        );
        let row_spacing = b / f64::from(resolution.rows_per_half_width);
        let width = (f64::from(resolution.lateral_period) * widest)
            .max(PERIOD_OVER_DEPTH * zone.depth)
            .max(WIDTH_OVER_ZONE * (zone.to - zone.from));
        let rows = power_of_two(width / row_spacing);
        let spacing = a / f64::from(resolution.columns_per_half_width);
        let length = (f64::from(resolution.period) * longest)
            .max(PERIOD_OVER_DEPTH * zone.depth)
            .max(PERIOD_OVER_WIDTH * width);
        let thickness = a.min(b) / f64::from(resolution.layers_per_half_width);
        let symmetry = rail.symmetry();
        let (middle, half) = (0.5 * (zone.from + zone.to), 0.5 * (zone.to - zone.from));
        let beside = (half / row_spacing).ceil() as usize;
        let first = match symmetry {
            Symmetry::Mirrored => rows / 2,
            Symmetry::None => rows / 2 - beside,
        };
        Self {
            columns: power_of_two(length / spacing),
            spacing,
            rows,
            row_spacing,
            middle,
            active: first..rows / 2 + beside + 1,
            layers: Layers::graded(thickness, zone.depth, MARGIN * zone.depth),
            across: Across::Confined,
            symmetry,
        }
    }
}

/// The smallest power of two that is not smaller.
fn power_of_two(count: f64) -> usize {
    (count.ceil() as usize).next_power_of_two()
}

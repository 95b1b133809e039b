//! Grid of columns and layers around the contact.

use super::layers::Layers;
use super::rail::RolledRail;
use super::{bounds, error::ShakedownError};

/// Resolution of stress and strain around the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Number of columns, and of layers where the rail may yield, per half-width of the contact; a
    /// power of two, so that both edges of the contact lie on columns.
    pub per_half_width: u32,
    /// Least period of the waves, in half-widths of the contact; see `docs/dev/shakedown.md`.
    pub period: u32,
}

impl Default for Resolution {
    /// The resolution measured in `docs/dev/shakedown.md`: within 2 % of the largest residual stress.
    fn default() -> Self {
        Self { per_half_width: 32, period: 16 }
    }
}

/// Columns and layers of one computation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RailGrid {
    /// Number of columns, a power of two.
    pub columns: usize,
    /// mm.
    pub spacing: f64,
    pub layers: Layers,
    /// Depth of the even layers, mm.
    pub fine_depth: f64,
}

/// p0/k beyond which the plastic zone is deeper than ten half-widths. No elastic half-plane carries
/// such a load, and the pressure ceases to be Hertzian at much lower loads.
const HEAVIEST: f64 = 20.0;
/// Factor by which the plastic zone is deeper than the zone of the elastic passage above yield,
/// because the yielded part sheds load, and …
const SPREAD: f64 = 1.35;
/// … increase of its depth, over a.
const SPREAD_OVER_A: f64 = 0.1;
/// Least period over the depth of the even layers.
const PERIOD_OVER_DEPTH: f64 = 4.5;
/// Depth of all layers over that of the even ones: flow in the lower layers shows that more even
/// layers are needed.
const MARGIN: f64 = 1.15;
/// Depth over a beyond which the sizes of layers and columns double, because deeper zones are
/// larger in all directions.
const COARSER_BEYOND: f64 = 4.0;
/// Half-widths on each side of the contact in which flow is admitted and the extrapolation acts.
pub(super) const ACTIVE: f64 = 3.0;

impl RailGrid {
    /// The grid for `rail`, with even layers to slightly below the depth at which its elastic
    /// passage yields.
    pub(super) fn of(rail: &RolledRail, resolution: Resolution) -> Result<Self, ShakedownError> {
        Self::check_load(rail)?;
        let a = rail.contact.half_width();
        let depth = yield_depth(rail)?.max(a);
        Ok(Self::down_to(rail, resolution, SPREAD * depth + SPREAD_OVER_A * a))
    }

    /// Checks that a half-plane can carry the load of `rail`.
    pub(super) fn check_load(rail: &RolledRail) -> Result<(), ShakedownError> {
        let ratio = rail.pressure_ratio();
        let accepted = ratio > 0.0 && ratio <= HEAVIEST;
        if accepted { Ok(()) } else { Err(ShakedownError::Load { ratio, most: HEAVIEST }) }
    }

    /// The grid for `rail` with even layers down to `fine_depth` (mm).
    pub(super) fn down_to(rail: &RolledRail, resolution: Resolution, fine_depth: f64) -> Self {
        let a = rail.contact.half_width();
        let mut spacing = a / f64::from(resolution.per_half_width.next_power_of_two());
        let mut reach = COARSER_BEYOND * a;
        while fine_depth > reach {
            (spacing, reach) = (2.0 * spacing, 2.0 * reach);
        }
        let period = (f64::from(resolution.period) * a).max(PERIOD_OVER_DEPTH * fine_depth);
        let columns = ((period / spacing).ceil() as usize).next_power_of_two();
        Self {
            columns,
            spacing,
            layers: Layers::graded(spacing, fine_depth, MARGIN * fine_depth),
            fine_depth,
        }
    }

    /// Abscissa of column `i` from the centre of the contact, mm.
    pub(super) fn abscissa(&self, i: usize) -> f64 {
        (i as f64 - 0.5 * self.columns as f64) * self.spacing
    }
}

/// The greatest depth (mm) at which the elastic passage reaches the yield stress; 0 for none.
fn yield_depth(rail: &RolledRail) -> Result<f64, ShakedownError> {
    // Step of the search over a, and its end: beyond a depth d the stress of the wheel is at most
    // p0 a/d.
    const STEP: f64 = 0.05;
    let a = rail.contact.half_width();
    let field = rail.forward_field()?;
    let limit = rail.hardening.yield_radius().powi(2);
    let path: Vec<f64> = bounds::path_abscissae().into_iter().map(|x| x * a).collect();
    let yields = |depth: f64| {
        let offset = rail.initial_stress(depth);
        let size = |x: f64| {
            let s = (field.stress(x, depth) + offset).deviator();
            s.iter().map(|c| c * c).sum::<f64>()
        };
        path.iter().any(|&x| size(x) > limit)
    };
    let deepest = (rail.pressure_ratio() / STEP).ceil() as usize;
    Ok((1..=deepest).rev().map(|i| STEP * i as f64 * a).find(|&depth| yields(depth)).unwrap_or(0.0))
}

//! Forces of a patch in rolling contact.

use super::RollingPatch;
use std::f64::consts::PI;

/// Integrals over a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchForces {
    /// F_x and F_y on the rail, N: x with the travel.
    pub force: [f64; 2],
    /// M_z on the rail, N mm, from +x towards +y.
    pub moment: f64,
    /// Area that slips over the area of the patch.
    pub slip_share: f64,
    /// Tγ = −(F_x ξ + F_y η), N: the work per length of track without that of the spin.
    pub t_gamma: f64,
    /// Tγ with the work of the spin, −M_z φ, N.
    pub t_gamma_with_spin: f64,
}

/// Strips of the integrals, and intervals of each.
const STRIPS: usize = 60;
const INTERVALS: usize = 80;

impl RollingPatch {
    /// Forces, slip and work of the patch, by strips at y = b cos ψ from its middle.
    #[must_use]
    pub fn forces(&self) -> PatchForces {
        self.forces_on(STRIPS, INTERVALS)
    }

    /// F_x/N and F_y/N by so many strips and intervals of each: a cheap estimate where thousands of
    /// patches are compared.
    #[must_use]
    pub fn mean_shear(&self, [strips, intervals]: [usize; 2]) -> [f64; 2] {
        let normal = self.normal_force();
        self.forces_on(strips, intervals).force.map(|force| force / normal)
    }

    /// [`RollingPatch::forces`] on `strips` strips of `intervals` intervals.
    pub(super) fn forces_on(&self, strips: usize, intervals: usize) -> PatchForces {
        let [from, to] = self.ends();
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut force, mut moment, mut slip, mut area) = ([0.0; 2], 0.0, 0.0, 0.0);
        for i in 0..strips {
            let angle = PI * (i as f64 + 0.5) / strips as f64;
            let (y, width) = (middle + half * angle.cos(), angle.sin() * PI / strips as f64);
            let Ok(strip) = self.strip(y, intervals) else { continue };
            let (across, steps) = (half * width, (strip.points.len() - 1) as f64);
            for (j, (point, shear)) in strip.points.iter().zip(&strip.balanced).enumerate() {
                // The trapezoidal rule in θ, where the integrand vanishes at the ends.
                let along = strip.half_length * (PI * j as f64 / steps).sin() * PI / steps;
                let cell = across * along;
                force[0] += shear[0] * cell;
                force[1] += shear[1] * cell;
                moment += (point.x * shear[1] - y * shear[0]) * cell;
                area += cell;
                slip += if point.slips { cell } else { 0.0 };
            }
        }
        let c = &self.creepage;
        let t_gamma = 0.0 - (force[0] * c.longitudinal + force[1] * c.lateral);
        PatchForces {
            force,
            moment,
            slip_share: if area > 0.0 { slip / area } else { 0.0 },
            t_gamma,
            t_gamma_with_spin: t_gamma - moment * c.spin,
        }
    }
}

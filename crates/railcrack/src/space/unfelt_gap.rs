//! The gap that an elliptical contact leaves over cracks in space which it does not feel.

use super::body::SpaceBody;
use super::wheel::EllipticWheel;
use crate::load::{SurfacePart, unfelt_gap};
use crate::math::dot;

/// Places of the running surface are within this distance of it, mm.
const AT_SURFACE: f64 = 1e-9;

impl SpaceBody {
    /// The mean sinking (mm) of the running surface by `jumps` (mm, 3p), weighted with the pressure
    /// of `wheel` at `position` (mm). By Betti's theorem the nodal forces of the pressure on the
    /// faces do the work on the jumps that it does on the sinking: no kernel of the surface
    /// (Boussinesq's) is needed.
    fn sinking(&self, jumps: &[f64], wheel: &EllipticWheel, position: f64, poisson: f64) -> f64 {
        let pressure = EllipticWheel { friction: 0.0, lateral_friction: 0.0, ..*wheel };
        dot(&self.nodal_forces(|point| pressure.stress(position, point, poisson)), jumps)
            / pressure.ellipse().load()
    }

    /// The largest gap (mm) that opens between rail and `wheel` at `position` (mm) by `jumps` (mm,
    /// 3p) of the faces, with the contact on the uncracked rail: [`unfelt_gap`], along the rail
    /// through the place of the contact that is nearest to the mouth.
    #[must_use]
    pub fn gap_under(&self, jumps: &[f64], wheel: &EllipticWheel, position: f64, poisson: f64) -> f64 {
        let at_surface = self.points().iter().filter(|point| point[2].abs() < AT_SURFACE);
        let (least, most) = at_surface.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), point| {
            (least.min(point[1]), most.max(point[1]))
        });
        if least > most {
            return 0.0;
        }
        let reach = (1.0 - SurfacePart::SHARE) * wheel.lateral_half_width;
        let nearest = wheel.lateral.max(least).min(most);
        let beside = nearest.max(wheel.lateral - reach).min(wheel.lateral + reach);
        unfelt_gap(|part| {
            let own = EllipticWheel {
                half_width: part.share * wheel.half_width,
                lateral_half_width: part.share * wheel.lateral_half_width,
                lateral: if part == SurfacePart::WHOLE { wheel.lateral } else { beside },
                ..*wheel
            };
            self.sinking(jumps, &own, position + part.ahead * wheel.half_width, poisson)
        })
    }
}

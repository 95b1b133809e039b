//! The gap that an elliptical contact leaves over cracks in space which it does not feel.

use super::body::SpaceBody;
use super::wheel::EllipticWheel;
use crate::load::{SurfacePart, uncoupled_gap};
use crate::math::dot;

/// Places of the running surface are within this distance of it, mm.
const AT_SURFACE: f64 = 1e-9;

/// A wheel over a body whose cracks it does not feel, and the nodal forces of unit loads on parts
/// of the running surface.
pub struct UncoupledWheel<'a> {
    body: &'a SpaceBody,
    wheel: EllipticWheel,
    poisson: f64,
    /// Lateral place of the parts, mm; none over a body without a mouth.
    beside: Option<f64>,
    /// x of parts (mm), and the forces (N, 3p) of a unit load on each.
    parts: Vec<(f64, Vec<f64>)>,
}

/// Difference of the places of two parts, over a, below which they are the same.
const SAME_PLACE: f64 = 1e-9;

impl<'a> UncoupledWheel<'a> {
    /// `wheel` over `body`, of a steel with this Poisson's ratio.
    #[must_use]
    pub fn new(body: &'a SpaceBody, wheel: &EllipticWheel, poisson: f64) -> Self {
        let at_surface = body.points().iter().filter(|point| point[2].abs() < AT_SURFACE);
        let (least, most) = at_surface.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), point| {
            (least.min(point[1]), most.max(point[1]))
        });
        let reach = (1.0 - SurfacePart::SHARE) * wheel.lateral_half_width;
        let beside = (least <= most).then(|| {
            let nearest = wheel.lateral.max(least).min(most);
            nearest.max(wheel.lateral - reach).min(wheel.lateral + reach)
        });
        let wheel = EllipticWheel { friction: 0.0, lateral_friction: 0.0, ..*wheel };
        Self { body, wheel, poisson, beside, parts: Vec::new() }
    }

    /// The largest gap (mm) that opens between the rail and the wheel at `position` (mm) by `jumps`
    /// (mm, 3p) of the faces, with the contact on the uncracked rail: [`uncoupled_gap`], along the
    /// rail through the place of the contact that is nearest to the mouth. Positions that are
    /// multiples of `SurfacePart::SPACING` a apart share their parts.
    pub fn gap(&mut self, position: f64, jumps: &[f64]) -> f64 {
        let Some(beside) = self.beside else { return 0.0 };
        let a = self.wheel.half_width;
        let whole = dot(&self.forces(&self.wheel, position), jumps);
        for ahead in SurfacePart::all_ahead() {
            let place = position + ahead * a;
            if self.part_at(place).is_none() {
                let part = EllipticWheel {
                    half_width: SurfacePart::SHARE * a,
                    lateral_half_width: SurfacePart::SHARE * self.wheel.lateral_half_width,
                    lateral: beside,
                    ..self.wheel
                };
                let forces = self.forces(&part, place);
                self.parts.push((place, forces));
            }
        }
        uncoupled_gap(|part| match part {
            SurfacePart::WHOLE => whole,
            part => self.part_at(position + part.ahead * a).map_or(0.0, |forces| dot(forces, jumps)),
        })
    }

    fn part_at(&self, place: f64) -> Option<&[f64]> {
        let same = SAME_PLACE * self.wheel.half_width;
        self.parts.iter().find(|(known, _)| (known - place).abs() < same).map(|(_, forces)| &forces[..])
    }

    /// The nodal forces (N, 3p) of a unit load with the distribution of `pressure` at `position`
    /// (mm). By Betti's theorem their work on the jumps is the mean sinking of the running surface,
    /// weighted with this distribution: no kernel of the surface (Boussinesq's) is needed.
    fn forces(&self, pressure: &EllipticWheel, position: f64) -> Vec<f64> {
        let peak_pressure = pressure.peak_pressure / pressure.ellipse().load();
        let unit = EllipticWheel { peak_pressure, ..*pressure };
        self.body.nodal_forces(|point| unit.stress(position, point, self.poisson))
    }
}

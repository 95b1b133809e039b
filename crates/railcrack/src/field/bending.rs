//! Bending of the rail under the axles of a train, as a field that moves with the wheel.

use super::Wheel;
use crate::load::{Bending, Track};
use crate::material::IsotropicElastic;
use crate::math::{OutOfRange, Stress, Vec2};

/// The beam's σ_xx under the axles of a train. It adds to the field of a contact
/// ([`super::Wheels`]).
///
/// σ_yy = σ_xy = 0, and σ_zz = 0, as the rail is free to contract sideways. The beam's shear stress
/// is left out, so that the field is in equilibrium only where M is constant: the missing shear
/// stress at the depth d is V d (h − d/2)/I, with the shear force V; under a wheel, V = Q/2, 1.4
/// MPa at 10 mm in a 60E1 under 100 kN.
#[derive(Debug, Clone, PartialEq)]
pub struct BendingWheel {
    bending: Bending,
}

impl BendingWheel {
    /// The bending of a rail of `steel` on `track`. Errors: [`Track::check`].
    pub fn new(track: &Track, steel: &IsotropicElastic) -> Result<Self, OutOfRange> {
        Ok(Self { bending: track.bending(steel)? })
    }
}

impl Wheel for BendingWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        Stress { xx: self.bending.stress(point.x - xc, -point.y), ..Stress::ZERO }
    }

    /// The displacement of Euler's beam: the deflection w, and u_x = (h − d) w′.
    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let (deflection, slope) = self.bending.deflection(point.x - xc);
        let above = self.bending.track().section.neutral_axis_depth + point.y;
        Vec2::new(above * slope, -deflection)
    }

    fn edges(&self) -> &[f64] {
        &[]
    }

    fn bending(&self) -> Option<&Bending> {
        Some(&self.bending)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::{Axle, NamedSection};

    #[test]
    fn the_fibres_stretch_as_they_are_stressed() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let section = NamedSection::of("60E1").unwrap().section();
        let axles = vec![Axle { at: 0.0, wheel_load: 100e3 }, Axle { at: 1800.0, wheel_load: 80e3 }];
        let wheel = BendingWheel::new(&Track { section, foundation: 50.0, axles }, &steel).unwrap();
        for (x, y) in [(-1300.0, -5.0), (400.0, 0.0), (1700.0, -120.0)] {
            let at = |dx: f64| wheel.displacement(Vec2::new(x + dx, y), 30.0).x;
            let stress = wheel.stress(Vec2::new(x, y), 30.0);
            assert!((210e3 * (at(0.5) - at(-0.5)) - stress.xx).abs() < 1e-4, "{x} {y}");
            assert_eq!((stress.yy, stress.zz, stress.xy), (0.0, 0.0, 0.0));
        }
    }
}

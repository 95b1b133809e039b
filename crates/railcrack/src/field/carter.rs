//! The half-plane under Carter's rolling contact and under a flat punch, in closed form.

use super::hertz_half_plane::{Lanes, Root, Transform, side_by_side};
use super::{HertzDisplacement, HertzField, Wheel};
use crate::load::{CarterContact, HertzianContact};
use crate::material::IsotropicElastic;
use crate::math::{OutOfRange, Stress, Vec2};
use std::f64::consts::PI;

/// A wheel in Hertzian line contact, in partial slip: the half-ellipse of shear in full sliding
/// less a half-ellipse over the stick zone.
#[derive(Debug, Clone, PartialEq)]
pub struct CarterWheel {
    contact: CarterContact,
    sliding: HertzField,
    displacement: HertzDisplacement,
    stuck: Option<StuckShear>,
    edges: Vec<f64>,
}

/// The half-ellipse of shear over the stick zone.
#[derive(Debug, Clone, Copy, PartialEq)]
struct StuckShear {
    /// Its largest value, signed, MPa.
    peak: f64,
    /// d, mm.
    centre: f64,
    /// 1/c, 1/mm.
    per_half_width: f64,
    poisson: f64,
    /// Displacements due to the pressure alone, and due to pressure and shear.
    displacement: [HertzDisplacement; 2],
}

impl CarterWheel {
    /// The wheel with `contact` on a rail of `steel`. Errors: [`CarterContact::check`].
    pub fn new(contact: &CarterContact, steel: &IsotropicElastic) -> Result<Self, OutOfRange> {
        contact.check()?;
        let sliding = contact.sliding();
        let half_width = contact.stick_half_width();
        let peak = sliding.friction * contact.peak_pressure * half_width / contact.half_width;
        let stuck = (peak != 0.0).then(|| {
            let under = |friction| {
                HertzDisplacement::new(&HertzianContact { peak_pressure: peak, half_width, friction }, steel)
            };
            StuckShear {
                peak,
                centre: contact.stick_centre(),
                per_half_width: 1.0 / half_width,
                poisson: steel.poisson(),
                displacement: [under(0.0), under(1.0)],
            }
        });
        Ok(Self {
            contact: *contact,
            sliding: HertzField::new(&sliding, steel.poisson()),
            displacement: HertzDisplacement::new(&sliding, steel),
            stuck,
            edges: contact.edges(),
        })
    }
}

impl StuckShear {
    /// The field of shear alone: Φ = W q / 2, as in [`HertzField`].
    #[inline(always)]
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        let x = (point.x - (xc + self.centre)) * self.per_half_width;
        let y = (point.y * self.per_half_width).min(0.0);
        let Transform { w_re, w_im, slope_re, slope_im } = Transform::of(x, y);
        let (trace, q) = (2.0 * w_re, self.peak);
        Stress {
            xx: q * (trace - slope_im),
            yy: q * slope_im,
            zz: q * self.poisson * trace,
            xy: -q * (w_im + slope_re),
        }
    }

    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let [pressure, both] = &self.displacement;
        both.displacement(point, xc + self.centre) - pressure.displacement(point, xc + self.centre)
    }
}

impl Lanes for CarterWheel {
    #[inline(always)]
    fn at(&self, point: Vec2, xc: f64) -> Stress {
        let sliding = self.sliding.stress(point, xc);
        match &self.stuck {
            Some(stuck) => sliding - stuck.stress(point, xc),
            None => sliding,
        }
    }
}

impl Wheel for CarterWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        Lanes::at(self, point, xc)
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        side_by_side(self, points, xc)
    }

    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let sliding = self.displacement.displacement(point, xc);
        self.stuck.map_or(sliding, |stuck| sliding - stuck.displacement(point, xc))
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }
}

/// The stress of the half-plane y ≤ 0 under a flat punch without friction, whose pressure per unit
/// load is 1/(π √(a² − u²)), u = x − x_c: the increment of a Hertzian contact under an increment of
/// its load.
///
/// With z = (x − x_c + i y)/a and s = √(z² − 1) as in [`super::HertzField`], the potential is Φ = i
/// / (2π a s).
///
/// Source: Johnson, Contact Mechanics, 2.8.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FlatPunch {
    /// a, mm.
    pub half_width: f64,
}

impl FlatPunch {
    /// The in-plane stress (MPa per N/mm) at `point` (mm) under a punch centred at `xc` (mm).
    pub(crate) fn stress(&self, point: Vec2, xc: f64) -> Stress {
        let a = self.half_width;
        let (x, y) = ((point.x - xc) / a, (point.y / a).min(0.0));
        let Root { re, im, modulus } = Root::of(x, y);
        let square = modulus.max(f64::MIN_POSITIVE);
        // V = 1/s and V′ = −z V³.
        let (v_re, v_im) = (re / square, -im / square);
        let (v2_re, v2_im) = (v_re * v_re - v_im * v_im, 2.0 * v_re * v_im);
        let (v3_re, v3_im) = (v2_re * v_re - v2_im * v_im, v2_re * v_im + v2_im * v_re);
        let slope = (y * v3_im - x * v3_re, -x * v3_im - y * v3_re);
        let scale = 1.0 / (PI * a);
        let yy = scale * (y * slope.0 - v_im);
        Stress { xx: -2.0 * scale * v_im - yy, yy, zz: 0.0, xy: scale * y * slope.1 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::field_checks::{equilibrium, largest, strains};
    use super::*;
    use crate::field::{HertzField, HertzWheel};
    use crate::load::{HertzianContact, Travel};

    const CARTER: CarterContact = CarterContact {
        peak_pressure: 845.0,
        half_width: 6.75,
        friction: 0.3,
        traction: 0.5,
        travel: Travel::Forward,
    };

    fn steel() -> IsotropicElastic {
        IsotropicElastic::new(210e3, 0.3).unwrap()
    }

    fn wheel(contact: CarterContact) -> CarterWheel {
        CarterWheel::new(&contact, &steel()).unwrap()
    }

    fn points() -> Vec<Vec2> {
        (0..200).map(|i| Vec2::new(0.31 * f64::from(i) - 31.0, -0.17 * f64::from((i * i) % 41))).collect()
    }

    #[test]
    fn full_traction_is_sliding_and_none_is_pressure_alone() {
        for (traction, friction) in [(1.0, 0.3), (-1.0, -0.3), (0.0, 0.0)] {
            let hertz = HertzWheel::new(&HertzianContact { friction, ..CARTER.sliding() }, &steel()).unwrap();
            let carter = wheel(CarterContact { traction, ..CARTER });
            for (one, other) in
                carter.stresses(&points(), 2.0).into_iter().zip(hertz.stresses(&points(), 2.0))
            {
                assert_eq!(one, other);
            }
            assert_eq!(carter.edges(), hertz.edges());
        }
    }

    #[test]
    fn nearly_all_and_nearly_no_traction_are_close_to_the_limits() {
        // c = a √(1 − |ξ|): the stress differs by 2 μ p0 c/a at most.
        let close = |traction: f64, friction: f64, bound: f64| {
            let hertz = HertzWheel::new(&HertzianContact { friction, ..CARTER.sliding() }, &steel()).unwrap();
            let carter = wheel(CarterContact { traction, ..CARTER });
            let pairs = carter.stresses(&points(), 0.0).into_iter().zip(hertz.stresses(&points(), 0.0));
            let error = pairs.map(|(one, other)| largest(one - other)).fold(0.0, f64::max);
            assert!(error < bound, "{traction}: {error}");
        };
        close(1.0 - 1e-8, 0.3, 2.1 * 0.3 * 845.0 * 1e-4);
        close(1e-10, 0.0, 845.0 * 0.3 * 3e-5);
    }

    #[test]
    fn the_surface_bears_pressure_and_shear() {
        for traction in [-0.9, -0.5, 0.2, 0.7] {
            for travel in [Travel::Forward, Travel::Backward] {
                let contact = CarterContact { traction, travel, ..CARTER };
                for i in -150..=150 {
                    let u = 0.1 * f64::from(i) + 0.03;
                    let s = wheel(contact).stress(Vec2::new(u + 2.0, 0.0), 2.0);
                    let error = (s.yy + contact.pressure(u)).abs().max((s.xy - contact.shear(u)).abs());
                    assert!(error < 1e-11, "u = {u}: {error:e}"); // round-off of 845 MPa
                }
            }
        }
    }

    #[test]
    fn is_in_equilibrium_and_its_strains_are_those_of_its_stress() {
        let carter = wheel(CARTER);
        let a = CARTER.half_width;
        for (x, y) in [(0.3, -0.2), (-0.9, -0.15), (1.05, -0.3), (2.0, -1.0), (-3.0, -0.1), (0.0, -0.8)] {
            let point = Vec2::new(a * x, a * y);
            assert!(equilibrium(&carter, point, 1e-4 * a) * a < 1e-6 * 845.0, "x/a {x}, y/a {y}");
            let error = strains(&carter, &steel(), point, 1e-3);
            assert!(error < 1e-6 * 845.0, "x/a {x}, y/a {y}: {error}");
        }
    }

    #[test]
    fn mirrored_shear_and_travel_mirror_the_field() {
        let one = wheel(CARTER);
        let other = wheel(CarterContact { traction: -0.5, travel: Travel::Backward, ..CARTER });
        for point in points() {
            let (s, m) = (one.stress(point, 0.0), other.stress(Vec2::new(-point.x, point.y), 0.0));
            let error = largest(s - Stress { xy: -m.xy, ..m });
            assert!(error < 1e-11, "{point:?}: {error:e}");
        }
    }

    #[test]
    fn is_the_increment_of_a_hertzian_contact() {
        let a = 6.75;
        // p0 and a grow with the root of the load, for the same radius.
        let hertz = |load: f64| {
            let root = load.sqrt();
            let contact =
                HertzianContact { peak_pressure: 845.0 * root, half_width: a * root, friction: 0.0 };
            HertzField::new(&contact, 0.0)
        };
        let (line_load, step) = (0.5 * PI * a * 845.0, 1e-4);
        for (x, y) in [(1.0, -0.5), (6.0, -2.0), (-7.5, -0.3), (-20.0, -11.0), (2.0, -30.0)] {
            let point = Vec2::new(x, y);
            let (more, less) = (hertz(1.0 + step).stress(point, 0.4), hertz(1.0 - step).stress(point, 0.4));
            let got = FlatPunch { half_width: a }.stress(point, 0.4);
            let per_load = 1.0 / (2.0 * step * line_load);
            for (got, more, less) in
                [(got.xx, more.xx, less.xx), (got.yy, more.yy, less.yy), (got.xy, more.xy, less.xy)]
            {
                // Central differences.
                assert!((got - (more - less) * per_load).abs() < 1e-7, "{point:?}: {got}");
            }
        }
    }
}

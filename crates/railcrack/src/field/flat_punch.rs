//! The half-plane under a flat punch, in closed form.

use super::hertz_half_plane::Root;
use crate::math::{Stress, Vec2};
use std::f64::consts::PI;

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
    use super::*;
    use crate::field::HertzField;
    use crate::load::HertzianContact;

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

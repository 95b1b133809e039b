//! Elastic fields in a layer that are waves along the rail, and their reflection.
//!
//! Airy's function φ = f(z) cos kx, z the depth below the top: σ_xx = f″ cos kx, σ_zz = −k² f cos
//! kx, σ_xz = k f′ sin kx. In plane strain 2G u_x = ((1 − ν) f″ + ν k² f)/k sin kx and 2G u_z =
//! −((2 − ν) k² f′ − (1 − ν) f‴)/k² cos kx. A quarter of a wave further along the rail, the same f
//! gives the sine waves.

use super::layers::{Layer, SectionLayers};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2, gauss_legendre};
use std::f64::consts::PI;

/// f and its first three derivatives at a depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Amplitude(pub [f64; 4]);

/// A 2 × 2 matrix, row by row.
pub(super) type Pair = [[f64; 2]; 2];

/// kz beyond which e^(−kz) is nothing beside e^(kz).
const ONE_SIDED: f64 = 20.0;

impl Amplitude {
    /// The two fields that leave the running surface free, at the depth `z` in a head of `height`,
    /// times e^(−k height):
    ///
    /// f₁ = kz sinh kz/(2k²), f₂ = (kz cosh kz − sinh kz)/(2k³).
    ///
    /// For long waves they are uniform tension, σ_xx = 1, and bending, σ_xx = z.
    pub fn below_free_surface(k: f64, z: f64, height: f64) -> [Self; 2] {
        let u = k * z;
        let (s, c) = if u < ONE_SIDED {
            let scale = (-k * height).exp();
            (scale * u.sinh(), scale * u.cosh())
        } else {
            let half = 0.5 * (u - k * height).exp();
            (half, half)
        };
        let one = [
            u * s / (2.0 * k * k),
            (s + u * c) / (2.0 * k),
            0.5 * (2.0 * c + u * s),
            0.5 * k * (3.0 * s + u * c),
        ];
        let two = [
            (u * c - s) / (2.0 * k.powi(3)),
            u * s / (2.0 * k * k),
            (s + u * c) / (2.0 * k),
            0.5 * (2.0 * c + u * s),
        ];
        [Self(one), Self(two)]
    }

    /// The two fields that decay downwards from z = 0.
    pub fn decaying(k: f64, z: f64) -> [Self; 2] {
        let u = k * z;
        let e = (-u).exp();
        let derivatives = |i: i32, f: f64| k.powi(i) * f * e;
        [
            Self([derivatives(0, 1.0), derivatives(1, -1.0), derivatives(2, 1.0), derivatives(3, -1.0)]),
            Self([
                derivatives(0, u),
                derivatives(1, 1.0 - u),
                derivatives(2, u - 2.0),
                derivatives(3, 3.0 - u),
            ]),
        ]
    }

    /// The two fields that decay upwards from z = 0.
    pub fn growing(k: f64, z: f64) -> [Self; 2] {
        let mirrored = |Self([f0, f1, f2, f3]): Self| Self([f0, -f1, f2, -f3]);
        Self::decaying(k, -z).map(mirrored)
    }

    /// Amplitudes of (u_x, u_z) in mm.
    pub fn displacement(self, k: f64, steel: &IsotropicElastic) -> [f64; 2] {
        let Self([f0, f1, f2, f3]) = self;
        let (nu, twice_shear) = (steel.poisson(), steel.young() / (1.0 + steel.poisson()));
        let x = ((1.0 - nu) * f2 + nu * k * k * f0) / k;
        let z = -((2.0 - nu) * k * k * f1 - (1.0 - nu) * f3) / (k * k);
        [x / twice_shear, z / twice_shear]
    }

    /// Amplitudes of (σ_xz, σ_zz), the traction on a layer's lower face.
    pub fn traction(self, k: f64) -> [f64; 2] {
        let Self([f0, f1, ..]) = self;
        [k * f1, -k * k * f0]
    }

    /// The stress at `point` (y upwards) whose depth the amplitude belongs to, of the cosine and
    /// the sine wave.
    pub fn stress(self, k: f64, point: Vec2) -> [Stress; 2] {
        let Self([f0, f1, f2, _]) = self;
        let (sin, cos) = (k * point.x).sin_cos();
        // σ_xy has the opposite sign of σ_xz, because y points up.
        let of = |along: f64, across: f64| Stress {
            xx: f2 * along,
            yy: -k * k * f0 * along,
            xy: k * f1 * across,
            ..Stress::ZERO
        };
        [of(cos, -sin), of(sin, cos)]
    }
}

/// a b.
pub(super) fn times(a: Pair, b: Pair) -> Pair {
    [0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

/// a − b.
pub(super) fn minus(a: Pair, b: Pair) -> Pair {
    [0, 1].map(|i| [0, 1].map(|j| a[i][j] - b[i][j]))
}

/// factor × a.
pub(super) fn scaled(factor: f64, a: Pair) -> Pair {
    a.map(|row| row.map(|value| factor * value))
}

/// a⁻¹.
pub(super) fn inverse([[a, b], [c, d]]: Pair) -> Pair {
    scaled(1.0 / (a * d - b * c), [[d, -b], [-c, a]])
}

/// The matrix with these columns.
pub(super) fn columns([first, second]: [[f64; 2]; 2]) -> Pair {
    [[first[0], second[0]], [first[1], second[1]]]
}

/// Elasticity of the rail and of its support.
#[derive(Debug, Clone, Copy)]
pub(super) struct Support<'a> {
    /// The steel.
    pub steel: &'a IsotropicElastic,
    /// k of the foundation, N/mm per mm of deflection of one rail; 0 for a free rail.
    pub foundation: f64,
}

/// Z(k) at the top of `layers` (from the top downwards), in (σ_xz, σ_zz) = Z (u_x, u_z): the
/// traction on the head's bottom, forces per width `unit` (mm) of the rail.
fn impedance(k: f64, layers: &[Layer], unit: f64, support: Support<'_>) -> Pair {
    // The foundation presses against the deflection.
    let mut below: Pair = [[0.0, 0.0], [0.0, -support.foundation / unit]];
    for &Layer { height, width } in layers.iter().rev() {
        let share = width / unit;
        // Waves that decay from the top and from the bottom of the layer.
        let at = |z: f64| [Amplitude::decaying(k, z), Amplitude::growing(k, z - height)];
        let displacements = |of: [Amplitude; 2]| columns(of.map(|a| a.displacement(k, support.steel)));
        let tractions = |of: [Amplitude; 2]| scaled(share, columns(of.map(|a| a.traction(k))));
        let [down, up] = at(height);
        // What the bottom reflects of a wave from the top.
        let missing = |of: [Amplitude; 2]| minus(tractions(of), times(below, displacements(of)));
        let reflected = times(inverse(missing(up)), scaled(-1.0, missing(down)));
        let [down, up] = at(0.0);
        let both = |of: &dyn Fn([Amplitude; 2]) -> Pair| {
            let sent_back = times(of(up), reflected);
            minus(of(down), scaled(-1.0, sent_back))
        };
        below = times(both(&tractions), inverse(both(&displacements)));
    }
    below
}

/// Q(k), symmetric: with U the work of the tractions of both fields of
/// [`Amplitude::below_free_surface`] on the jumps of cracks in the head, Q U dk are the amplitudes
/// of these fields in what the section reflects.
///
/// By Betti's theorem the crack radiates the decaying waves −B⁻¹ U, with B the bracket of both
/// kinds of waves at the bottom of the head; the rail below has the impedance Z there.
pub(super) fn reflection(k: f64, layers: &SectionLayers, support: Support<'_>) -> Pair {
    let height = layers.head.height;
    // A head without anything below it rests on the foundation itself.
    let impedance = impedance(k, &layers.below, layers.head.width, support);
    let free = Amplitude::below_free_surface(k, height, height);
    let sent = Amplitude::decaying(k, 0.0);
    let displacement = |a: Amplitude| a.displacement(k, support.steel);
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let bracket = [0, 1].map(|j| {
        [0, 1].map(|i| {
            PI * (dot(sent[i].traction(k), displacement(free[j]))
                - dot(free[j].traction(k), displacement(sent[i])))
        })
    });
    let missing = |of: [Amplitude; 2]| {
        minus(columns(of.map(|a| a.traction(k))), times(impedance, columns(of.map(displacement))))
    };
    let [[a, b], [c, d]] = times(times(inverse(missing(free)), missing(sent)), inverse(bracket));
    let off = 0.5 * (b + c);
    [[a, off], [off, d]]
}

/// Wave numbers (1/mm) and weights for the waves between a rail of `layers` and cracks in its head
/// that end `ligament` (mm) above the bottom of the head and extend over `reach` (mm) along the
/// rail.
pub(super) fn wave_numbers(layers: &SectionLayers, ligament: f64, reach: f64) -> Vec<(f64, f64)> {
    let last = DECAYED / ligament;
    let widest = (WIDEST_PANEL / layers.head.height).min(WIDEST_PANEL / reach);
    let rule = gauss_legendre(PANEL_POINTS);
    let mut nodes = Vec::new();
    let mut from = 0.0;
    while from < last {
        let width = from.max(FIRST_PANEL / layers.height()).min(widest);
        nodes.extend(rule.iter().map(|(x, w)| (from + width * x, width * w)));
        from += width;
    }
    nodes
}

/// k times the ligament at which waves, which decay there and back, have vanished: e^(−20).
const DECAYED: f64 = 10.0;
/// Width of the first panel times the height of the rail: below it the rail is a beam.
const FIRST_PANEL: f64 = 0.1;
/// Largest width of a panel times the height of the head, or the reach of the cracks.
const WIDEST_PANEL: f64 = 1.5;
/// Gauss points of a panel.
const PANEL_POINTS: usize = 6;

#[cfg(test)]
mod tests {
    use super::*;

    /// Each stress follows from the displacements by Hooke's law, and is in equilibrium.
    #[test]
    fn fields_are_elastic() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let (k, z, h) = (0.07, 11.0, 1e-3);
        let fields: [fn(f64, f64) -> [Amplitude; 2]; 3] =
            [|k, z| Amplitude::below_free_surface(k, z, 36.0), Amplitude::decaying, Amplitude::growing];
        for field in fields {
            for which in [0, 1] {
                let at = |z: f64| field(k, z)[which];
                let slope = |of: &dyn Fn(Amplitude) -> f64| (of(at(z + h)) - of(at(z - h))) / (2.0 * h);
                let here = at(z);
                let [ux, uz] = here.displacement(k, &steel);
                let [shear, normal] = here.traction(k);
                let along = here.0[2];
                // ε_xx, ε_zz and γ of cos, cos and sin.
                let exx = k * ux;
                let ezz = slope(&|a| a.displacement(k, &steel)[1]);
                let gamma = slope(&|a| a.displacement(k, &steel)[0]) - k * uz;
                let modulus = steel.young() / ((1.0 + 0.3) * (1.0 - 0.6));
                let scale = along.abs() + normal.abs() + shear.abs();
                assert!((modulus * (0.7 * exx + 0.3 * ezz) - along).abs() < 1e-6 * scale);
                assert!((modulus * (0.7 * ezz + 0.3 * exx) - normal).abs() < 1e-6 * scale);
                assert!((210e3 / 2.6 * gamma - shear).abs() < 1e-6 * scale);
                assert!((-k * along + slope(&|a| a.traction(k)[0])).abs() < 1e-6 * k * scale);
                assert!((k * shear + slope(&|a| a.traction(k)[1])).abs() < 1e-6 * k * scale);
            }
        }
    }

    #[test]
    fn long_waves_are_tension_and_bending() {
        let point = Vec2::new(0.0, -20.0);
        let [tension, bending] = Amplitude::below_free_surface(1e-5, 20.0, 36.0);
        assert!((tension.stress(1e-5, point)[0].xx - 1.0).abs() < 1e-3);
        assert!((bending.stress(1e-5, point)[0].xx - 20.0).abs() < 2e-2);
    }
}

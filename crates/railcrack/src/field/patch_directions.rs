//! The half-space under the tractions of a contact patch, as the sum over directions of
//! half-planes.
//!
//! In the direction n = (cos ψ, sin ψ) of the surface a traction f has the projection
//! R(σ) = ∫ f δ(n·x − σ), and f is the sum over ψ from 0 to π of the plane tractions (1/2π) |k|
//! R̂(k). Each is a load of a half-plane in the (n, depth) plane, or of its antiplane problem. With
//! the analytic function
//!
//!   Φ(w) = (1/2π²) ∫ R′(σ)/(w − σ) dσ,  w = n·x + i z,
//!
//! the plane traction at the depth z is Re Φ, and the stress follows from Φ and Φ′. A mean over the
//! lateral place with the weight (1 + β q) e^(−q), q = ρ |k_y|, is the same sum with
//! w = n·x + i (z + ρ |sin ψ|), at no further cost.
//!
//! The projection of a Hertz ellipse on any direction is a parabola; other patches are expanded in
//! Gegenbauer polynomials, whose Φ are Legendre functions of the second kind.

use crate::load::HertzEllipse;
use crate::math::{Stress, gauss_legendre, legendre_second, legendre_zeroth};
use num_complex::Complex64 as Complex;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Traction on the rail at x on a strip: pressure, shear along x and across, MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripTraction {
    /// x from the middle of the patch, mm.
    pub x: f64,
    /// p, q_x, q_y.
    pub traction: [f64; 3],
}

/// The tractions of one contact patch, and where it lies.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchLoad {
    /// x from the wheel's centre and lateral place of its middle, mm; the cracks are at y = 0.
    middle: [f64; 2],
    /// Semi-axes along and across, mm.
    half: [f64; 2],
    tractions: Tractions,
}

#[derive(Debug, Clone, PartialEq)]
enum Tractions {
    /// A Hertz ellipse in full sliding: force (N) of pressure and of shear along and across.
    Sliding([f64; 3]),
    /// Any tractions: x and y from the middle (mm), and forces (N) of pressure and shear.
    Sampled(Arc<[Sample]>),
}

/// The part of the traction that one point of a quadrature stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    at: [f64; 2],
    force: [f64; 3],
}

/// Strips across a patch, and points along each, from which its projections are computed.
const STRIPS: usize = 24;
const ALONG: usize = 48;
/// Order of the expansion of projections: 1e-3 of the peak pressure for a patch that sticks in
/// part.
const ORDER: usize = 10;

impl PatchLoad {
    /// `ellipse` with its middle at `middle`, in full sliding: shear over pressure along and
    /// across.
    #[must_use]
    pub fn sliding(ellipse: &HertzEllipse, middle: [f64; 2], frictions: [f64; 2]) -> Self {
        let load = ellipse.load();
        Self {
            middle,
            half: [ellipse.along, ellipse.across],
            tractions: Tractions::Sliding([load, frictions[0] * load, frictions[1] * load]),
        }
    }

    /// A patch of strips along the rail: semi-axes `half` (mm), and for a lateral place (mm) from
    /// the middle the traction by increasing x, linear in between.
    #[must_use]
    pub fn sampled(middle: [f64; 2], half: [f64; 2], strip: impl Fn(f64) -> Vec<StripTraction>) -> Self {
        let mut samples = Vec::with_capacity(STRIPS * ALONG);
        for row in 0..STRIPS {
            // Gauss and Chebyshev's points of the second kind, for a load that ends as a root.
            let angle = PI * (row as f64 + 1.0) / (STRIPS as f64 + 1.0);
            let (sin, cos) = angle.sin_cos();
            let points = strip(half[1] * cos);
            let across = PI / (STRIPS as f64 + 1.0) * half[1] * sin;
            sample_strip(&points, half[1] * cos, across, &mut samples);
        }
        Self { middle, half, tractions: Tractions::Sampled(samples.into()) }
    }

    /// Force (N) of pressure and of shear along and across.
    #[must_use]
    pub fn force(&self) -> [f64; 3] {
        match &self.tractions {
            Tractions::Sliding(force) => *force,
            Tractions::Sampled(samples) => samples.iter().fold([0.0; 3], |mut sum, sample| {
                sum.iter_mut().zip(sample.force).for_each(|(sum, own)| *sum += own);
                sum
            }),
        }
    }

    /// Semi-axes along and across, mm.
    #[must_use]
    pub fn half(&self) -> [f64; 2] {
        self.half
    }

    /// Unit loads with their middle at x = 0 and the factors with which their sum is this one:
    /// ellipses of its shape with a = 1 mm, or itself.
    pub(super) fn in_units(&self) -> (Vec<Self>, Vec<f64>) {
        let [a, b] = self.half;
        let Tractions::Sliding(force) = &self.tractions else {
            let middle = [0.0, self.middle[1]];
            return (vec![Self { middle, ..self.clone() }], vec![1.0]);
        };
        // Loads that differ by round-off have one shape.
        let rounded = |length: f64| (length / a * SHAPES).round() / SHAPES;
        let (middle, half) = ([0.0, rounded(self.middle[1])], [1.0, rounded(b)]);
        let loads = if force[2] == 0.0 { 2 } else { 3 };
        let unit = |own: usize| {
            let tractions = Tractions::Sliding(std::array::from_fn(|i| f64::from(u8::from(i == own))));
            Self { middle, half, tractions }
        };
        ((0..loads).map(unit).collect(), force[..loads].iter().map(|force| force / (a * a)).collect())
    }

    /// x from the wheel's centre and lateral place of its middle, mm.
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        self.middle
    }
}

/// Shapes of ellipses differ by one in so many at least.
const SHAPES: f64 = 1e9;

/// The points of a strip `across` mm wide at the lateral place `y` (mm).
fn sample_strip(points: &[StripTraction], y: f64, across: f64, samples: &mut Vec<Sample>) {
    let [first, .., last] = points else { return };
    let (middle, reach) = (0.5 * (first.x + last.x), 0.5 * (last.x - first.x));
    let mut next = 1;
    for column in 0..ALONG {
        let angle = PI * (1.0 - (column as f64 + 0.5) / ALONG as f64);
        let (sin, cos) = angle.sin_cos();
        let x = middle + reach * cos;
        while next + 1 < points.len() && points[next].x < x {
            next += 1;
        }
        let (a, b) = (&points[next - 1], &points[next]);
        let part = if b.x > a.x { ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0) } else { 0.0 };
        let area = across * PI / ALONG as f64 * reach * sin;
        let force = [0, 1, 2].map(|i| area * (a.traction[i] + part * (b.traction[i] - a.traction[i])));
        samples.push(Sample { at: [x, y], force });
    }
}

/// A direction of the sum over ψ with the coefficients of Φ for its load.
#[derive(Debug, Clone, PartialEq)]
struct Direction {
    /// cos ψ and sin ψ.
    cos: f64,
    sin: f64,
    /// Half the extent of the projection, mm.
    reach: f64,
    /// Coefficients of Q_1, Q_2, … in Φ of pressure, of shear along n and along t, times the weight
    /// of the direction: `[order]`.
    coefficients: Vec<[f64; 3]>,
}

/// The sums over directions of a patch, coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PatchDirections {
    middle: [f64; 2],
    half: [f64; 2],
    rules: [Vec<Direction>; RULES.len()],
    poisson: f64,
}

/// Directions within a quarter turn, and whether they crowd towards the lateral one: for points far
/// below the load, near it, below it, at the surface, and far away at the surface, where what lies
/// ahead and behind is seen within a narrow angle.
const RULES: [(usize, Crowded); 6] = [
    (10, Crowded::AcrossTheRail),
    (18, Crowded::Nowhere),
    (30, Crowded::Nowhere),
    (48, Crowded::Nowhere),
    (36, Crowded::AcrossTheRail),
    (120, Crowded::AcrossTheRail),
];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Crowded {
    Nowhere,
    AcrossTheRail,
}

impl PatchDirections {
    /// The directions of `patch` on a rail with this Poisson's ratio, one in `coarseness` of them.
    pub fn new(patch: &PatchLoad, poisson: f64, coarseness: usize) -> Self {
        let rules = RULES.map(|(count, crowded)| directions(patch, (count / coarseness, crowded)));
        Self { middle: patch.middle, half: patch.half, rules, poisson }
    }

    /// The stress (MPa, with y the depth turned upwards) at x (mm) from the wheel's centre and
    /// `depth` (mm), in the plane y = 0, averaged along the front with `spread`.
    pub fn stress(&self, x: f64, depth: f64, spread: Spread) -> Stress {
        let [even, odd] = self.parts(x, depth, spread.reach);
        (even + odd * spread.beta) * spread.share
    }

    /// [`PatchDirections::stress`] with the weight e^(−q), and what β = 1 adds to it; `reach` is ρ
    /// (mm).
    pub fn parts(&self, x: f64, depth: f64, reach: f64) -> [Stress; 2] {
        let mut sum = [Stress::ZERO; 2];
        let (x, y) = (x - self.middle[0], -self.middle[1]);
        let depth = depth.max(SHALLOWEST * self.half[0]);
        for direction in &self.rules[self.rule(x, y, depth, reach)] {
            let [even, odd] = direction.stress([x, y], depth, reach, self.poisson);
            sum = [sum[0] + even, sum[1] + odd];
        }
        sum
    }

    /// Semi-axis along the rail, mm.
    pub fn half(&self) -> f64 {
        self.half[0]
    }

    /// x of its middle from the wheel's centre, mm.
    pub fn middle(&self) -> f64 {
        self.middle[0]
    }

    /// The displacement along x and upwards (mm), times 2G, in the plane y = 0.
    pub fn displacement(&self, x: f64, depth: f64) -> [f64; 2] {
        let (x, y) = (x - self.middle[0], -self.middle[1]);
        let depth = depth.max(SHALLOWEST * self.half[0]);
        let rule = &self.rules[self.rule(x, y, depth, 0.0)];
        rule.iter().fold([0.0; 2], |sum, direction| {
            let own = direction.displacement([x, y], depth, self.poisson);
            [sum[0] + own[0], sum[1] + own[1]]
        })
    }

    /// The rule for a point: the integrand varies over an angle of its distance below or beside the
    /// load over the distance from its middle.
    fn rule(&self, x: f64, y: f64, depth: f64, reach: f64) -> usize {
        let away = (x / self.half[0]).hypot(y / self.half[1]);
        let below = (depth + 0.3 * reach) / self.half[0].min(self.half[1]);
        match (away, below) {
            (2.5.., _) if below > 0.5 * away => 0,
            (2.5.., 0.4..) => 4,
            (1.2.., ..0.4) | (1.0.., ..0.1) => 5,
            (_, 1.2..) => 1,
            (_, 0.25..) => 2,
            _ => 3,
        }
    }
}

/// Points are assumed to lie at least this share of a below the surface.
const SHALLOWEST: f64 = 1e-6;

/// How a load along the front counts: α (1 + β q) e^(−q) with q = ρ |k|.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// α.
    pub share: f64,
    /// ρ, mm.
    pub reach: f64,
    /// β.
    pub beta: f64,
}

impl Spread {
    /// The load at the place of the point alone.
    pub(super) const NONE: Self = Self { share: 1.0, reach: 0.0, beta: 0.0 };
}

/// Directions of `patch` from −π/2 to π/2, `count` in each quarter turn.
///
/// tan ψ = (a/b) tan χ: in χ the projection of a slender ellipse changes evenly.
fn directions(patch: &PatchLoad, (count, crowded): (usize, Crowded)) -> Vec<Direction> {
    let [a, b] = patch.half;
    let ratio = a / b;
    let mut all = Vec::with_capacity(2 * count);
    for (point, weight) in gauss_legendre(count) {
        let (point, weight) = match crowded {
            Crowded::Nowhere => (point, weight),
            Crowded::AcrossTheRail => (1.0 - (1.0 - point).powi(2), 2.0 * (1.0 - point) * weight),
        };
        let (sin_chi, cos_chi) = (FRAC_PI_2 * point).sin_cos();
        let length = cos_chi.hypot(ratio * sin_chi);
        let (cos, sin) = (cos_chi / length, ratio * sin_chi / length);
        let weight = FRAC_PI_2 * weight * ratio / (length * length);
        for sin in [sin, -sin] {
            all.push(direction(patch, [cos, sin], weight));
        }
    }
    if patch.middle[1] == 0.0 && matches!(patch.tractions, Tractions::Sliding([.., 0.0])) {
        // The directions on both sides add the same.
        all = all.into_iter().step_by(2).map(Direction::doubled).collect();
    }
    all
}

fn direction(patch: &PatchLoad, [cos, sin]: [f64; 2], weight: f64) -> Direction {
    let [a, b] = patch.half;
    let ellipse = (a * cos).hypot(b * sin);
    let (reach, moments) = match &patch.tractions {
        Tractions::Sliding(force) => (ellipse, vec![*force]),
        Tractions::Sampled(samples) => {
            let across = |sample: &Sample| (sample.at[0] * cos + sample.at[1] * sin).abs();
            let reach = samples.iter().map(across).fold(ellipse, f64::max);
            (reach, gegenbauer_moments(samples, [cos, sin], reach))
        }
    };
    let of_order = |(n, [p, along, across]): (usize, &[f64; 3])| {
        let factor = -weight * (n as f64 + 1.5) / (PI * PI * reach * reach);
        [factor * p, factor * (along * cos + across * sin), factor * (across * cos - along * sin)]
    };
    Direction { cos, sin, reach, coefficients: moments.iter().enumerate().map(of_order).collect() }
}

/// Σ force C_n^(3/2)(t) of the samples, t = n·x/`reach`: `[n]`, up to [`ORDER`].
fn gegenbauer_moments(samples: &[Sample], [cos, sin]: [f64; 2], reach: f64) -> Vec<[f64; 3]> {
    let mut moments = vec![[0.0; 3]; ORDER];
    for Sample { at, force } in samples {
        let t = (at[0] * cos + at[1] * sin) / reach;
        let (mut value, mut before) = (1.0, 0.0);
        for (n, moment) in moments.iter_mut().enumerate() {
            moment.iter_mut().zip(force).for_each(|(moment, force)| *moment += value * force);
            let n = n as f64;
            (value, before) = (((2.0 * n + 3.0) * t * value - (n + 2.0) * before) / (n + 1.0), value);
        }
    }
    moments
}

/// Q_1, Q_1′ and Q_1″ at `u` off the interval [−1, 1].
fn first_legendre(u: Complex) -> [Complex; 3] {
    let square = u * u;
    let inverse = 1.0 / (square - 1.0);
    if u.norm_sqr() > SERIES {
        let w = 1.0 / square;
        let value = w * (1.0 / 3.0 + w * (0.2 + w * (1.0 / 7.0 + w / 9.0)));
        let slope = -w * (2.0 / 3.0 + w * (0.8 + w * (6.0 / 7.0 + w * 8.0 / 9.0))) / u;
        return [value, slope, 2.0 * inverse * inverse];
    }
    let zeroth = legendre_zeroth(u);
    [u * zeroth - 1.0, zeroth - u * inverse, 2.0 * inverse * inverse]
}

/// |u|² beyond which a series has no cancellation.
const SERIES: f64 = 400.0;

/// Φ of pressure and of both shears.
type Potentials = [Complex; 3];

impl Direction {
    fn doubled(mut self) -> Self {
        self.coefficients.iter_mut().flatten().for_each(|coefficient| *coefficient *= 2.0);
        self
    }

    /// Φ, Φ′ and Φ″ of the loads at w/reach = `u`.
    fn potentials(&self, u: Complex) -> [Potentials; 3] {
        if let [only] = self.coefficients[..] {
            let scale = 1.0 / self.reach;
            let [value, slope, curvature] = first_legendre(u);
            return [value, slope * scale, curvature * (scale * scale)]
                .map(|value| only.map(|coefficient| coefficient * value));
        }
        // With (u² − 1) Q_m′ = m (u Q_m − Q_{m−1}) and Legendre's equation for Q_m″.
        let q = legendre_second::<{ ORDER + 1 }>(u);
        let [mut values, mut first, mut before, mut second] = [[Complex::new(0.0, 0.0); 3]; 4];
        for (n, coefficients) in self.coefficients.iter().enumerate() {
            let (lower, own, m) = (q[n], q[n + 1], (n + 1) as f64);
            for (i, coefficient) in coefficients.iter().enumerate() {
                let part = own * *coefficient;
                values[i] += part;
                first[i] += part * m;
                before[i] += lower * (*coefficient * m);
                second[i] += part * (m * (m + 1.0));
            }
        }
        let inverse = 1.0 / (u * u - 1.0);
        let slopes = [0, 1, 2].map(|i| inverse * (u * first[i] - before[i]));
        let curvatures = [0, 1, 2].map(|i| inverse * (second[i] - 2.0 * u * slopes[i]));
        let scale = 1.0 / self.reach;
        [values, slopes.map(|slope| slope * scale), curvatures.map(|own| own * (scale * scale))]
    }

    /// Σ coefficients times `of` the order, a multiple of Q_m, m from 1.
    fn sum(&self, of: impl Fn(usize) -> Complex) -> Potentials {
        let mut sum = [Complex::new(0.0, 0.0); 3];
        for (n, coefficients) in self.coefficients.iter().enumerate() {
            let value = of(n + 1);
            sum.iter_mut().zip(coefficients).for_each(|(sum, own)| *sum += *own * value);
        }
        sum
    }

    /// The stress with a load along the front weighted with e^(−q), and what β = 1 adds to it.
    fn stress(&self, [x, y]: [f64; 2], depth: f64, reach: f64, poisson: f64) -> [Stress; 2] {
        let lowered = reach * self.sin.abs();
        let u = Complex::new(x * self.cos + y * self.sin, depth + lowered) / self.reach;
        let [potentials, slopes, curvatures] = self.potentials(u);
        let share = Complex::new(0.0, -lowered);
        let added = [slopes, curvatures].map(|of| of.map(|own| share * own));
        [
            self.in_the_plane(potentials, slopes, depth, poisson),
            self.in_the_plane(added[0], added[1], depth, poisson),
        ]
    }

    /// σ_xx, σ_yy, σ_zz (across the plane) and σ_xy from Φ and Φ′ of the loads.
    fn in_the_plane(&self, of: Potentials, slopes: Potentials, depth: f64, poisson: f64) -> Stress {
        let [p, n, t] = of;
        let [p_slope, n_slope, _] = slopes;
        let turned = Complex::I * depth;
        let vertical = -(p - turned * p_slope).re + depth * n_slope.re;
        let along = -(p + turned * p_slope).re + (2.0 * Complex::I * n - depth * n_slope).re;
        let out = 2.0 * poisson * ((Complex::I * n).re - p.re);
        let shear = -depth * p_slope.re + (n + turned * n_slope).re;
        let (twist, antiplane) = ((Complex::I * t).re, t.re);
        let (c, s) = (self.cos, self.sin);
        Stress {
            xx: along * c * c - 2.0 * twist * c * s + out * s * s,
            yy: vertical,
            zz: along * s * s + 2.0 * twist * c * s + out * c * c,
            xy: shear * c - antiplane * s,
        }
    }

    /// u_x and u_y (upwards), times 2G.
    fn displacement(&self, [x, y]: [f64; 2], depth: f64, poisson: f64) -> [f64; 2] {
        let u = Complex::new(x * self.cos + y * self.sin, depth) / self.reach;
        let q = legendre_second::<{ ORDER + 2 }>(u);
        let [p, n, _] = self.sum(|m| q[m]);
        // ∫ Q_m du = (Q_{m+1} − Q_{m−1})/(2m + 1).
        let integral = |m: usize| self.reach * (q[m + 1] - q[m - 1]) / (2.0 * m as f64 + 1.0);
        let [of_p, of_n, of_t] = self.sum(integral);
        let (near, stiff) = (1.0 - 2.0 * poisson, 2.0 * (1.0 - poisson));
        let i = Complex::I;
        let along = -near * of_p.re - depth * (i * p).re + stiff * (i * of_n).re - depth * n.re;
        let up = -stiff * (i * of_p).re - depth * p.re - near * of_n.re + depth * (i * n).re;
        let beside = 2.0 * (i * of_t).re;
        [along * self.cos - beside * self.sin, up]
    }
}

//! Waves of several directions at a time, whose sum is the stress under an elliptical contact.

use super::lanes::{LANES, Lanes, angles, exponentials, logarithms, sines_and_cosines};
use super::plane::Symmetric;
use std::f64::consts::PI;

/// |w|² above which series in 1/w replace the logarithms, and the last term of these series.
const FAR: f64 = 64.0;
const LAST_TERM: u32 = 15;

/// A contact and a point in its field.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// The semi-axes a along the rail and b across, mm.
    pub half_axes: [f64; 2],
    /// x/a and y/b of the point, from the centre.
    pub at: [f64; 2],
    /// Its depth, mm.
    pub depth: f64,
    /// Ratios of shear along the rail and across to pressure.
    pub friction: [f64; 2],
    pub poisson: f64,
}

/// A node of a rule in a stretched neighbourhood of a parametric angle: φ = `at` + `width` sinh t.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub at: f64,
    pub width: f64,
    pub t: f64,
    pub weight: f64,
}

/// The sum over nodes, of which the last ones wait until there is one for each lane.
pub(super) struct Directions {
    place: Place,
    at: Lanes,
    width: Lanes,
    t: Lanes,
    weight: Lanes,
    waiting: usize,
    sums: [Lanes; 6],
}

impl Directions {
    #[inline(always)]
    pub fn new(place: Place) -> Self {
        let [at, width, t, weight] = [[0.0; LANES]; 4];
        Self { place, at, width, t, weight, waiting: 0, sums: [[0.0; LANES]; 6] }
    }

    #[inline(always)]
    pub fn add(&mut self, node: Node) {
        let lane = self.waiting % LANES;
        self.at[lane] = node.at;
        self.width[lane] = node.width;
        self.t[lane] = node.t;
        self.weight[lane] = node.weight;
        self.waiting = lane + 1;
        if self.waiting == LANES {
            self.sum();
        }
    }

    /// The stress over p₀/π.
    #[inline(always)]
    pub fn total(mut self) -> Symmetric {
        if self.waiting > 0 {
            self.weight[self.waiting..].fill(0.0);
            self.sum();
        }
        self.sums.map(|lanes| lanes.iter().sum())
    }

    /// Adds what waits.
    #[inline(always)]
    fn sum(&mut self) {
        let Place { half_axes: [a, b], at: [along, across], depth, friction, poisson } = self.place;
        let grown = exponentials(&self.t);
        let (mut phi, mut weight) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let shrunk = 1.0 / grown[i];
            phi[i] = self.at[i] + 0.5 * self.width[i] * (grown[i] - shrunk);
            weight[i] = 0.5 * self.weight[i] * self.width[i] * (grown[i] + shrunk);
        }
        let [sin, cos] = sines_and_cosines(&phi);
        let (mut c, mut s, mut below) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let mut w = [[0.0; LANES]; 2];
        for i in 0..LANES {
            let (x, y) = (cos[i] / a, sin[i] / b);
            let wave = (x * x + y * y).sqrt();
            (c[i], s[i], below[i]) = (x / wave, y / wave, depth * wave);
            (w[0][i], w[1][i]) = (below[i], -(along * cos[i] + across * sin[i]));
        }
        let [[j, ji], [k, ki]] = waves_of_hertz(&w);
        for i in 0..LANES {
            let (c, s, weight) = (c[i], s[i], weight[i]);
            let (j, ji, k, ki) = (j[i], ji[i], below[i] * k[i], below[i] * ki[i]);
            // Shear along and across the direction.
            let along = friction[0] * c + friction[1] * s;
            let across = friction[1] * c - friction[0] * s;
            // Pressure, then shear: plane strain with the depth and the direction, antiplane shear.
            let uu = -(j - k) - along * (2.0 * ji - ki);
            let vv = -2.0 * poisson * (j + along * ji);
            let uz = -ki - along * (j - k);
            let (vz, uv) = (-across * j, -across * ji);
            self.sums[0][i] += weight * (c * c * uu + s * s * vv - 2.0 * c * s * uv);
            self.sums[1][i] += weight * (s * s * uu + c * c * vv + 2.0 * c * s * uv);
            self.sums[2][i] -= weight * (j + k + along * ki);
            self.sums[3][i] += weight * (s * uz + c * vz);
            self.sums[4][i] += weight * (c * uz - s * vz);
            self.sums[5][i] += weight * (c * s * (uu - vv) + (c * c - s * s) * uv);
        }
        self.waiting = 0;
    }
}

/// Real and imaginary parts.
type Complex = [Lanes; 2];

/// 1 − w arccot w and minus its derivative, arccot w − w/(1 + w²), of Re w > 0.
#[inline(always)]
fn waves_of_hertz(w: &Complex) -> [Complex; 2] {
    let mut sizes = [0.0; LANES];
    for i in 0..LANES {
        sizes[i] = w[0][i] * w[0][i] + w[1][i] * w[1][i];
    }
    let far = sizes.iter().filter(|size| **size >= FAR).count();
    if far == 0 {
        return near_waves(w, &sizes);
    }
    let series = far_waves(w, &sizes);
    if far == LANES {
        return series;
    }
    let mut waves = near_waves(w, &sizes);
    for (waves, series) in waves.iter_mut().flatten().zip(series.iter().flatten()) {
        for i in 0..LANES {
            waves[i] = if sizes[i] < FAR { waves[i] } else { series[i] };
        }
    }
    waves
}

#[inline(always)]
fn near_waves(w: &Complex, sizes: &Lanes) -> [Complex; 2] {
    let [re, im] = w;
    let (mut doubled, mut less, mut ratios, mut product) =
        ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let above = re[i] * re[i] + (1.0 - im[i]) * (1.0 - im[i]);
        let below = re[i] * re[i] + (1.0 + im[i]) * (1.0 + im[i]);
        doubled[i] = 2.0 * re[i];
        less[i] = (sizes[i] - 1.0).abs();
        ratios[i] = above / below;
        product[i] = above * below;
    }
    let (steep, logarithms) = (angles(&doubled, &less), logarithms(&ratios));
    let mut arccot = [[0.0; LANES]; 2];
    let mut quotient = [[0.0; LANES]; 2];
    for i in 0..LANES {
        let angle = if sizes[i] < 1.0 { PI - steep[i] } else { steep[i] };
        (arccot[0][i], arccot[1][i]) = (0.5 * angle, 0.25 * logarithms[i]);
        // w / (1 + w²); the squared modulus of the divisor is the product.
        let (real, imaginary) = (1.0 + re[i] * re[i] - im[i] * im[i], -2.0 * re[i] * im[i]);
        quotient[0][i] = (re[i] * real - im[i] * imaginary) / product[i];
        quotient[1][i] = (re[i] * imaginary + im[i] * real) / product[i];
    }
    let shares = times(w, &arccot);
    let (mut one, mut two) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
    for i in 0..LANES {
        (one[0][i], one[1][i]) = (1.0 - shares[0][i], -shares[1][i]);
        (two[0][i], two[1][i]) = (arccot[0][i] - quotient[0][i], arccot[1][i] - quotient[1][i]);
    }
    [one, two]
}

#[inline(always)]
fn far_waves(w: &Complex, sizes: &Lanes) -> [Complex; 2] {
    let mut inverse = [[0.0; LANES]; 2];
    for i in 0..LANES {
        (inverse[0][i], inverse[1][i]) = (w[0][i] / sizes[i], -w[1][i] / sizes[i]);
    }
    let square = times(&inverse, &inverse);
    let (mut one, mut two) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
    for term in (3..=LAST_TERM).rev().step_by(2) {
        let odd = f64::from(term);
        (one, two) = (next(&one, &square, 1.0 / odd), next(&two, &square, (odd - 1.0) / odd));
    }
    [times(&one, &square), times(&times(&two, &square), &inverse)]
}

/// `first` less the product of the sum of the later terms of a series with 1/w².
#[inline(always)]
fn next(sum: &Complex, square: &Complex, first: f64) -> Complex {
    let mut next = times(sum, square);
    for i in 0..LANES {
        (next[0][i], next[1][i]) = (first - next[0][i], -next[1][i]);
    }
    next
}

#[inline(always)]
fn times([a, b]: &Complex, [c, d]: &Complex) -> Complex {
    let mut product = [[0.0; LANES]; 2];
    for i in 0..LANES {
        product[0][i] = a[i] * c[i] - b[i] * d[i];
        product[1][i] = a[i] * d[i] + b[i] * c[i];
    }
    product
}

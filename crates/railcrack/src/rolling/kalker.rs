//! Creepages, Kalker's coefficients of the contact ellipse, and theories of rolling contact.

use crate::math::OutOfRange;
use crate::words::{Choice, Word};
use std::f64::consts::{LN_2, PI};

/// Coefficients of the linear theory of rolling contact.
///
/// Source: Kalker 1967, On the Rolling Contact of Two Elastic Bodies in the Presence of Dry
/// Friction, Delft: table of the coefficients for ν = 0, ¼ and ½, and their asymptotes for slender
/// ellipses. Between the axis ratios of the table they are linear in the ratio of the shorter axis
/// to the longer one, and between the values of ν their inverse is a parabola.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KalkerCoefficients {
    /// C11, longitudinal creepage.
    pub c11: f64,
    /// C22, lateral creepage.
    pub c22: f64,
    /// C23 = −C32, lateral force by spin.
    pub c23: f64,
}

/// Coefficients for ν = 0, ¼ and ½.
type ByPoisson = [f64; 3];

/// C11, C22 and C23 for the ratios 0.1, 0.2, … 1 of the shorter to the longer semi-axis.
type ByRatio = [[ByPoisson; 3]; 10];

/// Of a to b, a ≤ b.
#[expect(clippy::approx_constant, reason = "3.14 is a coefficient")]
const NARROW: ByRatio = [
    [[2.51, 3.31, 4.85], [2.51, 2.52, 2.53], [0.334, 0.473, 0.731]],
    [[2.59, 3.37, 4.81], [2.59, 2.63, 2.66], [0.483, 0.603, 0.809]],
    [[2.68, 3.44, 4.80], [2.68, 2.75, 2.81], [0.607, 0.715, 0.889]],
    [[2.78, 3.53, 4.82], [2.78, 2.88, 2.98], [0.720, 0.823, 0.977]],
    [[2.88, 3.62, 4.83], [2.88, 3.01, 3.14], [0.827, 0.929, 1.07]],
    [[2.98, 3.72, 4.91], [2.98, 3.14, 3.31], [0.930, 1.03, 1.18]],
    [[3.09, 3.81, 4.97], [3.09, 3.28, 3.48], [1.03, 1.14, 1.29]],
    [[3.19, 3.91, 5.05], [3.19, 3.41, 3.65], [1.13, 1.25, 1.40]],
    [[3.29, 4.01, 5.12], [3.29, 3.54, 3.82], [1.23, 1.36, 1.51]],
    [[3.40, 4.12, 5.20], [3.40, 3.67, 3.98], [1.33, 1.47, 1.63]],
];

/// Of b to a, a ≥ b.
const LONG: ByRatio = [
    [[10.7, 11.7, 12.9], [10.7, 12.8, 16.0], [12.2, 14.6, 18.0]],
    [[6.96, 7.78, 8.82], [6.96, 8.14, 9.79], [5.72, 6.63, 7.89]],
    [[5.57, 6.34, 7.34], [5.57, 6.40, 7.51], [3.79, 4.32, 5.01]],
    [[4.84, 5.57, 6.57], [4.84, 5.48, 6.31], [2.88, 3.24, 3.70]],
    [[4.37, 5.10, 6.11], [4.37, 4.90, 5.56], [2.35, 2.62, 2.96]],
    [[4.06, 4.78, 5.80], [4.06, 4.50, 5.04], [2.01, 2.23, 2.50]],
    [[3.82, 4.54, 5.58], [3.82, 4.21, 4.67], [1.76, 1.95, 2.18]],
    [[3.65, 4.36, 5.42], [3.65, 3.99, 4.39], [1.58, 1.75, 1.94]],
    [[3.51, 4.22, 5.30], [3.51, 3.81, 4.16], [1.44, 1.59, 1.77]],
    [[3.40, 4.12, 5.20], [3.40, 3.67, 3.98], [1.33, 1.47, 1.63]],
];

/// C11, C22 and C23 of a slender ellipse by the ratio of its axes and ν.
type Asymptote = fn(f64, f64) -> [f64; 3];

/// The smallest ratio of the tables, and their step.
const STEP: f64 = 0.1;

impl KalkerCoefficients {
    /// The coefficients of an ellipse with the axis ratio a/b = `ratio` (a along the rail,
    /// positive) of bodies with Poisson's ratio `poisson`.
    #[must_use]
    pub fn of(ratio: f64, poisson: f64) -> Self {
        let (table, slender) = match ratio <= 1.0 {
            true => (&NARROW, narrow_limit as Asymptote),
            false => (&LONG, long_limit as Asymptote),
        };
        let shorter = ratio.min(1.0 / ratio);
        let row = |i: usize| table[i].map(|by_poisson| at_poisson(by_poisson, poisson));
        let [c11, c22, c23] = if shorter < STEP {
            // The asymptotes, joined to the first row of the table.
            let (limit, first, edge) = (slender(shorter, poisson), row(0), slender(STEP, poisson));
            [0, 1, 2].map(|i| limit[i] * (1.0 + (first[i] / edge[i] - 1.0) * shorter / STEP))
        } else {
            let place = shorter / STEP - 1.0;
            let below = (place as usize).min(table.len() - 2);
            let (low, high, part) = (row(below), row(below + 1), place - below as f64);
            [0, 1, 2].map(|i| (1.0 - part) * low[i] + part * high[i])
        };
        Self { c11, c22, c23 }
    }
}

/// The parabola in 1/C through ν = 0, ¼ and ½.
fn at_poisson(coefficients: ByPoisson, poisson: f64) -> f64 {
    let weights = [
        8.0 * (poisson - 0.25) * (poisson - 0.5),
        -16.0 * poisson * (poisson - 0.5),
        8.0 * poisson * (poisson - 0.25),
    ];
    let inverse: f64 = coefficients.iter().zip(weights).map(|(value, weight)| weight / value).sum();
    1.0 / inverse
}

/// a/b = g → 0.
fn narrow_limit(g: f64, poisson: f64) -> [f64; 3] {
    let half_lambda = 0.5 * (16.0 / (g * g)).ln();
    let spin = 1.0 + poisson * (half_lambda + 2.0 * LN_2 - 5.0);
    let rigid = 1.0 - poisson;
    [0.25 * PI * PI / rigid, 0.25 * PI * PI, PI * g.sqrt() * spin / (3.0 * rigid)]
}

/// b/a = g → 0.
fn long_limit(g: f64, poisson: f64) -> [f64; 3] {
    let lambda = (16.0 / (g * g)).ln();
    let rest = 3.0 - 2.0 * LN_2;
    let (along, across) = (lambda - 2.0 * poisson, (1.0 - poisson) * lambda + 2.0 * poisson);
    let spin = (1.0 - poisson) * lambda - 2.0 + 4.0 * poisson;
    [
        2.0 * PI / (along * g) * (1.0 + rest / along),
        2.0 * PI / (across * g) * (1.0 + (1.0 - poisson) * rest / across),
        2.0 * PI / (3.0 * g * g.sqrt() * spin),
    ]
}

/// Rigid slip of wheel and rail over the speed of travel, at the point (x, y) of the patch
/// (ξ − φ y, η + φ x): x with the travel, y across; the spin turns +x towards +y.
///
/// The signs are those of CONTACT: ξ > 0 of a driving wheel, whose force on the rail is F_x < 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Creepage {
    /// ξ, along the rail.
    pub longitudinal: f64,
    /// η, across the rail.
    pub lateral: f64,
    /// φ, per mm.
    pub spin: f64,
}

impl Creepage {
    /// Rejects values that are not finite.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_finite("longitudinal creepage", self.longitudinal)?;
        OutOfRange::unless_finite("lateral creepage", self.lateral)?;
        OutOfRange::unless_finite("spin (1/mm)", self.spin)
    }

    /// Whether wheel and rail roll on each other without slip.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The same creepage with all signs exchanged.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { longitudinal: -self.longitudinal, lateral: -self.lateral, spin: -self.spin }
    }
}

/// Convention for the signs of creepages and spin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CreepageSign {
    /// Those of [`Creepage`].
    Contact,
    /// All signs opposite.
    Vehicle,
}

impl CreepageSign {
    /// `given` in this convention, in that of [`Creepage`].
    #[must_use]
    pub fn read(self, given: Creepage) -> Creepage {
        match self {
            Self::Contact => given,
            Self::Vehicle => given.reversed(),
        }
    }
}

impl Choice for CreepageSign {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Contact,
            Word::now("contact", "of the program CONTACT: longitudinal creepage > 0 of a driving wheel"),
        ),
        (
            Self::Vehicle,
            Word::now(
                "vehicle",
                "of most vehicle codes, (V - omega r)/V: longitudinal creepage > 0 of a braking wheel",
            ),
        ),
    ];
}

/// A theory of the shear in rolling contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RollingTheory {
    /// Strips of Carter's form with the shear of Kalker's strip theory (1967), which does not slip
    /// where it sticks, scaled to Kalker's coefficients; of all closest to the exact theory.
    #[default]
    Strip,
    /// The same strips with the shear of Sichani et al. (2016).
    FaStrip,
    /// Kalker's simplified theory (1982).
    Fastsim,
    /// Kalker's linear theory (1967): forces without saturation.
    Linear,
}

impl Choice for RollingTheory {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Strip,
            Word::now(
                "strip",
                "strips of Carter's form by Kalker's strip theory, scaled to his coefficients",
            ),
        ),
        (Self::FaStrip, Word::now("fastrip", "the same with the shear of Sichani et al. 2016")),
        (
            Self::Fastsim,
            Word::now("fastsim", "Kalker's simplified theory with a parabolic limit of the shear"),
        ),
        (
            Self::Linear,
            Word::now("linear", "Kalker's linear theory; its force is distributed like the pressure"),
        ),
    ];
}

//! The weights with which a load along a straight crack front counts at one of its points.
//!
//! A traction cos(k y) on the faces at the distance s from the mouth of a surface crack of length l
//! with a long straight front changes K of a point of the front as the plane load does, times
//!
//!   ŵ(k) = (1 + β q) e^(−q),  q = c √(l² − s²) |k|,
//!
//! with c and β of the angle below the surface. They are those of shear on closed faces, which drive
//! cracks under wheels, and serve for all tractions: `examples/front_weights.rs` computes them by
//! the engine in space and compares both modes. Within ν = 0.25 to 0.35 they change by 5 %.
//! In an infinite body a crack with one tip has ŵ = (1 + …) e^(−r|k|) (Kassir and Sih 1975), and a
//! buried one that of its nearer tip.

use super::patch_directions::Spread;
use crate::math::Vec2;

/// A crack as a line from its first point on, and which of its ends are tips.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackLine {
    /// Its points, mm.
    pub points: Vec<Vec2>,
    /// Whether the first and the last point are tips.
    pub tips: [bool; 2],
}

/// A place on a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceOnCrack {
    /// Position, mm.
    pub point: Vec2,
    /// Index of the crack, from 0.
    pub crack: usize,
    /// Arc length from its first point, mm.
    pub s: f64,
}

/// Stresses that load cracks as a wheel does whose load varies along their fronts.
pub trait StressesOnCracks: Send + Sync {
    /// The stress (MPa) at each of the `places` with the wheel at `xc` (mm), as it counts for the
    /// front.
    fn stresses(&self, places: &[PlaceOnCrack], xc: f64) -> Vec<crate::math::Stress>;

    /// The pressure (MPa) over the mouth of a crack (index from 0) with the wheel at `xc` (mm), as
    /// it counts for the front.
    fn over_mouth(&self, crack: usize, xc: f64) -> f64;
}

/// Angles (degrees) of the table, and c and β of shear on closed faces.
const ANGLES: [f64; 10] = [10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 75.0, 90.0];
const DECAYS: [f64; 10] = [0.766, 0.817, 0.858, 0.891, 0.918, 0.953, 0.971, 0.976, 0.974, 0.971];
const BETAS: [f64; 10] = [1.10, 1.07, 1.05, 1.02, 1.00, 0.98, 0.99, 1.01, 1.07, 1.10];
/// A buried crack: ρ/r at its nearer tip, and by how much less it is in its middle.
const BURIED: [f64; 2] = [1.3, 0.4];

/// The spread at every place of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrontSpread {
    length: f64,
    tips: [bool; 2],
    decay: f64,
    beta: f64,
}

impl FrontSpread {
    /// That of `line`, by the angle of its chord.
    pub fn of(line: &CrackLine) -> Self {
        let length = line.points.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum();
        let chord = match line.points[..] {
            [first, .., last] => last - first,
            _ => Vec2::default(),
        };
        let angle = chord.y.abs().atan2(chord.x.abs()).to_degrees();
        let [decay, beta] = [DECAYS, BETAS].map(|values| between(angle, &values));
        Self { length, tips: line.tips, decay, beta }
    }

    /// The spread at the arc length `s` (mm).
    pub fn at(&self, s: f64) -> Spread {
        let l = self.length;
        let from_root = match self.tips {
            [true, false] => l - s,
            [false, _] => s,
            [true, true] => {
                let r = s.min(l - s).max(0.0);
                return Spread { reach: (BURIED[0] - BURIED[1] * r / l) * r, beta: 1.0 };
            }
        };
        Spread { reach: self.decay * (l * l - from_root * from_root).max(0.0).sqrt(), beta: self.beta }
    }

    /// The parameter φ of an arc length in which ρ is smooth: s = l sin φ from a mouth.
    pub fn parameter(&self, s: f64) -> f64 {
        let part = (s / self.length).clamp(0.0, 1.0);
        match self.tips {
            [true, true] => (1.0 - 2.0 * part).acos(),
            [true, false] => std::f64::consts::FRAC_PI_2 - (1.0 - part).asin(),
            [false, _] => part.asin(),
        }
    }

    /// The arc length of a parameter.
    pub fn arc(&self, parameter: f64) -> f64 {
        match self.tips {
            [true, true] => 0.5 * self.length * (1.0 - parameter.cos()),
            [true, false] => self.length * (1.0 - parameter.cos()),
            [false, _] => self.length * parameter.sin(),
        }
    }
}

/// Linear between the angles of the table.
fn between(angle: f64, values: &[f64; ANGLES.len()]) -> f64 {
    let above = ANGLES.partition_point(|known| *known < angle).clamp(1, ANGLES.len() - 1);
    let (low, high) = (ANGLES[above - 1], ANGLES[above]);
    let part = ((angle - low) / (high - low)).clamp(0.0, 1.0);
    values[above - 1] + part * (values[above] - values[above - 1])
}

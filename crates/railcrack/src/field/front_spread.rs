//! The weights with which a load along a straight crack front counts at one of its points.
//!
//! A traction cos(k y) on the faces at the distance s from the mouth of a surface crack of length l
//! with a long straight front changes K of a point of the front as the plane load does, times
//!
//!   ŵ(k) = α (1 + β q) e^(−q),  q = R l |k|,
//!
//! with α, β and R of s/l, of the angle below the surface and of the length on the surface over
//! that down the dip. They are those of shear on closed faces, which drive cracks under wheels, and
//! serve for all tractions: `examples/front_weights.rs` computes them by the engine in space; the
//! form fits to 2 % up to k l = 6, to 4 % where the front is a semicircle. Within ν = 0.25 to 0.35
//! they change by 5 %. Far from the surface, next to a front, shear has (1 + 2ν/(2 − ν) q) e^(−q)
//! with the distance from the front (Kassir and Sih 1975); a buried crack has that of its nearer
//! tip.

use super::patch_directions::Spread;
use crate::math::{Stress, Vec2};
use std::sync::Arc;

/// A crack as a line from its first point on, and which of its ends are tips.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackLine {
    /// Its points, mm.
    pub points: Vec<Vec2>,
    /// Whether the first and the last point are tips.
    pub tips: [bool; 2],
    /// Half its extent along the surface over its length; infinite for a long front.
    pub width: f64,
}

impl CrackLine {
    /// Length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum()
    }

    /// Arc lengths (mm) of the vertices at which it turns by `least` degrees or more.
    pub(super) fn kinks(&self, least: f64) -> Vec<f64> {
        let mut s = 0.0;
        let turns = |around: &[Vec2]| {
            let [before, after] = [around[1] - around[0], around[2] - around[1]];
            s += before.length();
            (before.cross(after).atan2(before.dot(after)).to_degrees().abs() >= least).then_some(s)
        };
        self.points.windows(3).filter_map(turns).collect()
    }

    /// How a load along the front counts at the arc length `s` (mm).
    #[must_use]
    pub fn spread(&self, s: f64) -> Spread {
        FrontSpread::of(self).at(s)
    }

    /// The angle of its chord below the surface, degrees up to 90.
    fn angle(&self) -> f64 {
        let chord = match self.points[..] {
            [first, .., last] => last - first,
            _ => Vec2::default(),
        };
        chord.y.abs().atan2(chord.x.abs()).to_degrees()
    }

    /// K of the deepest point of the front over that of a long one under an even load.
    #[must_use]
    pub fn width_factor(&self) -> f64 {
        weights(self.angle(), self.width)[0][EVEN]
    }
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

/// Stresses (MPa) at fixed places as a function of the wheel position x_c (mm).
pub type StressesByPosition<'a> = Box<dyn Fn(f64) -> Vec<Stress> + Send + Sync + 'a>;

/// Stresses that load cracks as a wheel does whose load varies along their fronts.
pub trait StressesOnCracks: Send + Sync {
    /// The stress (MPa) at each of the `places` as a function of the position x_c (mm) of the
    /// wheel, as it counts for the front.
    fn at<'a>(self: Arc<Self>, places: &[PlaceOnCrack]) -> StressesByPosition<'a>
    where
        Self: 'a;

    /// The pressure (MPa) over the mouth of a crack (index from 0) with the wheel at `xc` (mm), as
    /// it counts for the front.
    fn over_mouth(&self, crack: usize, xc: f64) -> f64;
}

/// Angles (degrees) and places s/l of the tables.
const ANGLES: [f64; 6] = [10.0, 15.0, 25.0, 45.0, 60.0, 90.0];
const PLACES: [f64; 7] = [0.06, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];
type ByPlace = [f64; PLACES.len()];
type ByAngle = [ByPlace; ANGLES.len()];

/// The contribution of shear on closed faces to K of the deepest point: α (1 + β q) e^(−q) times
/// that in the plane, q = R k l.
struct Weights {
    share: ByAngle,
    beta: ByAngle,
    reach: ByAngle,
}

/// Of a semi-ellipse twice as long on the surface as down the dip.
const ROUND: Weights = Weights {
    share: [
        [0.723, 0.732, 0.746, 0.760, 0.776, 0.807, 0.841],
        [0.691, 0.701, 0.714, 0.728, 0.752, 0.793, 0.834],
        [0.646, 0.653, 0.668, 0.692, 0.729, 0.777, 0.833],
        [0.609, 0.620, 0.642, 0.672, 0.710, 0.769, 0.834],
        [0.613, 0.625, 0.640, 0.667, 0.706, 0.764, 0.831],
        [0.641, 0.640, 0.648, 0.664, 0.701, 0.758, 0.829],
    ],
    beta: [
        [1.483, 1.466, 1.414, 1.358, 1.274, 1.124, 1.020],
        [1.493, 1.482, 1.438, 1.380, 1.277, 1.126, 1.034],
        [1.506, 1.510, 1.463, 1.376, 1.274, 1.134, 1.022],
        [1.522, 1.511, 1.463, 1.378, 1.258, 1.121, 1.031],
        [1.530, 1.526, 1.486, 1.391, 1.259, 1.124, 1.036],
        [1.535, 1.539, 1.502, 1.399, 1.260, 1.119, 1.035],
    ],
    reach: [
        [0.775, 0.725, 0.655, 0.570, 0.450, 0.275, 0.135],
        [0.795, 0.750, 0.685, 0.595, 0.455, 0.275, 0.135],
        [0.825, 0.790, 0.715, 0.600, 0.455, 0.275, 0.130],
        [0.850, 0.805, 0.725, 0.610, 0.455, 0.270, 0.130],
        [0.850, 0.815, 0.745, 0.625, 0.460, 0.270, 0.130],
        [0.840, 0.825, 0.765, 0.640, 0.465, 0.270, 0.130],
    ],
};

/// Of one four times as long; α tends to 1 with the cube of depth over length, the others stay.
const LONG: Weights = Weights {
    share: [
        [0.938, 0.935, 0.938, 0.940, 0.949, 0.954, 0.940],
        [0.925, 0.922, 0.927, 0.931, 0.943, 0.949, 0.937],
        [0.895, 0.898, 0.901, 0.910, 0.929, 0.934, 0.931],
        [0.869, 0.874, 0.880, 0.893, 0.912, 0.923, 0.926],
        [0.874, 0.883, 0.885, 0.898, 0.918, 0.923, 0.924],
        [0.904, 0.902, 0.904, 0.908, 0.929, 0.923, 0.923],
    ],
    beta: [
        [1.170, 1.215, 1.190, 1.180, 1.080, 0.920, 0.815],
        [1.170, 1.215, 1.189, 1.166, 1.046, 0.902, 0.816],
        [1.192, 1.183, 1.193, 1.114, 0.976, 0.873, 0.822],
        [1.219, 1.206, 1.184, 1.109, 0.955, 0.850, 0.827],
        [1.221, 1.208, 1.195, 1.106, 0.930, 0.819, 0.830],
        [1.241, 1.233, 1.221, 1.119, 0.910, 0.815, 0.821],
    ],
    reach: [
        [0.800, 0.760, 0.690, 0.615, 0.480, 0.290, 0.120],
        [0.845, 0.810, 0.735, 0.650, 0.490, 0.290, 0.120],
        [0.920, 0.865, 0.800, 0.665, 0.485, 0.290, 0.125],
        [0.990, 0.925, 0.830, 0.690, 0.495, 0.290, 0.130],
        [0.980, 0.925, 0.850, 0.710, 0.500, 0.285, 0.130],
        [0.955, 0.930, 0.880, 0.740, 0.510, 0.290, 0.130],
    ],
};

/// α by which K of an even load is that of the plane: that of its mean place.
const EVEN: usize = 4;

/// Weights at all places of a crack with this angle (degrees) and half length over length: α, β and
/// R.
fn weights(angle: f64, width: f64) -> [ByPlace; 3] {
    let above = ANGLES.partition_point(|known| *known < angle).clamp(1, ANGLES.len() - 1);
    let (low, high) = (ANGLES[above - 1], ANGLES[above]);
    let part = ((angle - low) / (high - low)).clamp(0.0, 1.0);
    let inverse = (1.0 / width).min(1.0);
    // Between semi-ellipses of 4:1 and 2:1.
    let round = (2.0 * inverse - 1.0).max(0.0);
    let narrow = (2.0 * inverse).min(1.0).powi(3);
    let at = |table: &ByAngle, place: usize| {
        table[above - 1][place] + part * (table[above][place] - table[above - 1][place])
    };
    let mixed = |of: fn(&Weights) -> &ByAngle| {
        std::array::from_fn(|place| (1.0 - round) * at(of(&LONG), place) + round * at(of(&ROUND), place))
    };
    let share = mixed(|own| &own.share).map(|share: f64| 1.0 - narrow * (1.0 - share));
    [share, mixed(|own| &own.beta), mixed(|own| &own.reach)]
}

/// A buried crack: ρ/r at its nearer tip, and by how much less it is in its middle.
const BURIED: [f64; 2] = [1.3, 0.4];

/// The spread at every place of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrontSpread {
    length: f64,
    tips: [bool; 2],
    share: ByPlace,
    beta: ByPlace,
    reach: ByPlace,
}

impl FrontSpread {
    /// That of `line`, by the angle of its chord.
    pub fn of(line: &CrackLine) -> Self {
        let [share, beta, reach] = weights(line.angle(), line.width);
        let even = share[EVEN];
        Self { length: line.length(), tips: line.tips, share: share.map(|own| own / even), beta, reach }
    }

    /// The spread at the arc length `s` (mm).
    pub fn at(&self, s: f64) -> Spread {
        let l = self.length;
        let from_root = match self.tips {
            [true, false] => l - s,
            [false, _] => s,
            [true, true] => {
                let r = s.min(l - s).max(0.0);
                return Spread { share: 1.0, reach: (BURIED[0] - BURIED[1] * r / l) * r, beta: 1.0 };
            }
        };
        let place = (from_root / l).clamp(0.0, 1.0);
        let [share, beta] = [&self.share, &self.beta].map(|values| between(place, values));
        // At the front ρ vanishes.
        let last = PLACES.len() - 1;
        let reach = match place > PLACES[last] {
            true => self.reach[last] * (1.0 - place) / (1.0 - PLACES[last]),
            false => between(place, &self.reach),
        };
        Spread { share, reach: reach * l, beta }
    }
}

/// Linear between the places of the table, and beyond the first one.
fn between(place: f64, values: &ByPlace) -> f64 {
    let above = PLACES.partition_point(|known| *known < place).clamp(1, PLACES.len() - 1);
    let (low, high) = (PLACES[above - 1], PLACES[above]);
    let part = ((place - low) / (high - low)).min(1.0);
    values[above - 1] + part * (values[above] - values[above - 1])
}

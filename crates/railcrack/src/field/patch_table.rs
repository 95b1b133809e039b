//! The stress of a contact patch by depth, spread along the front and place of the wheel: a table
//! that is filled where cracks ask for it, and that all cracks and all wheels of its shape share.
//!
//! The stress at a depth z, spread over the reach ρ with (1 + β q) e^(−q), is F + β G with F and G
//! of z, ρ and the place of the wheel. They vary over a share of r = z + ρ, next to the surface as
//! √(z/r), and along the rail over a share of the distance from the edges of the contact. Places of
//! the table are even in ln r, in √(z/r), and in asinh((x − a)/w) + asinh((x + a)/w), and a stress
//! is interpolated between six in each direction.

use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use crate::math::Stress;
use rayon::prelude::*;
use std::collections::VecDeque;
use std::sync::{Arc, LazyLock, Mutex, OnceLock, PoisonError};

/// The smallest r over a, places of r and the difference of their logarithms: up to 4800 a.
const SMALLEST: f64 = 0.004;
const RADII: usize = 29;
const RADIUS_STEP: f64 = 0.5;
/// Places of √(z/r) from 0 to 1.
const ANGLES: usize = 10;
/// Places between which a stress is interpolated.
const POINTS: usize = 6;

/// σ_xx, σ_yy, σ_zz and σ_xy.
const COMPONENTS: usize = 4;

/// F and G of each unit load at each place along the rail, to the digits of single precision:
/// `[load][part][along][component]`.
type Column = Box<[f32]>;

/// The table of one patch, or of all ellipses of one shape.
#[derive(Debug)]
pub(super) struct PatchTable {
    shape: Shape,
    loads: Vec<PatchDirections>,
    /// `[radius][angle]`
    columns: Vec<OnceLock<Column>>,
}

/// Unit loads of which the load of a wheel is a sum.
#[derive(Debug, Clone, PartialEq)]
struct Shape {
    loads: Vec<PatchLoad>,
    poisson: f64,
}

/// The patch of a wheel as a sum of the loads of a table.
#[derive(Debug, Clone)]
pub(super) struct TabledPatch {
    table: Arc<PatchTable>,
    factors: Vec<f64>,
    /// Semi-axis and middle along the rail, mm.
    half: f64,
    middle: f64,
}

/// The stress of a patch at one place of a crack by the place of the wheel.
#[derive(Debug)]
pub(super) struct PlaceColumn {
    along: &'static Along,
    half: f64,
    middle: f64,
    /// `[along][component]`, MPa
    values: Box<[f32]>,
}

impl TabledPatch {
    /// `load` on a rail with this Poisson's ratio.
    pub fn new(load: &PatchLoad, poisson: f64) -> Self {
        let (loads, factors) = load.in_units();
        let table = PatchTable::shared(Shape { loads, poisson });
        Self { table, factors, half: load.half()[0], middle: load.middle()[0] }
    }

    /// The stress (MPa) at `depth` (mm), averaged along the front with `spread`.
    pub fn at(&self, depth: f64, spread: Spread) -> PlaceColumn {
        let unit = Spread { reach: spread.reach / self.half, ..spread };
        let values = self.table.stresses(&self.factors, depth / self.half, unit);
        PlaceColumn { along: &ALONG, half: self.half, middle: self.middle, values }
    }
}

impl PlaceColumn {
    /// The stress of `patch` at few places along the rail, without a table.
    pub fn coarse(patch: &PatchDirections, depth: f64, spread: Spread) -> Self {
        let (half, middle) = (patch.half(), patch.middle());
        let at = |x: &f64| components(patch.stress(middle + half * x, depth, spread));
        let along = &*COARSELY_ALONG;
        Self { along, half, middle, values: along.places.iter().flat_map(at).collect() }
    }

    /// The stress (MPa) at x (mm) from the wheel's centre.
    pub fn at(&self, x: f64) -> Stress {
        let x = (x - self.middle) / self.half;
        // Beyond, where it is a millionth of the peak pressure, it falls with the square.
        let nearer = x.clamp(-FARTHEST, FARTHEST);
        let place = Along::parameter(nearer) / self.along.step + self.along.middle;
        let (first, weights) = between(place, self.along.places.len());
        let mut sum = [0.0f32; COMPONENTS];
        let around = self.values[COMPONENTS * first..].chunks_exact(COMPONENTS);
        around.zip(weights).for_each(|(value, weight)| add(&mut sum, value, weight as f32));
        let [xx, yy, zz, xy] = sum.map(f64::from);
        let stress = Stress { xx, yy, zz, xy };
        if nearer == x { stress } else { stress * (nearer / x).powi(2) }
    }
}

/// Tables that are kept for further wheels.
const KEPT: usize = 16;

impl PatchTable {
    /// The table of `shape`: one that other wheels have filled, if any.
    fn shared(shape: Shape) -> Arc<Self> {
        static TABLES: Mutex<VecDeque<Arc<PatchTable>>> = Mutex::new(VecDeque::new());
        let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        let known = tables.iter().position(|table| table.shape == shape);
        let table = match known.and_then(|known| tables.remove(known)) {
            Some(table) => table,
            None => Arc::new(Self::new(shape)),
        };
        tables.push_front(Arc::clone(&table));
        tables.truncate(KEPT);
        table
    }

    fn new(shape: Shape) -> Self {
        let directions = |load| PatchDirections::new(load, shape.poisson, 1);
        Self {
            loads: shape.loads.iter().map(directions).collect(),
            columns: std::iter::repeat_with(OnceLock::new).take(RADII * ANGLES).collect(),
            shape,
        }
    }

    /// The stress at the places along the rail; lengths over a.
    fn stresses(&self, factors: &[f64], depth: f64, spread: Spread) -> Box<[f32]> {
        let radius = (depth + spread.reach).max(SMALLEST);
        let (radius_first, by_radius) = between((radius / SMALLEST).ln() / RADIUS_STEP, RADII);
        let angle = (depth / radius).clamp(0.0, 1.0).sqrt();
        let (angle_first, by_angle) = between(angle * (ANGLES - 1) as f64, ANGLES);
        self.fill(radius_first, angle_first);
        let mut sum = vec![0.0; COMPONENTS * ALONG.places.len()].into_boxed_slice();
        for (i, of_radius) in by_radius.iter().enumerate() {
            for (j, of_angle) in by_angle.iter().enumerate() {
                let weight = spread.share * of_radius * of_angle;
                if weight == 0.0 {
                    continue;
                }
                let column = self.column(radius_first + i, angle_first + j);
                for (values, factor) in column.chunks_exact(2 * sum.len()).zip(factors) {
                    let even = (weight * factor) as f32;
                    let odd = (weight * factor * spread.beta) as f32;
                    let (of_even, of_odd) = values.split_at(sum.len());
                    for ((sum, of_even), of_odd) in sum.iter_mut().zip(of_even).zip(of_odd) {
                        *sum = (*sum + of_even * even) + of_odd * odd;
                    }
                }
            }
        }
        sum
    }

    /// Computes the columns that are interpolated from these first places on and not yet known.
    fn fill(&self, radius: usize, angle: usize) {
        let around = (0..POINTS * POINTS).map(|cell| (radius + cell / POINTS, angle + cell % POINTS));
        let is_known =
            |(radius, angle): &(usize, usize)| self.columns[radius * ANGLES + angle].get().is_some();
        let missing: Vec<_> = around.filter(|place| !is_known(place)).collect();
        if !missing.is_empty() {
            missing.into_par_iter().for_each(|(radius, angle)| {
                self.column(radius, angle);
            });
        }
    }

    fn column(&self, radius: usize, angle: usize) -> &[f32] {
        self.columns[radius * ANGLES + angle].get_or_init(|| {
            let radius = SMALLEST * (RADIUS_STEP * radius as f64).exp();
            let depth = radius * (angle as f64 / (ANGLES - 1) as f64).powi(2);
            let of = |load: &PatchDirections| {
                let a = load.half();
                let at = |x: &f64| load.parts(x * a, depth * a, (radius - depth) * a);
                let parts: Vec<[Stress; 2]> = ALONG.places.iter().map(at).collect();
                let flat = |part: usize| parts.iter().flat_map(move |own| components(own[part]));
                flat(0).chain(flat(1)).collect::<Vec<f32>>()
            };
            self.loads.iter().flat_map(of).collect()
        })
    }
}

fn components(stress: Stress) -> [f32; COMPONENTS] {
    [stress.xx, stress.yy, stress.zz, stress.xy].map(|component| component as f32)
}

fn add(sum: &mut [f32], values: &[f32], factor: f32) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value * factor;
    }
}

/// Places along the rail over a, even in the parameter.
#[derive(Debug)]
struct Along {
    places: Vec<f64>,
    /// The difference of the parameter from place to place.
    step: f64,
    /// The place, as a number, of the middle.
    middle: f64,
}

/// w and the farthest place over a.
const EDGE: f64 = 0.002;
const FARTHEST: f64 = 1000.0;

static ALONG: LazyLock<Along> = LazyLock::new(|| Along::new(0.35));
static COARSELY_ALONG: LazyLock<Along> = LazyLock::new(|| Along::new(1.0));

impl Along {
    fn new(step: f64) -> Self {
        let half = (Self::parameter(FARTHEST) / step).ceil() as usize;
        let one_side: Vec<f64> = (1..=half).map(|i| Self::place(step * i as f64)).collect();
        let behind = one_side.iter().rev().map(|x| -x);
        let places = behind.chain([0.0]).chain(one_side.iter().copied()).collect();
        Self { places, step, middle: half as f64 }
    }

    /// The sum of asinh of both distances, as one logarithm.
    fn parameter(x: f64) -> f64 {
        let [near, far] = [x.abs() - 1.0, x.abs() + 1.0].map(|distance| distance / EDGE);
        let [of_near, of_far] = [near.abs(), far].map(|own| own + (own * own + 1.0).sqrt());
        (if near < 0.0 { of_far / of_near } else { of_far * of_near }).ln().copysign(x)
    }

    /// The place of a parameter, by bisection.
    fn place(parameter: f64) -> f64 {
        let (mut low, mut high) = (0.0, 2.0 * FARTHEST);
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if Self::parameter(middle) < parameter { low = middle } else { high = middle }
        }
        low
    }
}

/// The first of the places around `place` of so many, and their weights.
fn between(place: f64, count: usize) -> (usize, [f64; POINTS]) {
    let first = (place as usize + 1).saturating_sub(POINTS / 2).min(count - POINTS);
    (first, weights(place - first as f64))
}

/// Weights of the values at 0, 1, … in the curve of the lowest degree through all of them.
fn weights(x: f64) -> [f64; POINTS] {
    let [a, b, c, d, e, f] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|place| x - place);
    let (ab, cd, ef) = (a * b, c * d, e * f);
    [
        -b * cd * ef / 120.0,
        a * cd * ef / 24.0,
        -ab * d * ef / 12.0,
        ab * c * ef / 12.0,
        -ab * cd * f / 24.0,
        ab * cd * e / 120.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::CrackLine;
    use crate::load::HertzEllipse;
    use crate::math::Vec2;

    #[test]
    fn between_its_places_it_is_the_stress_of_the_patch() {
        let ellipse = HertzEllipse { peak_pressure: 1000.0, along: 6.0, across: 4.0 };
        let load = PatchLoad::sliding(&ellipse, [0.5, 1.0], [0.3, 0.05]);
        let (patch, tabled) = (PatchDirections::new(&load, 0.3, 1), TabledPatch::new(&load, 0.3));
        // Smaller ones are next to the surface, where the directions of the patch are seen.
        for (length, angle, accepted) in
            [(0.3, 15.0, 4e-3), (1.0, 25.0, 2e-3), (3.0, 20.0, 2e-3), (12.0, 20.0, 2e-3), (40.0, 60.0, 2e-3)]
        {
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let line = CrackLine {
                points: vec![Vec2::default(), Vec2::new(length * cos, -length * sin)],
                tips: [false, true],
                width: f64::INFINITY,
            };
            for part in [0.0, 0.003, 0.01, 0.06, 0.2, 0.6, 0.95, 1.0] {
                let (depth, spread) = (part * length * sin, line.spread(part * length));
                let column = tabled.at(depth, spread);
                let off = |i: u16| {
                    let x = 0.016 * f64::from(i) - 12.0;
                    let (exact, found) = (patch.stress(x, depth, spread), column.at(x));
                    let off = [exact.xx - found.xx, exact.yy - found.yy, exact.xy - found.xy];
                    off.into_iter().fold(0.0, |most: f64, own| most.max(own.abs())) / ellipse.peak_pressure
                };
                let most = (0..1500).map(off).fold(0.0, f64::max);
                assert!(most < accepted, "{length} mm at {part}: {most:.1e} p0");
            }
        }
    }

    #[test]
    fn loads_of_one_shape_share_a_table() {
        let patch = |peak_pressure: f64, along: f64, friction: f64| {
            let ellipse = HertzEllipse { peak_pressure, along, across: 0.7 * along };
            TabledPatch::new(&PatchLoad::sliding(&ellipse, [0.0, 0.1 * along], [friction, 0.0]), 0.27)
        };
        let (one, other) = (patch(900.0, 5.0, 0.1), patch(1100.0, 6.0 + 1e-12, 0.4));
        assert!(Arc::ptr_eq(&one.table, &other.table));
        let aside = PatchLoad::sliding(
            &HertzEllipse { peak_pressure: 900.0, along: 5.0, across: 3.5 },
            [0.0, 0.6],
            [0.1, 0.0],
        );
        assert!(!Arc::ptr_eq(&one.table, &TabledPatch::new(&aside, 0.27).table));
    }
}

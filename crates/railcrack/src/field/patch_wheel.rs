//! A wheel whose contact is a patch, not a line, over cracks with straight fronts.

use super::Wheel;
use super::front_spread::{CrackLine, FrontSpread, PlaceOnCrack, StressesByPosition, StressesOnCracks};
use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A wheel on the half-space. Its stress and displacement are those in the plane y = 0 of the
/// cracks; what loads them is the mean along their fronts ([`Wheel::on_cracks`]).
#[derive(Debug, Clone, PartialEq)]
pub struct PatchWheel {
    patches: Vec<PatchDirections>,
    edges: Vec<f64>,
    half_width: f64,
    shear_modulus: f64,
    /// Step of its tables on cracks over that of a fine wheel.
    coarseness: usize,
}

impl PatchWheel {
    /// The wheel with `patches`, at least one, on a rail of `steel`.
    #[must_use]
    pub fn new(patches: &[PatchLoad], steel: &IsotropicElastic) -> Self {
        Self::of_coarseness(patches, steel, 1)
    }

    /// The same at a quarter of the cost, with stresses to some per cent.
    #[must_use]
    pub fn coarse(patches: &[PatchLoad], steel: &IsotropicElastic) -> Self {
        Self::of_coarseness(patches, steel, 2)
    }

    fn of_coarseness(patches: &[PatchLoad], steel: &IsotropicElastic, coarseness: usize) -> Self {
        let ends = |patch: &PatchLoad| {
            let (x, a) = (patch.middle()[0], patch.half()[0]);
            [x - a, x + a]
        };
        let mut edges: Vec<f64> = patches.iter().flat_map(ends).collect();
        edges.sort_by(f64::total_cmp);
        Self {
            patches: patches
                .iter()
                .map(|patch| PatchDirections::new(patch, steel.poisson(), coarseness))
                .collect(),
            edges,
            half_width: patches.iter().map(|patch| patch.half()[0]).fold(0.0, f64::max),
            shear_modulus: steel.shear_modulus(),
            coarseness,
        }
    }

    /// The stress (MPa) at x (mm) from the wheel's centre and y (mm), averaged with `spread`.
    fn spread_stress(&self, x: f64, y: f64, spread: Spread) -> Stress {
        self.patches.iter().fold(Stress::ZERO, |sum, patch| sum + patch.stress(x, -y, spread))
    }
}

impl Wheel for PatchWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        self.spread_stress(point.x - xc, point.y, Spread::NONE)
    }

    fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let sum = self.patches.iter().fold([0.0; 2], |sum, patch| {
            let own = patch.displacement(point.x - xc, -point.y);
            [sum[0] + own[0], sum[1] + own[1]]
        });
        Vec2::new(sum[0], sum[1]) * (0.5 / self.shear_modulus)
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn on_cracks<'a>(&'a self, cracks: &[CrackLine]) -> Option<Arc<dyn StressesOnCracks + 'a>> {
        let tables = cracks.iter().map(|line| CrackTable::new(self, line)).collect();
        Some(Arc::new(OnCracks { wheel: self, cracks: tables }))
    }
}

/// The stresses of a wheel on cracks, from tables.
struct OnCracks<'a> {
    wheel: &'a PatchWheel,
    cracks: Vec<CrackTable>,
}

impl StressesOnCracks for OnCracks<'_> {
    fn at<'a>(self: Arc<Self>, places: &[PlaceOnCrack]) -> StressesByPosition<'a>
    where
        Self: 'a,
    {
        let mut first = 0;
        let used: Vec<(usize, usize)> = (0..self.cracks.len())
            .filter(|crack| places.iter().any(|place| place.crack == *crack))
            .map(|crack| {
                let own = (crack, first);
                first += self.cracks[crack].nodes.len();
                own
            })
            .collect();
        let between = |place: &PlaceOnCrack| {
            let before = used.iter().find(|(crack, _)| *crack == place.crack).map_or(0, |own| own.1);
            let (start, weights) = self.cracks[place.crack].between(place.s);
            (before + start, weights)
        };
        let places: Vec<(usize, [f64; MOST_POINTS])> = places.iter().map(between).collect();
        Box::new(move |xc| {
            let nodes: Vec<Stress> = used
                .iter()
                .flat_map(|(crack, _)| &self.cracks[*crack].nodes)
                .map(|node| node.at(self.wheel, xc))
                .collect();
            places.iter().map(|(start, weights)| weighted(&nodes, *start, weights)).collect()
        })
    }

    fn over_mouth(&self, crack: usize, xc: f64) -> f64 {
        let mouth = &self.cracks[crack].mouth;
        (-mouth.at(self.wheel, xc).yy).max(0.0)
    }
}

/// Nodes within a quarter turn of the parameter of a crack, and the most between which a stress is
/// interpolated.
const NODES: usize = 14;
const MOST_POINTS: usize = 4;
/// A vertex at which a crack turns by more (radians) is an end of a leg.
const KINK: f64 = 0.05;

/// The stresses at nodes of a crack, which are dense enough to interpolate along it.
struct CrackTable {
    spread: FrontSpread,
    nodes: Vec<NodeTable>,
    /// For each leg, its first parameter, the distance of its nodes, their number, the first node.
    legs: Vec<Leg>,
    /// The running surface over its first point, spread as in the middle of the crack.
    mouth: NodeTable,
}

#[derive(Debug, Clone, Copy)]
struct Leg {
    from: f64,
    step: f64,
    count: usize,
    first: usize,
}

/// Share of the length at which the pressure over a mouth is spread as there.
const INSIDE: f64 = 0.5;

impl CrackTable {
    fn new(wheel: &PatchWheel, line: &CrackLine) -> Self {
        let spread = FrontSpread::of(line);
        let arcs = arcs(&line.points);
        let ends = leg_ends(&line.points, &arcs);
        let (mut nodes, mut legs) = (Vec::new(), Vec::new());
        for pair in ends.windows(2) {
            let (from, to) = (spread.parameter(pair[0]), spread.parameter(pair[1]));
            let count = nodes_of_leg(NODES as f64 * (to - from) / FRAC_PI_2);
            let step = (to - from) / (count - 1) as f64;
            // Its first node is the last one of the leg before.
            let shared = usize::from(!nodes.is_empty());
            legs.push(Leg { from, step, count, first: nodes.len() - shared });
            for i in shared..count {
                let s = spread.arc(from + step * i as f64).clamp(pair[0], pair[1]);
                nodes.push(NodeTable::new(wheel, position(&line.points, &arcs, s), spread.at(s)));
            }
        }
        let total = arcs[arcs.len() - 1];
        let first = line.points.first().copied().unwrap_or_default();
        let mouth = NodeTable::new(wheel, Vec2::new(first.x, 0.0), spread.at(INSIDE * total));
        Self { spread, nodes, legs, mouth }
    }

    /// The first of the nodes between which the stress at the arc length `s` (mm) is interpolated,
    /// and their weights.
    fn between(&self, s: f64) -> (usize, [f64; MOST_POINTS]) {
        let parameter = self.spread.parameter(s);
        let next = self.legs.partition_point(|leg| leg.from <= parameter);
        let leg = self.legs[next.max(1) - 1];
        let place = (parameter - leg.from) / leg.step;
        let points = leg.count.min(MOST_POINTS);
        let start = (place.floor() as usize).saturating_sub(1).min(leg.count - points);
        (leg.first + start, lagrange(place - start as f64, points))
    }
}

/// Nodes of a leg that is as long as so many of their distances: fewer than four where a curve of a
/// lower degree is as close over its length.
fn nodes_of_leg(length: f64) -> usize {
    match length {
        ..0.5 => 2,
        ..1.5 => 3,
        _ => (length.ceil() as usize + 1).max(MOST_POINTS),
    }
}

/// Weights of the values at 0, 1, … in the curve of the lowest degree through `points` of them, two
/// to four.
fn lagrange(x: f64, points: usize) -> [f64; MOST_POINTS] {
    let (a, b, c, d) = (x, x - 1.0, x - 2.0, x - 3.0);
    match points {
        ..=2 => [-b, a, 0.0, 0.0],
        3 => [b * c / 2.0, -a * c, a * b / 2.0, 0.0],
        _ => [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0],
    }
}

/// The sum of `values` from `start` on, with `weights`.
fn weighted(values: &[Stress], start: usize, weights: &[f64; MOST_POINTS]) -> Stress {
    let own = values[start..].iter().zip(weights);
    own.fold(Stress::ZERO, |sum, (value, weight)| sum + *value * *weight)
}

/// Arc lengths of points, mm.
fn arcs(points: &[Vec2]) -> Vec<f64> {
    let mut arcs = vec![0.0];
    for pair in points.windows(2) {
        arcs.push(arcs[arcs.len() - 1] + (pair[1] - pair[0]).length());
    }
    arcs
}

/// Arc lengths of the ends and of the kinks.
fn leg_ends(points: &[Vec2], arcs: &[f64]) -> Vec<f64> {
    let mut ends = vec![0.0];
    for (i, corner) in points.windows(3).enumerate() {
        let (before, after) = (corner[1] - corner[0], corner[2] - corner[1]);
        if before.cross(after).atan2(before.dot(after)).abs() > KINK {
            ends.push(arcs[i + 1]);
        }
    }
    ends.push(arcs[arcs.len() - 1]);
    ends
}

fn position(points: &[Vec2], arcs: &[f64], s: f64) -> Vec2 {
    let last = points.len().saturating_sub(2);
    let segment = arcs.partition_point(|arc| *arc <= s).saturating_sub(1).min(last);
    let (from, to) = (points[segment], points[segment + 1]);
    let part = (s - arcs[segment]) / (arcs[segment + 1] - arcs[segment]);
    from + (to - from) * part
}

/// Step of the abscissa τ of a fine table, u = w sinh τ, and the largest u over a.
const STEP: f64 = 0.09;
const TABLED: f64 = 40.0;

/// The stress at a point of a crack by the place of the wheel.
struct NodeTable {
    point: Vec2,
    spread: Spread,
    /// w, mm.
    width: f64,
    /// At τ = (i − middle) `step`.
    values: Vec<Stress>,
    step: f64,
    middle: usize,
}

impl NodeTable {
    fn new(wheel: &PatchWheel, point: Vec2, spread: Spread) -> Self {
        let width = 0.7 * wheel.half_width + 0.3 * (point.y.abs() + spread.reach);
        let reach =
            TABLED * wheel.half_width + wheel.edges.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let step = STEP * wheel.coarseness as f64;
        let middle = ((reach / width).asinh() / step).ceil() as usize + 2;
        let at = |i: usize| {
            let u = width * (step * (i as f64 - middle as f64)).sinh();
            wheel.spread_stress(u, point.y, spread)
        };
        Self { point, spread, width, values: (0..=2 * middle).map(at).collect(), step, middle }
    }

    fn at(&self, wheel: &PatchWheel, xc: f64) -> Stress {
        let u = self.point.x - xc;
        let place = (u / self.width).asinh() / self.step + self.middle as f64;
        let last = self.values.len() - MOST_POINTS;
        if !(1.0..=last as f64 + 1.0).contains(&place) {
            return wheel.spread_stress(u, self.point.y, self.spread);
        }
        let start = (place.floor() as usize - 1).min(last);
        weighted(&self.values, start, &lagrange(place - start as f64, MOST_POINTS))
    }
}

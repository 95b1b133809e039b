//! A wheel whose contact is a patch, not a line, over cracks with straight fronts.

use super::Wheel;
use super::front_spread::{CrackLine, FrontSpread, PlaceOnCrack, StressesByPosition, StressesOnCracks};
use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use super::patch_table::{PlaceColumn, TabledPatch, between};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2};
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// A wheel on the half-space. Its stress and displacement are those in the plane y = 0 of the
/// cracks; what loads them is the mean along their fronts ([`Wheel::on_cracks`]).
#[derive(Debug, Clone)]
pub struct PatchWheel {
    patches: Vec<PatchDirections>,
    /// Empty of a coarse wheel.
    tabled: Vec<TabledPatch>,
    edges: Vec<f64>,
    half_width: f64,
    shear_modulus: f64,
}

impl PatchWheel {
    /// The wheel with `patches`, at least one, on a rail of `steel`.
    #[must_use]
    pub fn new(patches: &[PatchLoad], steel: &IsotropicElastic) -> Self {
        let tabled = patches.iter().map(|patch| TabledPatch::new(patch, steel.poisson())).collect();
        Self { tabled, ..Self::of_coarseness(patches, steel, 1) }
    }

    /// The same for a few passages of its own, with stresses to some per cent.
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
            tabled: Vec::new(),
            edges,
            half_width: patches.iter().map(|patch| patch.half()[0]).fold(0.0, f64::max),
            shear_modulus: steel.shear_modulus(),
        }
    }

    fn place(&self, point: Vec2, spread: Spread) -> Place {
        let columns = if self.tabled.is_empty() {
            self.patches.iter().map(|patch| PlaceColumn::coarse(patch, -point.y, spread)).collect()
        } else {
            self.tabled.iter().map(|patch| patch.at(-point.y, spread)).collect()
        };
        Place { x: point.x, columns }
    }
}

impl Wheel for PatchWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        let of = |patch: &PatchDirections| patch.stress(point.x - xc, -point.y, Spread::NONE);
        self.patches.iter().fold(Stress::ZERO, |sum, patch| sum + of(patch))
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
        let own = |line: &CrackLine| OnCrack {
            spread: FrontSpread::of(line),
            line: line.clone(),
            nodes: OnceLock::new(),
            mouth: OnceLock::new(),
        };
        Some(Arc::new(OnCracks { wheel: self, cracks: cracks.iter().map(own).collect() }))
    }
}

/// A place of a crack with its stresses under each patch.
struct Place {
    /// mm.
    x: f64,
    columns: Vec<PlaceColumn>,
}

impl Place {
    /// The stress (MPa) with the wheel at `xc` (mm).
    fn at(&self, xc: f64) -> Stress {
        self.columns.iter().fold(Stress::ZERO, |sum, column| sum + column.at(self.x - xc))
    }
}

/// The stresses of a wheel on cracks.
struct OnCracks<'a> {
    wheel: &'a PatchWheel,
    cracks: Vec<OnCrack>,
}

struct OnCrack {
    line: CrackLine,
    spread: FrontSpread,
    /// Under a coarse wheel, places along the crack between which all others are interpolated.
    nodes: OnceLock<Vec<Place>>,
    /// The running surface over its first point, spread as in the middle of the crack.
    mouth: OnceLock<Place>,
}

/// Share of the length at which the pressure over a mouth is spread as there.
const INSIDE: f64 = 0.5;
/// Places along a crack under a coarse wheel.
const NODES: usize = 10;

impl OnCrack {
    fn place(&self, wheel: &PatchWheel, place: &PlaceOnCrack) -> Place {
        if !wheel.tabled.is_empty() {
            return wheel.place(place.point, self.spread.at(place.s));
        }
        let length = self.line.length();
        let nodes = self.nodes.get_or_init(|| {
            // Dense towards both ends: s = l sin²(φ/2).
            let at = |i: usize| {
                let s = 0.5 * length * (1.0 - (PI * i as f64 / (NODES - 1) as f64).cos());
                wheel.place(self.line.position(s), self.spread.at(s))
            };
            (0..NODES).map(at).collect()
        });
        let angle = (1.0 - 2.0 * place.s / length).clamp(-1.0, 1.0).acos();
        let (first, weights) = between(angle / PI * (NODES - 1) as f64, NODES);
        let column = |patch: usize| {
            let around: Vec<&PlaceColumn> =
                nodes[first..first + weights.len()].iter().map(|node| &node.columns[patch]).collect();
            PlaceColumn::between(&around, &weights)
        };
        Place { x: place.point.x, columns: (0..wheel.patches.len()).map(column).collect() }
    }
}

impl StressesOnCracks for OnCracks<'_> {
    fn at<'a>(self: Arc<Self>, places: &[PlaceOnCrack]) -> StressesByPosition<'a>
    where
        Self: 'a,
    {
        let on = |place: &PlaceOnCrack| self.cracks[place.crack].place(self.wheel, place);
        let places: Vec<Place> = places.iter().map(on).collect();
        Box::new(move |xc| places.iter().map(|place| place.at(xc)).collect())
    }

    fn over_mouth(&self, crack: usize, xc: f64) -> f64 {
        let OnCrack { line, spread, mouth, .. } = &self.cracks[crack];
        let place = mouth.get_or_init(|| {
            let first = line.points.first().copied().unwrap_or_default();
            self.wheel.place(Vec2::new(first.x, 0.0), spread.at(INSIDE * line.length()))
        });
        (-place.at(xc).yy).max(0.0)
    }
}

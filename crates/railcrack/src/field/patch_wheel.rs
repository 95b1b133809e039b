//! A wheel whose contact is a patch, not a line, over cracks with straight fronts.

use super::Wheel;
use super::front_spread::{CrackLine, FrontSpread, PlaceOnCrack, StressesByPosition, StressesOnCracks};
use super::patch_directions::{PatchDirections, PatchLoad, Spread};
use super::patch_table::{PlaceColumn, TabledPatch};
use crate::material::IsotropicElastic;
use crate::math::{Stress, Vec2, lagrange};
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

    /// The largest distance over depth of places between which stresses are interpolated.
    fn gap(&self) -> f64 {
        if self.tabled.is_empty() { 1.0 } else { 0.2 }
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
        Some(Arc::new(OnCracks { wheel: self, cracks: cracks.iter().map(OnCrack::new).collect() }))
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
    /// Arc lengths of its kinks, mm.
    kinks: Vec<f64>,
    /// The running surface over its first point, spread as in the middle of the crack.
    mouth: OnceLock<Place>,
}

/// Share of the length at which the pressure over a mouth is spread as there.
const INSIDE: f64 = 0.5;
/// The turn (degrees) from which a vertex is a kink, across which nothing is interpolated.
const KINK: f64 = 10.0;

impl OnCrack {
    fn new(line: &CrackLine) -> Self {
        Self {
            spread: FrontSpread::of(line),
            kinks: line.kinks(KINK),
            line: line.clone(),
            mouth: OnceLock::new(),
        }
    }

    /// The number of kinks before a place.
    fn part(&self, place: &PlaceOnCrack) -> usize {
        self.kinks.partition_point(|kink| *kink < place.s)
    }
}

/// Places among `places` between which the others are interpolated, `gap` times their depth from
/// each other or closer.
fn nodes_among(places: &[(usize, PlaceOnCrack)], gap: f64) -> Vec<PlaceOnCrack> {
    let mut nodes: Vec<PlaceOnCrack> = Vec::new();
    for (i, (_, place)) in places.iter().enumerate() {
        let is_node = match (nodes.last(), places.get(i + 1)) {
            (Some(before), _) if place.s <= before.s => false,
            (Some(before), Some((_, next))) => next.s - before.s > -gap * before.point.y.max(next.point.y),
            _ => true,
        };
        if is_node {
            nodes.push(*place);
        }
    }
    nodes
}

impl StressesOnCracks for OnCracks<'_> {
    fn at<'a>(self: Arc<Self>, places: &[PlaceOnCrack]) -> StressesByPosition<'a>
    where
        Self: 'a,
    {
        let mut order: Vec<(usize, PlaceOnCrack)> = places.iter().copied().enumerate().collect();
        order.sort_by(|(_, a), (_, b)| a.crack.cmp(&b.crack).then(a.s.total_cmp(&b.s)));
        let part = |(_, place): &(usize, PlaceOnCrack)| (place.crack, self.cracks[place.crack].part(place));
        let mut nodes: Vec<Place> = Vec::new();
        // Index of the first node of each place, and the weights of the nodes from it on.
        let mut sums: Vec<(usize, Vec<f64>)> = vec![Default::default(); places.len()];
        for of_part in order.chunk_by(|a, b| part(a) == part(b)) {
            let own = nodes_among(of_part, self.wheel.gap());
            let along: Vec<f64> = own.iter().map(|node| node.s).collect();
            for (i, place) in of_part {
                let (first, weights) = lagrange(&along, place.s);
                sums[*i] = (nodes.len() + first, weights);
            }
            let at =
                |node: &PlaceOnCrack| self.wheel.place(node.point, self.cracks[node.crack].spread.at(node.s));
            nodes.extend(own.iter().map(at));
        }
        Box::new(move |xc| {
            let at_nodes: Vec<Stress> = nodes.iter().map(|node| node.at(xc)).collect();
            let sum = |(first, weights): &(usize, Vec<f64>)| {
                let around = at_nodes[*first..].iter().zip(weights);
                around.fold(Stress::ZERO, |sum, (stress, weight)| sum + *stress * *weight)
            };
            sums.iter().map(sum).collect()
        })
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

//! Units of joined cracks in a row.

use crate::crack::{CrackCurve, CrackNetwork};
use crate::math::{Vec2, chebyshev};

/// Distance along the rail, over the larger crack size, up to which cracks are near to each other.
const GAP: f64 = 1.0;
/// Numbers of Chebyshev points of the expansion per crack, along the rail and in depth.
const ALONG: usize = 5;
const DOWN: usize = 4;

/// Width (mm) by which boxes exceed their cracks, so that the boxes of upright cracks have a width.
const FLAT: f64 = 1e-9;

/// The bounding box of a crack.
#[derive(Debug, Clone, Copy)]
pub(super) struct SourceBox {
    low: Vec2,
    high: Vec2,
}

impl SourceBox {
    /// Number of Chebyshev points of a box.
    pub(super) const NODES: usize = ALONG * DOWN;

    fn of(curve: &CrackCurve) -> Self {
        let points = (0..curve.segments()).map(|i| curve.position(i, curve.vertices()[i]));
        let all = points.chain([curve.last_point()]);
        let none = Self {
            low: Vec2::new(f64::INFINITY, f64::INFINITY),
            high: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        all.fold(none, |extent, p| Self {
            low: Vec2::new(extent.low.x.min(p.x), extent.low.y.min(p.y)),
            high: Vec2::new(extent.high.x.max(p.x), extent.high.y.max(p.y)),
        })
    }

    fn size(&self) -> f64 {
        (self.high.x - self.low.x).max(self.high.y - self.low.y)
    }

    fn is_apart(&self, other: &Self) -> bool {
        let gap = (other.low.x - self.high.x).max(self.low.x - other.high.x);
        gap >= GAP * self.size().max(other.size())
    }

    /// The Chebyshev points to which [`SourceBox::weights`] refers.
    pub(super) fn nodes(&self) -> Vec<Vec2> {
        let [xs, ys] = self.lines();
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| Vec2::new(x, y))).collect()
    }

    fn lines(&self) -> [Vec<f64>; 2] {
        let range = |low: f64, high: f64| low - FLAT..=high + FLAT;
        let (xs, ys) = (range(self.low.x, self.high.x), range(self.low.y, self.high.y));
        [chebyshev::points(&xs, ALONG), chebyshev::points(&ys, DOWN)]
    }

    pub(super) fn weights(&self, point: Vec2) -> Vec<f64> {
        let [xs, ys] = self.lines();
        let (along, down) = (chebyshev::weights(&xs, point.x), chebyshev::weights(&ys, point.y));
        along.iter().flat_map(|a| down.iter().map(move |d| a * d)).collect()
    }
}

/// Cracks that have joined each other are one unit, every other crack is a unit of its own; units
/// are in the order in which they lie along the rail.
pub(super) struct Units {
    /// The cracks of each unit, in order.
    pub cracks: Vec<Vec<usize>>,
    pub(super) extents: Vec<SourceBox>,
}

impl Units {
    /// The units of `network`, whose cracks have the `curves`.
    pub(super) fn new(network: &CrackNetwork, curves: &[CrackCurve]) -> Self {
        let extents: Vec<SourceBox> = curves.iter().map(SourceBox::of).collect();
        Self { cracks: units(network, &extents), extents }
    }

    /// The unit of each crack.
    pub(super) fn of_cracks(&self) -> Vec<usize> {
        let mut unit_of = vec![0; self.extents.len()];
        for (k, cracks) in self.cracks.iter().enumerate() {
            cracks.iter().for_each(|&crack| unit_of[crack] = k);
        }
        unit_of
    }

    /// Whether units `k` and `l` are near to each other.
    pub(super) fn are_near(&self, k: usize, l: usize) -> bool {
        let near = |&one: &usize| {
            self.cracks[l].iter().any(|&other| !self.extents[one].is_apart(&self.extents[other]))
        };
        self.cracks[k].iter().any(near)
    }

    /// Ends of unit `k` along the rail, mm.
    pub(super) fn span(&self, k: usize) -> (f64, f64) {
        let low = self.cracks[k].iter().map(|&c| self.extents[c].low.x).fold(f64::INFINITY, f64::min);
        (low, self.cracks[k].iter().map(|&c| self.extents[c].high.x).fold(f64::NEG_INFINITY, f64::max))
    }
}

fn units(network: &CrackNetwork, extents: &[SourceBox]) -> Vec<Vec<usize>> {
    let mut units: Vec<Vec<usize>> = (0..extents.len()).map(|crack| vec![crack]).collect();
    for point in network.junction_points() {
        let through = point.through.iter().map(|passing| passing.crack);
        let joined: Vec<usize> = point.ends.iter().map(|end| end.crack).chain(through).collect();
        let (one, others): (Vec<_>, Vec<_>) =
            units.into_iter().partition(|unit| unit.iter().any(|crack| joined.contains(crack)));
        units = others;
        units.push(one.concat());
    }
    units.retain(|unit| !unit.is_empty());
    units.iter_mut().for_each(|unit| unit.sort_unstable());
    let middle = |unit: &Vec<usize>| {
        let ends = |&crack: &usize| extents[crack].low.x + extents[crack].high.x;
        unit.iter().map(ends).sum::<f64>() / unit.len() as f64
    };
    units.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
    units
}

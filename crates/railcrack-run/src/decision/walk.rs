//! Growth of a sampled crack along the computed path.

use super::path::{GrowthPath, PathPoint};
use crate::log::MixInfo;
use railcrack::growth::MOST_WHEELS;

/// ΔK_eq (MPa√m) about which the exponent of the law scatters: there the rate keeps its scatter.
const PIVOT: f64 = 10.0;

/// Rates of a sample in relation to those of the path, and the removal of the surface.
pub(super) struct SampledRates {
    /// C over that of the case.
    pub faster: f64,
    /// m less that of the case.
    pub steeper: f64,
    pub shares: SampledShares,
    /// mm per million gross tonnes; none where nothing is removed.
    pub removal: Option<f64>,
}

impl SampledRates {
    /// The rate over that of the case.
    fn factor(&self, point: &PathPoint) -> f64 {
        let steeper = match self.steeper {
            0.0 => 1.0,
            steeper => (point.delta_keq.max(1e-3) / PIVOT).powf(steeper),
        };
        self.faster * steeper * self.shares.factor(point)
    }
}

/// Shares of the wheels of a mix in a sample.
pub(super) struct SampledShares {
    /// Each over that of the case; as many as there are wheels, none for one wheel.
    factors: [f64; MOST_WHEELS],
    wheels: usize,
    /// Mean load of an axle, t.
    pub tonnes: f64,
}

impl SampledShares {
    /// The shares of `mix`, each multiplied by its member of `factors` and then normalised to a sum
    /// of 1; `tonnes` is the mean load of an axle in the case.
    pub fn of(mix: &[MixInfo], factors: [f64; MOST_WHEELS], tonnes: f64) -> Self {
        let sum: f64 = mix.iter().zip(factors).map(|(wheel, factor)| wheel.share * factor).sum();
        let factors = factors.map(|factor| if sum > 0.0 { factor / sum } else { 1.0 });
        let loads: Option<f64> = mix
            .iter()
            .zip(factors)
            .map(|(wheel, factor)| Some(wheel.share * factor * wheel.axle_load?))
            .sum();
        let is_mix = mix.len() > 1;
        Self { factors, wheels: mix.len(), tonnes: loads.filter(|_| is_mix).unwrap_or(tonnes) }
    }

    fn factor(&self, point: &PathPoint) -> f64 {
        let shares = point.shares.values();
        if self.wheels < 2 || shares.iter().sum::<f64>() == 0.0 {
            return 1.0;
        }
        shares.iter().zip(self.factors).map(|(share, factor)| share * factor).sum()
    }
}

/// The path of a sampled crack: from the crack of the case to longer ones or, where the surface is
/// removed faster than the crack grows, to shorter ones.
pub(super) struct SampledWalk<'a> {
    path: &'a GrowthPath,
    /// With removal: the longer and the shorter cracks, each from that of the case on.
    sorted: Option<(GrowthPath, GrowthPath)>,
}

impl<'a> SampledWalk<'a> {
    /// Along `path`; where the surface `is_removed`, lengths can increase and decrease, and rates
    /// are a function of length.
    pub fn of(path: &'a GrowthPath, is_removed: bool) -> Self {
        if !is_removed {
            return Self { path, sorted: None };
        }
        let mut points = path.points.clone();
        let first = points[0];
        points.sort_by(|a, b| a.length.total_cmp(&b.length));
        points.dedup_by(|a, b| a.length - b.length < SAME * first.length);
        let longer = points.iter().copied().filter(|point| point.length > first.length * (1.0 + SAME));
        let shorter = points.iter().rev().copied().filter(|point| point.length < first.length * (1.0 - SAME));
        // Nothing is left of a crack at the end of its path to shorter ones.
        let nothing = PathPoint { length: 0.0, depth: 0.0, rate: 0.0, ..first };
        let with = |points: Vec<PathPoint>| GrowthPath { points, breaks: false, ..path.clone() };
        let up = with(std::iter::once(first).chain(longer).collect());
        let down = with(std::iter::once(first).chain(shorter).chain([nothing]).collect());
        Self { path, sorted: Some((GrowthPath { breaks: path.breaks, ..up }, down)) }
    }

    /// The path to longer cracks.
    pub fn up(&self) -> &GrowthPath {
        self.sorted.as_ref().map_or(self.path, |(up, _)| up)
    }

    /// The path to shorter cracks.
    pub fn down(&self) -> &GrowthPath {
        self.sorted.as_ref().map_or(self.path, |(_, down)| down)
    }

    /// Writes the million gross tonnes at each point of the path of a sample to `mgt`, infinite
    /// where it is not reached. Returns whether the path leads to longer cracks.
    pub fn tonnage(&self, sample: &SampledRates, mgt: &mut Vec<f64>) -> bool {
        mgt.clear();
        mgt.push(0.0);
        let Some(removal) = sample.removal.filter(|_| self.sorted.is_some()) else {
            along(self.path, sample, mgt);
            return true;
        };
        // mm of length per million gross tonnes.
        let net = |point: &PathPoint| {
            let growth = 1e6 / sample.shares.tonnes * point.rate * sample.factor(point);
            growth - removal / point.mouth_sine.unwrap_or(1.0)
        };
        let grows = net(&self.up().points[0]) > 0.0;
        let way = if grows { self.up() } else { self.down() };
        for pair in way.points.windows(2) {
            let (start, end) = (net(&pair[0]), net(&pair[1]));
            let passes = start * end > 0.0 && (start > 0.0) == grows;
            let time = 0.5 * (pair[1].length - pair[0].length) * (start.recip() + end.recip());
            mgt.push(if passes { mgt[mgt.len() - 1] + time } else { f64::INFINITY });
        }
        grows
    }
}

/// Lengths that differ by less than this share of the first are one.
const SAME: f64 = 1e-6;

/// Million gross tonnes along a path from which nothing is removed.
fn along(path: &GrowthPath, sample: &SampledRates, mgt: &mut Vec<f64>) {
    let mut before = sample.factor(&path.points[0]);
    for (i, pair) in path.points.windows(2).enumerate() {
        let after = sample.factor(&pair[1]);
        let inverse = |rate: f64| if rate > 0.0 { rate.recip() } else { 0.0 };
        let (start, end) = (inverse(pair[0].rate), inverse(pair[1].rate));
        let slower =
            if start + end > 0.0 { (start / before + end / after) / (start + end) } else { before.recip() };
        mgt.push(mgt[i] + 1e-6 * sample.shares.tonnes * (pair[1].axles - pair[0].axles) * slower);
        before = after;
    }
}

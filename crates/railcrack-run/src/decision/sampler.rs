//! One sampled crack on a computed path.

use super::inspection::{CriticalBy, Place, detectable};
use super::path::GrowthPath;
use super::walk::{SampledRates, SampledShares, SampledWalk};
use crate::log::MixInfo;
use railcrack::growth::MOST_WHEELS;
use railcrack_case::{Inspection, MaintenancePlan, Scatter};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::f64::consts::PI;

/// The crack that is sampled, and its scatter.
#[derive(Debug, Clone, Copy)]
pub struct Sampling<'a> {
    /// The crack.
    pub path: &'a GrowthPath,
    /// Standard deviations.
    pub scatter: &'a Scatter,
    /// The inspection, where there is one.
    pub inspection: Option<&'a Inspection>,
    /// A length that is critical, mm.
    pub critical_length: Option<f64>,
    /// Mean load of an axle, t.
    pub tonnes: f64,
    /// Wear and grinding, where there are any.
    pub maintenance: Option<&'a MaintenancePlan>,
    /// The wheels of a mix.
    pub mix: &'a [MixInfo],
}

/// Keys of the quantities whose scatter is described by one deviate each.
pub(crate) const KEYS: [&str; 5] =
    ["c_log_std", "m_std", "toughness_std", "detectable_depth_std", "wear_std"];

/// A separate stream of random numbers for later quantities, so that the samples of the first four
/// do not change.
const LATER: usize = 0x5EED_0000_0000;

/// Standard normal deviates, two at a time (Box & Muller), the same on any machine.
struct Deviates {
    source: Pcg64Mcg,
    spare: Option<f64>,
}

impl Deviates {
    fn new(seed: usize) -> Self {
        Self { source: Pcg64Mcg::seed_from_u64(seed as u64), spare: None }
    }

    /// In (0, 1].
    fn uniform(&mut self) -> f64 {
        ((self.source.next_u64() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        let (sine, cosine) = (2.0 * PI * self.uniform()).sin_cos();
        self.spare = Some(radius * sine);
        radius * cosine
    }
}

/// Standard normal deviates of one sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Draw {
    /// Deviates of [`KEYS`].
    pub deviates: [f64; KEYS.len()],
    /// Deviate of the share of each wheel.
    pub shares: [f64; MOST_WHEELS],
}

/// Draws, one sample after the other.
pub(crate) struct Draws {
    first: Deviates,
    later: Deviates,
    wears: bool,
    wheels: usize,
}

impl Draws {
    /// Draws of the quantities that `scatter`, with the wheels of `mix`.
    pub fn of(scatter: &Scatter, mix: &[MixInfo]) -> Self {
        Self {
            first: Deviates::new(scatter.seed),
            later: Deviates::new(scatter.seed ^ LATER),
            wears: scatter.wear_std > 0.0,
            wheels: if scatter.share_log_std > 0.0 { mix.len() } else { 0 },
        }
    }

    /// The next sample.
    pub fn next(&mut self) -> Draw {
        let [c, m, toughness, detected] = [0; 4].map(|_| self.first.next());
        let wear = if self.wears { self.later.next() } else { 0.0 };
        let mut shares = [0.0; MOST_WHEELS];
        shares.iter_mut().take(self.wheels).for_each(|z| *z = self.later.next());
        Draw { deviates: [c, m, toughness, detected, wear], shares }
    }

    /// The share of all values, in (0, 1), at which another quantity is drawn.
    pub fn share(&mut self) -> f64 {
        (self.later.uniform()).min(1.0 - f64::EPSILON)
    }
}

/// One sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    /// Its deviates.
    pub draw: Draw,
    /// Whether the crack grows faster at first than it is removed.
    pub grows: bool,
    /// Million gross tonnes until critical and from detectable to critical; infinite beyond the
    /// path.
    pub to_critical: f64,
    pub way: f64,
}

/// A path along which samples are evaluated.
pub(crate) struct Sampler<'a> {
    of: Sampling<'a>,
    /// The wheels of a mix whose shares scatter.
    mix: &'a [MixInfo],
    inspection: Inspection,
    removal: Option<&'a MaintenancePlan>,
    walk: SampledWalk<'a>,
    /// Where the crack is critical, or its path ends.
    end: Place,
}

impl<'a> Sampler<'a> {
    /// Samples of `of`.
    pub fn of(of: Sampling<'a>) -> Self {
        let inspection = of.inspection.copied().unwrap_or_default();
        let removal = of.maintenance.filter(|plan| plan.removal() > 0.0 || of.scatter.wear_std > 0.0);
        let walk = SampledWalk::of(of.path, removal.is_some());
        let critical = CriticalBy::first(walk.up(), &inspection, of.critical_length).map(|(_, place)| place);
        let end = critical.unwrap_or((walk.up().points.len() - 1, 0.0));
        // Shares that do not scatter leave the rates as they are, to the last bit.
        let mix = if of.scatter.share_log_std > 0.0 { of.mix } else { &[] };
        Self { of, mix, inspection, removal, walk, end }
    }

    /// Whether the surface is removed.
    pub fn is_removed(&self) -> bool {
        self.removal.is_some()
    }

    /// The sample `draw`; `mgt` receives the million gross tonnes at each point of its path.
    pub fn sample(&self, draw: &Draw, mgt: &mut Vec<f64>) -> Sample {
        let [c, m, toughness, detected, wear] = draw.deviates;
        let scatter = self.of.scatter;
        let shares = draw.shares.map(|z| (scatter.share_log_std * z).exp());
        let rates = SampledRates {
            faster: (scatter.c_log_std * c).exp(),
            steeper: scatter.m_std * m,
            shares: SampledShares::of(self.mix, shares, self.of.tonnes),
            removal: self.removal.map(|plan| {
                let wear = (plan.wear + scatter.wear_std * wear).max(0.0);
                wear + (plan.removal() - plan.wear)
            }),
        };
        let up = self.walk.up();
        let grows = self.walk.tonnage(&rates, mgt);
        let to = |place: Place| if grows { GrowthPath::at(place, mgt) } else { f64::INFINITY };
        let breaks = scatter.toughness.and_then(|value| {
            let toughness = value + scatter.toughness_std * toughness;
            up.reaches(|point| point.largest_k1, toughness)
        });
        let to_critical = breaks.map_or(to(self.end), |place| to(place).min(to(self.end)));
        let depth = self.inspection.detectable_depth;
        let depth = depth.map(|depth| (depth + scatter.detectable_depth_std * detected).max(0.0));
        let from = detectable(up, &self.inspection, depth).map_or(f64::INFINITY, to);
        let way = if from.is_finite() { (to_critical - from).max(0.0) } else { f64::INFINITY };
        Sample { draw: *draw, grows, to_critical, way }
    }

    /// Depth (mm) of `sample`, which reaches the points of its path at `mgt`, at the tonnage `at`;
    /// infinite beyond the last point.
    pub fn depth_at(&self, sample: &Sample, mgt: &[f64], at: f64) -> f64 {
        let path = if sample.grows { self.walk.up() } else { self.walk.down() };
        let next = mgt.partition_point(|here| *here <= at);
        match (next.checked_sub(1), mgt.get(next)) {
            (Some(i), Some(after)) => {
                let share = (at - mgt[i]) / (after - mgt[i]);
                path.points[i].depth + share * (path.points[i + 1].depth - path.points[i].depth)
            }
            (Some(i), None) if mgt[i] == at => path.points[i].depth,
            (Some(_), None) => f64::INFINITY,
            (None, _) => path.points[0].depth,
        }
    }
}

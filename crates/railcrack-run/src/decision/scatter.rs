//! Scatter of what does not change the path of the crack, by sampling.

use super::inspection::{CriticalBy, InspectionSummary, Place, detectable};
use super::path::GrowthPath;
use super::walk::{SampledRates, SampledShares, Walk};
use crate::run_info::MixInfo;
use railcrack::growth::MOST_WHEELS;
use railcrack_case::{Inspection, MaintenancePlan, Scatter};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Quantiles over all samples; null where the run does not reach that far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// Of 5 %.
    pub p05: Option<f64>,
    /// The median.
    pub p50: Option<f64>,
    /// Of 95 %.
    pub p95: Option<f64>,
}

/// Quantiles of the depth (mm) at one tonnage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DepthQuantiles {
    /// Million gross tonnes.
    pub mgt: f64,
    /// Depth, mm; null where those samples are beyond the last step.
    pub depth_mm: Quantiles,
}

/// How much of the variance of the logarithm of the way to critical one quantity makes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Its key in `[scatter]`.
    pub key: String,
    /// Squared correlation of its deviate with the logarithm of the tonnage.
    pub share: f64,
}

/// Results of the samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScatterSummary {
    /// How many.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: usize,
    /// Million gross tonnes until critical, or to the end of the path where nothing is.
    pub mgt_to_critical: Quantiles,
    /// Million gross tonnes from detectable to critical.
    pub mgt_detectable_to_critical: Quantiles,
    /// Probability that a crack that was just missed is critical before the next inspection, one
    /// interval later; null without an interval.
    pub probability_critical_before_inspection: Option<f64>,
    /// Probability that the crack grows faster at first than wear and grinding take it away; left
    /// out without them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability_growing: Option<f64>,
    /// Depth over traffic.
    pub depth: Vec<DepthQuantiles>,
    /// Of each quantity that scatters, the largest first.
    pub sensitivities: Vec<Sensitivity>,
}

/// Tonnages at which quantiles of the depth are given.
const TONNAGES: usize = 41;

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

/// One sample.
struct Sample {
    /// Deviates of C, m, toughness, detectable depth and wear, and of the share of each wheel.
    deviates: [f64; KEYS.len()],
    shares: [f64; MOST_WHEELS],
    /// Whether the crack grows faster at first than it is removed.
    grows: bool,
    /// Million gross tonnes until critical and from detectable to critical; infinite beyond the
    /// path.
    to_critical: f64,
    way: f64,
}

/// Keys of the quantities that scatter by one deviate each.
const KEYS: [&str; 5] = ["c_log_std", "m_std", "toughness_std", "detectable_depth_std", "wear_std"];

/// Another stream of random numbers for what came later: the samples of the first four quantities
/// stay what they were.
const LATER: usize = 0x5EED_0000_0000;

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

/// The samples.
///
/// The histories of K along the path do not depend on C, nor on m, the wear and the shares of the
/// wheels as long as the path is the same: each sample has the rates of the path times
/// e^(σ_C z) (ΔK_eq/10)^(σ_m z′), and those of each wheel of a mix by its share; its cycles follow
/// by the same rule as those of the run. Where the surface is removed, the length follows
/// dl/dN = da/dN − w/sin θ with the rates that the run has at each length, grinding as wear in the
/// mean.
pub fn sampled(of: Sampling) -> ScatterSummary {
    let Sampling { path, scatter, inspection, critical_length, tonnes, maintenance, mix } = of;
    // Shares that do not scatter leave the rates as they are, to the last bit.
    let mix = if scatter.share_log_std > 0.0 { mix } else { &[] };
    let mean = inspection.copied().unwrap_or_default();
    let nominal = InspectionSummary::of(path, &mean, critical_length, tonnes);
    let removal = maintenance.filter(|plan| plan.removal() > 0.0 || scatter.wear_std > 0.0);
    let walk = Walk::of(path, removal.is_some());
    let longest = 1e-6 * tonnes * path.points.last().map_or(0.0, |point| point.axles);
    let spread = 1.0 + 2.0 * scatter.c_log_std;
    let tonnages: Vec<f64> =
        (0..TONNAGES).map(|i| spread * longest * i as f64 / (TONNAGES - 1) as f64).collect();
    let mut depths: Vec<Vec<f64>> = (0..TONNAGES).map(|_| Vec::with_capacity(scatter.samples)).collect();
    let mut deviates = Deviates::new(scatter.seed);
    let mut later = Deviates::new(scatter.seed ^ LATER);
    let mut samples = Vec::with_capacity(scatter.samples);
    let mut mgt = Vec::new();
    let up = walk.up();
    let critical = CriticalBy::first(up, &mean, critical_length).map(|(_, place)| place);
    let end: Place = critical.unwrap_or((up.points.len() - 1, 0.0));
    for _ in 0..scatter.samples {
        let [c, m, toughness, detected] = [0; 4].map(|_| deviates.next());
        let wear = if scatter.wear_std > 0.0 { later.next() } else { 0.0 };
        let mut z_shares = [0.0; MOST_WHEELS];
        if scatter.share_log_std > 0.0 {
            z_shares.iter_mut().take(mix.len()).for_each(|z| *z = later.next());
        }
        let shares = SampledShares::of(mix, z_shares.map(|z| (scatter.share_log_std * z).exp()), tonnes);
        let sample = SampledRates {
            faster: (scatter.c_log_std * c).exp(),
            steeper: scatter.m_std * m,
            shares,
            removal: removal.map(|plan| {
                let wear = (plan.wear + scatter.wear_std * wear).max(0.0);
                wear + (plan.removal() - plan.wear)
            }),
        };
        let grows = walk.tonnage(&sample, &mut mgt);
        let along = if grows { up } else { walk.down() };
        let to = |place: Place| if grows { GrowthPath::at(place, &mgt) } else { f64::INFINITY };
        let breaks = scatter.toughness.and_then(|value| {
            let toughness = value + scatter.toughness_std * toughness;
            up.reaches(|point| point.largest_k1, toughness)
        });
        let to_critical = breaks.map_or(to(end), |place| to(place).min(to(end)));
        let depth =
            mean.detectable_depth.map(|depth| (depth + scatter.detectable_depth_std * detected).max(0.0));
        let from = detectable(up, &mean, depth).map_or(f64::INFINITY, to);
        let way = if from.is_finite() { (to_critical - from).max(0.0) } else { f64::INFINITY };
        let deviates = [c, m, toughness, detected, wear];
        samples.push(Sample { deviates, shares: z_shares, grows, to_critical, way });
        for (i, at) in tonnages.iter().enumerate() {
            depths[i].push(depth_at(along, &mgt, *at));
        }
    }
    let share_of = |is_it: &dyn Fn(&Sample) -> bool| {
        samples.iter().filter(|sample| is_it(sample)).count() as f64 / scatter.samples as f64
    };
    ScatterSummary {
        samples: scatter.samples,
        seed: scatter.seed,
        mgt_to_critical: quantiles(samples.iter().map(|sample| sample.to_critical).collect()),
        mgt_detectable_to_critical: quantiles(samples.iter().map(|sample| sample.way).collect()),
        probability_critical_before_inspection: nominal
            .interval_mgt
            .map(|interval| share_of(&|sample| sample.way < interval)),
        probability_growing: removal.map(|_| share_of(&|sample| sample.grows)),
        depth: tonnages
            .into_iter()
            .zip(depths)
            .map(|(mgt, depths)| DepthQuantiles { mgt, depth_mm: quantiles(depths) })
            .collect(),
        sensitivities: sensitivities(&samples, scatter, mix.len()),
    }
}

/// Depth (mm) at the tonnage `at`; infinite beyond the last point.
fn depth_at(path: &GrowthPath, mgt: &[f64], at: f64) -> f64 {
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

fn quantiles(mut values: Vec<f64>) -> Quantiles {
    let mut at = |share: f64| {
        let place = (share * (values.len().max(1) - 1) as f64).round() as usize;
        if values.is_empty() {
            return None;
        }
        let (_, value, _) = values.select_nth_unstable_by(place, f64::total_cmp);
        value.is_finite().then_some(*value)
    };
    Quantiles { p05: at(0.05), p50: at(0.5), p95: at(0.95) }
}

/// Squared correlations of the deviates with the logarithm of the tonnage.
fn sensitivities(samples: &[Sample], scatter: &Scatter, wheels: usize) -> Vec<Sensitivity> {
    let spread = [
        scatter.c_log_std,
        scatter.m_std,
        scatter.toughness_std,
        scatter.detectable_depth_std,
        scatter.wear_std,
    ];
    let reached: Vec<(&Sample, f64)> = samples
        .iter()
        .filter(|sample| sample.way.is_finite() && sample.way > 0.0)
        .map(|sample| (sample, sample.way.ln()))
        .collect();
    let count = reached.len() as f64;
    let mean = |of: &dyn Fn(&(&Sample, f64)) -> f64| reached.iter().map(of).sum::<f64>() / count;
    let middle = mean(&|(_, way)| *way);
    let variance = mean(&|(_, way)| (way - middle) * (way - middle));
    let share = |deviate: &dyn Fn(&Sample) -> f64| {
        let centre = mean(&|(sample, _)| deviate(sample));
        let covariance = mean(&|(sample, way)| (deviate(sample) - centre) * (way - middle));
        let own = mean(&|(sample, _)| (deviate(sample) - centre).powi(2));
        let share = covariance * covariance / (variance * own);
        if share.is_finite() { share } else { 0.0 }
    };
    let of = |i: usize| Sensitivity { key: KEYS[i].to_owned(), share: share(&|sample| sample.deviates[i]) };
    let mut all: Vec<Sensitivity> = (0..KEYS.len()).filter(|&i| spread[i] > 0.0).map(of).collect();
    if scatter.share_log_std > 0.0 {
        let of_wheels = (0..wheels).map(|wheel| share(&|sample| sample.shares[wheel])).sum();
        all.push(Sensitivity { key: "share_log_std".to_owned(), share: of_wheels });
    }
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    all
}

#[cfg(test)]
#[path = "scatter_tests.rs"]
mod tests;

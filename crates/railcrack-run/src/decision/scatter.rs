//! Scatter of what does not change the path of the crack, by sampling.

use super::inspection::{CriticalBy, InspectionSummary, Place, detectable};
use super::path::GrowthPath;
use railcrack_case::{Inspection, Scatter};
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
    /// Depth over traffic.
    pub depth: Vec<DepthQuantiles>,
    /// Of each quantity that scatters, the largest first.
    pub sensitivities: Vec<Sensitivity>,
}

/// Tonnages at which quantiles of the depth are given.
const TONNAGES: usize = 41;

/// ΔK_eq (MPa√m) about which the exponent of the law scatters: there the rate keeps its scatter.
const PIVOT: f64 = 10.0;

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
    /// Deviates of C, m, toughness and detectable depth.
    deviates: [f64; KEYS.len()],
    /// Million gross tonnes until critical and from detectable to critical; infinite beyond the
    /// path.
    to_critical: f64,
    way: f64,
}

/// Keys of the quantities that scatter.
const KEYS: [&str; 4] = ["c_log_std", "m_std", "toughness_std", "detectable_depth_std"];

/// The samples of `path` under axles of `tonnes`.
///
/// The histories of K along the path do not depend on C, nor on m as long as the path is the same:
/// each sample has the rates of the path times e^(σ_C z) (ΔK_eq/10)^(σ_m z′), and its cycles follow
/// by the same rule as those of the run.
pub fn sampled(
    path: &GrowthPath,
    scatter: &Scatter,
    inspection: Option<&Inspection>,
    critical_length: Option<f64>,
    tonnes: f64,
) -> ScatterSummary {
    let mean = inspection.copied().unwrap_or_default();
    let nominal = InspectionSummary::of(path, &mean, critical_length, tonnes);
    let last = path.points.len() - 1;
    let critical = CriticalBy::first(path, &mean, critical_length).map(|(_, place)| place);
    let end: Place = critical.unwrap_or((last, 0.0));
    let longest = 1e-6 * tonnes * path.points[last].axles;
    let spread = 1.0 + 2.0 * scatter.c_log_std;
    let tonnages: Vec<f64> =
        (0..TONNAGES).map(|i| spread * longest * i as f64 / (TONNAGES - 1) as f64).collect();
    let mut depths: Vec<Vec<f64>> = (0..TONNAGES).map(|_| Vec::with_capacity(scatter.samples)).collect();
    let mut deviates = Deviates::new(scatter.seed);
    let mut samples = Vec::with_capacity(scatter.samples);
    let mut mgt = vec![0.0; path.points.len()];
    for _ in 0..scatter.samples {
        let z = [0; KEYS.len()].map(|_| deviates.next());
        tonnage(path, scatter, z, tonnes, &mut mgt);
        let to = |place: Place| GrowthPath::at(place, &mgt);
        let breaks = scatter.toughness.and_then(|toughness| {
            let toughness = toughness + scatter.toughness_std * z[2];
            path.reaches(|point| point.largest_k1, toughness)
        });
        let to_critical = breaks.map_or(to(end), |place| to(place).min(to(end)));
        let depth = mean.detectable_depth.map(|depth| (depth + scatter.detectable_depth_std * z[3]).max(0.0));
        let from = detectable(path, &mean, depth).map_or(f64::INFINITY, to);
        let way = if from.is_finite() { (to_critical - from).max(0.0) } else { f64::INFINITY };
        samples.push(Sample { deviates: z, to_critical, way });
        for (i, at) in tonnages.iter().enumerate() {
            depths[i].push(depth_at(path, &mgt, *at));
        }
    }
    let before = |interval: f64| {
        samples.iter().filter(|sample| sample.way < interval).count() as f64 / scatter.samples as f64
    };
    ScatterSummary {
        samples: scatter.samples,
        seed: scatter.seed,
        mgt_to_critical: quantiles(samples.iter().map(|sample| sample.to_critical).collect()),
        mgt_detectable_to_critical: quantiles(samples.iter().map(|sample| sample.way).collect()),
        probability_critical_before_inspection: nominal.interval_mgt.map(before),
        depth: tonnages
            .into_iter()
            .zip(depths)
            .map(|(mgt, depths)| DepthQuantiles { mgt, depth_mm: quantiles(depths) })
            .collect(),
        sensitivities: sensitivities(&samples, scatter),
    }
}

/// Million gross tonnes at each point of the path in a sample with the deviates `z`.
fn tonnage(path: &GrowthPath, scatter: &Scatter, z: [f64; 4], tonnes: f64, mgt: &mut [f64]) {
    let faster = (scatter.c_log_std * z[0]).exp();
    let steeper = scatter.m_std * z[1];
    let factor = |delta_keq: f64| {
        if steeper == 0.0 { faster } else { faster * (delta_keq.max(1e-3) / PIVOT).powf(steeper) }
    };
    let mut before = factor(path.points[0].delta_keq);
    mgt[0] = 0.0;
    for (i, pair) in path.points.windows(2).enumerate() {
        let after = factor(pair[1].delta_keq);
        let inverse = |rate: f64| if rate > 0.0 { rate.recip() } else { 0.0 };
        let (start, end) = (inverse(pair[0].rate), inverse(pair[1].rate));
        let slower =
            if start + end > 0.0 { (start / before + end / after) / (start + end) } else { before.recip() };
        mgt[i + 1] = mgt[i] + 1e-6 * tonnes * (pair[1].axles - pair[0].axles) * slower;
        before = after;
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
fn sensitivities(samples: &[Sample], scatter: &Scatter) -> Vec<Sensitivity> {
    let spread = [scatter.c_log_std, scatter.m_std, scatter.toughness_std, scatter.detectable_depth_std];
    let reached: Vec<(&Sample, f64)> = samples
        .iter()
        .filter(|sample| sample.way.is_finite() && sample.way > 0.0)
        .map(|sample| (sample, sample.way.ln()))
        .collect();
    let count = reached.len() as f64;
    let mean = |of: &dyn Fn(&(&Sample, f64)) -> f64| reached.iter().map(of).sum::<f64>() / count;
    let middle = mean(&|(_, way)| *way);
    let variance = mean(&|(_, way)| (way - middle) * (way - middle));
    let of = |i: usize| {
        let centre = mean(&|(sample, _)| sample.deviates[i]);
        let covariance = mean(&|(sample, way)| (sample.deviates[i] - centre) * (way - middle));
        let own = mean(&|(sample, _)| (sample.deviates[i] - centre).powi(2));
        let share = covariance * covariance / (variance * own);
        Sensitivity { key: KEYS[i].to_owned(), share: if share.is_finite() { share } else { 0.0 } }
    };
    let mut all: Vec<Sensitivity> = (0..KEYS.len()).filter(|&i| spread[i] > 0.0).map(of).collect();
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    all
}

#[cfg(test)]
#[path = "scatter_tests.rs"]
mod tests;

//! Scatter of what does not change the path of the crack, by sampling.

use super::risk::DepthCurve;
use super::sampler::{Draw, Draws, KEYS, Sample, Sampler, Sampling};
use super::walk::Track;
use railcrack_case::Scatter;
use serde::{Deserialize, Serialize};

/// Quantiles over all samples; null if the run does not reach that far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// The quantile of 5 %.
    pub p05: Option<f64>,
    /// The median.
    pub p50: Option<f64>,
    /// The quantile of 95 %.
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

/// Contribution of a quantity to the variance of the logarithm of the tonnage until critical.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Its key in `[scatter]`.
    pub key: String,
    /// Squared correlation of its deviate with the logarithm of the tonnage.
    pub share: f64,
}

/// Samples that have not failed where the run that they follow ends: it is not known when they do.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Outlived {
    /// Share of all samples.
    pub share: f64,
    /// Million gross tonnes that the first of them reaches: a quantile beyond is not known.
    pub mgt: f64,
}

/// Accuracy of samples that are made between whole runs at several speeds of growth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CourseAccuracy {
    /// Number of these runs, that of the case among them.
    pub runs: usize,
    /// The largest error (percent) of the tonnage to failure at the speed of a run that was left
    /// out: about four times that of the samples, since it doubles the gap. Null where no run
    /// between two others fails.
    pub left_out_percent: Option<f64>,
}

/// Results of the samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScatterSummary {
    /// How many.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: usize,
    /// Million gross tonnes until the rail fails.
    pub mgt_to_critical: Quantiles,
    /// Share of the samples that fail.
    #[serde(default)]
    pub probability_of_failure: f64,
    /// The samples that outlive what is computed; left out where none does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outlived: Option<Outlived>,
    /// Accuracy of samples between several runs; left out where the run alone is enough.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between_runs: Option<CourseAccuracy>,
    /// Million gross tonnes from detectable to critical.
    pub mgt_detectable_to_critical: Quantiles,
    /// Probability that a crack that was just missed is critical before the next inspection, one
    /// interval later; null without an interval.
    pub probability_critical_before_inspection: Option<f64>,
    /// Probability that the crack initially grows faster than wear and grinding remove it; left out
    /// without them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability_growing: Option<f64>,
    /// Depth over traffic.
    pub depth: Vec<DepthQuantiles>,
    /// Contribution of each quantity that scatters, the largest first.
    pub sensitivities: Vec<Sensitivity>,
    /// The first samples, where the surface is removed: million gross tonnes until failure, from
    /// detectable to failure, and until which the sample is known to hold; null where it does not
    /// fail, and where its fate is known. A study makes its samples between those of its runs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub first: Vec<FirstSample>,
}

/// Million gross tonnes until failure, from detectable to failure, and until which it is known.
pub type FirstSample = [Option<f64>; 3];

/// Number of first samples: their coefficients divide the distribution evenly.
const FIRST: usize = 256;

/// The samples, with quantiles of the depth up to `longest` million gross tonnes, where the crack
/// is inspected every `interval` million gross tonnes.
///
/// The histories of K along the path do not depend on C, nor on m, the wear and the shares of the
/// wheels as long as the path is the same: each sample has the rates of the courses times
/// e^(σ_C z) (ΔK_eq/10)^(σ_m z′), and those of each wheel of a mix by its share; its cycles follow
/// by the same rule as those of the run, and without scatter they are those of the run.
///
/// The lives of the samples follow where the `risk` of inspections is asked for; otherwise none.
pub(crate) fn sampled(
    of: Sampling,
    longest: f64,
    interval: Option<f64>,
    risk: Lives,
) -> (ScatterSummary, Vec<SampledLife>) {
    let scatter = of.scatter;
    let sampler = Sampler::of(of);
    let mut gathered = Gathered::new(scatter, tonnages(longest, scatter));
    let mut draws = Draws::of(scatter, of.mix);
    let mut lives = Vec::new();
    let mut left = scatter.samples;
    while left > 0 {
        let piece: Vec<Draw> = (0..left.min(PIECE)).map(|_| draws.next()).collect();
        left -= piece.len();
        let tonnages = &gathered.tonnages;
        let made = sampler.each(&piece, |sample, track| {
            let depth = |at: &f64| track.at(*at, sample.fate);
            let depths = tonnages.iter().map(depth).collect();
            let life = (risk == Lives::Kept).then(|| SampledLife::of(&sample, track));
            (sample, depths, life)
        });
        for (sample, depths, life) in made {
            gathered.take(sample, depths);
            lives.extend(life);
        }
    }
    let mut sensitivities: Vec<Sensitivity> = (0..KEYS.len())
        .filter(|&i| spread(scatter)[i] > 0.0)
        .map(|i| gathered.sensitivity(KEYS[i], |sample, _| sample.draw.deviates[i]))
        .collect();
    if scatter.share_log_std > 0.0 {
        let of_wheel = |wheel| gathered.sensitivity("share_log_std", |sample, _| sample.draw.shares[wheel]);
        let share = (0..of.mix.len()).map(|wheel| of_wheel(wheel).share).sum();
        sensitivities.push(Sensitivity { key: "share_log_std".to_owned(), share });
    }
    let is_removed = of.question.removal.mean_rate() > 0.0 || scatter.wear_std > 0.0;
    (gathered.summary(scatter, interval, is_removed, sensitivities), lives)
}

/// Whether the lives of the samples are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lives {
    /// Their depths over traffic.
    Kept,
    /// Only what the summary needs.
    Dropped,
}

/// The life of a sample that nobody inspects.
#[derive(Debug, Clone)]
pub(crate) struct SampledLife {
    /// Million gross tonnes until failure; infinite where it does not fail.
    pub failure: f64,
    /// Million gross tonnes until which it is known to hold, where it is not known what follows;
    /// infinite otherwise.
    pub outlives: f64,
    /// Depth over traffic, to [`THINNED`] of its largest value.
    pub depths: DepthCurve,
    /// The depth (mm) from which it is detected.
    pub found_from: Option<f64>,
}

/// Accuracy of the depth of a sample over its largest depth.
const THINNED: f64 = 1e-3;

impl SampledLife {
    fn of(sample: &Sample, track: &Track) -> Self {
        let deepest = track.points().iter().map(|point| point.1).fold(0.0, f64::max);
        let depths = if sample.to_critical.is_finite() {
            DepthCurve::through(track.points().iter().copied()).thinned(THINNED * deepest, sample.found_from)
        } else {
            DepthCurve::through([])
        };
        Self { failure: sample.to_critical, outlives: sample.outlives, depths, found_from: sample.found_from }
    }
}

/// Samples that are in memory with all their deviates at once.
const PIECE: usize = 1 << 14;

/// Tonnages (million gross tonnes) at which quantiles of the depth are given, from 0, for a run of
/// `longest`.
pub(crate) fn tonnages(longest: f64, scatter: &Scatter) -> Vec<f64> {
    let spread = 1.0 + 2.0 * scatter.c_log_std;
    (0..TONNAGES).map(|i| spread * longest * i as f64 / (TONNAGES - 1) as f64).collect()
}

/// Number of these tonnages.
const TONNAGES: usize = 41;

/// Standard deviations of [`KEYS`].
pub(crate) fn spread(scatter: &Scatter) -> [f64; KEYS.len()] {
    [scatter.c_log_std, scatter.m_std, scatter.toughness_std, scatter.detectable_depth_std, scatter.wear_std]
}

/// Samples, and their depths at given tonnages.
pub(crate) struct Gathered {
    samples: Vec<Sample>,
    tonnages: Vec<f64>,
    depths: Vec<Vec<f64>>,
}

impl Gathered {
    /// No samples yet; `tonnages` in million gross tonnes.
    pub fn new(scatter: &Scatter, tonnages: Vec<f64>) -> Self {
        let depths = tonnages.iter().map(|_| Vec::with_capacity(scatter.samples)).collect();
        Self { samples: Vec::with_capacity(scatter.samples), tonnages, depths }
    }

    /// Takes `sample` with its `depths` (mm) at the tonnages.
    pub fn take(&mut self, sample: Sample, depths: Vec<f64>) {
        self.samples.push(sample);
        self.depths.iter_mut().zip(depths).for_each(|(all, depth)| all.push(depth));
    }

    /// Squared correlation of `deviate`, of a sample and its index, with the logarithm of the
    /// tonnage until critical, over the samples that become critical.
    pub fn sensitivity(&self, key: &str, deviate: impl Fn(&Sample, usize) -> f64) -> Sensitivity {
        let reached: Vec<(f64, f64)> = self
            .samples
            .iter()
            .enumerate()
            .filter(|(_, sample)| sample.way.is_finite() && sample.way > 0.0)
            .map(|(i, sample)| (deviate(sample, i), sample.way.ln()))
            .collect();
        let count = reached.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| reached.iter().map(of).sum::<f64>() / count;
        let (centre, middle) = (mean(&|(own, _)| *own), mean(&|(_, way)| *way));
        let covariance = mean(&|(own, way)| (own - centre) * (way - middle));
        let variances = mean(&|(own, _)| (own - centre).powi(2)) * mean(&|(_, way)| (way - middle).powi(2));
        let share = covariance * covariance / variances;
        Sensitivity { key: key.to_owned(), share: if share.is_finite() { share } else { 0.0 } }
    }

    /// The sensitivities of the inputs with `names`, of which sample j has the deviates
    /// `inputs[j]`, and of all that `scatter` scatters in the growth law.
    pub fn sensitivities<'n>(
        &self,
        scatter: &Scatter,
        names: impl IntoIterator<Item = &'n str>,
        inputs: &[Vec<f64>],
    ) -> Vec<Sensitivity> {
        let names = names.into_iter().enumerate();
        let of_inputs = names.map(|(input, name)| self.sensitivity(name, |_, sample| inputs[sample][input]));
        let of_law = (0..KEYS.len())
            .filter(|&i| spread(scatter)[i] > 0.0)
            .map(|i| self.sensitivity(KEYS[i], |sample, _| sample.draw.deviates[i]));
        of_inputs.chain(of_law).collect()
    }

    /// The results, where the crack is inspected every `interval` million gross tonnes; with
    /// `is_removed`, the results include how often the crack grows despite the removal.
    pub fn summary(
        self,
        scatter: &Scatter,
        interval: Option<f64>,
        is_removed: bool,
        mut sensitivities: Vec<Sensitivity>,
    ) -> ScatterSummary {
        let count = self.samples.len().max(1) as f64;
        let share_of = |is_it: &dyn Fn(&Sample) -> bool| {
            self.samples.iter().filter(|sample| is_it(sample)).count() as f64 / count
        };
        sensitivities.sort_by(|a, b| b.share.total_cmp(&a.share));
        let of_sample = |sample: &Sample| {
            [sample.to_critical, sample.way, sample.outlives].map(|mgt| mgt.is_finite().then_some(mgt))
        };
        let lives = self.samples.iter().take(if is_removed { FIRST } else { 0 }).map(of_sample).collect();
        let first = self.samples.iter().map(|sample| sample.outlives).fold(f64::INFINITY, f64::min);
        let outlived = first
            .is_finite()
            .then(|| Outlived { share: share_of(&|sample| sample.outlives.is_finite()), mgt: first });
        ScatterSummary {
            samples: self.samples.len(),
            seed: scatter.seed,
            probability_of_failure: share_of(&|sample| sample.to_critical.is_finite()),
            outlived,
            between_runs: None,
            mgt_to_critical: quantiles(self.samples.iter().map(|sample| sample.to_critical).collect())
                .known(|mgt| share_of(&|sample| sample.outlives < mgt)),
            mgt_detectable_to_critical: quantiles(self.samples.iter().map(|sample| sample.way).collect()),
            probability_critical_before_inspection: interval
                .map(|interval| share_of(&|sample| sample.way < interval)),
            probability_growing: is_removed.then(|| share_of(&|sample| sample.grows)),
            depth: self
                .tonnages
                .into_iter()
                .zip(self.depths)
                .map(|(mgt, depths)| DepthQuantiles { mgt, depth_mm: quantiles(depths) })
                .collect(),
            sensitivities,
            first: lives,
        }
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

impl Quantiles {
    /// None.
    pub(crate) const NONE: Self = Self { p05: None, p50: None, p95: None };

    /// Only those before which at most a share of [`LOST`] of the samples got lost, which `lost`
    /// counts.
    fn known(self, lost: impl Fn(f64) -> f64) -> Self {
        let known = |value: Option<f64>| value.filter(|value| lost(*value) <= LOST);
        Self { p05: known(self.p05), p50: known(self.p50), p95: known(self.p95) }
    }
}

/// Share of samples whose fate is not known that leaves a quantile as it is.
const LOST: f64 = 2e-3;

#[cfg(test)]
#[path = "scatter_tests.rs"]
mod tests;

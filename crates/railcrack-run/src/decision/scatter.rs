//! Scatter of what does not change the path of the crack, by sampling.

use super::risk::DepthCurve;
use super::sampler::{Draw, Draws, KEYS, Sample, Sampler, Sampling};
use super::walk::Track;
use railcrack_case::Scatter;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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

/// The samples, with quantiles of the depth at `tonnages`, where the crack is inspected every
/// `interval` million gross tonnes.
///
/// The histories of K along the path do not depend on C, nor on m, the wear and the shares of the
/// wheels as long as the path is the same: each sample has the rates of the courses times
/// e^(σ_C z) (ΔK_eq/10)^(σ_m z′), and those of each wheel of a mix by its share; its cycles follow
/// by the same rule as those of the run, and without scatter they are those of the run.
///
/// The lives of the samples follow where the `risk` of inspections is asked for; otherwise none.
pub(crate) fn sampled(
    of: Sampling,
    tonnages: Vec<f64>,
    interval: Option<f64>,
    risk: Lives,
) -> (ScatterSummary, Vec<SampledLife>) {
    let scatter = of.scatter;
    let sampler = Sampler::of(of);
    let mut gathered = Gathered::new(scatter, of.mix.len(), tonnages);
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
    let mut sensitivities: Vec<Sensitivity> =
        (0..KEYS.len()).filter(|&i| spread(scatter)[i] > 0.0).map(|i| gathered.of_key(i)).collect();
    if scatter.share_log_std > 0.0 {
        let of_wheel = |wheel| gathered.sensitivity("share_log_std", gathered.deviate(KEYS.len() + wheel));
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
    pub depths: DepthCurve<f32>,
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
        let Sample { to_critical: failure, outlives, found_from, .. } = *sample;
        Self { failure, outlives, depths: depths.in_single_precision(), found_from }
    }
}

/// Samples that are in memory with all their deviates at once.
const PIECE: usize = 1 << 13;

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

/// The tonnages of a sample: million gross tonnes until the rail fails, from the detectable crack
/// to then, and until it is known to hold.
#[derive(Debug, Clone, Copy)]
struct Kept {
    to_critical: f64,
    way: f64,
    outlives: f64,
}

/// Samples, and their depths at given tonnages.
pub(crate) struct Gathered {
    samples: Vec<Kept>,
    /// How many of them grow at first.
    growing: usize,
    /// The quantities that scatter: [`KEYS`], and behind them the shares of the wheels.
    scattered: Vec<usize>,
    /// Their deviates, sample by sample.
    deviates: Vec<f32>,
    tonnages: Vec<f64>,
    depths: Vec<DepthCounts>,
}

impl Gathered {
    /// No samples yet under a mix of `wheels`; `tonnages` in million gross tonnes.
    pub fn new(scatter: &Scatter, wheels: usize, tonnages: Vec<f64>) -> Self {
        let shares = if scatter.share_log_std > 0.0 { wheels } else { 0 };
        let keys = (0..KEYS.len()).filter(|&i| spread(scatter)[i] > 0.0);
        let scattered: Vec<usize> = keys.chain(KEYS.len()..KEYS.len() + shares).collect();
        let deviates = Vec::with_capacity(scatter.samples * scattered.len());
        let depths = tonnages.iter().map(|_| DepthCounts::default()).collect();
        let samples = Vec::with_capacity(scatter.samples);
        Self { samples, growing: 0, scattered, deviates, tonnages, depths }
    }

    /// Takes `sample` with its `depths` (mm) at the tonnages.
    pub fn take(&mut self, sample: Sample, depths: Vec<f64>) {
        let Sample { draw, grows, to_critical, way, outlives, .. } = sample;
        self.samples.push(Kept { to_critical, way, outlives });
        self.growing += usize::from(grows);
        let deviate = |&i: &usize| draw.deviates.get(i).unwrap_or_else(|| &draw.shares[i - KEYS.len()]);
        self.deviates.extend(self.scattered.iter().map(|i| *deviate(i) as f32));
        self.depths.iter_mut().zip(depths).for_each(|(all, depth)| all.take(depth));
    }

    /// The deviate of the quantity `i` by the index of a sample; zero where it does not scatter.
    fn deviate(&self, i: usize) -> impl Fn(usize) -> f64 {
        let place = self.scattered.iter().position(|own| *own == i);
        move |sample| place.map_or(0.0, |place| self.deviates[sample * self.scattered.len() + place].into())
    }

    /// The sensitivity of the key `i`.
    fn of_key(&self, i: usize) -> Sensitivity {
        self.sensitivity(KEYS[i], self.deviate(i))
    }

    /// Squared correlation of `deviate`, by the index of a sample, with the logarithm of the
    /// tonnage until critical, over the samples that become critical.
    pub fn sensitivity(&self, key: &str, deviate: impl Fn(usize) -> f64) -> Sensitivity {
        let reached: Vec<(f64, f64)> = self
            .samples
            .iter()
            .enumerate()
            .filter(|(_, sample)| sample.way.is_finite() && sample.way > 0.0)
            .map(|(i, sample)| (deviate(i), sample.way.ln()))
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
        let of_inputs = names.map(|(input, name)| self.sensitivity(name, |sample| inputs[sample][input]));
        let of_law = (0..KEYS.len()).filter(|&i| spread(scatter)[i] > 0.0).map(|i| self.of_key(i));
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
        let share_of = |is_it: &dyn Fn(&Kept) -> bool| {
            self.samples.iter().filter(|sample| is_it(sample)).count() as f64 / count
        };
        sensitivities.sort_by(|a, b| b.share.total_cmp(&a.share));
        let of_sample = |sample: &Kept| {
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
            probability_growing: is_removed.then(|| self.growing as f64 / count),
            depth: self
                .tonnages
                .into_iter()
                .zip(self.depths)
                .map(|(mgt, depths)| DepthQuantiles { mgt, depth_mm: depths.quantiles() })
                .collect(),
            sensitivities,
            first: lives,
        }
    }
}

/// Depths of samples in classes that are narrower than 0.05 % of them: their number, the least and
/// the largest of each.
#[derive(Debug, Default)]
struct DepthCounts {
    classes: BTreeMap<u64, (usize, f64, f64)>,
}

/// Bits of a depth that do not tell its class.
const WITHIN_CLASS: u32 = f64::MANTISSA_DIGITS - 1 - 11;

impl DepthCounts {
    fn take(&mut self, depth: f64) {
        let depth = depth.max(0.0);
        let class = self.classes.entry(depth.to_bits() >> WITHIN_CLASS).or_insert((0, depth, depth));
        *class = (class.0 + 1, class.1.min(depth), class.2.max(depth));
    }

    /// The quantiles, with even distances in a class.
    fn quantiles(&self) -> Quantiles {
        let count = self.classes.values().map(|class| class.0).sum::<usize>();
        let at = |share: f64| {
            let place = (share * (count.max(1) - 1) as f64).round() as usize;
            let mut before = 0;
            let reaches = |(number, ..): &&(usize, f64, f64)| {
                before += number;
                before > place
            };
            let &(number, least, most) = self.classes.values().find(reaches)?;
            let between = (place + number - before) as f64 / (number.max(2) - 1) as f64;
            Some(if most > least { least + between * (most - least) } else { least })
                .filter(|at| at.is_finite())
        };
        Quantiles { p05: at(0.05), p50: at(0.5), p95: at(0.95) }
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

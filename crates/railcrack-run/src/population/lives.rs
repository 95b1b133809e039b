//! A population of cracks whose surface is removed: interpolated between the lives of the samples
//! of its runs.
//!
//! Under wear and grinding the path of a crack depends on what is sampled, so that each run has
//! samples of its own. The first samples of all runs have the same deviates of the growth law: for
//! each of them 1/life, zero where the rail does not fail, and the fraction of the life from
//! detectable to failure are interpolated over the inputs of the study.

use super::drawn::{DrawnRuns, MOST_RUNS};
use super::interpolation::Interpolation;
use crate::decision::{Draw, Draws, FailureMode, Fate, FirstSample, Gathered, Sample, ScatterSummary};
use crate::study::{InterpolationError, Population, StudyRow};
use railcrack::math::Matrix;
use rayon::prelude::*;

/// 1/life over the smallest of all runs for the same sample, below which a rail does not fail:
/// under grinding the lives end abruptly where it outpaces growth, between two runs, and none twice
/// as long as the longest was computed.
const NEVER: f64 = 0.5;

/// A run as a point of the space of inputs.
struct Point<'a> {
    inputs: Vec<f64>,
    first: &'a [FirstSample],
    /// The run itself.
    nominal: [Option<f64>; 2],
}

impl<'a> Point<'a> {
    fn of(inputs: Vec<f64>, row: &'a StudyRow) -> Option<Self> {
        let decision = row.summary.as_ref()?.decision.as_ref()?;
        let way = decision.inspection.as_ref().and_then(|of| of.mgt_detectable_to_critical);
        let first = &decision.scatter.as_ref()?.first;
        Some(Self { inputs, first, nominal: [decision.failure.mgt, way] })
    }
}

/// 1/life and the fraction of the life from detectable to failure.
fn numbers(life: Option<f64>, way: Option<f64>) -> Option<[f64; 2]> {
    let life = life?.max(f64::MIN_POSITIVE);
    Some([life.recip(), (way.unwrap_or(0.0) / life).clamp(0.0, 1.0)])
}

/// The population of `drawn`.
///
/// Errors: why there are no samples.
pub(super) fn population(drawn: &DrawnRuns) -> Result<Population, String> {
    let mut points: Vec<Point> =
        drawn.done().filter_map(|(index, row)| Point::of(drawn.inputs(index)?, row)).collect();
    let left_out = drawn.done().count() - points.len();
    points.truncate(MOST_RUNS);
    let count = points.iter().map(|point| point.first.len()).min().unwrap_or(0);
    if count == 0 {
        return Err("no run has samples of its own".to_owned());
    }
    // The first samples, and last the run itself.
    let of_point = |point: &Point, k: usize| match point.first.get(k).filter(|_| k < count) {
        Some([life, way, _]) => numbers(*life, *way),
        None => numbers(point.nominal[0], point.nominal[1]),
    };
    let mut values = Matrix::zeros(points.len(), 2 * (count + 1));
    for k in 0..=count {
        let known: Vec<Option<[f64; 2]>> = points.iter().map(|point| of_point(point, k)).collect();
        let fails = known.iter().flatten().count().max(1) as f64;
        let usual = known.iter().flatten().map(|[_, fraction]| fraction).sum::<f64>() / fails;
        for (i, own) in known.iter().enumerate() {
            let [rate, fraction] = own.unwrap_or([0.0, usual]);
            values[(i, 2 * k)] = rate;
            values[(i, 2 * k + 1)] = fraction;
        }
    }
    let inputs: Vec<Vec<f64>> = points.iter().map(|point| point.inputs.clone()).collect();
    let interpolation = drawn.interpolated(&inputs, &values)?;
    let smallest = |k: usize| {
        let all = (0..points.len()).map(|i| values[(i, 2 * k)]).filter(|rate| *rate > 0.0);
        all.fold(f64::INFINITY, f64::min)
    };
    let smallest: Vec<f64> = (0..=count).map(smallest).collect();
    let between = LivesBetween { points, count, interpolation, smallest };
    let way_of =
        |[rate, fraction]: [f64; 2]| between.life(count, rate).map(|life| life * fraction.clamp(0.0, 1.0));
    let pairs: Vec<(f64, f64)> = (0..between.points.len())
        .filter_map(|i| {
            let found = between.interpolation.left_out(i);
            let exact = between.points[i].nominal[1].filter(|way| *way > 0.0)?;
            way_of([found[2 * count], found[2 * count + 1]]).filter(|way| *way > 0.0).map(|way| (exact, way))
        })
        .collect();
    let middle = vec![0.0; drawn.distributions.len()];
    let nominal = [0, 1].map(|of| between.interpolation.one_at(&middle, 2 * count + of));
    let interval = way_of(nominal).map(|way| way / drawn.plan.safety_factor);
    Ok(Population {
        runs: between.points.len(),
        left_out,
        error: InterpolationError::of(&pairs),
        interval_mgt: interval,
        scatter: Some(between.summary(drawn, interval)),
        ..Population::default()
    })
}

/// Samples of the runs, interpolated.
struct LivesBetween<'a> {
    points: Vec<Point<'a>>,
    /// Number of samples of each run.
    count: usize,
    interpolation: Interpolation,
    /// The smallest 1/life of the runs that fail, for each sample and last for the runs themselves;
    /// infinite where none fails.
    smallest: Vec<f64>,
}

impl LivesBetween<'_> {
    /// The life with 1/life of `rate` in the sample `k`; none where the rail does not fail.
    fn life(&self, k: usize, rate: f64) -> Option<f64> {
        (rate > NEVER * self.smallest[k]).then(|| rate.recip())
    }

    /// The sample of `draw`, the sample `k` of the runs, with the inputs at `point`.
    fn sample(&self, draw: Draw, k: usize, point: &[f64]) -> Sample {
        let [rate, fraction] = [0, 1].map(|of| self.interpolation.one_at(point, 2 * k + of));
        let life = self.life(k, rate).unwrap_or(f64::INFINITY);
        let way = if life.is_finite() { life * fraction.clamp(0.0, 1.0) } else { f64::INFINITY };
        let apart = |own: &Point| own.inputs.iter().zip(point).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let nearest = self.points.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let outlives = nearest.and_then(|own| own.first[k][2]).filter(|_| life == f64::INFINITY);
        let fate = match outlives {
            Some(mgt) => Fate::Outlives(mgt),
            None if life.is_finite() => Fate::Fails(FailureMode::Depth, life),
            None => Fate::Rests,
        };
        let outlives = outlives.unwrap_or(f64::INFINITY);
        Sample { draw, grows: false, to_critical: life, way, outlives, found_from: None, fate }
    }

    fn summary(&self, drawn: &DrawnRuns, interval: Option<f64>) -> ScatterSummary {
        let scatter = drawn.plan.scatter();
        let mut draws = Draws::of(&scatter, &[]);
        let of_runs: Vec<Draw> = (0..self.count).map(|_| draws.next()).collect();
        let inputs: Vec<Vec<f64>> = (0..scatter.samples).map(|_| drawn.draw(&mut draws)).collect();
        let sample = |(j, point): (usize, &Vec<f64>)| {
            let k = j % self.count;
            self.sample(of_runs[k], k, point)
        };
        let samples: Vec<Sample> = inputs.par_iter().enumerate().map(sample).collect();
        let mut gathered = Gathered::new(&scatter, 0, Vec::new());
        samples.into_iter().for_each(|sample| gathered.take(sample, Vec::new()));
        drawn.summary(gathered, &scatter, interval, &inputs)
    }
}

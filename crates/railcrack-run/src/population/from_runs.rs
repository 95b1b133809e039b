//! A population of cracks made from the runs of a study.

use super::interpolation::Interpolation;
use super::shape::{NUMBERS, numbers_of, path_of, path_of_tip};
use crate::decision::{
    Course, Draws, Family, Gathered, GrowthPath, InspectionSummary, Nominal, Question, Sampler, Sampling,
    ScatterSummary, Track, tonnages,
};
use crate::study::{
    Between, InterpolationError, Population, PopulationPlan, RunState, StudyAxis, StudyPlan, StudyResults,
    StudyRow, distributions,
};
use railcrack::growth::{Axles, RunStop, SurfaceRemoval};
use railcrack::math::Matrix;
use railcrack_case::{Distribution, Scatter};
use rayon::prelude::*;

/// Maximum number of runs used for interpolation; further runs measure its error.
const MOST_RUNS: usize = 200;
/// Fraction of the runs that may be left out.
const MOST_LEFT_OUT: f64 = 0.05;
/// Fraction of the runs that may have no interval by their verdicts: more, and the population is
/// not described either.
const MOST_REFUSED: f64 = 0.2;
/// Samples of a piece that one thread makes.
const PIECE: usize = 1000;

/// Runs with the index of their values of the drawn keys.
type DrawnRuns<'a> = Vec<(usize, &'a StudyRow)>;

/// A run as a point of the space of inputs.
struct Point {
    inputs: Vec<f64>,
    path: GrowthPath,
    numbers: Vec<f64>,
    breaks: bool,
}

impl Population {
    /// Populations from the finished runs of a study; empty where `plan` has no samples between
    /// them.
    pub fn of(plan: &StudyPlan, results: &StudyResults) -> Vec<Self> {
        let Some(population) = &plan.population else { return Vec::new() };
        let Some(drawn) = plan.axes.iter().position(StudyAxis::is_drawn) else { return Vec::new() };
        let texts = plan.axes[drawn].keys.iter().map(|key| key.distribution.as_deref());
        let distributions = distributions(texts);
        let mut groups: Vec<(Vec<usize>, DrawnRuns)> = Vec::new();
        for (run, row) in plan.runs.iter().zip(&results.rows) {
            let mut choice = run.choice.clone();
            let index = std::mem::take(&mut choice[drawn]);
            match groups.iter_mut().find(|(other, _)| *other == choice) {
                Some((_, runs)) => runs.push((index, row)),
                None => groups.push((choice, vec![(index, row)])),
            }
        }
        let of_group = |(choice, runs): (Vec<usize>, DrawnRuns)| {
            let names = plan.axes.iter().zip(&choice).enumerate().filter(|(axis, _)| *axis != drawn);
            let choice: Vec<String> =
                names.map(|(_, (axis, &index))| format!("{} = {}", axis.name(), axis.value(index))).collect();
            let made = match &distributions {
                Some(distributions) => Self::of_runs(population, &plan.axes[drawn], distributions, &runs),
                None => Err("one of the sampled keys is not a number".to_owned()),
            };
            let made = made.unwrap_or_else(Self::none);
            Self { choice: choice.join(", "), ..made }
        };
        groups.into_iter().map(of_group).collect()
    }

    fn none(reason: String) -> Self {
        Self {
            choice: String::new(),
            runs: 0,
            left_out: 0,
            error: None,
            interval_mgt: None,
            scatter: None,
            reason: Some(reason),
        }
    }

    fn of_runs(
        plan: &PopulationPlan,
        axis: &StudyAxis,
        distributions: &[Distribution],
        runs: &[(usize, &StudyRow)],
    ) -> Result<Self, String> {
        let (refused, finished) = refused(runs);
        if refused as f64 > MOST_REFUSED * finished as f64 {
            return Err(format!(
                "{refused} of {finished} runs are outside of what the model describes, or fail at once"
            ));
        }
        if plan.between == Between::Lives {
            return super::lives::population(plan, axis, distributions, runs);
        }
        let done: Vec<_> = runs.iter().filter(|(_, row)| row.state == RunState::Done).collect();
        let points: Vec<Point> =
            done.iter().filter_map(|(index, row)| Point::of(axis, *index, distributions, row)).collect();
        let left_out = done.len() - points.len();
        if left_out as f64 > MOST_LEFT_OUT * done.len() as f64 {
            return Err(format!("{left_out} of {} cracks do not grow", done.len()));
        }
        let (base, beyond) = points.split_at(points.len().min(MOST_RUNS));
        let inputs: Vec<Vec<f64>> = base.iter().map(|point| point.inputs.clone()).collect();
        let numbers = Matrix::from_fn(base.len(), NUMBERS, |i, j| base[i].numbers[j]);
        let interpolation = Interpolation::of(&inputs, &numbers)
            .ok_or_else(|| format!("{} runs are too few for {} keys", base.len(), distributions.len()))?;
        let breaks = !base.is_empty() && base.iter().all(|point| point.breaks);
        let question = question(plan);
        let way = |path: &GrowthPath| {
            let nominal = Nominal::of(&Course::of_path(path), &question);
            InspectionSummary::of(&nominal, &question.inspection, &[])
        };
        let known = |(point, numbers): (&Point, Vec<f64>)| {
            let exact = way(&GrowthPath { breaks: point.breaks, ..point.path.clone() });
            let found = way(&path_of(&numbers, point.breaks));
            let pair = exact.mgt_detectable_to_critical.zip(found.mgt_detectable_to_critical);
            pair.filter(|(exact, found)| *exact > 0.0 && *found > 0.0)
        };
        let ways: Vec<(f64, f64)> = if beyond.is_empty() {
            base.iter()
                .enumerate()
                .map(|(i, point)| (point, interpolation.left_out(i)))
                .filter_map(known)
                .collect()
        } else {
            beyond.iter().map(|point| (point, interpolation.at(&point.inputs))).filter_map(known).collect()
        };
        let nominal = path_of(&interpolation.at(&vec![0.0; distributions.len()]), breaks);
        let samples = Samples { question, scatter: plan.scatter(), interpolation, breaks };
        let interval_mgt = way(&nominal).interval_mgt;
        Ok(Self {
            choice: String::new(),
            runs: base.len(),
            left_out,
            error: InterpolationError::of(&ways),
            interval_mgt,
            scatter: Some(samples.made(axis, distributions, &points, interval_mgt)),
            reason: None,
        })
    }
}

impl Point {
    /// The point of a finished run, which has the values at `index` of the drawn keys; none where
    /// its crack does not grow.
    fn of(axis: &StudyAxis, index: usize, distributions: &[Distribution], row: &StudyRow) -> Option<Self> {
        let values = axis.keys.iter().zip(distributions);
        let inputs: Option<Vec<f64>> =
            values.map(|(key, distribution)| distribution.standardised(key.values.get(index)?)).collect();
        let tip = row.representative.as_ref()?;
        let path = path_of_tip(tip)?;
        let numbers = numbers_of(&path)?;
        Some(Self { inputs: inputs?, numbers, path, breaks: tip.last().stop == Some(RunStop::Fracture) })
    }
}

/// How many of the finished `runs` have no interval by their verdicts, and how many have finished.
fn refused(runs: &[(usize, &StudyRow)]) -> (usize, usize) {
    let done: Vec<_> = runs.iter().filter(|(_, row)| row.state == RunState::Done).collect();
    let has_none = |row: &StudyRow| {
        let verdict = row.summary.as_ref().and_then(|summary| summary.verdict.as_ref());
        verdict.is_some_and(|verdict| !verdict.gives_intervals())
    };
    (done.iter().filter(|(_, row)| has_none(row)).count(), done.len())
}

/// The question to each crack of a population.
fn question(plan: &PopulationPlan) -> Question {
    Question {
        inspection: plan.inspection(),
        critical_length: plan.critical_length_mm,
        tonnes: plan.axle_load_t,
        removal: SurfaceRemoval::NONE,
    }
}

impl InterpolationError {
    /// Errors of pairs of exact and interpolated tonnages. None without pairs.
    pub(super) fn of(ways: &[(f64, f64)]) -> Option<Self> {
        if ways.is_empty() {
            return None;
        }
        let count = ways.len() as f64;
        let errors: Vec<f64> = ways.iter().map(|(exact, found)| (found / exact).ln()).collect();
        let squares = errors.iter().map(|error| error * error).sum::<f64>();
        let mean = ways.iter().map(|(exact, _)| exact.ln()).sum::<f64>() / count;
        let variance: f64 = ways.iter().map(|(exact, _)| (exact.ln() - mean).powi(2)).sum();
        Some(Self {
            runs: ways.len(),
            rms_percent: 100.0 * (squares / count).sqrt(),
            worst_percent: 100.0 * errors.iter().fold(0.0, |worst: f64, error| worst.max(error.abs())),
            explained: if variance > 0.0 { 1.0 - squares / variance } else { 1.0 },
        })
    }
}

/// How samples are made.
struct Samples {
    question: Question,
    scatter: Scatter,
    interpolation: Interpolation,
    breaks: bool,
}

impl Samples {
    fn made(
        &self,
        axis: &StudyAxis,
        distributions: &[Distribution],
        points: &[Point],
        interval: Option<f64>,
    ) -> ScatterSummary {
        let scatter = &self.scatter;
        let longest = points.iter().map(|point| &point.path).max_by(|a, b| {
            let end = |path: &GrowthPath| path.points.last().map_or(0.0, |point| point.axles);
            end(a).total_cmp(&end(b))
        });
        let tonnages = longest.map_or_else(Vec::new, |path| {
            let axles = path.points.last().map_or(0.0, |point| point.axles);
            tonnages(Axles(axles).mgt(self.question.tonnes).0, scatter)
        });
        let mut gathered = Gathered::new(scatter, tonnages.clone());
        let mut draws = Draws::of(scatter, &[]);
        let mut inputs: Vec<Vec<f64>> = Vec::with_capacity(scatter.samples);
        let mut deviates = Vec::with_capacity(scatter.samples);
        for _ in 0..scatter.samples {
            deviates.push(draws.next());
            let drawn = |of: &Distribution| of.standardised(&of.value(draws.share())).unwrap_or(0.0);
            inputs.push(distributions.iter().map(drawn).collect());
        }
        let made: Vec<_> = inputs
            .par_chunks(PIECE)
            .zip(deviates.par_chunks(PIECE))
            .flat_map_iter(|(inputs, draws)| {
                let mut track = Track::default();
                let of_one = |(inputs, draw): (&Vec<f64>, _)| {
                    let path = path_of(&self.interpolation.at(inputs), self.breaks);
                    let family = Family::alone(&Course::of_path(&path));
                    let sampler = Sampler::of(Sampling {
                        family: &family,
                        question: self.question,
                        scatter,
                        mix: &[],
                        arrest_rate: 0.0,
                        has_own_toughness: false,
                    });
                    let sample = sampler.sample(draw, &mut track);
                    let depth = |at: &f64| track.at(*at, sample.fate);
                    (sample, tonnages.iter().map(depth).collect::<Vec<f64>>())
                };
                inputs.iter().zip(draws).map(of_one).collect::<Vec<_>>()
            })
            .collect();
        for (sample, depths) in made {
            gathered.take(sample, depths);
        }
        let names = axis.keys.iter().map(|key| key.name.as_str());
        let sensitivities = gathered.sensitivities(scatter, names, &inputs);
        gathered.summary(scatter, interval, false, sensitivities)
    }
}

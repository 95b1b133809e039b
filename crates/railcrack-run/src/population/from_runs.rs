//! A population of cracks made from the runs of a study.

use super::drawn::{DrawnRuns, IndexedRuns, MOST_RUNS};
use super::interpolation::Interpolation;
use super::shape::{NUMBERS, numbers_of, path_of, path_of_tip};
use crate::decision::{
    Course, Draws, Family, Gathered, GrowthPath, InspectionSummary, Nominal, Question, Sampler, Sampling,
    ScatterSummary, Track, tonnages,
};
use crate::study::{
    Between, InterpolationError, Population, PopulationPlan, StudyAxis, StudyPlan, StudyResults, StudyRow,
    distributions,
};
use railcrack::growth::{Axles, RunStop, SurfaceRemoval};
use railcrack::math::Matrix;
use railcrack_case::Scatter;
use rayon::prelude::*;

/// Fraction of the runs that may be left out.
const MOST_LEFT_OUT: f64 = 0.05;
/// Fraction of the runs that may have no interval by their verdicts: more, and the population is
/// not described either.
const MOST_REFUSED: f64 = 0.2;
/// Samples of a piece that one thread makes.
const PIECE: usize = 1000;

/// A run as a point of the space of inputs.
struct Point {
    inputs: Vec<f64>,
    path: GrowthPath,
    numbers: Vec<f64>,
    breaks: bool,
}

impl Population {
    /// Populations from the finished runs of a study; empty where `plan` has no samples between
    /// them. Runs beyond the most between which is interpolated measure the error.
    pub fn of(plan: &StudyPlan, results: &StudyResults) -> Vec<Self> {
        let Some(population) = &plan.population else { return Vec::new() };
        let Some(drawn) = plan.axes.iter().position(StudyAxis::is_drawn) else { return Vec::new() };
        let axis = &plan.axes[drawn];
        let distributions = distributions(axis.keys.iter().map(|key| key.distribution.as_deref()));
        let mut groups: Vec<(Vec<usize>, IndexedRuns)> = Vec::new();
        for (run, row) in plan.runs.iter().zip(&results.rows) {
            let mut choice = run.choice.clone();
            let index = std::mem::take(&mut choice[drawn]);
            match groups.iter_mut().find(|(other, _)| *other == choice) {
                Some((_, runs)) => runs.push((index, row)),
                None => groups.push((choice, vec![(index, row)])),
            }
        }
        let of_group = |(choice, runs): (Vec<usize>, IndexedRuns)| {
            let names = plan.axes.iter().zip(&choice).enumerate().filter(|(axis, _)| *axis != drawn);
            let choice: Vec<String> =
                names.map(|(_, (axis, &index))| format!("{} = {}", axis.name(), axis.value(index))).collect();
            let made = match &distributions {
                Some(distributions) => of_runs(&DrawnRuns { plan: population, axis, distributions, runs }),
                None => Err("one of the sampled keys is not a number".to_owned()),
            };
            let made = made.unwrap_or_else(|reason| Self { reason: Some(reason), ..Self::default() });
            Self { choice: choice.join(", "), ..made }
        };
        groups.into_iter().map(of_group).collect()
    }
}

/// The population of `drawn`.
///
/// Errors: why there are no samples.
fn of_runs(drawn: &DrawnRuns) -> Result<Population, String> {
    let (refused, finished) = refused(drawn);
    if refused as f64 > MOST_REFUSED * finished as f64 {
        return Err(format!(
            "{refused} of {finished} runs are outside of what the model describes, or fail at once"
        ));
    }
    if drawn.plan.between == Between::Lives {
        return super::lives::population(drawn);
    }
    let points: Vec<Point> =
        drawn.done().filter_map(|(index, row)| Point::of(drawn.inputs(index)?, row)).collect();
    let left_out = finished - points.len();
    if left_out as f64 > MOST_LEFT_OUT * finished as f64 {
        return Err(format!("{left_out} of {finished} cracks do not grow"));
    }
    let (base, beyond) = points.split_at(points.len().min(MOST_RUNS));
    let inputs: Vec<Vec<f64>> = base.iter().map(|point| point.inputs.clone()).collect();
    let numbers = Matrix::from_fn(base.len(), NUMBERS, |i, j| base[i].numbers[j]);
    let interpolation = drawn.interpolated(&inputs, &numbers)?;
    let breaks = !base.is_empty() && base.iter().all(|point| point.breaks);
    let samples = Samples { drawn, question: question(drawn.plan), interpolation, breaks };
    let interpolation = &samples.interpolation;
    let pairs: Vec<(f64, f64)> = if beyond.is_empty() {
        let all = base.iter().enumerate().map(|(i, point)| (point, interpolation.left_out(i)));
        all.filter_map(|found| samples.exact_and_found(found)).collect()
    } else {
        let all = beyond.iter().map(|point| (point, interpolation.at(&point.inputs)));
        all.filter_map(|found| samples.exact_and_found(found)).collect()
    };
    let nominal = path_of(&interpolation.at(&vec![0.0; drawn.distributions.len()]), breaks);
    let interval_mgt = samples.inspected(&nominal).interval_mgt;
    Ok(Population {
        runs: base.len(),
        left_out,
        error: InterpolationError::of(&pairs),
        interval_mgt,
        scatter: Some(samples.summary(&points, interval_mgt)),
        ..Population::default()
    })
}

impl Point {
    /// The point of a finished run with these `inputs`; none where its crack does not grow.
    fn of(inputs: Vec<f64>, row: &StudyRow) -> Option<Self> {
        let tip = row.representative.as_ref()?;
        let path = path_of_tip(tip)?;
        let numbers = numbers_of(&path)?;
        Some(Self { inputs, numbers, path, breaks: tip.last().stop == Some(RunStop::Fracture) })
    }
}

/// How many of the finished runs have no interval by their verdicts, and how many have finished.
fn refused(drawn: &DrawnRuns) -> (usize, usize) {
    let has_none = |row: &StudyRow| {
        let verdict = row.summary.as_ref().and_then(|summary| summary.verdict.as_ref());
        verdict.is_some_and(|verdict| !verdict.gives_intervals())
    };
    (drawn.done().filter(|(_, row)| has_none(row)).count(), drawn.done().count())
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
struct Samples<'a> {
    drawn: &'a DrawnRuns<'a>,
    question: Question,
    interpolation: Interpolation,
    breaks: bool,
}

impl Samples<'_> {
    /// The intervals of a rail that grows along `path`.
    fn inspected(&self, path: &GrowthPath) -> InspectionSummary {
        let nominal = Nominal::of(&Course::of_path(path), &self.question);
        InspectionSummary::of(&nominal, &self.question.inspection, &[])
    }

    /// The tonnage from detectable to critical of a run, and by the `numbers` interpolated there.
    fn exact_and_found(&self, (point, numbers): (&Point, Vec<f64>)) -> Option<(f64, f64)> {
        let exact = self.inspected(&GrowthPath { breaks: point.breaks, ..point.path.clone() });
        let found = self.inspected(&path_of(&numbers, point.breaks));
        let pair = exact.mgt_detectable_to_critical.zip(found.mgt_detectable_to_critical);
        pair.filter(|(exact, found)| *exact > 0.0 && *found > 0.0)
    }

    /// Million gross tonnes at which depths are gathered: those of the longest of `points`.
    fn tonnages(&self, points: &[Point], scatter: &Scatter) -> Vec<f64> {
        let end = |point: &Point| point.path.points.last().map_or(0.0, |point| point.axles);
        let longest = points.iter().map(end).max_by(f64::total_cmp);
        longest.map_or_else(Vec::new, |axles| tonnages(Axles(axles).mgt(self.question.tonnes).0, scatter))
    }

    fn summary(&self, points: &[Point], interval: Option<f64>) -> ScatterSummary {
        let scatter = self.drawn.plan.scatter();
        let tonnages = self.tonnages(points, &scatter);
        let mut gathered = Gathered::new(&scatter, 0, tonnages.clone());
        let mut draws = Draws::of(&scatter, &[]);
        let both = (0..scatter.samples).map(|_| (draws.next(), self.drawn.draw(&mut draws)));
        let (deviates, inputs): (Vec<_>, Vec<Vec<f64>>) = both.unzip();
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
                        scatter: &scatter,
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
        self.drawn.summary(gathered, &scatter, interval, &inputs)
    }
}

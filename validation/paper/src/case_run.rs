//! Results of one run for figures and statements.

use crate::error::PaperError;
use railcrack::contact::FaceStatus;
use railcrack::crack::Crack;
use railcrack::growth::{GrowthError, Observer, StepRecord};
use railcrack::math::MPA_SQRT_MM;
use railcrack_case::Case;
use railcrack_run::csv::TipRow;
use railcrack_run::setup::{PreparedRun, SharedRail};

/// K_I and K_II of one tip of the initial cracks over the stabilised passage.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SifCurve {
    /// Wheel positions over a, counted along the travel from x = 0, the mouth of crack 1.
    pub position: Vec<f64>,
    /// K_I, MPa√m.
    pub ki: Vec<f64>,
    /// K_II, MPa√m.
    pub kii: Vec<f64>,
    /// Whether the whole crack sticks.
    pub sticks: Vec<bool>,
}

/// One crack of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CrackGrowth {
    /// K of the initial crack.
    pub sif: SifCurve,
    /// The tip at every step; the first one is that of the initial crack.
    pub steps: Vec<TipRow>,
    /// The crack at the end, (x, depth) in mm from its mouth.
    pub points: Vec<[f64; 2]>,
    /// Number of points of the initial crack among them.
    pub initial_points: usize,
}

/// One run: a case in one set-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CaseRun {
    /// Its cracks, as the case numbers them.
    pub cracks: Vec<CrackGrowth>,
    /// Whether its cracks grow.
    pub grows: bool,
    /// Why it ended early, where a step could not be computed.
    pub failure: Option<String>,
    /// Its warnings, with their steps.
    pub warnings: Vec<String>,
    /// Number of growth steps.
    pub steps: usize,
    /// Number of contact solutions.
    pub solves: usize,
    /// Wall time, s.
    pub wall_s: f64,
}

/// No run is interrupted, and its progress is not shown.
struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        false
    }
}

impl CaseRun {
    /// Computes `case`, on `rail` where another run has made it. A step that cannot be computed
    /// ends the run.
    ///
    /// Errors: a stress that the rail cannot carry; the first step cannot be computed.
    pub fn compute(name: &str, case: &Case, rail: Option<&SharedRail>) -> Result<Self, PaperError> {
        let stress = |source| PaperError::Stress { name: name.to_owned(), source };
        let mut growth = PreparedRun::sharing(case, None, rail).map_err(stress)?.growth(None);
        let mut run = Self { grows: case.growth.steps > 0, ..Self::default() };
        loop {
            match growth.next_step(&Unobserved) {
                Ok(Some(record)) => run.add(case, &record),
                Ok(None) => return Ok(run),
                Err(source) if run.cracks.is_empty() => {
                    return Err(PaperError::Run { name: name.to_owned(), source });
                }
                Err(error) => return Ok(run.ended_early(&error)),
            }
        }
    }

    fn ended_early(self, error: &GrowthError) -> Self {
        Self { failure: Some(error.to_string()), ..self }
    }

    fn add(&mut self, case: &Case, record: &StepRecord) {
        self.steps += 1;
        self.solves += record.counts.solves;
        let warnings = record.warnings.iter().map(|w| format!("step {}: {}", w.step, w.text));
        self.warnings.extend(warnings);
        if record.step == 0 {
            self.cracks = initial(case, record);
        }
        for ((crack, tip), grown) in record.cracks().iter().zip(&record.tips).zip(&mut self.cracks) {
            grown.points = crack.points().iter().map(|p| [p.x, -p.y]).collect();
            // The direction of a slow crack is known before it has grown a whole increment.
            if let Some(deferred) = tip.plane().map(|plane| plane.deferred)
                && deferred.length > 0.0
            {
                let to = crack.tip(tip.tip.end) + deferred.direction * deferred.length;
                grown.points.push([to.x, -to.y]);
            }
            grown.steps.push(TipRow::of_tip(record.step, record.load_cycles, tip));
        }
    }
}

/// The cracks of the first step; every crack of the paper has one tip.
fn initial(case: &Case, record: &StepRecord) -> Vec<CrackGrowth> {
    let Some(stabilised) = record.passages.last() else { return Vec::new() };
    let passage = &case.first_wheel().passages.passage;
    let travel = (passage.to - passage.from).signum();
    let position: Vec<f64> = stabilised.xc.iter().map(|xc| travel * xc / case.half_width()).collect();
    let sticks = |crack: usize| -> Vec<bool> {
        let on_crack: Vec<usize> =
            (0..record.faces.points.len()).filter(|&p| record.faces.points[p].crack == crack).collect();
        let states = record.faces.states.iter();
        states.map(|states| on_crack.iter().all(|&p| states[p].status == FaceStatus::Stick)).collect()
    };
    let growth = |(i, (crack, sifs)): (usize, (&Crack, &Vec<railcrack::fracture::Sif>))| CrackGrowth {
        sif: SifCurve {
            position: position.clone(),
            ki: sifs.iter().map(|k| k.ki / MPA_SQRT_MM).collect(),
            kii: sifs.iter().map(|k| k.kii / MPA_SQRT_MM).collect(),
            sticks: sticks(i),
        },
        initial_points: crack.points().len(),
        ..CrackGrowth::default()
    };
    record.cracks().iter().zip(&stabilised.sifs).enumerate().map(growth).collect()
}

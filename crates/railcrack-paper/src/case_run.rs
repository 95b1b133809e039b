//! Results of one run for figures and statements.

use crate::error::PaperError;
use railcrack::contact::FaceStatus;
use railcrack::crack::Crack;
use railcrack::growth::{GrowthError, Observer, StepRecord, TipStop, Warning};
use railcrack::math::MPA_SQRT_MM;
use railcrack_case::Case;
use railcrack_run::csv::TipRow;
use railcrack_run::setup::{PreparedRun, SharedRail};
use serde::{Deserialize, Serialize};

/// K_I and K_II of one tip of the initial cracks over the stabilised passage.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrackGrowth {
    /// K of the initial crack.
    pub sif: SifCurve,
    /// The tip at every step; the first one is the initial crack's.
    pub steps: Vec<TipRow>,
    /// The crack at the end, (x, depth) in mm from its mouth.
    pub points: Vec<[f64; 2]>,
    /// Points of the initial crack among them.
    pub initial_points: usize,
    /// Why its tip stopped; none where it did not.
    pub stop: Option<TipStop>,
}

/// One run: a case in one set-up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseRun {
    /// Its cracks, as the case numbers them.
    pub cracks: Vec<CrackGrowth>,
    /// Increments that were asked for.
    pub steps_wanted: usize,
    /// Why it ended early, where a step could not be computed.
    pub failure: Option<String>,
    /// Its warnings, with their steps.
    pub warnings: Vec<String>,
    /// Its effort.
    pub effort: Effort,
}

/// Effort of a run, which differs between two computations of it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Effort {
    /// Steps.
    pub steps: usize,
    /// Contact solutions.
    pub solves: usize,
    /// Wall time of C and S, s; of a rail that runs share, only in the run that made it.
    pub body_s: f64,
    /// Wall time of contact, s.
    pub contact_s: f64,
    /// Wall time of all, s.
    pub wall_s: f64,
}

impl CaseRun {
    /// Computes `case`, on `rail` where another run has made it. A step that cannot be computed
    /// ends the run; one without its first step is an error.
    pub(super) fn compute(
        name: &str,
        case: &Case,
        rail: Option<&SharedRail>,
        observer: &dyn Observer,
    ) -> Result<Self, PaperError> {
        let failed = |source| PaperError::Run { name: name.to_owned(), source };
        let stress = |source| PaperError::Stress { name: name.to_owned(), source };
        let mut growth = PreparedRun::sharing(case, None, rail).map_err(stress)?.growth(None);
        let effort = Effort::default();
        let mut run = Self {
            cracks: Vec::new(),
            steps_wanted: case.growth.steps,
            failure: None,
            warnings: Vec::new(),
            effort,
        };
        loop {
            match growth.next_step(observer) {
                Ok(Some(record)) => run.add(case, &record),
                Ok(None) => break,
                Err(GrowthError::Interrupted { .. }) => return Err(PaperError::Interrupted),
                Err(error) if run.cracks.is_empty() => return Err(failed(error)),
                Err(error) => {
                    run.failure = Some(error.to_string());
                    break;
                }
            }
        }
        Ok(run)
    }

    fn add(&mut self, case: &Case, record: &StepRecord) {
        self.effort.steps += 1;
        self.effort.solves += record.counts.solves;
        self.effort.body_s += record.times.body_s;
        self.effort.contact_s += record.times.contact_s;
        let text = |warning: &Warning| format!("step {}: {}", warning.step, warning.text);
        self.warnings.extend(record.warnings.iter().map(text));
        if record.step == 0 {
            self.cracks = initial(case, record);
        }
        for ((crack, tip), grown) in record.cracks().iter().zip(&record.tips).zip(&mut self.cracks) {
            grown.points = points(crack);
            // The direction of a slow crack is known before it has grown a whole increment.
            if let Some(deferred) = tip.plane().map(|plane| plane.deferred)
                && deferred.length > 0.0
            {
                let to = crack.tip(tip.tip.end) + deferred.direction * deferred.length;
                grown.points.push([to.x, -to.y]);
            }
            grown.stop = tip.stop;
            grown.steps.push(TipRow::of_tip(record.step, record.load_cycles, tip));
        }
    }
}

/// The cracks of the first step; every crack of the paper has one tip.
fn initial(case: &Case, record: &StepRecord) -> Vec<CrackGrowth> {
    let passage = &case.passages.passage;
    let travel = (passage.to - passage.from).signum();
    let Some(stabilised) = record.passages.last() else { return Vec::new() };
    let position: Vec<f64> = stabilised.xc.iter().map(|xc| travel * xc / case.half_width()).collect();
    let sticks = |crack: usize| -> Vec<bool> {
        let mine: Vec<usize> =
            (0..record.faces.points.len()).filter(|&p| record.faces.points[p].crack == crack).collect();
        let all = |states: &Vec<_>| mine.iter().all(|&p| status(states, p) == FaceStatus::Stick);
        record.faces.states.iter().map(all).collect()
    };
    let of = |(i, (crack, sifs)): (usize, (&Crack, &Vec<railcrack::fracture::Sif>))| CrackGrowth {
        sif: SifCurve {
            position: position.clone(),
            ki: sifs.iter().map(|k| k.ki / MPA_SQRT_MM).collect(),
            kii: sifs.iter().map(|k| k.kii / MPA_SQRT_MM).collect(),
            sticks: sticks(i),
        },
        steps: Vec::new(),
        points: Vec::new(),
        initial_points: crack.points().len(),
        stop: None,
    };
    record.cracks().iter().zip(&stabilised.sifs).enumerate().map(of).collect()
}

fn status(states: &[railcrack::contact::FaceState], point: usize) -> FaceStatus {
    states[point].status
}

fn points(crack: &Crack) -> Vec<[f64; 2]> {
    crack.points().iter().map(|p| [p.x, -p.y]).collect()
}

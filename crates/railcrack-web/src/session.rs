//! A run whose page asks for one growth step after another.

use crate::refusal::Refusal;
use crate::step_json;
use railcrack_case::Case;
use railcrack_run::setup::RunSize;
use railcrack_run::simulation::{RunByStep, Simulation};
use railcrack_run::{OutputError, VERSION};
use serde_json::{Value, json};
use std::path::Path;

/// A run within a page.
pub struct Session {
    case: Case,
    by_step: RunByStep,
}

/// A page has no folder.
fn nowhere() -> &'static Path {
    Path::new("")
}

impl Session {
    /// The run of the case written in `text`, before its first step.
    ///
    /// Errors: all errors of the text; what a page does not compute.
    pub fn begin(text: &str) -> Result<Self, Vec<Refusal>> {
        let case = Case::parse(text, "case", nowhere()).map_err(|errors| Refusal::of_case(&errors))?;
        let reasons = case.not_in_page();
        if !reasons.is_empty() {
            return Err(reasons.iter().map(Refusal::of_page).collect());
        }
        let by_step =
            Simulation::new(&case).begin_by_step(nowhere()).map_err(|error| vec![Refusal::of_run(&error)])?;
        Ok(Self { case, by_step })
    }

    /// The case as read, defaults filled in, and what its page needs to know of it.
    #[must_use]
    pub fn case(&self) -> Value {
        let case = &self.case;
        json!({
            "version": VERSION,
            "title": case.title,
            "toml": case.to_toml(),
            "steps": case.growth.expected_steps(),
            "half_width_mm": case.half_width(),
            "axle_load_t": case.axle_load,
            "face_points": RunSize::estimate(case).face_points,
        })
    }

    /// Computes the next growth step: tips, cracks, and the histories of K over the stabilised
    /// passage; null where the run has ended.
    ///
    /// Errors: the step cannot be computed; the steps before it are kept.
    pub fn step(&mut self) -> Result<Value, Refusal> {
        let simulation = Simulation::new(&self.case);
        let record = simulation.next_of(&mut self.by_step).map_err(|error| Refusal::of_run(&error))?;
        Ok(record.map_or(Value::Null, |record| step_json::step(record, &self.case)))
    }

    /// Whether no step follows.
    #[must_use]
    pub fn has_ended(&self) -> bool {
        self.by_step.has_ended()
    }

    /// `summary.json` so far, without samples and other runs.
    #[must_use]
    pub fn summary(&self) -> Value {
        serde_json::to_value(self.by_step.run().summary_without_samples()).unwrap_or_default()
    }

    /// Computes the other runs that the decision needs, and the samples of `[scatter]`;
    /// `summary.json`.
    ///
    /// Errors: another run cannot be computed.
    pub fn decide(&mut self) -> Result<Value, Refusal> {
        let simulation = Simulation::new(&self.case);
        simulation
            .accompany_by_step(&mut self.by_step, nowhere())
            .map_err(|error| Refusal::of_run(&error))?;
        Ok(serde_json::to_value(self.by_step.run().summary()).unwrap_or_default())
    }

    /// The texts of `sif.csv` and `growth.csv`.
    ///
    /// Errors: a number that is not finite.
    pub fn tables(&self) -> Result<Value, Refusal> {
        let run = self.by_step.run();
        let of_output = |error: OutputError| Refusal::of_run(&error.into());
        Ok(json!({
            "sif.csv": run.sif_table().map_err(of_output)?,
            "growth.csv": run.growth_table().map_err(of_output)?,
        }))
    }
}

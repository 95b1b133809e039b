use super::*;
use crate::drive::StepSource;
use clap::Parser;
use railcrack::growth::{GrowthError, Observer, StepRecord};
use railcrack::output::OutputError;
use std::fs;
use support::{SMALL, Scratch, case, info, step};

#[path = "../../../railcrack/tests/support/mod.rs"]
mod support;

#[derive(Debug, Parser)]
struct Command {
    #[command(flatten)]
    run: RunArguments,
}

fn arguments(line: &[&str]) -> RunArguments {
    Command::try_parse_from([&["run"], line].concat()).unwrap().run
}

/// A synthetic run that is interrupted in the step `interrupted_in`.
struct Synthetic {
    state: GrowthState,
    interrupted_in: Option<usize>,
    interruption: Interruption,
}

impl StepSource for Synthetic {
    fn next_step(&mut self, watch: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        let now = self.state.step;
        watch.progress(0.5);
        if self.interrupted_in == Some(now) {
            self.interruption.ask();
        }
        if watch.interrupted() {
            return Err(GrowthError::Interrupted { step: now });
        }
        let (record, state) = step(SMALL, now);
        self.state = state;
        Ok(Some(record))
    }

    fn state(&self) -> &GrowthState {
        &self.state
    }
}

/// Runs the command `line`, interrupted in a step or not.
fn run(line: &[&str], interrupted_in: Option<usize>) -> Result<Finished, RunError> {
    let job = Job { case: case(), info: info(), increments: SMALL.increments };
    let interruption = Interruption::default();
    execute(&arguments(line), job, &interruption, |stage| {
        let mut initial = step(SMALL, 0).1;
        initial.step = 0;
        let state = stage.state.unwrap_or(initial);
        Ok((Synthetic { state, interrupted_in, interruption: interruption.clone() }, None))
    })
}

#[test]
fn a_run_goes_beside_its_case_and_ends() {
    let scratch = Scratch::new("cli-run");
    let path = scratch.path().join("rail.toml");
    let finished = run(&[path.to_str().unwrap(), "--quiet"], None).unwrap();
    assert_eq!((finished.ending, &finished.folder), (Ending::Ended, &scratch.path().join("rail")));
    let text = result_text(&finished);
    assert!(
        text.starts_with("steps-done at step 4, 140 999 load cycles, 2.397 million gross tonnes\n"),
        "{text}"
    );
    assert!(text.contains("crack 1 tip 1: at ("), "{text}");
    assert!(text.contains("1 warning, see summary.json\n"), "{text}");
}

#[test]
fn an_interrupted_run_resumes_to_the_same_tables() {
    let scratch = Scratch::new("cli-resume");
    let folder = |name: &str| scratch.path().join(name).display().to_string();
    let (whole, cut) = (folder("whole"), folder("cut"));
    run(&["x.toml", "--quiet", "--out", &whole], None).unwrap();
    let line = ["x.toml", "--quiet", "--out", &cut, "--resume"];
    let interrupted = run(&line[..4], Some(2)).unwrap();
    assert_eq!(interrupted.ending, Ending::Interrupted);
    let text = result_text(&interrupted);
    assert!(text.starts_with("interrupted after step 1, 41 000 load cycles"), "{text}");
    assert!(text.contains("--resume"), "{text}");
    assert!(!interrupted.summary.complete);
    // Interrupted again before anything new: nothing is lost.
    assert_eq!(run(&line, Some(2)).unwrap().summary.steps_recorded, 2);
    assert_eq!(run(&line, None).unwrap().ending, Ending::Ended);
    assert_eq!(run(&line, None).unwrap().summary.steps_recorded, SMALL.increments + 1);
    for file in ["case.toml", "sif.csv", "growth.csv", "faces.csv", "plots/ki.svg", "plots/faces-last.svg"] {
        let read = |folder: &str| fs::read(Path::new(folder).join(file)).unwrap();
        assert!(read(&whole) == read(&cut), "{file}");
    }
}

#[test]
fn refusals_have_their_exit_codes() {
    let scratch = Scratch::new("cli-codes");
    let folder = scratch.path().join("run").display().to_string();
    let code = |line: &[&str]| run(line, None).unwrap_err().exit().code();
    assert_eq!(code(&["x.toml", "--quiet", "--out", &folder, "--resume"]), 2);
    run(&["x.toml", "--quiet", "--out", &folder], None).unwrap();
    assert_eq!(code(&["x.toml", "--quiet", "--out", &folder]), 2);
    run(&["x.toml", "--quiet", "--out", &folder, "--force"], None).unwrap();
    let own = format!("{folder}/case.toml");
    let before = fs::read(&own).unwrap();
    assert_eq!(code(&[&own, "--quiet", "--out", &folder, "--force"]), 2);
    assert_eq!(before, fs::read(&own).unwrap());
    let file = scratch.path().join("file.txt").display().to_string();
    fs::write(&file, "").unwrap();
    assert_eq!(code(&["x.toml", "--quiet", "--out", &file]), 4);
    let not_finite =
        OutputError::NotFinite { file: "sif.csv", column: "xc_mm", row: String::new(), value: f64::NAN };
    assert_eq!(RunError::from(not_finite).exit().code(), 3);
}

#[test]
fn resume_and_force_exclude_each_other() {
    let refused = Command::try_parse_from(["run", "x.toml", "--resume", "--force"]).unwrap_err();
    assert_eq!(refused.exit_code(), 2);
    assert!(Command::try_parse_from(["run", "x.toml", "--threads", "0"]).is_err());
}

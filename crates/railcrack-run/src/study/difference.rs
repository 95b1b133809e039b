//! Differences between a study and the one that its folder holds.

use super::plan::{PlannedRun, StudyPlan};
use crate::disk::files::STUDY_FILE;
use crate::error::OutputError;
use crate::run_folder::{CaseFiles, same_case};
use std::path::Path;

impl StudyPlan {
    /// Whether `other` has the same runs, apart from what their cases have in common. Version,
    /// title and colours are not compared.
    pub(super) fn computes_what(&self, other: &Self) -> bool {
        let runs = |plan: &Self| -> Vec<PlannedRun> {
            plan.runs.iter().map(|run| PlannedRun { case: None, ..run.clone() }).collect()
        };
        (&self.axes, &self.options) == (&other.axes, &other.options) && runs(self) == runs(other)
    }

    /// Whether this plan has the case of `run`, a run of the same study; the plans of older
    /// versions do not say.
    pub(super) fn has_case_of(&self, run: &PlannedRun) -> bool {
        let own = self.runs.iter().find(|own| own.number == run.number).and_then(|own| own.case.as_ref());
        own.is_none() || own == run.case.as_ref()
    }

    /// The first thing in which `other` differs, in words.
    pub(super) fn first_difference(&self, other: &Self) -> String {
        let said = |options: &[String]| match options {
            [] => "no options".to_owned(),
            options => options.join(" "),
        };
        if self.options != other.options {
            return format!("it was started with {}, now {}", said(&self.options), said(&other.options));
        }
        let keys = |plan: &Self| -> Vec<(String, Vec<String>)> {
            let all = plan.axes.iter().flat_map(|axis| &axis.keys);
            all.map(|key| (key.key.clone(), key.values.clone())).collect()
        };
        for pair in keys(self).iter().zip(&keys(other)) {
            let ((before, values), (now, values_now)) = pair;
            if before != now || values != values_now {
                return format!(
                    "{before} = [{}] there, {now} = [{}] now",
                    values.join(", "),
                    values_now.join(", ")
                );
            }
        }
        format!("{} runs there, {} now", self.runs.len(), other.runs.len())
    }
}

/// The packed run `number` in `file` has the case `stored` instead of `given`: it is a run of
/// another study, or the study has been changed.
pub(super) fn other_case(
    file: &Path,
    number: usize,
    stored: &CaseFiles,
    given: &CaseFiles,
    is_this_study: bool,
) -> OutputError {
    match same_case(file, stored, given) {
        Err(OutputError::CaseChanged { file: of_case, line, stored, given, .. }) if is_this_study => {
            let difference = format!("line {line} of its {of_case} is \"{stored}\", not \"{given}\"");
            OutputError::OtherStudy { file: file.to_path_buf(), number, difference }
        }
        Err(error) => error,
        Ok(()) => OutputError::damaged(file, format!("run {number}: has another case than it says")),
    }
}

/// How the text of a study differs from the `stored` one, where run `number` has another case.
pub(super) fn other_text(number: usize, stored: &str, given: &str) -> String {
    let lines = || stored.lines().map(str::trim).zip(given.lines().map(str::trim));
    let line = lines().enumerate().find(|(_, (there, now))| there != now);
    let line = line.map_or_else(String::new, |(line, (there, now))| {
        format!(": line {} of {STUDY_FILE} is \"{there}\" there, \"{now}\" now", line + 1)
    });
    format!("run {number} has another case{line}")
}

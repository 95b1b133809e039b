//! A run of a study with its place in the plan.

use crate::direction::{Heading, heading};
use crate::numbers::brief;
use railcrack_run::StudyFolder;
use railcrack_run::files::REPORT_FILE;
use railcrack_run::run_folder::RepresentativeTip;
use railcrack_run::study::{PlannedRun, StudyPlan, StudyRow};

/// A run of a study.
pub(crate) struct StudyRun<'a> {
    pub(crate) planned: &'a PlannedRun,
    pub(crate) row: &'a StudyRow,
    /// `run 3: friction 0.4, angle_deg 15`, also the name of its curves.
    pub(crate) name: String,
    /// Whether its folder has a report.
    pub(crate) has_report: bool,
}

impl<'a> StudyRun<'a> {
    /// The run `planned` of `plan` with its results.
    pub(crate) fn new(folder: &StudyFolder, planned: &'a PlannedRun, row: &'a StudyRow) -> Self {
        let name = format!("run {}: {}", planned.number, values(folder.plan(), planned));
        let has_report = folder.run_folder(planned).join(REPORT_FILE).is_file();
        Self { planned, row, name, has_report }
    }

    /// Its representative tip; none without a finished step.
    pub(crate) fn tip(&self) -> Option<&'a RepresentativeTip> {
        self.row.representative.as_ref()
    }

    pub(crate) fn number(&self) -> usize {
        self.planned.number
    }

    /// Direction of the last segment of its representative tip.
    pub(crate) fn heading(&self) -> Option<Heading> {
        let (tip, summary) = (self.tip()?, self.row.summary.as_ref()?);
        let crack = summary.cracks.get(tip.first.crack.checked_sub(1)?)?;
        heading(crack, &tip.rows.iter().collect::<Vec<_>>())
    }
}

/// The values of a run: `friction 0.4, angle_deg 15`.
pub(crate) fn values(plan: &StudyPlan, run: &PlannedRun) -> String {
    let values = plan.values_of(run).map(|(key, value)| format!("{} {}", key.name, brief(value)));
    values.collect::<Vec<_>>().join(", ")
}

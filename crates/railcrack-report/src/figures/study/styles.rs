//! Runs of a study: their place in the plan, colours and dashes by their values.

use crate::chart::{CATEGORIES, Curve, CurveColour, CurveLook, LegendEntry};
use crate::choices::{AtFirst, Choice, ChoiceGroup, ChoiceMark, Choices};
use crate::direction::{Heading, heading};
use crate::numbers::brief;
use railcrack_run::StudyFolder;
use railcrack_run::files::REPORT_FILE;
use railcrack_run::run_folder::RepresentativeTip;
use railcrack_run::study::{PlannedRun, StudyAxis, StudyPlan, StudyRow};

/// Lines of the values of the second axis.
const LOOKS: [CurveLook; 4] =
    [CurveLook::Line, CurveLook::Dashed, CurveLook::FineDashed, CurveLook::DashDotted];
/// Maximum number of values of an axis in a legend; further ones follow from the order of the
/// colours.
const LEGEND_VALUES: usize = 12;

/// Colours and dashes of the values of each axis.
pub(crate) struct Styles<'a> {
    plan: &'a StudyPlan,
    colours: Vec<CurveColour>,
    /// The axis whose values have the dashes.
    dashed: Option<usize>,
}

impl<'a> Styles<'a> {
    pub(crate) fn new(plan: &'a StudyPlan) -> Self {
        let few = |(_, axis): &(usize, &StudyAxis)| (2..=LOOKS.len()).contains(&axis.len());
        let others = plan.axes.iter().enumerate().filter(|(i, _)| *i != plan.colour_axis);
        Self {
            plan,
            colours: plan.axes.get(plan.colour_axis).map_or_else(Vec::new, colours),
            dashed: others.into_iter().find(few).map(|(i, _)| i),
        }
    }

    /// `points` as a curve of `run`.
    pub(super) fn curve(&self, run: &StudyRun, points: Vec<[f64; 2]>) -> Curve {
        let choice = &run.planned.choice;
        let value = |axis: usize| choice.get(axis).copied().unwrap_or(0);
        let colour = self.colours.get(value(self.plan.colour_axis)).copied();
        let look = self.dashed.map_or(CurveLook::Line, |axis| LOOKS[value(axis) % LOOKS.len()]);
        Curve { colour: Some(colour.unwrap_or(CurveColour::Ink)), ..Curve::line(&run.name, points) }
            .with_look(look)
            .with_choices(choice.clone())
    }

    fn mark(&self, axis: usize, value: usize) -> ChoiceMark {
        if axis == self.plan.colour_axis {
            self.colours.get(value).map_or(ChoiceMark::None, |&colour| ChoiceMark::Colour(colour))
        } else if Some(axis) == self.dashed {
            ChoiceMark::Look(LOOKS[value % LOOKS.len()])
        } else {
            ChoiceMark::None
        }
    }

    /// The switches of the page: none for single samples.
    pub(crate) fn choices(&self) -> Choices {
        let group = |(i, axis): (usize, &StudyAxis)| {
            let choice = |value: usize| Choice {
                name: axis.value(value),
                mark: self.mark(i, value),
                at_first: AtFirst::Shown,
            };
            let values = if axis.is_drawn() { 0..0 } else { 0..axis.len() };
            ChoiceGroup { name: axis.name(), values: values.map(choice).collect() }
        };
        Choices { groups: self.plan.axes.iter().enumerate().map(group).collect() }
    }

    /// The legend of the SVG files, the axis with the colours first.
    pub(super) fn legend(&self) -> Vec<LegendEntry> {
        let mut legend = Vec::new();
        let axes = self.plan.axes.iter().enumerate();
        let (coloured, others): (Vec<_>, Vec<_>) = axes.partition(|(i, _)| *i == self.plan.colour_axis);
        for (i, axis) in coloured.into_iter().chain(others) {
            let every = axis.len().div_ceil(LEGEND_VALUES).max(1);
            let entries = (0..axis.len()).step_by(every).filter_map(|value| {
                let (look, colour) = match self.mark(i, value) {
                    ChoiceMark::Colour(colour) => (CurveLook::Line, colour),
                    ChoiceMark::Look(look) => (look, CurveColour::Quiet),
                    ChoiceMark::None => return None,
                };
                Some(LegendEntry::curve(&axis.value(value), look, colour))
            });
            let entries: Vec<LegendEntry> = entries.collect();
            if !entries.is_empty() {
                legend.push(LegendEntry::heading(&axis.name()));
                legend.extend(entries);
            } else if axis.len() > 1 {
                legend.push(LegendEntry::heading(&format!("one curve for each {}", axis.name())));
            }
        }
        legend
    }
}

/// Colours of the values of an axis: of numbers, by their order; of words, distinct ones.
fn colours(axis: &StudyAxis) -> Vec<CurveColour> {
    let count = axis.len();
    let along = |rank: usize| CurveColour::Along(rank as f64 / (count - 1).max(1) as f64);
    match axis.numbers() {
        Some(numbers) => {
            let below = |x: &f64| numbers.iter().filter(|other| *other < x).count();
            numbers.iter().map(|x| along(below(x))).collect()
        }
        None if count <= CATEGORIES => (0..count).map(CurveColour::Category).collect(),
        None => (0..count).map(along).collect(),
    }
}

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

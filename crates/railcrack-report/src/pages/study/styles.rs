//! Colours and dashes of runs by their values, as in the plots.

use crate::{AtFirst, Choice, ChoiceGroup, ChoiceMark, Choices, Curve, CurveColour, CurveLook};
use railcrack_run::study::{PlannedRun, StudyAxis, StudyPlan};

/// Dashes of the values of the second axis.
const LOOKS: [CurveLook; 4] =
    [CurveLook::Line, CurveLook::Dashed, CurveLook::FineDashed, CurveLook::DashDotted];
/// Colours of things without order.
const CATEGORIES: usize = 7;

/// What the values of each axis look like.
pub(super) struct Styles<'a> {
    plan: &'a StudyPlan,
    colours: Vec<CurveColour>,
    /// The axis whose values have the dashes.
    dashed: Option<usize>,
}

impl<'a> Styles<'a> {
    pub(super) fn new(plan: &'a StudyPlan) -> Self {
        let few = |(_, axis): &(usize, &StudyAxis)| (2..=LOOKS.len()).contains(&axis.len());
        let others = plan.axes.iter().enumerate().filter(|(i, _)| *i != plan.colour_axis);
        Self {
            plan,
            colours: plan.axes.get(plan.colour_axis).map_or_else(Vec::new, colours),
            dashed: others.into_iter().find(few).map(|(i, _)| i),
        }
    }

    /// `points` of `run` as a curve called `name`.
    pub(super) fn curve(&self, run: &PlannedRun, name: &str, points: Vec<[f64; 2]>) -> Curve {
        let value = |axis: usize| run.choice.get(axis).copied().unwrap_or(0);
        let colour = self.colours.get(value(self.plan.colour_axis)).copied();
        let look = self.dashed.map_or(CurveLook::Line, |axis| LOOKS[value(axis) % LOOKS.len()]);
        Curve { colour, ..Curve::line(name, points) }.with_look(look).with_choices(run.choice.clone())
    }

    /// The switches of the page.
    pub(super) fn choices(&self) -> Choices {
        let group = |(i, axis): (usize, &StudyAxis)| {
            let choice = |value: usize| Choice {
                name: axis.value(value),
                mark: if i == self.plan.colour_axis {
                    self.colours.get(value).map_or(ChoiceMark::None, |&colour| ChoiceMark::Colour(colour))
                } else if Some(i) == self.dashed {
                    ChoiceMark::Look(LOOKS[value % LOOKS.len()])
                } else {
                    ChoiceMark::None
                },
                at_first: AtFirst::Shown,
            };
            ChoiceGroup { name: axis.name(), values: (0..axis.len()).map(choice).collect() }
        };
        Choices { groups: self.plan.axes.iter().enumerate().map(group).collect() }
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

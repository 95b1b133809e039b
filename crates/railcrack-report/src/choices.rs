//! Switches of a page: curves and rows that a reader shows or hides.

use crate::chart::{CurveColour, CurveLook, dashes};
use crate::html::json_for_script;
use serde_json::json;
use std::fmt::Write;

/// Groups of values that a reader switches on and off: a curve or a row is shown where its value of
/// every group is on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Choices {
    /// The groups, in the order of [`Curve::choices`](crate::chart::Curve::choices).
    pub groups: Vec<ChoiceGroup>,
}

/// Values of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ChoiceGroup {
    /// The key or quantity of the values.
    pub name: String,
    /// The values.
    pub values: Vec<Choice>,
}

/// A value to choose.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The value as text.
    pub name: String,
    /// Colour or dashes of its curves, as a legend.
    pub mark: ChoiceMark,
    /// Whether it is on when the page opens.
    pub at_first: AtFirst,
}

/// Common look of curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChoiceMark {
    /// Nothing visible.
    None,
    /// Their colour.
    Colour(CurveColour),
    /// Their dashes.
    Look(CurveLook),
}

/// Whether a value is on when the page opens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtFirst {
    /// It is.
    #[default]
    Shown,
    /// It is not.
    Hidden,
}

impl Choices {
    /// Appends the place of the switches to `page`, which the page's script fills.
    pub(super) fn write(&self, page: &mut String) {
        let value = |choice: &Choice| {
            json!({
                "name": choice.name,
                "shown": choice.at_first == AtFirst::Shown,
                "colour": match choice.mark {
                    ChoiceMark::Colour(colour) => Some(colour.name()),
                    _ => None,
                },
                "dashes": match choice.mark {
                    ChoiceMark::Look(look) => Some(dashes(look)),
                    _ => None,
                },
            })
        };
        let group = |group: &ChoiceGroup| json!({ "name": group.name, "values": group.values.iter().map(value).collect::<Vec<_>>() });
        let data = json_for_script(&self.groups.iter().map(group).collect());
        // Writing to a string does not fail.
        let _ = writeln!(
            page,
            "<div class=\"controls choices\" id=\"choices\" hidden></div>\n\
             <script type=\"application/json\" id=\"choices-data\">{data}</script>"
        );
    }
}

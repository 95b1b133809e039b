//! Equations of the components whose conditions differ from those of a basis.

use crate::linear::{BorderedFactor, LinearError, SmallFactor};

/// The components whose present conditions differ from those of the basis.
#[derive(Default)]
pub(super) struct Differences {
    /// The components in the order of their changes.
    pub(super) components: Vec<usize>,
    /// The factor of the equations of the leading components.
    pub(super) factor: BorderedFactor,
    /// The factor of all equations with row interchanges, used where the bordered factor lacks a
    /// pivot.
    pub(super) whole: Option<SmallFactor>,
}

impl Differences {
    /// Records a change of the condition of `component`, and whether it now `differs` from that of
    /// the basis.
    pub(super) fn change(&mut self, component: usize, differs: bool) {
        self.whole = None;
        if let Some(place) = self.components.iter().position(|&other| other == component) {
            self.components.remove(place);
            self.factor.truncate(place);
        }
        if differs {
            self.components.push(component);
        }
    }

    /// Solves the equations in place.
    pub(super) fn solve(&self, right: &mut [f64]) -> Result<(), LinearError> {
        match &self.whole {
            Some(whole) => whole.solve(right),
            None => self.factor.solve(right),
        }
    }
}

//! Components whose conditions differ from those of a basis, and their equations.

use crate::linear::{BorderedFactor, LinearError, SmallFactor};

/// Where the present conditions differ from those of the basis.
#[derive(Default)]
pub(super) struct Differences {
    /// In the order in which they came.
    pub(super) components: Vec<usize>,
    /// The factor of the equations of the first of them.
    pub(super) factor: BorderedFactor,
    /// That of all, with exchange of rows, where the other one finds no pivot.
    pub(super) whole: Option<SmallFactor>,
}

impl Differences {
    /// Takes note that the condition of `component` has changed, and whether it `differs` from that
    /// of the basis.
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

    /// Solves their equations in place.
    pub(super) fn solve(&self, right: &mut [f64]) -> Result<(), LinearError> {
        match &self.whole {
            Some(whole) => whole.solve(right),
            None => self.factor.solve(right),
        }
    }
}

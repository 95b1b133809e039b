//! The runs of a study.

use super::axes::Axis;
use crate::case::Case;
use crate::tables::Combine;

/// A case file with lists instead of values, and the cases that it defines.
#[derive(Debug, Clone)]
pub struct Study {
    /// Heading of its plots.
    pub title: String,
    /// How its axes are combined.
    pub combine: Combine,
    /// Its axes, in the order of the file; at least one.
    pub axes: Vec<Axis>,
    /// The axis whose values have the colours of the overlay plots, from 0.
    pub colour_axis: usize,
    /// How its runs are kept.
    pub keeping: Keeping,
    /// Its runs; the values of the last axis change from one to the next.
    pub runs: Vec<StudyRun>,
    /// The text of the file.
    pub text: String,
}

/// How the runs of a study are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keeping {
    /// A run folder for each.
    Folders,
    /// All in a few files.
    Packed,
}

/// One case of a study.
#[derive(Debug, Clone)]
pub struct StudyRun {
    /// Its number, from 1.
    pub number: usize,
    /// The value that it takes of each axis, from 0.
    pub choice: Vec<usize>,
    /// These values: `friction = 0.025, angle_deg = 15`.
    pub label: String,
    /// The name of its run folder.
    pub folder: String,
    /// The case that it computes.
    pub case: Case,
}

/// Maximum number of runs of a study: a longer list is probably a mistake, and no plot or table
/// could show the runs.
pub(super) const MOST_RUNS: usize = 10_000;

/// Every combination of the values of `axes`, the last one changing fastest; none where there are
/// more than [`MOST_RUNS`].
pub(super) fn choices(axes: &[Axis]) -> Option<Vec<Vec<usize>>> {
    let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.len()))?;
    if count > MOST_RUNS {
        return None;
    }
    let choice = |run: usize| {
        let mut left = run;
        let mut choice: Vec<usize> = axes
            .iter()
            .rev()
            .map(|axis| {
                let index = left % axis.len();
                left /= axis.len();
                index
            })
            .collect();
        choice.reverse();
        choice
    };
    Some((0..count).map(choice).collect())
}
